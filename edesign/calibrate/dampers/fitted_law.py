"""A campaign that names a law without its parameters: the law is fitted to its tests before anything is judged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from edesign.damper.fitting import fit_forces
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.testing.campaign import Campaign


def with_fitted_law(campaign: Campaign, workers: int = 1, tell: Callable[[str], None] = lambda line: None) -> Campaign:
    """Return the campaign with parameters of its law: as they are if it has any, else fitted to its tests.

    Args:
        campaign: tests, and a law.
        workers: threads.
        tell: told that the law is fitted.

    Raises:
        InputError: the law cannot be fitted to these tests.
    """
    if campaign.law is None or campaign.law.parameters is not None:
        return campaign
    law = law_of(campaign.law.type)
    tell(f"fitting the law {law.name}, of which the campaign names no parameters")
    found = fit_forces(law, campaign.used_for("fit"), specimen=campaign.specimen, workers=workers)
    values = write_parameters(law, found.values)
    return replace(campaign, law=replace(campaign.law, parameters=values, fitted=True))
