"""`edesign sections`: rolled and hollow sections with their properties."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_csv
from edesign.cli.shared.complete import section_names
from edesign.report.building.tables.sections import chosen_sections, section_data, section_tables, write_sections
from edesign.report.tables.text import print_tables


def sections(
    what: Annotated[
        str | None,
        typer.Argument(
            metavar="[FAMILY|NAME|PATTERN]",
            help="HEB, HE (all that begin so), SHS, CHS, L, IPN, UPN, a name as you write it, or a pattern such as "
            "'UB457*' or 'SHS160*'; without it all rolled I sections of parallel flanges.",
            show_default=False,
            autocompletion=section_names,
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of a table.")] = False,
    csv: Annotated[Path | None, typer.Option("--csv", metavar="FILE", help="Write the table.")] = None,
) -> None:
    """Print the sections that a file may name, with their properties.

    Hollow ones of any size are printed by their name.
    """
    if csv is not None:
        check_csv(csv)
    found = chosen_sections(what)
    if as_json:
        print(json.dumps(section_data(found), indent=2, allow_nan=False, ensure_ascii=False))
    else:
        print_tables(section_tables(found))
    if csv is not None:
        write_sections(found, csv)
