"""The variables of an archive as long tables: a row for each analysis and storey, in SI."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import Archive
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed
from edesign.report.export.export_table import ExportColumn, ExportTable, Value
from edesign.report.export.names import LONGEST_FILE, slug, unique_names
from edesign.report.page.source import ALONG_TIME
from edesign.study.results.kinds import ANALYSES

HISTORIES_ALONG = (*ALONG_TIME, "sample")
"""Dimensions of histories and curves, which are tables of their own."""
LABELS = ("kind", "variant", "record", "level", "status")


def value_tables(archive: Archive) -> list[ExportTable]:
    """Return the variables of all groups but for histories, in SI with all digits.

    Variables with the same dimensions in groups beside each other are one table, `analyses_by_storey`: a row for each
    group and each place along the dimensions.
    """
    places: dict[str, list[str]] = {}
    for place in _places(archive):
        places.setdefault(place.rpartition("/")[0] or place, []).append(place)
    tables = []
    for parent, below in places.items():
        several = below != [parent]
        found: dict[tuple[str, ...], list[tuple[str, Group]]] = {}
        for place in below:
            group = archive.view(place).without(*HISTORIES_ALONG)
            for dims in dict.fromkeys(variable.dims for variable in group.variables.values()):
                found.setdefault(dims, []).append((place, group))
        for dims, groups in found.items():
            along = "_".join(("by", *dims)) if dims else "values"
            what = f"{parent}, each {' and '.join(dims)}" if dims else f"{parent}, single values"
            labelled = several and parent == ANALYSES
            columns = _stacked(dims, groups, several, labelled)
            left = several + (len(LABELS) if labelled else 0) + len(dims)
            tables.append(
                ExportTable(slug(f"{parent}_{along}", LONGEST_FILE), f"{what}, SI", tuple(columns), left=left)
            )
    return tables


def history_tables(archive: Archive, patterns: Sequence[str]) -> list[ExportTable]:
    """Return histories and curves, a table for each group and each dimension along which they run, in SI.

    Args:
        patterns: names of analyses, records or tests, with `*` for any letters.

    Raises:
        InputError: none of that name has a history.
    """
    have = {place: along for place in _places(archive) if (along := _abscissae(archive.view(place)))}
    last = {place: place.rpartition("/")[2] for place in have}
    chosen: list[str] = []
    for pattern in patterns:
        matching = [place for place, name in last.items() if fnmatch.fnmatchcase(name, pattern)]
        if not matching:
            there = list(dict.fromkeys(last.values()))
            hint = did_you_mean(pattern, there)
            raise InputError(
                f"{archive.path}: no analysis, record or test {pattern!r} has histories{hint} "
                f"(there are: {listed(there) if there else 'none'}) [E-ARCH-07]"
            )
        chosen += matching
    tables = []
    for place in dict.fromkeys(chosen):
        group = archive.view(place)
        for abscissa in have[place]:
            name = f"histories_{place}" + ("" if abscissa == have[place][0] else f"_{abscissa}")
            tables.append(
                ExportTable(slug(name, LONGEST_FILE), f"{place}: along {abscissa}, SI", tuple(_wide(group, abscissa)))
            )
    names = unique_names([table.name for table in tables])
    return [replace(table, name=name) for table, name in zip(tables, names, strict=True)]


def _places(archive: Archive, place: str = "") -> Iterator[str]:
    for name in archive.names(place or "/"):
        below = f"{place}/{name}".strip("/")
        if not archive.lost(below):
            yield below
            yield from _places(archive, below)


def _abscissae(group: Group) -> list[str]:
    found = {dim for variable in group.variables.values() for dim in variable.dims if dim in HISTORIES_ALONG}
    return [dim for dim in HISTORIES_ALONG if dim in found]


def _stacked(
    dims: tuple[str, ...], groups: Sequence[tuple[str, Group]], several: bool, labelled: bool
) -> Iterator[ExportColumn]:
    """Columns that say of what a row is, and one for each variable; None where a group does not have it."""
    along = [[_labels(group, dim, i, dims) for i, dim in enumerate(dims)] for _, group in groups]
    cells = [list(product(*labels)) for labels in along]
    counts = [len(of) for of in cells]
    variables: dict[str, Variable] = {}
    for _, group in groups:
        for name, variable in group.variables.items():
            if variable.dims == dims:
                variables.setdefault(name, variable)
    heads = [*(["name"] if several else []), *(LABELS if labelled else ()), *dims]
    names = unique_names([*heads, *variables], " ")
    if several:
        values = [place.rpartition("/")[2] for place, _ in groups]
        yield ExportColumn("name", "", _repeated(values, counts))
        for label in LABELS if labelled else ():
            yield ExportColumn(label, "", _repeated([_plain(g.attributes.get(label)) for _, g in groups], counts))
    for i, dim in enumerate(dims):
        coord = groups[0][1].coords.get(dim)
        unit, long_name = (coord.unit, coord.long_name) if coord is not None else ("", "")
        yield ExportColumn(dim, unit, [cell[i] for of in cells for cell in of], (), long_name)
    for header, (name, variable) in zip(names[len(heads) :], variables.items(), strict=True):
        found: list[Value] = []
        for (_, group), count in zip(groups, counts, strict=True):
            own = group.variables.get(name)
            there = own is not None and own.dims == dims
            found += _column(own.values) if own is not None and there else [None] * count
        yield ExportColumn(header, variable.unit, found, (), variable.long_name)


def _labels(group: Group, dim: str, axis: int, dims: tuple[str, ...]) -> list[Value]:
    coord = group.coords.get(dim)
    if coord is not None:
        return _column(coord.values)
    size = next(variable.values.shape[axis] for variable in group.variables.values() if variable.dims == dims)
    return list(range(1, size + 1))


def _wide(group: Group, along: str) -> Iterator[ExportColumn]:
    """The abscissa, and for each variable a column for each place: `floor_displacement 3`."""
    coord = group.coords.get(along)
    found: list[ExportColumn] = []
    if coord is not None:
        found.append(ExportColumn(along, coord.unit, _column(coord.values), (), coord.long_name))
    for name, variable in group.variables.items():
        if along not in variable.dims:
            continue
        axis = variable.dims.index(along)
        others = [dim for dim in variable.dims if dim != along]
        labels = [_of_axis(group, dim, variable) for dim in others]
        values = np.moveaxis(variable.values, axis, 0).reshape(variable.values.shape[axis], -1)
        for i, cell in enumerate(product(*labels)):
            header = " ".join([name, *map(str, cell)])
            found.append(ExportColumn(header, variable.unit, _column(values[:, i]), (), variable.long_name))
    names = unique_names([column.name for column in found], " ")
    for name, column in zip(names, found, strict=True):
        yield ExportColumn(name, column.unit, column.values, (), column.long_name)


def _of_axis(group: Group, dim: str, variable: Variable) -> list[Value]:
    coord = group.coords.get(dim)
    if coord is not None:
        return _column(coord.values)
    return list(range(1, variable.values.shape[variable.dims.index(dim)] + 1))


def _column(values: Any) -> list[Value]:
    found: list[Value] = np.asarray(values).reshape(-1).tolist()
    return found


def _repeated(values: Sequence[Value], counts: Sequence[int]) -> list[Value]:
    return [value for value, count in zip(values, counts, strict=True) for _ in range(count)]


def _plain(value: object) -> Value:
    return None if value in (None, "") else str(value)
