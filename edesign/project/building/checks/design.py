"""Cross checks of the seismic action and the design of a building."""

from __future__ import annotations

from edesign.project.actions.hazard import NtcHazard
from edesign.project.building.building import Building
from edesign.project.building.design import KINDS, RESTRAINED, Design, Select, System
from edesign.project.building.members import CHEVRONS
from edesign.project.checks.hazard import check_hazard
from edesign.project.checks.selections import GridSelections
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name


def check_design(building: Building, problems: Problems, files: bool = True) -> None:
    """Check hazard and design.

    Args:
        building: read without schema problems.
        files: whether the files that the hazard names must be there.
    """
    check_hazard(building.hazard, building, problems, files)
    hazard, design = building.hazard, building.design
    if getattr(hazard, "behaviour_factor", None) is not None:
        message = "a building has a behaviour factor in each direction; give `q` under design.systems [E-BLDG-01]"
        problems.at_key(("hazard", "behaviour_factor"), message)
    if design is None:
        return
    if hazard is None:
        problems.at_key(("design",), "a design needs the seismic action, and the file has no `hazard` [E-KEY-02]")
    elif building.design_hazard is None:
        message = (
            "a design is checked by EN 1993-1-1 and EN 1998-1 or NTC 2018, whose behaviour factors, classes and limits "
            f"of drift belong to the action of `ec8-2004` or `ntc-2018`, not of `{hazard.code}`; analyses take it"
            " [E-HAZ-03]"
        )
        problems.at_value(("hazard", "code"), message)
    elif hazard.code != design.code.seismic:
        message = (
            f"the design is by `{design.code.seismic}` and the action by `{hazard.code}`; both are of one code, as "
            "with "
            f"`design: {{code: {{seismic: {hazard.code}}}}}` [E-HAZ-03]"
        )
        problems.at_value(("hazard", "code"), message)
    elif not hazard.levels:
        problems.under(
            ("hazard",), "levels", "this key is missing; the design is for one level of the hazard [E-KEY-02]"
        )
    elif isinstance(hazard, NtcHazard):
        _ntc(building, hazard, design, problems)
    elif design.level is None and len(hazard.levels) > 1:
        message = f"this key is missing; the hazard has the levels {listed(hazard.levels)} [E-KEY-02]"
        problems.under(("design",), "level", message)
    elif design.level is not None and design.level not in hazard.levels:
        problems.at_value(("design", "level"), unknown_name("level", design.level, hazard.levels))
    if building.masses is None:
        problems.at_key(("design",), "a design needs `masses`, and the file has none [E-MODAL-02]")
    for along, system in (("x", design.systems.x), ("y", design.systems.y)):
        braced = any(place.along == along for place in building.layout.brace_at)
        if braced != (system.type != "moment_frame"):
            seen = "there are braces" if braced else "no bay is braced"
            message = f"`{system.type}`: along {along} {seen} [E-BLDG-01]"
            problems.at_value(("design", "systems", along, "type"), message)
            continue
        runs = [run for place, run in building.layout.brace_at.items() if place.along == along]
        kinds, linked = {run.kind for run in runs}, {run.link is not None for run in runs}
        if linked - {system.type == "eccentric"}:
            has = "has no" if system.type == "eccentric" else "has a"
            message = (
                f"`{system.type}`, and a brace along {along} {has} `link`; `eccentric` has them in all of its braces, "
                "and no other type has any [E-BLDG-01]"
            )
            problems.at_value(("design", "systems", along, "type"), message)
            continue
        chevrons = sorted(kinds & set(CHEVRONS))
        if system.type == "concentric_diagonal" and chevrons:
            message = (
                f"there are braces of kind `{chevrons[0]}` along {along}; with any of them the type is `concentric_v`"
                " [E-BLDG-01]"
            )
            problems.at_value(("design", "systems", along, "type"), message)
        if braced and system.type != "eccentric" and system.alpha_u_over_alpha_1 is not None:
            message = (
                "Table 6.2 has alpha_u / alpha_1 for moment frames and eccentric bracings alone, and along "
                f"{along} is `{system.type}` [E-BLDG-01]"
            )
            problems.at_key(("design", "systems", along, "alpha_u_over_alpha_1"), message)
        _restrained(building, along, design, problems)
        if system.type == "concentric_v" and not chevrons:
            message = (
                f"no brace along {along} is a `chevron` or `v`; the type of others is `concentric_diagonal` [E-BLDG-01]"
            )
            problems.at_value(("design", "systems", along, "type"), message)
    named = _groups(building)
    for i, place in enumerate(design.members.buckling_length.places):
        keys: Keys = ("design", "members", "buckling_length", "places", i)
        GridSelections(problems, building.n_storeys, "building").storeys(keys, place.storeys)
        for k, group in enumerate(place.groups):
            if group not in named:
                problems.at_item((*keys, "groups"), k, unknown_name("group", group, named))
    _select(building, design.select, problems)


def _restrained(building: Building, along: str, design: Design, problems: Problems) -> None:
    """Buckling-restrained braces stand where they are the system, which needs q with its source and capacity design."""
    system: System = getattr(design.systems, along)
    keys: Keys = ("design", "systems", along)
    there = {run.law is not None for place, run in building.layout.brace_at.items() if place.along == along}
    if system.type != RESTRAINED:
        if True in there:
            message = f"there are buckling-restrained braces along {along}, whose type is `{RESTRAINED}` [E-BLDG-01]"
            problems.at_value((*keys, "type"), message)
        if system.q_source is not None:
            message = f"q of `{system.type}` is of the seismic code; a source is for `{RESTRAINED}` alone [E-KEY-03]"
            problems.at_key((*keys, "q_source"), message)
        return
    if False in there:
        message = f"along {along} are other braces than buckling-restrained ones, `section: BRB25` [E-BLDG-01]"
        problems.at_value((*keys, "type"), message)
    if system.q == "table":
        message = "EN 1998-1 has no behaviour factor of buckling-restrained braces: give a number, and its `q_source`"
        problems.under(keys, "q", f"{message} [E-KEY-02]")
    elif system.q_source is None:
        message = "this key is missing: whose value `q` is, such as an approval; EN 1998-1 has none [E-KEY-02]"
        problems.under(keys, "q_source", message)
    if design.ductility_class == "low":
        message = f"`{RESTRAINED}` along {along} needs capacity design, which class low has not [E-BLDG-01]"
        problems.at_value(("design", "ductility_class"), message)
    if design.code.seismic != "ec8-2004":
        message = f"`{RESTRAINED}` is not in the rules of `{design.code.seismic}` here; take `ec8-2004` [E-BLDG-01]"
        problems.at_value((*keys, "type"), message)


def _groups(building: Building) -> dict[str, None]:
    """The names of the groups of members, in their order."""
    found: dict[str, None] = {}
    for runs in (building.columns, building.beams, building.braces):
        found |= dict.fromkeys(run.group or "" for run in runs)
    return found


def _ntc(building: Building, hazard: NtcHazard, design: Design, problems: Problems) -> None:
    """Limit states that a design by NTC 2018 needs, and keys that this code does not know."""
    if design.level is not None and design.level not in hazard.levels:
        problems.at_value(("design", "level"), unknown_name("level", design.level, hazard.levels))
    elif design.level is not None and hazard.levels[design.level].limit_state != "SLV":
        problems.at_value(
            ("design", "level"), "the design by NTC 2018 is for SLV (7.3.6.1); name a level of it [E-HAZ-06]"
        )
    wanted = {"SLV": "the strength of members"}
    ordinary = hazard.class_of_use in ("I", "II")
    if design.drift.limit != "none":
        wanted["SLD" if ordinary else "SLO"] = f"drifts in class of use {hazard.class_of_use}"
    if not ordinary:
        wanted["SLD"] = f"the strength of members under it in class of use {hazard.class_of_use}"
    for state, what in wanted.items():
        if building.level_of_limit_state(state) is None:
            message = f"no level is of {state}, by which NTC 2018, 7.3.6.1, looks at {what} [E-HAZ-06]"
            problems.at_key(("hazard", "levels"), message)
    given = design.model_fields_set
    foreign = {
        ("displacement",): "displacement" in given,
        ("directions",): design.directions != 0.3,
        ("drift", "nu"): "nu" in design.drift.model_fields_set,
        ("fundamental", "expression"): design.fundamental.expression != "6.10",
        ("code", "actions"): "actions" in design.code.model_fields_set and design.code.actions != "ntc-2018",
    }
    for keys, there in foreign.items():
        if there:
            message = "NTC 2018 leaves no such choice; take this key out of a design by `ntc-2018` [E-KEY-03]"
            problems.at_key(("design", *keys), message)
    if building.masses is not None and building.masses.phi != 1.0:
        message = "phi is of EN 1998-1; the masses of NTC 2018, 3.2.4, have psi_2 alone [E-KEY-03]"
        problems.at_key(("masses", "phi"), message)


def _select(building: Building, select: Select, problems: Problems) -> None:
    """Names of groups in `select` are those of the building."""
    design = building.design
    assert design is not None, "select is a block of it"
    for place, clause in enumerate(select.leave_out):
        if (design.code.seismic == "ntc-2018") != clause.startswith("7."):
            message = (
                f"`{clause}` is no clause of the seismic code of this design, `{design.code.seismic}` [E-VALUE-03]"
            )
            problems.at_value(("design", "select", "leave_out", place), message)
    named = _groups(building)
    keys: Keys = ("design", "select")
    if select.objective == "cost" and not select.prices:
        problems.at_value(
            (*keys, "objective"), "`cost` needs the prices of a kilogram; give `prices` by family [E-KEY-02]"
        )
    for key in ("splice", "doubler") if select.objective == "mass" else ():
        if getattr(select.prices_each, key) is not None:
            message = "prices count where the objective is `cost`; it is `mass` [E-KEY-03]"
            problems.at_key((*keys, "prices_each", key), message)
    if select.objective == "mass" and select.prices:
        problems.at_key((*keys, "prices"), "prices count where the objective is `cost`; it is `mass` [E-KEY-03]")
    for group in select.lists.groups:
        if group not in named:
            problems.at_key((*keys, "lists", "groups", group), unknown_name("group", group, named))
    for name in select.largest_depth:
        if name not in (*KINDS, *named):
            problems.at_key((*keys, "largest_depth", name), unknown_name("group", name, (*KINDS, *named)))
