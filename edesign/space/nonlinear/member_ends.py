"""Hinges and joints at the ends of the columns and beams of a building."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from edesign.codes.fema356.sections import ISection
from edesign.frame.hinges import Ends, MemberEnd, ends_of_members
from edesign.frame.sections.i_shape import IShape, full_i_section, plates_of
from edesign.frame.sections.own_section import section_of
from edesign.project.building.building import Building
from edesign.project.building.hinges import BuildingHinges, BuildingJoints
from edesign.project.building.members import End
from edesign.project.building.names import BeamPlace, ColumnLine, node_name
from edesign.project.frame.hinges import AnyHinges, AnyJoints, Joints
from edesign.project.frame.materials import ElasticMaterial
from edesign.space.nonlinear.rigid_ends import columns_at


class BuildingSites:
    """The members of a building at whose ends hinges and joints may stand; they turn about the strong axis.

    Args:
        building: from `load_building`.
    """

    def __init__(self, building: Building) -> None:
        self._building = building
        self._layout = building.layout

    def members_in(self, of: AnyHinges | AnyJoints) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each beam or column that is chosen; of most they are one."""
        assert isinstance(of, BuildingHinges | BuildingJoints)
        return self._layout.members_in(of.beams, of.columns)

    def length(self, name: str) -> float:
        """Return the length of a column or beam between its nodes, m."""
        first, last = (self._layout.nodes[node] for node in self._layout.ends[name])
        return sum(abs(b - a) for a, b in zip(first, last, strict=True))  # it stands along an axis

    def i_shape(self, name: str) -> IShape | None:
        """Return the plates of a member's section; None if it is no I section."""
        return plates_of(self._layout.members[name].section, self._building.sections)

    def i_section(self, name: str) -> ISection | None:
        """Return the properties of a member's I section; None if it has none, or its steel does not yield."""
        run = self._layout.members[name]
        law = self._building.steels[run.material]
        if isinstance(law, ElasticMaterial) or self.i_shape(name) is None:
            return None
        return full_i_section(section_of(self._building, run.section), law.E, law.fy)

    def columns_at(self, node: str, beam: str) -> list[IShape | None]:
        """Return the plates of the columns at the node of a beam's end; None: it is bent about its weak axis."""
        if node not in self._lines:
            return []
        line, floor = self._lines[node]
        along = self._beams[beam].along
        return [
            plates_of(section, self._building.sections) if axis == "strong" else None
            for section, axis in columns_at(self._building, line, floor, along)
        ]

    @cached_property
    def _lines(self) -> dict[str, tuple[ColumnLine, int]]:
        there = self._layout.node_lines
        return {node_name(line, floor): (line, floor) for floor, lines in there.items() for line in lines}

    @cached_property
    def _beams(self) -> dict[str, BeamPlace]:
        return {name: place for place in self._layout.beam_at for name in self._layout.beam_members(place)}


def member_ends(building: Building) -> dict[str, Ends]:
    """Return the hinges and joints at the ends of the members that have any, by name.

    Ends of beams with a stiffness are joints that stay elastic, as in the elastic design.

    Args:
        building: from `load_building`.

    Raises:
        InputError: the regression does not know a section.
    """
    found = ends_of_members(building, BuildingSites(building))
    for name, (start, end) in building.layout.beam_ends.items():
        if isinstance(start, float) or isinstance(end, float):
            first, last = found.get(name, (MemberEnd(), MemberEnd()))
            found[name] = _with_joint(first, start), _with_joint(last, end)
    return found


def _with_joint(end: MemberEnd, joined: End) -> MemberEnd:
    if not isinstance(joined, float):
        return end
    joint = Joints.model_construct(stiffness=joined, resistance=None, hardening=0.0)
    return MemberEnd(end.hinge, end.distance, end.ratio, joint)
