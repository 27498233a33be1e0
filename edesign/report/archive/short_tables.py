"""The tables that the run of a project or study ends with, and that `edesign show` prints without `--all`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from textwrap import shorten
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.sets import history_sets
from edesign.errors import EdesignError
from edesign.project.study.study import Study
from edesign.report.archive_view import all_results, design_warnings, ending, entry, input_warnings
from edesign.report.archived import archived_base, archived_frame, archived_hazard, archived_study
from edesign.report.assessment.change_tables import changes_in_short
from edesign.report.assessment.derived_results import not_swept
from edesign.report.assessment.derived_tables import derived_tables
from edesign.report.assessment.measure_columns import MEASURE_ROWS, Measure
from edesign.report.assessment.response_in_short import response_in_short
from edesign.report.assessment.tables import read_histories, read_judged
from edesign.report.assessment.verdict_data import verdicts_of, warnings_of_braces
from edesign.report.assessment.verdicts_in_short import verdicts_in_short
from edesign.report.capacity.incremental_tables import incremental_tables
from edesign.report.capacity.pushover_tables import STATES_IN_SHORT, states_table
from edesign.report.design.designs_tables import designs_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_statistics_table, isolation_table
from edesign.report.ground_motion.record_tables import CRITERIA, tables_of
from edesign.report.response.analysis_tables import KINDS, NOT_COMPLETED, Entry, Mode, leading_modes, modes
from edesign.report.response.damper_results import dampers_table
from edesign.report.response.ground_tables import first_mode_table
from edesign.report.response.use_tables import use_in_short
from edesign.report.tables.column import Column, col, literal, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import PAPER
from edesign.report.tables.unit import ONE, PERCENT, S
from edesign.study.results.kinds import ANALYSES
from edesign.study.results.warnings import warning_lines
from edesign.study.run.outcome import COMPLETED

WARNINGS = "Warnings"
WARNINGS_SHOWN = 3
FAILED_SHOWN = 5
ANALYSES_SHOWN = 4
MAIN = (
    "roof_displacement_m",
    "interstorey_drift",
    "residual_interstorey_drift",
    "base_shear_N",
    "column_base_shear_N",
    "roof_acceleration_m_s2",
    "beam_plastic_rotation_rad",
    "column_plastic_rotation_rad",
    "brace_ductility",
    "damper_strain",
    "damper_deformation_m",
    "damper_force_N",
)
"""Measures of analyses without histories that are printed here."""


class _Modes(NamedTuple):
    """The modes of an analysis."""

    analysis: str
    modes: list[Mode]


def short_project_tables(archive: Archive, top: Table) -> list[Table]:
    """Return the main tables of a project: periods, means of the main measures; of matched records their criteria.

    Args:
        top: the heading, which says then how many analyses were completed.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    groups = all_results(archive)
    return _with_ends(archive, top, groups, _of_project(archive, groups))


def short_study_tables(archive: Archive, top: Table) -> list[Table]:
    """Return the main tables of a study: verdicts, means of the main measures, and governing histories.

    Of a damaged study whose text cannot be read, they are the tables of its analyses.

    Args:
        top: the heading, which says then how many analyses were completed.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: the study that it holds is not one of this version.
    """
    groups = all_results(archive)
    try:
        study = archived_study(archive)
    except EdesignError:
        if not archive.damage:
            raise
        study = None
    of_kind = _of_project(archive, groups) if study is None else _of_study(archive, study, groups)
    braces = warnings_of_braces(archive, study, history_sets(groups))
    return _with_ends(archive, top, groups, of_kind, braces)


def _with_ends(
    archive: Archive, top: Table, groups: dict[str, Group], tables: list[Table], braces: Sequence[str] = ()
) -> list[Table]:
    """The tables below the warnings, those of braces among them; the ends of analyses are added to the heading."""
    _add_ends(top, groups, [place for place in archive.damage if place.startswith(ANALYSES)])
    return [_warnings(archive, groups, braces), *tables]


def _of_study(archive: Archive, study: Study, groups: dict[str, Group]) -> list[Table]:
    histories = read_histories(archive, groups)
    sets = history_sets(histories)
    tables: list[Table] = []
    governing: list[Table] = []
    if not sets:
        tables += designs_tables(archive, study, sets)
    if found := verdicts_of(archive, study, read_judged(archive, groups), study.objectives):
        verdicts, *others = verdicts_in_short(found, study.base.hazard)
        tables.append(verdicts)
        governing += others
    shown = not_swept(study, sets)
    use = use_in_short(shown, study.base.hazard, archived_frame(archive))
    tables += [*governing, use, changes_in_short(shown), response_in_short(shown)]
    tables += [isolation_statistics_table(sets), *derived_tables(study, sets)]
    tables.append(states_table(study.base, groups, study, STATES_IN_SHORT))
    return tables + incremental_tables(archive, groups)


def _of_project(archive: Archive, groups: dict[str, Group]) -> list[Table]:
    if not groups:  # of `edesign match`, whose verdicts are the criteria of its sets
        return sorted(tables_of(archive), key=lambda table: table.name != CRITERIA.name)
    entries = [entry(name, group) for name, group in groups.items()]
    targets = any(item["kind"] in KINDS for item in entries)
    sets = history_sets(groups)
    tables: list[Table] = [_periods(groups)]
    tables.append(states_table(archived_base(archive) if targets else None, groups, None, STATES_IN_SHORT))
    tables += [response_in_short(sets) if sets or targets else _measures(entries[:ANALYSES_SHOWN])]
    tables += [use_in_short(sets, archived_hazard(archive), archived_frame(archive)), changes_in_short(sets)]
    tables += [isolation_table(groups)]
    tables += [isolation_estimate_table(name, group) for name, group in groups.items()]
    footings = first_mode_table(groups)
    return [*tables, *([footings] if footings.rows else []), dampers_table(groups)]


def _period(number: int) -> Column[_Modes]:
    def of(found: _Modes) -> float | None:
        plane = len(found.modes) >= number and not leading_modes(found.modes)
        return found.modes[number - 1].period if plane else None

    return col(f"T_{number}", S, of, form=".4f", optional=True)


def _leading(name: str) -> Column[_Modes]:
    """Number and period of the mode that leads in a direction of a building, and its share of the mass."""

    def of(found: _Modes) -> str | None:
        there = (one for one in leading_modes(found.modes) if one.direction == name)
        return next((f"{one.mode.number}: {one.mode.period:.4f} s, {100.0 * one.share:.1f} %" for one in there), None)

    return text(name, of, optional=True)


def _first_mass(found: _Modes) -> float | None:
    """The share of the first mode of a plane frame in the mass."""
    return None if leading_modes(found.modes) else found.modes[0].mass


PERIODS = TableSpec[_Modes](
    "first_periods",
    "Periods",
    (
        text("analysis"),
        *(_period(number) for number in (1, 2, 3)),
        col("effective mass of mode 1", PERCENT, _first_mass, form=".2f", optional=True),
        *map(_leading, ("along x", "along y", "about z")),
    ),
    named_by_title=True,
)
MEASURES = TableSpec[Measure](
    "measures_in_short",
    "Response (largest absolute values)",
    (text("measure", "head"),),  # and each analysis
    named_by_title=True,
)


def _periods(groups: dict[str, Group]) -> Table:
    """The first periods of each modal analysis, and the effective mass of the first mode."""
    rows = [_Modes(name, found) for name, group in groups.items() if (found := modes(group))]
    rule = "The leading mode of each direction: the one with most of the mass of the whole."
    return PERIODS.of(rows, notes=[rule] * any(leading_modes(row.modes) for row in rows))


def _measures(entries: Sequence[Entry]) -> Table:
    """The main measures of analyses without histories, a column for each that has any."""
    having = [item for item in entries if any(value is not None for value in item["measures"].values())]
    rows = [
        row
        for row in MEASURE_ROWS
        if row.name in MAIN and any(item["measures"][row.name] is not None for item in having)
    ]
    notes = () if all(item["status"] == COMPLETED for item in having) else (NOT_COMPLETED,)
    return MEASURES.of(rows, more=[_of_analysis(item) for item in having], notes=notes)


def _of_analysis(item: Entry) -> Column[Measure]:
    name = literal(item["name"] + ("" if item["status"] == COMPLETED else " *"))
    return col(name, ONE, lambda row: row.cell(item["measures"][row.name]))


def _warnings(archive: Archive, groups: dict[str, Group], braces: Sequence[str]) -> Table:
    """The first warnings, and how many there are."""
    found = [*braces, *input_warnings(archive), *design_warnings(archive), *warning_lines(groups)]
    found = [shorten(text, 2 * PAPER, placeholder=" ...") for text in found]
    if len(found) > WARNINGS_SHOWN + 1:
        found = [*found[:WARNINGS_SHOWN], f"and {len(found) - WARNINGS_SHOWN} more"]
    return Table(WARNINGS, notes=found)


def _add_ends(top: Table, groups: dict[str, Group], damaged: Sequence[str]) -> None:
    """Say in the head how many analyses were completed, and below it the first that were not."""
    if not groups and not damaged:
        return
    ends = {name: ending(group) for name, group in groups.items()}
    counts = Counter(end["status"] for end in ends.values())
    others = "".join(f", {count} {status}" for status, count in counts.items() if status != COMPLETED)
    others += f", {len(damaged)} damaged" if damaged else ""
    if top.rows[-1] == ["status", COMPLETED]:
        top.rows.pop()  # it is in the line of the analyses
    top.rows.append(["analyses", f"{counts[COMPLETED]} of {len(ends) + len(damaged)} completed{others}"])
    failed = [f"{name}: {end['status']}: {end['reason']}" for name, end in ends.items() if end["status"] == "failed"]
    top.notes += failed[:FAILED_SHOWN]
    top.notes += [f"and {len(failed) - FAILED_SHOWN} more"] if len(failed) > FAILED_SHOWN else []
