"""The tables of sections that `edesign design` has chosen."""

from __future__ import annotations

from edesign.project.notation.printed_unit import told_apart
from edesign.report.tables.column import col, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, T
from edesign.space.selection.select import GroupChoice, Selection
from edesign.space.structure.design_block import design_of


def _most_used(row: GroupChoice) -> str:
    of = row.governing
    return f"{of.check} of {of.member} in {of.combination}"


SECTIONS = TableSpec[GroupChoice](
    "sections",
    "Sections: before, chosen, and the most used check of each group",
    (
        text("group", "group.name"),
        text("members", lambda row: f"{row.group.kind}s"),
        text("before"),
        text("chosen", "after"),
        col("mass", T),
        col("use", ONE, "governing.utilisation", 3),
        text("most used check", _most_used, broken=1),
    ),
    keys=4,
)
LIMITS = TableSpec[GroupChoice](
    "selection_limits",
    "What holds each group up: what its next lighter section would break",
    (text("group", "group.name"), text("broken", "held_by", broken=1)),
    keys=2,
)
DESIGN = TableSpec[None]("design", "Design", ())


def selection_tables(selection: Selection) -> list[Table]:
    """Return the tables of a selection: groups, the check that governs each, and the design as a whole."""
    governing = [row.governing for row in selection.groups]
    clauses = {of.check: of.clause for of in governing}
    return [
        SECTIONS.of(selection.groups, notes=[f"{name}: {clause}" for name, clause in clauses.items()]),
        LIMITS.of(selection.groups),
        DESIGN.of((), notes=_whole(selection)),
    ]


def _whole(selection: Selection) -> list[str]:
    before, after = (significant(of / 1e3) for of in (selection.mass_before, selection.mass))
    priced = design_of(selection.building).select.objective == "cost"
    less = "cheaper" if priced else "lighter"
    certificate = (
        f"certificate: no single and no double exchange of sections is {less} and meets all checks"
        if selection.certified
        else f"no certificate: the evaluations of design.select were used up; {less} sections may meet all checks"
    )
    price = [f"price, which was to be least: {significant(selection.cost)}"] if priced else []
    not_met = [
        f"not met, and not searched: {rule.text}: "
        f"{', limit '.join(told_apart(rule.value, rule.required, significant))} ({rule.reference}) {rule.detail}"
        for rule in selection.not_met
    ]
    starts = "1 start" if selection.starts == 1 else f"{selection.starts} starts"
    return [
        f"steel: {after} t, with the sections of the file {before} t",
        *price,
        f"{selection.evaluations} designs were analysed; {starts} met all checks",
        certificate,
        *not_met,
    ]
