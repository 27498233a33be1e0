"""Intensity measures of incremental studies: of a record, of a hazard level, and the period that they are taken at."""

from __future__ import annotations

import numpy as np

from edesign.codes.motion_sets import DAMPING
from edesign.core import Modes
from edesign.errors import InputError
from edesign.ground_motion.hazard import elastic_spectrum, factor_of_level
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.project.actions.hazard_base import YEAR
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import keys_text
from edesign.project.study.incremental import (
    Incremental,
    LevelFactorStudy,
    PeakAccelerationStudy,
    SpectralAccelerationStudy,
)
from edesign.project.study.life_cycle import CurveOfLevels
from edesign.project.study.study import Study
from edesign.study.analysis.damper_stiffness import damped_modes
from edesign.study.analysis.leading_mode import leading_mode, leading_modes
from edesign.study.analysis.structure import make_structure
from edesign.study.motions.applied import input_motion
from edesign.study.motions.motions import AnyMotion
from edesign.study.motions.pairs import PairMotion

LONGEST = 10.0
"""Up to what period levels are compared where a study leaves it to the frame, s."""


def intensity_text(study: Incremental, intensity: float) -> str:
    """Return an intensity for names and messages: 0.4g, or x1.5 for a factor of the level.

    Args:
        intensity: m/s2, or a factor on the level.
    """
    if isinstance(study, LevelFactorStudy):
        return f"x{intensity:.6g}"
    return f"{intensity / STANDARD_GRAVITY:.6g}g"


def motion_intensity(project: AnalysisFile, study: Incremental, motion: AnyMotion, period: float | None) -> float:
    """Return the intensity measure of a motion as it is applied with the factor 1, m/s2 or a factor.

    That of a pair is the geometric mean of both components as recorded (FEMA P-58-1).

    Args:
        project: the validated project of the variant.
        study: what the study file says.
        motion: made ready, before scaling.
        period: of the spectral acceleration where the study does not give it, s.

    Raises:
        InputError: a period is needed and the frame has none, the project has no hazard with the level, or a record
            is zero throughout.
    """
    if isinstance(study, LevelFactorStudy):
        if project.hazard is None:
            raise InputError(
                f"{project.path}: hazard: this block is missing; `{study.name}` scales records to its levels [E-KEY-02]"
            )
        return 1.0 / factor_of_level(project.hazard, study.level)
    found = []
    for record in motion.records[:2] if isinstance(motion, PairMotion) else (motion.record,):
        if isinstance(study, PeakAccelerationStudy):
            found.append(record.pga)
        else:
            found.append(_spectral_acceleration(project, study, record, period))
        if found[-1] <= 0.0:
            raise InputError(f"{record.name}: the record has no {study.intensity} that could be scaled [E-IDA-01]")
    return float(np.exp(np.mean(np.log(found))))


def level_intensity(project: AnalysisFile, study: Incremental, period: float | None, level: str | None) -> float | None:
    """Return the intensity measure of a hazard level; None without a level.

    Args:
        study: what the study file says.
        period: of the spectral acceleration, s.
    """
    if level is None or project.hazard is None:
        return None
    if isinstance(study, LevelFactorStudy):
        return factor_of_level(project.hazard, level) / factor_of_level(project.hazard, study.level)
    at = 0.0 if isinstance(study, PeakAccelerationStudy) else period
    spectrum = elastic_spectrum(project.hazard, level).with_damping(DAMPING)
    return None if at is None else float(spectrum.acceleration(at))


def check_hazard_curves(study: Study) -> None:
    """Check that rarer levels of a hazard curve have larger intensities.

    Where the period of the spectral acceleration is not known yet, that of variants, they must at some period.

    Args:
        study: the validated study, whose hazard is right.

    Raises:
        InputError: they have not, or a level has no intensity; the message names the place.
    """
    for i, item in enumerate(study.incremental):
        curve = item.life_cycle.hazard_curve if item.life_cycle is not None else None
        if not isinstance(curve, CurveOfLevels):
            continue
        given = item.period if isinstance(item, SpectralAccelerationStudy) else 0.0
        periods = np.linspace(0.0, LONGEST, 401) if given is None else np.array([given])
        names = sorted(curve.levels, key=lambda name: curve.levels[name])
        for before, name in zip(names, names[1:], strict=False):
            keys = ("incremental", i, "life_cycle", "hazard_curve", "levels", name)
            try:
                pair = [_intensities(study.base, item, level, periods) for level in (before, name)]
                reached = np.isfinite(pair[0]) & np.isfinite(pair[1])
                if np.all(pair[1][reached] <= pair[0][reached]):
                    raise InputError(_not_rising(item, curve, before, name, given, pair))
            except InputError as error:
                raise InputError(f"{study.where(*keys)}: {keys_text(keys)}: {error}") from error


def _intensities(project: AnalysisFile, item: Incremental, level: str, periods: np.ndarray) -> np.ndarray:
    """Intensities of a level at periods; nan where there is a choice of periods and the spectrum does not reach."""
    if isinstance(item, LevelFactorStudy):
        return np.array([level_intensity(project, item, None, level)])
    assert project.hazard is not None, "it has the level"
    spectrum = elastic_spectrum(project.hazard, level).with_damping(DAMPING)
    reached = periods if periods.size == 1 else periods[periods <= spectrum.last_period]
    found = np.full(periods.shape, np.nan)
    found[: reached.size] = spectrum.acceleration(reached)
    return found


def _not_rising(
    item: Incremental, curve: CurveOfLevels, before: str, name: str, given: float | None, pair: list[np.ndarray]
) -> str:
    years = {level: f"{curve.levels[level] / YEAR:g} years" for level in (before, name)}
    said = f"`{name}` of {years[name]} is no larger than `{before}` of {years[before]}"
    if given is None:
        said += " at any period"
    else:
        first, second = (float(values[0]) for values in pair)
        shown = [intensity_text(item, value) for value in (second, first)]
        at = f" at {given:g} s" if isinstance(item, SpectralAccelerationStudy) else ""
        said += f"{at} ({shown[0]} and {shown[1]})"
    return f"{said}; the longer a return period, the larger must be the intensity [E-IDA-02]"


def first_periods(project: AnalysisFile, dampers: bool, damper_strain: float | None = None) -> tuple[float, ...]:
    """Return T1 of a variant under gravity with the storage stiffness of its dampers, of a building along x and y, s.

    Args:
        dampers: whether it has its dampers.
        damper_strain: amplitude of their shear strain; None: small vibrations.

    Raises:
        AnalysisError: the frame is unstable, or the period cannot be found.
    """
    structure = make_structure(project, dampers=dampers)
    structure.apply_gravity()
    directions = structure.frame.directions
    if not structure.frame.devices:
        return tuple(leading_mode(structure, direction).period for direction in directions)

    def damped(count: int) -> Modes:
        spec = ModalAnalysis(kind="modal", name="T1", dampers=dampers, modes=count, damper_strain=damper_strain)
        return damped_modes(project.model_copy(update={"analyses": (spec,)}), structure, spec).modes

    if len(directions) == 1:
        return (float(damped(1).period[0]),)
    modes, leading = leading_modes(damped, 1, structure.most_modes, directions)
    return tuple(float(modes.period[first]) for first, *_ in leading)


def intensity_period(project: AnalysisFile, dampers: bool, damper_strain: float | None = None) -> float:
    """Return the period at which a variant takes the spectral acceleration if the study does not say it, s.

    It is T1, of a building the mean of those along x and y (FEMA P-58-1); arguments and errors as `first_periods`.
    """
    return float(np.mean(first_periods(project, dampers, damper_strain)))


def _spectral_acceleration(
    project: AnalysisFile, study: SpectralAccelerationStudy, record: Record, period: float | None
) -> float:
    """Return the pseudo acceleration at 5 % damping of a record as it is applied with the factor 1, m/s2."""
    period = period if study.period is None else study.period
    if period is None:
        raise InputError(
            f"{project.path}: incremental study `{study.name}`: a frame without masses has no period T1 [E-MODAL-02]"
        )
    applied = input_motion(record, 1.0, project.integration.time_step if project.integration else None, 0.0)
    return float(psa(applied.acceleration, applied.time_step, [period], DAMPING)[0])
