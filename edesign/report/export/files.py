"""Tables as folders of CSV and of Parquet files."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.archive.files import make_folder, write_whole
from edesign.errors import InputError
from edesign.report.export.export_table import ExportColumn, ExportTable

if TYPE_CHECKING:
    import pyarrow

NO_EXTRA = "a Parquet file needs the package pyarrow: pip install 'edesign[tables]'; --csv needs no package [E-CLI-06]"
CONTENTS, PROVENANCE = "contents.csv", "provenance.csv"
_LIST = ("file", "title", "rows", "columns", "notes")


def write_csv_folder(tables: Sequence[ExportTable], facts: Mapping[str, str], folder: Path) -> list[Path]:
    """Write each table as `NAME.csv` with all digits and units in the headers, and a list of them.

    Args:
        tables: whose names are no other's.
        facts: written as provenance.csv.
        folder: made if it is not there.

    Returns:
        The files of the tables.

    Raises:
        ArchiveError: a file cannot be written.
    """
    make_folder(folder)
    written = []
    for table in tables:
        path = folder / f"{table.name}.csv"
        headers = [column.header for column in table.columns]
        write_csv_file(headers, zip(*(column.values for column in table.columns), strict=True), path)
        written.append(path)
    _describe(tables, facts, folder, ".csv")
    return written


def write_parquet_folder(tables: Sequence[ExportTable], facts: Mapping[str, str], folder: Path) -> list[Path]:
    """Write each table as `NAME.parquet`; units are metadata of its fields, title and notes those of the table.

    Arguments, result and errors as `write_csv_folder`; InputError: pyarrow is missing.
    """
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise InputError(NO_EXTRA) from error
    make_folder(folder)
    written = []
    for table in tables:
        fields = [_field(pyarrow, column) for column in table.columns]
        about = {"title": table.title, "notes": json.dumps(table.notes), "provenance": json.dumps(dict(facts))}
        columns = [pyarrow.array(_uniform(c), one.type) for c, one in zip(table.columns, fields, strict=True)]
        made = pyarrow.table(columns, pyarrow.schema(fields, about))
        path = folder / f"{table.name}.parquet"

        def write(partial: Path, made: pyarrow.Table = made) -> None:
            pyarrow.parquet.write_table(made, partial)

        write_whole(path, write)
        written.append(path)
    _describe(tables, facts, folder, ".parquet")
    return written


def _describe(tables: Sequence[ExportTable], facts: Mapping[str, str], folder: Path, suffix: str) -> None:
    rows: list[list[Cell]] = [
        [f"{t.name}{suffix}", t.title, t.rows, len(t.columns), "\n".join(t.notes)] for t in tables
    ]
    write_csv_file(_LIST, rows, folder / CONTENTS)
    write_csv_file(("what", "value"), facts.items(), folder / PROVENANCE)


def _field(arrow: Any, column: ExportColumn) -> Any:
    """A field of numbers where it has nothing else, of texts otherwise."""
    kind = arrow.string()
    if column.numeric:
        whole = all(isinstance(value, int) for value in column.values if value is not None)
        kind = arrow.int64() if whole else arrow.float64()
    elif column.values and all(isinstance(value, bool) for value in column.values if value is not None):
        kind = arrow.bool_() if any(value is not None for value in column.values) else arrow.string()
    about = {"unit": column.unit, "long_name": column.long_name}
    return arrow.field(column.name, kind, metadata={key: text for key, text in about.items() if text})


def _uniform(column: ExportColumn) -> list[Any]:
    """Values of one type; numbers among texts are texts."""
    if any(isinstance(value, str) for value in column.values):
        return [None if value is None else str(value) for value in column.values]
    return list(column.values)
