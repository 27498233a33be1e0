"""Tables as CSV files: whole or not at all, and without formulas."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from edesign.archive.files import write_text

Cell = str | float | int | bool | None

_FORMULA = re.compile(r"(?:^|(?<=[;\t\r\n]))(?=[=+\-@\t\r\n＝＋－＠])")


def write_csv_file(
    headers: Sequence[str], rows: Iterable[Iterable[Cell]], path: Path, digits: int | None = None
) -> None:
    """Write a table as CSV: commas, quotes where a cell needs them, UTF-8.

    Texts that a spreadsheet would take for a formula get an apostrophe before them: those that begin with = + - @, a
    tab or a line end, also behind a semicolon or tab, at which a spreadsheet may cut. Numbers, and a sign that stands
    alone, are written as they are.

    Args:
        headers: of the columns, with their units.
        rows: cells; None is an empty cell, true and false are written in small letters.
        digits: significant ones of numbers; all of them, so that reading gives the same numbers, if None.

    Raises:
        ArchiveError: it cannot be written.

    Source: OWASP, "CSV Injection".
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(map(_harmless, headers))
    writer.writerows([_written(cell, digits) for cell in row] for row in rows)
    write_text(text.getvalue(), path)


def _written(cell: Cell, digits: int | None) -> str:
    if isinstance(cell, str):
        return _harmless(cell)
    if cell is None:
        return ""
    if isinstance(cell, bool):
        return str(cell).lower()
    if isinstance(cell, int):
        return str(cell)
    return repr(float(cell)) if digits is None else f"{cell:.{digits}g}"


def _harmless(text: str) -> str:
    return text if len(text) < 2 or _is_number(text) else _FORMULA.sub("'", text)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
