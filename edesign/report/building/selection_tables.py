"""The tables of sections that `edesign design` has chosen."""

from __future__ import annotations

from edesign.report.tables.table import Table, number
from edesign.space.selection.select import Selection
from edesign.space.structure.design_block import design_of


def selection_tables(selection: Selection) -> list[Table]:
    """Return the tables of a selection: groups, the check that governs each, and the design as a whole."""
    return [_groups(selection), _held(selection), _whole(selection)]


def _groups(selection: Selection) -> Table:
    table = Table(
        "Sections: before, chosen, and the most used check of each group",
        ("group", "members", "before", "chosen", "mass [t]", "use", "most used check"),
        left=4,
        sentences=6,
        name="sections",
    )
    clauses: dict[str, str] = {}
    for row in selection.groups:
        of = row.governing
        table.rows.append(
            [
                row.group.name,
                f"{row.group.kind}s",
                row.before,
                row.after,
                number(row.mass, 4, 1e3),
                number(of.utilisation, 3),
                f"{of.check} of {of.member} in {of.combination}",
            ]
        )
        clauses.setdefault(of.check, of.clause)
    table.notes += [f"{name}: {clause}" for name, clause in clauses.items()]
    return table


def _held(selection: Selection) -> Table:
    table = Table(
        "What holds each group up: what its next lighter section would break",
        ("group", "broken"),
        left=2,
        sentences=1,
        name="selection_limits",
    )
    table.rows += [[row.group.name, row.held_by] for row in selection.groups]
    return table


def _whole(selection: Selection) -> Table:
    before, after = (number(of, 4, 1e3) for of in (selection.mass_before, selection.mass))
    priced = design_of(selection.building).select.objective == "cost"
    less = "cheaper" if priced else "lighter"
    certificate = (
        f"certificate: no single and no double exchange of sections is {less} and meets all checks"
        if selection.certified
        else f"no certificate: the evaluations of design.select were used up; {less} sections may meet all checks"
    )
    table = Table("Design", notes=[f"steel: {after} t, with the sections of the file {before} t"], name="design")
    if priced:
        table.notes.append(f"price, which was to be least: {number(selection.cost, 4)}")
    table.notes.append(f"{selection.evaluations} designs were analysed; {selection.starts} starts met all checks")
    table.notes.append(certificate)
    for rule in selection.not_met:
        value, limit = number(rule.value, 3), number(rule.required, 3)
        table.notes.append(
            f"NOT MET, and not searched: {rule.text}: {value}, limit {limit} ({rule.reference}) {rule.detail}"
        )
    return table
