"""Campaigns of structures that the loop cannot begin with: too few tests, wrong units or signs."""

from __future__ import annotations

import numpy as np

from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.problem import StructureProblem
from edesign.errors import InputError

_ABSURD = 30.0  # ratio of measured to predicted motion beyond which a unit is wrong, not a building
_OPPOSITE = -0.5  # median correlation of measured and predicted channels below which a sign is wrong


def check_tests(campaign: StructureCampaign) -> None:
    """Refuse too few tests.

    Raises:
        InputError: fewer than two tests to fit to, or none to validate with.
    """
    fitted = sum(test.use == "fit" for test in campaign.tests)
    if fitted < 2:
        raise InputError(
            f"{campaign.path}: tests: {fitted} with `use: fit`; an effect is adopted when it lowers the error on tests "
            "it was not fitted to, so that two are the least"
        )
    if fitted == len(campaign.tests):
        raise InputError(
            f"{campaign.path}: tests: none has `use: validate`; the error before and after is reported on tests that "
            "nothing was fitted to, so that one is the least"
        )


def check_channels(problem: StructureProblem, campaign: StructureCampaign) -> None:
    """Refuse channels of the wrong unit or sign, which no effect is to absorb.

    Raises:
        InputError: the motion is far from what the declared building does.
    """
    correlations = []
    for test, values in zip(problem.tests, problem.histories(problem.declared), strict=True):
        assert values is not None
        for channel, measured, predicted in zip(test.channels, test.values.T, values.T, strict=True):
            ratio = float(np.sqrt(measured @ measured / max(predicted @ predicted, 1e-300)))
            if not 1.0 / _ABSURD < ratio < _ABSURD:
                raise InputError(
                    f"{test.source}: the {channel.label} is {ratio:.3g} times that of the declared building: are "
                    f"`channels.units` in {campaign.path} and the properties of the building right?"
                )
            correlations.append(float(measured @ predicted) / max(ratio * float(predicted @ predicted), 1e-300))
    if float(np.median(correlations)) < _OPPOSITE:
        raise InputError(
            f"{campaign.path}: the floors move against what the base makes the declared building do; positive "
            "acceleration of base and floors, and positive displacement, must point the same way"
        )
