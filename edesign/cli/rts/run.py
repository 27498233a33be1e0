"""`edesign rts run`: virtual tests into an archive."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.rts.tests_file import load_tests
from edesign.cli.shared.streams import progress_line
from edesign.errors import AnalysisError
from edesign.optional_stages import earlier, optional
from edesign.report.archive.document import default_page_path, write_page
from edesign.report.archive.tables import overview
from edesign.report.tables.text import print_tables
from edesign.report.tables.visible import visible_line
from edesign.substructure.run import run_tests

File = Annotated[Path, typer.Argument(help="The file of substructure tests.", show_default=False)]


def run(
    file: File,
    archive: Annotated[
        Path | None, typer.Option("--archive", "-a", help="Where to write; by default what the file says.")
    ] = None,
    csv: Annotated[
        Path | None, typer.Option("--csv", metavar="DIR", help="Write each run as a CSV file there as well.")
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace the archive of something else.")] = False,
    check: Annotated[bool, typer.Option("--check", help="Exit with 3 if a response is too wrong.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no summary.")] = False,
    report: Annotated[
        bool, typer.Option("--report", help="Write the report too, one HTML page beside the archive.")
    ] = False,
) -> None:
    """Run the virtual tests of a file with all its compensators, archive them, and print a summary."""
    tests = load_tests(file)

    def progress(line: str) -> None:
        if not quiet:
            progress_line(f"{visible_line(line)} ...")

    path, found, others = run_tests(tests, archive, overwrite, progress, csv)
    page = None
    if report:
        with optional("the report", f"the results are in {path}{earlier(default_page_path(path))}"):
            page = write_page(path)
    if not quiet:
        with optional("the tables", f"the results are in {path}"):
            print_tables(overview(path))
        print(f"archive: {path}")
        if page is not None:
            print(f"report: {page}")
    bad = [
        f"{one.test}, {one.compensator}"
        for results in found
        for one in results.runs
        if one.outcome != "done" or one.response_error > tests.criteria.response_error
    ]
    bad += [
        one.name
        for one in others
        if one.outcome != "done" or one.record is None or one.record.response_error > tests.criteria.response_error
    ]
    if check and bad:
        raise AnalysisError(
            f"{file}: {len(bad)} runs are unstable, saturated or too wrong ({'; '.join(bad)}); all are in {path}"
            " [E-RUN-03]"
        )
