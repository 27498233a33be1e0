"""All verdicts of a study in one table that fits lines of 80 characters."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.assess.criteria import Verdict
from edesign.assess.requirement import DEMAND_OVER_CAPACITY, bare
from edesign.report.assessment.verdict_tables import beyond_or, few_notes, motion_of, ratio_text
from edesign.report.tables.table import Table


def verdicts_in_short(verdicts: Sequence[Verdict]) -> Table:
    """Return all verdicts in one table: a heading for each criterion and level, below it a row for each variant.

    It fits lines of 80 characters where names of records have up to 27.
    """
    table = Table("Verdicts", ("variant", "verdict", "value", "D/C", "governs"), left=2, sentences=(0, 4))
    grouped: dict[tuple[str, str, str], list[Verdict]] = {}
    for verdict in verdicts:
        grouped.setdefault((verdict.name, verdict.level, verdict.requirement), []).append(verdict)
    for (name, level, requirement), alike in grouped.items():
        table.headings[len(table.rows)] = f"{name}{f', {level}' if level and level not in name else ''}: {requirement}"
        for verdict in alike:
            value = "-" if verdict.value is None else _bare_value(verdict.value, verdict.unit)
            governs = "" if verdict.negligible else " ".join(filter(None, (verdict.place, motion_of(verdict))))
            cells = [verdict.answer, value, ratio_text(verdict), governs or verdict.remark or "-"]
            table.rows.append([verdict.variant or "frame", *cells])
    table.notes += [
        *_counts(verdicts),
        "Value: in the unit of its limit; D/C: demand over capacity, met up to 1; governs: where it is largest.",
        *few_notes(verdicts),
    ]
    return table


def _bare_value(value: float, unit: str) -> str:
    """A value in the unit that people read, without the unit."""
    text = bare(value, unit, 3)
    return beyond_or(value, text) if unit == DEMAND_OVER_CAPACITY else text


def _counts(verdicts: Sequence[Verdict]) -> list[str]:
    """How many of the criteria that apply each variant meets; where one is open, how many are."""
    lines = []
    for variant in dict.fromkeys(verdict.variant for verdict in verdicts):
        answers = [verdict.answer for verdict in verdicts if verdict.variant == variant and verdict.applies]
        if answers:
            still = f", {answers.count('open')} open" if "open" in answers else ""
            lines.append(f"{variant or 'The frame'}: {answers.count('met')} of {len(answers)} met{still}")
    return ["; ".join(lines) + "."] if lines else []
