"""What tables of designs show storey by storey, whatever the method."""

from __future__ import annotations

from collections.abc import Iterable

from edesign.archive.dataset import Group
from edesign.report.tables.table import Table, number, whole


def put_storeys(table: Table, group: Group, columns: Iterable[tuple[str, str, float]]) -> None:
    """Fill a table with a row for each storey with dampers.

    Args:
        table: without columns.
        group: of a design.
        columns: header, variable over (storey,), and the unit shown, in SI; those that the design has not are left out.
    """
    shown = [column for column in columns if column[1] in group.variables]
    table.columns = ("storey", *(header for header, _, _ in shown))
    for i, storey in enumerate(group.coords["storey"].values):
        cells = [number(float(group.variables[key].values[i]), scale=scale) for _, key, scale in shown]
        table.rows.append([whole(storey), *cells])
