"""Buckling-restrained braces that do not yield, on footings and under passing waves: the frame with elastic struts of
the same stiffness in their places is the same frame."""

from __future__ import annotations

from pathlib import Path

import pytest
from cases.conftest import HERE

from edesign.building.building_sections import BuildingSections
from edesign.project import Project, parse_project
from edesign.study.modal import run_modal

AREA, KF = 2400.0, 1.35
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
  STRUTS
soils:
  clay: {{density: 1900 kg/m^3, shear_wave_velocity: 120 m/s, poisson: 0.45, damping: 8 %}}
sections: {{strut: {{area: {KF * AREA} mm^2}}}}
materials: {{S: {{law: elastic, E: 200 GPa}}}}
masses: {{given: [{{floors: all, mass: 30 t}}]}}
elements: {{geometry: {{columns: linear}}}}
DAMPERS
damping: {{kind: modal, ratio: 3 %, modes: 4}}
integration: {{method: newmark, time_step: 0.005 s, tolerance: 1e-10}}
records: {{motion: {{file: {HERE}/records/motion.csv, acceleration_unit: m/s^2}}}}
analyses:
  - {{name: modes, kind: modal, modes: 3, state: initial}}
  - {{name: shake, kind: history, record: motion}}
  - {{name: wave, kind: history, record: motion, wave_passage: {{velocity: 300 m/s}}}}
"""
STRUTS = "braces: [{kind: chevron, bays: 1, storeys: all, section: strut, material: S}]"
BRACES = f"""\
dampers:
  laws:
    brb:
      type: buckling_restrained
      parameters: {{A_sc: {AREA} mm^2, F_ysc: 26200 MPa, E: 200 GPa, L_wp: 6.5 m, L_y: 4.4 m, KF: {KF}, alpha: 0.4 %,
        strain: 40 %, omega: 1.46, beta: 1.12}}
  devices: [{{kind: chevron_braces, bays: 1, storeys: all, law: brb}}]
"""


def project(struts: bool, supports: str | None = None) -> Project:
    text = TEXT.replace("STRUTS", STRUTS if struts else "").replace("DAMPERS\n", "" if struts else BRACES)
    return parse_project(text, Path(HERE) / "braces.yaml", BuildingSections())


def test_footings_are_taken_at_the_period_of_the_braced_frame() -> None:
    """Stiffness and dashpots of footings, the first mode and its damping by the soil do not know struts from braces."""
    braced = project(struts=False)
    found, expected = (run_modal(of, of.analyses[0]) for of in (braced, project(struts=True)))
    assert found.variables["footing_period"].values == pytest.approx(found.variables["period"].values[0], rel=1e-9)
    for name, variable in expected.variables.items():
        if name.startswith(("footing_", "period")) and variable.values.dtype.kind == "f":
            assert found.variables[name].values == pytest.approx(variable.values, rel=1e-9), name
    for name in ("fixed_base_period_s", "foundation_damping", "closed_period_ratio", "closed_foundation_damping"):
        assert found.attributes[name] == pytest.approx(expected.attributes[name], rel=1e-8), name
