"""`edesign calibrate`: what a damper law or the model of a structure lacks, found in measured tests."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from edesign.cli.shared.pdf_options import PaperOption, print_options
from edesign.cli.shared.streams import progress_line
from edesign.optional_stages import earlier, optional

if TYPE_CHECKING:
    from edesign.calibration.search.settings import SearchSettings
    from edesign.report.html.render import Page
    from edesign.report.pdf.paper import PrintOptions
    from edesign.report.tables.table import Table


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
    workers: Annotated[
        int, typer.Option("--workers", "-w", min=1, help="Threads of predictions; results do not depend on it.")
    ] = 2,
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
    from edesign.errors import Interrupted
    from edesign.report.tables.text import filled, print_tables, told

    folder = campaign.parent if output is None else output
    options = print_options(pdf, paper, appendix=False)
    try_folder(folder)  # rather than after the search
    if pdf:
        from edesign.report.pdf.document import check_pdf_engine

        check_pdf_engine()
    begin = time.monotonic()

    def tell(what: str) -> None:
        if not quiet:
            progress_line(told(f"{time.monotonic() - begin:6.1f} s  ", what, sys.stderr))

    tell("reading the tests")
    found = _run(campaign, _Search(workers, tell, effort, folder, overwrite))
    written = found.write(folder)
    kept = f"what was found is in {folder}"
    pages = [name for name, asked in (("calibration.html", page), ("calibration.pdf", pdf)) if asked]
    if pages:
        tell("drawing the report")
        with optional("the report", kept + earlier(*(folder / name for name in pages))):
            written += _reports(found.report(), folder, page, options if pdf else None)
    if json_output:
        print(json.dumps(found.json(), indent=1, allow_nan=False))
    elif not quiet:
        with optional("the tables", kept):
            print_tables(found.tables())
        with optional("the verdict", kept):
            for paragraph in found.verdict().splitlines():
                print(f"\n{filled(paragraph)}")
        print()
        for path in written:
            print(f"written: {path}")
    if found.interrupted:
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


@dataclass(frozen=True)
class _Search:
    """What is asked of a search."""

    workers: int
    tell: Callable[[str], None]
    effort: float | None
    folder: Path
    overwrite: bool

    @property
    def settings(self) -> SearchSettings:
        """Numbers of the search."""
        from dataclasses import replace

        from edesign.calibration.search.settings import SETTINGS

        return SETTINGS if self.effort is None else replace(SETTINGS, effort=self.effort)


@dataclass(frozen=True)
class _Found:
    """What may be asked of a calibration, whatever the tests are of."""

    write: Callable[[Path], list[Path]]
    report: Callable[[], Page]
    json: Callable[[], dict[str, Any]]
    tables: Callable[[], list[Table]]
    verdict: Callable[[], str]
    interrupted: bool


def _run(campaign: Path, search: _Search) -> _Found:
    """Calibrate with the tests of a damper, the records of a structure, or the rows of a property table."""
    from edesign.calibration.properties.campaign import is_property_campaign
    from edesign.calibration.structures.campaign import is_structure_campaign

    if is_property_campaign(campaign):
        return _properties(campaign, search)
    return _structure(campaign, search) if is_structure_campaign(campaign) else _damper(campaign, search)


def _damper(campaign: Path, search: _Search) -> _Found:
    from edesign.calibration.results.write import calibration_json, check_files, write_files
    from edesign.calibration.run import calibrate as run
    from edesign.damper.testing.campaign import load_campaign
    from edesign.damper.testing.clipping import clipping_notes
    from edesign.report.calibration.tables import tables_of
    from edesign.report.calibration.verdict import verdict_text
    from edesign.report.page.calibration import calibration_page

    loaded = load_campaign(campaign)
    for note in (*loaded.notes, *clipping_notes(loaded.tests)):
        search.tell(note)
    check_files(campaign, loaded.label, search.folder, search.overwrite)
    found = run(loaded, search.settings, search.workers, search.tell)
    return _Found(
        lambda folder: write_files(found, loaded, folder),
        lambda: calibration_page(found, document=loaded.document),
        lambda: calibration_json(found),
        lambda: tables_of(found),
        lambda: verdict_text(found),
        found.ending == "interrupted",
    )


def _structure(campaign: Path, search: _Search) -> _Found:
    from edesign.calibration.results.write import calibration_json, check_files, write_calibration
    from edesign.calibration.structures.campaign import load_structure_campaign
    from edesign.calibration.structures.corrected import FILES, corrected_texts
    from edesign.calibration.structures.run import calibrate_structure
    from edesign.report.calibration.tables import tables_of
    from edesign.report.calibration.verdict import verdict_text
    from edesign.report.page.calibration import calibration_page

    loaded = load_structure_campaign(campaign)
    check_files(campaign, loaded.title or loaded.name, search.folder, search.overwrite, FILES)
    found = calibrate_structure(loaded, search.settings, search.workers, search.tell)
    texts = partial(corrected_texts, found, loaded)
    return _Found(
        lambda folder: write_calibration(found, loaded.path, loaded.text, texts, folder),
        lambda: calibration_page(found, document=loaded.document),
        lambda: calibration_json(found),
        lambda: tables_of(found),
        lambda: verdict_text(found),
        found.ending == "interrupted",
    )


def _properties(campaign: Path, search: _Search) -> _Found:
    from edesign.calibration.properties.campaign import load_property_campaign
    from edesign.calibration.properties.run import calibrate_properties
    from edesign.calibration.properties.write import property_calibration_json, write_property_files
    from edesign.calibration.results.write import check_files
    from edesign.report.calibration.properties import property_tables
    from edesign.report.calibration.verdict import verdict_text
    from edesign.report.page.property_calibration import property_calibration_page

    loaded = load_property_campaign(campaign)
    check_files(campaign, loaded.title or loaded.specimen.name, search.folder, search.overwrite)
    found = calibrate_properties(loaded, search.settings, search.workers, search.tell)
    return _Found(
        lambda folder: write_property_files(found, folder),
        lambda: property_calibration_page(found),
        lambda: property_calibration_json(found),
        lambda: property_tables(found),
        lambda: verdict_text(found.found),
        found.found.ending == "interrupted",
    )
