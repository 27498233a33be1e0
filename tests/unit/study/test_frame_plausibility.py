"""Frames that nobody would build: period, masses, damping, state under gravity."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from unit.study.frames import project

from edesign import check_project
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project
from edesign.study.analysis.modal import fundamental_period
from edesign.study.check.advice import frame_warnings
from edesign.study.check.plausibility import implausible

FRAME = """\
edesign: 1
title: Three storeys
frame:
  bays: {count: 2, width: 6 m}
  storeys: [4 m, 3.5 m, 3.5 m]
  columns: [{storeys: all, section: HEB260, material: S275}]
  beams: [{floors: all, section: IPE360, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams: [{floors: all, G: 20 kN/m, Q: 9 kN/m}]
masses: {from_loads: {G: 1.0, Q: 0.3}}
damping: {kind: rayleigh, ratio: 2 %, modes: [1, 2]}
analyses:
  - {name: modes, kind: modal, modes: 3}
"""


def first_period_of(of: Project, fixed_base: bool = False) -> float:
    (period,) = fundamental_period(of, fixed_base=fixed_base) or ()
    return period


def reported(*changes: tuple[str, str]) -> list[str]:
    text = FRAME
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    made = project(text)
    return implausible(made, first_period_of(made))


def test_a_frame_that_was_meant_is_plausible() -> None:
    assert reported() == []


def test_masses_of_a_whole_building_on_a_perimeter_frame() -> None:
    """Ten times the weight of its own loads, on sections that suit them."""
    heavy = ("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 10.0, Q: 3.0}")
    assert reported(heavy, ("section: HEB260", "section: HEB500"), ("section: IPE360", "section: IPE500")) == []


def test_masses_a_hundred_times_the_loads() -> None:
    """T1 is ten times as long, and d = T1^2/4 under the weight applied sideways a hundred times as large."""
    period, weight = reported(("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 100.0, Q: 30.0}"))
    bare = first_period_of(project(FRAME))
    assert f"T1 = {10.0 * bare:.3g} s is implausible for a frame 11 m high" in period
    assert f"from {2.0 * math.sqrt(0.3 * 11.0 / 1.5):.2g} s on" in period
    assert "100 times the gravity loads" in weight


def test_the_behaviour_factor_counts() -> None:
    """Frames that are meant to yield have to be stiffer: 4.4.2.2 takes the drift of the design earthquake, q d_e."""
    heavy = ("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 10.0, Q: 3.0}")
    assert reported(heavy) == []
    hazard = "hazard: {code: ec8-2004, a_gR: 0.2 g, ground: B, spectrum: 1, behaviour_factor: 4}\nanalyses:"
    (line,) = reported(heavy, ("analyses:", hazard))
    assert "with q = 4" in line


def test_masses_in_kilograms_that_were_meant_in_tonnes() -> None:
    given = ("from_loads: {G: 1.0, Q: 0.3}", "given: [{floors: all, mass: 15 kg}]")
    period, weight = reported(given)
    assert "its masses are ten times too small" in period
    loads = 3 * 12.0 * (20e3 + 0.3 * 9e3)
    assert f"{9 * 15 * STANDARD_GRAVITY / loads:.3g} times the gravity loads" in weight


def test_sections_in_millimetres_that_were_meant_in_centimetres() -> None:
    """All sizes ten times: second moments of area ten thousand times, T1 a hundredth."""
    large = "{height: 2.6 m, width: 2.6 m, flange: 175 mm, web: 100 mm}"
    (period,) = reported(
        ("section: HEB260", "section: large"),
        ("section: IPE360", "section: large"),
        ("materials:\n", f"sections: {{large: {large}}}\nmaterials:\n"),
    )
    assert "or its sections too large" in period


def test_inherent_damping_of_a_half() -> None:
    (line,) = reported(("ratio: 2 %", "ratio: 50 %"))
    assert "an inherent damping of 50 % is implausible" in line


def test_loads_five_times_too_large_make_beams_yield() -> None:
    """q l^2 / 12 = 113.5 x 36 / 12 = 340 kNm, and W_pl f_y = 280 kNm of IPE360; the masses stay what they were."""
    found = reported(
        ("G: 20 kN/m, Q: 9 kN/m", "G: 100 kN/m, Q: 45 kN/m"),
        ("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 0.2, Q: 0.06}"),
    )
    assert any(line.startswith("beams yield under the gravity loads alone, most B_") for line in found), found


@pytest.mark.parametrize("name", ["thesis_10_storey", "thesis_one_storey", "thesis_three_storey"])
def test_the_projects_that_are_shipped_are_plausible(name: str) -> None:
    from edesign.frame.project_file import load_project

    made = load_project(Path(__file__).parents[3] / "projects" / name / "project.yaml")
    assert implausible(made, first_period_of(made)) == []


def test_check_warns(tmp_path: Path) -> None:
    made = project(
        FRAME.replace("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 100, Q: 30}"), tmp_path / "project.yaml"
    )
    assert "is implausible" in check_project(made)["warnings"]


def test_an_isolated_frame_is_judged_on_a_fixed_base() -> None:
    """Column bases that cannot turn on a fixed base are column bases on fixed supports."""
    isolators = """\
dampers:
  laws:
    pendulum: {type: friction_pendulum, parameters: {W: 300 kN, R: 3 m, f_slow: 4 %, f_fast: 4 %, a: 30 s/m, Y: 1 mm}}
  isolation:
    isolators: [{lines: all, law: pendulum}]
    base: {G: 20 kN/m, rotation: fixed}
    design_displacement: 150 mm
analyses:
"""
    low = FRAME.replace("[4 m, 3.5 m, 3.5 m]", "[3 m]")
    on_supports, isolated = project(low), project(low.replace("analyses:\n", isolators))
    fixed = first_period_of(isolated, fixed_base=True)
    assert fixed == pytest.approx(first_period_of(on_supports), rel=1e-9)
    period = first_period_of(isolated)
    assert period > 2.0 * math.sqrt(0.3 * 3.0 / 1.5)  # which would be refused of a frame
    assert not any(" T1 " in f" {line}" for line in frame_warnings(isolated, {}))
    heavy = low.replace("from_loads: {G: 1.0, Q: 0.3}", "from_loads: {G: 300.0, Q: 90.0}").replace(
        "analyses:\n", isolators
    )
    assert any(
        "s without its isolators is implausible for a frame 3 m high" in w for w in frame_warnings(project(heavy), {})
    )


@pytest.mark.parametrize(("load", "yields"), [(2400e3, True), (1200e3, False)])
def test_braces_that_gravity_brings_to_yield_are_reported(load: float, yields: bool) -> None:
    """A column shortens by e = N / (E A), and a cross brace over b and h by e h^2 / (b^2 + h^2) of its length.

    The braces' own share of the load is below a hundredth, and the strains are 30 % from their yield strain.
    """
    column, b, h, fy = 78.1e-4, 6.0, 4.0, 80e6
    strain = load / (210e9 * column) * h**2 / (b**2 + h**2)
    assert (strain > 1.15 * fy / 210e9) == yields and abs(strain / (fy / 210e9) - 1.0) > 0.15
    text = f"""\
edesign: 1
title: Braced storey
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{{storeys: all, section: HEB200, material: high}}]
  beams: [{{floors: all, section: IPE300, material: high}}]
  braces: [{{bays: 1, storeys: 1, kind: cross, section: rod, material: low}}]
sections: {{rod: {{rectangles: [{{width: 5 mm, depth: 20 mm, centre: 0 mm}}]}}}}
materials:
  high: {{law: bilinear, E: 210 GPa, fy: 700 MPa}}
  low: {{law: bilinear, E: 210 GPa, fy: {fy} Pa}}
loads: {{nodes: [{{floors: all, lines: all, G: {load} N}}]}}
masses: {{given: [{{floors: all, mass: 100 t}}]}}
analyses: [{{name: modes, kind: modal, modes: 1}}]
"""
    made = project(text)
    reported = [line for line in implausible(made, first_period_of(made)) if line.startswith("braces yield")]
    assert reported == (["braces yield under the gravity loads alone: `D_1_1_r`, `D_1_1_f`, most D_1_1_r"] * yields)
