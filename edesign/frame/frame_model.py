"""A frame in the core: its parts by their names."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

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
from edesign.frame.supports import BuiltFooting, Grounds
from edesign.project.frame.frame import Frame
from edesign.project.notation import names
from edesign.project.notation.names import MemberKind


@dataclass(frozen=True)
class Member:
    """A member of the model.

    Attributes:
        element: its id in the core; of a member with hinges the part between them.
        start, end: names of its nodes; a column starts below, beams and braces start at the left.
        layers: depths of its layers of fibres above the centroid, bottom to top, m; None for braces, elastic members.
        parts: its elements from the start: most members are one.
        stretches: where these stand on it.
        springs: hinges and joints at its start and at its end.
        yield_elongation: f_y L / E of a brace that buckles, m; infinite: it does not yield; None: it does not buckle.
        rigid_ends: lengths at its start and end that do not bend, m.
    """

    name: str
    kind: MemberKind
    element: int
    start: str
    end: str
    layers: np.ndarray | None = None
    parts: tuple[int, ...] = ()
    stretches: Stretches = Stretches((0.0, 0.0), ())
    springs: tuple[tuple[EndSpring, ...], tuple[EndSpring, ...]] = ((), ())
    yield_elongation: float | None = None
    rigid_ends: tuple[float, float] = (0.0, 0.0)

    @property
    def yields(self) -> bool:
        """True if the member can yield in bending."""
        return self.layers is not None or any(spring.yields for end in self.springs for spring in end)

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
class FrameModel:
    """A frame in the core, with the names of its parts.

    Attributes:
        model: the core's model; loads may be added until an analysis is made of it.
        gravity: the load pattern of the gravity combination.
        nodes: ids by name, floor by floor from the left.
        members: by name, columns, then beams, then braces.
        masses: kg that resist horizontal motion, by node.
        supports: restrained degrees of freedom (ux, uy, rz) of each supported node, by name.
        devices: its dampers.
        attached: nodes of its tuned masses, by name.
        panels: its panel zones by the node of their joint.
        moving_with: nodes behind hinges and joints that share the displacements of a node, by its id.
        grounds: of supported nodes on springs the other end of these, for each degree; None: no spring restrains it.
        leaning: its leaning column, whose nodes and struts are none of the above.
        footings: by the supported nodes that stand on them.
        isolated: its isolated base, whose devices are among its dampers; None: it stands on its supports.
        on_bases: loads of the gravity combination on the column bases of an isolated base, N downwards, by the name of
            the node.
    """

    frame: Frame
    model: Model
    gravity: int
    nodes: dict[str, int]
    members: dict[str, Member]
    masses: dict[str, float]
    supports: dict[str, tuple[bool, bool, bool]]
    devices: tuple[Device, ...] = ()
    attached: dict[str, int] = field(default_factory=dict)
    grounds: dict[str, Grounds] = field(default_factory=dict)
    moving_with: dict[int, list[int]] = field(default_factory=dict)
    panels: dict[str, BuiltPanel] = field(default_factory=dict)
    leaning: LeaningStruts | None = None
    footings: dict[str, BuiltFooting] = field(default_factory=dict)
    isolated: IsolatedBases | None = None
    on_bases: Mapping[str, float] = field(default_factory=dict)

    @property
    def mass(self) -> float:
        """Total mass, kg."""
        return float(sum(self.masses.values()))

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

    def reaction(self, support: str, degree: int) -> tuple[tuple[float, str, int, int], ...]:
        """Return the reaction at a degree of a supported node, as terms of the core.

        A column that stands on a hinge or joint pushes at a node of its own; isolators hold back the base, and what
        loads it at a support goes there at once.

        Args:
            degree: 0 ux, 1 uy, 2 rz.
        """
        if degree == 0 and self.isolated is not None:
            return tuple((-1.0, "damper_force", number, 0) for number in self.isolated.at(support))
        ground = self.grounds.get(support, (None, None, None))[degree]
        if ground is not None:
            return ((1.0, "reaction", ground, degree),)
        node = self.nodes[support]
        pushed = [node] if degree == 2 else [node, *self.moving_with.get(node, ())]
        terms = tuple((1.0, "reaction", at, degree) for at in pushed)
        load = self.on_bases.get(support, 0.0) if degree == 1 else 0.0
        return terms if load == 0.0 else (*terms, (load, "load_factor", self.gravity, 0))

    def of_kind(self, kind: MemberKind) -> list[Member]:
        """Return the members of a kind in the order of `members`."""
        return [member for member in self.members.values() if member.kind == kind]

    def floor_nodes(self, floor: int) -> list[str]:
        """Return the names of the nodes at a floor on column lines, from the left.

        Args:
            floor: from 0 at the ground.
        """
        return [name for line in self.frame.lines if (name := names.node_name(line, floor)) in self.nodes]

    def level_nodes(self, floor: int) -> list[str]:
        """Return the names of all nodes at a floor, those in the middle of beams too.

        Args:
            floor: from 0 at the ground.
        """
        level = self.frame.levels[floor]
        return [name for name in self.nodes if self.frame.nodes[name][1] == level]

    @cached_property
    def leading_nodes(self) -> list[str]:
        """First node from the left of each floor from 1, which stands for the floor."""
        return [self.frame.leading_node(floor) for floor in range(1, self.frame.n_storeys + 1)]
