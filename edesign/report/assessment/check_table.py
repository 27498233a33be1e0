"""Every check of a study in one table: clause or source, demand, capacity, ratio, verdict, and what governs."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.assess.criteria import Verdict
from edesign.project.criteria.criteria import Criterion, PerformanceCriterion
from edesign.report.assessment.verdict_tables import measured
from edesign.report.drawing.captions import record_label
from edesign.report.tables.table import Table, formatted, said_of

FEMA = {"drift": "FEMA 356, Table C1-3", "members": "FEMA 356, Table 5-6", "both": "FEMA 356, Tables C1-3 and 5-6"}


def check_table(verdicts: Sequence[Verdict], criteria: Sequence[Criterion]) -> Table:
    """Return a row for each criterion, variant and level.

    Args:
        verdicts: of `judge` on the criteria.
        criteria: of the study.
    """
    sources = {criterion.name: source_of(criterion) for criterion in criteria}
    columns = ("check", "requirement", "source", "variant", "level", "demand", "capacity", "D/C", "verdict", "governs")
    table = Table("Checks", columns, left=5, sentences=(1, 9, 2), name="checks")
    for verdict in verdicts:
        cells = [verdict.name, verdict.requirement, sources.get(verdict.name, "") or "-"]
        cells += [verdict.variant or "-", verdict.level or "-", _demand(verdict)]
        ratio = "-" if verdict.ratio is None else formatted(verdict.ratio, ".2f")
        cells += [measured(verdict.limit, verdict.unit), ratio, verdict.answer, _governs(verdict)]
        table.rows.append(cells)
    if table.rows:
        table.notes.append(
            "D/C is demand over capacity, met up to 1. Of a lower bound it is the inverse, so that 1 is the limit too."
        )
        table.notes.append(
            "Governs: place and motion of the largest value of a history, of a lower bound the smallest."
        )
        if "-" in {row[2] for row in table.rows}:
            table.notes.append("Source -: the study does not say where the limit comes from (`source` of a criterion).")
    return table


def source_of(criterion: Criterion) -> str:
    """Return where the limit of a criterion comes from, "" if that is not said."""
    if criterion.source is not None:
        return criterion.source
    if isinstance(criterion, PerformanceCriterion):
        return FEMA[criterion.by]
    return ""


def _demand(verdict: Verdict) -> str:
    """The value with the statistic that it is."""
    if verdict.value is None:
        return "-"
    value = measured(verdict.value, verdict.unit)
    if verdict.count == 1 and not verdict.missing:
        return value
    return said_of(value, f" ({verdict.statistic} of {verdict.count})")


def _governs(verdict: Verdict) -> str:
    if verdict.negligible:
        return "-"
    name = verdict.governing_history
    motion = name.partition(f".{verdict.level}.")[2] if verdict.level else ""
    parts = [verdict.place, record_label(motion) if motion else name]
    return ", ".join(part for part in parts if part) or "-"
