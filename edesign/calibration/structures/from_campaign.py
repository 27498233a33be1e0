"""From a campaign of records to the problem, and what a search finds in it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.search.search import Found, Progress, Search
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.problem import StructureProblem
from edesign.errors import InputError
from edesign.estimation.model import PredictionError

Stage = Literal["declared", "refit", "corrected"]
_ABSURD = 30.0  # ratio of measured to predicted motion beyond which a unit is wrong, not a building
_OPPOSITE = -0.5  # median correlation of measured and predicted channels below which a sign is wrong


@dataclass(frozen=True, eq=False)
class StructureCalibration:
    """What a search found in records of a structure.

    Attributes:
        problem: of the records.
        found: by the search.
        predicted: channels (t, channels), SI, of all tests by stage.
    """

    problem: StructureProblem
    found: Found
    predicted: Mapping[Stage, tuple[np.ndarray, ...]]

    def nrms(self, stage: Stage, *tests: int) -> float:
        """Return the root of the squared errors of all scaled channels over their squares.

        Args:
            stage: of the model.
            tests: their indices.
        """
        measured = [self.problem.flat(i, self.problem.tests[i].values) for i in tests]
        left = [y - self.problem.flat(i, self.predicted[stage][i]) for i, y in zip(tests, measured, strict=True)]
        return float(np.sqrt(sum(float(r @ r) for r in left) / sum(float(y @ y) for y in measured)))


def structure_problem(campaign: StructureCampaign, threads: int | None = None) -> StructureProblem:
    """Return the problem of a campaign.

    Args:
        campaign: records, and the declared building.
        threads: of predictions, at most so many; None: as many as there are processors.

    Raises:
        InputError: there are too few tests, or their channels cannot be those of the declared building.
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
    problem = StructureProblem(campaign.building, campaign.isolation, campaign.refit, campaign.tests, threads)
    _check_channels(problem, campaign)
    return problem


def calibrate_structure(
    problem: StructureProblem, settings: SearchSettings = SETTINGS, progress: Progress = lambda _: None
) -> StructureCalibration:
    """Search what the declared building lacks.

    Args:
        problem: of the records.
        settings: numbers of the search.
        progress: told what is done.
    """
    found = Search(problem.thinned(), settings, progress).run()
    fits = {"refit": found.base, "corrected": found.best}
    plain = problem.model((), ("fit", "validate"))
    predicted: dict[Stage, tuple[np.ndarray, ...]] = {"declared": tuple(plain.histories(_centres(problem)))}
    for stage, one in fits.items():
        model = problem.model(one.effects, ("fit", "validate"))
        predicted[stage] = tuple(model.histories(one.fit.values))  # type: ignore[index]
    return StructureCalibration(problem, found, predicted)


def _centres(problem: StructureProblem) -> np.ndarray:
    return np.array([one.centre for one in problem.base])


def _check_channels(problem: StructureProblem, campaign: StructureCampaign) -> None:
    """Refuse channels of the wrong unit or sign, which no effect is to absorb."""
    try:
        histories = problem.model((), ("fit", "validate")).histories(_centres(problem))
    except PredictionError as error:
        raise InputError(f"{campaign.path}: the declared building has no response: {error}") from error
    correlations = []
    for test, values in zip(problem.tests, histories, strict=True):
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
