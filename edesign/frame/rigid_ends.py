"""Lengths of the rigid ends of members, from the depths of what they meet."""

from __future__ import annotations

from collections.abc import Iterable

from edesign.errors import InputError
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.named_section import cross_section
from edesign.project.frame.members import BeamRun, ColumnRun, SectionAxis
from edesign.project.frame.sections import ElasticSection
from edesign.project.notation import names
from edesign.project.notation.positions import Position
from edesign.project.project import Project

Ends = tuple[float, float]


def rigid_ends(project: Project) -> dict[str, Ends]:
    """Return the lengths of the rigid ends of the columns and beams that have any: start and end, m, by name.

    A share is that of half the depth of the column that a beam meets, or of the deepest beam that a column meets: with
    1 the member begins to bend at the face of the joint. A column has none at the base, and a beam none where braces
    meet it in the middle.

    Raises:
        InputError: a section has no depth, or rigid ends leave nothing of a member.
    """
    frame, asked = project.frame, project.elements.rigid_ends
    depths = _Depths(project)
    found: dict[str, Ends] = {}
    for line, storey in frame.column_at:
        low, high = (depths.of_beams(line, floor) for floor in (storey - 1, storey))
        ends = _length(asked.columns, low), _length(asked.columns, high)
        found[names.column_name(line, storey)] = ends
    for name, beam in frame.beam_members.items():
        lines, middle = frame.bay_lines(beam.bay), names.beam_name(beam.bay, beam.floor)
        left, right = (
            0.0 if node == middle else _length(asked.beams, depths.of_columns(line, beam.floor))
            for node, line in zip((beam.start, beam.end), lines, strict=True)
        )
        found[name] = (left, right)
        if left + right >= beam.length:
            raise InputError(_too_long(project, name, (left, right), beam.length))
    for line, storey in frame.column_at:
        name = names.column_name(line, storey)
        if sum(found[name]) >= frame.storey_heights[storey - 1]:
            raise InputError(_too_long(project, name, found[name], frame.storey_heights[storey - 1]))
    return {name: ends for name, ends in found.items() if any(ends)}


def _length(asked: Position, depth: float) -> float:
    """Length of a rigid end beside or under a member of a depth; none where there is no such member."""
    return asked.along(0.5 * depth) if depth > 0.0 else 0.0


def _too_long(project: Project, name: str, ends: Ends, length: float) -> str:
    where = project.where("elements", "rigid_ends")
    return (
        f"{where}: elements.rigid_ends: ends of {ends[0]:.3g} m and {ends[1]:.3g} m leave nothing of {name}, which is "
        f"{length:g} m long [E-HINGE-05]"
    )


class _Depths:
    """Depths in the plane of the frame, each section asked once."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._known: dict[tuple[str, SectionAxis], float] = {}

    def of_columns(self, line: str, floor: int) -> float:
        """Depth of the deepest column at a node, m; 0 if there is none."""
        runs = (self._project.frame.column_at.get((line, storey)) for storey in (floor, floor + 1))
        return self._largest(runs, self._project.elements.rigid_ends.beams)

    def of_beams(self, line: str, floor: int) -> float:
        """Depth of the deepest beam at a node, m; 0 if there is none, as at the base."""
        frame = self._project.frame
        at = frame.lines.index(line)
        runs = (frame.beam_at.get((bay, floor)) for bay in (at, at + 1))
        return self._largest(runs, self._project.elements.rigid_ends.columns)

    def _largest(self, runs: Iterable[ColumnRun | BeamRun | None], asked: Position) -> float:
        if asked.value == 0.0:
            return 0.0
        there = [run for run in runs if run is not None]
        if not asked.is_share:
            return 1.0 if there else 0.0  # the length is given, whatever the depth
        return max((self._depth(run) for run in there), default=0.0)

    def _depth(self, run: ColumnRun | BeamRun) -> float:
        key = (run.section, run.axis)
        if key not in self._known:
            self._known[key] = self._of_section(*key)
        return self._known[key]

    def _of_section(self, name: str, axis: SectionAxis) -> float:
        section = cross_section(self._project, name, axis)
        if isinstance(section, ElasticSection):
            where = self._project.where("elements", "rigid_ends")
            raise InputError(
                f"{where}: elements.rigid_ends: the section `{name}` has area and inertia but no depth, of which rigid "
                "ends could have a share; give their length, for example `0.2 m` [E-HINGE-05]"
            )
        hollow = hollow_section(name) if name not in self._project.sections else None
        if hollow is not None:
            return hollow.b if axis == "weak" else hollow.h
        return section.depth
