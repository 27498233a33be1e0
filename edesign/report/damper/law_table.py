"""Damper laws as tables: all of them, or the parameters of one."""

from __future__ import annotations

from edesign.damper.law import Law, Parameter
from edesign.damper.laws import LAWS
from edesign.damper.parameters import PARAMETER_SETS, practical_unit
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE


def _names(law: Law) -> list[str]:
    names = [parameter.name for parameter in law.with_branches(1 if law.branch else 0)]
    return [*names, "..."] if law.branch else names


LAWS_KNOWN = TableSpec[Law](
    "laws",
    "{count} damper laws",
    (text("law", "name"), text("what", "title"), text("parameters", lambda law: ", ".join(_names(law)))),
    notes=("`edesign laws NAME` prints units, bounds, defaults, equation and source.",),
    keys=3,
    named_by_title=True,
)
PARAMETERS = TableSpec[Parameter](
    "parameters_of_law",
    "{law}: {title}",
    (
        text("parameter", "name"),
        text("unit", lambda parameter: practical_unit(parameter) or None),
        text("allowed"),
        col("default", ONE, form="g"),
        text("meaning"),
    ),
    keys=5,
    named_by_title=True,
)


def laws_table() -> Table:
    """Return a table of all laws: name, title, names of the parameters."""
    return LAWS_KNOWN.of(LAWS.values(), count=len(LAWS))


def law_table(law: Law) -> Table:
    """Return the parameters of a law with unit, bounds, default and meaning; equation and source stand below."""
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
    parameters = law.with_branches(1 if law.branch else 0)
    return PARAMETERS.of(parameters, notes=notes, law=law.name, title=law.title)
