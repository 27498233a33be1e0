"""Tables of the groups of a building's archive that have no table of their own."""

from __future__ import annotations

from edesign.archive.dataset import Variable
from edesign.report.building.results import UNITS, BuildingResults
from edesign.report.tables.table import Table, finite, number
from edesign.space.archived import PLACE, SELECTION

KNOWN = {
    *("combinations", "criteria", "deflections", "floors", "forces", "foundations", "joints", "materials", "members"),
    *("modes", "nodes", "overstrength_x", "overstrength_y", "spectrum", "storeys_x", "storeys_y", SELECTION),
}
"""Groups that the other tables and figures show."""
ROWS = 100
"""Rows of a table."""


def other_tables(results: BuildingResults) -> list[Table]:
    """Return a table of each group that is not in `KNOWN`: its variables along one dimension; the others are named."""
    names = [name for name in results.archive.names(PLACE) if name not in KNOWN]
    return [table for name in names for table in _tables(results, name)]


def _tables(results: BuildingResults, name: str) -> list[Table]:
    group = results.group(name)
    tables = []
    for along, coordinate in group.coords.items():
        columns = {key: variable for key, variable in group.variables.items() if variable.dims == (along,)}
        if not columns:
            continue
        headers = [f"{key} [{_unit(of)[0]}]" if _unit(of)[0] else key for key, of in columns.items()]
        table = Table(f"{name.replace('_', ' ')}, each {along}", (along, *headers))
        cells = [_cells(of) for of in (coordinate, *columns.values())]
        table.rows = [list(row) for row in zip(*cells, strict=True)][:ROWS]
        table.notes = [f"{key}: {of.long_name}" for key, of in columns.items()]
        if coordinate.values.size > ROWS:
            table.notes.append(f"and {coordinate.values.size - ROWS} more, in the archive")
        tables.append(table)
    more = {key: of for key, of in group.variables.items() if len(of.dims) > 1}
    if more:
        notes = [f"{key}, by {', '.join(of.dims)}: {of.long_name}" for key, of in more.items()]
        tables.append(Table(f"{name.replace('_', ' ')}: in the archive", notes=notes))
    return tables


def _unit(variable: Variable) -> tuple[str, float]:
    return UNITS.get(variable.unit, (variable.unit, 1.0))


def _cells(variable: Variable) -> list[str]:
    if variable.values.dtype.kind in "iuU":
        return [str(value) for value in variable.values]
    return [number(finite(float(value)), 4, _unit(variable)[1], negligible=1e-300) for value in variable.values]
