"""`edesign effects`: what a calibration may find in measured tests."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_csv
from edesign.calibration.effect_list import effects_named, known_effects
from edesign.cli.shared.complete import effect_names
from edesign.report.calibration.known_effects import effect_tables, effects_data, effects_tables, write_effects_csv
from edesign.report.tables.text import print_tables


def effects(
    name: Annotated[
        str | None,
        typer.Argument(
            help="One effect: its forms, their parameters, signature and source.",
            show_default=False,
            autocompletion=effect_names,
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON, units in SI, instead of tables.")] = False,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write a line for each parameter.")] = None,
) -> None:
    """Print the effects that `edesign calibrate` looks for, or the forms and parameters of one."""
    if csv is not None:
        check_csv(csv)
    found = known_effects() if name is None else effects_named(name)
    if as_json:
        print(json.dumps(effects_data(found), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        print_tables(effects_tables(found) if name is None else [one for item in found for one in effect_tables(item)])
    if csv is not None:
        write_effects_csv(found, csv)
