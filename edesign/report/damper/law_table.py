"""Damper laws as tables: all of them, or the parameters of one."""

from __future__ import annotations

from edesign.damper.law import Law
from edesign.damper.laws import LAWS
from edesign.damper.parameters import PARAMETER_SETS, practical_unit
from edesign.report.tables.table import Table, formatted


def laws_table() -> Table:
    """Return a table of all laws: name, title, names of the parameters."""
    rows = [[law.name, law.title, ", ".join(_names(law))] for law in LAWS.values()]
    note = "`edesign laws NAME` tells units, bounds, defaults, equation and source."
    return Table(f"{len(rows)} damper laws", ["law", "what", "parameters"], rows, [note], left=3)


def law_table(law: Law) -> Table:
    """Return the parameters of a law with unit, bounds, default and meaning; equation and source stand below."""
    rows = [
        [
            parameter.name,
            practical_unit(parameter) or "-",
            parameter.allowed,
            "-" if parameter.default is None else formatted(parameter.default, "g"),
            parameter.meaning,
        ]
        for parameter in law.with_branches(1 if law.branch else 0)
    ]
    notes = [f"equation: {law.equation}", f"source: {law.source}"]
    if law.branch:
        names = ", ".join(f"{parameter.name}2" for parameter in law.branch)
        notes.insert(0, f"further branches: {names} ..., {law.most_branches} branches at most")
    speed = "depends on the speed of the deformation" if law.rate_dependent else "does not depend on the speed"
    notes.append(f"the force {speed}; u deformation, v = u' velocity, F force")
    sets = [
        f"{item.name} ({item.source}, {item.temperature})" for item in PARAMETER_SETS.values() if item.law == law.name
    ]
    if sets:
        notes.append(f"parameter sets: {', '.join(sets)}")
    return Table(
        f"{law.name}: {law.title}", ["parameter", "unit", "allowed", "default", "meaning"], rows, notes, left=5
    )


def _names(law: Law) -> list[str]:
    names = [parameter.name for parameter in law.with_branches(1 if law.branch else 0)]
    return [*names, "..."] if law.branch else names
