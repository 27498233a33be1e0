"""A building as a model of the numerical core, for modes, pushes and histories."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np

from edesign.core import Analysis, Model
from edesign.errors import InputError
from edesign.frame.devices import DeviceLaw, add_devices
from edesign.frame.footings import FootingSprings, footings_of
from edesign.frame.frame_model import FrameModel, Sinking
from edesign.frame.isolation import add_isolation
from edesign.frame.tuned_masses import Attached, add_attachment
from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS as PLAN
from edesign.project.building.members import AS_DEVICES, NO_LAW_OF_LINKS
from edesign.project.building.names import node_name
from edesign.space.file_places import telling_member
from edesign.space.nonlinear.bays import building_sites
from edesign.space.nonlinear.floors import DIRECTIONS, UP, building_floors, building_storeys, control_node
from edesign.space.nonlinear.gravity import gravity_loads
from edesign.space.nonlinear.isolation import add_building_base_beams, isolated_base, support_base
from edesign.space.nonlinear.masses import IN_PLACE, add_masses, attachment_place, ridden, still_beams
from edesign.space.nonlinear.members import BuildingMembers
from edesign.space.nonlinear.supports import add_supports, weights_of
from edesign.space.structure.frame import NO_DIAPHRAGM
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness


def build_building(
    building: Building,
    model: Model | None = None,
    laws: Mapping[str, DeviceLaw] | None = None,
    attachments: Sequence[Attached] = (),
    outside: Collection[str] = (),
    eccentricity: tuple[float, float] = IN_PLACE,
    footings: Mapping[str, FootingSprings] | None = None,
    weights: Mapping[str, float] | None = None,
) -> FrameModel:
    """Build the model of a building with its masses and gravity loads.

    Nodes, members, loads and masses are those of the elastic design. Columns and beams have fibres in two directions
    and elastic torsion without warping, or are elastic if their steel is; they do not deform in shear. Braces are
    bars; those that do not count in compression have half of their area, as in the design.

    Args:
        building: from `load_building`.
        model: an empty model in space to build in; a new one by default.
        laws: of the dampers, by name; those of other laws are left out; None: the building without dampers.
        attachments: tuned masses.
        outside: names of dampers that stand elsewhere, in a laboratory.
        eccentricity: by what shares of the lengths of each diaphragm, along x and y, its masses stand beside their
            places; tuned masses stay where they are.
        footings: by lines of columns; without one that is a footing in the file, the line is fixed. None: those of the
            file.
        weights: on the column bases of an isolated base under the gravity combination, N, by node, where its isolators
            need them; None: the base is fixed in plan, and has no isolators.

    Returns:
        The model, with the numbers of its parts in the core.

    Raises:
        InputError: a section is not known, or has no place for a hinge or a rigid end; loads upwards would give a
            negative mass; a damper has no node to stand at, it has seismic links, or the core refuses a member.
    """
    linked = next((i for i, run in enumerate(building.braces) if run.link is not None), None)
    if linked is not None:
        place = building.where("braces", linked, "link")
        raise InputError(f"{place}: braces[{linked}].link: {NO_LAW_OF_LINKS} [E-SPACE-12]")
    for number, run in enumerate(building.braces):
        if run.law is not None:
            raise InputError(f"{building.where('braces', number)}: braces[{number}]: {AS_DEVICES} [E-DEVICE-04]")
    whole = with_steel_by_thickness(building)
    with telling_member(building):
        if footings is None:
            footings = _footings(whole, laws or {})
        built = model or Model(dimension=3)
        return _build(whole, built, laws, attachments, outside, eccentricity, footings, weights)


def _footings(building: Building, laws: Mapping[str, DeviceLaw]) -> dict[str, FootingSprings]:
    """The footings at the first period of the unloaded building; of its dampers it has buckling-restrained braces."""
    braces = {name: law for name, law in laws.items() if law.restrained is not None}

    def first_period(found: Mapping[str, FootingSprings]) -> float:
        built = _build(building, Model(dimension=3), braces, (), (), IN_PLACE, found, None)
        return float(Analysis(built.model).modes(1, built.brace_stiffness).period[0])

    return footings_of(building, first_period, dimension=3)


def _build(
    building: Building,
    model: Model,
    laws: Mapping[str, DeviceLaw] | None,
    attachments: Sequence[Attached],
    outside: Collection[str],
    eccentricity: tuple[float, float],
    footings: Mapping[str, FootingSprings],
    weights: Mapping[str, float] | None,
) -> FrameModel:
    frame = space_frame(building)
    isolation = building.isolation if laws is not None else None
    base = None if isolation is None else isolated_base(building, isolation, frame, fixed_base=weights is None)
    frame = frame if base is None else base.frame
    loads = gravity_loads(building, frame)
    nodes = {
        name: model.node(name, *place) for name, place in zip(frame.node_names, frame.coordinates.tolist(), strict=True)
    }
    masters, masses, turning = add_masses(building, frame, model, attachments, eccentricity)
    members = BuildingMembers(building, frame, model, loads)  # panel zones add to rigid floors before there are dampers
    supports = add_supports(building, frame, model, footings, masters)
    if base is not None:
        support_base(base, model, supports.restrained, supports.grounds)
    blocks = weights_of(supports.footings, building.loads.gravity.G)
    gravity = model.pattern()
    for node, (fx, fy, fz, mx, my, mz) in enumerate(loads.on_nodes.tolist()):
        model.nodal_load(gravity, node, fx, fy, mz, fz=fz - blocks.get(frame.node_names[node], 0.0), mx=mx, my=my)
    for number, uniform in enumerate(loads.uniform):
        members.add_loads(gravity, number, uniform, loads.points.get(number, ()))
    on_bases = {name: -float(loads.on_nodes[nodes[name], UP]) for name, held in supports.restrained.items() if held[UP]}
    isolated = None
    if isolation is not None and base is not None and laws is not None:
        for name, load in base.loads.items():
            model.nodal_load(gravity, nodes[name], fz=-load)
            on_bases[name] += load
        add_building_base_beams(building, isolation, model, nodes)
        if weights is not None:
            isolated = add_isolation(building, model, nodes, laws, weights)
    devices = () if laws is None else add_devices(building, model, nodes, laws, building_sites(building), outside)
    devices = (*(isolated.devices if isolated is not None else ()), *devices)
    attached = {}
    for item in attachments:
        tied = ridden(frame, item)
        node = nodes[node_name(item.at, item.floor)] if tied == NO_DIAPHRAGM else masters[tied]
        attached[item.name] = add_attachment(model, item, node, attachment_place(frame, item).tolist())
    floors = building_floors(building, frame, loads, nodes, masters)
    places = dict(zip(model.node_names, model.node_places, strict=True))
    named = {**nodes, **{model.node_names[master]: master for master in masters}}
    return FrameModel(
        grid=building.grid,
        model=model,
        gravity=gravity,
        sinking=Sinking(
            float(np.abs(loads.of_levels).sum()) + (0.0 if base is None else sum(map(abs, base.loads.values()))),
            members.work_inside,
            0.5 * float(np.mean([width for along in PLAN for width in building.widths(along)])),
        ),
        nodes=named,
        places={name: places[name] for name in named},
        members=members.by_name,
        floors=floors,
        storeys=building_storeys(building, frame, nodes, members.by_name),
        control=control_node(floors[-1], model.node_places),
        directions=DIRECTIONS,
        up=UP,
        still=still_beams(building, frame, loads),
        masses=masses,
        turning=turning,
        supports=supports.restrained,
        grounds=supports.grounds,
        devices=devices,
        attached=attached,
        footings=supports.footings,
        isolated=isolated,
        moving_with=members.moving_with,
        turning_apart=members.turning_apart,
        panels=members.panels,
        on_bases=on_bases,
    )
