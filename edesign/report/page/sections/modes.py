"""Natural modes: periods, effective masses, shapes, and what dampers add to them."""

from __future__ import annotations

from edesign.report.html.section import Folded, Section
from edesign.report.page.source import Source
from edesign.report.response.analysis_tables import periods_table
from edesign.report.response.damper_results import damper_stiffness_table
from edesign.report.response.mode_figures import mode_figures


def modes(source: Source) -> Section:
    """Return the section on periods and shapes of each modal analysis, with the stiffness of dampers in them.

    Analyses with the same periods, as of variants whose dampers have no stiffness, share a table.
    """
    alike: dict[str, list[str]] = {}
    for name, group in source.groups.items():
        if "period" in group.variables:
            table = periods_table("", group)
            alike.setdefault(repr((table.texts, table.notes)), []).append(name)
    tables = [periods_table("; ".join(names), source.groups[names[0]]) for names in alike.values()]
    dampers = {name: damper_stiffness_table(name, group) for name, group in source.groups.items()}
    title = "Stiffness and loss factor of the dampers"
    folded = tuple(Folded(f"{title}, {name}", (table,)) for name, table in dampers.items() if table.rows)
    return Section("modes", "Natural modes", (), (*source.pictures(mode_figures), *tables, *folded))
