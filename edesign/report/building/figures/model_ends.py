"""The ends of the members of a frame of a building on a sheet: pins, hinges, joints, panel zones, rigid ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from edesign.errors import InputError
from edesign.project.building import Building
from edesign.project.building.hinges import BuildingHinges, BuildingJoints, BuildingPanelZones
from edesign.project.building.names import Direction, node_name
from edesign.project.frame.hinges import AnyHinges, AnyJoints, AnyPanelZones
from edesign.report.model.ends import FROM_NODE, Line, draw_hinges, draw_joints, draw_panels, draw_rigid, near
from edesign.report.model.sheet import Entry, Point, Sheet
from edesign.space.nonlinear.panel_zones import panels_of
from edesign.space.nonlinear.rigid_ends import rigid_ends
from edesign.space.structure.frame import Member

PINNED_END, SPRUNG_END = "end without moment", "end with a rotational stiffness"


def is_weak(member: Member, along: Direction) -> bool:
    """Say whether a column bends about its weak axis in frames along a direction."""
    return member.kind == "column" and abs(member.web["xy".index(along)]) < 0.5


@dataclass(frozen=True)
class EndsOfFrame:
    """What stands at the ends of the members of one plane frame of a building in analyses.

    Hinges and joints turn about the strong axis of their member, so that columns show those about it alone.

    Attributes:
        building: as its file says.
        along: direction of the frame.
        members: in the frame.
    """

    building: Building
    along: Direction
    members: Sequence[Member]

    @property
    def look(self) -> tuple[object, ...]:
        """What distinguishes the frame from others: the places of the ends that each run is at."""
        k = "xy".index(self.along)
        place = self.building.grid.nodes

        def at(node: str) -> tuple[float, float]:
            return place[node][k], place[node][2]

        ends = {one.name: tuple(map(at, self.building.grid.ends[one.name])) for one in self.members}
        runs: list[AnyHinges | AnyJoints] = [*self.building.hinges, *self.building.joints]
        found = [frozenset((ends[name], end) for name, end in self._chosen(run)) for run in runs]
        return (*found, *(frozenset(map(at, self._joints(zones))) for zones in self.building.panel_zones))

    def draw(self, sheet: Sheet, drawn: Mapping[str, Line], at: Callable[[str], Point]) -> list[Entry]:
        """Draw the ends; return their lines of the legend.

        Args:
            drawn: where each member is, by name.
            at: gives the place of a node on the sheet.
        """

        def chosen(run: AnyHinges | AnyJoints, distance: float) -> list[Point]:
            return [near(drawn[name], end, distance) for name, end in self._chosen(run)]

        def joints(zones: AnyPanelZones) -> list[Point]:
            return [at(node) for node in self._joints(zones)]

        try:
            rigid = rigid_ends(self.building)
        except InputError:  # reported where the building is built
            rigid = {}
        length = {
            name: math.dist(*(self.building.grid.nodes[n] for n in self.building.grid.ends[name])) for name in drawn
        }
        return [
            *draw_rigid(sheet, ((drawn[name], ends, length[name]) for name, ends in rigid.items() if name in drawn)),
            *draw_panels(sheet, self.building.panel_zones, joints),
            *_of_beams(sheet, self.members, drawn),
            *draw_hinges(sheet, self.building.hinges, chosen),
            *draw_joints(sheet, self.building.joints, chosen),
        ]

    def _chosen(self, run: AnyHinges | AnyJoints) -> list[tuple[str, int]]:
        """The ends of the members of the frame that a run is at: name, and 0 for its start or 1."""
        assert isinstance(run, BuildingHinges | BuildingJoints)
        seen = {one.name for one in self.members if not is_weak(one, self.along)}
        pairs = self.building.layout.members_in(run.beams, run.columns)
        ends = [
            (name, end)
            for first, last in pairs
            for name, end, other in ((first, 0, "end"), (last, 1, "start"))
            if run.ends != other
        ]
        return [(name, end) for name, end in ends if name in seen]

    def _joints(self, zones: AnyPanelZones) -> list[str]:
        """The nodes of the frame at which the panels of a run shear in it."""
        assert isinstance(zones, BuildingPanelZones)
        try:
            panels = panels_of(self.building)
        except InputError:  # reported where the building is built
            return []
        ends = {node for one in self.members for node in self.building.grid.ends[one.name]}
        nodes = (
            node_name(line, floor)
            for floor in zones.floors.numbers(1, self.building.n_storeys)
            for line in self.building.lines_of(zones.at)
        )
        return [node for node in nodes if node in ends and node in panels and panels[node][0] == self.along]


def _of_beams(sheet: Sheet, members: Sequence[Member], drawn: Mapping[str, Line]) -> list[Entry]:
    """Circles at ends of beams that pass no moment in the frame, diamonds at those with a stiffness."""
    marks: dict[str, list[Point]] = {"o": [], "D": []}
    for one in members:
        for k, stiffness in ((0, one.ends[0]), (1, one.ends[2])) if one.kind == "beam" else ():
            if math.isfinite(stiffness):
                marks["D" if stiffness else "o"].append(near(drawn[one.name], k, FROM_NODE))
    entries = []
    for mark, text in (("o", PINNED_END), ("D", SPRUNG_END)):
        if marks[mark]:
            sheet.dots(marks[mark], 4.0, marker=mark)
            entries.append(Entry(text, lambda on, x, y, m=mark: on.dots([(x + 0.14, y)], 4.0, marker=m)))  # type: ignore[misc]
    return entries
