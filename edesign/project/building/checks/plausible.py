"""What dimensions, steels, loads and masses of a steel building can be, and what is usual: slips of units are found.

All bounds of this kind stand here, each with its reason; those of lengths, which frames have too, stand in
`notation.plausible_range`. Beyond what is possible a value is refused, with the unit that was probably meant; beyond
what is usual it is warned of, as uncommon buildings are allowed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from edesign.project.actions.hazard import EC8Hazard
from edesign.project.building.building import Building
from edesign.project.building.design import KINDS
from edesign.project.building.layout import Panel
from edesign.project.notation.plausible_range import HEIGHT, WIDTH, Range
from edesign.project.notation.quantities import ACCELERATION, AREA_LOAD, DENSITY, FORCE, LINE_LOAD, MASS, NUMBER, STRESS
from edesign.project.notation.units import STANDARD_GRAVITY, units_of
from edesign.project.reading.problems import Keys, Problems, keys_text

LIGHTEST, HEAVIEST = 10.0, 100e3
"""Loads of a floor, N/m2: a coated fabric of a membrane roof weighs 10 N/m2; 4 m of concrete (EN 1991-1-1, Table A.1,
25 kN/m3) or 10 m of water weigh 100 kN/m2."""

YIELD = Range(
    "yield strength of structural steel",
    STRESS,
    "MPa",
    (150e6, 700e6),
    "S235 of 400 mm has 165 MPa (EN 10025-2), the grades end with S700 (EN 1993-1-12)",
    (215e6, 460e6),
    "EN 1993-1-1, Table 3.1, goes from S235 of 80 mm to S460; the checks have no rules for other steels",
)
MODULUS = Range(
    "modulus of elasticity of steel",
    STRESS,
    "GPa",
    (190e9, 2200e9),
    "EN 1993-1-1 does not check other materials; tenfold values stand for rigid parts of a model",
    (195e9, 220e9),
    "EN 1993-1-1, 3.2.6 has 210 GPa, and EN 1993-1-4, 2.1.3 has 195 to 220 GPa of stainless steel",
)
STEEL_DENSITY = Range(
    "density of steel",
    DENSITY,
    "kg/m^3",
    (7200.0, 10000.0),
    "cast iron is lightest in EN 1991-1-1, Table A.4; more than a quarter on 7850 kg/m^3 is no allowance for joints",
    (7700.0, 10000.0),
    "EN 1991-1-1, Table A.4, has 77 to 78.5 kN/m3",
)
OTHER_MODULUS = Range(
    "modulus of elasticity",
    STRESS,
    "GPa",
    (0.1e9, 2200e9),
    "timber across the grain has 0.3 GPa (EN 338); ten times that of steel stands for rigid parts of a model",
    (0.1e9, 2200e9),
    "",
)
OTHER_DENSITY = Range(
    "density",
    DENSITY,
    "kg/m^3",
    (1.0, 10000.0),
    "parts without weight have 1 kg/m^3, and steel with its joints is heaviest",
    (1.0, 10000.0),
    "",
)
CONCRETE = Range(
    "modulus of the concrete of a slab",
    MODULUS.kind,
    "GPa",
    (5e9, 60e9),
    "light concrete under loads that last has 5 GPa, and C90/105 44 GPa (EN 1992-1-1, Table 3.1)",
    (10e9, 45e9),
    "half of that of C20/25 to that of C90/105",
)
AREA = Range(
    "load of a floor or roof",
    AREA_LOAD,
    "kN/m^2",
    (LIGHTEST, HEAVIEST),
    "a membrane roof weighs 0.01 kN/m^2, 4 m of concrete 100 kN/m^2",
    (LIGHTEST, 25e3),
    "1 m of concrete weighs 25 kN/m^2 (EN 1991-1-1, Table A.1)",
)
IMPOSED = Range(
    AREA.what,
    AREA_LOAD,
    "kN/m^2",
    AREA.possible,
    AREA.why,
    (LIGHTEST, 7.5e3),
    "EN 1991-1-1, Tables 6.2 to 6.10, have at most 7.5 kN/m^2 on areas",
)
WIND = Range(
    "pressure on a facade",
    AREA_LOAD,
    "kN/m^2",
    (LIGHTEST, 10e3),
    "10 kN/m^2 is the pressure of a gust of 126 m/s, and none stronger was measured",
    (LIGHTEST, 3e3),
    "3 kN/m^2 is the pressure of a gust of 69 m/s",
)
LINE = Range(
    "load along a beam",
    LINE_LOAD,
    "kN/m",
    (LIGHTEST, 1e6),
    "the bounds of loads on areas, on a strip of 1 m and of 10 m",
    (LIGHTEST, 250e3),
    "1 m of concrete on a strip of 10 m weighs 250 kN/m",
)
POINT = Range(
    "load on a node",
    FORCE,
    "kN",
    (LIGHTEST, 100e6),
    "the least load of an area on 1 m^2, and more than the heaviest rolled column carries, 87 MN of S460",
    (LIGHTEST, 100e6),
    "",
)
FLOOR_MASS = Range(
    "mass of a floor by its area",
    MASS,
    "t",
    (LIGHTEST / STANDARD_GRAVITY, HEAVIEST / STANDARD_GRAVITY),
    "the bounds of loads on areas, over the acceleration of gravity",
    (LIGHTEST / STANDARD_GRAVITY, 25e3 / STANDARD_GRAVITY),
    "1 m of concrete has 2.5 t/m^2",
)

GROUND = Range(
    "reference ground acceleration",
    ACCELERATION,
    "g",
    (0.0, 2.0 * STANDARD_GRAVITY),
    "the ground of few records on rock has moved with more than 2 g, and no zone of a code comes near it",
    (0.04 * STANDARD_GRAVITY, 0.5 * STANDARD_GRAVITY),
    "below 0.04 g EN 1998-1 need not be observed (3.2.1(5)P), above 0.5 g are no zones of its National Annexes",
)

_SLIPS = (0.1, 10.0), "a tenth or tenfold of the recommended values near 1 are slips of decimals"
RESISTANCE = Range("partial factor of resistance", NUMBER, "", *_SLIPS, (1.0, 1.25), "EN 1993-1-1, 6.1(1)")
ACTION = Range("partial factor of actions", NUMBER, "", *_SLIPS, (1.0, 1.5), "EN 1990, Table A1.2(B)")
OVERSTRENGTH = Range("overstrength factor", NUMBER, "", *_SLIPS, (1.0, 1.5), "EN 1998-1, 6.2(3) has 1.25")
BUCKLING_LENGTH = Range(
    "buckling length over the length between nodes",
    NUMBER,
    "",
    (1e-3, 100.0),
    "0.001 leaves buckling out, and at 100 nothing stands",
    (1e-3, 10.0),
    "more than that of a column in a soft frame that sways",
)


def check_plausible(building: Building, problems: Problems) -> None:
    """Refuse values that no steel building has; zero loads are allowed.

    Args:
        building: read without schema problems.
    """
    for keys, value, bounds in _values(building):
        if not bounds.refuses(value):
            continue
        written = problems.node(keys).text
        allowed = f"{bounds.shown(bounds.possible)} is allowed ({bounds.why}){_meant(written, bounds)}"
        problems.at_value(keys, f"`{written}` is no {bounds.what}: {allowed} [E-UNIT-03]")


def check_given_masses(building: Building, problems: Problems) -> None:
    """Refuse given masses that no floor has, by the area of the bays that it covers.

    Args:
        building: the building without schema problems.
    """
    for floor, by_area in _mass_by_area(building).items():
        if FLOOR_MASS.refuses(by_area):
            message = (
                f"floor {floor} has {by_area:.4g} kg/m^2, which no floor has: {FLOOR_MASS.possible[0]:.4g} to "
                f"{FLOOR_MASS.possible[1]:.4g} kg/m^2 is allowed ({FLOOR_MASS.why}); `mass` is that of each node"
                " [E-UNIT-03]"
            )
            problems.at_value(("masses", "given", _entry_of(building, floor)), message)

    added: dict[int, float] = {}
    for i, item in enumerate(building.masses.added if building.masses is not None else ()):
        for floor in item.floors.numbers(1, building.n_storeys):
            there = set(building.lines_of(item.at)) & set(building.layout.node_lines[floor])
            added[floor] = added.get(floor, 0.0) + item.mass * len(there)
            by_area = added[floor] / _area(building, building.layout.floors[floor])
            if by_area > FLOOR_MASS.possible[1]:
                message = f"floor {floor} has {by_area:.4g} kg/m^2 of added masses, which no floor has [E-UNIT-03]"
                problems.at_value(("masses", "added", i, "mass"), message)
                return


def unusual(building: Building) -> list[tuple[Keys, str]]:
    """Return place and sentence of each value that is possible but unusual."""
    found: list[tuple[Keys, str]] = [
        (
            keys,
            f"{keys_text(keys)}: an unusual {bounds.what}; {bounds.shown(bounds.usual)} is usual: {bounds.why_usual}",
        )
        for keys, value, bounds in _values(building)
        if bounds.warns(value)
    ]
    for floor, by_area in _mass_by_area(building).items():
        if FLOOR_MASS.warns(by_area):
            text = f"floor {floor} has an unusual mass, {by_area:.4g} kg/m^2: {FLOOR_MASS.why_usual}"
            found.append((("masses", "given", _entry_of(building, floor)), text))
    return found


def _values(building: Building) -> Iterator[tuple[Keys, float, Range]]:
    """The values that have bounds, with their places; zero loads have none."""
    for along in ("x", "y"):
        yield from _lengths(("plan", along), getattr(building.plan, along), "width", WIDTH)
    hazard = building.hazard
    if isinstance(hazard, EC8Hazard) and hazard.a_gR is not None:
        yield ("hazard", "a_gR"), hazard.a_gR, GROUND
    yield from _factors(building)
    yield from _lengths(("storeys",), building.storeys, "height", HEIGHT)
    for name, steel in building.materials.items():
        if steel.law == "elastic" and building.design is None:  # no clause for steel looks at it
            yield ("materials", name, "E"), steel.E, OTHER_MODULUS
            yield ("materials", name, "density"), steel.density, OTHER_DENSITY
            continue
        yield ("materials", name, "fy"), steel.fy, YIELD
        yield ("materials", name, "E"), steel.E, MODULUS
        yield ("materials", name, "density"), steel.density, STEEL_DENSITY
    for i, run in enumerate(building.beams):
        if run.slab is not None:
            yield ("beams", i, "slab", "E"), run.slab.E, CONCRETE
    for part, permanent, variable in (
        ("areas", AREA, IMPOSED),
        ("perimeter", LINE, LINE),
        ("beams", LINE, LINE),
        ("nodes", POINT, POINT),
    ):
        for i, load in enumerate(getattr(building.loads, part)):
            stored = load.category in ("E", "snow")  # what is stored and how deep it snows has no common bound
            of_Q = permanent if stored else variable
            for key, value, bounds in (("G", load.G, permanent), ("G2", load.G2, permanent), ("Q", load.Q, of_Q)):
                if value:
                    yield ("loads", part, i, key), abs(value), bounds
    yield from _points(building)
    bounds_of = {"areas": AREA, "beams": LINE, "nodes": POINT, "floors": POINT, "facades": WIND}
    for name, case in building.loads.cases.items():
        for part, i, key, value in case.values():
            yield ("loads", "cases", name, part, i, key), abs(value), bounds_of[part]


def _points(building: Building) -> Iterator[tuple[Keys, float, Range]]:
    """Forces at places along beams, and loads on parts of them."""
    for i, load in enumerate(building.loads.beams):
        for k, point in enumerate(load.points):
            for key, value in (("G", point.G), ("Q", point.Q)):
                if value:
                    yield ("loads", "beams", i, "points", k, key), abs(value), POINT
        for k, part in enumerate(load.partial):
            for key, values in (("G", part.G), ("Q", part.Q)):
                if any(values):
                    yield ("loads", "beams", i, "partial", k, key), max(map(abs, values)), LINE


def _factors(building: Building) -> Iterator[tuple[Keys, float, Range]]:
    """The factors of the design."""
    if building.design is None:
        return
    for key, bounds in {"M0": RESISTANCE, "M1": RESISTANCE, "G": ACTION, "Q": ACTION}.items():
        if value := getattr(building.design.partial_factors, key):
            yield ("design", "partial_factors", key), value, bounds
    yield ("design", "overstrength"), building.design.overstrength, OVERSTRENGTH
    lengths = building.design.members.buckling_length
    for kind in KINDS:
        for axis in ("y", "z"):
            keys: Keys = ("design", "members", "buckling_length", kind, axis)
            yield keys, getattr(getattr(lengths, kind), axis), BUCKLING_LENGTH
    for i, place in enumerate(lengths.places):
        for axis in ("y", "z"):
            keys = ("design", "members", "buckling_length", "places", i, axis)
            yield keys, getattr(place, axis), BUCKLING_LENGTH


def _lengths(keys: Keys, of: object, key: str, bounds: Range) -> Iterator[tuple[Keys, float, Range]]:
    """Widths or heights: each of a list, or the one that all have."""
    if isinstance(of, tuple):
        for i, value in enumerate(of):
            yield (*keys, i), value, bounds
    else:
        yield (*keys, key), getattr(of, key), bounds


def _mass_by_area(building: Building) -> dict[int, float]:
    """Given mass of each floor that has some, by the area of the bays that it covers, kg/m2."""
    masses: dict[int, float] = {}
    for given in building.masses.given or () if building.masses else ():
        for floor in given.floors.numbers(1, building.n_storeys):
            there = building.layout.node_lines[floor]
            masses[floor] = masses.get(floor, 0.0) + given.mass * len(set(building.lines_of(given.at)) & set(there))
    return {floor: mass / _area(building, building.layout.floors[floor]) for floor, mass in masses.items()}


def _area(building: Building, panels: frozenset[Panel]) -> float:
    x, y = building.widths("x"), building.widths("y")
    return sum(x[i - 1] * y[j - 1] for i, j in panels)


def _entry_of(building: Building, floor: int) -> int:
    """The first entry of given masses on a floor."""
    given = building.masses.given or () if building.masses else ()
    return next(i for i, item in enumerate(given) if floor in item.floors.numbers(1, building.n_storeys))


def _meant(written: str, bounds: Range) -> str:
    """`; did you mean ...?` with the unit in which the number written is usual, or nothing."""
    match = re.match(r"\s*[-+]?([0-9.]+(?:[eE][-+]?[0-9]+)?)", written)
    if not match:
        return ""
    number = abs(float(match[1]))
    units = [unit for unit, factor in units_of(bounds.kind).items() if not bounds.warns(number * factor)]
    if not units:
        return ""
    unit = bounds.unit if bounds.unit in units else units[0]
    return f"; did you mean `{f'{written[: match.end()].strip()} {unit}'.strip()}`?"
