"""Cross checks of own load cases, patterns and stated combinations of a building."""

from __future__ import annotations

import re
from typing import get_args

from edesign.project.actions.national import Category
from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.building.names import node_name
from edesign.project.building.own_cases import NAMED_CATEGORIES, LoadCaseOfFile, cases_of
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name

_TAKEN = re.compile(r"(G2?|Q[12]?|Q_.*|[ES]_.*|P_Delta.*|self_weight|alpha)")


def check_cases(building: Building, problems: Problems) -> None:
    """Check own load cases, patterns of loads and stated combinations; those of areas are with the other areas.

    Args:
        building: its members and its other loads are right.
    """
    loads, check = building.loads, Selections(building, problems)
    used = {case.category for case in loads.cases.values()}
    known = (*NAMED_CATEGORIES, *loads.psi)
    for name in loads.psi:
        keys: Keys = ("loads", "psi", name)
        if name in get_args(Category):
            message = f"`{name}` has factors of its own; `hazard: national: psi` states others [E-NAME-02]"
            problems.at_key(keys, message)
        elif name not in used:
            problems.at_key(keys, f"no case of `loads.cases` has the category `{name}` [E-KEY-03]")
    for name, case in loads.cases.items():
        keys = ("loads", "cases", name)
        if _TAKEN.fullmatch(name):
            problems.at_key(keys, f"`{name}` is a name of edesign's own cases; take another one [E-NAME-02]")
        if case.category not in known:
            advice = "; imposed loads stand in `areas`, and factors of own categories in `loads.psi`"
            problems.at_value((*keys, "category"), unknown_name("category of own cases", case.category, known, advice))
        if not any(case.values()):
            problems.at_key(
                keys, "this case has no load: give `areas`, `beams`, `nodes`, `floors` or `facades` [E-LOAD-01]"
            )
        elif case.category == "snow" and case.relieving:
            problems.at_key(keys, "snow acts downwards alone, and not the other way [E-LOAD-01]")
        _case(building, problems, check, keys, case)
    _pattern(building, problems)
    _stated(building, problems)


def _case(building: Building, problems: Problems, check: Selections, keys: Keys, case: LoadCaseOfFile) -> None:
    for i, beam in enumerate(case.beams):
        check.standing_beams((*keys, "beams", i), beam)
    for i, node in enumerate(case.nodes):
        check.nodes((*keys, "nodes", i), node.at, node.floors)
    rigid = {at.floor for at in building.layout.diaphragms if at.part == 0}
    for i, force in enumerate(case.floors):
        at = (*keys, "floors", i)
        if not check.floors(at, force.floors):
            continue
        if soft := [floor for floor in force.floors.numbers(1, building.n_storeys) if floor not in rigid]:
            message = f"floor {listed(soft)} is not rigid as one; give forces on its `nodes`, or `facades` [E-LOAD-02]"
            problems.at_value((*at, "floors"), message)
    for i, facade in enumerate(case.facades):
        at = (*keys, "facades", i)
        if not check.storeys(at, facade.storeys):
            continue
        bare = [
            node_name(line, floor)
            for storey in facade.storeys.numbers(1, building.n_storeys)
            for lines, _ in building.layout.faces(storey, facade.side)
            for line in lines
            for floor in (storey - 1, storey)
            if line not in building.layout.node_lines[floor]
        ]
        if bare:
            message = f"the facade stands at {listed(dict.fromkeys(bare))}, where nothing is; give its load by `nodes`"
            problems.at_value(at, f"{message} [E-LOAD-02]")


def _pattern(building: Building, problems: Problems) -> None:
    loads = building.loads
    if loads.pattern == "none":
        return
    keys = ("loads", "pattern")
    if not any(area.Q and area.category in tuple("ABCDEFG") for area in loads.areas):
        problems.at_value(
            keys, "no load of `areas` is a Q of the categories A to G, and only they alternate [E-LOAD-01]"
        )
    if loads.live_load_reduction:
        message = "`live_load_reduction` goes by whole areas, and a pattern loads half of them; take one [E-KEY-03]"
        problems.at_value(keys, message)


def _stated(building: Building, problems: Problems) -> None:
    if building.design is None:
        return
    live = {f"Q_{load.category}" for load in building.loads.items if load.category is not None}
    more = ["G2"] if any(load.G2 for load in building.loads.items) else []
    own = [name for name, _, _ in cases_of(building.loads.cases)]
    names = ["G", *more, *sorted(live), *(["Q"] if len(live) == 1 else []), *own]
    for i, row in enumerate(building.design.fundamental.stated):
        if more and "G" in row and "G2" not in row:
            message = "`G2` is missing beside `G`; give its factor, 0 where it does not act [E-KEY-02]"
            problems.at_item(("design", "fundamental", "stated"), i, message)
        for name in row:
            if name not in names:
                keys = ("design", "fundamental", "stated", i, name)
                problems.at_key(keys, unknown_name("load case", name, names))
