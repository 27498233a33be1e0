"""The sections of the report of a calibration by a property table."""

from __future__ import annotations

from collections.abc import Callable

from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.report.calibration.properties import (
    each_group_table,
    property_calibration_figures,
    property_errors_table,
)
from edesign.report.calibration.tables import effect_tables, law_table
from edesign.report.calibration.verdict import verdict_paragraphs
from edesign.report.calibration.words import searched
from edesign.report.html.section import Part, Section
from edesign.report.page.source import drawn


def _verdict(found: PropertyCalibration) -> Section:
    return Section("verdict", "Verdict", verdict_paragraphs(found), (property_errors_table(found),))


def _effects(found: PropertyCalibration) -> Section:
    text = (f"The search took {searched(found)}.",)
    return Section("effects", "Effects, and how sure they are", text, tuple(effect_tables(found)))


def _residuals(found: PropertyCalibration) -> Section:
    parts = (each_group_table(found), *_pictures(found, "residuals"))
    return Section("residuals", "Residuals before and after", (), parts)


def _properties(found: PropertyCalibration) -> Section:
    return Section("properties", "Properties", (), tuple(_pictures(found, "properties")))


def _law(found: PropertyCalibration) -> Section:
    return Section("law", "Parameters of the law", (), (law_table(found),))


def _pictures(found: PropertyCalibration, name: str) -> list[Part]:
    """Return the figures whose names begin so."""
    every = property_calibration_figures
    return drawn(f"figures of {name}", lambda: (one for one in every(found) if one[0].startswith(name)))


SECTIONS: tuple[Callable[[PropertyCalibration], Section], ...] = (_verdict, _effects, _residuals, _properties, _law)
"""In the order of the page."""
