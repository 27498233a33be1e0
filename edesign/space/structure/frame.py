"""A space frame: nodes, members, floors and load cases of a building.

Axes. Global x and y are horizontal, z points upwards. Local x of a member runs from its start to its end. Local z is
the direction of the web, local y completes a right-handed system, so that bending about local y is bending about the
strong axis of an I section, as in EN 1993-1-1, 1.7.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Literal

import numpy as np

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building.layout import Diaphragm

Kind = Literal["column", "beam", "brace"]
RIGID = float("inf")
NO_DIAPHRAGM = -1


PLACES = ("ends", "length", "columns", "webs", "storey", "in_compression", "passes_moment", "level_of_nodes")
"""What a `SpaceFrame` derives from its nodes and the places of its members."""

Axis = Literal["x", "y"]
AXES: tuple[Axis, Axis] = ("x", "y")


@dataclass(frozen=True)
class Member:
    """A straight prismatic member between two nodes.

    Attributes:
        name: `C_A2_3` (column line A2, storey 3), `BX_2_1_5` (frame, bay, floor), `DY_A_1_5_r`.
        start, end: numbers of its nodes; columns and braces start at their lower end.
        section: name in the catalogue, or of the file.
        material: name of the file.
        group: members of one group have one section.
        web: direction of local z, (3,), of length 1, at right angles to the member.
        ends: rotational stiffness (about y at start, z at start, y at end, z at end), N m/rad; `RIGID`, or 0 for a pin.
        stiffness_factor: of E I about the strong axis, of a beam with which a slab acts; KF on E A of a
            buckling-restrained brace, whose ends are stiffer than its core.
        axial_only: pinned about all axes at both ends, without bending.
        bracing: of a brace the kind that the file gives: `alternating`, `rising`, `falling`, `cross`, `chevron`, `v`.
        compression: whether it counts in compression; diagonals of EN 1998-1, 6.7.2(2)P do not.
        storey: 1 at the bottom; of a beam that of the storey below its floor.
        frame: plane frames that it stands in: `X2` along x on line 2, `YA` along y on line A; a column is in two.
        bay: of a beam or a brace, 1 at the beginning; 0 of a column.
        beam: of a part of a beam that braces meet, the name of the whole; "" of all others.
        part: where a part of a beam begins and ends, as fractions of the whole.
        link: whether it is a seismic link (EN 1998-1, 6.8).
        eccentric: of a brace whether it meets a link, of a part of a beam whether it or a part beside it is one.
    """

    name: str
    kind: Kind
    start: int
    end: int
    section: str
    material: str
    group: str
    web: tuple[float, float, float]
    ends: tuple[float, float, float, float] = (RIGID, RIGID, RIGID, RIGID)
    stiffness_factor: float = 1.0
    axial_only: bool = False
    bracing: str = ""
    compression: bool = True
    storey: int = 0
    frame: tuple[str, ...] = ()
    bay: int = 0
    beam: str = ""
    part: tuple[float, float] = (0.0, 1.0)
    link: bool = False
    eccentric: bool = False


@dataclass(frozen=True)
class LoadCase:
    """Loads of one action.

    Attributes:
        name: `G`, `Q`.
        category: `permanent`, the category of use of EN 1991-1-1 (A to H), `snow`, `wind`, or one of the file.
        nodal: (n_nodes, 6) forces and moments on nodes, global, N and N m.
        uniform: (n_members, 3) force a length of the member, global, N/m.
        point_member, point_position, point_force: (p,) member, (p,) place as a fraction of its length, (p, 3) N.
        own: whether it is one of `loads.cases`, which belong to the elastic design alone and bring no masses.
        relieving: whether it may relieve what others load, as it acts sideways or upwards.
    """

    name: str
    category: str
    nodal: np.ndarray
    uniform: np.ndarray
    point_member: np.ndarray
    point_position: np.ndarray
    point_force: np.ndarray
    own: bool = False
    relieving: bool = False

    @property
    def sideways(self) -> bool:
        """Whether it has horizontal forces, or moments about the vertical."""
        return bool(self.nodal[:, [0, 1, 5]].any())


@dataclass(frozen=True)
class SpaceFrame:
    """A building as nodes, members, rigid floors and load cases; values in SI.

    Attributes:
        node_names: `A2.3`: column line A2, floor 3; floor 0 is the base. `BX_2_1_5`: the middle of that beam;
            `BX_2_1_5.1`: an end of the link in it.
        coordinates: (n_nodes, 3) m.
        node_diaphragm: (n_nodes,) number in `diaphragms` of what ties it; `NO_DIAPHRAGM`: nothing does.
        levels: (n_floors + 1,) level of each floor above the base, m; the base is first.
        fixed: (n_nodes, 6) True where ux, uy, uz, rx, ry, rz is restrained.
        springs: (n_nodes, 6) stiffness of elastic supports, N/m and N m/rad; 0 elsewhere.
        members: columns, beams, braces.
        cases: load cases by name.
        node_mass: (n_nodes,) kg, acts horizontally at the node.
        own_sections: of the file, by name.
        diaphragms: rigid floors, and rigid parts of floors, from below.
        held: the highest floor that the ground holds in plan; 0: none above the base.
    """

    node_names: tuple[str, ...]
    coordinates: np.ndarray
    node_diaphragm: np.ndarray
    levels: np.ndarray
    fixed: np.ndarray
    springs: np.ndarray
    members: tuple[Member, ...]
    cases: dict[str, LoadCase]
    node_mass: np.ndarray
    own_sections: Mapping[str, SteelSection] = field(default_factory=dict)
    diaphragms: tuple[Diaphragm, ...] = ()
    held: int = 0

    def section(self, name: str) -> SteelSection:
        """Return a section that a member names: one of the file, or one of the catalogue.

        Raises:
            InputError: there is no such section.
        """
        own = self.own_sections.get(name)
        return steel_section(name) if own is None else own

    @cached_property
    def unclassified(self) -> np.ndarray:
        """Numbers of the members whose section has no class, so that no clause checks them."""
        pairs, of_members = self.sections
        without = np.array([not self.section(name).has_class for name, _ in pairs], dtype=bool)
        return np.flatnonzero(without[of_members])

    @property
    def n_floors(self) -> int:
        """Number of floors above the base."""
        return len(self.levels) - 1

    @property
    def heights(self) -> np.ndarray:
        """Heights of the floors above the level where the seismic action acts, (n_floors + 1,) m; 0 below it.

        Source: EN 1998-1:2004, 4.3.3.2.3(3): the foundation, or the top of a rigid basement.
        """
        return np.maximum(self.levels - self.levels[self.held], 0.0)

    @cached_property
    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Numbers of the start and end nodes of the members, (n_members,) each."""
        start, end = np.array([[member.start, member.end] for member in self.members]).T
        return start, end

    @cached_property
    def length(self) -> np.ndarray:
        """Lengths of the members, (n_members,) m."""
        start, end = self.ends
        return np.asarray(np.linalg.norm(self.coordinates[end] - self.coordinates[start], axis=1))

    @cached_property
    def sections(self) -> tuple[tuple[tuple[str, str], ...], np.ndarray]:
        """The pairs of section and material that occur, and which of them each member has, (n_members,)."""
        numbers: dict[tuple[str, str], int] = {}
        of_members = [numbers.setdefault((member.section, member.material), len(numbers)) for member in self.members]
        return tuple(numbers), np.array(of_members, dtype=int)

    @cached_property
    def columns(self) -> np.ndarray:
        """Numbers of the columns."""
        return np.array([number for number, member in enumerate(self.members) if member.kind == "column"], dtype=int)

    @cached_property
    def webs(self) -> np.ndarray:
        """Directions of local z of the members, (n_members, 3)."""
        return np.array([member.web for member in self.members]).reshape(-1, 3)

    @cached_property
    def storey(self) -> np.ndarray:
        """Storey of each member, from 0, (n_members,)."""
        return np.array([member.storey - 1 for member in self.members])

    @cached_property
    def in_compression(self) -> np.ndarray:
        """True for each member that counts in compression, (n_members,)."""
        return np.array([member.compression for member in self.members], dtype=bool)

    @cached_property
    def passes_moment(self) -> np.ndarray:
        """True for each start and end that passes moments about y on, (n_members, 2)."""
        return np.array([(member.ends[0], member.ends[2]) for member in self.members]).reshape(-1, 2) > 0.0

    @cached_property
    def level_of_nodes(self) -> np.ndarray:
        """Floor at the level of each node, 0 at the base, (n_nodes,); nodes between two floors count up."""
        return np.searchsorted(self.levels, self.coordinates[:, 2] - 1e-9 * self.levels[-1])

    @property
    def acting_mass(self) -> float:
        """Mass that the seismic action moves, that of the floors above the base or a rigid basement, kg."""
        return float(self.node_mass[self.level_of_nodes > self.held].sum())

    @cached_property
    def diaphragm_sizes(self) -> np.ndarray:
        """Lengths along x and y of what accidental eccentricity goes by, (n_diaphragms, 2) m.

        It is the whole floor where it has one diaphragm, and otherwise its own nodes.
        """
        found = []
        for number, at in enumerate(self.diaphragms):
            own = self.node_diaphragm == number if at.part else self.level_of_nodes == at.floor
            found.append(np.ptp(self.coordinates[own, :2], axis=0))
        return np.array(found).reshape(-1, 2)

    def with_sections(
        self, members: tuple[Member, ...], cases: Mapping[str, LoadCase], node_mass: np.ndarray
    ) -> SpaceFrame:
        """Return the frame with other sections in the same places, and what depends on them.

        Args:
            members: as they are, but for their sections.
            cases: load cases with the weight of these sections.
            node_mass: masses of the nodes with them.

        Returns:
            The other frame.
        """
        found = replace(self, members=members, cases=dict(cases), node_mass=node_mass)
        for name in (*PLACES, "sections") if members is self.members else PLACES:
            vars(found)[name] = getattr(self, name)
        return found
