"""How dampers were designed: sizes over the height, the damping they add, rounds of the design, bounds."""

from __future__ import annotations

from edesign.report.design.designs_tables import designs_tables
from edesign.report.design.device_order import LARGEST
from edesign.report.design.figures import design_figures
from edesign.report.html.section import Folded, Section
from edesign.report.page.source import Source


def design(source: Source) -> Section:
    """Return the section on the designs: sizes, added damping, rounds, bounds, and devices to order."""
    tables = designs_tables(source.archive, source.study, source.sets)
    parts = [
        Folded(f"{one.title} ({len(one.rows)} rows)", (one,)) if one.title.startswith(LARGEST) else one
        for one in tables
    ]
    return Section("design", "Design of the dampers", (), (*parts, *source.pictures(design_figures)))
