"""All verdicts of a study in two tables that fit lines of 80 characters: variants side by side, and what governs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from edesign.assess.judged_designs import OF_DESIGN
from edesign.assess.requirement import DEMAND_OVER_CAPACITY
from edesign.assess.verdicts import Verdict
from edesign.project.actions.hazard_base import Hazard
from edesign.report.assessment.verdict_tables import RATIO, answer, few_notes, measured, motion_of
from edesign.report.tables import cell
from edesign.report.tables.cell import Value
from edesign.report.tables.column import Column, literal, text, verdict
from edesign.report.tables.table import Table, TableSpec

ROOM = 13
"""Lines of a screen for criteria; each variant takes two of them, for what governs it and for its members."""
FEWEST = 5
"""Criteria that stand there with any number of variants."""
Row = tuple[str, str]
"""A criterion and a level."""
Grouped = dict[Row, dict[str, Verdict]]
"""Verdicts by criterion and level, then by variant."""


def _row_name(name: str, level: str) -> str:
    return f"{name}, {level}" if level and level not in name else name


def _value(found: Verdict) -> Value:
    return RATIO.of(found) if found.unit == DEMAND_OVER_CAPACITY else measured(found.value, found.unit)


def _where(found: Verdict) -> str | None:
    return None if found.negligible else " ".join(filter(None, (found.place, motion_of(found)))) or None


VERDICTS = TableSpec[Row](
    "verdicts_in_short",
    "Verdicts, demand over capacity",
    (text("criterion", lambda row: _row_name(*row), broken=1),),  # and each variant
    named_by_title=True,
)
GOVERNING = TableSpec[Verdict](
    "governing_in_short",
    "What governs",
    (
        text("variant", lambda found: found.variant or "structure"),
        text("criterion", lambda found: _row_name(found.name, found.level), broken=1),
        replace(RATIO, header="value", value=_value),
        text("where", _where, broken=2),
    ),
    keys=2,
    named_by_title=True,
)


def verdicts_in_short(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[Table]:
    """Return the answers with demand over capacity, a row for each criterion and level, and what governs.

    Of many criteria those that all variants meet are left out, the least used first.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code says what few histories are worth.
    """
    variants = list(dict.fromkeys(one.variant for one in verdicts))
    grouped: Grouped = {}
    for one in verdicts:
        grouped.setdefault((one.name, one.level), {})[one.variant] = one
    kept, left_out = _kept(grouped, max(FEWEST, ROOM - 2 * len(variants)))
    left = [f"and {left_out} more, which all variants meet, among all tables"] * bool(left_out)
    notes = [*left, *_counts(verdicts), *few_notes(verdicts, hazard)]
    table = VERDICTS.of(kept, more=[_answers(grouped, variant) for variant in variants], notes=notes)
    governing = GOVERNING.of(_worst(verdicts, variants))
    return [table, governing] if governing.rows else [table]


def _answers(grouped: Grouped, variant: str) -> Column[Row]:
    def of(row: Row) -> cell.Verdict | None:
        found = grouped[row].get(variant)
        if found is None or not found.applies:
            return None
        return answer(found, "" if found.ratio is None else RATIO.text(RATIO.of(found)))

    return verdict(literal(variant or "structure"), of)


def _kept(grouped: Grouped, most: int) -> tuple[list[Row], int]:
    """The rows that are shown, and how many are not."""
    spare = [key for key, of in grouped.items() if all(v.answer in ("met", "does not apply") for v in of.values())]
    spare.sort(key=lambda key: max((one.ratio or 0.0 for one in grouped[key].values()), default=0.0))
    gone = set(spare[: max(0, len(grouped) - most)])
    return [key for key in grouped if key not in gone], len(gone)


def _worst(verdicts: Sequence[Verdict], variants: Sequence[str]) -> Iterator[Verdict]:
    """For each variant the criterion with the largest demand over capacity in histories; nothing where none has one."""
    for variant in variants:
        own = [one for one in verdicts if one.variant == variant and one.applies and one.ratio is not None]
        own = [one for one in own if one.statistic != OF_DESIGN]
        if own:
            yield max(own, key=lambda one: one.ratio or 0.0)


def _counts(verdicts: Sequence[Verdict]) -> list[str]:
    """How many of the criteria that apply each variant meets; where one is open, how many are."""
    lines = []
    for variant in dict.fromkeys(one.variant for one in verdicts):
        answers = [one.answer for one in verdicts if one.variant == variant and one.applies]
        if answers:
            still = f", {answers.count('open')} open" if "open" in answers else ""
            lines.append(f"{variant or 'The structure'}: {answers.count('met')} of {len(answers)} met{still}")
    return ["; ".join(lines) + "."] if lines else []
