"""Cross checks of an incremental study: names that exist, intensities that ascend."""

from __future__ import annotations

from collections.abc import Collection

from edesign.project.actions.hazard import UserHazard
from edesign.project.actions.hazard_base import YEAR
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.analyses import check_drift
from edesign.project.checks.matching import check_fitted_levels
from edesign.project.checks.names import ALL, check_names, check_records
from edesign.project.checks.shaking import check_shaking
from edesign.project.checks.vertical_motion import check_horizontal
from edesign.project.checks.wave_passage import check_wave_passage
from edesign.project.reading.problems import Keys, Problems, unknown_name
from edesign.project.records.records import record_of
from edesign.project.study.incremental import COLLAPSE, Incremental, LevelFactorStudy
from edesign.project.study.life_cycle import CurveOfLevels, LifeCycle


def check_incremental(
    keys: Keys, incremental: Incremental, base: AnalysisFile, variants: Collection[str], problems: Problems
) -> None:
    """Check an incremental study against its project; it has no schema problems.

    Args:
        keys: where it stands in the study file.
        base: the project that is studied.
        problems: receives what is wrong.
    """
    if incremental.variants != (ALL,):
        check_names(problems, (*keys, "variants"), "variant", incremental.variants, variants)
    check_records(problems, (*keys, "records"), incremental.records, base)
    check_horizontal(base, problems, (*keys, "records"), incremental.records)
    check_shaking(base, problems, keys, incremental)
    if incremental.level is not None and incremental.level not in base.hazard_levels:
        problems.at_value((*keys, "level"), unknown_name("level", incremental.level, base.hazard_levels))
    if isinstance(base.hazard, UserHazard) and incremental.level is not None and not base.hazard.at_5_percent:
        message = (
            "intensities are of 5 % damping, and the tables of the hazard of another; leave this key out, or give "
            "`hazard.damping_correction` [E-KEY-03]"
        )
        problems.at_key((*keys, "level"), message)
    if isinstance(incremental, LevelFactorStudy):
        fitted = [name for name in map(record_of, incremental.records) if name in base.records]
        check_fitted_levels((*keys, "level"), fitted, (incremental.level,), base, problems)
        for i, name in enumerate(map(record_of, incremental.records)):
            if name in base.records and not base.records[name].fitted:
                message = (
                    f"`{name}` is not fitted to the spectrum of the hazard, so that it has no level to be scaled from"
                    " [E-SCALE-03]"
                )
                problems.at_item((*keys, "records"), i, message)
    check_drift(base, problems, (*keys, "collapse_drift"), incremental.collapse_drift)
    check_wave_passage(base, problems, (*keys, "wave_passage"), incremental.wave_passage)
    values = incremental.intensities
    if any(later <= earlier for earlier, later in zip(values, values[1:], strict=False)):
        problems.at_value(
            (*keys, "levels"), "intensities must ascend: each greater than the one before it [E-VALUE-04]"
        )
    if COLLAPSE in incremental.limits:
        problems.at_key(
            (*keys, "limits", COLLAPSE),
            f"`{COLLAPSE}` is there without being asked for; choose another name [E-NAME-03]",
        )
    if incremental.life_cycle is not None:
        _life_cycle((*keys, "life_cycle"), incremental, incremental.life_cycle, base, problems)


def _life_cycle(keys: Keys, incremental: Incremental, spec: LifeCycle, base: AnalysisFile, problems: Problems) -> None:
    """Check that the hazard curve rises and that losses are of limits."""
    curve, at = spec.hazard_curve, (*keys, "hazard_curve")
    if isinstance(curve, CurveOfLevels):
        if isinstance(incremental, LevelFactorStudy) and base.hazard is not None and base.hazard.own_shapes:
            message = (
                "the levels of this hazard have spectra of their own shape; no factor leads from one to another"
                " [E-HAZ-04]"
            )
            problems.at_key((*at, "levels"), message)
        for name, period in curve.levels.items():
            if name not in base.hazard_levels:
                problems.at_key((*at, "levels", name), unknown_name("level", name, base.hazard_levels))
            _return_period((*at, "levels", name), period, problems)
        names = list(curve.levels)
        for i, name in enumerate(names):
            twin = next((other for other in names[:i] if curve.levels[other] == curve.levels[name]), None)
            if twin is not None:
                message = (
                    f"{curve.levels[name] / YEAR:g} years are the return period of `{twin}` too; each has its own"
                    " [E-NAME-02]"
                )
                problems.at_value((*at, "levels", name), message)
    else:
        if isinstance(incremental, LevelFactorStudy):
            message = "intensities are factors of a level here; give the return periods of `levels` [E-HAZ-04]"
            problems.at_key((*at, "intensities"), message)
        if len(curve.intensities) != len(curve.return_periods):
            message = (
                f"{len(curve.return_periods)} return periods for {len(curve.intensities)} intensities [E-VALUE-04]"
            )
            problems.at_value((*at, "return_periods"), message)
        for i, period in enumerate(curve.return_periods):
            _return_period((*at, "return_periods", i), period, problems)
        for key, values in (("intensities", curve.intensities), ("return_periods", curve.return_periods)):
            if any(later <= earlier for earlier, later in zip(values, values[1:], strict=False)):
                problems.at_value((*at, key), "they must ascend: each greater than the one before it [E-VALUE-04]")
    limits = (*incremental.limits, COLLAPSE)
    for name in spec.losses:
        if name not in limits:
            problems.at_key((*keys, "losses", name), unknown_name("limit", name, limits))
    _return_period((*keys, "years"), spec.years, problems)


def _return_period(keys: Keys, seconds: float, problems: Problems) -> None:
    if seconds < YEAR * (1.0 - 1e-9):
        problems.at_value(keys, "this is shorter than a year; years are written like `475 years` [E-VALUE-02]")
