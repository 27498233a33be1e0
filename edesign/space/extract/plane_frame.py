"""A plane frame of a building with what falls to it: loads on its beams and nodes, masses, supports."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.errors import InputError
from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS, ways
from edesign.project.building.members import NO_LAW_OF_LINKS, BeamRun, BraceRun, ColumnRun, Ends
from edesign.project.building.names import (
    BeamPlace,
    BracePlace,
    ColumnLine,
    Direction,
    bay_lines,
    frame_name,
    node_name,
)
from edesign.project.building.supports import Springs
from edesign.project.reading.problems import listed
from edesign.space.file_places import keys_of_member
from edesign.space.structure.area_loads import BeamShare
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.load_cases import members_of, on_nodes

AtNodes = dict[tuple[int, int], float]
"""Values by number of the line, from 0, and floor."""


@dataclass(frozen=True)
class PlaneFrame:
    """A plane frame of a building.

    Attributes:
        building: from `load_building`.
        space: its space frame.
        along: direction of the frame.
        number: of the frame, from 0.
    """

    building: Building
    space: SpaceFrame
    along: Direction
    number: int

    @property
    def name(self) -> str:
        """Name of the frame by direction and number of its grid line."""
        return frame_name(self.along, self.number, self.building.axes)

    @cached_property
    def lines(self) -> tuple[ColumnLine, ...]:
        """Column lines of the frame, from its beginning."""
        axes, n_bays = self.building.axes, self.building.n_bays(self.along)
        bays = [bay_lines(self.along, self.number, bay + 1, axes) for bay in range(n_bays)]
        return (bays[0][0], *(end for _, end in bays))

    @cached_property
    def columns(self) -> dict[tuple[int, int], ColumnRun]:
        """Columns of the frame by (number of the line from 0, storey)."""
        at = self.building.layout.column_at
        places = [(i, s) for s in range(1, self.building.n_storeys + 1) for i in range(len(self.lines))]
        return {(i, s): at[self.lines[i], s] for i, s in places if (self.lines[i], s) in at}

    @cached_property
    def beams(self) -> dict[BeamPlace, BeamRun]:
        """Beams of the frame."""
        at = self.building.layout.beam_at
        return {p: run for p, run in at.items() if (p.along, p.frame) == (self.along, self.number)}

    @cached_property
    def braces(self) -> dict[BracePlace, BraceRun]:
        """Braces of the frame."""
        at = self.building.layout.brace_at
        return {p: run for p, run in at.items() if (p.along, p.frame) == (self.along, self.number)}

    @cached_property
    def top(self) -> int:
        """Highest floor that the frame reaches; 0 where it has no column."""
        return max((storey for _, storey in self.columns), default=0)

    @property
    def resists(self) -> bool:
        """True if braces, or beams with a moment at an end, resist horizontal forces in it."""
        return bool(self.braces) or any(not _pinned(run.ends) for run in self.beams.values())

    def beam_load(self, factors: Mapping[str, float]) -> dict[tuple[int, int], BeamShare]:
        """Return the loads on each of its beams where they act, by (bay, floor), downwards.

        Args:
            factors: on load cases, by name.
        """
        totals = {(p.bay, p.floor): BeamShare() for p in self.beams}
        for name, factor in factors.items():
            of_case = self._loads_of_case(name)
            totals = {place: total.plus(of_case[place], factor) for place, total in totals.items()}
        return totals

    def _loads_of_case(self, case: str) -> dict[tuple[int, int], BeamShare]:
        """The loads of a case on its beams; two halves of a beam are one, with what stands at the node between."""
        space, of = self.space, self.space.cases[case]
        numbers = {member.name: i for i, member in enumerate(space.members)}
        nodes = {name: i for i, name in enumerate(space.node_names)}
        found = {}
        for place in self.beams:
            members = members_of(place, numbers)
            points = [
                ((k + float(of.point_position[i])) / len(members), -float(of.point_force[i, 2]))
                for k, member in enumerate(members)
                for i in np.flatnonzero(of.point_member == member)
            ]
            if len(members) == 2:
                points.append((0.5, -float(of.nodal[nodes[str(place)], 2])))
            uniform = -float(of.uniform[members[0], 2])
            found[place.bay, place.floor] = BeamShare().plus(BeamShare(uniform, tuple(points)), 1.0)
        return found

    def node_load(self, factors: Mapping[str, float]) -> AtNodes:
        """Return what other members bring to the nodes of the frame above the base, N, downwards.

        Beams at right angles bring half of their load, columns and braces half of their weight.

        Args:
            factors: see `beam_load`.
        """
        own = {name for place in self.beams for name in self.building.layout.beam_members(place)}
        middles = np.array([name in {str(place) for place in self.beams} for name in self.space.node_names])
        return self._carried(factors, np.array([member.name in own for member in self.space.members]), middles)

    def weight(self, factors: Mapping[str, float]) -> AtNodes:
        """Return what the nodes of the frame above the base carry of all members, N, downwards.

        Args:
            factors: see `beam_load`.
        """
        return self._carried(factors)

    def node_mass(self) -> AtNodes:
        """Return the mass at each of its nodes above the base, kg."""
        return self._at_nodes(self.space.node_mass)

    def _carried(
        self, factors: Mapping[str, float], but: np.ndarray | None = None, middles: np.ndarray | None = None
    ) -> AtNodes:
        """What nodes carry, but the loads of some members and what stands at the middles of beams."""
        total = np.zeros(len(self.space.node_names))
        for name, factor in factors.items():
            case = self.space.cases[name]
            total -= factor * on_nodes(self.space, case, but)[:, 2]
            if middles is not None:
                total += factor * np.where(middles, case.nodal[:, 2], 0.0)
        return self._at_nodes(total)

    def _at_nodes(self, values: np.ndarray) -> AtNodes:
        """Values of its nodes; those inside of a beam go to its ends by their distance."""
        nodes = {name: i for i, name in enumerate(self.space.node_names)}
        whole = values.astype(float)
        for beam in self.building.layout.cut_beams:
            for name, at in self.building.layout.cuts(beam).items():
                for line, share in zip(beam.lines, (1.0 - at, at), strict=True):
                    whole[nodes[node_name(line, beam.floor)]] += share * values[nodes[name]]
        places = [(i, floor) for floor in range(1, self.building.n_storeys + 1) for i in range(len(self.lines))]
        named = {place: node_name(self.lines[place[0]], place[1]) for place in places}
        return {place: float(whole[nodes[name]]) for place, name in named.items() if name in nodes}

    def support(self, i: int) -> str:
        """Return the support of a line in the plane of the frame: fixed, pinned, roller.

        Args:
            i: index of the line.

        Raises:
            InputError: it is a spring or a footing.
        """
        springs, kind = self.building.support(self.lines[i]), None
        if isinstance(springs, Springs) and springs.uz == "fixed":
            restraints = (springs.ux, springs.ry) if self.along == "x" else (springs.uy, springs.rx)
            kinds = {("fixed", "fixed"): "fixed", ("fixed", "free"): "pinned", ("free", "free"): "roller"}
            kind = kinds.get((str(restraints[0]), str(restraints[1])))
        if kind is None:
            raise self._refuse(
                f"extracted frames have fixed, pinned and roller supports, not that of {self.lines[i]} [E-SPACE-04]",
                *self.building.support_keys(str(self.lines[i])),
            )
        return kind

    def check(self, alone: bool = True) -> None:
        """Check that a project file can say what the frame is.

        Args:
            alone: whether it stands alone, so that it must resist something itself.

        Raises:
            InputError: it has seismic links, floors that the ground holds or that are rigid in part, no column, nodes
                without a member of its own, or nothing that resists while other frames do.
        """
        if linked := next((place for place, run in self.braces.items() if run.link is not None), None):
            message = f"{linked} has a `link`: {NO_LAW_OF_LINKS}, and frames without them can be extracted [E-SPACE-12]"
            way = next(iter(ways(linked, self.braces[linked])))
            raise self._refuse(message, *keys_of_member(self.building, linked.name(way)))
        if self.building.held_floors:
            message = "project files have no floors that the ground holds [E-SPACE-04]"
            raise self._refuse(message, "restrained_floors")
        if self.building.partial_diaphragms or any(at.part for at in self.building.layout.diaphragms):
            message = "project files have no floors that are rigid in part, or in several parts [E-SPACE-04]"
            raise self._refuse(message, "partial_diaphragms" if self.building.partial_diaphragms else "setbacks")
        if not self.columns:
            raise self._refuse("no column stands in it [E-SPACE-05]", "missing", "columns")
        if loose := self._loose_nodes():
            message = f"beams at right angles end at {listed(loose)}, where it has no member itself [E-SPACE-05]"
            raise self._refuse(message, "missing")
        if alone and not self.resists and (firm := [other.name for other in parallel_frames(self) if other.resists]):
            message = (
                f"it leans on others, as its beams are pinned and it has no braces; extract {listed(firm)} [E-SPACE-05]"
            )
            beam = next(iter(self.beams), None)
            raise self._refuse(message, *(keys_of_member(self.building, str(beam)) if beam else ("beams",)))

    def _loose_nodes(self) -> list[str]:
        """Nodes on its lines at which none of its own members ends."""
        own = {(self.lines[i], floor) for i, storey in self.columns for floor in (storey - 1, storey)}
        own |= {(line, place.floor) for place in self.beams for line in place.lines}
        there = self.building.layout.node_lines
        return [
            node_name(line, floor)
            for floor, lines in there.items()
            for line in self.lines
            if line in lines and (line, floor) not in own
        ]

    def _refuse(self, message: str, *keys: str | int) -> InputError:
        return InputError(f"{self.building.where(*keys)}: frame {self.name}: {message}")


def plane_frame(building: Building, space: SpaceFrame, name: str) -> PlaneFrame:
    """Return a plane frame of a building by its name.

    Args:
        building: from `load_building`.
        name: `X2` along x on line 2, `YA` along y on line A.

    Raises:
        InputError: there is no such frame.
    """
    names = {a: [frame_name(a, i, building.axes) for i in range(building.n_frames(a))] for a in DIRECTIONS}
    for alike in (str, str.upper):  # 2a and 2A may both be lines
        for along, of in names.items():
            if alike(name.strip()) in (known_by := [alike(one) for one in of]):
                return PlaneFrame(building, space, along, known_by.index(alike(name.strip())))
    known = " and ".join(f"{of[0]} to {of[-1]}" for of in names.values())
    raise InputError(
        f"{building.path}: there is no frame `{name}`; the frames are {known}; X and Y are all of a direction"
        " [E-NAME-01]"
    )


def parallel_frames(frame: PlaneFrame) -> list[PlaneFrame]:
    """Return all frames of the building in the direction of one, with itself.

    Args:
        frame: one of them.
    """
    count = frame.building.n_frames(frame.along)
    return [PlaneFrame(frame.building, frame.space, frame.along, number) for number in range(count)]


def _pinned(ends: Ends) -> bool:
    return ends.start == ends.end == "pinned"
