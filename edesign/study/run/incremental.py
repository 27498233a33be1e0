"""The histories of incremental studies: their frames, factors on the records, and what the archive says of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache

import numpy as np

from edesign.archive.dataset import Group
from edesign.errors import EdesignError
from edesign.project.actions.hazard_base import YEAR
from edesign.project.analysis.analyses import PlannedAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.study.incremental import Incremental, LevelFactorStudy, SpectralAccelerationStudy
from edesign.project.study.life_cycle import CurveOfLevels
from edesign.project.study.study import Study
from edesign.study.analysis.intensity import intensity_period, level_intensity, motion_intensity
from edesign.study.plan.plan import Task
from edesign.study.plan.variants import variant_strain
from edesign.study.results.kinds import INCREMENTAL
from edesign.study.results.recording import coordinate
from edesign.study.run.state import Prepared, RunState


def study_stripes(study: Study, run: RunState, frames: Prepared) -> Prepared:
    """Archive the basis of each incremental study of the plan, and return a function that also scales its records.

    T1 of a variant is computed once, and so is the intensity measure of a record on a variant.

    Args:
        run: whose records are ready.
        frames: gives the frame of each task.
    """
    studies = {spec.name: spec for spec in study.incremental}
    first: dict[str, dict[str, Task]] = {}
    for task in run.job.tasks:
        if task.stripe is not None:
            first.setdefault(task.stripe.incremental, {}).setdefault(task.variant, task)
    periods = _Periods(study, frames)
    for order, name in enumerate(first):
        of = {variant: periods(studies[name], task) for variant, task in first[name].items()}
        group = incremental_group(study.base, studies[name], of)
        group.attributes["order"] = order
        run.archive(f"{INCREMENTAL}/{name}", group)

    @cache
    def unit(name: str, variant: str, reference: str) -> float:
        task = first[name][variant]
        period = periods(studies[name], task, needed=True)
        return motion_intensity(frames(task)[0], studies[name], run.motions[reference], period)

    def prepared(task: Task) -> tuple[AnalysisFile, PlannedAnalysis]:
        project, spec = frames(task)
        if task.stripe is None:
            return project, spec
        factor = task.stripe.intensity / unit(task.stripe.incremental, task.variant, str(task.record))
        return project, spec.model_copy(update={"scale": factor})

    return prepared


def incremental_group(project: AnalysisFile, study: Incremental, periods: Mapping[str, float | None]) -> Group:
    """Return the archived group of an incremental study: intensities, periods, hazard curve and limits.

    Args:
        study: what the study file says.
        periods: T1 of each of its variants, s; None where it is not needed, or not known.
    """
    group = Group()
    unit = "1" if isinstance(study, LevelFactorStudy) else "m/s^2"
    coordinate(group, "intensity", study.intensities, unit, f"intensity measure: {study.intensity}")
    coordinate(group, "variant", list(periods), "", "name of the variant")
    used = [getattr(study, "period", None) or period for period in periods.values()]
    group.add("period", ("variant",), _numbers(used), "s", "period of the spectral acceleration")
    reference = [level_intensity(project, study, period, study.level) for period in used]
    group.add("level_intensity", ("variant",), _numbers(reference), unit, "intensity of the hazard level")
    if study.life_cycle is not None:
        _add_hazard_curve(group, project, study, used)
        group.attributes["life_cycle"] = {
            "years": study.life_cycle.years / YEAR,
            "dispersion": study.life_cycle.dispersion,
            "losses": dict(study.life_cycle.losses),
            "discount": study.life_cycle.discount,
        }
    limits = {name: [limit.measure, limit.value] for name, limit in study.limits.items()}
    group.attributes |= {
        "name": study.name,
        "intensity_measure": study.intensity,
        "intensity_unit": unit,
        "level": study.level,
        "collapse_drift": study.collapse_drift,
        "limits": limits,
    }
    return group


def _add_hazard_curve(group: Group, project: AnalysisFile, study: Incremental, periods: Sequence[float | None]) -> None:
    """Add the points of the hazard curve: the rate of each, and its intensity for each variant."""
    assert study.life_cycle is not None
    curve = study.life_cycle.hazard_curve
    if isinstance(curve, CurveOfLevels):
        levels = sorted(curve.levels, key=lambda name: curve.levels[name])
        years = [curve.levels[name] / YEAR for name in levels]
        points = [_numbers([level_intensity(project, study, period, level) for level in levels]) for period in periods]
    else:
        years = [period / YEAR for period in curve.return_periods]
        points = [np.array(curve.intensities) for _ in periods]
    coordinate(group, "hazard_return_period", years, "year", "return period of a point of the hazard curve")
    unit = "1" if isinstance(study, LevelFactorStudy) else "m/s^2"
    label = "intensity that is exceeded once in the return period"
    group.add("hazard_intensity", ("variant", "hazard_return_period"), np.array(points), unit, label)


class _Periods:
    """T1 of the variants, each computed when it is first asked for: that at the design strain of their dampers."""

    def __init__(self, study: Study, frames: Prepared) -> None:
        self._study = study
        self._frames = frames
        self._found: dict[str, float | EdesignError] = {}

    def __call__(self, incremental: Incremental, task: Task, needed: bool = False) -> float | None:
        """T1 of the variant of a task; None where the study gives the period or has none.

        Raises:
            EdesignError: it is needed, and there is none.
        """
        if not isinstance(incremental, SpectralAccelerationStudy) or incremental.period is not None:
            return None
        if task.variant not in self._found:
            self._found[task.variant] = self._compute(task)
        found = self._found[task.variant]
        if isinstance(found, float):
            return found
        if needed:
            raise found
        return None

    def _compute(self, task: Task) -> float | EdesignError:
        variant = self._study.variants[task.variant]
        strain = variant_strain(self._study, task.variant)
        try:
            return intensity_period(self._frames(task)[0], variant.dampers != "none", strain)
        except EdesignError as error:
            return error


def _numbers(values: Sequence[float | None]) -> np.ndarray:
    return np.array([np.nan if value is None else value for value in values])
