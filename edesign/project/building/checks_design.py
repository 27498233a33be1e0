"""Cross checks of the seismic action and the design of a building."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.design import KINDS, Select
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
            "a design is checked by EN 1993-1-1 and EN 1998-1, whose behaviour factors, importance classes and limits "
            f"of drift belong to the action of `ec8-2004`, not of `{hazard.code}`; analyses take it [E-HAZ-03]"
        )
        problems.at_value(("hazard", "code"), message)
    elif not hazard.levels:
        problems.under(
            ("hazard",), "levels", "this key is missing; the design is for one level of the hazard [E-KEY-02]"
        )
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
        kinds = {run.kind for place, run in building.layout.brace_at.items() if place.along == along}
        chevrons = sorted(kinds & set(CHEVRONS))
        if system.type == "concentric_diagonal" and chevrons:
            message = (
                f"there are braces of kind `{chevrons[0]}` along {along}; with any of them the type is `concentric_v`"
                " [E-BLDG-01]"
            )
            problems.at_value(("design", "systems", along, "type"), message)
        if braced and system.alpha_u_over_alpha_1 is not None:
            message = (
                f"Table 6.2 has alpha_u / alpha_1 for moment frames alone, and along {along} is `{system.type}`"
                " [E-BLDG-01]"
            )
            problems.at_key(("design", "systems", along, "alpha_u_over_alpha_1"), message)
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


def _groups(building: Building) -> dict[str, None]:
    """The names of the groups of members, in their order."""
    found: dict[str, None] = {}
    for runs in (building.columns, building.beams, building.braces):
        found |= dict.fromkeys(run.group or "" for run in runs)
    return found


def _select(building: Building, select: Select, problems: Problems) -> None:
    """Names of groups in `select` are those of the building."""
    named = _groups(building)
    keys: Keys = ("design", "select")
    if select.objective == "cost" and not select.prices:
        problems.at_value(
            (*keys, "objective"), "`cost` needs the prices of a kilogram; give `prices` by family [E-KEY-02]"
        )
    if select.objective == "mass" and select.prices:
        problems.at_key((*keys, "prices"), "prices count where the objective is `cost`; it is `mass` [E-KEY-03]")
    for group in select.lists.groups:
        if group not in named:
            problems.at_key((*keys, "lists", "groups", group), unknown_name("group", group, named))
    for name in select.largest_depth:
        if name not in (*KINDS, *named):
            problems.at_key((*keys, "largest_depth", name), unknown_name("group", name, (*KINDS, *named)))
