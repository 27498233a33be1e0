"""The report of a calibration: one HTML page that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from edesign._version import __version__
from edesign.calibration.results.result import Calibration
from edesign.project.document import Document
from edesign.report.calibration.view import View
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.document import check_page_path, write_html
from edesign.report.page.render import Cover, Page, render
from edesign.report.page.sections.damper_calibration import SECTIONS

NO_DOCUMENT = Document()


def write_calibration_page(
    calibration: Calibration,
    path: Path,
    tell: Callable[[str], None] = lambda line: None,
    document: Document = NO_DOCUMENT,
) -> Path:
    """Write the report of a calibration.

    Args:
        calibration: what was found.
        path: the page, whole or not at all.
        tell: called with a line for each section.
        document: for the cover.

    Returns:
        The page.

    Raises:
        InputError: the page has another ending than that of a page.
        ArchiveError: it cannot be written.
    """
    check_page_path(path)
    return write_html(calibration_page(calibration, tell, document), path)


def calibration_page_text(
    calibration: Calibration,
    tell: Callable[[str], None] = lambda line: None,
    document: Document = NO_DOCUMENT,
) -> str:
    """Return the report as HTML; arguments as `write_calibration_page`."""
    page = calibration_page(calibration, tell, document)
    return render(page.cover, page.sections)


def calibration_page(
    calibration: Calibration,
    tell: Callable[[str], None] = lambda line: None,
    document: Document = NO_DOCUMENT,
) -> Page:
    """Return the report as data; arguments as `write_calibration_page`."""
    view = View(calibration)
    made = []
    for section in SECTIONS:
        found = section(view)
        tell(f"section {found.title}")
        made.append(found)
    tests = calibration.tests
    validated = sum(one.use == "validate" for one in tests)
    cover = Cover(
        title=calibration.title,
        kind="Calibration report",
        about=f"{_model(calibration)} · {len(tests)} tests, {validated} of them for validation · edesign {__version__}",
        origin=f"edesign {__version__}",
        footer=f"Made by edesign {__version__}. All numbers are computed from the measured tests.",
        document=cover_lines(document.said),
    )
    return Page(cover, tuple(section for section in made if section))


def _model(calibration: Calibration) -> str:
    law = f"law {calibration.law}" if calibration.law else ""
    return ", ".join(filter(None, ("building", law))) if calibration.subject == "structure" else law
