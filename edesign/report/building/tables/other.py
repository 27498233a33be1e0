"""Tables of the groups of a building's archive that have no table of their own."""

from __future__ import annotations

from dataclasses import replace

from edesign.archive.dataset import Variable
from edesign.report.building.results import UNITS, BuildingResults, Row
from edesign.report.tables.column import Column, bounded
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import MM, Unit
from edesign.space.archived import PLACE, SELECTION

KNOWN = {
    *("combinations", "criteria", "deflections", "floors", "forces", "foundations", "joints", "lateral", "materials"),
    *("members", "modes", "nodes", "overstrength_x", "overstrength_y", "spectrum", "storeys_x", "storeys_y", "sway"),
    SELECTION,
}
"""Groups that the other tables and figures show."""
ROWS = 100
"""Rows of a table."""
_TITLES = {"panels": "Web panels of columns"}
_HEADS: dict[str, tuple[str, str]] = {
    "node": ("node", ""),
    "axis": ("direction", ""),
    "V_wp_Ed": ("shear", "V_wp,Ed"),
    "V_wp_Rd": ("resistance", "V_wp,Rd"),
    "V_wp_Rd_doubled": ("resistance with a plate", "V_wp,Rd,d"),
    "doubler": ("plate", "t_d"),
}
"""Words and symbols of the variables of these groups, in the order of their columns; other groups have their names."""
_UNITS = UNITS | {"m": MM}  # lengths are those of plates
OTHERS = TableSpec[Row]("other_results", "{title}", (), named_by_title=True)
VARIABLES = TableSpec[None]("other_variables", "{group}: in the archive", (), named_by_title=True)


def other_tables(results: BuildingResults) -> list[Table]:
    """Return a table of each group that is not in `KNOWN`: its variables along one dimension; the others are named."""
    names = [name for name in results.archive.names(PLACE) if name not in KNOWN]
    return [table for name in names for table in _tables(results, name)]


def _tables(results: BuildingResults, name: str) -> list[Table]:
    group, words = results.group(name), name.replace("_", " ")
    tables = []
    for along, coordinate in group.coords.items():
        variables = {key: of for key, of in group.variables.items() if of.dims == (along,)}
        if not variables:
            continue
        named = {key: _HEADS[key] for key in _HEADS if key in variables} if name in _TITLES else {}
        heads = named | {key: ("", key) for key in variables if key not in named}
        columns = [_column(" ".join(head).strip(), key, variables[key]) for key, head in heads.items()]
        notes = [f"{symbol}: {variables[key].long_name}" for key, (_, symbol) in heads.items() if symbol]
        rows = results.rows(name, along)
        if len(rows) > ROWS:
            notes.append(f"and {len(rows) - ROWS} more, in the archive")
        tables.append(
            replace(OTHERS, formulas=bool(named)).of(
                rows[:ROWS],
                more=[_column(along, along, coordinate), *columns],
                notes=notes,
                title=_TITLES.get(name, f"{words}, each {along}"),
            )
        )
    more = {key: of for key, of in group.variables.items() if len(of.dims) > 1}
    if more:
        notes = [f"{key}, by {', '.join(of.dims)}: {of.long_name}" for key, of in more.items()]
        tables.append(VARIABLES.of((), notes=notes, group=words))
    return tables


def _column(header: str, key: str, variable: Variable) -> Column[Row]:
    unit = _UNITS.get(variable.unit, Unit(variable.unit))
    if variable.values.dtype.kind in "iuU":
        return Column(header, key, "text", unit)
    return Column(header, bounded(key), unit=unit, negligible=1e-300)
