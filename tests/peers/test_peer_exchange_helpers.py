"""Elements of OpenSees scripts that only help to express the structure: histories beside edesign's own.

Rigid ends, levers, apexes of chevrons and springs in series have no damping, mass or load of their own. With damping on
the initial stiffness, those that turn with corotational columns show any share that they take.
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import numpy as np
import pytest
from opensees_scripts import run, table, written

from edesign import load_project
from edesign.study.plan.plan import make_plan
from edesign.study.run.analyses import run_analysis

if importlib.util.find_spec("openseespy") is None:
    pytest.skip("OpenSeesPy (extra 'peers') is not installed", allow_module_level=True)

pytestmark = pytest.mark.peer

MOTION = Path(__file__).parent.parent / "cases" / "records" / "motion.csv"
HEIGHTS = (4.0, 3.5)  # m
FRAME = """edesign: 1
title: Two storeys that sway far
frame:
  bays: [7 m]
  storeys: [4 m, 3.5 m]
  supports: {supports}
  diaphragms: {diaphragms}
  columns: [{{storeys: all, section: HEB200, material: steel}}]
  beams: [{{floors: all, section: IPE330, material: steel}}]
materials: {{steel: {{law: elastic, E: 210 GPa}}}}
loads: {{beams: [{{floors: all, G: 18 kN/m}}]}}
masses: {{from_loads: {{}}, directions: horizontal}}
elements: {{geometry: {{columns: corotational, beams: linear}}, rigid_ends: {{columns: {arms}}}}}
dampers: {{laws: {{pad: {{type: kelvin_voigt, parameters: {{k: 2 kN/mm, c: 100 kN*s/m}}}}}}{dampers}}}
damping: {{kind: {damping}, ratio: 3 %, stiffness: initial}}
integration: {{method: newmark, time_step: 0.0025 s}}
records: {{motion: {{file: {motion}, acceleration_unit: m/s^2}}}}
analyses: [{{name: shake, kind: history, record: motion, scale: 3}}]
outputs: {{histories: [floors, storeys]}}
"""
PLAIN = {"supports": "fixed", "diaphragms": "none", "arms": "0", "dampers": "", "damping": "stiffness_proportional"}
SAME = 1e-6
"""Numbers of the archive are rounded to 6e-8 of theirs, and Newton's methods end at increments of 1e-8 m."""
SERIES = 1e-4
"""edesign follows a spring in series exactly within a step, OpenSees to second order: (omega dt)^2 / 12, which is 4e-5
in the first mode (0.71 s) and 5e-4 in the second, whose share is some per cent."""
TURNED = None
"""Rigid ends: the square of the drift by which they turn. edesign damps on the stiffness as they stand at first, in
OpenSees the part that they move is damped as they have turned it."""


def _devices(kind: str, more: str = "") -> str:
    return f", devices: [{{kind: {kind}, bays: 1, storeys: all, law: pad{more}}}]"


SERIES_SPRING = ", brace: {stiffness: 20 kN/mm}"
TUNED = ", attachments: [{kind: tuned_mass, floor: 2, mass: 2 t, frequency: 0.8 Hz, damping: 8 %}]"
SPRINGS = "{default: {horizontal: 40 kN/mm, vertical: 200 kN/mm, rotation: 30 MN*m/rad}}"
CASES: dict[str, tuple[float | None, dict[str, str]]] = {
    "rigid_ends": (TURNED, {"arms": "50 %"}),
    "rigid_ends_rayleigh": (TURNED, {"arms": "50 %", "damping": "rayleigh, modes: [1, 2]"}),
    "rigid_ends_and_tuned_mass": (TURNED, {"arms": "50 %", "diaphragms": "all", "dampers": TUNED}),
    "springs_at_supports": (SAME, {"supports": SPRINGS}),
    "levers": (SAME, {"dampers": _devices("storey")}),
    "levers_and_apexes": (SERIES, {"dampers": _devices("chevron", SERIES_SPRING)}),
    "copies_along_diagonals": (SAME, {"dampers": _devices("rising")}),
    "springs_in_series": (SERIES, {"dampers": _devices("rising", SERIES_SPRING)}),
    "tuned_mass": (SAME, {"diaphragms": "all", "dampers": TUNED}),
}


@pytest.mark.parametrize("name", CASES)
def test_helpers_take_no_part(tmp_path: Path, name: str) -> None:
    """In every step from the first to the last."""
    tolerance, changes = CASES[name]
    file = tmp_path / "project.yaml"
    file.write_text(FRAME.format(**PLAIN | changes, motion=MOTION), encoding="utf-8")
    project = load_project(file)
    assert written(project, tmp_path / "model.py") == ()
    run(tmp_path / "model.py")
    theirs = table(tmp_path / "model_results" / "shake.csv")
    group = run_analysis(project, next(iter(make_plan(project))).spec)
    ours = np.column_stack([group.variables[key].values for key in ("base_shear", "floor_displacement")])
    drift = np.abs(np.diff(ours[:, 1:], axis=1, prepend=0.0) / HEIGHTS).max()
    assert drift > 0.01  # far enough for what turns to matter
    allowed = drift**2 if tolerance is None else tolerance
    assert (np.abs(ours - theirs).max(axis=0) < allowed * np.abs(ours).max(axis=0)).all()
