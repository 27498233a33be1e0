"""The tables of `edesign show` and of the end of a run."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive, open_archive
from edesign.assess.profile import storey_profile
from edesign.errors import EdesignError
from edesign.report.archive.study_tables import study_tables
from edesign.report.archive_view import all_results, entry, find, input_warnings, results
from edesign.report.archived import archived_project, is_building_archive, is_study_archive, is_substructure_archive
from edesign.report.assessment.measure_columns import BRACE_COLUMNS, FRAME_COLUMNS, ROUNDING
from edesign.report.capacity.pushover_tables import events_table, target_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_table
from edesign.report.ground_motion.record_tables import tables_of
from edesign.report.response.damper_results import (
    amplitude_notes,
    damper_stiffness_table,
    dampers_table,
    each_damper_table,
)
from edesign.report.response.ground_tables import ground_tables
from edesign.report.response.restrained_braces import restrained_tables
from edesign.report.tables.table import Table, formatted, number, seconds, whole
from edesign.study.results.warnings import warning_lines, warnings_of

PROFILE_COLUMNS = (
    ("floor u [m]", "floor_displacement", 1.0),
    ("drift [%]", "storey_drift", 0.01),
    ("residual drift [%]", "residual_storey_drift", 0.01),
    ("shear [kN]", "storey_shear", 1e3),
    ("floor a [m/s2]", "floor_acceleration", 1.0),
)
EVENTS_SHOWN = 20
ABSCISSAE = {  # what steps are taken in
    "gravity": "load factor",
    "pushover": "roof u [m]",
    "target": "roof u [m]",
    "history": "time [s]",
}


def overview(archive: str | os.PathLike[str] | Archive) -> list[Table]:
    """Return the tables of a whole archive: analyses, periods, response measures, statistics; of a study its results.

    Of a damaged study whose text cannot be read, they are those of its analyses.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return overview(opened)
    if is_building_archive(archive):
        from edesign.report.building.tables import building_tables

        return [heading(archive), *building_tables(archive)]
    if is_substructure_archive(archive):
        from edesign.report.substructure.building_tables import building_tables as of_tests
        from edesign.report.substructure.tables import substructure_tables

        tables = [*substructure_tables(archive), *of_tests(archive)]
        return [heading(archive), *(table for table in tables if table.rows)]
    if is_study_archive(archive):
        try:
            tables = [heading(archive), warnings_table(archive), *tables_of(archive), *study_tables(archive)]
            return [table for table in tables if table.rows or table.notes]
        except EdesignError:
            if not archive.damage:
                raise
    groups = all_results(archive)
    entries = [entry(name, group) for name, group in groups.items()]
    kinds = {item["kind"] for item in entries}
    tables = [heading(archive), warnings_table(archive, groups), *tables_of(archive), analyses_table(entries)]
    tables += [periods_table(name, group) for name, group in groups.items() if "period" in group.variables]
    tables += target_tables(archived_project(archive) if "target" in kinds else None, groups)
    tables += [isolation_estimate_table(name, group) for name, group in groups.items()]
    tables += [measures_table(entries), isolation_table(groups), dampers_table(groups), *restrained_tables(groups)]
    tables += ground_tables(groups)
    tables.append(statistics_table(entries))
    return [table for table in tables if table.rows or table.notes]


def details(archive: str | os.PathLike[str] | Archive, name: str) -> list[Table]:
    """Return all tables of one analysis: those of the overview, its storey profile and its fallbacks.

    Args:
        archive: path, or open archive, complete or partial.
        name: name of the analysis.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: there is no such analysis.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return details(opened, name)
    group = results(archive, find(archive, name))
    entries = [entry(name, group)]
    tables = [
        analyses_table(entries),
        Table("Warnings", notes=[warning.text for warning in warnings_of(group)], name="warnings"),
        periods_table(name, group),
        damper_stiffness_table(name, group),
        isolation_estimate_table(name, group),
        measures_table(entries),
        isolation_table({name: group}),
        profile_table(name, group),
        events_table({name: group}),
        *target_tables(None, {name: group}),
        each_damper_table(name, group),
        *restrained_tables({name: group}),
        *ground_tables({name: group}),
    ]
    tables += [statistics_table(entries), fallbacks_table(name, group)]
    return [table for table in tables if table.rows or table.notes]


def warnings_table(archive: Archive, groups: Mapping[str, Group] | None = None) -> Table:
    """Return the doubts about the input and about results of the given analyses, as a table without columns.

    Args:
        archive: the open archive.
        groups: results of analyses by name, whose warnings the table has too; None: none.
    """
    return Table("Warnings", notes=[*input_warnings(archive), *warning_lines(groups or {})], name="warnings")


KINDS = {"target": "target displacement"}
"""Kinds of analyses as people read them, where the word of the archive is another."""


def analyses_table(entries: list[dict[str, Any]]) -> Table:
    """Return name, kind, labels and status of each analysis; reasons of failures stand below."""
    table = Table("Analyses", ("analysis", "kind", "variant", "record", "level", "status"), left=6, name="analyses")
    for item in entries:
        kind = KINDS.get(str(item["kind"]), str(item["kind"] or "-"))
        labels = [kind, *(str(item[label] or "-") for label in ("variant", "record", "level"))]
        table.rows.append([item["name"], *labels, item["status"]])
        if item["reason"]:
            table.notes.append(f"{item['name']}: {item['reason']}")
    return table


def measures_table(entries: list[dict[str, Any]]) -> Table:
    """Return the response measures of the analyses that have any; columns that apply to none are left out."""
    rows = [item for item in entries if any(value is not None for value in item["measures"].values())]
    shown = [
        column
        for column in (*FRAME_COLUMNS, *BRACE_COLUMNS)
        if any(item["measures"][column[1]] is not None for item in rows)
    ]
    table = Table(
        "Response measures (largest absolute values)",
        ("analysis", *(header for header, _, _ in shown)),
        name="response_measures",
    )
    for item in rows:
        mark = "" if item["status"] == "completed" else " *"
        cells = [number(item["measures"][measure], scale=unit, negligible=ROUNDING) for _, measure, unit in shown]
        table.rows.append([item["name"] + mark, *cells])
    if any(item["status"] != "completed" for item in rows):
        table.notes.append("* not completed: as far as the analysis came, and not to be relied on")
    return table


def statistics_table(entries: list[dict[str, Any]]) -> Table:
    """Return the computing effort of each analysis, and the error of its energy balance."""
    table = Table(
        "Statistics",
        ("analysis", "steps", "iterations", "refactorisations", "fallbacks", "CPU [s]", "energy error"),
        name="statistics",
    )
    for item in entries:
        found = item["statistics"]
        if all(value is None for value in found.values()):
            continue
        counts = [whole(found[key]) for key in ("steps", "iterations", "refactorisations", "fallbacks")]
        table.rows.append([item["name"], *counts, seconds(found["cpu_s"]), number(found["energy_error"], 2)])
    return table


def periods_table(name: str, group: Group, most: int | None = None) -> Table:
    """Return periods and effective modal masses of a modal analysis: of the first modes, or of all.

    Args:
        name: name of the analysis.
        group: results of the analysis.
        most: number of modes that are shown; None: all.
    """
    table = Table(f"{name}: periods", ("mode", "T [s]", "f [Hz]", "effective mass [%]", "sum [%]"), left=0)
    table.each = ("Periods", name)
    table.name = "periods"
    period = group.variables.get("period")
    if period is None:
        return table
    ratio = group.variables.get("effective_mass_ratio_x")
    total = 0.0
    for mode, value in enumerate(period.values[:most]):
        cells = ["-", "-"]
        if ratio is not None:
            total += float(ratio.values[mode])
            cells = [formatted(100 * float(ratio.values[mode]), ".2f"), formatted(100 * total, ".2f")]
        table.rows.append([whole(mode + 1), formatted(value, ".4f"), formatted(1 / value, ".4f"), *cells])
    if len(table.rows) < period.values.size:
        table.notes.append(f"the first {len(table.rows)} of {period.values.size} modes")
    table.notes += amplitude_notes(group)
    return table


def profile_table(name: str, group: Group) -> Table:
    """Return the peaks of every storey, from the roof down; the floor is the one above the storey.

    Args:
        name: name of the analysis.
        group: results of the analysis.
    """
    found = storey_profile(group)
    columns = [(header, unit, found[key]) for header, key, unit in PROFILE_COLUMNS if key in found]
    table = Table(
        f"{name}: storeys (largest absolute values)", ("storey", *(header for header, _, _ in columns)), left=0
    )
    table.each = ("Storeys (largest absolute values)", name)
    table.name = "storey_response"
    if not columns:
        return table
    for storey in range(len(columns[0][2]), 0, -1):
        table.rows.append(
            [
                whole(storey),
                *(number(float(values[storey - 1]), scale=unit, negligible=ROUNDING) for _, unit, values in columns),
            ]
        )
    return table


def fallbacks_table(name: str, group: Group) -> Table:
    """Return the fallbacks of the solver where a step did not converge; long lists are cut.

    Args:
        name: name of the analysis.
        group: results of the analysis.
    """
    abscissa = ABSCISSAE.get(str(group.attributes.get("kind")), "time [s]")
    table = Table(
        f"{name}: fallbacks", ("step", abscissa, "rung", "detail"), left=0, each=("Fallbacks", name), name="fallbacks"
    )
    events = group.attributes.get("events")
    listed = [event for event in events if isinstance(event, Mapping)] if isinstance(events, list) else []
    for event in listed[:EVENTS_SHOWN]:
        table.rows.append([whole(event["step"]), number(event["time"]), str(event["rung"]), str(event["detail"])])
    if len(listed) > EVENTS_SHOWN:
        table.notes.append(f"and {len(listed) - EVENTS_SHOWN} more, in the archive")
    return table


def heading(archive: Archive) -> Table:
    """Return kind, files, date and completeness of an archive as a heading."""
    about = archive.attributes
    state = str(about.get("status")) if archive.complete else "not complete: the run goes on or was interrupted"
    made = archive.group_attributes("provenance").get("created", "?") if "provenance" in archive.names() else "?"
    project = f"{about.get('project_file')}, sha256 {str(about.get('project_checksum'))[:12]}"
    building = f"{about.get('building_file')}, sha256 {str(about.get('building_checksum'))[:12]}"
    rows = [
        ["archive", str(archive.path)],
        *([["project", project]] if about.get("project_file") else []),  # `edesign match` needs none
        *([["building", building]] if about.get("building_file") else []),
        ["made", f"{made} by edesign {about.get('edesign_version')}, core {about.get('core_version')}"],
        ["status", state],
        *([["damaged", damage]] if (damage := archive.damage_in_short()) else []),
    ]
    return Table(str(about.get("title", "")), (), rows, left=2)
