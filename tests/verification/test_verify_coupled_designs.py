"""Designs of dampers of buildings whose modes along the direction and in turns share it, and pass each other.

References: a floor on cantilevers with equal frequencies along x and in turns and a dashpot beside its centre, whose
modes are known in closed form: the turn about the dashpot is not damped, the other one has c (1 + d^2 / r^2) / (2 m w).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from design_examples import design
from verification.test_verify_building_designs import COMMON
from verification.test_verify_shaken_buildings import stiffness

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building import parse_building
from edesign.study.design.design import DesignResult, run_design

LEVER = 2.5  # of the dampers from the centre of the floor, m
METHODS = {
    "viscous": "method: viscous, law: oil, damping: 10 %",
    "power": "method: viscous, law: oil4, damping: 10 %, amplitude: spectrum, level: DBE",
    "share": "method: hysteretic, law: steel, shear_share: 20 %, level: DBE",
    "loops": "method: hysteretic, law: steel, damping: 6 %, level: DBE",
    "elastomer": "method: strain_energy, law: rubber, damping: 8 %, strain: 20 %, target_in: first_mode,"
    " layer_thickness: 20 mm, level: DBE",
}
SIZES = ("damping_coefficient", "yield_force", "damper_stiffness")


def floor(middle: float, beside: float) -> AnalysisFile:
    """A floor of 32 t on six columns.

    Args:
        middle: share of the mass on the middle line, with which the floor turns faster.
        beside: mass at one edge that makes the floor eccentric, t.
    """
    text = f"""\
edesign_building: 1
title: A floor that turns as fast as it moves
plan: {{x: [3 m, 3 m], y: [{2.0 * LEVER} m]}}
storeys: [3.5 m]
columns: [{{section: HEB200, material: S275, strong: x}}]
beams: [{{along: x, section: IPE300, material: S275, ends: pinned}}]
missing: {{beams: [{{along: x}}, {{along: y}}]}}
materials: {{S275: {{E: 210 GPa, fy: 275 MPa, nu: 0.3, law: elastic}}}}
loads: {{self_weight: false}}
masses:
  given:
    - {{at: [A, C], floors: 1, mass: {8.0 * (1.0 - middle)!r} t}}
    - {{at: B1, floors: 1, mass: {16.0 * middle!r} t}}
    - {{at: B2, floors: 1, mass: {16.0 * middle + beside!r} t}}
{COMMON}"""
    return parse_building(text, "building.yaml", BuildingSections())


def made(text: str, file: AnalysisFile) -> DesignResult:
    """Dampers at one edge."""
    where = "kind: storey, along: x, frames: X2, bays: 1, state: initial"
    return run_design(file, "tried", design(f"{text}, {where}", file), Path("."))


def test_dampers_beside_the_centre_of_a_floor_that_turns_as_fast_as_it_moves() -> None:
    """c = 2 zeta m w: d^2 / (r^2 + d^2) of the motion is not damped, the rest has c (1 + d^2 / r^2) / (2 m w).

    1e-3: the shares are those of small damping, and shift by its square, 1e-4 here.
    """
    k_x, k_y, k_turn = stiffness("HEB200")
    omega2 = 6.0 * k_x / 32e3
    polar = (6.0 * k_x * LEVER**2 + 4.0 * k_y * 3.0**2 + 6.0 * k_turn) / omega2
    middle = 1.0 - (polar - 32e3 * LEVER**2) / (32e3 * 3.0**2)  # four masses at 3 m from the centre along x
    found = made(METHODS["viscous"].replace("10 %", "1 %"), floor(middle, 0.0)).group
    coefficient = float(found.variables["damping_coefficient"].values[0])
    assert coefficient == pytest.approx(2.0 * 0.01 * 32e3 * np.sqrt(omega2), rel=1e-3)
    complex_ratios = np.sort(found.variables["damping_complex"].values[:2])
    r2 = polar / 32e3
    assert complex_ratios == pytest.approx([0.0, 0.01 * (1.0 + LEVER**2 / r2)], rel=2e-3, abs=1e-6)


@pytest.mark.parametrize("name", METHODS)
def test_a_design_does_not_jump_where_modes_pass_each_other(name: str) -> None:
    """Half the step of the mass, half the largest step of the dampers; 0.65 leaves room for the curvature.

    The mode with most mass along x changes on the way.
    """
    largest, leading = [], set()
    for count in (9, 17):
        sizes = []
        for middle in np.linspace(0.68, 0.90, count).tolist():
            found = made(METHODS[name], floor(middle, 0.5))
            assert found.status == "completed", found.reason
            leading.add(int(found.group.attributes["leading_mode"]))
            size = next(key for key in SIZES if key in found.group.variables)
            sizes.append(float(found.group.variables[size].values[0]))
        largest.append(np.abs(np.diff(np.log(sizes))).max())
    assert len(leading) == 2
    assert largest[1] < 0.65 * largest[0] < 0.65 * 0.15


def test_the_formula_of_fema_356_is_the_mean_of_the_modes() -> None:
    """Linear dashpots on rigid braces store nothing, so that the modes told are those without dampers, all three."""
    found = made(METHODS["viscous"], floor(0.79, 8.0)).group
    share, damping = (found.variables[f"plan_{name}"].values for name in ("share", "damping"))
    assert share.max() < 0.8
    assert float(found.attributes["damping_fema356"]) == pytest.approx(float(share @ damping), rel=1e-9)


def test_towers_share_the_direction_by_their_masses() -> None:
    """Each tower has a mode of its own along x. Guided, both move as one: v' M phi = sqrt(m / M)."""
    text = f"""\
edesign_building: 1
title: Two towers of one storey
plan: {{x: [4 m, 6 m, 4 m], y: [5 m]}}
storeys: [3.5 m]
setbacks: [{{floors: all, bays: [{{x: 1, y: all}}, {{x: 3, y: all}}]}}]
columns:
  - {{section: HEB200, material: S275, strong: x}}
  - {{at: [C, D], section: HEB300, material: S275, strong: x}}
beams: [{{along: x, section: IPE300, material: S275, ends: pinned}}]
missing: {{beams: [{{along: x}}, {{along: y}}]}}
materials: {{S275: {{E: 210 GPa, fy: 275 MPa, nu: 0.3, law: elastic}}}}
loads: {{self_weight: false}}
masses:
  given: [{{at: [A, B], floors: 1, mass: 8 t}}, {{at: [C, D], floors: 1, mass: 5 t}}]
{COMMON}"""
    file = parse_building(text, "building.yaml", BuildingSections())
    where = "kind: storey, along: x, frames: all, bays: [1, 3], state: initial"
    found = run_design(file, "tried", design(f"{METHODS['viscous']}, {where}", file), Path(".")).group
    share, ratio = (found.variables[f"plan_{name}"].values for name in ("share", "mass_ratio_x"))
    assert share.max() == pytest.approx(32.0 / 52.0, rel=1e-9)
    assert ratio[share.argmax()] == pytest.approx(32.0 / 52.0, rel=1e-9)


L_PLAN = """\
edesign_building: 1
title: An L with a heavy corner
plan: {x: [6 m, 7.8 m, 4.6 m], y: [6.8 m, 4.9 m]}
storeys: [3.6 m, 4.2 m, 3.6 m]
setbacks: [{floors: all, bays: [{x: 1, y: all}, {x: 2-3, y: 1}]}]
columns:
  - {section: HEB260, material: S275, strong: x}
  - {at: A1, section: HEB260, material: S275, strong: y}
beams:
  - {along: x, section: IPE330, material: S275}
  - {along: y, section: IPE300, material: S275}
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {areas: [{G: 4.3 kN/m^2, spans: x}]}
masses: {from_loads: {}, added: [{at: A1, floors: all, mass: 23.8 t}]}
"""


def test_elastomer_whose_frequency_goes_to_and_fro_between_modes_is_found() -> None:
    """The mean frequency leaps by 10 % between 0.88 and 0.97 Hz where it is put in again as it comes out."""
    file = parse_building(L_PLAN + COMMON, "building.yaml", BuildingSections())
    spec = f"{METHODS['elastomer']}, kind: storey, along: y, frames: [A, B], bays: 1, state: initial"
    found = run_design(file, "tried", design(spec, file), Path("."))
    assert found.status == "completed", found.reason
    mean = found.group.variables["plan_share"].values @ (1.0 / found.group.variables["plan_period"].values)
    assert found.group.variables["iteration_frequency"].values[-1] == pytest.approx(mean, rel=1e-3)
