"""Rigid ends of the columns and beams of a building."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from edesign.frame.rigid_ends import Ends, Meeting, Met, lengths_of_ends
from edesign.frame.sections.own_section import section_of
from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS
from edesign.project.building.names import BeamPlace, ColumnLine, Direction, column_name
from edesign.project.frame.sections import SectionAxis


def rigid_ends(building: Building) -> dict[str, Ends]:
    """Return the lengths of the rigid ends of the columns and beams that have any: start and end, m, by name.

    Beams meet columns with their depth along the beam: h where they bend about their strong axis in its frame, else b.
    The end of a column is rigid about both axes, so that the deepest of all beams at its node counts.

    Args:
        building: from `load_building`.

    Raises:
        InputError: rigid ends leave nothing of a member.
    """

    def depth(name: str, axis: SectionAxis) -> float | None:
        section = section_of(building, name)
        return (section.b if axis == "weak" else section.h) or None

    return lengths_of_ends(building, _meetings(building), depth)


def columns_at(building: Building, line: ColumnLine, floor: int, along: Direction) -> list[Met]:
    """Return the sections of the columns below and above a node, and the axes about which they bend along a direction.

    Args:
        building: from `load_building`.
        along: direction of the frames in which they bend.
    """
    runs = (building.layout.column_at.get((line, storey)) for storey in (floor, floor + 1))
    return [(run.section, "strong" if run.strong == along else "weak") for run in runs if run is not None]


def beams_at(building: Building, line: ColumnLine, floor: int, directions: Iterable[Direction]) -> list[BeamPlace]:
    """Return the places of the beams that stand at a node, in frames of some directions.

    Args:
        building: from `load_building`.
    """
    found = []
    for along in directions:
        frame, at = (line.j, line.i) if along == "x" else (line.i, line.j)
        places = (BeamPlace(along, frame, bay, floor, building.axes) for bay in (at, at + 1))
        found += [place for place in places if place in building.layout.beam_at]
    return found


def _meetings(building: Building) -> Iterator[Meeting]:
    layout = building.layout
    for place in layout.beam_at:
        members = layout.beam_members(place)
        length = building.widths(place.along)[place.bay - 1] / len(members)
        first, last = (columns_at(building, line, place.floor, place.along) for line in place.lines)
        for name in members:  # the node in the middle is none of a column
            ends = first if name == members[0] else [], last if name == members[-1] else []
            yield Meeting(name, "beam", length, ends)
    for line, storey in layout.column_at:
        met: list[list[Met]] = [
            [(layout.beam_at[at].section, "strong") for at in beams_at(building, line, floor, DIRECTIONS)]
            for floor in (storey - 1, storey)
        ]
        yield Meeting(column_name(line, storey), "column", building.storey_heights[storey - 1], (met[0], met[1]))
