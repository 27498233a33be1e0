"""Whether the spectra of the user reach the periods at which a run takes them, reported before the first analysis.

Spectra of codes reach any period. Designs are left out: the period that theirs is taken at follows from the design.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.analysis.analyses import PlannedAnalysis, PushoverAnalysis
from edesign.project.analysis.pushover import GivenPattern, Pushover
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import Keys, keys_text
from edesign.project.study.incremental import SpectralAccelerationStudy
from edesign.project.study.life_cycle import CurveOfLevels
from edesign.project.study.study import Study
from edesign.study.analysis.intensity import intensity_period
from edesign.study.analysis.modal import fundamental_period
from edesign.study.plan.variants import variant_project


def check_project_reach(project: AnalysisFile, specs: Iterable[PlannedAnalysis]) -> None:
    """Check that the spectrum reaches T1 where a pushover combines modes by it.

    Args:
        specs: the analyses that will run.

    Raises:
        InputError: it does not; the message names the analysis.
        AnalysisError: T1 cannot be found.
    """
    parts = [spec for spec in specs if isinstance(spec, PushoverAnalysis)]
    for i, spec in enumerate(project.analyses):
        if isinstance(spec, PushoverAnalysis) and any(part.name.split(".")[0] == spec.name for part in parts):
            check_pushover_reach(project, spec, project.where("analyses", i, "pattern"), ("analyses", i, "pattern"))


def check_pushover_reach(project: AnalysisFile, spec: Pushover, where: str, keys: Keys) -> None:
    """Check that the spectrum reaches T1 where a pushover combines modes; errors as `check_project_reach`.

    Args:
        where: place of the pattern in the file, for messages.
    """
    if not any(isinstance(pattern, GivenPattern) and pattern.modes is not None for pattern in spec.pattern):
        return
    last = elastic_spectrum(checked_hazard(project)).last_period
    if math.isfinite(last) and (period := max(fundamental_period(project) or (), default=last)) > last:
        raise InputError(f"{where}: {keys_text(keys)}: {_short(last, period)}")


def check_incremental_reach(study: Study) -> None:
    """Check that the spectra of levels reach the period of the spectral acceleration of each variant without a design.

    Raises:
        InputError: one does not; the message names the level.
        AnalysisError: T1 of a variant cannot be found.
    """
    for i, item in enumerate(study.incremental):
        if not isinstance(item, SpectralAccelerationStudy) or study.base.hazard is None:
            continue
        wanted: dict[str, Keys] = {} if item.level is None else {item.level: ("incremental", i, "level")}
        curve = item.life_cycle.hazard_curve if item.life_cycle is not None else None
        if isinstance(curve, CurveOfLevels):
            at: Keys = ("incremental", i, "life_cycle", "hazard_curve", "levels")
            wanted = {name: (*at, name) for name in curve.levels} | wanted
        for level, keys in wanted.items():
            last = elastic_spectrum(study.base.hazard, level).last_period
            for variant, period in _periods(study, item).items() if math.isfinite(last) else ():
                if period > last:
                    text = f"{_short(last, period)} of the variant `{variant}` [E-HAZ-01]"
                    raise InputError(f"{study.where(*keys)}: {keys_text(keys)}: {text}")


def _periods(study: Study, item: SpectralAccelerationStudy) -> dict[str, float]:
    """The period at which each variant takes the spectral acceleration, s, where that is known."""
    names = [name for name in study.variants if item.variants == ("all",) or name in item.variants]
    if item.period is not None:
        return dict.fromkeys(names, item.period)
    return {
        name: intensity_period(variant_project(study, name, {}), study.variants[name].dampers != "none")
        for name in names
        if not study.variants[name].designs and study.base.masses is not None
    }


def _short(last: float, period: float) -> str:
    return f"the spectrum of the hazard ends at {last:g} s, before the period of {period:.4g} s [E-HAZ-01]"
