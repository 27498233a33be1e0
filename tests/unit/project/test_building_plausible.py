"""Slips of units and decimals in building files: what no steel building has is refused, the unusual is warned of."""

from __future__ import annotations

import math

import pytest
from building_examples import SMALL, building
from messages import says

from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building import BuildingError
from edesign.project.building.checks.plausible import HEIGHT, POINT, WIDTH, unusual
from edesign.project.notation.units import STANDARD_GRAVITY

GIVEN = SMALL.replace("{from_loads: {}}", "{given: [{floors: 1-2, mass: 9 t}]}")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named
        ("fy: 275 MPa", "fy: @275 Pa", "materials.S275.fy 150 700 MPa E-UNIT-03"),
        ("fy: 275 MPa", "fy: @275 Pa", "materials.S275.fy `275 MPa` E-UNIT-03"),
        ("fy: 275 MPa", "fy: @27.5 kN/cm^2 ", ""),
        ("fy: 275 MPa", "fy: @235 N/mm^2", ""),
        ("fy: 275 MPa", "fy: @355 GPa", "materials.S275.fy `355 MPa` E-UNIT-03"),
        ("fy: 275 MPa", "fy: 275 MPa, E: @210 MPa", "materials.S275.E E-UNIT-03"),
        ("fy: 275 MPa", "fy: 275 MPa, E: @210 MPa", "materials.S275.E `210 GPa` E-UNIT-03"),
        ("fy: 275 MPa", "fy: 275 MPa, E: @70 GPa", "materials.S275.E 1993-1-1 E-UNIT-03"),
        ("fy: 275 MPa", "fy: 275 MPa, density: @7850 g/m^3", "materials.S275.density `7850 kg/m^3` E-UNIT-03"),
        ("[4 m, 3 m]", "[@4 mm, 3 m]", "storeys[0] 0.5 150 E-UNIT-03"),
        ("[4 m, 3 m]", "[@4 mm, 3 m]", "storeys[0] `4 m` E-UNIT-03"),
        ("[4 m, 3 m]", "{count: 2, height: @3500 m}", "storeys.height E-UNIT-03"),
        ("[4 m, 3 m]", "{count: 2, height: @3500 m}", "storeys.height `3500 mm` E-UNIT-03"),
        ("[6 m, 4 m]", "[6 m, @7200 m]", "plan.x[1] E-UNIT-03"),
        ("width: 5 m", "width: @7200 m", "plan.y.width E-UNIT-03"),
        ("G: 4 kN/m^2", "G: @4.5 N/m^2", "loads.areas[0].G E-UNIT-03"),
        ("G: 4 kN/m^2", "G: @4.5 MN/m^2", "loads.areas[0].G `4.5 kN/m^2` E-UNIT-03"),
        ("Q: 2 kN/m^2", "Q: @2 N/m^2", "loads.areas[0].Q E-UNIT-03"),
        ("  areas:", "  perimeter: [{G: @1.2 N/m}]\n  areas:", "loads.perimeter[0].G `1.2 kN/m` E-UNIT-03"),
        ("  areas:", "  beams: [{along: x, G: @12 MN/m}]\n  areas:", "loads.beams[0].G E-UNIT-03"),
        ("design:\n", "design:\n  overstrength: @1.25 %\n", "design.overstrength E-UNIT-03"),
        ("design:\n", "design:\n  partial_factors: {M0: @100}\n", "design.partial_factors.M0 E-UNIT-03"),
        (
            "design:\n",
            "design:\n  members: {buckling_length: {braces: {z: @1e6}}}\n",
            "design.members.buckling_length.braces.z E-UNIT-03",
        ),
        ("a_gR: 0.24 g", "a_gR: @24 g", "hazard.a_gR E-UNIT-03"),
        ("  areas:", "  nodes: [{at: A1, floors: 1, G: @5 N}]\n  areas:", "loads.nodes[0].G `5 kN` E-UNIT-03"),
    ],
)
def test_what_no_steel_building_has_is_refused(old: str, new: str, said: str) -> None:
    text = SMALL.replace(old, new.replace("@", ""))
    assert text != SMALL
    if not said:
        building(text)
        return
    with pytest.raises(BuildingError) as caught:
        building(text)
    before = SMALL.replace(old, new).partition("@")[0]
    place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
    assert [(p.mark.line, p.mark.column) for p in caught.value.problems] == [place]
    assert says(str(caught.value), said)


@pytest.mark.parametrize("mass", ["9 kg", "9000 t", "18 g"])
def test_masses_that_no_floor_has_are_refused(mass: str) -> None:
    with pytest.raises(BuildingError, match=r"masses.given\[0\].*E-UNIT-03") as caught:
        building(GIVEN.replace("9 t", mass))
    assert len(caught.value.problems) == 2  # floors 1 and 2


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("fy: 275 MPa", "fy: 690 MPa", "materials.S275.fy: an unusual yield strength"),
        ("[4 m, 3 m]", "[4 m, 1.5 m]", "storeys[1]: an unusual height of a storey; 2 to 20 m is usual"),
        ("[4 m, 3 m]", "[35 m, 3 m]", "storeys[0]: an unusual height"),
        ("[6 m, 4 m]", "[60 m, 4 m]", "plan.x[0]: an unusual width of a bay; 2 to 24 m is usual"),
        ("Q: 2 kN/m^2", "Q: 20 kN/m^2", "loads.areas[0].Q: an unusual load"),
        ("G: 4 kN/m^2", "G: 45 kN/m^2", "loads.areas[0].G: an unusual load"),
        ("a_gR: 0.24 g", "a_gR: 0.24 m/s^2", "hazard.a_gR: an unusual reference ground acceleration; 0.04 to 0.5 g"),
        ("a_gR: 0.24 g", "a_gR: 0.8 g", "hazard.a_gR: an unusual reference ground acceleration"),
    ],
)
def test_what_is_unusual_is_reported_and_allowed(old: str, new: str, said: str) -> None:
    (found,) = unusual(building(SMALL.replace(old, new)))
    assert found[1].startswith(said)


def test_usual_buildings_have_no_warning() -> None:
    assert not unusual(building(SMALL)) and not unusual(building(GIVEN))
    stored = SMALL.replace("Q: 2 kN/m^2, category: B", "Q: 20 kN/m^2, category: E")  # a store has no common bound
    assert not unusual(building(stored))
    assert not unusual(building(SMALL.replace("G: 4 kN/m^2", "G: 0 kN/m^2")))


def test_bounds_are_those_of_the_catalogue() -> None:
    """A beam of S460 fails under its own weight at sqrt(8 W_pl f_y / (A rho g)); a column crushes at A f_y."""
    sections = [steel_section(name) for name in profile_names()]
    longest = max(math.sqrt(8.0 * s.W_pl_y * 460e6 / (s.mass * STANDARD_GRAVITY)) for s in sections)
    assert 0.9 * WIDTH.possible[1] < longest < WIDTH.possible[1] == HEIGHT.possible[1]
    assert 0.8 * POINT.possible[1] < max(s.A for s in sections) * 460e6 < POINT.possible[1]
