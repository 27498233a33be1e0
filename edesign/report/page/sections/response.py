"""Peak response: profiles over the height, statistics of all measures, and the measures of each record."""

from __future__ import annotations

from edesign.assess.sets import HistorySet
from edesign.report.archived import archived_frame, archived_hazard
from edesign.report.assessment.change_tables import changes_table
from edesign.report.assessment.measure_tables import record_measures_table, statistics_tables
from edesign.report.building.elastic_uses import elastic_uses
from edesign.report.drawing.captions import at_level
from edesign.report.html.section import Folded, Part, Section
from edesign.report.model.force_envelopes import force_envelopes
from edesign.report.page.source import Source, by_level, level_heading
from edesign.report.response.analysis_tables import measures_table
from edesign.report.response.interaction_figures import interaction_figures
from edesign.report.response.mean_profiles import mean_profile_figures
from edesign.report.response.orbits import orbit_figures
from edesign.report.response.profile_figures import profile_figures
from edesign.report.response.support_tables import support_tables
from edesign.report.response.torsion_tables import torsion_tables
from edesign.report.response.use_tables import use_tables

SHOWN = 2  # tables of statistics, mean and maximum; the others on demand


def response(source: Source) -> Section:
    """Return the section on the response at each hazard level with and without dampers."""
    sets = [found for found in source.sets if found.completed]
    parts: list[Part] = []
    if sets:
        tables = statistics_tables(source.sets)
        parts += tables[:SHOWN]
        changes = changes_table(source.sets)
        parts += [changes] if changes.rows else []
        if tables[SHOWN:]:
            parts.append(Folded("Median, and 84 % percentile", tuple(tables[SHOWN:])))
        each = tuple(record_measures_table(found) for found in sets)
        parts.append(Folded("Response measures of each record", each))
    else:
        table = measures_table(source.entries)
        parts += [table] if table.rows else []
    parts += torsion_tables(sets)
    parts += _members(source, sets)
    parts += source.pictures(interaction_figures)
    if forces := source.pictures(force_envelopes):
        parts.append(Folded(f"Axial force, shear and moment along members ({len(forces)})", forces))
    parts += _profiles(source)
    orbits = source.pictures(orbit_figures)
    parts += [Folded("Orbits in plan", orbits)] if len(orbits) > 1 else orbits
    return Section("response", "Peak response", (), tuple(parts))


def _members(source: Source, sets: list[HistorySet]) -> list[Part]:
    """Return how far members are used, the worst of each storey and all beyond 1, and the reactions of supports."""
    hazard, frame = archived_hazard(source.archive), archived_frame(source.archive)
    design = None if frame is None else frame.design
    uses = tuple(use_tables(sets, hazard, frame, elastic_uses(source.archive)))
    parts: list[Part] = []
    for said, tables in (
        ("Use of columns, beams and braces, of each storey and beyond 1", uses),
        ("Reactions of supports for foundations", tuple(support_tables(sets, hazard, design))),
    ):
        parts += [Folded(said, tables)] if tables else []
    return parts


def _profiles(source: Source) -> list[Part]:
    """Return the mean profiles of all variants at each level, with every record folded; of one variant its records."""
    over = by_level(source.pictures(mean_profile_figures), source.levels)
    single = by_level(source.pictures(profile_figures), source.levels)
    parts: list[Part] = []
    for level, pictures in single.items():
        parts += [level_heading(level, source.levels)] if len(single) > 1 else []
        if level in over:
            said = f"Profiles of every record{at_level(level)} ({len(pictures)})"
            parts += [*over[level], Folded(said, tuple(pictures))]
        else:
            parts += pictures
    return parts
