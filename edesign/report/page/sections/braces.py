"""Braces that buckle."""

from __future__ import annotations

from edesign.report.html.section import Part, Section
from edesign.report.page.source import Source
from edesign.report.response.brace_figures import brace_figures
from edesign.report.response.brace_table import brace_table


def braces(source: Source) -> Section:
    """Return the section on braces that buckle: their extremes, and the loops of those that were recorded."""
    table = brace_table(source.groups)
    tables: list[Part] = [table] if table.rows else []
    parts = (*tables, *source.pictures(brace_figures))
    return Section("braces", "Braces that buckle", (), parts, aside=True)
