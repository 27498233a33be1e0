"""A frame in the core: its parts by their names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from edesign.core import Model
from edesign.frame.devices import Device
from edesign.frame.hinges import EndSpring
from edesign.frame.isolation import (
    IsolatedBases,
)
from edesign.frame.leaning_column import LeaningStruts
from edesign.frame.loads import Stretches
from edesign.frame.panel_zones import BuiltPanel
from edesign.frame.struts import Bar
from edesign.frame.supports import BuiltFooting, Grounds
from edesign.project.frame.materials import Material
from edesign.project.notation.grid import Grid
from edesign.project.notation.names import MemberKind

Sum = tuple[tuple[float, int, int], ...]
"""A displacement as a sum: coefficient, node and degree of the core."""
Terms = tuple[tuple[float, str, int, int], ...]
"""A sum of what the core records: coefficient, kind, item, and component or degree."""


@dataclass(frozen=True)
class Bending:
    """A plane in which members bend, by components of what the core records of an element.

    Attributes:
        axis: local axis about which they bend, "y" or "z" (EN 1993-1-1, 1.7); "" of a plane frame.
        shear, moment: of `end_force` at the start and the end.
        plastic: of `plastic_rotation` at both.
        chord: of `deformation`: rotations of both ends against the chord.
    """

    axis: str
    shear: tuple[int, int]
    moment: tuple[int, int]
    plastic: tuple[int, int]
    chord: tuple[int, int]


IN_PLANE = (Bending("", shear=(1, 4), moment=(2, 5), plastic=(0, 1), chord=(1, 2)),)
"""How members of a plane frame bend."""
IN_SPACE = (
    Bending("y", shear=(2, 8), moment=(4, 10), plastic=(2, 3), chord=(3, 4)),
    Bending("z", shear=(1, 7), moment=(5, 11), plastic=(0, 1), chord=(1, 2)),
)
"""How members in space bend."""


@dataclass(frozen=True)
class Member:
    """A member of the model.

    Attributes:
        element: its id in the core; of a member with hinges the part between them.
        start, end: names of its nodes; a column starts below, beams and braces start at the left.
        section, material: their names.
        steel: the law of the material.
        length: between its nodes, m.
        bending: the planes in which it bends; () of a bar in space.
        axial: components of `end_force` along it, at its start and end.
        torque: those about it; None of a plane frame and of braces.
        frames: plane frames of a building that it stands in.
        fibres: depths of its layers of fibres above the centroid, bottom to top, m; in space (n, 2) places along local
            y and z; None for braces, elastic members.
        outer: numbers of the fibres of which one yields first.
        points: its sections along `element`.
        parts: its elements from the start: most members are one.
        stretches: where these stand on it.
        springs: hinges and joints at its start and at its end; in space they turn about local y.
        axes: local x, y, z of a column or beam in space.
        yield_elongation: f_y L / E of a brace that buckles, m; infinite: it does not yield; None: it does not buckle.
        fractures: whether fibres of a brace that buckles can break.
        rigid_ends: lengths at its start and end that do not bend, m.
        bar: the column or brace as one in compression.
    """

    name: str
    kind: MemberKind
    element: int
    start: str
    end: str
    section: str
    material: str
    steel: Material
    length: float
    bending: tuple[Bending, ...] = IN_PLANE
    axial: tuple[int, int] = (0, 3)
    torque: tuple[int, int] | None = None
    frames: tuple[str, ...] = ()
    fibres: np.ndarray | None = None
    outer: tuple[int, ...] = ()
    points: int = 0
    parts: tuple[int, ...] = ()
    stretches: Stretches = Stretches((0.0, 0.0), ())
    springs: tuple[tuple[EndSpring, ...], tuple[EndSpring, ...]] = ((), ())
    yield_elongation: float | None = None
    fractures: bool = False
    rigid_ends: tuple[float, float] = (0.0, 0.0)
    bar: Bar | None = None
    axes: tuple[tuple[float, ...], ...] = ()

    def springs_about(self, end: int, bending: Bending) -> tuple[EndSpring, ...]:
        """Return the hinges and joints that turn in one of the planes in which the member bends.

        Args:
            end: 0: start, 1: end.
        """
        return () if bending.axis == "z" else self.springs[end]

    @property
    def yields(self) -> bool:
        """True if the member can yield in bending."""
        return self.fibres is not None or any(spring.yields for end in self.springs for spring in end)

    @property
    def bending_stretches(self) -> Stretches:
        """Stretches of the member that bend: its elements without their rigid ends, which are arms."""
        if not any(self.rigid_ends):
            return self.stretches
        return Stretches(self.rigid_ends, (self.stretches.length - sum(self.rigid_ends),))

    def at_end(self, end: int) -> int:
        """Return the element at the start or the end of the member.

        Args:
            end: 0: start, 1: end.
        """
        return self.parts[-end]


@dataclass(frozen=True)
class Direction:
    """A horizontal direction in which floors move.

    Attributes:
        name: "" of a plane frame, whose results know no direction.
        degree: of the core.
    """

    name: str
    degree: int


@dataclass(frozen=True)
class RigidPart:
    """One of several diaphragms of a floor of a building.

    Attributes:
        name: number of the floor and its own, such as `3.2`.
        movers: by direction the displacement of its centre of mass, as of a `Floor`.
        turn: its turn about the vertical.
        nodes: names of the nodes that it ties, and last of the one at its centre of mass.
    """

    name: str
    movers: tuple[tuple[Sum, ...], ...]
    turn: Sum
    nodes: tuple[str, ...]


@dataclass(frozen=True)
class Floor:
    """A floor above the base.

    Attributes:
        level: above the base, m.
        movers: by direction the displacements that count alike in the mean of the floor, the leading one first; of a
            plane frame those of the nodes on column lines, of a rigid floor of a building that of its centre of mass.
        nodes: names of all nodes at its level.
        gravity: loads of the gravity combination on it, N downwards.
        turn: its turn about the vertical; () of a plane frame, and of a floor that does not turn as one.
        points: by the name of a place of a building its displacements by direction.
        parts: its diaphragms, if it has several.
    """

    number: int
    level: float
    movers: tuple[tuple[Sum, ...], ...]
    nodes: tuple[str, ...]
    gravity: float
    turn: Sum = ()
    points: Mapping[str, tuple[Sum, ...]] = field(default_factory=dict)
    parts: tuple[RigidPart, ...] = ()

    @property
    def rigid(self) -> tuple[Floor | RigidPart, ...]:
        """What turns about the vertical as one: its diaphragms, the floor itself, or nothing."""
        return self.parts or ((self,) if self.turn else ())


@dataclass(frozen=True)
class DriftLine:
    """A column line on which a storey drifts.

    Attributes:
        line: its name.
        ratio: drift ratio of the storey on it.
        frames: plane frames of a building along the direction that it stands in.
    """

    line: str
    ratio: Sum
    frames: tuple[str, ...] = ()


@dataclass(frozen=True)
class Storey:
    """A storey, below the floor of its number.

    Attributes:
        height: m.
        drifts: by direction the column lines on which it drifts.
        shear: by direction the force on the upper ends of its columns and braces.
        torque: of these forces about the vertical through the centre of mass of the floor above; () of a plane frame.
    """

    number: int
    height: float
    drifts: tuple[tuple[DriftLine, ...], ...]
    shear: tuple[Terms, ...]
    torque: Terms = ()


@dataclass(frozen=True)
class Sinking:
    """What shows whether loads sank so far that it is meaningless.

    Attributes:
        loads: sum of the magnitudes of the gravity combination, N.
        work_inside: work of the loads on elastic beams as if they were simply supported, J, which the energy balance
            leaves out. It is the same for any moments at the ends of their elements: the integral of M^2 / (2 E I).
        half_span: half of a mean bay, m.
    """

    loads: float
    work_inside: float
    half_span: float


@dataclass(frozen=True)
class FrameModel:
    """A frame in the core, with the names of its parts.

    Attributes:
        grid: what stands where.
        model: the core's model; loads may be added until an analysis is made of it.
        gravity: the load pattern of the gravity combination.
        sinking: to see how far its loads sink.
        nodes: ids by name, floor by floor from the left.
        places: coordinates of the nodes, m; the last one is the level.
        members: by name, columns, then beams, then braces.
        floors, storeys: from the lowest.
        control: node of the roof whose displacement pushes control.
        directions: in which floors and storeys move.
        up: degree of the core along the vertical.
        still: names of the loaded beams that vertical ground motion does not bend.
        masses: kg that resist horizontal motion, by node.
        turning: kg m2 that resist turns about the vertical, by node: those of rigid floors of a building.
        supports: whether each degree of the core is restrained, of each supported node by name.
        devices: its dampers.
        attached: displacement of each tuned mass relative to its floor, by name, beginning with its own node.
        panels: its panel zones by the node of their joint.
        moving_with: nodes behind hinges and joints that share the displacements of a node, by its id.
        turning_apart: degree in which such a node of a building turns on its own, by its id.
        grounds: of supported nodes on springs the other end of these, for each degree; None: no spring restrains it.
        leaning: its leaning column, whose nodes and struts are none of the above.
        footings: by the supported nodes that stand on them.
        isolated: its isolated base, whose devices are among its dampers; None: it stands on its supports.
        on_bases: loads of the gravity combination on column bases themselves, those of an isolated base and of a
            building, N downwards, by the name of the node.
    """

    grid: Grid
    model: Model
    gravity: int
    sinking: Sinking
    nodes: dict[str, int]
    places: Mapping[str, tuple[float, ...]]
    members: dict[str, Member]
    floors: tuple[Floor, ...]
    storeys: tuple[Storey, ...]
    control: int
    directions: tuple[Direction, ...]
    up: int
    still: tuple[str, ...]
    masses: dict[str, float]
    supports: dict[str, tuple[bool, ...]]
    devices: tuple[Device, ...] = ()
    attached: dict[str, Sum] = field(default_factory=dict)
    grounds: dict[str, Grounds] = field(default_factory=dict)
    moving_with: dict[int, list[int]] = field(default_factory=dict)
    panels: dict[str, BuiltPanel] = field(default_factory=dict)
    leaning: LeaningStruts | None = None
    footings: dict[str, BuiltFooting] = field(default_factory=dict)
    isolated: IsolatedBases | None = None
    on_bases: Mapping[str, float] = field(default_factory=dict)
    turning: Mapping[str, float] = field(default_factory=dict)
    turning_apart: Mapping[int, int] = field(default_factory=dict)

    @property
    def mass(self) -> float:
        """Total mass, kg."""
        return float(sum(self.masses.values()))

    @property
    def bending(self) -> tuple[Bending, ...]:
        """The planes in which members bend; bars have none of them."""
        return IN_PLANE if self.model.dimension == 2 else IN_SPACE

    @property
    def brace_stiffness(self) -> np.ndarray | None:
        """Stiffness of every damper of the core in modes if it is a buckling-restrained brace, (n_dampers,) N/m.

        The braces have not yielded. None: there are no such braces.
        """
        braces = {device.number: device.restrained.stiffness for device in self.devices if device.restrained}
        if not braces:
            return None
        found = np.zeros(len(self.model.damper_names))
        found[list(braces)] = list(braces.values())
        return found

    @property
    def bars(self) -> list[Bar]:
        """Columns and braces, and braces of dampers that are given by their section, in compression."""
        found = [member.bar for member in self.members.values() if member.bar is not None]
        braces = ((device.name, device.brace_bar) for device in self.devices)
        return found + [Bar(name, "brace of a damper", of.section, of.strut) for name, of in braces if of is not None]

    def reaction(self, support: str, degree: int) -> Terms:
        """Return the reaction at a degree of a supported node, as terms of the core.

        A column that stands on a hinge or joint pushes at a node of its own; isolators hold back the base, and what
        loads it at a support goes there at once. A rigid floor of a building that the ground holds has at its master
        what members hand over to it; its own inertia goes into the ground at once.
        """
        if degree < self.up and self.isolated is not None:
            return tuple((-1.0, "damper_force", number, 0) for number in self.isolated.at(support, degree))
        ground = self.grounds[support][degree] if support in self.grounds else None
        if ground is not None:
            return ((1.0, "reaction", ground, degree),)
        node = self.nodes[support]
        if of_floor := [at for at, master in self.model.masters.items() if master == node]:
            return tuple(term for at in of_floor for term in self._on_master(at, degree))
        behind = self.moving_with.get(node, ())
        if degree > self.up:
            behind = [at for at in behind if self.turning_apart.get(at, degree) != degree]
        pushed = [node, *behind]
        terms = tuple((1.0, "reaction", at, degree) for at in pushed)
        load = self.on_bases.get(support, 0.0) if degree == self.up else 0.0
        return terms if load == 0.0 else (*terms, (load, "load_factor", self.gravity, 0))

    def _on_master(self, node: int, degree: int) -> Terms:
        """The part that a node of a rigid floor has in a reaction at the master of the floor."""
        found: Terms = ((1.0, "reaction", node, degree),)
        if self.model.degrees[degree] == "rz":
            found += tuple((lever, "reaction", node, at) for at, lever in enumerate(self.model.levers(node)))
        return found

    def of_kind(self, kind: MemberKind) -> list[Member]:
        """Return the members of a kind in the order of `members`."""
        return [member for member in self.members.values() if member.kind == kind]
