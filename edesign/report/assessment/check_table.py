"""Every check of a study in one table: clause or source, demand, capacity, ratio, verdict, and what governs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from edesign.assess.verdicts import Verdict
from edesign.project.criteria.criteria import Criterion
from edesign.report.assessment.verdict_tables import answer, measured
from edesign.report.drawing.captions import record_label
from edesign.report.tables.cell import Marked, Value
from edesign.report.tables.column import col, text, verdict
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE


class _Check(NamedTuple):
    """A verdict with the source of its limit."""

    found: Verdict
    source: str

    @property
    def demand(self) -> Value:
        """The value with the statistic that it is."""
        value = measured(self.found.value, self.found.unit)
        if value is None or (self.found.count == 1 and not self.found.missing):
            return value
        return Marked(value, f" ({self.found.statistic} of {min(self.found.count, self.found.number)})")

    @property
    def governs(self) -> str | None:
        """The place and the motion of the value."""
        if self.found.negligible:
            return None
        name = self.found.governing_history
        motion = name.partition(f".{self.found.level}.")[2] if self.found.level else ""
        parts = [self.found.place, record_label(motion) if motion else name]
        return ", ".join(part for part in parts if part) or None


CHECKS = TableSpec[_Check](
    "checks_of_criteria",
    "Checks",
    (
        text("check", "found.name"),
        text("requirement", "found.requirement", broken=1),
        text("source", lambda check: check.source or None, broken=3),
        text("variant", lambda check: check.found.variant or None),
        text("level", lambda check: check.found.level or None),
        text("demand"),
        text("capacity", lambda check: measured(check.found.limit, check.found.unit)),
        col("D/C", ONE, "found.ratio", form=".2f"),
        verdict("verdict", lambda check: answer(check.found)),
        text("governs", broken=2),
    ),
    notes=(
        "D/C is demand over capacity, met up to 1. Of a lower bound it is the inverse, so that 1 is the limit too.",
        "Governs: place and motion of the largest value of a history, of a lower bound the smallest.",
    ),
    keys=5,
    named_as="checks",
)
UNKNOWN = "Source -: the study does not say where the limit comes from (`source` of a criterion)."


def check_table(verdicts: Sequence[Verdict], criteria: Sequence[Criterion]) -> Table:
    """Return a row for each criterion, variant and level.

    Args:
        verdicts: of `judge` on the criteria.
        criteria: of the study.
    """
    sources = {criterion.name: source_of(criterion) for criterion in criteria}
    checks = [_Check(found, sources.get(found.name, found.source)) for found in verdicts]
    return CHECKS.of(checks, notes=() if all(check.source for check in checks) else (UNKNOWN,))


def source_of(criterion: Criterion) -> str:
    """Return where the limit of a criterion comes from, "" if that is not said."""
    return criterion.traits.standard if criterion.source is None else criterion.source
