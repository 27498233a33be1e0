"""An isolated base: its estimate from the spectra, and its displacement, acceleration and forces in histories."""

from __future__ import annotations

from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_statistics_table, isolation_table
from edesign.report.html.section import Folded, Section
from edesign.report.page.sections.dampers import MANY
from edesign.report.page.source import Source


def isolation(source: Source) -> Section:
    """Return the section on the equivalent linear estimate of each modal analysis, and the base in each history."""
    estimates = [isolation_estimate_table(name, group) for name, group in source.groups.items()]
    ordinary = {name: group for name, group in source.groups.items() if not group.attributes.get("incremental")}
    table, over = isolation_table(ordinary), isolation_statistics_table(source.sets)
    estimates += [over] if source.study is not None else []
    many = len(table.rows) > MANY
    shown = (Folded(f"{table.title}: {len(table.rows)} analyses", (table,)),) if many else (table,) * bool(table.rows)
    return Section("isolation", "Isolated base", (), (*(one for one in estimates if one.rows), *shown))
