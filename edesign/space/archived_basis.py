"""What a design rests on as groups of an archive: steels, floors, nodes with their modes, overstrength of members."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.codes.ec3.member import Stability
from edesign.frame.sections.section_class import section_class
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.space.analysis.effects import largest
from edesign.space.analysis.response import AnyDesignSpectrum
from edesign.space.designed import ElasticDesign
from edesign.space.structure.frame import AXES
from edesign.space.structure.load_cases import on_nodes
from edesign.space.structure.masses import floor_masses

MODES_DRAWN = 6
LONGEST = 4.0  # s, EN 1998-1, 3.2.2.2
POINTS = 201
_LENGTHS = {"L_cr_y", "L_cr_z", "L_LT", "z_g"}


def basis(design: ElasticDesign) -> Iterator[tuple[str, Group]]:
    """Yield the groups with their names below that of the building."""
    yield "materials", _materials(design)
    yield "floors", _floors(design)
    yield "nodes", _nodes(design)
    yield "spectrum", _spectrum(design)
    for axis in AXES:
        yield f"overstrength_{axis}", _overstrength(design, axis)


def add_restraints(group: Group, design: ElasticDesign) -> None:
    """Add to the group of the members what their checks take them for: class, restraints, ends, orientation.

    Args:
        group: of the members in the archive.
    """
    checks, members = design.members, design.frame.members
    kinds = checks.kinds
    for of in fields(Stability):
        values = np.array([float(getattr(member.stability, of.name)) for member in checks.members])
        unit = "m" if of.name in _LENGTHS else "1"
        group.add(of.name, ("member",), values[kinds], unit, f"{of.name} of the checks of stability")
    for name, unit, text in (
        ("fy", "Pa", "yield strength"),
        ("E", "Pa", "modulus of elasticity"),
        ("G", "Pa", "shear modulus"),
        ("V_M", "N", "V_Ed,M of EN 1998-1, 6.6.2(2)"),
        ("annex_a", "1", "1: k_ij of EN 1993-1-1, 6.3.3, by Annex A; 0: by Annex B"),
    ):
        values = np.array([float(getattr(member, name)) for member in checks.members])
        group.add(name, ("member",), values[kinds], unit, text)
    used, found = np.array([member.section_class for member in checks.members])[kinds], _classes(design)
    text = "class of the section in the checks, under the largest axial force of all combinations; 0: it has none"
    group.add("class", ("member",), np.where((found < 3) == (used < 3), found, used), "1", text)
    at = np.array(["y at start", "z at start", "y at end", "z at end"])
    group.coords["end_axis"] = Variable(("end_axis",), at, "", "axis of the section and end of the member")
    stiffness = np.array([member.ends for member in members])
    group.add("ends", ("member", "end_axis"), stiffness, "N*m/rad", "stiffness of the ends; infinite: rigid, 0: pinned")
    web = np.array([member.web for member in members])
    group.add("web", ("member", "coordinate"), web, "1", "direction of the web")
    for end in ("start", "end"):
        nodes = np.array([design.frame.node_names[getattr(member, end)] for member in members])
        group.add(f"{end}_node", ("member",), nodes, "", f"node at the {end}")


def _classes(design: ElasticDesign) -> np.ndarray:
    force = largest(design.effects, design.members.rows)[:, :, 0].max(axis=1)
    checked = [design.members.members[kind] for kind in design.members.kinds]
    return np.array(
        [
            section_class(of.section, of.fy, 0.0 if member.kind == "beam" else -N_Ed, member.kind != "brace").number
            if of.section.has_class
            else 0
            for member, of, N_Ed in zip(design.frame.members, checked, force.tolist(), strict=True)
        ]
    )


def _materials(design: ElasticDesign) -> Group:
    steels = design.building.materials
    group = Group(coords={"material": Variable(("material",), np.array(list(steels)), "", "name of the steel")})
    for name, unit, text in (
        ("fy", "Pa", "yield strength"),
        ("E", "Pa", "modulus of elasticity"),
        ("nu", "1", "Poisson's ratio"),
        ("density", "kg/m^3", "density"),
    ):
        group.add(name, ("material",), np.array([getattr(steel, name) for steel in steels.values()]), unit, text)
    return group


def _floors(design: ElasticDesign) -> Group:
    frame = design.frame
    numbers = np.arange(frame.n_floors + 1)
    group = Group(coords={"floor": Variable(("floor",), numbers, "1", "floor; 0: the base")})
    group.coords["case"] = Variable(("case",), np.array(list(frame.cases)), "", "load case")
    group.add("level", ("floor",), frame.levels, "m", "level above the base")
    loads = [
        np.bincount(frame.level_of_nodes, -on_nodes(frame, case)[:, 2], minlength=numbers.size)
        for case in frame.cases.values()
    ]
    group.add("load", ("case", "floor"), np.array(loads), "N", "load on the floor, downwards")
    masses = floor_masses(frame)
    for name, unit, text in (
        ("mass", "kg", "mass of the floor"),
        ("x", "m", "centre of mass"),
        ("y", "m", "centre of mass"),
        ("gyration", "m", "radius of gyration of the mass about its centre"),
    ):
        group.add(name, ("floor",), getattr(masses, name), unit, text)
    return group


def _nodes(design: ElasticDesign) -> Group:
    frame, modes = design.frame, design.modes
    count = min(MODES_DRAWN, modes.period.size)
    group = Group(coords={"node": Variable(("node",), np.array(frame.node_names), "", "name of the node")})
    group.coords["coordinate"] = Variable(("coordinate",), np.array(["x", "y", "z"]), "", "global coordinate")
    group.coords["mode"] = Variable(("mode",), np.arange(1, count + 1), "1", "number of the mode")
    group.add("position", ("node", "coordinate"), frame.coordinates, "m", "place of the node")
    group.add("mass", ("node",), frame.node_mass, "kg", "mass at the node, horizontally")
    group.coords["degree"] = Variable(("degree",), np.array(["ux", "uy", "uz", "rx", "ry", "rz"]), "", "degree")
    group.add("fixed", ("node", "degree"), frame.fixed.astype(int), "1", "1: restrained by a support")
    shape = modes.displacements[:count, :, :3].astype(np.float32)  # for drawings
    group.add("mode_shape", ("mode", "node", "coordinate"), shape, "kg^-1/2", "shape, generalised mass 1")
    return group


def _spectrum(design: ElasticDesign) -> Group:
    """The spectra up to 4 s, where EN 1998-1 ends them, or beyond the longest period; corners are among the periods."""
    building = design.building
    of = {axis: design.response[axis].spectrum for axis in AXES}
    longest = max(LONGEST, 1.1 * float(design.modes.period.max()))
    period = np.unique(np.concatenate([np.linspace(0.0, longest, POINTS), _corners(of["x"])]))
    group = Group(coords={"period": Variable(("period",), period, "s", "period")})
    if building.hazard is not None and building.design is not None:
        level = building.design_level or None
        elastic = elastic_spectrum(building.hazard, level)
        group.attributes["label"] = elastic.label
        group.add("elastic", ("period",), elastic.acceleration(period), "m/s^2", "elastic response spectrum S_e")
    for axis in AXES:
        text = f"design spectrum S_d, direction {axis}"
        group.add(f"design_{axis}", ("period",), of[axis].acceleration(period), "m/s^2", text)
    return group


def _corners(spectrum: AnyDesignSpectrum) -> list[float]:
    """Return T_B, T_C and T_D, s."""
    corners = spectrum.corners
    return list(corners.values() if isinstance(corners, Mapping) else corners)


def _overstrength(design: ElasticDesign, axis: str) -> Group:
    of = design.overstrength[axis]  # type: ignore[index]
    members = [design.frame.members[number] for number in of.members]
    names = np.array([member.name for member in members], dtype=str)
    group = Group(coords={"member": Variable(("member",), names, "", "dissipative member")})
    group.add("storey", ("member",), np.array([member.storey for member in members], dtype=int), "1", "storey")
    group.add("ratio", ("member",), of.ratios, "1", "resistance over effect in the seismic design situation")
    return group
