"""Peak response: profiles over the height, statistics of all measures, and the measures of each record."""

from __future__ import annotations

from edesign.report.archive_tables import measures_table
from edesign.report.assessment.measure_tables import record_measures_table, statistics_tables
from edesign.report.page.section import Folded, Part, Section
from edesign.report.page.source import Source, headed
from edesign.report.response.profile_figures import profile_figures

SHOWN = 2  # tables of statistics, mean and maximum as in thesis Tables 5.8 and 5.9; the others on demand


def response(source: Source) -> Section:
    """What the frame did at each hazard level with and without dampers."""
    sets = [found for found in source.sets if found.completed]
    parts: list[Part] = []
    if sets:
        tables = statistics_tables(source.sets)
        parts += tables[:SHOWN]
        if tables[SHOWN:]:
            parts.append(Folded("Median, and 84 % percentile", tuple(tables[SHOWN:])))
        each = tuple(record_measures_table(found) for found in sets)
        parts.append(Folded("Response measures of each record", each))
    else:
        table = measures_table(source.entries)
        parts += [table] if table.rows else []
    parts += headed(source.pictures(profile_figures), source.levels)
    return Section("response", "Peak response", (), tuple(parts))
