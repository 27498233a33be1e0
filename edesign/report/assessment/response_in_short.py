"""The response of all variants at all levels in one table that fits lines of 80 characters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.assess.sets import HistorySet, measure_statistics
from edesign.assess.statistics import Statistics
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import label, missing_notes
from edesign.report.tables.table import Table, number, whole

COLUMNS = (  # header, measures of which the largest counts, unit of the header in SI, what it is
    ("drift %", ("interstorey_drift",), 0.01, ""),
    ("residual %", ("residual_interstorey_drift",), 0.01, ""),
    ("V kN", ("base_shear_N",), 1e3, "V: base shear"),
    ("a m/s2", ("roof_acceleration_m_s2",), 1.0, "a: roof"),
    ("rot. mrad", ("beam_plastic_rotation_rad", "column_plastic_rotation_rad"), 1e-3, "rot.: plastic rotation"),
    ("ductility", ("brace_ductility",), 1.0, "ductility: of a brace"),
    ("damper mm", ("damper_deformation_m",), 1e-3, ""),
)
MOST_ROWS = 12


def response_in_short(sets: Sequence[HistorySet]) -> Table:
    """Return the means of the main measures, a row for each variant and level.

    Args:
        sets: of histories; those without a completed one are told below the table.
    """
    shown = [found for found in sets if found.completed]
    over = [measure_statistics(found) for found in shown]
    columns = [column for column in COLUMNS if any(_mean(each, column[1]) is not None for each in over)]
    several = any(len(found.completed) > 1 for found in shown)
    title = "Mean response of the records" if several else "Response"
    table = Table(title, ("histories", *(("n",) if several else ()), *(column[0] for column in columns)))
    for found, each in list(zip(shown, over, strict=True))[:MOST_ROWS]:
        counts = [whole(len(found.completed))] if several else []
        cells = [number(_mean(each, measures), 3, unit, ROUNDING) for _, measures, unit, _ in columns]
        table.rows.append([_name(found), *counts, *cells])
    if len(shown) > MOST_ROWS:
        table.notes.append(f"and {len(shown) - MOST_ROWS} more")
    told = [words for *_, words in columns if words]
    if told:
        table.notes.append(f"Largest values; {', '.join(told)}{', n: records' * several}")
    table.notes += missing_notes(sets)
    return table


def _name(found: HistorySet) -> str:
    """The variant and level; of one history of no variant its name."""
    if found.variant or len(found.histories) > 1:
        return label(found)
    return next(iter(found.histories))


def _mean(each: Mapping[str, Statistics], measures: Sequence[str]) -> float | None:
    found = [each[measure].mean for measure in measures]
    return max((value for value in found if value is not None), default=None)
