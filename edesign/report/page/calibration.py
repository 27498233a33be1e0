"""The report of a calibration: one HTML page that needs nothing beside it."""

from __future__ import annotations

from functools import partial

from edesign._version import __version__
from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.results.result import Calibration
from edesign.report.calibration.view import View
from edesign.report.html.render import Cover, Page
from edesign.report.html.section import made
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.sections import calibration as sections_of_tests
from edesign.report.page.sections import property_calibration as sections_of_tables


def calibration_page(calibration: Calibration) -> Page:
    """Return the report of a calibration as data."""
    if isinstance(calibration, PropertyCalibration):
        makers = [(section.__name__, partial(section, calibration)) for section in sections_of_tables.SECTIONS]
        tested, measured = f"{len(calibration.campaign.table)} rows of a property table", "properties"
    else:
        view = View(calibration)
        makers = [(section.__name__, partial(section, view)) for section in sections_of_tests.SECTIONS]
        validated = sum(one.use == "validate" for one in calibration.tests)
        tested, measured = f"{len(calibration.tests)} tests, {validated} of them for validation", "tests"
    cover = Cover(
        title=calibration.title,
        kind="Calibration report",
        about=f"{_model(calibration)} · {tested} · edesign {__version__}",
        origin=f"edesign {__version__}",
        footer=f"Made by edesign {__version__}. All numbers are computed from the measured {measured}.",
        document=cover_lines(calibration.campaign.document.said),
    )
    return Page(cover, tuple(found for name, make in makers if (found := made(name, make))))


def _model(calibration: Calibration) -> str:
    law = f"law {calibration.law}" if calibration.law else ""
    return ", ".join(filter(None, ("building", law))) if calibration.subject == "structure" else law
