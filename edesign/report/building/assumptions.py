"""Assumptions and limits of the design of a building, in sentences that follow from its file."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.space.structure.design_block import rules_of
from edesign.space.structure.steel_by_thickness import thick_parts

Rows = list[tuple[str, str]]
NOT_CHECKED = (
    "Limits of vibration, patterns of live load, torsion of members, connections and their overstrength "
    "(EN 1998-1, 6.5.5), and bow imperfections of slender columns in frames that sway (EN 1993-1-1, 5.3.2(6)) are not "
    "checked. The bending of braces under their own weight is not in the checks."
)


_RESTRAINED = (
    "They have the stiffness KF E A / L between work points, yield at A f_y both ways and do not buckle. Beams and "
    "columns hold the adjusted strengths omega R_y P_ysc and beta omega R_y P_ysc of all braces of a direction at once "
    "(AISC 341-16, F4.3). Gussets, and the stability of the braces out of their plane, are not checked."
)


def building_assumption_rows(building: Building) -> Rows:
    """Return a topic and its sentences for each assumption; those of the design are left out without one."""
    rows = [("Model", _model(building)), ("Floors", _floors(building)), ("Ground", _ground(building))]
    if building.analyses and (ends := _ends(building)):
        rows.append(("Ends of members in analyses", ends))
    if building.design is not None:
        design = building.design
        rows += [
            ("Analysis", _analysis(design)),
            ("Torsion", _torsion(building, design)),
            ("Imperfections and second order", _second_order(design)),
            *([("Buckling-restrained braces", _RESTRAINED)] if any(run.law for run in building.braces) else []),
            *([("Yield strength in checks", thick)] if (thick := thick_parts(building)) else []),
            ("Stability of members", _stability(design)),
            ("Not checked", rules_of(design).told(NOT_CHECKED)),
        ]
    return rows


def _model(building: Building) -> str:
    return (
        "The building is analysed in space and stays elastic; what it dissipates is in the behaviour factor q. Members "
        "have shear deformations. Walls, stairs and cladding have no stiffness."
    )


def _floors(building: Building) -> str:
    stiff = building.diaphragms.numbers(1, building.n_storeys)
    if not stiff:
        return "Floors are no diaphragms."
    which = "All floors are" if len(stiff) == building.n_storeys else f"Floors {building.diaphragms} are"
    if building.partial_diaphragms:
        which = f"{which} in part" if len(stiff) == 1 else f"{which}, some in part alone,"
    several = [str(floor) for floor in stiff if len(building.rigid_parts(floor)) > 1]
    floors = "floor" if len(several) == 1 else "floors"
    apart = f" The parts of {floors} {', '.join(several)} move apart." if several else ""
    no_force = "beams in them have no axial forces"
    if building.braces or building.dampers:
        no_force += (
            " in the model. Beams that braces or dampers meet, and those joined to them, are checked with the axial "
            "force by equilibrium of the floor, others without"
        )
    return f"{which} rigid in their plane; {no_force}.{apart} Slabs add no strength to beams."


def _ends(building: Building) -> str:
    rigid = building.elements.rigid_ends
    found = []
    if rigid.columns.value or rigid.beams.value:
        found.append("Members do not bend in their rigid ends.")
    if building.joints or any(isinstance(end, float) for ends in building.layout.beam_ends.values() for end in ends):
        found.append("Joints turn about the strong axis of their member by their stiffness.")
    if building.hinges:
        found.append(
            "Plastic hinges lose strength and stiffness with the rotations that they have had. Members that have them "
            "stay elastic between them and about their weak axis."
        )
    if building.panel_zones:
        found.append(
            "Panel zones shear in the frames in which columns bend about their strong axis, and are rigid across them."
        )
    return " ".join(found)


def _ground(building: Building) -> str:
    held = ""
    if building.design is not None and building.held_floors:
        top = max(building.held_floors)
        held = f" A rigid basement reaches up to floor {top}, where the seismic action acts; masses below do not count."
    if building.supports in ("fixed", "pinned"):
        return f"Supports are {building.supports} on ground that does not deform.{held}"
    on_footings = "Footings are springs of their static stiffness. " if building.footings else ""
    return f"{on_footings}Supports are as given; neighbouring foundations do not move each other.{held}"


def _analysis(design: Design) -> str:
    directions = "by SRSS" if design.directions == "srss" else f"with {100 * float(design.directions):g} % of the other"
    drifts = "at most the elastic ones" if design.displacement == "elastic_cap" else "not capped"
    rules = rules_of(design)
    times = "mu_d" if rules.clauses else "q"
    drifts = "at SLV" if rules.clauses else drifts
    return rules.told(
        f"Seismic effects are those of modal response spectrum analysis with {100 * design.damping:g} % damping; modes "
        f"are combined by {design.combination.upper()}, directions {directions}. The vertical component of the action "
        "counts for long spans alone (EN 1998-1, 4.3.3.5.2). "
        f"Displacements are {times} times those of the design spectrum, {drifts}."
    )


def _torsion(building: Building, design: Design) -> str:
    if not design.accidental_torsion:
        return "Accidental torsion is left out."
    if not building.diaphragms.numbers(1, building.n_storeys):
        return "Accidental torsion is left out: no floor is rigid, and its moments act on rigid floors."
    how = (
        "static moments" if design.torsion_by == "static_moments" else "masses beside their place in the modal analysis"
    )
    return f"Accidental eccentricities of {100 * design.accidental_torsion:g} % of the plan act as {how}."


def _second_order(design: Design) -> str:
    sway = "Sway imperfections act as forces." if design.imperfections == "sway" else "There are no sway imperfections."
    if design.second_order == "none":
        return f"{sway} Effects of second order are left out."
    return f"{sway} Effects of second order amplify the sway where the codes ask for it."


def _stability(design: Design) -> str:
    lengths, restraint = design.members.buckling_length, design.members.lateral_restraint
    parts = [
        f"{kind} {of.y:g} (y) and {of.z:g} (z)"
        for kind, of in (("columns", lengths.columns), ("beams", lengths.beams), ("braces", lengths.braces))
    ]
    for place in lengths.places:
        which = " ".join(filter(None, (", ".join(place.groups), place.kind))) or "members"
        where = "" if place.storeys.is_all else f" in storeys {place.storeys}"
        parts.append(f"{which}{where} {place.y:g} (y) and {place.z:g} (z)")
    beams = "restrained by the slab all along" if restraint.beams == "slab" else "restrained at their ends"
    columns = "at the floors" if restraint.columns == "floors" else "all along"
    method = {"annex_a": "Annex A", "annex_b": "Annex B"}[design.members.interaction]
    return (
        f"Buckling lengths over lengths between nodes: {', '.join(parts)}. The flanges of beams are {beams}, those of "
        f"columns {columns}. Interaction is by EN 1993-1-1, {method}."
    )
