"""From a campaign of records to its problem: what the loop cannot begin with is refused."""

from __future__ import annotations

import numpy as np

from edesign.calibration.dampers.from_campaign import check_uses
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.problem import StructureProblem
from edesign.damper.testing.measured_histories import USES
from edesign.errors import InputError
from edesign.estimation.model import PredictionError

_ABSURD = 30.0  # ratio of measured to predicted motion beyond which a unit is wrong, not a building
_OPPOSITE = -0.5  # median correlation of measured and predicted channels below which a sign is wrong


def structure_problem(campaign: StructureCampaign, threads: int | None = None) -> StructureProblem:
    """Return the problem of a campaign.

    Args:
        campaign: records, and the declared building.
        threads: of predictions, at most so many; None: as many as there are processors.

    Raises:
        InputError: there are too few tests, or their channels cannot be those of the declared building.
    """
    check_uses(campaign.path, campaign.tests)
    problem = blank_problem(campaign, threads)
    _check_channels(problem, campaign)
    return problem


def blank_problem(campaign: StructureCampaign, threads: int | None = None) -> StructureProblem:
    """Return the problem of a campaign that was checked, or needs no check.

    Args:
        campaign: records, and the declared building.
        threads: of predictions, at most so many; None: as many as there are processors.
    """
    return StructureProblem(campaign.building, campaign.isolation, campaign.refit, campaign.tests, threads)


def _check_channels(problem: StructureProblem, campaign: StructureCampaign) -> None:
    """Refuse channels of the wrong unit or sign, which no effect is to absorb."""
    try:
        histories = problem.model((), USES).histories(np.array([one.centre for one in problem.base]))
    except PredictionError as error:
        raise InputError(f"{campaign.path}: the declared building has no response: {error} [E-CALIB-04]") from error
    correlations = []
    for test, values in zip(problem.tests, histories, strict=True):
        for channel, measured, predicted in zip(test.channels, test.values.T, values.T, strict=True):
            ratio = float(np.sqrt(measured @ measured / max(predicted @ predicted, 1e-300)))
            if not 1.0 / _ABSURD < ratio < _ABSURD:
                raise InputError(
                    f"{test.source}: the {channel.label} is {ratio:.3g} times that of the declared building: are "
                    f"`channels.units` in {campaign.path} and the properties of the building right? [E-CALIB-07]"
                )
            correlations.append(float(measured @ predicted) / max(ratio * float(predicted @ predicted), 1e-300))
    if float(np.median(correlations)) < _OPPOSITE:
        raise InputError(
            f"{campaign.path}: the floors move against what the base makes the declared building do; positive "
            "acceleration of base and floors, and positive displacement, must point the same way [E-CALIB-07]"
        )
