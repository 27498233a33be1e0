"""The results of an elastic design as groups of an archive."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.space.analysis.actions import patterns_of
from edesign.space.analysis.response import STATIONS
from edesign.space.archived_basis import add_restraints, basis
from edesign.space.checks.buckling_moments import FreeBeamMoments
from edesign.space.checks.foundations import COMPONENTS
from edesign.space.designed import ElasticDesign
from edesign.space.structure.design_block import design_of
from edesign.space.structure.frame import AXES

PLACE = "building"
SELECTION = "selection"
"""Of how `edesign design` chose the sections, below `PLACE`; other designs have none."""
IMPERFECTION = "S"
"""What the cases of sway imperfections are alternatives of."""
FORCES = ("N", "V_y", "V_z", "T", "M_y", "M_z")
_UNITS = "N, moments N*m"


def groups(design: ElasticDesign) -> Iterator[tuple[str, Group]]:
    """Yield the groups of an elastic design with their places below `PLACE`."""
    yield PLACE, _summary(design)
    yield f"{PLACE}/modes", _modes(design)
    yield f"{PLACE}/combinations", _combinations(design)
    for axis in AXES:
        yield f"{PLACE}/storeys_{axis}", _storeys(design, axis)
    yield f"{PLACE}/sway", _sway(design)
    yield f"{PLACE}/criteria", _criteria(design)
    if design.joints:
        yield f"{PLACE}/joints", _joints(design)
    if design.panels:
        yield f"{PLACE}/panels", _panels(design)
    if design.links:
        yield f"{PLACE}/links", _links(design)
    yield f"{PLACE}/foundations", _foundations(design)
    yield f"{PLACE}/members", _members(design)
    if design.members.free_beams is not None:
        yield f"{PLACE}/free_beams", _free_beams(design, design.members.free_beams)
    yield f"{PLACE}/deflections", _deflections(design)
    if design.lateral.cases:
        yield f"{PLACE}/lateral", _lateral(design)
    yield f"{PLACE}/forces", _forces(design)
    for name, group in basis(design):
        yield f"{PLACE}/{name}", group


def _summary(design: ElasticDesign) -> Group:
    frame = design.frame
    group = Group(
        attributes={
            "passed": int(design.passed),
            "notes": list(design.notes),
            "mass_kg": frame.acting_mass,
            "ductility_class": design.building.design.ductility_class if design.building.design else "",
            "seismic_code": design.building.design.code.seismic if design.building.design else "",
            "gamma_M0": design.members.members[0].gamma_M0,
            "gamma_M1": design.members.members[0].gamma_M1,
            "regular_in_plan": int(design.regular.plan),
            "regular_in_elevation": int(design.regular.elevation),
        }
    )
    for axis in AXES:
        of = design.response[axis]
        group.attributes |= {
            f"q_{axis}": of.spectrum.q,
            f"base_shear_{axis}_N": of.base_shear,
            f"base_shear_without_beta_{axis}_N": of.base_shear_without_beta,
            f"F_b_{axis}_N": of.F_b,
            f"Omega_{axis}": design.overstrength[axis].Omega,
            f"Omega_member_{axis}": design.overstrength[axis].governing,
            f"alpha_cr_{axis}": float(design.sway.alpha_cr[:, AXES.index(axis)].min()),
        }
    return group


def _modes(design: ElasticDesign) -> Group:
    modes = design.modes
    group = _numbered("mode", modes.period.size, "number of the mode")
    group.add("period", ("mode",), modes.period, "s", "natural period")
    for number, name in enumerate(("x", "y", "rz")):
        ratio = modes.effective_mass_ratio[:, number]
        group.add(f"effective_mass_ratio_{name}", ("mode",), ratio, "1", f"effective modal mass ratio, {name}")
    about = "effective modal mass ratio of rotation about the corner of lines A and 1, as some programs give it"
    group.add("effective_mass_ratio_rz_corner", ("mode",), _about_corner(design), "1", about)
    group.add("frequency", ("mode",), 1.0 / modes.period, "Hz", "natural frequency")
    group.coords["diaphragm"] = _numbers("diaphragm", modes.floor_shapes.shape[1], "rigid floor, from below")
    group.coords["degree"] = Variable(("degree",), np.array(["ux", "uy", "rz"]), "", "degree of a floor")
    shape = "shape of the floors, generalised mass 1"
    group.add("floor_shape", ("mode", "diaphragm", "degree"), modes.floor_shapes, "kg^-1/2", shape)
    for axis in AXES:
        of = design.response[axis]
        group.add(f"design_acceleration_{axis}", ("mode",), of.acceleration, "m/s^2", f"S_d(T), direction {axis}")
        group.add(f"lower_bound_{axis}", ("mode",), of.lower_bound, "1", f"beta a_g governs, direction {axis}")
    return group


def _about_corner(design: ElasticDesign) -> np.ndarray:
    """Return the effective modal mass ratios of rotation about a vertical axis through the origin, (n_modes,)."""
    moves = design.frame.level_of_nodes > design.frame.held
    mass, moved = np.where(moves, design.frame.node_mass, 0.0), design.modes.displacements
    x, y = design.frame.coordinates[:, 0], design.frame.coordinates[:, 1]
    participation = (mass * (x * moved[:, :, 1] - y * moved[:, :, 0])).sum(axis=1)
    return np.asarray(participation**2 / (mass * (x**2 + y**2)).sum())


def _combinations(design: ElasticDesign) -> Group:
    group = _numbered("combination", len(design.combinations), "number of the combination")
    for name, text in (
        ("name", "as reports print it"),
        ("set", "design situation"),
        ("equation", "of EN 1990, or of NTC 2018"),
        ("directions", "how the components of the seismic action add up: as a sum, or srss"),
    ):
        values = np.array([getattr(row, name) for row in design.combinations])
        group.add(name, ("combination",), values, "", text)
    group.coords["case"] = Variable(("case",), np.array(design.effects.cases), "", "load case")
    text = "what the case is an alternative of: `[category]`, `[case]` of patterns, sway imperfections; else itself"
    group.add("alternative", ("case",), np.array([*map(_alternative(design), design.effects.cases)]), "", text)
    group.coords["axis"] = Variable(("axis",), np.array(AXES), "", "direction of the seismic action")
    static = design.effects.static_factors(design.combinations)
    group.add("static", ("combination", "case"), static, "1", "factors of the load cases")
    seismic = np.array([row.seismic[:2] for row in design.combinations])
    group.add("seismic", ("combination", "axis"), seismic, "1", "factors of the seismic action along x and y")
    return group


def _alternative(design: ElasticDesign) -> Callable[[str], str]:
    """Return the function that says what a load case is an alternative of."""
    cases, sway = design.frame.cases, set(design.sway.cases)
    patterned = {name for of in patterns_of(cases, design.building.loads.pattern) for name in of}
    patterned = {name for name in patterned if {name[:-1] + half for half in "12"} <= patterned}

    def of(name: str) -> str:
        if name in sway:
            return IMPERFECTION if name.startswith("S_") else "P_Delta"
        if name in cases and cases[name].own:
            return f"[{cases[name].category}]"
        return f"[{name[:-1]}]" if name in patterned else name

    return of


def _storeys(design: ElasticDesign, axis: str) -> Group:
    table = design.storeys[axis]  # type: ignore[index]
    group = _numbered("storey", table.height.size, "storey, from below")
    if table.limit is not None:
        group.attributes["limit"] = table.limit
    for name, unit, text in (
        ("height", "m", "storey height"),
        ("gravity", "N", "P_tot, gravity load at and above the storey"),
        ("shear", "N", "V_tot, storey shear"),
        ("drift", "m", "d_r, design interstorey drift"),
        ("drift_q", "m", "q d_e"),
        ("theta", "1", "interstorey drift sensitivity"),
        ("theta_q", "1", "interstorey drift sensitivity with q d_e"),
        ("amplification", "1", "factor for second-order effects"),
        ("reduced", "1", "nu d_r / h; by NTC 2018 q d_r / h under SLD or SLO"),
    ):
        group.add(name, ("storey",), getattr(table, name), unit, text)
    return group


def _sway(design: ElasticDesign) -> Group:
    sway = design.sway
    names = np.array([row.name for row in sway.combinations])
    group = Group(coords={"persistent": Variable(("persistent",), names, "", "persistent combination")})
    for number, axis in enumerate(AXES):
        for name, unit, values, text in (
            ("alpha_cr", "1", sway.alpha_cr, "least factor of the loads at which the building sways, infinite: none"),
            ("initial_sway", "rad", sway.initial_sway, "phi of the sway imperfection"),
            ("amplification", "1", sway.amplification, "factor on the sway effects"),
        ):
            group.add(f"{name}_{axis}", ("persistent",), values[:, number], unit, f"{text}, direction {axis}")
    text = "least factor of the loads at which the building sways in any direction or twists"
    group.add("alpha_cr", ("persistent",), sway.alpha_cr.min(axis=1), "1", text)
    return group


def _criteria(design: ElasticDesign) -> Group:
    rules = design.criteria
    group = _numbered("rule", len(rules), "number of the rule")
    for name, text in (
        ("clause", "of EN 1998-1:2004, or of the standard that it names"),
        ("text", "what is asked"),
        ("detail", "where, or what follows"),
    ):
        values = [rule.told or rule.clause if name == "clause" else getattr(rule, name) for rule in rules]
        group.add(name, ("rule",), np.array(values), "", text)
    for name, text in (("required", "limit"), ("value", "what was found")):
        values = [np.nan if getattr(rule, name) is None else getattr(rule, name) for rule in rules]
        group.add(name, ("rule",), np.array(values, dtype=float), "1", text)
    passed = np.array([-1 if rule.passed is None else int(rule.passed) for rule in rules])
    group.add("passed", ("rule",), passed, "1", "1: passed, 0: failed, -1: only informs")
    return group


def _columns(dim: str, text: str, items: Sequence[object], columns: Iterable[tuple[str, str, str]]) -> Group:
    """What is archived of numbered things: name of an attribute of theirs, its unit, and what it is."""
    group = _numbered(dim, len(items), text)
    for name, unit, label in columns:
        group.add(name, (dim,), np.array([getattr(item, name) for item in items]), unit, label)
    return group


def _joints(design: ElasticDesign) -> Group:
    joints = design.joints
    columns = (
        ("node", "", "node"),
        ("axis", "", "direction of its beams"),
        ("M_Rc", "N*m", "sum of the resistances of the columns"),
        ("M_Rb", "N*m", "sum of the resistances of the beams"),
        ("ratio", "1", "of both, at least 1.3"),
        ("exempt", "1", "the rule is not asked here"),
    )
    return _columns("joint", "number of the joint", joints, columns)


def _panels(design: ElasticDesign) -> Group:
    panels = design.panels
    columns = (
        ("node", "", "node"),
        ("axis", "", "direction of its beams"),
        ("V_wp_Ed", "N", "shear when the beams have their hinges"),
        ("V_wp_Rd", "N", "resistance of the web of the column"),
        ("V_wp_Rd_doubled", "N", "resistance with a supplementary web plate"),
        ("doubler", "m", "thickness of that plate, 0: none is needed"),
    )
    return _columns("panel", "number of the web panel", panels, columns)


def _links(design: ElasticDesign) -> Group:
    of_links = (
        ("member", "", "name of the link"),
        ("axis", "", "direction of its bracing"),
        ("section", "", "section"),
        ("e", "m", "length"),
        ("alpha", "1", "smaller over greater moment at its ends"),
        ("e_s", "m", "length up to which it is short"),
        ("e_L", "m", "length from which it is long"),
        ("category", "", "short, intermediate or long"),
        ("N_Ed", "N", "in the seismic design situation, without sign"),
        ("V_Ed", "N", "in the seismic design situation, without sign"),
        ("M_Ed", "N*m", "in the seismic design situation, without sign"),
        ("axial", "1", "N_Ed / N_pl,Rd"),
        ("V_p", "N", "V_p,link, less beside an axial force above 0.15 N_pl,Rd"),
        ("M_p", "N*m", "M_p,link, less beside an axial force above 0.15 N_pl,Rd"),
        ("shear_use", "1", "V_Ed / V_p,link"),
        ("moment_use", "1", "M_Ed / M_p,link"),
        ("longest", "m", "largest length where N_Ed is at least 0.15 N_pl,Rd; infinite elsewhere"),
        ("Omega", "1", "Omega_i"),
        ("theta_p", "rad", "rotation between the link and the beam beside it"),
        ("theta_pR", "rad", "limit of the rotation"),
        ("lateral", "N", "force on the lateral supports of either flange at its ends"),
    )
    group = _columns("link", "number of the link", design.links, of_links)
    for name, unit, text in (
        ("end_thickness", "m", "thickness of stiffeners where braces meet it"),
        ("end_width", "m", "least width of both of them together"),
        ("spacing", "m", "largest distance of stiffeners between its ends, infinite: none for shear"),
        ("flange_distance", "m", "distance of one stiffener each from its ends, 0: none for bending"),
        ("count", "1", "stiffeners between its ends"),
        ("thickness", "m", "their thickness"),
        ("width", "m", "least width of each of them"),
        ("sides", "1", "sides of the web at which they stand"),
    ):
        group.add(name, ("link",), np.array([getattr(link.stiffeners, name) for link in design.links]), unit, text)
    return group


def _foundations(design: ElasticDesign) -> Group:
    of = design.foundations
    axes = Variable(("axis",), np.array(AXES), "", "direction of the seismic action")
    group = Group(
        coords={
            "support": Variable(("support",), np.array(of.nodes), "", "node"),
            "component": Variable(("component",), np.array(COMPONENTS), "", "global, F_z positive upwards"),
            "case": Variable(("case",), np.array(of.cases), "", "load case"),
            "axis": axes,
            "combination": Variable(("combination",), np.array(of.combinations), "", "combination of actions"),
            "persistent": Variable(("persistent",), np.array(of.persistent), "", "persistent combination"),
        }
    )
    text = "reactions in persistent combinations, without sway imperfections"
    group.add("acting", ("persistent", "support", "component"), of.acting, _UNITS, text)
    text = "reactions on the frame to load cases"
    group.add("static", ("case", "support", "component"), of.static, _UNITS, text)
    text = "reactions to the seismic action without sign, with second-order effects and accidental torsion"
    group.add("seismic", ("axis", "support", "component"), of.seismic, _UNITS, text)
    group.add("factor", ("axis", "support"), of.factor, "1", "gamma_Rd Omega (EN 1998-1, 4.4.2.6(4))")
    text = "1: Omega is that of the hinge at the column base, 0: that of the dissipative members of the direction"
    group.add("of_foot", ("axis", "support"), of.of_base.astype(int), "1", text)
    for name in ("least", "largest"):
        text = f"{name} design action, E_F,G -+ gamma_Rd Omega E_F,E"
        group.add(name, ("combination", "support", "component"), getattr(of, name), _UNITS, text)
    return group


def _members(design: ElasticDesign) -> Group:
    members = design.frame.members
    names = np.array([member.name for member in members])
    group = Group(coords={"member": Variable(("member",), names, "", "name of the member")})
    for name in ("kind", "section", "material", "group"):
        group.add(name, ("member",), np.array([getattr(member, name) for member in members]), "", name)
    frames = np.array([", ".join(member.frame) for member in members])
    group.add("frame", ("member",), frames, "", "plane frames that it stands in")
    group.add("storey", ("member",), np.array([member.storey for member in members]), "1", "storey")
    group.add("length", ("member",), design.frame.length, "m", "length")
    group.coords["coordinate"] = Variable(("coordinate",), np.array(["x", "y", "z"]), "", "global coordinate")
    for end in ("start", "end"):
        places = design.frame.coordinates[[getattr(member, end) for member in members]]
        group.add(end, ("member", "coordinate"), places, "m", f"{end} of the member")
    checks = design.members
    group.coords["check"] = Variable(("check",), np.array(checks.checks), "", "check")
    group.add("clause", ("check",), np.array(checks.clauses), "", "clause of the check")
    group.add("utilisation", ("member", "check"), checks.utilisation, "1", "largest utilisation, nan: does not apply")
    group.add(
        "combination", ("member", "check"), checks.combination, "1", "number of the governing combination, 0: none"
    )
    group.add("station", ("member", "check"), checks.station, "1", "governing place as a fraction of the length")
    add_restraints(group, design)
    return group


def _free_beams(design: ElasticDesign, of: FreeBeamMoments) -> Group:
    names = np.array([design.frame.members[number].name for number in of.members], dtype=str)
    group = _numbered("combination", of.M_b_Rd.shape[1], "number of the combination")
    group.coords["beam"] = Variable(("beam",), names, "", "name of the beam")
    group.coords["case"] = Variable(("case",), np.array(design.effects.cases), "", "load case")
    text = "resistance in lateral torsional buckling, by the moment diagram"
    group.add("M_b_Rd", ("beam", "combination"), of.M_b_Rd, "N*m", text)
    group.add("span", ("beam",), of.span, "m", "between restraints; of halves of a beam that braces meet, of the whole")
    group.add("uniform", ("beam",), of.uniform.astype(int), "1", "whether a uniform moment is taken for the diagram")
    text = "sum of P sin2(pi x / L) of the loads on the top flange, downwards"
    group.add("load", ("case", "beam"), of.loads, "N", text)
    return group


def _deflections(design: ElasticDesign) -> Group:
    of = design.deflections
    beams = [design.frame.members[number] for number in of.members]
    group = Group(coords={"beam": Variable(("beam",), np.array([beam.name for beam in beams]), "", "name of the beam")})
    group.add("group", ("beam",), np.array([beam.group for beam in beams]), "", "group")
    group.add("span", ("beam",), of.span, "m", "span")
    group.add("total", ("beam",), of.total, "m", "largest deflection in characteristic combinations")
    group.add("live", ("beam",), of.live, "m", "largest deflection of their variable loads alone")
    number = len(design.members.rows) + 1 + of.combination
    group.add("combination", ("beam",), number, "1", "number of the combination of `total`")
    limits = design_of(design.building).serviceability.beams
    for name, limit in (("total", limits.total), ("live", limits.live)):
        if limit is not None:
            group.attributes[f"limit_{name}"] = limit
    return group


def _lateral(design: ElasticDesign) -> Group:
    of = design.lateral
    group = _numbered("storey", of.height.size, "storey, from below")
    group.coords["case"] = Variable(("case",), np.array(of.cases), "", "load case")
    group.coords["axis"] = Variable(("axis",), np.array(AXES), "", "direction")
    group.add("height", ("storey",), of.height, "m", "storey height")
    group.add("force", ("case", "axis", "storey"), of.force, "N", "force on the floor above the storey")
    group.add("drift", ("case", "axis", "storey"), of.drift, "m", "largest drift of the columns of the storey")
    text = "largest drift of the columns of the storey in characteristic combinations"
    group.add("combined", ("axis", "storey"), of.combined, "m", text)
    number = len(design.members.rows) + 1 + of.combination
    group.add("combination", ("axis", "storey"), number, "1", "number of the combination of `combined`")
    group.add("top", ("axis",), of.top, "m", "largest displacement of the roof in characteristic combinations")
    group.attributes["total_height_m"] = of.total_height
    limits = design_of(design.building).serviceability.sway
    for name, limit in (("storey", limits.storey), ("building", limits.building)):
        if limit is not None:
            group.attributes[f"limit_{name}"] = limit
    return group


def _forces(design: ElasticDesign) -> Group:
    acting = design.effects
    names = np.array([member.name for member in design.frame.members])
    group = Group(
        coords={
            "member": Variable(("member",), names, "", "name of the member"),
            "station": Variable(("station",), STATIONS, "1", "place as a fraction of the length"),
            "force": Variable(("force",), np.array(FORCES), "", "internal force, N positive in tension"),
            "case": Variable(("case",), np.array(acting.cases), "", "load case"),
            "axis": Variable(("axis",), np.array(AXES), "", "direction of the seismic action"),
        }
    )
    group.add("static", ("case", "member", "station", "force"), acting.static, _UNITS, "effects of load cases")
    text = "effects of the seismic action without sign, with second-order effects and accidental torsion"
    group.add("seismic", ("axis", "member", "station", "force"), acting.seismic, _UNITS, text)
    return group


def _numbered(name: str, count: int, text: str) -> Group:
    return Group(coords={name: _numbers(name, count, text)})


def _numbers(name: str, count: int, text: str) -> Variable:
    return Variable((name,), np.arange(1, count + 1), "1", text)
