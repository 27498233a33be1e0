"""What a declared model lacks, found in tests: which effects they show, and how large these are.

`search` holds what a problem owes the search for effects, `signals` what is known of measured channels. `form.py` is a
form of an effect, `problems.py` what problems have in common. These are `dampers`, tests of dampers, `properties`,
tables of their moduli, and `structures`, records of buildings; `residual` is what a model leaves of tests. Parameters,
priors and fits are those of `estimation`. `results` makes of what a search found what the user gets. `campaign.py`
reads any campaign: `load_campaign(path)`; `run.py` calibrates by it: `calibrate(campaign)`; `write.py` makes the files.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["calibrate", "load_campaign"]

_PLACES = {"calibrate": "run", "load_campaign": "campaign"}


def __getattr__(name: str) -> Any:
    """Load a function when it is first asked for, so that other parts of the package stay quick."""
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_PLACES[name]}"), name)
