"""The tables of a project's analyses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.sets import HistorySet, history_sets
from edesign.errors import EdesignError
from edesign.project.actions.hazard_base import Hazard
from edesign.project.project import Project
from edesign.report.archive_view import all_results, entry, input_warnings
from edesign.report.archived import archived_base, archived_frame, archived_hazard
from edesign.report.building.elastic_uses import elastic_uses
from edesign.report.capacity.pushover_tables import target_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_table
from edesign.report.ground_motion.record_tables import tables_of
from edesign.report.inputs.steel_list import steel_tables
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.response.analysis_tables import analyses_table, measures_table, periods_table, statistics_table
from edesign.report.response.damper_results import dampers_table
from edesign.report.response.ground_tables import ground_tables
from edesign.report.response.restrained_braces import restrained_tables
from edesign.report.response.support_tables import support_tables
from edesign.report.response.torsion_tables import torsion_tables
from edesign.report.response.use_tables import use_in_short, use_tables
from edesign.report.tables.table import Table
from edesign.study.results.warnings import warning_lines


def project_tables(archive: Archive) -> list[Table]:
    """Return the tables of all analyses of an archive: ends, periods, response measures, statistics.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the project that it holds is not one of this version.
    """
    groups = all_results(archive)
    entries = [entry(name, group) for name, group in groups.items()]
    kinds = {item["kind"] for item in entries}
    tables: list[Table] = [warnings_table(archive, groups), *tables_of(archive), analyses_table(entries)]
    tables += [periods_table(name, group) for name, group in groups.items() if "period" in group.variables]
    tables += target_tables(archived_base(archive) if "target" in kinds else None, groups)
    tables += [isolation_estimate_table(name, group) for name, group in groups.items()]
    tables += [measures_table(entries), isolation_table(groups), dampers_table(groups), *restrained_tables(groups)]
    tables += ground_tables(groups)
    tables += torsion_tables(history_sets(groups))
    tables += member_tables(archive, history_sets(groups), archived_hazard(archive))
    tables.append(statistics_table(entries))
    tables += _steel(archive)
    return [table for table in tables if table.rows or table.notes]


def _steel(archive: Archive) -> list[Table]:
    """The steel list of a plane frame; none where the text of its project cannot be read."""
    try:
        base = archived_base(archive)
        return steel_tables(VariantFrames(archive, base)) if isinstance(base, Project) else []
    except EdesignError:
        return []


def member_tables(archive: Archive, sets: Sequence[HistorySet], hazard: Hazard | None) -> list[Table]:
    """Return the tables of what the forces of histories do to members and supports."""
    frame = archived_frame(archive)
    uses = use_tables(sets, hazard, frame, elastic_uses(archive))
    return [
        use_in_short(sets, hazard, frame),
        *uses,
        *support_tables(sets, hazard, None if frame is None else frame.design),
    ]


def warnings_table(archive: Archive, groups: Mapping[str, Group] | None = None) -> Table:
    """Return the warnings about the input and about results of the given analyses, as a table without columns.

    Args:
        groups: results of analyses by name, whose warnings the table has too; None: none.
    """
    return Table("Warnings", notes=[*input_warnings(archive), *warning_lines(groups or {})], name="warnings")
