"""The members of a building in the core's model: fibres in two directions, or elastic ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from edesign.core import Model
from edesign.errors import InputError
from edesign.frame.frame_model import IN_SPACE, Member
from edesign.frame.hinges import MemberBuilder, MemberEnd
from edesign.frame.loads import MemberLoads, Stretches
from edesign.frame.panel_zones import BuiltPanel
from edesign.frame.sections.core_sections import core_law
from edesign.frame.sections.residual_stress import eccs_stresses, pattern_of
from edesign.frame.sections.space_section import space_section
from edesign.frame.sections.tapered import tapered_name
from edesign.frame.struts import Bar, section_strut
from edesign.project.actions.beam_loads import points_of_member
from edesign.project.building.building import Building
from edesign.project.building.names import Direction
from edesign.project.frame.materials import ElasticMaterial, with_stiffness
from edesign.project.frame.sections import RivetedSection, SpaceElasticSection
from edesign.project.notation.names import MemberKind
from edesign.space.nonlinear.gravity import GravityLoads, Point
from edesign.space.nonlinear.member_ends import member_ends
from edesign.space.nonlinear.panel_zones import SpacePanels, panels_of
from edesign.space.nonlinear.rigid_ends import rigid_ends
from edesign.space.structure.frame import Member as Placed
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.model import TENSION_ONLY_SHARE


@dataclass(frozen=True)
class _Section:
    """A section in the core: its number, and the places of its fibres, (n, 2) m; None: it is elastic."""

    number: int
    fibres: np.ndarray | None = None

    @cached_property
    def outer(self) -> tuple[int, ...]:
        """Fibres at the corners of the polygon around all: whatever the axis of bending, one of them yields first."""
        if self.fibres is None:
            return ()
        from scipy.spatial import ConvexHull

        return tuple(sorted(int(i) for i in ConvexHull(self.fibres).vertices))


def _along(placed: Placed) -> Direction | None:
    """The direction of a beam; None of a column."""
    if placed.kind == "column":
        return None
    return "x" if placed.frame[0].startswith("X") else "y"


class BuildingMembers:
    """The members of a building, added to a model of the core.

    Args:
        building: whose members are of steels by their thickness.
        model: of the core, which has the nodes of the frame in their order.
        gravity: loads on the members, at which these are integrated piece by piece.

    Attributes:
        by_name: the members.

    Raises:
        InputError: a section does not exist, or has no place for what the file asks at ends of members.
    """

    def __init__(self, building: Building, frame: SpaceFrame, model: Model, gravity: GravityLoads) -> None:
        self._building, self._frame, self._model, self._gravity = building, frame, model, gravity
        self._laws, of_kind = building.steels, building.elements.geometry
        self._geometry = {"column": of_kind.columns, "beam": of_kind.beams, "brace": of_kind.braces}
        steels = dict.fromkeys((member.material, member.stiffness_factor) for member in frame.members)
        self._materials = {of: model.material(core_law(with_stiffness(self._laws[of[0]], of[1]))) for of in steels}
        self._sections: dict[tuple[str, str, float, bool], _Section] = {}
        self._rigid, self._ends = rigid_ends(building), member_ends(building)
        places: dict[int, tuple[float, ...]] = dict(enumerate(map(tuple, frame.coordinates.tolist())))
        self._builder = MemberBuilder(model, places)
        nodes = {name: node for node, name in enumerate(frame.node_names)}
        self._panels = SpacePanels(model, nodes, places, panels_of(building))
        self.by_name = {member.name: self._add(i, member) for i, member in enumerate(frame.members)}

    @property
    def moving_with(self) -> dict[int, list[int]]:
        """Nodes behind springs that share the displacements of a node, by its id."""
        return self._builder.moving_with

    @property
    def panels(self) -> dict[str, BuiltPanel]:
        """Panel zones by the node of their joint."""
        return self._panels.built

    @property
    def turning_apart(self) -> dict[int, int]:
        """Degree in which a node behind a spring turns on its own, by its id."""
        return self._builder.turning_apart

    def add_loads(self, pattern: int, number: int, uniform: np.ndarray, points: Sequence[Point]) -> None:
        """Add loads on a member to its parts.

        Args:
            pattern: to which they are added.
            number: of the member in the frame.
            uniform: along local x, y, z, (3,) N/m.
            points: places and forces along these.
        """
        placed = self._frame.members[number]
        member, model = self.by_name[placed.name], self._model
        on_joints = [uniform * arm for arm in member.stretches.arms]
        for part in member.parts if uniform.any() else ():
            model.uniform_load(pattern, part, *uniform.tolist())
        for position, force in points:
            parts, shares = MemberLoads(points=[(position, 1.0)]).split(member.stretches)
            for part, on in zip(member.parts, parts, strict=True):
                for place, _ in on.points:
                    model.point_load(pattern, part, place, *force.tolist())
            on_joints = [whole + share * force for whole, share in zip(on_joints, shares, strict=True)]
        for joint, local in zip((placed.start, placed.end), on_joints, strict=True):
            if local.any():
                fx, fy, fz = (local @ self._gravity.axes[number]).tolist()
                model.nodal_load(pattern, joint, fx, fy, fz=fz)

    @property
    def work_inside(self) -> float:
        """Work of the gravity loads on elastic members as if they were simply supported, J."""
        found = 0.0
        for number, member in enumerate(self._frame.members):
            if member.axial_only or self.by_name[member.name].fibres is not None:
                continue
            shape, E = self._frame.section(member.section), self._laws[member.material].E
            for axis, inertia in ((1, shape.I_z), (2, shape.I_y * member.stiffness_factor)):
                points = [(position, float(force[axis])) for position, force in self._gravity.points.get(number, ())]
                loads = MemberLoads(float(self._gravity.uniform[number, axis]), points)
                inside = self.by_name[member.name].bending_stretches
                parts = zip(loads.split(inside)[0], inside.lengths, strict=True)
                found += sum(on.squared_moment(length) for on, length in parts) / (2.0 * E * inertia)
        return found

    def _add(self, number: int, placed: Placed) -> Member:
        nodes = placed.start, placed.end
        if placed.axial_only:
            area = self._frame.section(placed.section).A * (1.0 if placed.compression else TENSION_ONLY_SHARE)
            material = self._materials[placed.material, placed.stiffness_factor]
            element = self._model.truss(placed.name, *nodes, material, area, self._geometry[placed.kind])
            stretches = Stretches((0.0, 0.0), (float(self._frame.length[number]),))
            return self._member(
                number, placed, element, parts=(element,), stretches=stretches, bending=(), axial=(0, 6)
            )
        joints = self._frame.node_names[placed.start], self._frame.node_names[placed.end]
        along = _along(placed)
        arms = self._panels.arm(joints[0], along), self._panels.arm(joints[1], along)
        first, last = self._ends.get(placed.name, (MemberEnd(), MemberEnd()))
        ends = first.from_edge(arms[0]), last.from_edge(arms[1])
        section = self._section(placed, any(end.hinge is not None for end in ends))
        stiffness, geometry = self._stiffness(placed), self._geometry[placed.kind]
        inside = dict.fromkeys(at for at, _ in self._gravity.points.get(number, ()) if 0.0 < at < 1.0)
        bent = Stretches(arms, (float(self._frame.length[number]) - sum(arms),))
        breaks = bent.on_only_element(tuple(inside)) if section.fibres is not None else ()
        built = self._builder.add(
            placed.name,
            self._panels.ends(placed.name, joints, along, stiffness, geometry, placed.web),
            section.number,
            stiffness[1],
            self._building.elements.integration_points,
            geometry,
            [value == 0.0 for value in placed.ends],
            ends,
            breaks,
            placed.web,
        )
        element = built.interior
        rigid = self._rigid.get(placed.name, (0.0, 0.0))
        if any(rigid):
            self._model.rigid_ends(element, *rigid)
        return self._member(
            number,
            placed,
            element,
            parts=built.parts,
            stretches=Stretches(arms, built.lengths),
            springs=built.springs,
            rigid_ends=rigid,
            bending=IN_SPACE,
            axial=(0, 6),
            torque=(3, 9),
            axes=tuple(map(tuple, self._gravity.axes[number].tolist())),
            fibres=section.fibres,
            outer=section.outer,
            points=points_of_member(self._building.elements, breaks),
        )

    def _member(self, number: int, placed: Placed, element: int, **facts: Any) -> Member:
        length = float(self._frame.length[number])
        kind: MemberKind = placed.kind
        return Member(
            name=placed.name,
            kind=kind,
            element=element,
            start=self._frame.node_names[placed.start],
            end=self._frame.node_names[placed.end],
            section=placed.section,
            material=placed.material,
            steel=with_stiffness(self._laws[placed.material], placed.stiffness_factor),
            length=length,
            frames=placed.frame,
            bar=self._bar(placed, length),
            **facts,
        )

    def _bar(self, placed: Placed, length: float) -> Bar | None:
        if placed.kind == "beam":
            return None
        steel = self._laws[placed.material]
        section = self._frame.section(placed.section)
        strut = section_strut(section, steel, length) if placed.compression else None
        return Bar(placed.name, placed.kind, placed.section, strut, placed.compression)

    def _stiffness(self, placed: Placed) -> tuple[float, float, float]:
        """E I about local z and y, and G J, N m2; the stiffness factor is on E I_y alone."""
        shape, E = self._frame.section(placed.section), self._laws[placed.material].E
        return E * shape.I_z, placed.stiffness_factor * E * shape.I_y, self._G(placed) * shape.I_t

    def _G(self, placed: Placed) -> float:
        steel = self._building.materials[placed.material]
        return steel.E / (2.0 * (1.0 + steel.nu))

    def _section(self, placed: Placed, hinged: bool) -> _Section:
        own = isinstance(self._building.sections.get(placed.section), SpaceElasticSection)
        elastic = hinged or own or isinstance(self._laws[placed.material], ElasticMaterial)
        key = placed.section, placed.material, placed.stiffness_factor, elastic
        if key not in self._sections:
            self._sections[key] = self._make(placed, elastic)
        return self._sections[key]

    def _make(self, placed: Placed, elastic: bool) -> _Section:
        """Return a new section; E of the fibres, or E I_y alone, is multiplied by the stiffness factor."""
        building, law = self._building, self._laws[placed.material]
        if elastic:
            about_z, about_y, torsion = self._stiffness(placed)
            axial = law.E * self._frame.section(placed.section).A
            return _Section(self._model.elastic_section(axial, about_z, about_y, torsion))
        own = building.sections.get(placed.section)
        assert not isinstance(own, SpaceElasticSection), "it is elastic"
        if own is None and tapered_name(placed.section) is not None:
            raise InputError(
                f"{building.path.name}: {placed.name}: {placed.section} has tapered flanges, whose fibres are not "
                "made; analyses take it with a material of `law: elastic`, or an I section of plates [E-FRAME-02]"
            )
        if isinstance(own, RivetedSection):
            raise InputError(
                f"{building.where('sections', placed.section)}: sections.{placed.section}: {placed.name} is riveted, "
                "and its fibres are not made; analyses take it with a material of `law: elastic` [E-FRAME-02]"
            )
        fibres = space_section(own or placed.section, building.fibres.half_flange)
        where = building.where("fibres", "residual_stress")
        rolled = pattern_of(building.fibres, placed.section, own is not None, placed.material, law, where)
        stress = None if rolled is None else eccs_stresses(rolled, fibres.y, fibres.z, fibres.area)
        number, torsion = self._materials[placed.material, placed.stiffness_factor], self._G(placed) * fibres.I_t
        section = self._model.fibre_section(fibres.y, fibres.area, number, fibres.z, torsion, stress)
        return _Section(section, np.unique(np.stack([fibres.y, fibres.z], axis=1), axis=0))
