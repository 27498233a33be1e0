"""All verdicts of a study in two tables that fit lines of 80 characters: variants side by side, and what governs."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.assess.criteria import Verdict
from edesign.assess.requirement import DEMAND_OVER_CAPACITY
from edesign.project.actions.hazard_base import Hazard
from edesign.report.assessment.verdict_tables import few_notes, measured, motion_of, ratio_text
from edesign.report.tables.table import Table

MOST_ROWS = 14


def verdicts_in_short(verdicts: Sequence[Verdict], hazard: Hazard | None) -> list[Table]:
    """Return the answers with demand over capacity, a row for each criterion and level, and what governs.

    Of many criteria those that all variants meet are left out, the least used first.

    Args:
        verdicts: of the study.
        hazard: of the project, whose code says what few histories are worth.
    """
    variants = list(dict.fromkeys(verdict.variant for verdict in verdicts))
    grouped: dict[tuple[str, str], dict[str, Verdict]] = {}
    for verdict in verdicts:
        grouped.setdefault((verdict.name, verdict.level), {})[verdict.variant] = verdict
    kept, left_out = _kept(grouped)
    table = Table("Verdicts, demand over capacity", ("criterion", *(variant or "frame" for variant in variants)))
    table.sentences = 0
    for name, level in kept:
        cells = [_answer(grouped[name, level].get(variant)) for variant in variants]
        table.rows.append([_row_name(name, level), *cells])
    table.notes += [f"and {left_out} more, which all variants meet"] * bool(left_out)
    table.notes += [*_counts(verdicts), *few_notes(verdicts, hazard)]
    return [table, *_governing(verdicts, variants)]


def _kept(grouped: dict[tuple[str, str], dict[str, Verdict]]) -> tuple[list[tuple[str, str]], int]:
    """The rows that are shown, and how many are not."""
    spare = [key for key, of in grouped.items() if all(v.answer in ("met", "does not apply") for v in of.values())]
    spare.sort(key=lambda key: max((verdict.ratio or 0.0 for verdict in grouped[key].values()), default=0.0))
    gone = set(spare[: max(0, len(grouped) - MOST_ROWS)])
    return [key for key in grouped if key not in gone], len(gone)


def _row_name(name: str, level: str) -> str:
    return f"{name}, {level}" if level and level not in name else name


def _answer(verdict: Verdict | None) -> str:
    if verdict is None or not verdict.applies:
        return "-"
    ratio = ratio_text(verdict)
    return verdict.answer if ratio == "-" else f"{verdict.answer} {ratio}"


def _governing(verdicts: Sequence[Verdict], variants: Sequence[str]) -> list[Table]:
    """For each variant the criterion with the largest demand over capacity; nothing where none has a value."""
    table = Table("What governs", ("variant", "criterion", "value", "where"), left=2, sentences=(1, 3))
    for variant in variants:
        own = [one for one in verdicts if one.variant == variant and one.applies and one.ratio is not None]
        if not own:
            continue
        worst = max(own, key=lambda one: one.ratio or 0.0)
        value = ratio_text(worst) if worst.unit == DEMAND_OVER_CAPACITY else measured(worst.value, worst.unit)
        where = "" if worst.negligible else " ".join(filter(None, (worst.place, motion_of(worst))))
        table.rows.append([variant or "frame", _row_name(worst.name, worst.level), value, where or "-"])
    return [table] if table.rows else []


def _counts(verdicts: Sequence[Verdict]) -> list[str]:
    """How many of the criteria that apply each variant meets; where one is open, how many are."""
    lines = []
    for variant in dict.fromkeys(verdict.variant for verdict in verdicts):
        answers = [verdict.answer for verdict in verdicts if verdict.variant == variant and verdict.applies]
        if answers:
            still = f", {answers.count('open')} open" if "open" in answers else ""
            lines.append(f"{variant or 'The frame'}: {answers.count('met')} of {len(answers)} met{still}")
    return ["; ".join(lines) + "."] if lines else []
