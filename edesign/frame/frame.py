"""A project's frame as a model of the numerical core."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from edesign.core import Analysis, Model
from edesign.frame.bays import frame_sites
from edesign.frame.devices import DeviceLaw, add_devices
from edesign.frame.floors import ACROSS, UP, frame_floors, frame_storeys
from edesign.frame.footings import FootingSprings, footings_of
from edesign.frame.frame_members import add_members
from edesign.frame.frame_model import FrameModel, Member, Sinking
from edesign.frame.isolation import (
    add_base_beams,
    add_isolation,
    base_loads,
    base_masses,
    isolated_support,
)
from edesign.frame.leaning_column import add_leaning_column
from edesign.frame.loads import MemberLoads, beam_loads, column_loads, gravity_load, horizontal_load, node_loads
from edesign.frame.masses import node_masses, still_beams, vertical_masses
from edesign.frame.sections.named_section import cross_section
from edesign.frame.supports import BuiltFooting, Grounds, add_footing, support_springs
from edesign.frame.tuned_masses import Attached, add_attachment
from edesign.project.dampers.isolation import Isolation
from edesign.project.frame.foundations import FootingSupport
from edesign.project.frame.frame import Frame
from edesign.project.frame.members import BraceRun
from edesign.project.frame.supports import springs_of
from edesign.project.notation import names
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project


def build_frame(
    project: Project,
    model: Model | None = None,
    laws: Mapping[str, DeviceLaw] | None = None,
    attachments: Sequence[Attached] = (),
    outside: Collection[str] = (),
    footings: Mapping[str, FootingSprings] | None = None,
    weights: Mapping[str, float] | None = None,
) -> FrameModel:
    """Build the model of a project's frame with its masses and gravity loads.

    The model has nodes, supports, members, diaphragms, masses, a leaning column and gravity loads. A place of the grid
    where no member ends gets no node and no support. The rotation of a node at which only pin-ended members end is
    fixed: nothing else would restrain it, and nothing turns it.

    Args:
        model: an empty model to build in; a new one by default.
        laws: of the dampers, by name; those of other laws are left out; None: the frame without dampers.
        attachments: tuned masses.
        outside: names of dampers that stand elsewhere, in a laboratory.
        footings: by lines of columns; without one that is a footing in the project, the line is fixed. None: those of
            the project.
        weights: on the column bases of an isolated base under the gravity combination, N, by node, where its isolators
            need them; None: the base is fixed horizontally, and has no isolators.

    Returns:
        The model of the frame, with the numbers of its parts in the core.

    Raises:
        InputError: an unknown or impossible section, a soil that the tables of its code do not have, or loads upwards
            that would give a negative mass.
    """
    if model is None:
        model = Model()
    frame = project.frame
    nodes = {name: model.node(name, x, y) for name, (x, y) in frame.nodes.items()}
    members, moving_with, panels = add_members(project, model, nodes)
    isolation = project.isolation if laws is not None else None
    if isolation is not None:
        footings = {}
    elif footings is None:
        braces = {name: law for name, law in (laws or {}).items() if law.restrained is not None}
        footings = footings_of(project, lambda found: _first_period(project, found, braces))
    fixed_base = weights is None
    supports, grounds, built_footings = _supports(frame, model, nodes, footings, isolation, fixed_base)
    rigid = frame.diaphragm_floors if isolation is None or fixed_base else (0, *frame.diaphragm_floors)
    for floor in rigid:
        tied = [node for name, node in nodes.items() if frame.nodes[name][1] == frame.levels[floor]]
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
    gravity = model.pattern()
    for name, loads in beam_loads(project, project.loads.gravity).items():
        _add_loads(model, gravity, nodes, members[name], loads, (0.0, -1.0))
    for name, load in column_loads(project, project.loads.gravity).items():
        _add_loads(model, gravity, nodes, members[name], MemberLoads(load), (1.0, 0.0))
    for name, load in node_loads(project, project.loads.gravity).items():
        model.nodal_load(gravity, nodes[name], 0.0, -load, 0.0)
    for name, footing in built_footings.items():
        weight = project.loads.gravity.G * footing.springs.mass * STANDARD_GRAVITY
        model.nodal_load(gravity, nodes[name], 0.0, -weight, 0.0)
    on_bases = {} if isolation is None else base_loads(frame, isolation, project.loads.gravity)
    for name, load in on_bases.items():
        model.nodal_load(gravity, nodes[name], 0.0, -load, 0.0)
    leaning = add_leaning_column(project, model, nodes, gravity)
    isolated = None
    if isolation is not None:
        add_base_beams(project, model, nodes)
    if isolation is not None and laws is not None and weights is not None:
        isolated = add_isolation(project, model, nodes, laws, weights)
    devices = add_devices(project, model, nodes, laws, frame_sites(project), outside) if laws is not None else ()
    devices = (*(isolated.devices if isolated is not None else ()), *devices)
    attached = {}
    for item in attachments:
        leading = frame.leading_node(item.floor)
        attached[item.name] = add_attachment(model, item, nodes[leading], frame.nodes[leading])
    floors = frame_floors(project, nodes)
    return FrameModel(
        frame,
        model,
        gravity,
        _sinking(project, members),
        nodes,
        frame.nodes,
        members,
        floors,
        frame_storeys(frame, nodes, members),
        floors[-1].movers[0][0][0][1],
        (ACROSS,),
        UP,
        tuple(still_beams(project)),
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
        on_bases,
    )


def _first_period(project: Project, footings: Mapping[str, FootingSprings], braces: Mapping[str, DeviceLaw]) -> float:
    """The first period of the unloaded frame on such footings, s; of its dampers it has those of laws in `braces`."""
    built = build_frame(project, laws=braces, footings=footings)
    return float(Analysis(built.model).modes(1, built.brace_stiffness).period[0])


def _sinking(project: Project, members: Mapping[str, Member]) -> Sinking:
    """What shows how far the loads sink."""
    loads = gravity_load(project) + horizontal_load(project)
    inside = 0.0
    for name, on_beam in beam_loads(project, project.loads.gravity).items():
        member, run = members[name], project.frame.members[name]
        if member.fibres is not None:
            continue
        inertia = cross_section(project, run.section, "strong" if isinstance(run, BraceRun) else run.axis).inertia
        if inertia is not None:
            EI = member.steel.E * inertia
            parts, _ = on_beam.split(member.bending_stretches)
            lengths = zip(parts, member.bending_stretches.lengths, strict=True)
            inside += sum(on.squared_moment(length) for on, length in lengths) / (2.0 * EI)
    return Sinking(loads, inside, 0.5 * sum(project.frame.bay_widths) / project.frame.n_bays)


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
    fixed_base: bool,
) -> tuple[dict[str, tuple[bool, ...]], dict[str, Grounds], dict[str, BuiltFooting]]:
    """Support the column bases; returns the restrained degrees, the ground nodes of support springs, and the footings.

    Isolators support an isolated base, or with `fixed_base` fixed supports in their place.
    """
    unreleased = _unreleased_nodes(frame)
    turning = isolation is not None and isolation.base.beams is not None
    at_base = {names.node_name(line, 0): line for line in frame.lines}
    supports: dict[str, tuple[bool, ...]] = {}
    grounds, built = {}, {}
    for name, node in nodes.items():
        line = at_base.get(name)
        if line is None:
            if name not in unreleased:
                model.fix(node, rz=True)
            continue
        support = frame.support(line) if isolation is None else isolated_support(frame, isolation, line)
        if isinstance(support, FootingSupport):
            supports[name] = (True, True, True)
            if line not in footings:
                model.fix(node, True, True, True)
                continue
            model.fix(node, rz=name not in unreleased)
            place = frame.nodes[name]
            grounds[name], built[name] = add_footing(model, name, node, place, footings[line], name in unreleased)
            continue
        springs = springs_of(support)
        horizontal = "fixed" if isolation is not None and fixed_base else springs.horizontal
        directions = [horizontal, springs.vertical, springs.rotation if name in unreleased or turning else "fixed"]
        ux, uy, rz = (direction == "fixed" for direction in directions)
        model.fix(node, ux=ux, uy=uy, rz=rz)
        ux, uy, rz = (direction != "free" for direction in directions)
        ux = ux or isolation is not None
        supports[name] = ux, uy, rz
        if not all(direction in ("fixed", "free") for direction in directions):
            grounds[name] = support_springs(model, name, node, frame.nodes[name], directions)
    return supports, grounds, built


def _unreleased_nodes(frame: Frame) -> set[str]:
    """Nodes at which the end of a column or beam is not released."""
    unreleased = set()
    for name, (start, end) in frame.ends.items():
        if names.member_kind(name) == "brace":
            continue
        released = frame.released.get(name, (False, False))
        unreleased |= {node for node, free in zip((start, end), released, strict=True) if not free}
    return unreleased
