"""The same motion with dampers at different temperatures."""

from __future__ import annotations

from edesign.report.html.section import Section
from edesign.report.page.source import Source
from edesign.report.response.temperature_figures import temperature_figures


def temperature(source: Source) -> Section:
    """Return the section on histories with warmer or colder dampers, over those at the variant's own temperature."""
    return Section("temperature", "Effect of temperature", (), source.pictures(temperature_figures))
