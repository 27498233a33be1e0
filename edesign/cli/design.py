"""`edesign design`: sections of a building chosen by the program."""

from __future__ import annotations

import shlex
import time
from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.progress import remaining
from edesign.cli.shared.stages import in_stages
from edesign.cli.shared.streams import progress_line
from edesign.cli.shared.workers import DEFAULT, Workers
from edesign.frame.building_file import load_building
from edesign.optional_stages import optional
from edesign.report.building.tables.selection import selection_tables
from edesign.report.tables.text import print_tables
from edesign.report.tables.visible import visible_line
from edesign.space.selection.search import Line
from edesign.study.run.building import DESIGNED, design_building


def design(
    building: Annotated[Path, typer.Argument(help="The building file.", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="FILE", help=f"The building file to write; by default {DESIGNED} beside it."
        ),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file that is of something else.")] = False,
    workers: Workers = DEFAULT,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no summary.")] = False,
) -> None:
    """Choose the lightest sections that meet all checks, and write the building file with them, and its archive.

    The lists of sections are those of `design: select` in the file.
    """
    began = time.monotonic()

    def progress(line: str) -> None:
        if not quiet:
            share = line.share if isinstance(line, Line) else 0.0
            # later starts take less: they know what those before them found
            left = remaining((time.monotonic() - began) * (1.0 / share - 1.0), ", at most ") if share else ""
            progress_line(visible_line(line) + (f"; {share:.0%} done{left}" if left else ""))

    read = load_building(building)
    path, archive, found = in_stages(lambda stage: design_building(read, output, overwrite, workers, progress), quiet)
    if not quiet:
        with optional("the tables", f"{path} and {archive} are written"):
            print_tables(selection_tables(found))
        print(f"{path} and {archive} written. Next: edesign report {shlex.quote(str(archive))}")
