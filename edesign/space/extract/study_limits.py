"""What the study of an extracted frame is judged by: levels and limits of the code that the building is designed by."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.codes.ec8.verification.drift import drift_limit
from edesign.codes.ntc2018.drift import limit_of_drift, limit_state_of_drift
from edesign.errors import InputError
from edesign.ground_motion.hazard import elastic_spectrum, objective_level
from edesign.project.actions.hazard import EC8Hazard, NtcHazard
from edesign.project.building.building import Building
from edesign.project.building.design import Drift
from edesign.space.structure.design_block import design_of

OBJECTIVES = ("h", "l")
"""The basic safety objective. Source: FEMA 356, Table C1-1 (letters of thesis Table 5.4)."""

_EC8, _NTC, _ASKED = "EN 1998-1, 4.4.3.2", "NTC 2018, 7.3.6.1", "as asked for"


@dataclass(frozen=True)
class StudyLimits:
    """Levels and limits of a study, by the code of the action.

    Attributes:
        level: of the design, whose residual drift is limited; its spectrum gives what the dampers reach.
        drift_level: at which drifts are limited.
        drift: the largest of them, a ratio.
        drift_is: how this limit comes about, in words.
        source: clause of the limit; "" if it was asked for.
        reached: drift at `level`, for the thickness of the layers.
        reached_by: where this drift comes from, in words.
        objectives: letters of FEMA 356 that are judged too.
    """

    level: str
    drift_level: str
    drift: float
    drift_is: str
    source: str
    reached: float
    reached_by: str
    objectives: tuple[str, ...] = ()


def study_hazard(building: Building) -> EC8Hazard | NtcHazard:
    """Return the action of a building that a study takes.

    Raises:
        InputError: the building has no hazard with levels, one of another code, or no masses.
    """
    hazard = building.hazard
    if hazard is None or not hazard.levels:
        raise InputError(f"{building.where('hazard')}: a study needs a `hazard` with `levels` [E-KEY-02]")
    if building.masses is None:
        raise InputError(f"{building.where('masses')}: a study needs `masses` [E-KEY-02]")
    if not isinstance(hazard, EC8Hazard | NtcHazard):
        raise InputError(
            f"{building.where('hazard', 'code')}: hazard.code: the study takes the action of `ec8-2004` or `ntc-2018`, "
            f"not of `{hazard.code}` [E-HAZ-03]"
        )
    return hazard


def study_limits(building: Building, drift: float | None = None) -> StudyLimits:
    """Return what a study of a building is judged by.

    Args:
        building: from `load_building`, with a hazard and masses.
        drift: largest storey drift, a ratio; None: that of the building's own limit.

    Raises:
        InputError: as `study_hazard`, or the action lacks a limit state of NTC 2018.
    """
    hazard = study_hazard(building)
    design = None if building.design is None else design_of(building)
    given = Drift() if design is None or design.drift.limit == "none" else design.drift
    if isinstance(hazard, NtcHazard):
        return _by_ntc(building, hazard, given, drift)
    limit, level = drift_limit(given.limit), building.design_level or next(iter(hazard.levels))
    most, why, clause = limit / given.nu, f"{100.0 * limit:g} % / nu = {given.nu:g}", _EC8
    most, why, clause = (most, why, clause) if drift is None else (drift, _ASKED, "")
    with_strain = "with the strain limit it gives the thickness of the layers"
    letters = tuple(letter for letter in OBJECTIVES if objective_level(letter, hazard) is not None)
    return StudyLimits(level, level, most, why, clause, most, with_strain, objectives=letters)


def _by_ntc(building: Building, hazard: NtcHazard, given: Drift, drift: float | None) -> StudyLimits:
    """Drifts of histories under SLD or SLO are compared as they are (7.3.6.1); those under SLV follow from spectra."""
    use = hazard.class_of_use
    state, limit = limit_state_of_drift(use), limit_of_drift(given.limit, use)
    level = building.design_level or _level_of(building, "SLV", "strength and dampers are looked at under it")
    drift_level = _level_of(building, state, f"drifts of class of use {use} are limited under it")
    most, why = (limit, f"class of use {use}, {state}") if drift is None else (drift, f"{_ASKED}, {state}")
    at_level, at_drift = (_velocity_branch(hazard, name) for name in (level, drift_level))
    reached = most * max(1.0, at_level / at_drift)
    return StudyLimits(
        level,
        drift_level,
        most,
        why,
        "" if drift is not None else _NTC,
        reached,
        f"{100.0 * most:g} % times S_De of {level} over {drift_level}",
    )


def _level_of(building: Building, state: str, why: str) -> str:
    level = building.level_of_limit_state(state)
    if level is None:
        raise InputError(
            f"{building.where('hazard', 'levels')}: hazard.levels: a study needs a level with `limit_state: {state}`; "
            f"{why} (NTC 2018, 7.3.6.1) [E-HAZ-06]"
        )
    return level


def _velocity_branch(hazard: NtcHazard, level: str) -> float:
    """Largest displacement over period between T_C and T_D, as a_g S F_0 T_C: its ratio is that of all such periods."""
    spectrum = elastic_spectrum(hazard, level)
    T_C = spectrum.corners["T_C"]
    return float(spectrum.displacement(T_C)) / T_C
