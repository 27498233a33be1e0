"""The input as a checker needs it: the frame in numbers, masses, laws, the damper schedule, the plan, and the files."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from operator import itemgetter

from edesign.project.notation.names import beam_name, brace_name, damper_names
from edesign.project.project import Project
from edesign.report.archive_view import results
from edesign.report.html.section import Facts, Folded, Heading, Part, Section
from edesign.report.inputs.connections import connection_tables
from edesign.report.inputs.damper_schedule import schedule_tables
from edesign.report.inputs.law_parameters import law_tables
from edesign.report.inputs.mass_table import mass_tables
from edesign.report.inputs.steel_list import steel_tables
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.inputs.variants_table import variants_table
from edesign.report.page.project_facts import project_rows
from edesign.report.page.source import Source
from edesign.report.response.analysis_tables import analyses_table
from edesign.report.tables.column import text
from edesign.report.tables.table import Table, TableSpec

NAMES = (
    ("Columns", "C_B_3 stands on line B in storey 3."),
    ("Beams", "B_2_3 is in bay 2 at floor 3."),
    ("Dampers", "V_2_3 is a chevron in bay 2 and storey 3; R rises, F falls, S is between floors, I is an isolator."),
    ("Braces", "D_2_3_r is in bay 2 and storey 3, and rises from left to right; f falls."),
)
MEMBER_NAMES = TableSpec[tuple[str, str]](
    "names_of_members",
    "",
    (text("members", itemgetter(0)), text("example", itemgetter(1))),
    keys=2,
    named_by_title=True,
)
MANY = 48  # rows of a table of the schedule, beyond which it is folded


def inputs(source: Source) -> Section:
    """Return the section on the input of the run; empty without a project, as in an archive of `edesign match`."""
    parts: list[Part] = []
    if source.project is not None:
        parts.append(Facts(tuple(project_rows(source.project))))
        parts.append(Folded("How members are named", (MEMBER_NAMES.of(_names(source.project)),)))
    if source.study is not None:
        parts.append(variants_table(source.study))
    if source.frames is not None and source.entries:
        parts += _of_frames(source, source.frames)
    if source.entries:
        table = replace(analyses_table(source.entries, "name of the analysis"), names_kept=True)
        parts.append(Folded(f"All {len(source.entries)} analyses", (table,)))
    for name, what in (("study_text", "The study file"), ("project_text", "The project file")):
        text = source.text(name)
        if text:
            parts.append(Folded(f"{what}, {len(text.splitlines())} lines", text=text))
    title = source.project.title if source.project is not None else ""
    known = title == source.attributes.get("title")
    return Section("inputs", "Input", (f"{title}.",) if title and not known else (), tuple(parts))


def _names(project: Project) -> tuple[tuple[str, str], ...]:
    """How members are named; with the lines of the plans, where the frame has their names."""
    lines = project.frame.axes
    if lines is None:
        return NAMES
    column = f"C_{lines[1]}_3 stands on line {lines[1]} in storey 3; the lines are {', '.join(lines)}, as in the plans."
    if not project.frame.in_building:
        return (("Columns", column), *NAMES[1:])
    frame = project.frame.in_building[0]
    bay = f"bay 2 of frame {frame}"
    return (
        ("Columns", column),
        ("Beams", f"{beam_name(2, 3, frame)} is in {bay} at floor 3, as in the building."),
        (
            "Dampers",
            f"{damper_names('chevron', 2, 3, frame)[0]} is a chevron in {bay} and storey 3; R rises, F falls, S is "
            "between floors, I is an isolator.",
        ),
        ("Braces", f"{brace_name(2, 3, 'r', frame)} is in {bay} and storey 3, and rises from left to right; f falls."),
    )


def _of_frames(source: Source, frames: VariantFrames) -> list[Part]:
    """Masses, laws and schedule; one that cannot be made, as a file is not at hand, is named under Provenance."""
    makers: tuple[tuple[str, Callable[[], list[Table]]], ...] = (
        ("masses of the floors", lambda: mass_tables(frames)),
        ("steel", lambda: steel_tables(frames)),
        ("laws of the dampers", lambda: law_tables(frames)),
        (
            "damper schedule",
            lambda: schedule_tables(frames, source.study, source.sets, lambda name: results(source.archive, name)),
        ),
        ("connections of the dampers", lambda: _connections(source, frames, governing=True)),
        ("connections of each damper", lambda: _connections(source, frames, governing=False)),
    )
    parts: list[Part] = []
    for what, make in makers:
        tables: list[Table] = []
        with source.or_left_out(what):
            tables = make()
        each = what == "connections of each damper"
        if tables and what not in ("masses of the floors", "steel") and not each:
            parts.append(Heading(what.capitalize()))
        parts += [Folded(f"{t.title} ({len(t.rows)} rows)", (t,)) if each or len(t.rows) > MANY else t for t in tables]
    return parts


def _connections(source: Source, frames: VariantFrames, governing: bool) -> list[Table]:
    return connection_tables(
        frames, source.study, source.sets, lambda name: results(source.archive, name), governing=governing
    )
