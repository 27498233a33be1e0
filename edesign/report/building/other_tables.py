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
_TITLES = {"panels": "Web panels of columns", "sway": "Sway in persistent combinations"}
_HEADS: dict[str, tuple[str, str]] = {
    "node": ("node", ""),
    "axis": ("direction", ""),
    "V_wp_Ed": ("shear", "V_wp,Ed"),
    "V_wp_Rd": ("resistance", "V_wp,Rd"),
    "V_wp_Rd_doubled": ("resistance with a plate", "V_wp,Rd,d"),
    "doubler": ("plate", "t_d"),
    "alpha_cr": ("load factor", "alpha_cr"),
    "alpha_cr_x": ("load factor", "alpha_cr,x"),
    "alpha_cr_y": ("load factor", "alpha_cr,y"),
    "amplification_x": ("factor on sway effects, x", ""),
    "amplification_y": ("factor on sway effects, y", ""),
    "initial_sway_x": ("imperfection", "phi_x"),
    "initial_sway_y": ("imperfection", "phi_y"),
}
"""Words and symbols of the variables of these groups, in the order of their columns; other groups have their names."""
_ALONG = {"persistent": "combination"}
_LENGTH = {"m": ("mm", 1e-3)}  # of plates


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
        named = {key: columns[key] for key in _HEADS if key in columns} if name in _TITLES else {}
        columns = {**named, **{key: of for key, of in columns.items() if key not in named}}
        title = _TITLES.get(name, f"{name.replace('_', ' ')}, each {along}")
        headers = [_header(key, of) if key in named else _with_unit(key, of) for key, of in columns.items()]
        table = Table(title, (_ALONG.get(along, along), *headers), formulas=() if named else None)
        cells = [_cells(of) for of in (coordinate, *columns.values())]
        table.rows = [list(row) for row in zip(*cells, strict=True)][:ROWS]
        symbols = {key: _HEADS[key][1] for key in named}
        table.notes = [
            f"{symbols.get(key, key)}: {of.long_name}" for key, of in columns.items() if symbols.get(key, key)
        ]
        if coordinate.values.size > ROWS:
            table.notes.append(f"and {coordinate.values.size - ROWS} more, in the archive")
        tables.append(table)
    more = {key: of for key, of in group.variables.items() if len(of.dims) > 1}
    if more:
        notes = [f"{key}, by {', '.join(of.dims)}: {of.long_name}" for key, of in more.items()]
        tables.append(Table(f"{name.replace('_', ' ')}: in the archive", notes=notes))
    return tables


def _header(key: str, variable: Variable) -> str:
    """Words, symbol and unit of a variable that is known."""
    return _with_unit(" ".join(filter(None, _HEADS[key])), variable)


def _with_unit(words: str, variable: Variable) -> str:
    unit = _unit(variable)[0]
    return f"{words} [{unit}]" if unit else words


def _unit(variable: Variable) -> tuple[str, float]:
    return (UNITS | _LENGTH).get(variable.unit, (variable.unit, 1.0))


def _cells(variable: Variable) -> list[str]:
    if variable.values.dtype.kind in "iuU":
        return [str(value) for value in variable.values]
    return [number(finite(float(value)), 4, _unit(variable)[1], negligible=1e-300) for value in variable.values]
