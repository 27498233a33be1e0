"""Variables of a group of an archive (a design, modes) beside reference values."""

from __future__ import annotations

import numpy as np
from pydantic_core import PydanticCustomError

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import Archive
from edesign.errors import InputError
from edesign.project.notation.printed_unit import unit_factor
from edesign.project.reading.problems import listed, unknown_name
from edesign.project.study.reference import Reference, VariableRow, VariableTable
from edesign.report.comparison.cells import ComparedCell, ComparedTable


def compare_variables(archive: Archive, reference: Reference, index: int, table: VariableTable) -> ComparedTable:
    """Compare one table of variables, number `index` of the reference.

    Args:
        index: number of the table in the reference, from 0.

    Raises:
        ArchiveError: the archive is damaged.
        InputError: the group has no such variable, or it has another dimension or unit.
    """
    parent, _, name = table.group.rpartition("/")
    there = name in archive.names(parent or "/")
    group = archive.group(table.group) if there else None
    notes = [] if there else [f"the archive has no {table.group}"]
    failed = group is not None and group.attributes.get("status", "completed") != "completed"
    if group is not None and failed:
        notes.append(f"{table.group}: {group.attributes['status']}: {group.attributes.get('reason') or '-'}")
    cells: list[ComparedCell] = []
    for j, row in enumerate(table.rows):
        values = None
        if group is not None and not (failed and row.variable not in group.variables):
            values = _values(group, reference, table, row, ("tables", index, "rows", j))
        cells += _cells(table, row, group, values)
    return ComparedTable(table.title, "variables", tuple(cells), over=table.over, notes=tuple(notes))


def _values(
    group: Group, reference: Reference, table: VariableTable, row: VariableRow, keys: tuple[str | int, ...]
) -> np.ndarray:
    """The values in the unit of the row."""
    variable = group.variables.get(row.variable)
    dimensions = {table.over, *table.at}
    if variable is None:
        known = [name for name, other in group.variables.items() if set(other.dims) == dimensions]
        where = reference.where(*keys, "variable")
        raise InputError(f"{where}: {table.group}: {unknown_name('variable', row.variable, known)}")
    if set(variable.dims) != dimensions:
        over = listed(variable.dims) if variable.dims else "nothing"
        where = reference.where(*keys, "variable")
        raise InputError(
            f"{where}: {table.group}: `{row.variable}` is given over {over}, not over {listed(sorted(dimensions))}"
            " [E-ARCH-07]"
        )
    values = np.asarray(variable.values, dtype=float)
    for dimension, label in table.at.items():
        labels = [str(value) for value in group.coords[dimension].values]
        if label not in labels:
            where = reference.where(*keys[:2], "at", dimension)
            raise InputError(f"{where}: {table.group}: {unknown_name(dimension, label, labels)}")
        values = np.take(values, [labels.index(label)], axis=variable.dims.index(dimension))
    return values.ravel() / _factor(variable, reference, row, keys)


def _factor(variable: Variable, reference: Reference, row: VariableRow, keys: tuple[str | int, ...]) -> float:
    try:
        return unit_factor(row.unit, variable.unit)
    except PydanticCustomError as error:
        raise InputError(f"{reference.where(*keys, 'unit')}: {error.message()}") from None


def _cells(
    table: VariableTable, row: VariableRow, group: Group | None, values: np.ndarray | None
) -> list[ComparedCell]:
    have = 0 if values is None else len(values)
    cells = []
    for k, cell in enumerate(row.cells()):
        if cell is None:
            continue
        value = float(values[k]) if values is not None and k < have else None
        finite = value is not None and bool(np.isfinite(value))
        absent = f"the archive has no {table.group}" if group is None else f"there are {have} values"
        cells.append(
            ComparedCell(
                quantity=row.label,
                source=f"{table.group}/{row.variable}",
                unit=row.unit,
                reference=cell.value,
                found=value if finite else None,
                within=table.bar(row, cell),
                note="; ".join(note for note in (row.note, cell.note) if note),
                index=_label(table, group, k),
                reason="" if finite else "not finite" if value is not None else absent,
            )
        )
    return cells


def _label(table: VariableTable, group: Group | None, k: int) -> str:
    if table.labels is not None:
        return table.labels[k]
    coordinate = None if group is None else group.coords.get(table.over)
    return str(coordinate.values[k]) if coordinate is not None and k < len(coordinate.values) else str(k + 1)
