"""Plastic hinges in the frame, axial forces of its columns, and footings under them."""

from __future__ import annotations

from edesign.report.html.section import Section
from edesign.report.page.source import Source, headed
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.frame_figures import frame_figures
from edesign.report.response.ground_tables import ground_tables
from edesign.report.response.hinge_tables import hinge_tables


def hinges(source: Source) -> Section:
    """Return the section on yielding members, hinges, joints, axial forces of columns, and supports, level by level."""
    pictures = source.pictures(frame_figures, axial_figures)
    tables = (*hinge_tables(source.groups), *ground_tables(source.groups))
    return Section("hinges", "Plastic hinges and columns", (), (*tables, *headed(pictures, source.levels)))
