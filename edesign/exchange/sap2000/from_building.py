"""A building as a model of SAP2000."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from edesign.exchange.sap2000.model import (
    FrameLoad,
    FrameObject,
    FramePoint,
    GravityCase,
    JointLoad,
    LoadPattern,
    Material,
    Sap2000Model,
    Section,
    Six,
    SixFlags,
    Vector,
    local_axes,
)
from edesign.exchange.sap2000.spectra import spectrum_functions
from edesign.project.building.building import Building
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.structure.frame import NO_DIAPHRAGM, Member, SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.load_cases import SELF_WEIGHT
from edesign.space.structure.masses import psi_2
from edesign.space.structure.model import TENSION_ONLY_SHARE

_AXES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_TYPES = {"permanent": "Dead", "snow": "Snow", "H": "Roof Live", "wind": "Wind"}
"""Design types of load patterns by the categories of loads; all others are Live."""


def from_building(building: Building) -> tuple[Sap2000Model, list[str]]:
    """Return a building as a model, and sentences on what the model does not have of it.

    Args:
        building: from `load_building`.

    Raises:
        InputError: a section is not known, or loads upwards would give a negative mass.
    """
    space = space_frame(building, design=True)
    names = space.node_names
    model = Sap2000Model(building.title)
    model.joints = {name: _vector(place) for name, place in zip(names, space.coordinates, strict=True)}
    for name, steel in building.materials.items():
        weight = steel.density * STANDARD_GRAVITY
        model.materials[name] = Material(name, "Steel", steel.E, steel.nu, weight, steel.density, steel.fy)
    for member in space.members:
        section = _section(model, space, member)
        released, springs = _ends(member)
        start, end = names[member.start], names[member.end]
        angle = _angle(member, model.joints[start], model.joints[end])
        model.frames[member.name] = FrameObject(member.name, start, end, section, angle, released, springs)
    for name, fixed, springs_of_node in zip(names, space.fixed, space.springs, strict=True):
        if fixed.any():
            model.restraints[name] = _flags(fixed)
        if springs_of_node.any():
            model.springs[name] = _six(springs_of_node)
    for name, number, mass in zip(names, space.node_diaphragm.tolist(), space.node_mass, strict=True):
        if number != NO_DIAPHRAGM:
            model.diaphragms.setdefault(f"FLOOR{space.diaphragms[number]}", []).append(name)
        if mass > 0.0:
            model.joint_masses[name] = float(mass), float(mass), 0.0
    _loads(building, space, model)
    if building.hazard is not None:
        model.spectra = spectrum_functions(building.hazard)
    left_out = list(_left_out(building, space))
    model.about = [f"{building.path.name} without {sentence}" for sentence in left_out]
    return model, left_out


def _left_out(building: Building, space: SpaceFrame) -> Iterator[str]:
    if building.design is not None:
        yield "the design: checks, combinations, accidental torsion, imperfections"
    if any(member.kind == "brace" for member in space.members):
        yield "gravity without braces (EN 1998-1, 6.7.2(1)P): the braces of the model carry gravity loads too"
    if building.dampers is not None and not building.dampers.none:
        yield "its dampers and tuned masses"
    if building.footings:
        yield "dashpots, masses and uplift of footings: springs have their static stiffness"
    if building.loads.live_load_reduction:
        yield "the reduction of variable loads (EN 1991-1-1, 6.3.1.2)"


def _vector(values: np.ndarray) -> Vector:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _six(values: np.ndarray) -> Six:
    a, b, c, d, e, f = (float(value) for value in values)
    return a, b, c, d, e, f


def _flags(values: np.ndarray) -> SixFlags:
    a, b, c, d, e, f = (bool(value) for value in values)
    return a, b, c, d, e, f


def _section(model: Sap2000Model, space: SpaceFrame, member: Member) -> str:
    """The name of a member's section in the model; of diagonals that do not count in compression, half of it."""
    of = space.section(member.section)
    used = {section.material for section in model.sections.values() if section.catalogue == of.name}
    called = of.name if used | {member.material} == {member.material} else f"{of.name} {member.material}"
    called = called if member.compression else f"{called} half"
    called = called if member.stiffness_factor == 1.0 else f"{called} x{member.stiffness_factor:g}"
    bending, axial = (1.0, member.stiffness_factor) if member.axial_only else (member.stiffness_factor, 1.0)
    model.sections.setdefault(
        called,
        Section(
            *(called, member.material, of.A, of.I_t, of.I_y * bending, of.I_z, of.A_z, of.A_y),
            catalogue=of.name,
            depth=of.h,
            width=of.b,
            axial_share=axial * (1.0 if member.compression else TENSION_ONLY_SHARE),
        ),
    )
    return called


def _ends(member: Member) -> tuple[tuple[SixFlags, SixFlags], tuple[Six, Six]]:
    """Releases at both ends, and springs of what is released; bending about y is M3."""
    released, springs = [], []
    for end in (0, 1):
        about_y, about_z = member.ends[2 * end : 2 * end + 2]
        loose_y, loose_z = (member.axial_only or not math.isinf(value) for value in (about_y, about_z))
        twist = member.axial_only and end == 0
        released.append((False, False, False, twist, loose_z, loose_y))
        stiffnesses = (0.0 if member.axial_only or math.isinf(value) else value for value in (about_z, about_y))
        springs.append((0.0, 0.0, 0.0, 0.0, *stiffnesses))
    return (released[0], released[1]), (springs[0], springs[1])  # type: ignore[return-value]


def _angle(member: Member, start: Vector, end: Vector) -> float:
    """The angle of the local axes, degrees, with which axis 2 has the direction of the web."""
    _, two, three = local_axes(start, end, 0.0)
    angle = math.degrees(math.atan2(float(np.dot(member.web, three)), float(np.dot(member.web, two))))
    return round(angle, 9) + 0.0


def _loads(building: Building, space: SpaceFrame, model: Sap2000Model) -> None:
    factors = {}
    for name, case in space.cases.items():
        if name.startswith("-"):  # a case that acts the other way is the same with the factor -1
            continue
        own_weight = name == SELF_WEIGHT
        kind = _TYPES.get(case.category, "Live")
        model.patterns[name] = LoadPattern(name, kind, 1.0 if own_weight else 0.0)
        if not case.own:
            factors[name] = 1.0 if case.category == "permanent" else psi_2(building, case.category)
        if own_weight:
            continue
        for node, forces in zip(space.node_names, case.nodal, strict=True):
            if forces.any():
                model.joint_loads.append(JointLoad(node, name, _six(forces)))
        for member, load in zip(space.members, case.uniform, strict=True):
            for along, value in zip(_AXES, load, strict=True):
                if value != 0.0:
                    model.frame_loads.append(FrameLoad(member.name, name, along, 0.0, 1.0, float(value), float(value)))
        for number, at, force in zip(case.point_member, case.point_position, case.point_force, strict=True):
            for along, value in zip(_AXES, force, strict=True):
                if value != 0.0:
                    point = FramePoint(space.members[number].name, name, along, float(at), float(value))
                    model.frame_points.append(point)
    model.gravity = GravityCase(factors, p_delta=False)
