"""How dampers were designed: rounds of the design, sizes over the height."""

from __future__ import annotations

from edesign.report.design_figures import design_figures
from edesign.report.page.section import Section
from edesign.report.page.source import Source


def design(source: Source) -> Section:
    """The rounds of each design, and the sizes that came of it."""
    return Section("design", "Design of the dampers", (), source.pictures(design_figures))
