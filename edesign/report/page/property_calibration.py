"""The report of a calibration by a property table: its sections and cover."""

from __future__ import annotations

from functools import partial

from edesign._version import __version__
from edesign.calibration.properties.run import PropertyCalibration
from edesign.report.calibration.properties import (
    each_group_table,
    property_calibration_figures,
    property_effect_tables,
    property_errors_table,
)
from edesign.report.calibration.tables import law_table
from edesign.report.calibration.verdict import verdict_paragraphs
from edesign.report.calibration.words import searched
from edesign.report.html.render import Cover, Page
from edesign.report.html.section import Part, Section, made
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.source import drawn


def property_calibration_page(calibration: PropertyCalibration) -> Page:
    """Return the report as data."""
    campaign, found = calibration.campaign, calibration.found
    sections = [made(section.__name__, partial(section, calibration)) for section in _SECTIONS]
    cover = Cover(
        title=found.title,
        kind="Calibration report",
        about=f"law {found.law} · {len(campaign.table)} rows of a property table · edesign {__version__}",
        origin=f"edesign {__version__}",
        footer=f"Made by edesign {__version__}. All numbers are computed from the measured properties.",
        document=cover_lines(campaign.document.said),
    )
    return Page(cover, tuple(section for section in sections if section))


def _verdict(calibration: PropertyCalibration) -> Section:
    errors = property_errors_table(calibration)
    return Section("verdict", "Verdict", verdict_paragraphs(calibration.found), (errors,))


def _effects(calibration: PropertyCalibration) -> Section:
    text = (f"The search took {searched(calibration.found)}.",)
    return Section("effects", "Effects, and how sure they are", text, tuple(property_effect_tables(calibration)))


def _residuals(calibration: PropertyCalibration) -> Section:
    parts = (each_group_table(calibration), *_pictures(calibration, "residuals"))
    return Section("residuals", "Residuals before and after", (), parts)


def _properties(calibration: PropertyCalibration) -> Section:
    return Section("properties", "Properties", (), tuple(_pictures(calibration, "properties")))


def _law(calibration: PropertyCalibration) -> Section:
    return Section("law", "Parameters of the law", (), (law_table(calibration.found),))


def _pictures(calibration: PropertyCalibration, name: str) -> list[Part]:
    """Return the figures whose names begin so."""
    every = property_calibration_figures
    return drawn(f"figures of {name}", lambda: (one for one in every(calibration) if one[0].startswith(name)))


_SECTIONS = (_verdict, _effects, _residuals, _properties, _law)
