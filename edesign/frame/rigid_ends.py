"""Lengths of the rigid ends of members, from the depths of what they meet."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache

from edesign.errors import InputError
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.named_section import cross_section
from edesign.project.analysis_file import AnalysisFile
from edesign.project.frame.members import BeamRun, ColumnRun
from edesign.project.frame.sections import ElasticSection, SectionAxis
from edesign.project.notation import names
from edesign.project.notation.names import MemberKind
from edesign.project.notation.positions import Position
from edesign.project.project import Project

Ends = tuple[float, float]
Met = tuple[str, SectionAxis]
"""A section, and the axis about which it bends in the plane in which its depth is asked."""


@dataclass(frozen=True)
class Meeting:
    """A column or beam, and the members that it meets at its nodes.

    Attributes:
        length: between its nodes, m.
        met: the columns that a beam meets, or the beams that a column meets, at its start and at its end.
    """

    name: str
    kind: MemberKind
    length: float
    met: tuple[Sequence[Met], Sequence[Met]]


def rigid_ends(project: Project) -> dict[str, Ends]:
    """Return the lengths of the rigid ends of the columns and beams of a project that have any: start and end, m.

    Raises:
        InputError: as of `lengths_of_ends`.
    """
    return lengths_of_ends(project, _meetings(project), lambda *met: _depth(project, *met))


def lengths_of_ends(
    file: AnalysisFile, members: Iterable[Meeting], depth: Callable[[str, SectionAxis], float | None]
) -> dict[str, Ends]:
    """Return the lengths of the rigid ends of the members that have any: start and end, m, by name.

    A share is that of half the depth of the column that a beam meets, or of the deepest beam that a column meets: with
    1 the member begins to bend at the face of the joint. A column has none at the base, and a beam none where braces
    meet it in the middle.

    Args:
        depth: of a section in the plane in which it bends about an axis, m; None: it has no depth.

    Raises:
        InputError: a section has no depth, or rigid ends leave nothing of a member.
    """
    asked, known = file.elements.rigid_ends, cache(depth)

    def length(of: Position, met: Sequence[Met]) -> float:
        if of.value == 0.0 or not met:
            return 0.0
        if not of.is_share:
            return of.along(1.0)  # the length is given, whatever the depth
        return of.along(0.5 * max(_known_depth(file, section, known(section, axis)) for section, axis in met))

    found: dict[str, Ends] = {}
    for member in members:
        of = asked.columns if member.kind == "column" else asked.beams
        start, end = (length(of, met) for met in member.met)
        if start + end >= member.length:
            where = file.where("elements", "rigid_ends")
            raise InputError(
                f"{where}: elements.rigid_ends: ends of {start:.3g} m and {end:.3g} m leave nothing of {member.name}, "
                f"which is {member.length:g} m long [E-HINGE-05]"
            )
        if start or end:
            found[member.name] = (start, end)
    return found


def _known_depth(file: AnalysisFile, section: str, depth: float | None) -> float:
    if depth is None:
        where = file.where("elements", "rigid_ends")
        raise InputError(
            f"{where}: elements.rigid_ends: the section `{section}` has area and inertia but no depth, of which rigid "
            "ends could have a share; give their length, for example `0.2 m` [E-HINGE-05]"
        )
    return depth


def _meetings(project: Project) -> Iterator[Meeting]:
    frame = project.frame

    def met(runs: Iterable[ColumnRun | BeamRun | None]) -> list[Met]:
        return [(run.section, run.axis) for run in runs if run is not None]

    def beams(line: str, floor: int) -> list[Met]:
        at = frame.lines.index(line)
        return met(frame.beam_at.get((bay, floor)) for bay in (at, at + 1))

    def columns(line: str, floor: int) -> list[Met]:
        return met(frame.column_at.get((line, storey)) for storey in (floor, floor + 1))

    for name, beam in frame.beam_members.items():
        lines, middle = frame.bay_lines(beam.bay), frame.beam_name(beam.bay, beam.floor)
        start, end = (
            [] if node == middle else columns(line, beam.floor)
            for node, line in zip((beam.start, beam.end), lines, strict=True)
        )
        yield Meeting(name, "beam", beam.length, (start, end))
    for line, storey in frame.column_at:
        ends = beams(line, storey - 1), beams(line, storey)
        yield Meeting(names.column_name(line, storey), "column", frame.storey_heights[storey - 1], ends)


def _depth(project: Project, name: str, axis: SectionAxis) -> float | None:
    section = cross_section(project, name, axis)
    if isinstance(section, ElasticSection):
        return None
    hollow = hollow_section(name) if name not in project.sections else None
    if hollow is not None:
        return hollow.b if axis == "weak" else hollow.h
    return section.depth
