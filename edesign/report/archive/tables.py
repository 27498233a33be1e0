"""The tables of `edesign show` and of the end of a run, of archives of any kind."""

from __future__ import annotations

import os
import shlex
from collections.abc import Sequence
from operator import itemgetter

from edesign.archive.reader import Archive, open_archive
from edesign.report.archive.kinds import kind_of
from edesign.report.archive.short_tables import WARNINGS
from edesign.report.archive_view import entry, find, results
from edesign.report.capacity.pushover_tables import events_table, target_tables
from edesign.report.design.isolation_tables import isolation_estimate_table, isolation_table
from edesign.report.response.analysis_tables import (
    analyses_table,
    fallbacks_table,
    measures_table,
    periods_table,
    profile_table,
    statistics_table,
)
from edesign.report.response.damper_results import damper_stiffness_table, each_damper_table
from edesign.report.response.ground_tables import ground_tables
from edesign.report.response.restrained_braces import restrained_tables
from edesign.report.tables.column import text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import PAPER, fitted, plain
from edesign.study.results.warnings import warnings_of

SCREEN = 40  # lines
LAST = 1  # of them for the line that says where the rest is
LEAST = 4  # tables beside warnings, however long they are: of a study heading, verdicts, what governs, uses
HEADING = TableSpec[tuple[str, str]](
    "heading",
    "{title}",
    (text("what", itemgetter(0)), text("value", itemgetter(1))),
    keys=2,
    headed=False,
    named_by_title=True,
)


def overview(archive: str | os.PathLike[str] | Archive) -> list[Table]:
    """Return the tables of a whole archive: a heading, and the tables of its kind, as those of a study's results.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return overview(opened)
    return [heading(archive), *kind_of(archive).tables(archive)]


def details(archive: str | os.PathLike[str] | Archive, name: str) -> list[Table]:
    """Return all tables of one analysis: those of the overview, its storey profile and its fallbacks.

    Args:
        archive: path, or open archive, complete or partial.

    Raises:
        ArchiveError: the archive cannot be read.
        InputError: there is no such analysis.
    """
    if not isinstance(archive, Archive):
        with open_archive(archive) as opened:
            return details(opened, name)
    group = results(archive, find(archive, name))
    entries = [entry(name, group)]
    tables: list[Table] = [
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


def heading(archive: Archive) -> Table:
    """Return kind, files, date and completeness of an archive as a heading."""
    about = archive.attributes
    state = str(about.get("status")) if archive.complete else "not complete: the run goes on or was interrupted"
    made = archive.group_attributes("provenance").get("created", "?") if "provenance" in archive.names() else "?"
    project = f"{about.get('project_file')}, sha256 {str(about.get('project_checksum'))[:12]}"
    building = f"{about.get('building_file')}, sha256 {str(about.get('building_checksum'))[:12]}"
    return HEADING.of(
        [
            ("archive", str(archive.path)),
            *([("project", project)] if about.get("project_file") else []),  # `edesign match` needs none
            *([("building", building)] if about.get("building_file") else []),
            ("made", f"{made} by edesign {about.get('edesign_version')}, core {about.get('core_version')}"),
            ("status", state),
            *([("damaged", damage)] if (damage := archive.damage_in_short()) else []),
        ],
        title=str(about.get("title", "")),
    )


def short_tables(archive: Archive) -> list[Table]:
    """Return the main tables of an archive: of a study verdicts, means of measures, uses, what governs.

    They take one screen: `SCREEN` lines of 80 characters.

    Raises:
        ArchiveError: the archive cannot be read.
    """
    top = heading(archive)
    found = kind_of(archive).short_tables(archive, top)
    tables = [top, *(table for table in found if table.rows or table.notes)]
    shown = _on_a_screen(tables)
    return [*shown, _more(archive, [table.title for table in tables[len(shown) :]])]


def _on_a_screen(tables: list[Table]) -> list[Table]:
    """The first tables: as many as a screen has lines for, a few at least."""
    lines = 0
    shown: list[Table] = []
    for table in tables:
        lines += sum(len(plain(part).splitlines()) + 1 for part in fitted(table, PAPER))
        if lines > SCREEN - LAST and sum(one.title != WARNINGS for one in shown) >= LEAST:
            break
        shown.append(table)
    return shown


def _more(archive: Archive, left_out: Sequence[str]) -> Table:
    """Where everything is, and how many tables of what is asked first had no room."""
    more = f", {len(left_out)} of which had no room here" if left_out else ""
    return Table("", notes=[f"All tables{more}: edesign show {shlex.quote(str(archive.path))} --all"])
