"""Dampers: their largest strain, deformation, force and work, strengths of buckling-restrained braces, and loops."""

from __future__ import annotations

from edesign.report.html.section import Folded, Section
from edesign.report.page.source import Source, headed
from edesign.report.response.damper_loops import damper_figures
from edesign.report.response.damper_results import dampers_table
from edesign.report.response.restrained_braces import restrained_tables

MANY = 24  # rows, from which a table is folded
ONE_SET = 4  # tables of buckling-restrained braces; of several sets all are folded


def dampers(source: Source) -> Section:
    """Return the section on the demand on dampers in each history, with force against deformation where it was kept."""
    ordinary = {name: group for name, group in source.groups.items() if not group.attributes.get("incremental")}
    table = dampers_table(ordinary)
    if not table.rows:
        return Section("dampers", "Dampers")
    shown = Folded(f"{table.title}: {len(table.rows)} analyses", (table,)) if len(table.rows) > MANY else table
    tables = restrained_tables(ordinary)
    several = len(tables) > ONE_SET
    braces = [Folded(t.title, (t,)) if several or len(t.rows) > MANY else t for t in tables]
    loops = headed(source.pictures(damper_figures), source.levels)
    return Section("dampers", "Dampers", (), (shown, *braces, *loops), aside=True)
