"""A project's plane frame as a model of SAP2000, in the plane X-Z."""

from __future__ import annotations

from collections.abc import Iterator

from edesign.errors import InputError
from edesign.exchange.sap2000.from_dampers import add_dampers
from edesign.exchange.sap2000.model import (
    FREE,
    PINNED,
    FrameLoad,
    FrameObject,
    FramePoint,
    GravityCase,
    JointLoad,
    LoadPattern,
    Material,
    Sap2000Model,
    Section,
    SixFlags,
)
from edesign.exchange.sap2000.spectra import spectrum_functions
from edesign.frame.loads import MemberLoads, beam_loads, column_loads, node_loads
from edesign.frame.masses import node_masses, vertical_masses
from edesign.frame.sections.named_section import cross_section
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.section import CrossSection
from edesign.frame.sections.steel_section import SteelSection, steel_section
from edesign.project.actions.loads import Combination
from edesign.project.frame.foundations import FootingSupport
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.members import BraceRun
from edesign.project.frame.sections import ElasticSection, PlateSection, RectangleSection, is_hollow
from edesign.project.frame.supports import springs_of
from edesign.project.notation import names
from edesign.project.project import Project

X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
PATTERNS = {"G": "Dead", "Q": "Live"}
"""Load patterns of a project with their design types."""
NO_BENDING = 1e-12  # m4, of the section of a brace that has no inertia: it does not bend
_POISSON = 0.3  # of steel, EN 1993-1-1, 3.2.6(1); plane frames of edesign have no shear deformation


def from_project(project: Project, without_dampers: bool = False) -> tuple[Sap2000Model, list[str]]:
    """Return a project's frame as a model, and sentences on what the model does not have of it.

    Args:
        without_dampers: whether dampers, isolators and tuned masses are left out.

    Raises:
        InputError: the project has what SAP2000's tables do not have, or not in this translation, and what would
            change the answer.
    """
    _check(project)
    frame = project.frame
    model = Sap2000Model(project.title, degrees=(True, False, True, False, True, False))
    model.joints = {name: (x, 0.0, z) for name, (x, z) in frame.nodes.items()}
    for name, steel in project.materials.items():
        fy = None if isinstance(steel, ElasticMaterial) else steel.fy
        model.materials[name] = Material(name, "Other" if fy is None else "Steel", steel.E, _POISSON, fy=fy)
    for name, run in frame.members.items():
        start, end = frame.ends[name]
        brace = isinstance(run, BraceRun)
        weak = not isinstance(run, BraceRun) and run.axis == "weak"
        section = _section(project, model, run.section, run.material, isinstance(run, BraceRun) and not run.compression)
        free = (True, True) if brace else frame.released.get(name, (False, False))
        at_ends: tuple[SixFlags, SixFlags] = (PINNED if free[0] else FREE, PINNED if free[1] else FREE)
        if brace:
            at_ends = ((False, False, False, True, True, True), PINNED)
        model.frames[name] = FrameObject(name, start, end, section, 90.0 if weak else 0.0, at_ends)
    _supports(project, model)
    for floor in frame.diaphragm_floors:
        joints = [name for name, place in frame.nodes.items() if place[1] == frame.levels[floor]]
        if len(joints) > 1:
            model.diaphragms[f"FLOOR{floor}"] = joints
    _loads(project, model)
    vertical = vertical_masses(project)
    for name, mass in node_masses(project).items():
        model.joint_masses[name] = mass, mass, vertical.get(name, 0.0)
    left_out = list(_left_out(project))
    if project.hazard is not None:
        model.spectra = spectrum_functions(project.hazard)
    if project.dampers is not None and not project.dampers.none:
        if without_dampers:
            left_out.append("dampers, isolators and tuned masses, by --without-dampers")
        else:
            add_dampers(project, model)
            if any(found.nonlinear for found in model.link_properties.values()):
                left_out.append("stiffness of dampers in the modes: links with dashpots in series have none there")
            if standing := model.standing_links():
                left_out.append(f"dampers set in under the gravity loads: the links {standing} carry a share of these")
    model.about = [f"{project.path.name} without {sentence}" for sentence in left_out]
    return model, left_out


def _check(project: Project) -> None:
    frame = project.frame
    refused: list[tuple[tuple[str | int, ...], str]] = []
    for key, what in (("hinges", "hinges"), ("joints", "semi-rigid joints"), ("panel_zones", "panel zones")):
        if getattr(project, key):
            refused.append(((key,), what))
    if frame.leaning_column is not None:
        refused.append((("frame", "leaning_column"), "a leaning column"))
    ends = project.elements.rigid_ends
    if ends.columns.value or ends.beams.value:
        refused.append((("elements", "rigid_ends"), "rigid ends"))
    for i, run in enumerate(frame.braces):
        if run.buckling is not None:
            refused.append((("frame", "braces", i, "buckling"), "braces that buckle"))
    if frame.footings:
        refused.append((("frame", "supports"), "footings"))
    if refused:
        raise InputError(
            "\n".join(
                f"{project.where(*keys)}: SAP2000's tables take no {what} in this translation, and the frame would be "
                "another without them"
                for keys, what in refused
            )
        )


def _left_out(project: Project) -> Iterator[str]:
    if any(not isinstance(steel, ElasticMaterial) for steel in project.materials.values()):
        yield "yielding: members are elastic; Fy is in the table of steel data"
    geometry = project.elements.geometry
    if "corotational" in (geometry.columns, geometry.beams, geometry.braces):
        yield "corotational geometry: the case GRAVITY has P-Delta"
    elif geometry.columns != "linear" and (geometry.beams, geometry.braces) == ("linear", "linear"):
        yield "P-Delta of columns alone: the case GRAVITY of SAP2000 counts it in all members"
    if project.damping is not None:
        yield "inherent damping"
    if project.records:
        yield "ground motions"
    yield "analyses but the gravity loads and the modes"


def _section(project: Project, model: Sap2000Model, name: str, material: str, half: bool) -> str:
    """The name of a section of a material in the model; of diagonals that do not count in compression, half of it."""
    used = {section.material for section in model.sections.values() if section.catalogue == name} | {material}
    called = name if len(used) == 1 else f"{name} {material}"
    called = f"{called} half" if half else called
    if called not in model.sections:
        model.sections[called] = named_section(project, name, called, material, 0.5 if half else 1.0)
    return called


def named_section(project: Project, name: str, called: str, material: str, share: float) -> Section:
    """Return a section of a project with the properties that its members have: in bending, without shear."""
    own = project.sections.get(name)
    shape = cross_section(project, name)
    inertia = shape.inertia or NO_BENDING
    weak, torsion, depth, width = inertia, 2.0 * inertia, 0.0, 0.0
    if own is None:
        full = full_section(name)
        depth, width, torsion = full.h, full.b, full.I_t
    elif isinstance(own, PlateSection):
        depth, width = own.height, own.width
    if isinstance(shape, CrossSection) and not isinstance(own, RectangleSection):
        across = cross_section(project, name, "weak")
        weak = across.inertia if across.inertia is not None else inertia
    assert own is None or isinstance(own, (PlateSection, RectangleSection, ElasticSection))
    return Section(
        called,
        material,
        shape.area,
        torsion,
        inertia,
        weak,
        catalogue=name,
        depth=depth,
        width=width,
        axial_share=share,
    )


def full_section(name: str) -> SteelSection:
    """Return a section of the catalogue with all its properties."""
    return steel_section(name if is_hollow(name) else (profile_names().canonical(name) or name))


def _supports(project: Project, model: Sap2000Model) -> None:
    frame = project.frame
    bent = {
        node
        for name, ends in frame.ends.items()
        if names.member_kind(name) != "brace"
        for node, free in zip(ends, frame.released.get(name, (False, False)), strict=True)
        if not free
    }
    base = {names.node_name(line, 0): line for line in frame.lines}
    for node in frame.nodes:
        if node not in base:
            if node not in bent:  # nothing turns it, and nothing else restrains it
                model.restraints[node] = (False, False, False, False, True, False)
            continue
        support = frame.support(base[node])
        assert not isinstance(support, FootingSupport)
        springs = springs_of(support)
        restraints = (springs.horizontal, springs.vertical, springs.rotation if node in bent else "fixed")
        if not all(isinstance(direction, (str, float)) for direction in restraints):
            where = project.where("frame", "supports", base[node])
            raise InputError(f"{where}: springs that yield or lift off are no springs of SAP2000's joints [E-SAP-29]")
        ux, uz, ry = (direction == "fixed" for direction in restraints)
        model.restraints[node] = (ux, False, uz, False, ry, False)
        kx, kz, kr = (direction if isinstance(direction, float) else 0.0 for direction in restraints)
        if kx or kz or kr:
            model.springs[node] = (kx, 0.0, kz, 0.0, kr, 0.0)


def _loads(project: Project, model: Sap2000Model) -> None:
    for pattern, kind in PATTERNS.items():
        factors = Combination(G=float(pattern == "G"), Q=float(pattern == "Q"))
        model.patterns[pattern] = LoadPattern(pattern, kind)
        for name, loads in beam_loads(project, factors).items():
            _member_loads(model, pattern, name, loads)
        for name, load in column_loads(project, factors).items():
            model.frame_loads.append(FrameLoad(name, pattern, X, 0.0, 1.0, load, load))
        for name, load in node_loads(project, factors).items():
            model.joint_loads.append(JointLoad(name, pattern, (0.0, 0.0, -load, 0.0, 0.0, 0.0)))
    gravity = project.loads.gravity
    p_delta = project.elements.geometry.columns != "linear"
    model.gravity = GravityCase({"G": gravity.G, "Q": gravity.Q}, p_delta)


def _member_loads(model: Sap2000Model, pattern: str, name: str, loads: MemberLoads) -> None:
    """Loads across a beam, positive downwards."""
    if loads.uniform != 0.0:
        model.frame_loads.append(FrameLoad(name, pattern, Z, 0.0, 1.0, -loads.uniform, -loads.uniform))
    for start, end, first, last in loads.parts:
        model.frame_loads.append(FrameLoad(name, pattern, Z, start, end, -first, -last))
    for at, force in loads.points:
        model.frame_points.append(FramePoint(name, pattern, Z, at, -force))
