"""Cross checks of an incremental study: names that exist, intensities that ascend."""

from __future__ import annotations

from collections.abc import Collection

from edesign.project.checks_actions import check_drift
from edesign.project.checks_names import ALL, check_names, check_records
from edesign.project.incremental import COLLAPSE, Incremental, LevelFactorStudy
from edesign.project.problems import Keys, Problems, unknown_name
from edesign.project.project import Project
from edesign.project.records import record_of


def check_incremental(
    keys: Keys, incremental: Incremental, base: Project, variants: Collection[str], problems: Problems
) -> None:
    """Check an incremental study against its project; it has no schema problems.

    Args:
        keys: where it stands in the study file.
        incremental: the study.
        base: the project that is studied.
        variants: names of the variants of the study file.
        problems: receives what is wrong.
    """
    if incremental.variants != (ALL,):
        check_names(problems, (*keys, "variants"), "variant", incremental.variants, variants)
    check_records(problems, (*keys, "records"), incremental.records, base)
    if incremental.level is not None and incremental.level not in base.hazard_levels:
        problems.at_value((*keys, "level"), unknown_name("level", incremental.level, base.hazard_levels))
    if isinstance(incremental, LevelFactorStudy):
        for i, name in enumerate(map(record_of, incremental.records)):
            if name in base.records and base.records[name].match is None:
                message = (
                    f"`{name}` is not fitted to the spectrum of the hazard, so that it has no level to be scaled from"
                )
                problems.at_item((*keys, "records"), i, message)
    check_drift(base, problems, (*keys, "collapse_drift"), incremental.collapse_drift)
    values = incremental.intensities
    if any(later <= earlier for earlier, later in zip(values, values[1:], strict=False)):
        problems.at_value((*keys, "levels"), "intensities must ascend: each greater than the one before it")
    if COLLAPSE in incremental.limits:
        problems.at_key(
            (*keys, "limits", COLLAPSE), f"`{COLLAPSE}` is there without being asked for; choose another name"
        )
