"""Every check of a study in one table: clause or source, demand, capacity, ratio, verdict, and what governs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from edesign.assess.verdicts import Verdict
from edesign.project.criteria.criteria import Criterion
from edesign.report.assessment.verdict_tables import answer, governs, measured
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


CHECKS = TableSpec[_Check](
    "checks_of_criteria",
    "Checks",
    (
        text("check", "found.name"),
        text("variant", lambda check: check.found.variant or None),
        text("level", lambda check: check.found.level or None),
        verdict("verdict", lambda check: answer(check.found)),
        col("D/C", ONE, "found.ratio", form=".2f"),
        text("demand"),
        text("capacity", lambda check: measured(check.found.limit, check.found.unit)),
        text("governs", lambda check: governs(check.found), broken=2),
        text("requirement", "found.requirement", broken=1),
        text("source", lambda check: check.source or None, broken=3, optional=True),
    ),
    notes=(
        "D/C is demand over capacity, met up to 1. Of a lower bound it is the inverse, so that 1 is the limit too.",
        "Governs: place and motion of the largest value of a history, of a lower bound the smallest.",
    ),
    keys=4,
    named_as="checks",
)
UNKNOWN = "No source: the study does not say where the limit comes from (`source` of a criterion)."


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
