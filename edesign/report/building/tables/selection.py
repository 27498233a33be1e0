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
    alike = "" if selection.free is None else ", nor one of two of those that the wishes bind together,"
    certificate = (
        f"certificate: no single and no double exchange of sections{alike} is {less} and meets all checks"
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
        *_work(selection),
        *_wishes(selection),
        f"{selection.evaluations} designs were analysed; {starts} met all checks",
        certificate,
        *not_met,
    ]


def _work(selection: Selection) -> list[str]:
    """Splices and doublers, and what they cost where they have a price."""
    each = design_of(selection.building).select.prices_each
    counted = (
        (selection.splices, "where the section of a column changes", "splices", each.splice),
        (selection.doublers, "of web panels", "doublers", each.doubler),
    )
    return [
        f"{name} {where}: {number}" + (f", {significant(number * price)} of the price" if price is not None else "")
        for number, where, name, price in counted
        if number or price is not None
    ]


def _wishes(selection: Selection) -> list[str]:
    """What the wishes cost beside the choice without them."""
    free, select = selection.free, design_of(selection.building).select
    if free is None:
        return []
    asked = [f"one nominal depth of {kind} in a line" for kind in select.same_depth]
    asked += [
        f"at most {most} section{'s' if most > 1 else ''} of {'all members' if kind == 'all' else kind}"
        for kind, most in select.most_sections.items()
    ]
    if not free.best.met:
        return [f"wishes: {', '.join(asked)}; without them no choice was found that meets all checks"]
    if selection.cost < free.best.cost * (1.0 - 1e-12):  # what is allowed with them is allowed without
        return [f"wishes: {', '.join(asked)}; they cost nothing: without them nothing better was found"]
    more = [f"{significant((selection.mass - free.best.mass) / 1e3)} t of steel"]
    if select.objective == "cost":
        more.append(f"{significant(selection.cost - free.best.cost)} of the price")
    share = 100.0 * (selection.cost / free.best.cost - 1.0)
    return [f"wishes: {', '.join(asked)}; they cost {' and '.join(more)}, {significant(share)} %"]
