"""The report of a calibration: one HTML page that needs nothing beside it."""

from __future__ import annotations

from functools import partial

from edesign._version import __version__
from edesign.calibration.results.result import Calibration
from edesign.project.document import Document
from edesign.report.calibration.view import View
from edesign.report.html.render import Cover, Page
from edesign.report.html.section import made
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.sections.calibration import SECTIONS

NO_DOCUMENT = Document()


def calibration_page(calibration: Calibration, document: Document = NO_DOCUMENT) -> Page:
    """Return the report of a calibration as data.

    Args:
        calibration: what was found.
        document: for the cover.
    """
    view = View(calibration)
    sections = tuple(found for section in SECTIONS if (found := made(section.__name__, partial(section, view))))
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
    return Page(cover, sections)


def _model(calibration: Calibration) -> str:
    law = f"law {calibration.law}" if calibration.law else ""
    return ", ".join(filter(None, ("building", law))) if calibration.subject == "structure" else law
