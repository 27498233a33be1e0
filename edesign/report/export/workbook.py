"""Tables as one workbook of Excel: contents, a sheet a table, provenance."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from edesign.archive.files import write_whole
from edesign.errors import InputError
from edesign.report.archived import input_checksum
from edesign.report.export.export_table import ExportColumn, ExportTable
from edesign.report.export.names import slug, unique_names
from edesign.report.tables.visible import visible

if TYPE_CHECKING:
    from xlsxwriter.workbook import Workbook
    from xlsxwriter.worksheet import Worksheet

NO_EXTRA = "a workbook needs the package XlsxWriter: pip install 'edesign[tables]'; --csv needs no package [E-CLI-06]"
CONTENTS, PROVENANCE = "contents", "provenance"
MOST_ROWS, MOST_COLUMNS, MOST_LETTERS = 1_048_576, 16_384, 32_767  # of a sheet and of a cell
_SHEET = 31  # letters of the name of a sheet
_HEAD = 2  # rows above the headers: the title, and the way back to the contents
_WIDEST, _LEAST, _SAMPLE = 60, 8, 200  # letters of a column, and rows that its width is taken from
_LINE = 15.0  # points of a line
_OPTIONS = {
    "strings_to_formulas": False,
    "strings_to_numbers": False,
    "strings_to_urls": False,
    "nan_inf_to_errors": False,
}
_NUMBER = re.compile(r"([+-]*)(\d+)(\.\d*)?(e[+-]\d+)?(.*)")


def write_workbook(tables: Sequence[ExportTable], facts: Mapping[str, str], path: Path) -> list[ExportTable]:
    """Write tables as a workbook; numbers keep all their digits and are shown with those of the report.

    Args:
        tables: a sheet each, after the sheet of contents.
        facts: of the last sheet, the provenance.
        path: the workbook, whole or not at all.

    Returns:
        The tables that are larger than a sheet can be: the contents name them, and they have no sheet.

    Raises:
        InputError: XlsxWriter is missing, or every table is larger than a sheet can be.
        ArchiveError: it cannot be written.
    """
    try:
        import xlsxwriter
    except ImportError as error:
        raise InputError(NO_EXTRA) from error
    larger = [table for table in tables if not _fits(table)]
    if larger and len(larger) == len(tables):
        table = larger[0]
        raise InputError(
            f"table {table.name}: {table.rows} rows and {len(table.columns)} columns are more than a sheet takes "
            f"({MOST_ROWS} and {MOST_COLUMNS}); use --csv or --parquet, or choose others by --tables [E-CLI-07]"
        )

    def write(partial: Path) -> None:
        with xlsxwriter.Workbook(partial, _OPTIONS) as book:
            _fill(book, [table for table in tables if _fits(table)], facts, larger)

    write_whole(path, write)
    return larger


def _fits(table: ExportTable) -> bool:
    return table.rows + _HEAD + 1 + len(table.notes) <= MOST_ROWS and len(table.columns) <= MOST_COLUMNS


def sheet_names(names: Sequence[str]) -> list[str]:
    """Return names of sheets: of at most 31 letters, no two the same in any case of letters, none of our own sheets."""
    history = "history"  # a name that Excel keeps for itself
    whole = [slug(name, _SHEET) if len(name) > _SHEET else name for name in names]
    return unique_names(whole, taken=(CONTENTS, PROVENANCE, history), longest=_SHEET)


def number_format(text: str) -> str:
    """Return the format of Excel that shows a number as a text does: `12.30 %` is `0.00" %"`."""
    match = _NUMBER.fullmatch(text)
    if match is None:
        return "General"
    sign, _, places, exponent, after = match.groups()
    digits = "0" + (f".{'0' * (len(places) - 1)}" if places and len(places) > 1 else "")
    digits += "E+00" if exponent else ""
    digits += f'"{after}"' if after and '"' not in after else ""
    if sign == "+":
        return f"+{digits};-{digits};{digits}"
    return f'"±"{digits}' if sign == "+-" else digits


def _fill(
    book: Workbook, tables: Sequence[ExportTable], facts: Mapping[str, str], larger: Sequence[ExportTable]
) -> None:
    # no clock of ours: the same archive gives the same workbook
    book.set_properties({"title": facts.get("title", ""), "created": _created(facts), "comments": _origin(facts)})
    bold, link = book.add_format({"bold": True}), book.get_default_url_format()
    names = sheet_names([table.sheet or table.name for table in tables])
    contents = book.add_worksheet(CONTENTS)
    _text(contents, 0, 0, facts.get("title", "") or facts.get("archive", ""), bold)
    for column, header in enumerate(("table", "title", "rows", "columns")):
        contents.write_string(_HEAD, column, header, bold)
    contents.set_column(0, 0, 2 * _SHEET)
    contents.set_column(1, 1, _WIDEST)
    contents.freeze_panes(_HEAD + 1, 0)
    forms: dict[str, Any] = {}
    for row, (name, table) in enumerate(zip(names, tables, strict=True), start=_HEAD + 1):
        contents.write_url(row, 0, f"internal:'{name}'!A1", link, table.name)
        _text(contents, row, 1, table.title)
        contents.write_number(row, 2, table.rows)
        contents.write_number(row, 3, len(table.columns))
        _sheet(book, book.add_worksheet(name), table, forms, bold, link)
    provenance = book.add_worksheet(PROVENANCE)
    provenance.set_column(0, 0, 20)
    provenance.set_column(1, 1, 70)
    for row, (key, text) in enumerate(facts.items()):
        provenance.write_string(row, 0, key, bold)
        _text(provenance, row, 1, text)
    contents.write_url(row := len(tables) + _HEAD + 1, 0, f"internal:'{PROVENANCE}'!A1", link, PROVENANCE)
    contents.write_string(row, 1, "The archive, checksums of its input, versions")
    for at, table in enumerate(larger, start=row + 1):
        _text(contents, at, 0, table.name)
        _text(contents, at, 1, f"{table.title} (larger than a sheet: by --csv or --parquet)")
        contents.write_number(at, 2, table.rows)
        contents.write_number(at, 3, len(table.columns))


def _sheet(book: Workbook, sheet: Worksheet, table: ExportTable, forms: dict[str, Any], bold: Any, link: Any) -> None:
    _text(sheet, 0, 0, table.title, bold)
    sheet.write_url(1, 0, f"internal:'{CONTENTS}'!A1", link, CONTENTS)
    named, numbered = (
        book.add_format({"bold": True, "bottom": 1, "text_wrap": True, "valign": "top", "align": align})
        for align in ("left", "right")
    )
    lines = 1
    for i, column in enumerate(table.columns):
        _text(sheet, _HEAD, i, column.header, numbered if column.numeric else named)
        if column.long_name:
            sheet.write_comment(_HEAD, i, column.long_name, {"x_scale": 2})
        sheet.set_column(i, i, width := _width(column))
        lines = max(lines, math.ceil(len(column.header) / width))
        for row, value in enumerate(column.values, start=_HEAD + 1):
            if value is None:
                continue
            if isinstance(value, bool):
                sheet.write_boolean(row, i, value)
            elif isinstance(value, str):
                _text(sheet, row, i, value)
            elif not math.isfinite(value):  # no cell can hold it
                _text(sheet, row, i, str(value))
            else:
                shown = number_format(str(column.texts[row - _HEAD - 1])) if column.texts else "General"
                if shown not in forms:
                    forms[shown] = book.add_format({"num_format": shown})
                sheet.write_number(row, i, value, forms[shown])
    first_note = _HEAD + 1 + table.rows
    for row, note in enumerate(table.notes, start=first_note + 1):
        _text(sheet, row, 0, note)
    sheet.freeze_panes(_HEAD + 1, min(table.left, 2) if len(table.columns) > table.left else 0)
    sheet.set_row(_HEAD, (lines + (lines > 1)) * _LINE)
    sheet.set_landscape()
    sheet.set_paper(9)  # A4
    sheet.fit_to_pages(1, 0)
    sheet.repeat_rows(_HEAD)
    if table.rows > 1:
        sheet.autofilter(_HEAD, 0, first_note - 1, len(table.columns) - 1)


def _text(sheet: Worksheet, row: int, column: int, text: str, form: Any = None) -> None:
    """Write a text as a text, whatever it begins with."""
    sheet.write_string(row, column, visible(text)[:MOST_LETTERS], form)


def _width(column: ExportColumn) -> float:
    cells = column.texts or [f"{v:.9g}" if isinstance(v, float) else str(v or "") for v in column.values[:_SAMPLE]]
    longest = max((len(cell) for cell in cells[:_SAMPLE]), default=0)
    return min(max(longest, len(column.header) * 0.7, _LEAST) + 2, _WIDEST)


def _created(facts: Mapping[str, str]) -> datetime:
    try:
        return datetime.fromisoformat(facts["created"]).replace(tzinfo=None)
    except (KeyError, ValueError):
        return datetime(2000, 1, 1)


def _origin(facts: Mapping[str, str]) -> str:
    checksum = input_checksum({name.replace(" ", "_"): text for name, text in facts.items()})
    return f"{facts.get('archive', '')}, input SHA-256 {checksum}"
