"""One-storey buildings under pairs of records, at angles, with their masses beside their places.

References: three oscillators in closed form where stiffness and mass have one centre; otherwise two translations and
a turn that are coupled (Chopra, Dynamics of Structures, 4th edition, section 9.6), integrated here; symmetry.
Columns are cantilevers under a rigid floor, without beams: 3 E I / h^3 along each axis, G I_t / h about the vertical.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from building_examples import changed

from edesign.archive.dataset import Group
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.steel_section import steel_section
from edesign.ground_motion.formats.write import write_csv
from edesign.ground_motion.record import Record
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.building import Building, load_building
from edesign.study.analysis.modal import fundamental_period
from edesign.study.plan.plan import make_plan
from edesign.study.run.analyses import run_analysis

E, G, HEIGHT = 210e9, 210e9 / 2.6, 3.5
TABLE = """\
edesign_building: 1
title: A table
plan: {x: [6 m], y: [5 m]}
storeys: [3.5 m]
columns:
  - {section: HEB200, material: S275, strong: x}
beams: [{along: x, section: IPE300, material: S275, ends: pinned}]
missing: {beams: [{along: x}, {along: y}]}
materials: {S275: {E: 210 GPa, fy: 275 MPa, nu: 0.3, law: elastic}}
loads: {self_weight: false}
masses: {given: [{at: all, floors: 1, mass: 8 t}]}
elements: {geometry: {columns: linear}}
damping: {kind: none}
integration: {method: newmark, time_step: 0.002 s, tolerance: 1e-10}
records:
  both: {pair: [{file: a.csv, acceleration_unit: m/s^2}, {file: b.csv, acceleration_unit: m/s^2}]}
  one: {file: a.csv, acceleration_unit: m/s^2}
analyses:
  - {name: shaken, kind: history, record: both}
outputs: {every: 1, histories: [floors, storeys, energy]}
"""
UNEQUAL = (
    ("strong: x}\nbeams", "strong: x}\n  - {at: A, section: HEB260, material: S275, strong: x}\nbeams"),
    ("{at: all, floors: 1, mass: 8 t}", "{at: [A, B1], floors: 1, mass: 8 t}, {at: B2, floors: 1, mass: 14 t}"),
    ("damping: {kind: none}", "damping: {kind: rayleigh, ratio: 3 %, periods: [0.6 s, 0.15 s]}"),
)
"""Centres of mass and stiffness apart along x and y; damped."""
DAMPING = (0.03, 2 * np.pi / 0.6, 2 * np.pi / 0.15)
STEP = 0.002


def stiffness(section: str) -> tuple[float, float, float]:
    """Of a column along x, which its strong axis resists, along y, N/m, and about the vertical, N m."""
    shape = steel_section(section)
    return 3.0 * E * shape.I_y / HEIGHT**3, 3.0 * E * shape.I_z / HEIGHT**3, G * shape.I_t / HEIGHT


@dataclass(frozen=True)
class Floor:
    """Two translations of the centre of mass and a turn: masses and stiffness, (3, 3)."""

    M: np.ndarray
    K: np.ndarray


def floor_of(sections: Mapping[str, str], masses: Mapping[str, float], beside: tuple[float, float]) -> Floor:
    """The floor by hand.

    Args:
        sections: of the columns, by column line.
        masses: kg, likewise.
        beside: by how much the masses stand beside the columns, m.
    """
    places = {"A1": (0.0, 0.0), "B1": (6.0, 0.0), "A2": (0.0, 5.0), "B2": (6.0, 5.0)}
    total = sum(masses.values())
    centre = np.sum([masses[line] * np.array(place) for line, place in places.items()], axis=0) / total
    polar = sum(masses[line] * float(np.sum((np.array(place) - centre) ** 2)) for line, place in places.items())
    K = np.zeros((3, 3))
    for line, place in places.items():
        k_x, k_y, k_turn = stiffness(sections[line])
        x, y = np.array(place) - centre - beside
        along_x, along_y = np.array([1.0, 0.0, -y]), np.array([0.0, 1.0, x])
        K += k_x * np.outer(along_x, along_x) + k_y * np.outer(along_y, along_y)
        K[2, 2] += k_turn
    return Floor(np.diag([total, total, polar]), K)


def equal_floor() -> Floor:
    lines = ("A1", "B1", "A2", "B2")
    return floor_of(dict.fromkeys(lines, "HEB200"), dict.fromkeys(lines, 8e3), (0.0, 0.0))


def unequal_floor(beside: tuple[float, float] = (0.0, 0.0)) -> Floor:
    sections = {"A1": "HEB260", "A2": "HEB260", "B1": "HEB200", "B2": "HEB200"}
    return floor_of(sections, {"A1": 8e3, "A2": 8e3, "B1": 8e3, "B2": 14e3}, beside)


def wave(seed: int) -> np.ndarray:
    """Two seconds of motion, (1001,) m/s2."""
    t, phases = np.arange(1001) * STEP, np.random.default_rng(seed).uniform(0, 2 * np.pi, 4)
    parts = zip((1.2, 0.9, 0.5, 0.2), (1.3, 2.7, 5.1, 9.0), phases, strict=True)
    sines = sum(size * np.sin(2 * np.pi * frequency * t + phase) for size, frequency, phase in parts)
    return np.asarray(np.sin(np.pi * t / t[-1]) ** 2 * sines)


def table(folder: Path, a: np.ndarray, b: np.ndarray, *changes: tuple[str, str]) -> Building:
    for name, samples in (("a", a), ("b", b)):
        write_csv(Record(name, samples, STEP, name), folder / f"{name}.csv")
    path = folder / "building.yaml"
    path.write_text(changed(TABLE, *changes), encoding="utf-8")
    return load_building(path, BuildingSections())


def histories(whole: Building) -> dict[str, Group]:
    found = {}
    for spec in (task.spec for task in make_plan(whole)):
        assert isinstance(spec, HistoryAnalysis)
        group = found[spec.name] = run_analysis(whole, spec)
        assert group.attributes["status"] == "completed", group.attributes["reason"]
    return found


def moved(group: Group) -> np.ndarray:
    """Along x and y, and turned, (nt, 3) m and rad."""
    along = group.variables["floor_displacement"].values[:, 0]
    return np.column_stack([along, group.variables["floor_rotation"].values[:, 0]])


def newmark(floor: Floor, x: np.ndarray, y: np.ndarray, a_0: float, a_1: float) -> tuple[np.ndarray, np.ndarray]:
    """Displacements and velocities, (nt, 3), by the average acceleration method (Chopra, Table 15.2.1).

    Args:
        x: accelerations of the ground along it, (nt,) m/s2.
        y: likewise.
        a_0, a_1: of the Rayleigh damping.
    """
    M, K = floor.M, floor.K
    C = a_0 * M + a_1 * K
    u, v, a = np.zeros((x.size, 3)), np.zeros((x.size, 3)), np.zeros((x.size, 3))
    load = -np.column_stack([x, y, np.zeros_like(x)]) @ M
    a[0] = np.linalg.solve(M, load[0])
    whole = K + 2.0 * C / STEP + 4.0 * M / STEP**2
    for i in range(1, x.size):
        before = M @ (4.0 * u[i - 1] / STEP**2 + 4.0 * v[i - 1] / STEP + a[i - 1]) + C @ (
            2.0 * u[i - 1] / STEP + v[i - 1]
        )
        u[i] = np.linalg.solve(whole, load[i] + before)
        v[i] = 2.0 * (u[i] - u[i - 1]) / STEP - v[i - 1]
        a[i] = 4.0 * (u[i] - u[i - 1]) / STEP**2 - 4.0 * v[i - 1] / STEP - a[i - 1]
    return u, v


def test_first_periods_by_direction(tmp_path: Path) -> None:
    """T = 2 pi sqrt(m / k) along x and along y, in the order of the axes and not of the periods; both to rounding."""
    floor = equal_floor()
    k = np.diag(floor.K)
    assert np.abs(floor.K - np.diag(k)).max() < 1e-9 * k.max()  # three oscillators
    found = fundamental_period(table(tmp_path, wave(1), wave(2)))
    assert found == pytest.approx((2 * np.pi * np.sqrt(np.diag(floor.M) / k))[:2].tolist(), rel=1e-9)
    along_y = ("section: HEB200, material: S275, strong: x", "section: HEB200, material: S275, strong: y")
    assert fundamental_period(table(tmp_path, wave(1), wave(2), along_y)) == pytest.approx(found[::-1], rel=1e-9)


def test_three_oscillators_under_a_pair(tmp_path: Path) -> None:
    """Ground that starts to accelerate at 30 degrees: u = -a / omega^2 (1 - cos omega t) along each axis, no turn.

    The average acceleration method lengthens periods by (omega dt)^2 / 12, which after 2 s is a phase of 1e-3.
    """
    a, b = np.full(1001, 1.0), np.full(1001, -0.4)
    whole = table(tmp_path, a, b, ("record: both", "record: both, angles: 30 deg"))
    (group,) = histories(whole).values()
    floor, t = equal_floor(), np.arange(1001) * STEP
    omega = np.sqrt(np.diag(floor.K) / np.diag(floor.M))
    cos, sin = np.sqrt(0.75), 0.5
    found = moved(group)
    for axis, ground in enumerate((cos * 1.0 + sin * 0.4, sin * 1.0 - cos * 0.4)):
        slower = omega[axis] * (1.0 - (omega[axis] * STEP) ** 2 / 12.0)
        expected = -ground / omega[axis] ** 2 * (1.0 - np.cos(slower * t))
        assert found[:, axis] == pytest.approx(expected, abs=1e-4 * np.abs(expected).max())
        largest = np.abs(group.variables["floor_displacement_min"].values[0, axis])
        assert largest == pytest.approx(2.0 * ground / omega[axis] ** 2, rel=1e-4)
    assert np.abs(found[:, 2]).max() < 1e-9 * np.abs(found[:, :2]).max()
    labels = {name: group.attributes[name] for name in ("record", "angle_deg", "eccentricity")}
    assert labels == {"record": "both", "angle_deg": pytest.approx(30.0), "eccentricity": "0"}


@pytest.mark.parametrize(
    ("asked", "angle", "beside"),
    [
        ("record: both", 0.0, (0.0, 0.0)),
        ("record: both, angles: 115 deg", 115.0, (0.0, 0.0)),
        ("record: both, angles: 40 deg, eccentricity: +x-y", 40.0, (0.3, -0.25)),
        ("record: both, angles: -70 deg, eccentricity: -x, eccentricity_ratio: 20 %", -70.0, (-1.2, 0.0)),
        ("record: one, angles: 65 deg, eccentricity: +y", 65.0, (0.0, 0.25)),
    ],
)
def test_a_floor_that_turns(tmp_path: Path, asked: str, angle: float, beside: tuple[float, float]) -> None:
    """Periods, motions, peaks and energies of two translations and a turn that are coupled.

    1e-6 of the largest motion: results over time are kept in single precision; periods and peaks to 1e-8.
    """
    a, b = wave(3), wave(4)
    whole = table(tmp_path, a, b, *UNEQUAL, ("record: both", asked))
    (group,) = histories(whole).values()
    if "record: one" in asked:
        b = np.zeros_like(a)
    theta = np.radians(angle)
    x, y = np.cos(theta) * a - np.sin(theta) * b, np.sin(theta) * a + np.cos(theta) * b
    floor, (ratio, first, second) = unequal_floor(beside), DAMPING
    a_0, a_1 = 2 * ratio * first * second / (first + second), 2 * ratio / (first + second)
    u, v = newmark(floor, x, y, a_0, a_1)
    scale = np.abs(u).max(axis=0)
    np.testing.assert_allclose(moved(group) / scale, u / scale, rtol=0, atol=1e-6)
    assert scale[2] * 5.0 > 0.1 * scale[0]  # edges move by the turn
    for name, extreme in (("max", u.max(axis=0)), ("min", u.min(axis=0))):
        own = group.variables[f"floor_displacement_{name}"].values[0]
        assert own == pytest.approx(extreme[:2], abs=1e-8 * scale[:2].max())
    omega = np.sqrt(np.min(np.linalg.eigvals(np.linalg.solve(floor.M, floor.K)).real))
    assert group.attributes["fundamental_period_s"] == pytest.approx(2 * np.pi / omega, rel=1e-9)
    force = -np.column_stack([x, y]) * np.diag(floor.M)[:2]
    work = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(u[:, :2], axis=0)))
    by_hand = {"input": work, "kinetic": 0.5 * v[-1] @ floor.M @ v[-1], "elastic": 0.5 * u[-1] @ floor.K @ u[-1]}
    by_hand["damping"] = by_hand["input"] - by_hand["kinetic"] - by_hand["elastic"]
    terms = zip(group.coords["energy_term"].values, group.variables["energy_final"].values, strict=True)
    energies = {str(term): float(value) for term, value in terms}
    assert {term: energies[term] for term in by_hand} == pytest.approx(by_hand, rel=1e-7)


@pytest.mark.parametrize(("law", "strength", "tolerance"), [("elastic", 1.0, 1e-12), ("bilinear", 4.0, 1e-9)])
def test_a_quarter_turn_exchanges_the_axes(tmp_path: Path, law: str, strength: float, tolerance: float) -> None:
    """On a square of hollow sections; some hundred roundings in another order, which yielding multiplies."""
    square = (
        ("x: [6 m], y: [5 m]", "x: [6 m], y: [6 m]"),
        ("section: HEB200", "section: SHS200x10"),
        ("law: elastic", f"law: {law}, hardening: 0.02" if law == "bilinear" else "law: elastic"),
        ("damping: {kind: none}", "damping: {kind: rayleigh, ratio: 3 %, periods: [0.6 s, 0.15 s]}"),
        ("record: both", "record: both, angles: [0 deg, 90 deg], eccentricity: [0, +x+y]"),
    )
    found = histories(table(tmp_path, strength * wave(5), strength * wave(6), *square))
    assert list(found) == [f"shaken.{angle}deg.{place}" for angle in (0, 90) for place in ("0", "+x+y")]
    straight, turned = found["shaken.0deg.0"], found["shaken.90deg.0"]
    largest = {name: straight.variables[f"floor_displacement_{name}"].values[0] for name in ("max", "min")}
    x, y = (np.array([largest["max"][i], largest["min"][i]]) for i in (0, 1))
    of_turned = {name: turned.variables[f"floor_displacement_{name}"].values[0] for name in ("max", "min")}
    scale = max(np.abs(x).max(), np.abs(y).max())
    assert [of_turned["max"][0], of_turned["min"][0]] == pytest.approx((-y[::-1]).tolist(), abs=tolerance * scale)
    assert [of_turned["max"][1], of_turned["min"][1]] == pytest.approx(x.tolist(), abs=tolerance * scale)
    assert (
        np.abs(moved(straight)[:, 2]).max() < 1e-9 * scale < 1e-3 * np.abs(moved(found["shaken.0deg.+x+y"])[:, 2]).max()
    )
