"""Scripts of buildings that `edesign translate` writes, run by OpenSeesPy, beside edesign's own analyses."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from building_examples import changed
from opensees_scripts import check_languages, columns, off, run, table, written

from edesign.core import Channel
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import Building, parse_building
from edesign.study.analysis.history import integrator, load_and_damp
from edesign.study.analysis.structure import make_structure

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
records: {motion: {file: motion.csv, acceleration_unit: m/s^2}}
analyses:
  - {name: unloaded, kind: modal, modes: 4, state: initial}
  - {name: modes, kind: modal, modes: 6}
  - {name: gravity, kind: gravity}
  - {name: shake, kind: history, record: motion, scale: 2, vertical: {ratio: 0.7}}
"""
WITHOUT_WEIGHT = ("loads: {", "loads: {self_weight: false, ")
ELASTIC = ("hardening: 0.01", "law: elastic")
LOOSE = ("loads: {", "diaphragms: 1\nloads: {")
MODAL = ("{kind: rayleigh, ratio: 2 %, modes: [1, 3], stiffness: initial}", "{kind: modal, ratio: 3 %, modes: 4}")
CURVED = ("hardening: 0.01", "law: menegotto_pinto, hardening: 0.01")
FAR = ("points: 4}", "points: 4, geometry: {columns: corotational, braces: p_delta}}")
DIVIDED = ("points: 4}", "points: 5}")
BY_MASS = ("rayleigh, ratio: 2 %, modes: [1, 3], stiffness: initial", "mass_proportional, ratio: 2 %")


@dataclass(frozen=True)
class Case:
    """Changes of the file, and how near the results are.

    Attributes:
        changes: of its text.
        history: largest difference over the largest value of a floor and of the base shear.
        period, static: of modes and gravity.
    """

    changes: tuple[tuple[str, str], ...] = ()
    history: float = 1e-5
    period: float = 1e-8
    static: float = 1e-6


CASES = {
    # increments of 1e-8 m end the iteration, and gravity moves floors by some 1e-3 m
    "yielding": Case((WITHOUT_WEIGHT,), history=1e-6),
    # N of columns is that in the middle of each: some 5e-4 of the yield strain beside it
    "self_weight_of_columns": Case(history=1e-3),
    "divided_beams": Case((WITHOUT_WEIGHT, DIVIDED, BY_MASS), history=1e-6),
    # stiffness-proportional damping acts within divided beams too, once they yield
    "divided_beams_damped": Case((WITHOUT_WEIGHT, DIVIDED), history=2e-2),
    "elastic_without_a_rigid_floor": Case((ELASTIC, LOOSE)),
    "modal_damping": Case((ELASTIC, MODAL)),
    # Steel02 forgets; corotational members of one piece differ by h^2 of their formulation, as in test_peer_buildings
    "curved_steel_and_large_turns": Case((CURVED, FAR), history=5e-2, period=5e-4, static=1e-3),
}


def pulses() -> np.ndarray:
    """Times in steps of 10 ms, s, and accelerations of two waves of 0.8 s that begin and end with 0, (n, 2) m/s2."""
    time = np.linspace(0.0, 2.0, 201)
    return np.column_stack([time, 3.0 * np.sin(2.0 * np.pi * time / 0.8) * np.sin(np.pi * time / 2.0)])


def hall(folder: Path, *changes: tuple[str, str]) -> Building:
    """The building in a folder, with its record beside it."""
    np.savetxt(folder / "motion.csv", pulses(), delimiter=",", header="time [s],acceleration [m/s2]", comments="")
    return parse_building(changed(HALL, *changes), folder / "building.yaml", BuildingSections())


def channels(frame: FrameModel) -> list[Channel]:
    """Base shear and floors, by the names of the columns of a script."""
    found = []
    for direction in frame.directions:
        held = [name for name, fixed in frame.supports.items() if fixed[direction.degree]]
        terms = [term for name in held for term in frame.reaction(name, direction.degree)]
        found.append(Channel(f"base shear {direction.name} [N]", tuple((-factor, *rest) for factor, *rest in terms)))
    for floor in frame.floors:
        sums = {f"{way.name} [m]": movers[0] for way, movers in zip(frame.directions, floor.movers, strict=True)}
        for what, terms in (sums | ({"turn [rad]": floor.turn} if floor.turn else {})).items():
            moved = tuple((factor, "displacement", node, degree) for factor, node, degree in terms)
            found.append(Channel(f"floor {floor.number} {what}", moved))
    return found


def check_modes(whole: Building, case: Case, folder: Path) -> None:
    for name, loaded in (("unloaded", False), ("modes", True)):
        structure = make_structure(whole)
        if loaded:
            structure.apply_gravity()
        theirs = table(folder / f"{name}.csv")[:, 0]
        assert structure.modes(theirs.size).period == pytest.approx(theirs, rel=case.period), name


def check_gravity(whole: Building, case: Case, folder: Path) -> None:
    structure = make_structure(whole)
    frame, six = structure.frame, range(6)
    moved = [Channel(f"{n} {k}", ((1.0, "displacement", frame.nodes[n], k),)) for n in frame.nodes for k in six]
    held = [Channel(f"R {n} {k}", frame.reaction(n, k)) for n in frame.supports for k in six if frame.supports[n][k]]
    final = structure.apply_gravity(moved + held).final
    ours = np.array([[final[f"{name} {k}"] for k in six] for name in frame.nodes])
    theirs = table(folder / "gravity.csv")
    assert off(ours[:, :3], theirs[:, :3]) < case.static and off(ours[:, 3:], theirs[:, 3:]) < 10.0 * case.static
    ours = np.array([[final.get(f"R {name} {k}", 0.0) for k in six] for name in frame.supports])
    theirs = table(folder / "gravity_reactions.csv")
    assert off(ours, theirs) < case.static  # moments over those of the largest force on one metre
    assert theirs[:, 2].sum() == pytest.approx(frame.sinking.loads, rel=1e-9)


def check_history(whole: Building, case: Case, folder: Path) -> np.ndarray:
    """Every step; returns the largest drift ratio of a storey along x and y."""
    structure = make_structure(whole)
    load_and_damp(whole, structure)
    ground, vertical = (np.loadtxt(folder.parent / f"model_shake{end}.txt") for end in ("", "_vertical"))
    assert np.abs(ground - 2.0 * pulses()[:, 1]).max() < 1e-12 and np.abs(vertical - 0.7 * ground).max() < 1e-12
    assert whole.integration is not None
    sums, method = channels(structure.frame), integrator(whole.integration)
    response = structure.analysis.history(ground, 0.01, method=method, channels=sums, vertical=vertical)
    assert response.status == "completed"
    head = columns(folder / "shake.csv")
    assert head == [channel.name for channel in sums]
    theirs = dict(zip(head, table(folder / "shake.csv").T, strict=True))
    for unit in ("[N]", "[m]", "[rad]"):
        names = [name for name in head if unit in name]
        if names:
            assert off([response.values[name] for name in names], [theirs[name] for name in names]) < case.history, unit
    first, second = (np.array([theirs[f"floor {floor} {way} [m]"] for way in "xy"]) for floor in (1, 2))
    return np.maximum(np.abs(first).max(axis=1) / 4.0, np.abs(second - first).max(axis=1) / 3.2)


@pytest.mark.parametrize("name", CASES)
def test_script_of_a_building(tmp_path: Path, name: str) -> None:
    case = CASES[name]
    whole = hall(tmp_path, *case.changes)
    assert written(whole, tmp_path / "model.py") == ()
    run(tmp_path / "model.py")
    folder = tmp_path / "model_results"
    check_modes(whole, case, folder)
    check_gravity(whole, case, folder)
    drift = check_history(whole, case, folder)
    assert (drift > (0.04, 0.01)).all()  # far beyond yield; eccentric masses and the motion along x alone shake y too


def test_tcl_of_a_building_does_what_python_does(tmp_path: Path) -> None:
    check_languages(hall(tmp_path, ("scale: 2", "scale: 0.5")), tmp_path)
