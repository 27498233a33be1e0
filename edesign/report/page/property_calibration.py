"""The report of a calibration by a property table: its sections and cover."""

from __future__ import annotations

from collections.abc import Iterator

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
from edesign.report.page.cover_facts import cover_lines
from edesign.report.page.render import Cover, Page
from edesign.report.page.section import Picture, Section
from edesign.report.page.source import picture_of


def property_calibration_page(calibration: PropertyCalibration) -> Page:
    """Return the report as data."""
    campaign, found = calibration.campaign, calibration.found
    pictures = dict(_pictures(calibration))
    residuals = tuple(picture for name, picture in pictures.items() if name.startswith("residuals"))
    properties = tuple(picture for name, picture in pictures.items() if name.startswith("properties"))
    sections = (
        Section("verdict", "Verdict", verdict_paragraphs(found), (property_errors_table(calibration),)),
        Section(
            "effects",
            "Effects, and how sure they are",
            (f"The search took {searched(found)}.",),
            tuple(property_effect_tables(calibration)),
        ),
        Section("residuals", "Residuals before and after", (), (each_group_table(calibration), *residuals)),
        Section("properties", "Properties", (), properties),
        Section("law", "Parameters of the law", (), (law_table(found),)),
    )
    cover = Cover(
        title=found.title,
        kind="Calibration report",
        about=f"law {found.law} · {len(campaign.table)} rows of a property table · edesign {__version__}",
        origin=f"edesign {__version__}",
        footer=f"Made by edesign {__version__}. All numbers are computed from the measured properties.",
        document=cover_lines(campaign.document.said),
    )
    return Page(cover, tuple(section for section in sections if section))


def _pictures(calibration: PropertyCalibration) -> Iterator[tuple[str, Picture]]:
    for name, caption, figure in property_calibration_figures(calibration):
        yield name, picture_of(name, caption, figure)
