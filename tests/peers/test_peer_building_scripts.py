"""Scripts of buildings that `edesign translate` writes, run by OpenSeesPy, beside edesign's own analyses."""

from __future__ import annotations

import importlib.util
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from building_examples import changed
from opensees_scripts import check_languages, columns, off, run, table, written

from edesign.archive.dataset import Group
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import Building, parse_building
from edesign.study.plan.plan import make_plan
from edesign.study.run.analyses import run_analysis

if importlib.util.find_spec("openseespy") is None:
    pytest.skip("OpenSeesPy (extra 'peers') is not installed", allow_module_level=True)

pytestmark = pytest.mark.peer

HALL = """\
edesign_building: 1
title: Two storeys, eccentric masses, columns turned, hinges
plan: {x: [6 m, 4.5 m], y: [5 m, 4 m]}
storeys: [4 m, 3.2 m]
setbacks: [{floors: 2, bays: {x: 1, y: all}}]
supports: {default: fixed, C3: pinned}
columns:
  - {section: HEB220, material: S275, strong: x}
  - {at: [A2, B1, B3, C2], section: RHS250x150x10, material: S275, strong: y}
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE270, material: S275}
  - {along: y, frames: C, section: IPE270, material: S275, ends: pinned}
  - {along: x, frames: 3, bays: 2, section: IPE300, material: S275, ends: {start: rigid, end: pinned}}
braces: [{along: y, frames: A, bays: 1, storeys: 1, kind: cross, section: CHS76.1x4, material: S275}]
materials: {S275: {E: 210 GPa, fy: 275 MPa, hardening: 0.01}}
loads: {areas: [{floors: all, G: 5 kN/m^2, spans: x, secondary_beams: 2}]}
masses:
  directions: both
  given:
    - {floors: 1, at: [A, B, C1], mass: 8 t}
    - {floors: 1, at: [C2, C3], mass: 20 t}
    - {floors: 2, at: [A1, A2, B1, B2], mass: 8 t}
    - {floors: 2, at: [A3, B3], mass: 16 t}
elements: {integration_points: 4}
damping: {kind: rayleigh, ratio: 2 %, modes: [1, 3], stiffness: initial}
integration: {method: newmark, time_step: 0.01 s, tolerance: 1e-9}
records:
  both:
    pair: [{file: x.csv, acceleration_unit: m/s^2}, {file: y.csv, acceleration_unit: m/s^2}]
    vertical: {file: z.csv, acceleration_unit: m/s^2}
outputs: {histories: [floors, storeys]}
analyses:
  - {name: unloaded, kind: modal, modes: 4, state: initial}
  - {name: modes, kind: modal, modes: 6}
  - {name: gravity, kind: gravity}
  - {name: push, kind: pushover, pattern: first_mode, direction: y, eccentricity: +x, roof_drift: 1 %, steps: 40}
  - {name: shake, kind: history, record: both, angles: 30 deg, eccentricity: [0, +x-y]}
"""
WITHOUT_WEIGHT = ("loads: {", "loads: {self_weight: false, ")
ELASTIC = ("hardening: 0.01", "law: elastic")
LOOSE = ("loads: {", "diaphragms: 1\nloads: {")
CUT = (
    ("y: [5 m, 4 m]", "y: [5 m, 3 m, 4 m]"),
    (
        "loads: {",
        "partial_diaphragms: [{floors: 1, bays: {x: all, y: 1}}, {floors: 1, bays: {x: all, y: 3}}]\nloads: {",
    ),
)
MODAL = ("{kind: rayleigh, ratio: 2 %, modes: [1, 3], stiffness: initial}", "{kind: modal, ratio: 3 %, modes: 4}")
CURVED = ("hardening: 0.01", "law: menegotto_pinto, hardening: 0.01")
FAR = ("points: 4}", "points: 4, geometry: {columns: corotational, braces: p_delta}}")
DIVIDED = ("points: 4}", "points: 5}")
RIGID_ENDS = ("points: 4}", "points: 4, rigid_ends: {columns: 0.15 m, beams: 1}}")
BY_MASS = ("rayleigh, ratio: 2 %, modes: [1, 3], stiffness: initial", "mass_proportional, ratio: 2 %")

GROUND = (
    "supports: {default: fixed, C3: pinned}",
    "soils: {sand: {density: 1900 kg/m^3, shear_wave_velocity: 150 m/s, poisson: 0.3, damping: 5 %}}\n"
    "supports:\n"
    "  default: {footing: {soil: sand, length: 2 m, width: 1.4 m, embedment: 0.5 m, thickness: 0.5 m}}\n"
    "  A: {footing: {soil: sand, length: 1.5 m, width: 1.8 m, thickness: 0.5 m, uplift: true}}\n"
    "  C3: {uz: 200 MN/m, rx: 20 MN*m/rad, ry: 10 MN*m/rad}",
)


FIRM = """\
dampers:
  laws:
    pad: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 100 kN*s/m}}
    oil: {type: viscous, parameters: {c: 400 kN*s/m}}
  devices:
    - {kind: rising, along: y, frames: C, bays: 2, storeys: 1, law: pad}
    - {kind: chevron_braces, along: x, frames: 2, bays: 1, storeys: all, law: oil}
    - {kind: chevron, along: x, frames: 1, bays: 1, storeys: all, law: pad}
    - {kind: storey, along: y, frames: B, bays: 1, storeys: all, law: oil}
    - {kind: nodes, nodes: [A1.0, B2.1], law: pad}
  attachments:
    - {kind: tuned_mass, floor: 1, mass: 4 t, frequency: 1 Hz, damping: 8 %, direction: y}
"""
SERIES = ("law: pad}\n    - {kind: storey", "law: oil, brace: {stiffness: 20 kN/mm}}\n    - {kind: storey")
DAMPERS = ("outputs:", FIRM + "outputs:")


OWN = (
    ("section: RHS250x150x10", "section: COL"),
    (
        "{along: x, section: IPE300, material: S275}",
        "{along: x, section: IPE300, material: S275, stiffness_factor: 1.8}",
    ),
    ("{along: y, section: IPE270, material: S275}", "{along: y, section: EDGE, material: S275}"),
    (
        "secondary_beams: 2}]",
        "secondary_beams: 2}], beams: [{along: x, bays: 2, partial: [{start: 1 m, end: 3 m, G: 8 kN/m}]}]",
    ),
    (
        "materials:",
        "sections:\n"
        "  COL: {height: 240 mm, width: 200 mm, flange: 15 mm, web: 10 mm}\n"
        "  EDGE: {area: 45 cm^2, inertia: 6000 cm^4, weak_inertia: 420 cm^4, torsion_constant: 16 cm^4}\n"
        "materials:",
    ),
)


BEARINGS = """\
dampers:
  laws:
    lead: {type: lead_rubber, parameters: {Q: 6 kN, K_d: 120 kN/m, Y: 8 mm}}
    rubber: {type: bouc_wen, parameters: {Fy: 12 kN, Y: 12 mm, alpha: 0.15, A: 1.2, beta: 0.4, gamma: 0.8, n: 1.6}}
    pad: {type: kelvin_voigt, parameters: {k: 200 kN/m, c: 10 kN*s/m}}
    slider: {type: friction, parameters: {mu: 4 %, N: 150 kN, k: 10 kN/mm}}
    even: {type: friction_pendulum, parameters: {W: 100 kN, R: 1.5 m, f_slow: 4 %, f_fast: 4 %, a: 30 s/m, Y: 1 mm}}
    oil: {type: viscous, parameters: {c: 10 kN*s/m}}
  isolation:
    isolators:
      - {at: [A1, C1, C2], law: lead}
      - {at: [A2, A3], law: rubber, vertical: 500 kN/mm}
      - {at: [B1, B3], law: pad, vertical: {stiffness: 400 kN/mm, uplift: true}}
      - {at: B2, law: slider}
      - {at: C3, law: even}
    beside: [{at: [A1, C3], direction: y, law: oil}]
    base: {G: 5 kN/m^2, mass: 40 t, beams: {section: HEB300, material: S275}}
    design_displacement: 100 mm
"""
DISH = (
    "{type: friction, parameters: {mu: 4 %, N: 150 kN, k: 10 kN/mm}}",
    "{type: friction_pendulum, parameters: {W: 100 kN, R: 1.5 m, f_slow: 3 %, f_fast: 6 %, a: 20 s/m, Y: 1 mm}}",
)
WEIGHED = ("B2, law: slider}", "B2, law: slider, weight: varying, vertical: {stiffness: 900 kN/mm, uplift: true}}")
PADS = (
    ("C2], law: lead", "C2], law: pad"),
    ("A3], law: rubber", "A3], law: pad"),
    ("B2, law: slider", "B2, law: pad"),
    ("C3, law: even", "C3, law: pad"),
)
BY_PERIODS = ("modes: [1, 3]", "periods: [2 s, 0.3 s]")
FINE = ("time_step: 0.01 s", "time_step: 0.002 s")
ISOLATED = (("outputs:", BEARINGS + "outputs:"), ("roof_drift: 1 %,", "roof_drift: 1 %, dampers: false,"))


@dataclass(frozen=True)
class Case:
    """Changes of the file, and how near the results are.

    Attributes:
        changes: of its text.
        history: largest difference over the largest value of a floor and of the base shear.
        period, static: of modes and gravity.
        lacks: analyses that are left out.
        drift: of the history at least.
    """

    changes: tuple[tuple[str, str], ...] = ()
    history: float = 1e-5
    period: float = 1e-8
    static: float = 1e-6
    lacks: int = 0
    drift: float = 0.01  # far beyond yield


CASES = {
    # increments of 1e-8 m end the iteration, and gravity moves floors by some 1e-3 m
    "yielding": Case((WITHOUT_WEIGHT,), history=1e-6),
    # N of columns is that in the middle of each: some 5e-4 of the yield strain beside it
    "self_weight_of_columns": Case(history=1e-3),
    "divided_beams": Case((WITHOUT_WEIGHT, DIVIDED, BY_MASS), history=1e-6),
    "own_sections": Case((WITHOUT_WEIGHT, BY_MASS, *OWN), history=1e-6),
    # stiffness-proportional damping acts within divided beams too, once they yield
    "divided_beams_damped": Case((WITHOUT_WEIGHT, DIVIDED), history=2e-2),
    "elastic_without_a_rigid_floor": Case((ELASTIC, LOOSE)),
    "two_diaphragms_of_a_floor": Case((WITHOUT_WEIGHT, *CUT), history=1e-6),
    # arms are members some 1e5 times as stiff as theirs, beside which columns yield
    "rigid_ends": Case((WITHOUT_WEIGHT, RIGID_ENDS), history=1e-3, period=2e-5, static=1e-4),
    # stiff bars carry the apex of a chevron; a history whose masses stand beside the tuned mass is left out
    "dampers": Case((ELASTIC, DAMPERS), history=1e-5, period=1e-6, lacks=1),
    "springs_in_series": Case((ELASTIC, DAMPERS, SERIES), history=1e-3, period=1e-6, lacks=1),
    "springs_and_footings": Case((WITHOUT_WEIGHT, GROUND), history=1e-6),
    "modal_damping": Case((ELASTIC, MODAL)),
    # with damping by modes 3e-4 where masses are eccentric, as it is that of masses in their places
    "linear_isolators": Case(
        (WITHOUT_WEIGHT, ELASTIC, BY_PERIODS, *ISOLATED, *PADS), history=1e-6, drift=1e-3, lacks=2
    ),
    # bearings go from step to step along the chord: five times as far apart at steps of 10 ms
    "isolators": Case((WITHOUT_WEIGHT, ELASTIC, FINE, *ISOLATED), history=8e-3, drift=1e-3, lacks=2),
    # and the dish turns, by up to (u/R)^2
    "pendulum": Case((WITHOUT_WEIGHT, ELASTIC, *ISOLATED, DISH, WEIGHED), history=4e-2, drift=1e-3, lacks=2),
    # Steel02 forgets; corotational members of one piece differ by h^2 of their formulation, as in test_peer_buildings
    "curved_steel_and_large_turns": Case((CURVED, FAR), history=5e-2, period=5e-4, static=1e-3),
}


def hall(folder: Path, *changes: tuple[str, str]) -> Building:
    """The building in a folder, beside its record: 2 s in steps of 10 ms that begin and end with 0."""
    time = np.linspace(0.0, 2.0, 201)
    for axis, peak, period in (("x", 5.0, 0.8), ("y", 3.0, 0.5), ("z", 2.0, 0.3)):
        motion = peak * np.sin(2.0 * np.pi * time / period) * np.sin(np.pi * time / 2.0)
        table = np.column_stack([time, motion])
        np.savetxt(folder / f"{axis}.csv", table, delimiter=",", header="time [s],acceleration [m/s2]", comments="")
    return parse_building(changed(HALL, *changes), folder / "building.yaml", BuildingSections())


def check_gravity(group: Group, folder: Path, case: Case) -> None:
    values = {name: variable.values for name, variable in group.variables.items()}
    moved, theirs = values["node_displacement_final"], table(folder / "gravity.csv")
    assert off(moved[:, :3], theirs[:, :3]) < case.static
    assert off(moved[:, 3:], theirs[:, 3:]) < 10.0 * case.static  # of short lengths between nodes
    # moments over the largest force on one metre
    assert off(values["reaction_final"], table(folder / "gravity_reactions.csv")) < case.static


def check_steps(group: Group, path: Path, error: float) -> None:
    """Base shear and floors in every step, over the largest of each kind."""
    values = {name: variable.values for name, variable in group.variables.items()}
    names, found = columns(path), table(path)
    kinds = {"base_shear": "base shear", "floor_displacement": "[m]", "floor_rotation": "[rad]"}
    kinds |= {"diaphragm_displacement": "[m]", "diaphragm_rotation": "[rad]"}
    for name, mark in kinds.items():
        if name in values:
            there = [mark in column and "control" not in column for column in names]
            apart = [re.search(r"floor \d+\.\d", column) is not None for column in names]
            theirs = found[:, np.array(there) & (np.array(apart) == name.startswith("diaphragm"))]
            ours = values[name].reshape(len(found), -1)
            assert off(ours[:, ours.any(axis=0)], theirs) < error, name  # floors that are not rigid have no turn


SLOW = ("isolators", "divided_beams", "divided_beams_damped", "curved_steel_and_large_turns")


@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.slow) if n in SLOW else n for n in CASES])
def test_script_of_a_building(tmp_path: Path, name: str) -> None:
    case = CASES[name]
    whole = hall(tmp_path, *case.changes)
    left_out = written(whole, tmp_path / "model.py")
    assert len(left_out) == case.lacks
    run(tmp_path / "model.py")
    folder = tmp_path / "model_results"
    for task in make_plan(whole):
        if any(task.name in sentence for sentence in left_out):
            continue
        group = run_analysis(whole, task.spec)
        assert group.attributes["status"] == "completed"
        file = folder / f"{task.name}.csv"
        if task.spec.kind == "modal":
            assert group.variables["period"].values == pytest.approx(table(file)[:, 0], rel=case.period), task.name
        elif task.spec.kind == "gravity":
            check_gravity(group, folder, case)
        else:
            check_steps(group, file, case.history)
            if task.spec.kind == "history":
                assert (group.variables["storey_drift_max"].values.max(axis=0) > case.drift).all()


TCL = {"fixed": (("steps: 40", "steps: 5"),), "isolated": (*ISOLATED, DISH, WEIGHED)}


@pytest.mark.parametrize("changes", TCL.values(), ids=TCL)
def test_tcl_of_a_building_does_what_python_does(tmp_path: Path, changes: tuple[tuple[str, str], ...]) -> None:
    check_languages(hall(tmp_path, ("time_step: 0.01 s", "time_step: 0.04 s"), *changes), tmp_path)
