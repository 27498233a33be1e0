"""`edesign show`: what an archive holds."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Annotated

import typer


def show(
    archive: Annotated[Path, typer.Argument(help="The archive, complete or partial.", show_default=False)],
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON in SI units instead of tables.")] = False,
    analysis: Annotated[
        str | None, typer.Option("--analysis", "-n", metavar="NAME", help="Details of one analysis only.")
    ] = None,
    figures: Annotated[
        Path | None, typer.Option("--figures", metavar="DIR", help="Draw records, their spectra, and loops of dampers.")
    ] = None,
    figure_format: Annotated[str, typer.Option("--format", help="Of the figures: svg, png, pdf.")] = "svg",
) -> None:
    """Print the records and analyses of an archive, response measures and statistics."""
    from edesign.report.archive_figures import check_format, draw_figures
    from edesign.report.summary import summarise
    from edesign.report.tables import details, overview
    from edesign.report.text import print_tables

    check_format(figure_format)
    if as_json:
        print(json.dumps(summarise(archive, analysis), indent=2, allow_nan=False, ensure_ascii=False))
    elif analysis is not None:
        print_tables(details(archive, analysis))
    else:
        print_tables(overview(archive))
    if figures is not None and not draw_figures(archive, figures, figure_format):
        nothing = "nothing to draw: no record is fitted or of a suite, and no history of dampers was kept"
        print(nothing, file=sys.stderr, flush=True)
