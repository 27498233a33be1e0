"""Buckling-restrained braces as members of the frame: on footings, under wave passage, and from the beginning.

Before they yield, elastic struts of the same stiffness in their places are the same frame. A frame that stands by its
braces alone has a critical load and periods in closed form.
"""

from __future__ import annotations

import re
from math import hypot, pi, sqrt
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import HERE

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import Project, parse_project
from edesign.report.response.damper_results import dampers_table
from edesign.study.check.check import check_inputs
from edesign.study.run.analyses import run_analysis

AREA, KF, L_WP = 2400.0, 1.35, 6.5  # mm2, -, m
LAW = f"""\
    brb:
      type: buckling_restrained
      parameters: {{A_sc: {AREA} mm^2, F_ysc: 26200 MPa, E: 200 GPa, L_wp: {L_WP} m, L_y: 4.4 m, KF: {KF}, alpha: 0.4 %,
        strain: 40 %, omega: 1.46, beta: 1.12}}
"""
TEXT = f"""\
edesign: 1
title: Elastic braces
frame:
  bays: [6 m, 6 m]
  storeys: [4 m, 3.5 m]
  supports:
    default: {{footing: {{soil: clay, length: 2.4 m, width: 2 m, embedment: 1.2 m, thickness: 0.8 m}}}}
  diaphragms: all
  columns: [{{storeys: all, section: HEB300, material: S}}]
  beams: [{{floors: all, section: IPE400, material: S}}]
  releases: [{{beams: {{floors: all}}, ends: both}}]
  STRUTS
soils:
  clay: {{density: 1900 kg/m^3, shear_wave_velocity: 120 m/s, poisson: 0.45, damping: 8 %}}
sections: {{strut: {{area: {KF * AREA} mm^2}}}}
materials: {{S: {{law: elastic, E: 200 GPa}}}}
loads: {{beams: [{{floors: all, G: LOAD}}]}}
masses: {{given: [{{floors: all, mass: 30 t}}]}}
damping: {{kind: modal, ratio: 3 %, modes: 4}}
integration: {{method: newmark, time_step: 0.005 s, tolerance: 1e-10}}
records: {{motion: {{file: {HERE}/records/motion.csv, acceleration_unit: m/s^2}}}}
analyses:
  - {{name: gravity, kind: gravity}}
  - {{name: modes, kind: modal, modes: 3, state: initial}}
  - {{name: push, kind: pushover, pattern: first_mode, roof_drift: 1 %, steps: 4}}
  - {{name: shake, kind: history, record: motion}}
  - {{name: wave, kind: history, record: motion, wave_passage: {{velocity: 300 m/s}}}}
"""
STRUTS = "braces: [{kind: chevron, bays: 1, storeys: all, section: strut, material: S}]"
BRACES = f"dampers:\n  laws:\n{LAW}  devices: [{{kind: chevron_braces, bays: 1, storeys: all, law: brb}}]\n"
CARRY = ("law: brb}", "law: brb, carries_gravity: true}")
PINS = ("  releases: [", "  releases: [{columns: {storeys: all}, ends: both}, ")  # what stands by its braces alone


def project(text: str, *changes: tuple[str, str]) -> Project:
    for old, new in changes:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    return parse_project(text, Path(HERE) / "braces.yaml", BuildingSections())


def frame(struts: bool, *changes: tuple[str, str], load: str = "0 kN/m") -> Project:
    text = TEXT.replace("LOAD", load).replace("STRUTS", STRUTS if struts else "")
    return project(text if struts else text + BRACES, *changes)


def run(of: Project, name: str) -> Group:
    group = run_analysis(of, next(spec for spec in of.analyses if spec.name == name))
    assert group.attributes["status"] == "completed"
    return group


def same(found: Group, expected: Group, within: float, *prefixes: str) -> None:
    """Compare all variables whose names begin so, within a share of the largest value of each beginning."""
    for prefix in prefixes:
        names = [n for n, v in expected.variables.items() if n.startswith(prefix) and v.values.dtype.kind == "f"]
        assert names, prefix
        largest = max(float(np.max(np.abs(expected.variables[name].values))) for name in names)
        for name in names:
            values = expected.variables[name].values
            assert found.variables[name].values == pytest.approx(values, rel=1e-9, abs=within * largest), name


def test_footings_are_taken_at_the_period_of_the_braced_frame() -> None:
    """Stiffness and dashpots of footings, the first mode and its damping by the soil."""
    found, expected = run(frame(struts=False), "modes"), run(frame(struts=True), "modes")
    assert found.variables["footing_period"].values == pytest.approx(found.variables["period"].values[0], rel=1e-9)
    same(found, expected, 1e-9, "period", "footing_stiff", "footing_radiation", "footing_dashpot")
    for name in ("fixed_base_period_s", "foundation_damping", "closed_period_ratio", "closed_foundation_damping"):
        assert found.attributes[name] == pytest.approx(expected.attributes[name], rel=1e-8), name


RESPONSE = ("floor_displacement", "floor_acceleration", "base_shear", "column_axial", "storey_drift", "footing_work")


@pytest.mark.parametrize("name", ["shake", "wave"])
def test_histories(name: str) -> None:
    """Damping acts on what moves beyond the frame that follows its column bases slowly, with its braces. Equilibrium
    within 1e-10 leaves 1e-6 of the largest response."""
    found = run(frame(struts=False), name)
    same(found, run(frame(struts=True), name), 1e-6, *RESPONSE)
    # what the dashpots of footings do is not counted as work of the braces
    energy = dict(zip(found.coords["energy_term"].values, found.variables["energy_final"].values, strict=True))
    braces, ground = (float(np.sum(found.variables[f"{of}_work_final"].values)) for of in ("damper", "footing"))
    assert energy["dampers"] == pytest.approx(braces + ground, rel=1e-9) and ground > 0.0
    row = dampers_table({name: found}).texts[0]
    assert float(row[-1]) == pytest.approx(100.0 * braces / energy["input"], rel=1e-3)


@pytest.mark.parametrize("name", ["gravity", "modes", "push", "shake"])
@pytest.mark.parametrize("pinned", [False, True])
def test_braces_that_act_from_the_beginning(name: str, pinned: bool) -> None:
    """Chevrons hold the middle of the beams, and the frame upright where its columns are hinged at both ends."""
    changes = [PINS] if pinned else []
    found = run(frame(False, CARRY, *changes, load="25 kN/m"), name)
    quantities = {
        "gravity": ("floor_displacement", "node_displacement", "column_axial", "support_reaction"),
        "modes": ("period", "footing_dashpot"),
        "push": ("floor_displacement", "base_shear", "column_axial", "storey_drift"),
        "shake": RESPONSE,
    }
    expected = run(frame(True, *changes, load="25 kN/m"), name)
    same(found, expected, 1e-6, *quantities[name])
    if name == "gravity":
        assert found.variables["damper_force_final"].values == pytest.approx(
            expected.variables["brace_axial_force_final"].values, rel=1e-6
        )


def test_without_their_braces_such_frames_are_refused() -> None:
    with pytest.raises(InputError, match=r"`carries_gravity: true`.*mechanism.*E-CORE-06"):
        check_inputs(frame(False, PINS), [])


H, W = 4.0, 6.0
BENT = f"""\
edesign: 1
title: A bent that stands by its brace
frame:
  bays: [{W} m]
  storeys: [{H} m]
  supports: pinned
  columns: [{{storeys: 1, section: stiff, material: S}}]
  beams: [{{floors: 1, section: stiff, material: S}}]
  releases: [{{beams: {{floors: 1}}, ends: both}}]
sections: {{stiff: {{area: 1 m^2, inertia: 1 m^4}}}}
materials: {{S: {{law: elastic, E: 200000 GPa}}}}
loads: {{nodes: [{{lines: all, floors: 1, G: LOAD}}]}}
masses: {{given: [{{lines: A, floors: 1, mass: 50 t}}], directions: horizontal}}
dampers:
  laws:
{LAW}\
  devices: [{{kind: rising, bays: 1, storeys: 1, law: brb, carries_gravity: true}}]
analyses:
  - {{name: modes, kind: modal, modes: 1}}
  - {{name: push, kind: pushover, pattern: uniform, roof_drift: 0.001 %, steps: 4}}
"""
LENGTH = hypot(W, H)
K = KF * 200e9 * AREA * 1e-6 / LENGTH * (W / LENGTH) ** 2  # K cos^2 of the brace, against sway
CRITICAL = K * H  # of both columns together: K - N / h = 0


@pytest.mark.parametrize("share", [0.0, 0.5, 0.95])
def test_a_bent_sways_against_its_brace_less_its_loads(share: float) -> None:
    """K - N / h. Columns a thousand times as stiff as steel leave 1e-5."""
    of = project(BENT.replace("LOAD", f"{0.5e-3 * share * CRITICAL} kN"))
    left = K - share * CRITICAL / H
    period = run(of, "modes").variables["period"].values[0]
    assert period == pytest.approx(2.0 * pi * sqrt(50e3 / left), rel=1e-4)
    push = run(of, "push")
    V, u = (np.ravel(push.variables[name].values) for name in ("base_shear", "floor_displacement"))
    assert (V[-1] - V[0]) / (u[-1] - u[0]) == pytest.approx(left, rel=1e-3)


def test_beyond_its_critical_load_the_bent_is_unstable() -> None:
    of = project(BENT.replace("LOAD", f"{0.5e-3 * 1.01 * CRITICAL} kN"))
    group = run_analysis(of, of.analyses[1])
    assert group.attributes["status"] == "failed"
    reached = re.search(r"under the gravity loads: .* load factor ([0-9.]+)", str(group.attributes["reason"]))
    assert reached and float(reached[1]) == pytest.approx(1.0 / 1.01, rel=5e-3)


def test_other_dampers_carry_nothing_of_gravity() -> None:
    law = "    brb:\n      type: viscous\n      parameters: {c: 100 kN*s/m}\n"
    of = project(BENT.replace("LOAD", "1 kN").replace(LAW, law))
    with pytest.raises(InputError, match=r"devices\[0\]: carries_gravity: .*`brb` .*E-DEVICE-02"):
        check_inputs(of, [])
