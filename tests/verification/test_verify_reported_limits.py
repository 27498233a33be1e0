"""Limits of the model that change numbers are reported with their size: each is worked out by hand here.

Damping of C = a0 M + a1 K in an oscillator: a0 / (2 omega) + a1 omega / 2 (Chopra, Dynamics of Structures, 11.4.8), and
free vibration falls by exp(-2 pi zeta / sqrt(1 - zeta^2)) a cycle. Axial forces and moments: statics.
"""

from __future__ import annotations

from math import exp, pi, sqrt
from pathlib import Path

import numpy as np
import pytest

from edesign import check_project, load_project
from edesign.archive.dataset import Group
from edesign.project.project import Project
from edesign.study.plan.plan import make_plan
from edesign.study.results.warnings import AnalysisWarning, warnings_of
from edesign.study.run.analyses import run_analysis

G = 9.80665  # m/s2
FRAME = """edesign: 1
title: One storey
frame:
  bays: [6 m]
  storeys: [4 m]
  supports: fixed
  diaphragms: all
  columns: [{{storeys: all, section: {column}, material: steel}}]
  beams: [{{floors: all, section: IPE400, material: steel}}]
materials: {{steel: {{law: {law}}}}}
{more}
integration: {{method: newmark, time_step: 0.005 s}}
records: {{pulse: {{file: pulse.csv, acceleration_unit: m/s^2}}}}
analyses: [{analysis}]
outputs: {{histories: [floors, storeys]}}
"""
STEEL = "bilinear, E: 210 GPa, fy: 235 MPa, hardening: 1 %"
ELASTIC = "elastic, E: 210 GPa"
SHAKE = "{name: shake, kind: history, record: pulse, free_vibration: 12 s}"


def project(folder: Path, column: str, law: str, more: str, analysis: str) -> Project:
    time = np.arange(0.0, 1.005, 0.01)
    pulse = 2.0 * np.sin(pi * time) ** 2
    rows = "\n".join(f"{t:.3f},{a:.9g}" for t, a in zip(time, pulse, strict=True))
    (folder / "pulse.csv").write_text(f"time [s],a [m/s2]\n{rows}\n", encoding="utf-8")
    file = folder / "project.yaml"
    text = FRAME.format(column=column, law=law, more=more, analysis=analysis)
    file.write_text(text, encoding="utf-8")
    return load_project(file)


def result(of: Project) -> Group:
    return run_analysis(of, next(iter(make_plan(of))).spec)


def values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)


def reported(group: Group, kind: str) -> list[AnalysisWarning]:
    return [warning for warning in warnings_of(group) if warning.kind == kind]


@pytest.mark.parametrize("kind", ["rayleigh", "stiffness_proportional", "mass_proportional", "modal"])
def test_damping_that_the_frame_gives_its_tuned_mass(tmp_path: Path, kind: str) -> None:
    """`check` prints the damping with which the mass then vibrates on a frame that is stiff and heavy beside it."""
    damping = {
        "rayleigh": "{kind: rayleigh, ratio: 4 %, periods: [2 s, 0.1 s]}",
        "stiffness_proportional": "{kind: stiffness_proportional, ratio: 4 %, period: 0.5 s}",
        "mass_proportional": "{kind: mass_proportional, ratio: 4 %, period: 2 s}",
        "modal": "{kind: modal, ratio: 4 %, modes: 1}",
    }[kind]
    more = f"""masses: {{given: [{{floors: 1, mass: 2 t}}], directions: horizontal}}
dampers: {{attachments: [{{kind: tuned_mass, floor: 1, mass: 1 kg, frequency: 0.8 Hz, damping: 2 %}}]}}
damping: {damping}"""
    of = project(tmp_path, "HEB1000", ELASTIC, more, SHAKE)
    omega, first, second = 2.0 * pi * 0.8, pi, 20.0 * pi
    added = {
        "rayleigh": 0.04 / (first + second) * (first * second / omega + omega),
        "stiffness_proportional": 0.04 / (2.0 * pi / 0.5) * omega,
        "mass_proportional": 0.04 * first / omega,
        "modal": 0.0,
    }[kind]
    warnings = check_project(of).get("warnings", "")
    assert (
        f"T_1_1 has 2 % of critical damping, and `{kind}` damping of the frame adds {100 * added:.3g} %" in warnings
    ) == (kind != "modal")
    u = values(result(of), "tuned_mass_displacement")[300:, 0]  # the pulse is over, and the frame at rest
    peaks = np.array([u[i] for i in range(1, u.size - 1) if u[i] > u[i - 1] and u[i] >= u[i + 1]])
    zeta = 0.02 + added
    # a frame of 1/50 of the period moves by (1/50)^2 of the mass's displacement, and peaks are 1/250 of a cycle apart
    assert peaks[5] / peaks[0] == pytest.approx(exp(-2.0 * pi * 5 * zeta / sqrt(1.0 - zeta**2)), rel=5e-3)


@pytest.mark.parametrize(("load", "expected"), [(600.0, True), (300.0, False)])
def test_axial_force_of_columns_with_hinges(tmp_path: Path, load: float, expected: bool) -> None:
    """HEB200 has 78.08 cm2 (ArcelorMittal tables): A f_y = 1835 kN, a quarter is 459 kN."""
    more = f"""loads: {{nodes: [{{floors: 1, G: {load} kN}}]}}
masses: {{from_loads: {{}}, directions: horizontal}}
hinges:
  - columns: {{storeys: 1}}
    ends: start
    parameters: {{M_y: 140 kN*m, theta_p: 0.02 rad, theta_pc: 0.12 rad, theta_u: 0.2 rad}}"""
    push = "{name: push, kind: pushover, pattern: uniform, roof_drift: 0.2 %, steps: 4}"
    group = result(project(tmp_path, "HEB200", STEEL, more, push))
    found = reported(group, "hinge_axial")
    assert len(found) == expected
    if expected:
        most = np.abs(values(group, "column_axial_force_min")).max()
        assert 600e3 < most < 640e3  # with its share of overturning
        assert f"2 columns with hinges have axial forces above 0.25 A f_y, most C_B_1 with {most / 1834.9e3:.2g};" in (
            found[0].text
        )


def test_moments_of_isolators_that_move(tmp_path: Path) -> None:
    """Half of weight times displacement above rubber, beside storey shear times height."""
    more = """loads: {beams: [{floors: 1, G: 60 kN/m}]}
masses: {from_loads: {}, directions: horizontal}
dampers:
  laws: {rubber: {type: kelvin_voigt, parameters: {k: 300 kN/m, c: 40 kN*s/m}}}
  isolation:
    isolators: [{lines: all, law: rubber, vertical: {stiffness: 1500 kN/mm}}]
    base: {G: 30 kN/m, beams: {section: IPE600, material: steel}}
    design_displacement: 200 mm
damping: {kind: stiffness_proportional, ratio: 2 %, period: 0.3 s}"""
    group = result(project(tmp_path, "HEB300", ELASTIC, more, SHAKE))
    (found,) = reported(group, "isolator_height")
    weight = (60e3 + 30e3) * 6.0
    moved = max(float(values(group, "base_displacement_max")), -float(values(group, "base_displacement_min")))
    shear = max(float(values(group, "storey_shear_max")[0]), -float(values(group, "storey_shear_min")[0]))
    assert 0.5 * weight * moved > 0.1 * shear * 4.0
    lacking, overturning = 0.5 * weight * moved / 1e3, shear * 4.0 / 1e3
    assert f"of {1e3 * moved:.3g} mm, up to {lacking:.4g} kNm beside {overturning:.4g} kNm of" in found.text
