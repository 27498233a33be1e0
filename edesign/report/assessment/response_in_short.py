"""The response of all variants at all levels in one table that fits lines of 80 characters."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.assess.sets import HistorySet, measure_statistics
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import label, missing_notes, motion_notes
from edesign.report.tables.column import Column, col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, M_S2, MM, MRAD, ONE, PERCENT, Unit


def _name(found: HistorySet) -> str:
    """The variant and level; of one history of no variant its name."""
    return label(found) if found.variant or len(found.histories) > 1 else next(iter(found.histories))


def _mean(header: str, unit: Unit, *measures: str) -> Column[HistorySet]:
    """A column of the largest mean of some measures; it is left out where no set has one of them."""

    def of(found: HistorySet) -> float | None:
        statistics = measure_statistics(found)
        return max((mean for one in measures if (mean := statistics[one].mean) is not None), default=None)

    return col(header, unit, of, 3, negligible=ROUNDING, bare=True, optional=True)


RESPONSE = TableSpec[HistorySet](
    "response_in_short",
    "{title}",
    (
        text("histories", _name),
        count("n", lambda found: len({found.motion_of[name] for name in found.completed})),
        _mean("drift", PERCENT, "interstorey_drift"),
        _mean("residual", PERCENT, "residual_interstorey_drift"),
        _mean("V", KN, "base_shear_N"),
        _mean("a", M_S2, "roof_acceleration_m_s2"),
        _mean("rot.", MRAD, "beam_plastic_rotation_rad", "column_plastic_rotation_rad"),
        _mean("ductility", ONE, "brace_ductility"),
        _mean("damper", MM, "damper_deformation_m"),
    ),
    most=12,
    cut="and {more} more, among all tables",
    named_by_title=True,
)
MEANINGS = {"V": "base shear", "a": "roof", "rot.": "plastic rotation", "ductility": "of a brace"}
"""Of headers."""


def response_in_short(sets: Sequence[HistorySet]) -> Table:
    """Return the means of the main measures, a row for each variant and level.

    Args:
        sets: of histories; those without a completed one are listed below the table.
    """
    shown = [found for found in sets if found.completed]
    several = any(len(found.completed) > 1 for found in shown)
    title = "Mean response of the records" if several else "Response"
    table = RESPONSE.of(shown, title=title, without=() if several else ("n",))
    meanings = [f"{one.header}: {MEANINGS[one.header]}" for one in table.columns if one.header in MEANINGS]
    if meanings:
        table.notes.append(f"Largest values; {', '.join(meanings)}{', n: records' * several}")
    table.notes += [*motion_notes(shown), *missing_notes(sets)]
    return table
