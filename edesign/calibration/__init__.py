"""What a declared model lacks, found in tests: which effects they show, and how large these are.

`search` holds what a problem owes the search for effects, `signals` what is known of measured channels. `form.py` is a
form of an effect, `problems.py` what problems have in common. These are `dampers`, tests of dampers, `properties`,
tables of their moduli, and `structures`, records of buildings; `residual` is what a model leaves of tests. Parameters,
priors and fits are those of `estimation`. `results` makes of what a search found what the user gets. `run.py` does all
of it for tests of dampers: `calibrate(campaign)`; `properties` and `structures` have a `run.py` of their own.
"""

from __future__ import annotations

from typing import Any

__all__ = ["calibrate"]


def __getattr__(name: str) -> Any:
    """Load `calibrate` when it is first asked for, so that other parts of the package stay quick."""
    if name != "calibrate":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from edesign.calibration.run import calibrate

    return calibrate
