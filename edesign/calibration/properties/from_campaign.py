"""From a campaign of a property table to its problem."""

from __future__ import annotations

from edesign.calibration.properties.campaign import PropertyCampaign
from edesign.calibration.properties.problem import PropertyProblem, problem_of
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.errors import InputError

_QUICK_CYCLES, _QUICK_SAMPLES = (8, 8), 60
"""Of the search: the eighth full cycle is within the repeatability of tables from the mean of cycles 5 to 15."""


def property_problem(
    campaign: PropertyCampaign,
    cycles: tuple[int, int] = _QUICK_CYCLES,
    samples: int = _QUICK_SAMPLES,
    threads: int | None = None,
) -> PropertyProblem:
    """Return the problem of a campaign.

    Args:
        campaign: the table, and the declared law.
        cycles: of the simulated tests that are averaged, first and last.
        samples: of such a cycle.
        threads: of predictions, at most so many; None: as many as there are processors.

    Raises:
        InputError: no law is declared.
    """
    if campaign.law.parameters is None:
        raise InputError(f"{campaign.path}: law: the law thought of is needed, with its parameters [E-CALIB-01]")
    law = law_of(campaign.law.type)
    declared = law.complete(read_parameters(law, campaign.law.parameters))
    of = campaign.table, campaign.specimen, campaign.groups
    return problem_of(*of, law, declared, campaign.law.refit, cycles, samples, threads)
