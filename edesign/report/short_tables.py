"""The tables that a run ends with, and that `edesign show` prints without `--all`: verdicts, means, what governs."""

from __future__ import annotations

from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.criteria import judge
from edesign.assess.sets import history_sets
from edesign.errors import EdesignError
from edesign.project.study.study import Study
from edesign.report.archive_tables import (
    KINDS,
    analyses_table,
    heading,
    overview,
    periods_table,
)
from edesign.report.archived import (
    archived_project,
    archived_study,
    is_building_archive,
    is_study_archive,
    is_substructure_archive,
)
from edesign.report.assessment.derived_results import not_swept
from edesign.report.assessment.derived_tables import derived_tables
from edesign.report.assessment.measure_columns import MEASURE_ROWS, ROUNDING
from edesign.report.assessment.measure_tables import MAIN, means_tables
from edesign.report.assessment.study_tables import designs_tables
from edesign.report.assessment.tables import read_histories, read_judged
from edesign.report.assessment.verdicts_in_short import verdicts_in_short
from edesign.report.capacity.incremental_tables import incremental_tables
from edesign.report.capacity.pushover_tables import target_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_statistics_table, isolation_table
from edesign.report.ground_motion.record_tables import tables_of
from edesign.report.response.damper_results import dampers_table
from edesign.report.response.ground_tables import first_mode_table
from edesign.report.summary import all_results, design_warnings, ending, entry, input_warnings
from edesign.report.tables.table import Table, number
from edesign.study.check.warnings import warning_lines
from edesign.study.run.outcome import COMPLETED

WARNINGS_SHOWN = 3
FAILED_SHOWN = 5
PERIODS_SHOWN = 3


def short_tables(archive: Archive) -> list[Table]:
    """Return the main tables of an archive: verdicts, means of the main measures, and governing histories.

    Of a damaged study whose text cannot be read, they are the tables of its analyses.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    if is_substructure_archive(archive):
        return overview(archive)
    if is_building_archive(archive):
        from edesign.report.building.tables import short_building_tables

        tables = short_building_tables(archive)
    else:
        groups = all_results(archive)
        try:
            study = archived_study(archive) if is_study_archive(archive) else None
        except EdesignError:
            if not archive.damage:
                raise
            study = None
        of_kind = _of_project(archive, groups) if study is None else _of_study(archive, study, groups)
        tables = [_warnings(archive, groups), *of_kind]
    tables = [heading(archive), *tables, _more(archive)]
    return [table for table in tables if table.rows or table.notes]


def _of_study(archive: Archive, study: Study, groups: dict[str, Group]) -> list[Table]:
    histories = read_histories(archive, groups)
    sets = history_sets(histories)
    tables = [_ended(groups)]
    if not sets:
        tables += designs_tables(archive, study, sets)
    if study.criteria or study.objectives:
        judged = read_judged(archive, groups)
        tables.append(verdicts_in_short(judge(study.criteria, study.objectives, judged, study.base, study)))
    tables += means_tables(not_swept(study, sets))
    tables += [isolation_statistics_table(sets), *derived_tables(study, sets)]
    tables += target_tables(study.base, groups, study)
    return tables + incremental_tables(archive, groups)


def _of_project(archive: Archive, groups: dict[str, Group]) -> list[Table]:
    if not groups:  # of `edesign match`
        return tables_of(archive)
    entries = [entry(name, group) for name, group in groups.items()]
    tables = [analyses_table(entries)]
    tables += [periods_table(name, group, PERIODS_SHOWN) for name, group in groups.items()]
    targets = any(item["kind"] in KINDS for item in entries)
    tables += target_tables(archived_project(archive) if targets else None, groups)
    tables += [isolation_estimate_table(name, group) for name, group in groups.items()]
    footings = first_mode_table(groups)
    tables += [footings] if footings.rows else []
    return [*tables, _measures(entries), isolation_table(groups), dampers_table(groups)]


def _measures(entries: list[dict[str, Any]]) -> Table:
    """The main measures of the analyses that have any, a column for each."""
    having = [item for item in entries if any(value is not None for value in item["measures"].values())]
    marks = ["" if item["status"] == COMPLETED else " *" for item in having]
    columns = ("measure", *(item["name"] + mark for item, mark in zip(having, marks, strict=True)))
    table = Table("Response (largest absolute values)", columns)
    for name, measure, unit in MEASURE_ROWS:
        values = [item["measures"].get(measure) for item in having]
        if measure in MAIN and any(value is not None for value in values):
            table.rows.append([name, *(number(value, scale=unit, negligible=ROUNDING) for value in values)])
    if any(marks):
        table.notes.append("* not completed: as far as the analysis came, and not to be relied on")
    return table


def _warnings(archive: Archive, groups: dict[str, Group]) -> Table:
    """The first warnings, and how many there are."""
    found = [*input_warnings(archive), *design_warnings(archive), *warning_lines(groups)]
    if len(found) > WARNINGS_SHOWN + 1:
        found = [*found[:WARNINGS_SHOWN], f"and {len(found) - WARNINGS_SHOWN} more"]
    return Table("Warnings", notes=found)


def _ended(groups: dict[str, Group]) -> Table:
    """How many analyses were completed, and the first that were not."""
    ends = {name: ending(group) for name, group in groups.items()}
    completed = sum(end["status"] == COMPLETED for end in ends.values())
    lines = [f"{completed} of {len(ends)} completed"]
    failed = [f"{name}: {end['status']}: {end['reason']}" for name, end in ends.items() if end["status"] == "failed"]
    lines += failed[:FAILED_SHOWN]
    lines += [f"and {len(failed) - FAILED_SHOWN} more"] if len(failed) > FAILED_SHOWN else []
    return Table("Analyses", notes=lines)


def _more(archive: Archive) -> Table:
    return Table("", notes=[f"All tables: edesign show {archive.path} --all"])
