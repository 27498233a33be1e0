"""Tables of a building in the words of the seismic code that it was designed by."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from edesign.codes.building_rules import BuildingRules
from edesign.report.building.results import BuildingResults
from edesign.report.tables.cell import Value
from edesign.report.tables.column import Column
from edesign.report.tables.table import Table
from edesign.space.structure.design_block import rules_by_name


def rules_in_use(results: BuildingResults) -> BuildingRules:
    """Return the rules of the seismic code of a building; archives of earlier versions are of EN 1998-1."""
    return rules_by_name(str(results.group().attributes.get("seismic_code", "ec8-2004")))


def in_code(table: Table, rules: BuildingRules) -> Table:
    """Return a table whose title, headers, notes and texts name the clauses of a code and its symbols.

    Args:
        table: as it is for EN 1998-1.
    """
    if not rules.clauses:
        return table

    def cell(value: Value) -> Value:
        return rules.told(value) if type(value) is str else value

    def column(of: Column[Any]) -> Column[Any]:
        header = rules.told(of.header)
        return of if header == of.header else replace(of, header=header, name=of.name or of.header)

    return replace(
        table,
        title=rules.told(table.title),
        columns=tuple(map(column, table.columns)),
        rows=[list(map(cell, row)) for row in table.rows],
        notes=list(map(rules.told, table.notes)),
    )
