"""A building in three dimensions as plain numbers, the same for every program that builds it.

`peer_building` takes them from the space frame of a building file. Values are in SI units (m, N, kg, Pa). Axes are
those of `edesign.space.structure.frame`: z upwards; local x along the member, local z along its web, local y completes
a right-handed system. Masters of rigid floors stand behind the nodes, at the centres of mass.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from edesign.frame.sections.space_section import SpaceSection, space_section
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building.building import Building
from edesign.space.structure.frame import RIGID, SpaceFrame
from edesign.space.structure.masses import psi_2
from edesign.space.structure.model import TENSION_ONLY_SHARE

Array = NDArray[np.float64]
Law = Literal["elastic", "bilinear", "menegotto_pinto"]
Geometry = Literal["linear", "p_delta", "corotational"]
DampingStiffness = Literal["initial", "committed", "current"]

MOST_POINTS = 10  # of a force-based element in OpenSees, which shares those between two pieces
PROJECTS = Path(__file__).resolve().parents[2] / "projects"


@dataclass(frozen=True)
class PeerSection:
    """A section of fibres with elastic torsion.

    name: of the section; fibres: y, z, m, and area, m2, (n,) each; area: of a bar, m2; E, fy: of its steel, Pa; GJ:
    torsional stiffness, N m2.
    """

    name: str
    fibres: SpaceSection
    area: float
    E: float
    fy: float
    GJ: float


@dataclass(frozen=True)
class PeerMember:
    """A member between two nodes.

    name, kind: as in the space frame; start, end: numbers of its nodes; section: its number; web: direction of local z,
    global; pins: moment-free about (y at start, z at start, y at end, z at end); bar: carries an axial force alone;
    share: of the area of a bar that acts.
    """

    name: str
    kind: str
    start: int
    end: int
    section: int
    web: tuple[float, float, float]
    pins: tuple[bool, bool, bool, bool] = (False, False, False, False)
    bar: bool = False
    share: float = 1.0


@dataclass(frozen=True)
class PointLoad:
    """A force on a member: position as a fraction of its length, force along local x, y, z, N."""

    member: int
    position: float
    force: tuple[float, float, float]


@dataclass(frozen=True)
class PeerBuilding:
    """A building with the loads and masses of the seismic design situation.

    title: of tables; names: of the nodes, without the masters; coordinates: (n_nodes, 3), m; fixed: (n_nodes, 6), True
    where ux, uy, uz, rx, ry, rz is supported; diaphragms: nodes of each rigid floor; masters: (n_diaphragms, 3), m;
    mass: (n_nodes + n_diaphragms, 6) of nodes and masters, kg and kg m2, nodes of rigid floors have none; nodal:
    (n_nodes, 6) gravity loads, N and N m, those along members and on bars included; uniform: (n_members, 3) those along
    local x, y, z, N/m; points: those at places; steel: law of the fibres; hardening: E_t / E; geometry: of columns and
    beams; stations: Gauss-Lobatto points of a member; damping: ratio of Rayleigh damping by mass and stiffness;
    damped_modes: two modes under gravity that have it, from 1; damping_stiffness: of which state.
    """

    title: str
    names: tuple[str, ...]
    coordinates: Array
    fixed: NDArray[np.bool_]
    diaphragms: tuple[NDArray[np.int_], ...]
    masters: Array
    mass: Array
    sections: tuple[PeerSection, ...]
    members: tuple[PeerMember, ...]
    nodal: Array
    uniform: Array
    points: tuple[PointLoad, ...]
    steel: Law = "bilinear"
    hardening: float = 0.01
    geometry: Geometry = "p_delta"
    stations: int = 5
    damping: float = 0.02
    damped_modes: tuple[int, int] = (1, 4)
    damping_stiffness: DampingStiffness = "initial"

    @property
    def n_nodes(self) -> int:
        """Number of nodes without the masters."""
        return len(self.coordinates)

    @property
    def n_floors(self) -> int:
        """Number of rigid floors."""
        return len(self.diaphragms)

    @cached_property
    def supports(self) -> tuple[int, ...]:
        """Numbers of the nodes that are supported."""
        return tuple(int(node) for node in np.flatnonzero(self.fixed.any(axis=1)))

    @cached_property
    def watched(self) -> int:
        """Number of the column whose forces are compared, the first one."""
        return next(number for number, member in enumerate(self.members) if member.kind == "column")

    @cached_property
    def breaks(self) -> dict[int, tuple[float, ...]]:
        """Places of point loads inside members, by their numbers, between which members are integrated."""
        places: dict[int, set[float]] = {}
        for load in self.points:
            if 0.0 < load.position < 1.0:
                places.setdefault(load.member, set()).add(load.position)
        return {number: tuple(sorted(found)) for number, found in places.items()}

    def points_of_pieces(self, number: int) -> int:
        """Gauss-Lobatto points of each piece of a member; OpenSees' force-based element has 10 at most."""
        pieces = 1 + len(self.breaks.get(number, ()))
        return min(self.stations, 1 + (MOST_POINTS - 1) // pieces)

    @cached_property
    def weight(self) -> float:
        """Sum of the gravity loads, N."""
        total = -float(self.nodal[:, 2].sum())
        for number, member in enumerate(self.members):
            axis = self.coordinates[member.end] - self.coordinates[member.start]
            along = self.uniform[number] * np.linalg.norm(axis)
            along = along + sum(np.array(load.force) for load in self.points if load.member == number)
            total -= float(local_axes(axis, member.web)[:, 2] @ along)
        return total

    @cached_property
    def corners(self) -> Array:
        """Places of the corners of each rigid floor from its master, (n_floors, 4, 2), m."""
        ways = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)], float)
        found = []
        for nodes, master in zip(self.diaphragms, self.masters, strict=True):
            plan = self.coordinates[nodes, :2] - master[:2]
            found.append([plan[int(np.argmax(plan @ way))] for way in ways])
        return np.array(found)


@dataclass
class BuildingHistory:
    """What a program found; rows begin after gravity, at the time 0.

    status: "completed" or "failed"; steps: done; cpu_s: of their loop; cost: what it went into, for people; bare,
    loaded: periods without loads and under gravity, s; rayleigh: factors of mass and stiffness, 1/s and s; frozen:
    steps of edesign whose damping has the stiffness of their start; floors:
    (steps + 1, n_floors, 3) ux, uy, rz of the masters from the ground, m and rad; accelerations: (steps + 1, n_floors,
    2) total ones along x and y, m/s2; base_shear: (steps + 1, 2) reactions to the members' forces, N; column: (steps +
    1, 3) N, M_y, M_z at the start of the watched column, N and N m.
    """

    status: str = "completed"
    steps: int = 0
    cpu_s: float = 0.0
    cost: str = ""
    bare: Array = field(default_factory=lambda: np.zeros(0))
    loaded: Array = field(default_factory=lambda: np.zeros(0))
    rayleigh: tuple[float, float] = (0.0, 0.0)
    frozen: tuple[int, ...] = ()
    floors: Array = field(default_factory=lambda: np.zeros((0, 0, 3)))
    accelerations: Array = field(default_factory=lambda: np.zeros((0, 0, 2)))
    base_shear: Array = field(default_factory=lambda: np.zeros((0, 2)))
    column: Array = field(default_factory=lambda: np.zeros((0, 3)))

    def corners(self, building: PeerBuilding) -> Array:
        """Displacements along x and y of the corners of each floor, (steps + 1, n_floors, 4, 2), m."""
        x, y = building.corners[..., 0], building.corners[..., 1]
        turn = self.floors[:, :, None, 2]
        return np.stack([self.floors[:, :, None, 0] - turn * y, self.floors[:, :, None, 1] + turn * x], axis=-1)

    def peaks(self, building: PeerBuilding) -> dict[str, float]:
        """Largest values by quantity and unit."""
        u = self.corners(building)
        heights = np.diff(building.masters[:, 2], prepend=building.coordinates[list(building.supports), 2].min())
        drift = np.abs(np.diff(u, axis=1, prepend=0.0)) / heights[:, None, None]
        found: dict[str, float] = {}
        for axis, name in enumerate("xy"):
            found |= {
                f"roof displacement of the centre along {name}, m": np.abs(self.floors[:, -1, axis]).max(),
                f"roof displacement of the corners along {name}, m": np.abs(u[:, -1, :, axis]).max(),
                f"storey drift of the corners along {name}, %": 100.0 * drift[..., axis].max(),
                f"base shear along {name}, kN": 1e-3 * np.abs(self.base_shear[:, axis]).max(),
                f"roof acceleration along {name}, m/s2": np.abs(self.accelerations[:, -1, axis]).max(),
            }
        found["roof turn, mrad"] = 1e3 * np.abs(self.floors[:, -1, 2]).max()
        for i, name in enumerate(("N, kN", "M_y, kNm", "M_z, kNm")):
            found[f"{building.members[building.watched].name} {name}"] = 1e-3 * np.abs(self.column[:, i]).max()
        return {name: float(value) for name, value in found.items()}


def local_axes(axis: Array, web: tuple[float, float, float]) -> Array:
    """Local x, y, z of a member as rows of global components, (3, 3)."""
    x = axis / np.linalg.norm(axis)
    return np.stack([x, np.cross(web, x), web])


def peer_building(building: Building, frame: SpaceFrame) -> PeerBuilding:
    """A building as plain numbers, with G + phi psi_2 Q as gravity loads, as its masses have them.

    Raises:
        ValueError: supports or ends of members are springs.
    """
    if frame.springs.any():
        raise ValueError("elastic supports are not in the peers")
    diaphragms = tuple(np.flatnonzero(frame.node_diaphragm == number) for number in range(len(frame.diaphragms)))
    masters, mass = _masses(frame, diaphragms)
    nodal, uniform, points = _gravity(building, frame)
    pairs, of_members = frame.sections
    sections = [(name, building.materials[steel]) for name, steel in pairs]
    return PeerBuilding(
        title=building.title,
        names=frame.node_names,
        coordinates=frame.coordinates,
        fixed=frame.fixed,
        diaphragms=diaphragms,
        masters=masters,
        mass=mass,
        sections=tuple(peer_section(name, steel.E, steel.fy, steel.nu) for name, steel in sections),
        members=tuple(
            PeerMember(
                member.name,
                member.kind,
                member.start,
                member.end,
                int(of_members[number]),
                member.web,
                _pins(member.name, member.ends),
                member.axial_only,
                1.0 if member.compression else TENSION_ONLY_SHARE,
            )
            for number, member in enumerate(frame.members)
        ),
        nodal=nodal,
        uniform=uniform,
        points=points,
    )


def peer_section(name: str, E: float, fy: float, nu: float) -> PeerSection:
    """A section of the catalogue with its steel: E and fy in Pa."""
    section = space_section(name)
    return PeerSection(name, section, steel_section(name).A, E, fy, E / (2.0 * (1.0 + nu)) * section.I_t)


def _pins(name: str, ends: tuple[float, float, float, float]) -> tuple[bool, bool, bool, bool]:
    if any(value not in (0.0, RIGID) for value in ends):
        raise ValueError(f"{name}: elastic ends are not in the peers")
    y_start, z_start, y_end, z_end = (value == 0.0 for value in ends)
    return y_start, z_start, y_end, z_end


def _masses(frame: SpaceFrame, diaphragms: tuple[NDArray[np.int_], ...]) -> tuple[Array, Array]:
    """Masters at the centres of mass, and masses of nodes and masters."""
    n = len(frame.node_names)
    masters, mass = np.zeros((len(diaphragms), 3)), np.zeros((n + len(diaphragms), 6))
    mass[:n, :2] = frame.node_mass[:, None]
    for k, nodes in enumerate(diaphragms):
        own, plan = frame.node_mass[nodes], frame.coordinates[nodes, :2]
        masters[k] = (*np.average(plan, axis=0, weights=own), frame.coordinates[nodes[0], 2])
        mass[nodes] = 0.0
        mass[n + k, :2] = own.sum()
        mass[n + k, 5] = own @ np.sum((plan - masters[k, :2]) ** 2, axis=1)
    return masters, mass


def _gravity(building: Building, frame: SpaceFrame) -> tuple[Array, Array, tuple[PointLoad, ...]]:
    """Loads of G + phi psi_2 Q: on nodes, along members (local), at places of members (local)."""
    nodal, uniform = np.zeros((len(frame.node_names), 6)), np.zeros((len(frame.members), 3))
    forces: dict[tuple[int, float], Array] = {}
    phi = 1.0 if building.masses is None else building.masses.phi
    for case in frame.cases.values():
        factor = 1.0 if case.category == "permanent" else phi * psi_2(building, case.category)
        nodal += factor * case.nodal
        uniform += factor * case.uniform
        for member, position, force in zip(case.point_member, case.point_position, case.point_force, strict=True):
            key = int(member), float(position)
            forces[key] = forces.get(key, np.zeros(3)) + factor * force
    axes = [local_axes(frame.coordinates[m.end] - frame.coordinates[m.start], m.web) for m in frame.members]
    along = np.array([own @ q for own, q in zip(axes, uniform, strict=True)])
    for number, member in enumerate(frame.members):
        # what acts along a member goes to its ends: OpenSees takes its P-Delta from the axial force at the end
        to_ends = along[number] * (1.0 if member.axial_only else np.array([1.0, 0.0, 0.0]))
        along[number] -= to_ends
        for node in (member.start, member.end):
            nodal[node, :3] += 0.5 * frame.length[number] * (to_ends @ axes[number])
    points = []
    for (number, position), force in sorted(forces.items()):
        x, y, z = (float(value) for value in axes[number] @ force)
        points.append(PointLoad(number, position, (x, y, z)))
    return nodal, along, tuple(points)
