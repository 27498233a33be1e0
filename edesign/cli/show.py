"""`edesign show`: what an archive holds."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer


def show(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
    analysis: Annotated[
        str | None, typer.Option("--analysis", "-n", metavar="NAME", help="Details of one analysis only.")
    ] = None,
) -> None:
    """Print the analyses of an archive, their response measures and statistics."""
    from edesign.report.summary import summarise
    from edesign.report.tables import details, overview
    from edesign.report.text import print_tables

    if as_json:
        typer.echo(json.dumps(summarise(archive, analysis), indent=2, allow_nan=False, ensure_ascii=False))
    elif analysis is not None:
        print_tables(details(archive, analysis))
    else:
        print_tables(overview(archive))
