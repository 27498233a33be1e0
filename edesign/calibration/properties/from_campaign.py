"""From a campaign of a property table to the problem, and what a search finds in it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.properties.campaign import PropertyCampaign
from edesign.calibration.properties.problem import PropertyProblem, problem_of
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.search.search import Found, Progress, Search
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.steady_state import CYCLES, SAMPLES, PropertyRows
from edesign.errors import InputError

Stage = Literal["declared", "refit", "corrected"]
USES: tuple[Use, ...] = ("fit", "validate")
_QUICK_CYCLES, _QUICK_SAMPLES = (8, 8), 60
"""Of the search: the eighth full cycle is within the repeatability of tables from the mean of cycles 5 to 15."""


@dataclass(frozen=True, eq=False)
class PropertyCalibration:
    """What a search found in a property table.

    Attributes:
        problem: of the table, with the cycles and samples of measured tests.
        found: by the search.
        rows: properties of all rows by stage.
    """

    problem: PropertyProblem
    found: Found
    rows: Mapping[Stage, PropertyRows]

    def error(self, stage: Stage, rows: np.ndarray) -> float:
        """Return the root mean square of the relative errors of all properties.

        Args:
            stage: of the model.
            rows: their indices (n,).
        """
        pairs = [(getattr(self.rows[stage], name), getattr(self.problem.table, name)) for name in QUANTITIES]
        return float(np.sqrt(np.mean([(f[rows] / y[rows] - 1.0) ** 2 for f, y in pairs])))

    def rows_of(self, use: Use) -> np.ndarray:
        """Return the indices (n,) of rows of a use.

        Args:
            use: fit, validate.
        """
        return np.concatenate([group.rows for group in self.problem.groups if group.use == use])


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
        raise InputError(f"{campaign.path}: law: the law thought of is needed, with its parameters")
    law = law_of(campaign.law.type)
    declared = law.complete(read_parameters(law, campaign.law.parameters))
    of = campaign.table, campaign.specimen, campaign.groups
    return problem_of(*of, law, declared, campaign.law.refit, cycles, samples, threads)


def calibrate_properties(
    campaign: PropertyCampaign,
    settings: SearchSettings = SETTINGS,
    progress: Progress = lambda _: None,
    threads: int | None = None,
) -> PropertyCalibration:
    """Search what the declared law lacks.

    Args:
        campaign: the table, and the declared law.
        settings: numbers of the search.
        progress: told what is done.
        threads: of predictions, at most so many; None: as many as there are processors.
    """
    quick = property_problem(campaign, threads=threads)
    found = Search(quick, settings, progress).run()
    problem, every = property_problem(campaign, CYCLES, SAMPLES, threads), USES
    declared = np.array([one.centre for one in quick.inner.base])
    rows: dict[Stage, PropertyRows] = {"declared": problem.model((), every).properties(declared)}
    rows["refit"] = problem.model((), every).properties(found.base.fit.values)
    rows["corrected"] = problem.model(found.best.effects, every).properties(found.best.fit.values)
    return PropertyCalibration(problem, found, rows)
