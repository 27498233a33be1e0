"""Projects whose answers are known in closed form."""

from __future__ import annotations

from pathlib import Path

from shear_frames import MASS, shear_frame_text

from edesign.frame.sections.profiles import profile_names
from edesign.project import Project, parse_project

NODE_MASS = MASS / 2  # kg

ANALYSED = """\
loads:
  beams: [{floors: all, G: 10 kN/m, Q: 5 kN/m}]
  gravity: {G: 1.0, Q: 0.4}
damping: @damping@
integration: {method: newmark, time_step: 0.01 s, tolerance: 1e-10}
records:
  pulse: {file: pulse.csv, acceleration_unit: m/s^2, time_step: 0.02 s}
analyses:
@analyses@
outputs: @outputs@
"""
"""What analyses of a shear frame need, to follow its text."""

PULSE = [0.0, 1.0, -2.0, 3.0, 0.5, -1.0, 0.0]  # m/s2, every 0.02 s

PORTAL = """\
edesign: 1
title: Portal with a rigid beam
frame:
  bays: [1000 m]
  storeys: [4 m]
  diaphragms: all
  columns: [{storeys: all, section: bar, material: steel}]
  beams: [{floors: 1, section: rigid, material: elastic}]
sections:
  bar: {rectangles: [{width: 100 mm, depth: 200 mm, centre: 0 m}]}
  rigid: {area: 1 m^2, inertia: 1e6 m^4}
materials:
  steel: {law: bilinear, E: 210 GPa, fy: 250 MPa}
  elastic: {law: elastic, E: 210 GPa}
elements: {geometry: {columns: linear}}
masses:
  given: [{lines: all, floors: all, mass: 1 t}]
analyses:
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 10 %, steps: 100}
outputs:
  members: [C_A_1]
  sections: [{member: C_A_1, points: 1}]
  fibres: [{member: C_A_1, points: 1, layers: [1, 16]}]
"""

THESIS_4_BAYS = """\
edesign: 1
title: Ten-storey frame with four bays
frame:
  bays: {count: 4, width: 7.2 m}
  storeys: {count: 10, height: 3.5 m}
  columns:
    - {storeys: 1-4, section: HEB450, material: S275}
    - {storeys: 5-7, section: HEB360, material: S275}
    - {storeys: 8-10, section: HEB320, material: S275}
  beams:
    - {floors: 1-4, section: IPE450, material: S275}
    - {floors: 5-7, section: IPE400, material: S275}
    - {floors: 8-10, section: IPE360, material: S275}
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0}
loads:
  beams: [{floors: all, G: 23 kN/m, Q: 9.6 kN/m}]
masses:
  given:
    - {lines: B-D, floors: all, mass: 29.5 t}
    - {lines: [A, E], floors: all, mass: 19.35 t}
analyses:
  - {name: bare, kind: modal, modes: 2, state: initial}
  - {name: loaded, kind: modal, modes: 2}
"""


def shear_frame(
    *analyses: str, storeys: int = 1, damping: str = "{kind: none}", outputs: str = "{}", path: str = "project.yaml"
) -> Project:
    """A shear frame with the given analyses, each as it stands in the file."""
    text = (shear_frame_text(storeys) + ANALYSED).replace("@damping@", damping).replace("@outputs@", outputs)
    text = text.replace("@analyses@", "\n".join(f"  - {analysis}" for analysis in analyses))
    if "history" not in text:
        text = text.replace("records:\n  pulse: {file: pulse.csv, acceleration_unit: m/s^2, time_step: 0.02 s}\n", "")
    return parse_project(text, path, profile_names())


def project(text: str, path: Path | str = "project.yaml") -> Project:
    """A project of any text."""
    return parse_project(text, path, profile_names())
