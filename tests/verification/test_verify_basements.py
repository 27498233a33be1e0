"""Floors above the base that the ground holds, as of a basement.

References: the building cut off above the held floor, on springs in the place of the elastic columns below (4 E I / h,
E A / h); a table on two legs of springs by hand; Newton's second law.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_building_model import STEP, completed, displacement, motion, under_gravity
from verification.test_verify_building_supports import table
from verification.test_verify_shaken_buildings import stiffness

from edesign.core import Analysis, Channel, Response
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.steel_section import steel_section
from edesign.space.elastic_design import elastic_design
from edesign.space.nonlinear import build_building
from edesign.space.structure.frame import AXES

DEPTH = 3.2
CELLAR = """\
edesign_building: 1
title: A basement
plan: {x: [6 m, 5 m], y: [5 m, 4 m]}
storeys: [3.2 m, 4 m, 3.5 m]
restrained_floors: [{floors: 1}]
diaphragms: @rigid@
columns:
  - {section: HEB240, material: S275, strong: x}
  - {at: [B, A3], section: RHS250x150x10, material: S275, strong: y}
  - {storeys: 1, section: HEB260, material: firm, strong: x}
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE270, material: S275}
missing: {beams: [{along: x, floors: 1}, {along: y, floors: 1}]}
materials: {S275: {fy: 275 MPa}, firm: {fy: 275 MPa, law: elastic}}
loads: {areas: [{floors: 2-3, G: 6 kN/m^2, spans: x, secondary_beams: 1}], self_weight: false}
masses: {from_loads: {}}
"""


def cut_off(text: str, k_y: float, k_z: float) -> str:
    """The file of what stands above the basement, on springs of the columns below about their axes, N m."""
    springs = f"{{uz: {210e9 * steel_section('HEB260').A / DEPTH} N/m, rx: {k_z} N*m/rad, ry: {k_y} N*m/rad}}"
    above = text.replace("[3.2 m, 4 m", "[4 m").replace(
        "restrained_floors: [{floors: 1}]", f"supports: {{default: {springs}}}"
    )
    above = above.replace("floors: 2-3", "floors: all")
    above = above.replace("  - {storeys: 1, section: HEB260, material: firm, strong: x}\n", "")
    return above.replace("missing: {beams: [{along: x, floors: 1}, {along: y, floors: 1}]}\n", "")


def shaken(frame: FrameModel, floors: slice) -> Response:
    """A history of two components under gravity in which the upper storeys yield, with their floors and reactions."""
    channels = []
    for number, floor in enumerate(frame.floors[floors]):
        channels += [displacement(f"{axis} {number}", floor.movers[at][0]) for at, axis in enumerate("xy")]
        channels += [displacement(f"turn {number}", floor.turn)] if floor.turn else []
    for number, storey in enumerate(frame.storeys[floors]):
        channels += [Channel(f"shear {number} {axis}", storey.shear[at]) for at, axis in enumerate("xy")]
    for at, axis in enumerate("xy"):
        terms = [term for name, held in frame.supports.items() if held[at] for term in frame.reaction(name, at)]
        channels.append(Channel(f"reactions {axis}", tuple(terms)))
    analysis, _ = under_gravity(frame)
    analysis.rayleigh(0.3, 0.002, "initial")
    return completed(analysis.history(motion(1), STEP, channels=channels, along_y=motion(2)))


@pytest.mark.parametrize("rigid", ["all", "2-3"])
def test_a_building_cut_off_above_its_basement(rigid: str) -> None:
    """1e-9: the columns below are exact springs, as their heads are held and they stay elastic."""
    text = CELLAR.replace("@rigid@", rigid)
    below = steel_section("HEB260")
    k_y, k_z = (4.0 * 210e9 * inertia / DEPTH for inertia in (below.I_y, below.I_z))
    above = cut_off(text, k_y, k_z).replace(f"diaphragms: {rigid}", "diaphragms: all")
    whole, cut = build_building(building(text)), build_building(building(above))
    found, expected = shaken(whole, slice(1, None)), shaken(cut, slice(None))
    for name, values in expected.values.items():
        scale = max(expected.peak(other) for other in expected.values if other[:2] == name[:2])
        np.testing.assert_allclose(found.values[name], values, rtol=0, atol=1e-9 * scale, err_msg=name)
    assert expected.energy_final["hysteretic"] > 0.2 * expected.energy_final["input"]
    assert ("floor.1" in whole.supports) == (rigid == "all")


def test_a_floor_on_springs_of_the_ground() -> None:
    """A table whose floor is held by springs, in equal shares at its corners; 1e-9 but for rounding."""
    k_x, k_y, k_t = stiffness("HEB200")
    held = "restrained_floors: [{floors: 1, ux: 4 MN/m, uy: 6 MN/m, rz: 20 MN*m/rad}]\n"
    found = Analysis(build_building(table("fixed", held)).model).modes(3)
    k_x, k_y = k_x + 1e6, k_y + 1.5e6
    turning = 4.0 * (k_x * 2.5**2 + k_y * 3.0**2 + k_t) + 20e6
    of = [32e3 / (4.0 * k_x), 32e3 / (4.0 * k_y), 32e3 * (3.0**2 + 2.5**2) / turning]
    np.testing.assert_allclose(found.period, sorted(2.0 * np.pi * np.sqrt(of), reverse=True), rtol=1e-9)


def test_reactions_are_the_inertia_above() -> None:
    """Without damping all reactions are the masses above the held floor times their accelerations."""
    text = (
        CELLAR.replace("@rigid@", "all")
        .replace("floors: 2-3", "floors: all")
        .replace("missing: {beams: [{along: x, floors: 1}, {along: y, floors: 1}]}\n", "")
    )
    frame = build_building(building(text))
    names = [name for name in frame.masses if name != "floor.1"]
    channels = [
        Channel("inertia", tuple((frame.masses[n], "total_acceleration", frame.nodes[n], 0) for n in names)),
        Channel("reactions", tuple(t for n, h in frame.supports.items() if h[0] for t in frame.reaction(n, 0))),
    ]
    analysis, _ = under_gravity(frame)
    run = completed(analysis.history(motion(1), STEP, channels=channels))
    assert "floor.1" in frame.supports and frame.masses["floor.1"] > 0.0
    total = run.values["inertia"]
    np.testing.assert_allclose(run.values["reactions"], total, rtol=0, atol=1e-6 * np.abs(total).max())


DESIGN = """\
hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}
  torsion_by: @torsion@
"""


@pytest.mark.parametrize("torsion", ["static_moments", "shifted_masses"])
def test_a_design_above_a_rigid_basement(torsion: str) -> None:
    """Of the building cut off, whose columns below are springs (4 + f) E I / ((1 + f) h), f = 12 E I / (G A_v h^2).

    The held floor has a mass, which does not count (EN 1998-1, 4.3.3.2.2(1)P), and heights are above it
    (4.3.3.2.3(3)). 1e-9: the columns below are exact springs.
    """

    def held(inertia: float, shear_area: float) -> float:
        f = 12.0 * 2.6 * inertia / (shear_area * DEPTH**2)
        return (4.0 + f) / (1.0 + f) * 210e9 * inertia / DEPTH

    below = steel_section("HEB260")
    text = CELLAR.replace("@rigid@", "all") + DESIGN.replace("@torsion@", torsion)
    heavy = text.replace("self_weight: false}", "nodes: [{at: all, floors: 1, G: 300 kN}], self_weight: false}")
    above = cut_off(text, held(below.I_y, below.A_z), held(below.I_z, below.A_y))
    found, expected = (elastic_design(building(of)) for of in (heavy, above))
    assert found.frame.node_mass[found.frame.level_of_nodes == 1].sum() > expected.frame.node_mass.sum()
    np.testing.assert_allclose(found.modes.period, expected.modes.period, rtol=1e-9)
    np.testing.assert_allclose(found.modes.effective_mass_ratio.sum(axis=0)[:2], 1.0, rtol=1e-9)
    names = [member.name for member in found.frame.members]
    for axis in AXES:
        own, cut = found.response[axis], expected.response[axis]
        assert (own.base_shear, own.F_b) == pytest.approx((cut.base_shear, cut.F_b), rel=1e-9)
        np.testing.assert_allclose(own.storey_shear, [cut.base_shear, *cut.storey_shear], rtol=1e-9)
        np.testing.assert_allclose(own.drift, [0.0, *cut.drift], rtol=1e-9, atol=0)
        np.testing.assert_allclose(found.storeys[axis].theta, [0.0, *expected.storeys[axis].theta], rtol=1e-9, atol=0)
        largest = np.abs(cut.internal).max(axis=(0, 1))
        for number, member in enumerate(expected.frame.members):
            kind, _, last = member.name.rpartition("_")
            apart = own.internal[names.index(f"{kind}_{int(last) + 1}")] - cut.internal[number]
            assert (np.abs(apart).max(axis=0) <= 1e-9 * largest).all(), member.name
    for text in ("centre", "e_0 / r", "r / l_s", "fall of stiffness", "rise of stiffness"):
        each = [[of.value for of in one.criteria if text in of.text] for one in (found, expected)]
        assert each[0] == pytest.approx(each[1], rel=1e-6)  # e_0 is small beside the plan
    for clause in ("6.5.3(2)", "6.6.3(4)"):  # hinges at the column bases are above the basement
        each = [[of.value for of in one.criteria if of.clause == clause] for one in (found, expected)]
        assert each[0] == pytest.approx(each[1], rel=1e-9)
    np.testing.assert_allclose(found.foundations.factor, expected.foundations.factor, rtol=1e-9, atol=0)
    assert found.frame.acting_mass == pytest.approx(expected.frame.acting_mass, rel=1e-9)
    assert set(found.foundations.nodes) == {name for name in found.frame.node_names if name.endswith(".0")}
    assert found.sway.initial_sway.max() == pytest.approx(expected.sway.initial_sway.max(), rel=1e-9)
