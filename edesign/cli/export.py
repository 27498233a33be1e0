"""`edesign export`: the tables of an archive for spreadsheets and programs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_folder
from edesign.archive.reader import Archive, DamagedArchive, read_archive, refuse_calibration
from edesign.errors import EdesignError, InputError
from edesign.optional_stages import optional
from edesign.report.archive.document import check_page_path
from edesign.report.export.catalogue import archive_tables, choose
from edesign.report.export.export_table import ExportTable
from edesign.report.export.facts import provenance_facts
from edesign.report.export.files import write_csv_folder, write_parquet_folder
from edesign.report.export.value_tables import history_tables
from edesign.report.export.workbook import write_workbook
from edesign.report.tables.column import count, text
from edesign.report.tables.table import TableSpec
from edesign.report.tables.text import print_tables

LIST = TableSpec[ExportTable](
    "list_of_tables",
    "{number} tables",
    (text("name"), count("rows"), count("columns", lambda table: len(table.columns))),
)


def export(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    xlsx: Annotated[
        Path | None,
        typer.Option("--xlsx", metavar="FILE", help="A workbook of Excel; by default NAME.xlsx beside the archive."),
    ] = None,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FOLDER", help="A CSV file for each table.")] = None,
    parquet: Annotated[
        Path | None, typer.Option("--parquet", metavar="FOLDER", help="A Parquet file for each table.")
    ] = None,
    tables: Annotated[
        str | None, typer.Option("--tables", "-t", metavar="NAME,...", help="These only; `*` stands for any letters.")
    ] = None,
    histories: Annotated[
        str | None,
        typer.Option(
            "--histories",
            metavar="NAME,...",
            help="Also the histories and curves of these analyses, records or tests; `*` stands for any letters.",
        ),
    ] = None,
    analysis: Annotated[
        str | None, typer.Option("--analysis", "-n", metavar="NAME", help="The tables of one analysis only.")
    ] = None,
    as_list: Annotated[bool, typer.Option("--list", help="Print the names of the tables, and write nothing.")] = False,
) -> None:
    """Write the tables of an archive as a workbook, or as CSV or Parquet files, with units and all digits."""
    if xlsx is None and csv is None and parquet is None:
        xlsx = archive.with_name(archive.name.removesuffix(".partial")).with_suffix(".xlsx")
    for option, names in (("--tables", tables), ("--histories", histories)):
        if names is not None and not _names(names):
            raise InputError(
                f"{option}: it names nothing; names are separated by commas, `*` stands for all [E-CLI-04]"
            )
    if xlsx is not None and not as_list:
        check_page_path(xlsx, (".xlsx",), "a workbook")
    for folder in filter(None, (csv, parquet)):
        check_folder(folder)

    def read(opened: Archive) -> tuple[list[ExportTable], dict[str, str]]:
        if histories is None and not as_list:
            refuse_calibration(opened)  # there is nothing else to write
        found = archive_tables(opened, analysis)
        if tables is not None:
            found = choose(found, _names(tables), str(archive))
        if histories is not None:
            found = found + history_tables(opened, _names(histories))
        return found, provenance_facts(opened)

    (found, facts), damage = read_archive(archive, read)
    if as_list:
        print_tables([LIST.of(found, number=len(found))])
    else:
        kept = f"the results are in {archive}"  # and each form of the tables does without the others
        if xlsx is not None:
            with optional(str(xlsx), kept, passing=(EdesignError,)):
                larger = write_workbook(found, facts, xlsx)
                print(f"{xlsx}: {len(found) - len(larger)} tables")
                for table in larger:
                    print(
                        f"without {table.name}: its {table.rows} rows and {len(table.columns)} columns are more than a "
                        f"sheet takes; edesign export {archive} --tables {table.name} --csv FOLDER writes it, "
                        "as --parquet does"
                    )
        if csv is not None:
            with optional(str(csv), kept, passing=(EdesignError,)):
                print(f"{csv}: {len(write_csv_folder(found, facts, csv))} tables, listed in contents.csv")
        if parquet is not None:
            with optional(str(parquet), kept, passing=(EdesignError,)):
                print(f"{parquet}: {len(write_parquet_folder(found, facts, parquet))} tables, listed in contents.csv")
    if damage:
        raise DamagedArchive(f"{damage} [E-ARCH-03]")


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]
