"""Moment against rotation of the recorded members."""

from __future__ import annotations

from edesign.report.html.section import Section
from edesign.report.page.source import Source, headed
from edesign.report.response.moment_rotation_figures import moment_rotation_figures


def moment_rotation(source: Source) -> Section:
    """Return the section with the loops of both ends of each recorded member, variants overlaid."""
    pictures = source.pictures(moment_rotation_figures)
    return Section("moment-rotation", "Moment and rotation", (), tuple(headed(pictures, source.levels)), aside=True)
