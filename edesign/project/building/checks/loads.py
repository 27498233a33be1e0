"""Cross checks of loads and masses of a building: on floors and beams that are there, with a category for each Q."""

from __future__ import annotations

from edesign.project.actions.hazard import NtcHazard
from edesign.project.actions.loads import PartialLoad
from edesign.project.building.building import Building
from edesign.project.building.checks.cases import check_cases
from edesign.project.building.checks.selections import Selections
from edesign.project.building.layout import edges
from edesign.project.building.loads import Areas, BeamLoad, Combination, NodeLoad, PerimeterLoad
from edesign.project.building.names import BeamPlace, node_name
from edesign.project.building.own_cases import CaseArea
from edesign.project.building.places import Panels, panels_in
from edesign.project.frame.sections import BoxSection, Catalogue, PlateSection, RivetedSection, no_section
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name


def check_loads(building: Building, problems: Problems, profiles: Catalogue | None = None) -> None:
    """Check loads and masses.

    Args:
        building: its members are right.
        profiles: names of the catalogue; None leaves section names unchecked.
    """
    check = Selections(building, problems)
    loads = building.loads
    for i, area in enumerate(loads.areas):
        keys: Keys = ("loads", "areas", i)
        _variable(problems, keys, area.Q, area.category)
        _placed_area(building, problems, check, keys, area)
        _secondary(building, problems, keys, area, profiles)
    for i, perimeter in enumerate(loads.perimeter):
        keys = ("loads", "perimeter", i)
        _variable(problems, keys, perimeter.Q, perimeter.category)
        if check.floors(keys, perimeter.floors):
            _perimeter(building, problems, keys, perimeter)
    for i, beam in enumerate(loads.beams):
        keys = ("loads", "beams", i)
        _variable(problems, keys, beam.Q, beam.category)
        if check.standing_beams(keys, beam):
            _points(building, problems, keys, beam)
    for i, node in enumerate(loads.nodes):
        keys = ("loads", "nodes", i)
        _variable(problems, keys, node.Q, node.category)
        check.nodes(keys, node.at, node.floors)
    for name, case in loads.cases.items():
        for i, part in enumerate(case.areas):
            _placed_area(building, problems, check, ("loads", "cases", name, "areas", i), part)
    _non_structural(building, problems)
    check_cases(building, problems)
    _categories(building, problems, ("loads", "gravity"), loads.gravity)
    _masses(building, problems, check)


def _variable(problems: Problems, keys: Keys, Q: float, category: str | None, at: Keys | None = None) -> None:
    """A variable load, or a force `at` a point of it, acts downwards and has a category."""
    if Q < 0.0:
        message = "a variable load acts downwards, and is at least 0: uplift is not in the analysis [E-LOAD-01]"
        problems.at_value((*(at or keys), "Q"), message)
    if Q != 0.0 and category is None:
        message = "this key is missing; a variable load has the category of its use: `A` to `H`, or `snow` [E-KEY-02]"
        problems.under(keys, "category", message)


def _non_structural(building: Building, problems: Problems) -> None:
    """NTC 2018 alone has factors of their own for permanent loads that are not structural."""
    if isinstance(building.hazard, NtcHazard):
        return
    for part in ("areas", "perimeter", "beams", "nodes"):
        for i, load in enumerate(getattr(building.loads, part)):
            if load.G2:
                message = (
                    "`G2`, permanent loads that are not structural, are of NTC 2018 (Table 2.6.I); the file has no "
                    "`hazard: {code: ntc-2018}`, so give them as `G` [E-KEY-03]"
                )
                problems.at_key(("loads", part, i, "G2"), message)


def _points(building: Building, problems: Problems, keys: Keys, load: BeamLoad) -> None:
    """Places of forces must be inside the beams that have them."""
    widths = building.widths(load.along)
    shortest = min(widths[place.bay - 1] for place in building.layout.beam_places(load))
    for k, point in enumerate(load.points):
        at_point = (*keys, "points", k)
        for i, at in enumerate(point.at):
            if not 0.0 < at.share(shortest) < 1.0:
                problems.at_item((*at_point, "at"), i, f"{at} is not inside a beam of {shortest:g} m [E-LOAD-02]")
        _variable(problems, keys, point.Q, load.category, at_point)
    for k, part in enumerate(load.partial):
        _partial(problems, (*keys, "partial", k), part, widths, load)
        for Q in part.Q:
            _variable(problems, keys, Q, load.category, (*keys, "partial", k))


def _partial(problems: Problems, keys: Keys, part: PartialLoad, widths: tuple[float, ...], load: BeamLoad) -> None:
    """A load on a part of beams begins and ends inside all of them, and ends behind its beginning."""
    of_beams = [widths[bay - 1] for bay in load.bays.numbers(1, len(widths))]
    shortest = min(of_beams)
    wrong = {key: at for key, at in (("start", part.start), ("end", part.end)) if at.share(shortest) > 1.0}
    for key, at in wrong.items():
        problems.at_value((*keys, key), f"{at} is beyond the end of a beam of {shortest:g} m [E-LOAD-02]")
    ends_early = [width for width in of_beams if part.start.share(width) >= part.end.share(width)]
    if not wrong and ends_early:
        message = f"on a beam of {ends_early[0]:g} m the load ends at {part.end}, not after its `start` at {part.start}"
        problems.at_value((*keys, "end"), f"{message} [E-VALUE-04]")


def _placed_area(building: Building, problems: Problems, check: Selections, keys: Keys, area: Areas | CaseArea) -> None:
    if area.spans == "two_way" and area.secondary_beams:
        problems.at_key(
            (*keys, "secondary_beams"), "a floor on secondary beams spans one way: along `x` or `y` [E-LOAD-02]"
        )
    if check.floors(keys, area.floors) and check.bays((*keys, "bays"), area.bays):
        _area(building, problems, keys, area)


def _secondary(building: Building, problems: Problems, keys: Keys, area: Areas, profiles: Catalogue | None) -> None:
    """Secondary beams have a section and a steel together, and there are some."""
    name, steel = area.secondary_section, area.secondary_material
    if name is None and steel is None:
        return
    if name is None or steel is None:
        missing = "secondary_section" if name is None else "secondary_material"
        message = "this key is missing; secondary beams have a section and a material together [E-KEY-02]"
        problems.under(keys, missing, message)
        return
    if not area.secondary_beams:
        problems.at_key((*keys, "secondary_section"), "there are none: give their number, `secondary_beams` [E-KEY-02]")
    own = building.sections.get(name)
    known = profiles is None or profiles.canonical(name) or profiles.canonical_in_building(name)
    if own is None and not known:
        assert profiles is not None, "without it all names are known"
        problems.at_value((*keys, "secondary_section"), no_section(name, building.sections, profiles))
    elif own is not None and not isinstance(own, (PlateSection, BoxSection, RivetedSection)):
        message = f"`{name}` has no class and no resistance; give a profile, or plates [E-FRAME-02]"
        problems.at_value((*keys, "secondary_section"), message)
    if steel not in building.materials:
        problems.at_value((*keys, "secondary_material"), unknown_name("material", steel, building.materials))


def _area(building: Building, problems: Problems, keys: Keys, area: Areas | CaseArea) -> None:
    layout = building.layout
    wanted = panels_in(area.bays, building.n_bays("x"), building.n_bays("y"))
    bare: set[BeamPlace] = set()
    for floor in area.floors.numbers(1, building.n_storeys):
        for block in () if area.floors.is_all else area.bays:
            if uncovered := _uncovered(building, floor, block):
                problems.at_value((*keys, "bays"), f"floor {floor} does not cover {uncovered} [E-BLDG-02]")
        for panel in sorted(wanted & layout.floors[floor]):
            bare |= {beam for beam in _carriers(area, edges(panel, floor, building.axes)) if beam not in layout.beam_at}
    if bare:
        message = f"the floor rests on beams that are missing: {listed(_by_floor(bare))} [E-BLDG-02]"
        problems.at_value(keys, message)


def _uncovered(building: Building, floor: int, block: Panels) -> str:
    """What a block of bays names that a floor does not cover, "" if nothing: `all` takes those that it covers."""
    covered = building.layout.floors[floor]
    places = set(block.numbers(building.n_bays("x"), building.n_bays("y")))
    if not (block.x.is_all or block.y.is_all):
        return next((f"bay {i} along x, {j} along y" for i, j in sorted(places - covered)), "")
    for along, chosen, axis in (("x", block.x, 0), ("y", block.y, 1)):
        named = set() if chosen.is_all else {place[axis] for place in places}
        if bare := sorted(named - {place[axis] for place in places & covered}):
            return f"bay {bare[0]} along {along}"
    return ""


def _by_floor(places: set[BeamPlace]) -> list[BeamPlace]:
    return sorted(places, key=lambda place: (place.floor, place))


def _carriers(
    area: Areas | CaseArea, around: tuple[BeamPlace, BeamPlace, BeamPlace, BeamPlace]
) -> tuple[BeamPlace, ...]:
    """Return the beams at the edges of a bay that carry its floor load.

    They are those across the span of the floor, and all four where it spans both ways or has secondary beams.
    """
    if area.spans == "two_way" or area.secondary_beams:
        return around
    return around[2:] if area.spans == "x" else around[:2]


def _perimeter(building: Building, problems: Problems, keys: Keys, load: PerimeterLoad) -> None:
    layout = building.layout
    bare = [
        place
        for floor in load.floors.numbers(1, building.n_storeys)
        for place, count in layout.floor_edges[floor].items()
        if count == 1 and place not in layout.beam_at
    ]
    if bare:
        problems.at_value(
            keys, f"at the perimeter beams are missing: {listed(bare)}; give the others by `beams` [E-BLDG-02]"
        )


def _varies_along(load: Areas | PerimeterLoad | BeamLoad | NodeLoad) -> bool:
    """Whether a load has variable forces at places or on parts of beams."""
    return isinstance(load, BeamLoad) and (
        any(point.Q != 0.0 for point in load.points) or any(any(part.Q) for part in load.partial)
    )


def _categories(building: Building, problems: Problems, keys: Keys, factors: Combination) -> None:
    """Factors by category are there for each that the loads have."""
    if not isinstance(factors.Q, dict):
        return
    used = {item.category for item in building.loads.items if item.Q != 0.0 or _varies_along(item)}
    absent = sorted(category for category in used if category and category not in factors.Q)
    if absent:
        problems.at_value((*keys, "Q"), f"no factor for the category {listed(absent)} of the loads [E-KEY-02]")


def _masses(building: Building, problems: Problems, check: Selections) -> None:
    masses = building.masses
    if masses is None:
        return
    if (masses.from_loads is None) == (masses.given is None):
        problems.at_key(("masses",), "give either `from_loads` or `given`, one of them [E-KEY-03]")
    if masses.given is not None and "phi" in masses.model_fields_set:
        problems.at_key(("masses", "phi"), "phi reduces variable loads, which given masses do not come from [E-KEY-03]")
    if masses.from_loads is not None:
        _categories(building, problems, ("masses", "from_loads"), masses.from_loads)
    elif masses.added:
        problems.at_key(("masses", "added"), "added masses are beside those of `from_loads` [E-KEY-03]")
    for i, added in enumerate(masses.added):
        check.nodes(("masses", "added", i), added.at, added.floors)
    seen: dict[str, int] = {}
    for i, given in enumerate(masses.given or ()):
        keys: Keys = ("masses", "given", i)
        if not check.nodes(keys, given.at, given.floors):
            continue
        for floor in given.floors.numbers(1, building.n_storeys):
            there = building.layout.node_lines[floor]
            names = [node_name(line, floor) for line in building.lines_of(given.at) if line in there]
            twice = [name for name in names if name in seen]
            if twice:
                message = f"{listed(twice)} got a mass in masses.given[{seen[twice[0]]}] already [E-NAME-02]"
                problems.at_value(keys, message)
                return
            seen |= dict.fromkeys(names, i)
