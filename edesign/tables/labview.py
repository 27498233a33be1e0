"""LabVIEW measurement files (.lvm) as tables: their headers say signs, units and sampling above the columns."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from edesign.errors import InputError
from edesign.tables.text import TableText, is_number

MARK = "LabVIEW"
_FIRST = "LabVIEW Measurement"
_END = "***End_of_Header***"
_TIME, _COMMENT = "X_Value", "Comment"


def is_labview(lines: Sequence[str]) -> bool:
    """Return whether lines are those of a LabVIEW measurement.

    Args:
        lines: of the file, without blank ones.
    """
    return bool(lines) and lines[0].strip('" \t').startswith(_FIRST)


def plain_table(text: TableText) -> TableText:
    """Return a LabVIEW measurement as a table: a line of headers with units, then rows, all with tabs between.

    The first column is the time, of `X_Value`, or of `X0` and `Delta_X` where the file has none. Comments and channels
    without samples are left out. Several sections follow each other.

    Args:
        text: all lines of the file that are not blank.

    Raises:
        InputError: there is no section of numbers, sections differ in their channels, or channels have times of their
            own.

    Source: National Instruments, "Specification for the LabVIEW Measurement File (.lvm)".
    """
    sign = "\t"
    keys: dict[str, list[str]] = {}
    names: list[str] = []
    header_line = 0
    numbers: list[int] = []
    rows: list[list[str]] = []
    in_header = True
    for number, line in zip(text.numbers, text.lines, strict=True):
        if number == text.numbers[0]:
            continue
        cells = [cell.strip().strip('"').strip() for cell in line.split(sign)]
        if cells[0] == _END:
            in_header = False
        elif cells[0] == "Separator":
            sign = "," if cells[1:2] == ["Comma"] else "\t"
        elif cells[0] == _TIME:
            if names and cells != names:
                raise InputError(
                    f"{text.path}:{number}: other channels than in line {header_line}; write them apart [E-TABLE-06]"
                )
            names, header_line = cells, header_line or number
            in_header, in_section = False, len(rows)
        elif in_header or not (cells[0] == "" or is_number(cells[0].replace(",", "."))):
            keys[cells[0]] = cells
            in_header = True
        elif names:
            rows.append(_row(cells, names, keys, len(rows) - in_section))
            numbers.append(number)
    if not rows:
        raise InputError(
            f"{text.path}:{text.last}: the LabVIEW measurement has no rows below a line `{_TIME}` [E-TABLE-04]"
        )
    kept = _kept(text, names, rows, numbers)
    headers = [_header(names, keys, i) for i in kept]
    lines = ["\t".join(row[i] if i < len(row) else "" for i in kept) for row in rows]
    decimal = {",": "comma", ".": "point"}.get("".join(keys.get("Decimal_Separator", ["", ""])[1:2]))
    return replace(
        text,
        numbers=[header_line, *numbers],
        lines=["\t".join(headers), *lines],
        mark=MARK,
        decimal=decimal,  # type: ignore[arg-type]
        above=text.numbers.index(header_line),
    )


def _row(cells: list[str], names: Sequence[str], keys: dict[str, list[str]], index: int) -> list[str]:
    """A row with its time, which a file without a column of times has as X0 and Delta_X."""
    if cells[0] == "" and names[0] == _TIME:
        start, step = (_number(keys.get(key, [])) for key in ("X0", "Delta_X"))
        if step > 0.0:
            time = f"{start + index * step:.9g}"
            cells = [time.replace(".", ",") if any("," in cell for cell in cells[1:]) else time, *cells[1:]]
    return cells


def _number(cells: list[str]) -> float:
    """The first number of a line of the header; 0 if it has none."""
    plain = (cell.replace(",", ".") for cell in cells[1:])
    return next((float(cell) for cell in plain if is_number(cell)), 0.0)


def _kept(text: TableText, names: list[str], rows: list[list[str]], numbers: list[int]) -> list[int]:
    """Columns of a table: the first of the times, and channels that have samples."""
    columns = range(len(names))
    for i in columns:
        if i and names[i] == _TIME:
            other = next((k for k, row in enumerate(rows) if row[i : i + 1] != row[:1]), None)
            if other is not None:
                raise InputError(
                    f"{text.path}:{numbers[other]}: column {i + 1} has times of its own (`X_Columns` is `Multi`); "
                    "write the channels with one column of times [E-TABLE-13]"
                )
    return [
        i
        for i in columns
        if i == 0 or names[i] not in (_TIME, _COMMENT, "") and any(i < len(row) and row[i] for row in rows)
    ]


def _header(names: list[str], keys: dict[str, list[str]], column: int) -> str:
    """The name of a column with its unit; signs that stand between columns are left out."""
    if column == 0:
        of_time = {cell for cell in keys.get("X_Dimension", ["", "Time"])[1:] if cell} <= {"Time"}
        return "time (s)" if of_time else _TIME
    name = names[column].replace(",", " ").replace(";", " ")
    units = keys.get("Y_Unit_Label", [])
    unit = units[column] if column < len(units) else ""
    return f"{name} ({unit})" if unit and not name.endswith((")", "]")) else name
