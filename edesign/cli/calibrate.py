"""`edesign calibrate`: what a damper law or the model of a structure lacks, found in measured tests."""

from __future__ import annotations

import json
import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from edesign.cli.shared.pdf_options import PaperOption, print_options
from edesign.cli.shared.streams import progress_line
from edesign.cli.shared.workers import DEFAULT, Workers
from edesign.optional_stages import earlier, optional

if TYPE_CHECKING:
    from edesign.report.html.render import Page
    from edesign.report.pdf.paper import PrintOptions


def calibrate(
    campaign: Annotated[Path, typer.Argument(metavar="CAMPAIGN", help="Campaign file (.yaml).", show_default=False)],
    output: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", "--out", metavar="DIR", help="Where the files go; the folder of the campaign if not said."
        ),
    ] = None,
    page: Annotated[bool, typer.Option("--page/--no-page", help="Write calibration.html.")] = True,
    pdf: Annotated[bool, typer.Option("--pdf", help="Write the report as calibration.pdf too.")] = False,
    paper: PaperOption = None,
    json_output: Annotated[bool, typer.Option("--json", help="Print calibration.json instead of tables.")] = False,
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Replace laws and results that are not of this campaign.")
    ] = False,
    workers: Workers = DEFAULT,
    effort: Annotated[
        float | None,
        typer.Option(
            "--effort",
            "-e",
            min=1.0,
            help="Predictions of all tests, weighted by what effects cost, after which the search "
            "ends unfinished. The same on every machine; 10 000 if not said.",
            show_default=False,
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="No progress and no tables.")] = False,
) -> None:
    """Predict measured tests, find what the law or structure lacks, add it, and report errors before and after."""
    from edesign.archive.files import try_folder
    from edesign.calibration.campaign import load_campaign
    from edesign.calibration.run import calibrate as run
    from edesign.calibration.run import notes_of
    from edesign.calibration.search.settings import SETTINGS
    from edesign.calibration.write import calibration_json, check_files, write_files
    from edesign.errors import Interrupted
    from edesign.report.calibration.tables import tables_of
    from edesign.report.calibration.verdict import verdict_text
    from edesign.report.page.calibration import calibration_page
    from edesign.report.tables.text import filled, print_tables, progress_text

    folder = campaign.parent if output is None else output
    options = print_options(pdf, paper, appendix=False)
    try_folder(folder)  # rather than after the search
    if pdf:
        from edesign.report.pdf.document import check_pdf_engine

        check_pdf_engine()
    begin = time.monotonic()

    def progress(what: str) -> None:
        if not quiet:
            progress_line(progress_text(f"{time.monotonic() - begin:6.1f} s  ", what, sys.stderr))

    progress("reading the tests")
    loaded = load_campaign(campaign)
    for note in notes_of(loaded):
        progress(note)
    check_files(loaded, folder, overwrite)
    settings = SETTINGS if effort is None else replace(SETTINGS, effort=effort)
    found = run(loaded, settings, workers, progress)
    written = write_files(found, folder)
    kept = f"what was found is in {folder}"
    pages = [name for name, asked in (("calibration.html", page), ("calibration.pdf", pdf)) if asked]
    if pages:
        progress("drawing the report")
        with optional("the report", kept + earlier(*(folder / name for name in pages))):
            written += _reports(calibration_page(found), folder, page, options if pdf else None)
    if json_output:
        print(json.dumps(calibration_json(found), indent=1, allow_nan=False))
    elif not quiet:
        with optional("the tables", kept):
            print_tables(tables_of(found))
        with optional("the verdict", kept):
            for paragraph in verdict_text(found).splitlines():
                print(f"\n{filled(paragraph)}")
        print()
        for path in written:
            print(f"written: {path}")
    if found.ending == "interrupted":
        raise Interrupted(f"the search was interrupted; what it had found is in {folder}")


def _reports(report: Page, folder: Path, page: bool, pdf: PrintOptions | None) -> list[Path]:
    """Write a report as a page, a PDF or both, of which one does without the other."""
    from edesign.report.archive.document import write_html
    from edesign.report.pdf.document import write_page_as_pdf

    written = []
    if page:
        with optional("calibration.html", f"results are in {folder}{earlier(folder / 'calibration.html')}"):
            written.append(write_html(report, folder / "calibration.html"))
    if pdf is not None:
        with optional("calibration.pdf", f"results are in {folder}{earlier(folder / 'calibration.pdf')}"):
            written.append(write_page_as_pdf(report, folder / "calibration.pdf", options=pdf))
    return written
