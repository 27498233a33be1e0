"""A project's frame as a model of the numerical core."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from edesign.building.devices import Attached, Device, DeviceLaw, add_attachment, add_devices
from edesign.building.footings import FootingSprings, project_footings
from edesign.building.hinges import EndSpring, MemberBuilder, MemberEnd, member_ends
from edesign.building.isolation import (
    IsolatedFeet,
    add_base_beams,
    add_isolation,
    base_loads,
    base_masses,
    isolated_support,
)
from edesign.building.leaning_column import LeaningStruts, add_leaning_column
from edesign.building.loads import MemberLoads, Stretches, beam_loads, column_loads, node_loads
from edesign.building.masses import node_masses, vertical_masses
from edesign.building.named_section import cross_section
from edesign.building.panel_zones import BuiltPanel, PanelBuilder, panels_of
from edesign.building.rigid_ends import rigid_ends
from edesign.building.section import CrossSection
from edesign.building.struts import equivalent_camber
from edesign.building.supports import BuiltFooting, Grounds, add_footing, support_springs
from edesign.errors import InputError
from edesign.project.actions.beam_loads import breaks_of_members
from edesign.project.dampers.isolation import Isolation
from edesign.project.frame.braces import BraceBuckling, Fracture
from edesign.project.frame.foundations import FootingSupport
from edesign.project.frame.frame import Frame
from edesign.project.frame.materials import BilinearMaterial, ElasticMaterial, Material
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import ElasticSection, SectionAxis
from edesign.project.frame.supports import springs_of
from edesign.project.notation import names
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.core import Model, Steel

Kind = Literal["column", "beam", "brace"]
Run = ColumnRun | BeamRun | BraceRun


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
    kind: Kind
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
        """Whether it can yield, in bending."""
        return self.layers is not None or any(spring.yields for end in self.springs for spring in end)

    @property
    def bending_stretches(self) -> Stretches:
        """Where what bends stands on it: its elements without their rigid ends, which are arms."""
        if not any(self.rigid_ends):
            return self.stretches
        return Stretches(self.rigid_ends, (self.stretches.length - sum(self.rigid_ends),))

    def at_end(self, end: int) -> int:
        """The element at its start (0) or end (1)."""
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
        supports: held degrees of freedom (ux, uy, rz) of each supported node, by name.
        devices: its dampers.
        attached: nodes of its tuned masses, by name.
        panels: its panel zones by the node of their joint.
        moving_with: nodes behind hinges and joints that share the displacements of a node, by its id.
        grounds: of supported nodes on springs the other end of these, for each degree; None: no spring holds it.
        leaning: its leaning column, whose nodes and struts are none of the above.
        footings: by the supported nodes that stand on them.
        isolated: its isolated base, whose devices are among its dampers; None: it stands on its supports.
        on_feet: loads of the gravity combination on the feet of an isolated base, N downwards, by the name of the node.
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
    isolated: IsolatedFeet | None = None
    on_feet: Mapping[str, float] = field(default_factory=dict)

    @property
    def mass(self) -> float:
        """Total mass, kg."""
        return float(sum(self.masses.values()))

    @property
    def brace_stiffness(self) -> np.ndarray | None:
        """Of all dampers of the core the stiffness that they have in modes as buckling-restrained braces which have not
        yielded, (n_dampers,) N/m; None: there are no such braces."""
        braces = {device.number: device.restrained.stiffness for device in self.devices if device.restrained}
        if not braces:
            return None
        found = np.zeros(len(self.model.damper_names))
        found[list(braces)] = list(braces.values())
        return found

    def reaction(self, support: str, degree: int) -> tuple[tuple[float, str, int, int], ...]:
        """The reaction at a degree (0 ux, 1 uy, 2 rz) of a supported node, as terms of the core.

        A column that stands on a hinge or joint pushes at a node of its own; isolators hold back the base, and what
        loads it at a support goes there at once.
        """
        if degree == 0 and self.isolated is not None:
            return tuple((-1.0, "damper_force", number, 0) for number in self.isolated.at(support))
        ground = self.grounds.get(support, (None, None, None))[degree]
        if ground is not None:
            return ((1.0, "reaction", ground, degree),)
        node = self.nodes[support]
        pushed = [node] if degree == 2 else [node, *self.moving_with.get(node, ())]
        terms = tuple((1.0, "reaction", at, degree) for at in pushed)
        load = self.on_feet.get(support, 0.0) if degree == 1 else 0.0
        return terms if load == 0.0 else (*terms, (load, "load_factor", self.gravity, 0))

    def of_kind(self, kind: Kind) -> list[Member]:
        """Members of a kind in the order of `members`."""
        return [member for member in self.members.values() if member.kind == kind]

    def floor_nodes(self, floor: int) -> list[str]:
        """Names of the nodes at a floor on column lines, from the left."""
        return [name for line in self.frame.lines if (name := names.node_name(line, floor)) in self.nodes]

    def level_nodes(self, floor: int) -> list[str]:
        """Names of all nodes at a floor, those in the middle of beams too."""
        level = self.frame.y[floor]
        return [name for name in self.nodes if self.frame.nodes[name][1] == level]

    @cached_property
    def leading_nodes(self) -> list[str]:
        """For each floor from 1 the first node from the left, which stands for the floor."""
        return [self.frame.leading_node(floor) for floor in range(1, self.frame.n_storeys + 1)]


def build_frame(
    project: Project,
    model: Model | None = None,
    laws: Mapping[str, DeviceLaw] | None = None,
    attachments: Sequence[Attached] = (),
    outside: Collection[str] = (),
    footings: Mapping[str, FootingSprings] | None = None,
    weights: Mapping[str, float] | None = None,
) -> FrameModel:
    """Build the model of a project's frame: nodes, supports, members, diaphragms, masses, leaning column and
    gravity loads.

    A place of the grid where no member ends gets no node and no support. The rotation of a node at which only pin-ended
    members end is fixed: nothing else would hold it, and nothing turns it.

    Args:
        project: the validated project.
        model: an empty model to build in; a new one by default.
        laws: of the dampers, by name; those of other laws are left out; None: the frame without dampers.
        attachments: tuned masses.
        outside: names of dampers that stand elsewhere, in a laboratory.
        footings: by lines of columns; without one that is a footing in the project, the line is fixed. None: those of
            the project.
        weights: on the feet of an isolated base under the gravity combination, N, by node, where its isolators need
            them; None: the base is held horizontally, and has no isolators.

    Raises:
        InputError: an unknown or impossible section, a soil that the tables of its code do not have, or loads upwards
            that would give a negative mass.
    """
    if model is None:
        from edesign.core import Model

        model = Model()
    frame = project.frame
    nodes = {name: model.node(name, x, y) for name, (x, y) in frame.nodes.items()}
    members, moving_with, panels = _members(project, model, nodes)
    isolation = project.isolation if laws is not None else None
    if isolation is not None:
        footings = {}
    elif footings is None:
        braces = {name: law for name, law in (laws or {}).items() if law.restrained is not None}
        footings = project_footings(project, lambda found: _first_period(project, found, braces))
    base_held = weights is None
    supports, grounds, built_footings = _supports(frame, model, nodes, footings, isolation, base_held)
    rigid = frame.diaphragm_floors if isolation is None or base_held else (0, *frame.diaphragm_floors)
    for floor in rigid:
        tied = [node for name, node in nodes.items() if frame.nodes[name][1] == frame.y[floor]]
        for node in tied[1:]:
            model.tie(node, tied[0], ux=True, uy=False, rz=False)
    masses = node_masses(project)
    vertical = vertical_masses(project)
    if isolation is not None:
        base = base_masses(project)
        masses = base | masses
        vertical = base | vertical if vertical else vertical
    for name, mass in masses.items():
        model.mass(nodes[name], mass, vertical.get(name, 0.0), 0.0)
    gravity = model.pattern("gravity")
    for name, loads in beam_loads(project, project.loads.gravity).items():
        _add_loads(model, gravity, nodes, members[name], loads, (0.0, -1.0))
    for name, load in column_loads(project, project.loads.gravity).items():
        _add_loads(model, gravity, nodes, members[name], MemberLoads(load), (1.0, 0.0))
    for name, load in node_loads(project, project.loads.gravity).items():
        model.nodal_load(gravity, nodes[name], 0.0, -load, 0.0)
    for name, footing in built_footings.items():
        weight = project.loads.gravity.G * footing.springs.mass * STANDARD_GRAVITY
        model.nodal_load(gravity, nodes[name], 0.0, -weight, 0.0)
    on_feet = {} if isolation is None else base_loads(frame, isolation, project.loads.gravity)
    for name, load in on_feet.items():
        model.nodal_load(gravity, nodes[name], 0.0, -load, 0.0)
    leaning = add_leaning_column(project, model, nodes, gravity)
    isolated = None
    if isolation is not None:
        add_base_beams(project, model, nodes)
    if isolation is not None and laws is not None and weights is not None:
        isolated = add_isolation(project, model, nodes, laws, weights)
    devices = add_devices(project, model, nodes, laws, outside) if laws is not None else ()
    devices = (*(isolated.devices if isolated is not None else ()), *devices)
    attached = {}
    for item in attachments:
        leading = frame.leading_node(item.floor)
        attached[item.name] = add_attachment(model, item, nodes[leading], *frame.nodes[leading])
    return FrameModel(
        frame,
        model,
        gravity,
        nodes,
        members,
        masses,
        supports,
        devices,
        attached,
        grounds,
        moving_with,
        panels,
        leaning,
        built_footings,
        isolated,
        on_feet,
    )


def _first_period(project: Project, footings: Mapping[str, FootingSprings], braces: Mapping[str, DeviceLaw]) -> float:
    """The first period of the unloaded frame on such footings, s; of its dampers it has those of laws in `braces`."""
    from edesign.core import Analysis

    built = build_frame(project, laws=braces, footings=footings)
    return float(Analysis(built.model).modes(1, built.brace_stiffness).period[0])


def _add_loads(
    model: Model,
    pattern: int,
    nodes: Mapping[str, int],
    member: Member,
    loads: MemberLoads,
    towards: tuple[float, float],
) -> None:
    """Add loads across a member: on its parts, and on its joints what stands on the halves of their panel zones.

    Args:
        model: of the core.
        pattern: to which they are added.
        nodes: ids by name.
        member: a beam or column.
        loads: on its length between its nodes.
        towards: unit vector of positive loads, which is across the member to the right.
    """
    on_parts, on_joints = loads.split(member.stretches)
    for part, on in zip(member.parts, on_parts, strict=True):
        if on.uniform != 0.0:
            model.uniform_load(pattern, part, axial=0.0, transverse=-on.uniform)
        for position, force in on.points:
            model.point_load(pattern, part, position, transverse=-force)
        for begin, end, at_begin, at_end in on.parts:
            model.partial_load(pattern, part, begin, end, -at_begin, -at_end)
    for joint, force in zip((member.start, member.end), on_joints, strict=True):
        if force != 0.0:
            model.nodal_load(pattern, nodes[joint], force * towards[0], force * towards[1], 0.0)


def _supports(
    frame: Frame,
    model: Model,
    nodes: dict[str, int],
    footings: Mapping[str, FootingSprings],
    isolation: Isolation | None,
    base_held: bool,
) -> tuple[dict[str, tuple[bool, bool, bool]], dict[str, Grounds], dict[str, BuiltFooting]]:
    """Hold the feet of the columns; returns what is held, where springs that hold it stand, and the footings.

    An isolated base is held by its isolators, or with `base_held` by fixed supports in their place.
    """
    held = _held_rotations(frame)
    turning = isolation is not None and isolation.base.beams is not None
    at_base = {names.node_name(line, 0): line for line in frame.lines}
    supports, grounds, built = {}, {}, {}
    for name, node in nodes.items():
        line = at_base.get(name)
        if line is None:
            if name not in held:
                model.fix(node, rz=True)
            continue
        support = frame.support(line) if isolation is None else isolated_support(frame, isolation, line)
        if isinstance(support, FootingSupport):
            supports[name] = (True, True, True)
            if line not in footings:
                model.fix(node, True, True, True)
                continue
            model.fix(node, rz=name not in held)
            place = frame.nodes[name]
            grounds[name], built[name] = add_footing(model, name, node, place, footings[line], name in held)
            continue
        springs = springs_of(support)
        horizontal = "fixed" if isolation is not None and base_held else springs.horizontal
        directions = [horizontal, springs.vertical, springs.rotation if name in held or turning else "fixed"]
        ux, uy, rz = (direction == "fixed" for direction in directions)
        model.fix(node, ux=ux, uy=uy, rz=rz)
        ux, uy, rz = (direction != "free" for direction in directions)
        ux = ux or isolation is not None
        supports[name] = ux, uy, rz
        if not all(direction in ("fixed", "free") for direction in directions):
            grounds[name] = support_springs(model, name, node, frame.nodes[name], directions)
    return supports, grounds, built


def _held_rotations(frame: Frame) -> set[str]:
    """Nodes at which the end of a column or beam is not released."""
    held = set()
    for name, (start, end) in frame.ends.items():
        if name.startswith("D_"):
            continue
        released = frame.released.get(name, (False, False))
        held |= {node for node, free in zip((start, end), released, strict=True) if not free}
    return held


def _members(
    project: Project, model: Model, nodes: dict[str, int]
) -> tuple[dict[str, Member], dict[int, list[int]], dict[str, BuiltPanel]]:
    parts = _Parts(project, model)
    geometry = project.elements.geometry
    of_kind: dict[Kind, str] = {"column": geometry.columns, "beam": geometry.beams, "brace": geometry.braces}
    kinds: dict[str, Kind] = {"C": "column", "B": "beam", "D": "brace"}
    places = {node: project.frame.nodes[place] for place, node in nodes.items()}
    panels = PanelBuilder(model, nodes, places, panels_of(project))
    builder = MemberBuilder(model, places)
    at_ends = member_ends(project)
    breaks = breaks_of_members(project.frame, project.loads)
    rigid = rigid_ends(project)
    found = {}
    for name, run in project.frame.members.items():
        start, end = project.frame.ends[name]
        kind = kinds[name[0]]
        if isinstance(run, BraceRun):
            if run.buckling is not None:
                found[name] = _buckling_brace(project, model, parts, name, run, run.buckling, (start, end), nodes)
                continue
            material, area = parts.brace(run)
            element = model.truss(name, nodes[start], nodes[end], material, area, geometry=of_kind[kind])
            found[name] = Member(name, kind, element, start, end, None, (element,))
            continue
        first, last = at_ends.get(name, (MemberEnd(), MemberEnd()))
        arms = panels.arm(start, kind), panels.arm(end, kind)
        ends = first.from_edge(arms[0]), last.from_edge(arms[1])
        hinged = any(of.hinge is not None for of in ends)
        section, layers = parts.section(run, hinged)
        EI = parts.bending_stiffness(run)
        between = project.frame.length(name) - sum(arms)
        built = builder.add(
            name,
            panels.ends(name, (start, end), EI, of_kind[kind]),
            section,
            EI,
            project.elements.integration_points,
            of_kind[kind],
            project.frame.released.get(name, (False, False)),
            ends,
            Stretches(arms, (between,)).on_only_element(breaks.get(name, ())),
        )
        if name in rigid:  # such a member has no hinges and no panel zones
            model.rigid_ends(built.interior, *rigid[name])
        stretches = Stretches(arms, built.lengths)
        found[name] = Member(
            name,
            kind,
            built.interior,
            start,
            end,
            layers,
            built.parts,
            stretches,
            built.springs,
            rigid_ends=rigid.get(name, (0.0, 0.0)),
        )
    return found, builder.moving_with, panels.built


def _buckling_brace(
    project: Project,
    model: Model,
    parts: _Parts,
    name: str,
    run: BraceRun,
    buckling: BraceBuckling,
    ends: tuple[str, str],
    nodes: dict[str, int],
) -> Member:
    """Add a brace that buckles."""
    start, end = ends
    length = project.frame.length(name)
    camber = buckling.camber
    if camber == "ec3":
        effective = run.buckling_length_factor * length
        camber = equivalent_camber(project, run.section, run.material, buckling.axis, effective)
    stiffnesses = {"pinned": 0.0, "fixed": math.inf}
    stiffness = stiffnesses[buckling.ends] if isinstance(buckling.ends, str) else buckling.ends
    section, material, area = parts.buckling_brace(run, buckling)
    element = model.strut(
        name,
        nodes[start],
        nodes[end],
        section,
        material,
        area,
        camber,
        elements=buckling.n_elements,
        points=project.elements.integration_points,
        buckling_length=run.buckling_length_factor,
        end_stiffness=stiffness,
        geometry=project.elements.geometry.braces,
    )
    steel = project.materials[run.material]
    yields = math.inf if isinstance(steel, ElasticMaterial) else steel.fy * length / steel.E
    return Member(name, "brace", element, start, end, None, (element,), yield_elongation=yields)


ONE_OF_A_PAIR = 0.5
"""Share of its area that a brace has that does not count in compression.

Source: EN 1998-1:2004, 6.7.2(2)P: of a pair the one in tension acts. With half its area each, the pair is as stiff and
as strong as that one.
"""


class _Parts:
    """Materials and sections of the core's model, each made once; the core wants all materials before any section."""

    def __init__(self, project: Project, model: Model) -> None:
        self._project = project
        self._model = model
        self._shapes: dict[tuple[str, SectionAxis], CrossSection | ElasticSection] = {}
        self._materials: dict[tuple[str, bool], int] = {}
        self._breaking: dict[tuple[str, Fracture], int] = {}
        self._sections: dict[tuple[str, str, SectionAxis, bool], tuple[int, np.ndarray | None]] = {}
        self._buckling: dict[tuple[str, int, SectionAxis], int] = {}
        for run in project.frame.members.values():
            if isinstance(run, BraceRun) or not self._stays_elastic(run):
                self._material(run)
            if isinstance(run, BraceRun) and run.buckling is not None:
                self._fibre_material(run, run.buckling)

    def section(self, run: Run, elastic: bool = False) -> tuple[int, np.ndarray | None]:
        """Id of the section of a column or beam, and the depths of its layers unless it is elastic, or is to be."""
        key = (run.section, run.material, _axis(run), elastic)
        if key not in self._sections:
            self._sections[key] = self._make(run, elastic)
        return self._sections[key]

    def bending_stiffness(self, run: Run) -> float:
        """E I of a column or beam, N m2."""
        return self._project.materials[run.material].E * (self._shape(run).inertia or 0.0)

    def brace(self, run: BraceRun) -> tuple[int, float]:
        """Material id and area of a brace; on an elastic section the material is its elastic part."""
        return self._material(run), self._shape(run).area * (1.0 if run.compression else ONE_OF_A_PAIR)

    def buckling_brace(self, run: BraceRun, buckling: BraceBuckling) -> tuple[int, int, float]:
        """Ids of the section and of the material of a brace that buckles, and its area."""
        shape = cross_section(self._project, run.section, buckling.axis)
        if not isinstance(shape, CrossSection):
            where = self._project.where("sections", run.section)
            raise InputError(f"{where}: section {run.section}: a brace that buckles needs a section of fibres")
        material = self._fibre_material(run, buckling)
        key = (run.section, material, buckling.axis)
        if key not in self._buckling:
            self._buckling[key] = self._model.fibre_section(*shape.fibres, material)
        return self._buckling[key], self._material(run), shape.area

    def _make(self, run: Run, elastic: bool) -> tuple[int, np.ndarray | None]:
        shape = self._shape(run)
        if isinstance(shape, CrossSection) and not (elastic or self._stays_elastic(run)):
            depths, areas = shape.fibres
            return self._model.fibre_section(depths, areas, self._material(run)), shape.layers[0]
        if shape.inertia is None:
            where = self._project.where("sections", run.section)
            raise InputError(f"{where}: section {run.section}: a column or beam needs `inertia`")
        modulus = self._project.materials[run.material].E  # the integral over the section in closed form
        return self._model.elastic_section(modulus * shape.area, modulus * shape.inertia), None

    def _stays_elastic(self, run: Run) -> bool:
        law = self._project.materials[run.material]
        return isinstance(law, ElasticMaterial) or isinstance(self._shape(run), ElasticSection)

    def _shape(self, run: Run) -> CrossSection | ElasticSection:
        key = (run.section, _axis(run))
        if key not in self._shapes:
            self._shapes[key] = cross_section(self._project, *key)
        return self._shapes[key]

    def _material(self, run: Run) -> int:
        key = (run.material, self._stays_elastic(run))
        if key not in self._materials:
            self._materials[key] = self._model.material(_law(self._project.materials[run.material], key[1]))
        return self._materials[key]

    def _fibre_material(self, run: BraceRun, buckling: BraceBuckling) -> int:
        """The material of the fibres of a brace that buckles."""
        if buckling.fracture is None:
            return self._material(run)
        key = (run.material, buckling.fracture)
        if key not in self._breaking:
            from edesign import core

            fatigue = core.Fatigue(buckling.fracture.strain, buckling.fracture.exponent)
            self._breaking[key] = self._model.material(_law(self._project.materials[run.material], False), fatigue)
        return self._breaking[key]


def _axis(run: Run) -> SectionAxis:
    return "strong" if isinstance(run, BraceRun) else run.axis


def _law(material: Material, elastic: bool) -> Steel:
    """The core's description of a material, or of its elastic part."""
    from edesign import core

    if elastic or isinstance(material, ElasticMaterial):
        return core.Elastic(E=material.E)
    if isinstance(material, BilinearMaterial):
        return core.Bilinear(E=material.E, fy=material.fy, b=material.hardening)
    return core.MenegottoPinto(
        E=material.E, fy=material.fy, b=material.hardening, R0=material.R0, cR1=material.cR1, cR2=material.cR2
    )
