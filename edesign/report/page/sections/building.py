"""The elastic design of a building: verdict, drawings, modes, storeys, rules, members, combinations."""

from __future__ import annotations

from edesign.report.archived import is_building_archive
from edesign.report.building_figures import building_figures
from edesign.report.building_tables import building_tables
from edesign.report.page.section import Section
from edesign.report.page.source import Source


def building(source: Source) -> Section:
    """Return the section of a building; empty for other archives."""
    if not is_building_archive(source.archive):
        return Section("building", "Elastic design", (), ())
    *tables, verdict = building_tables(source.archive)
    return Section("building", "Elastic design", (), (verdict, *source.pictures(building_figures), *tables))
