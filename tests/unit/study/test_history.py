"""Histories of a one-storey frame against Newmark's recursion for one degree of freedom, written out here."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from shear_frames import HEIGHT, STIFFNESS
from unit.study.frames import NODE_MASS, PULSE, project, shear_frame

from edesign.archive.dataset import Group
from edesign.errors import InputError
from edesign.project.project import Project
from edesign.study.analysis.residual import residual
from edesign.study.run.analyses import run_analysis

DT, M = 0.01, 2 * NODE_MASS
HISTORY = "{name: h, kind: history, record: pulse, scale: 2.0, free_vibration: 1.5 s, level: DBE, variant: bare}"
STATEMENT = "{kind: modal, ratio: 5 %, modes: 1}"


def recursion(ground: np.ndarray, k: float, zeta: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement, velocity, relative acceleration; average acceleration method (Chopra, Table 5.4.2)."""
    c = 2 * zeta * np.sqrt(k * M)
    u, v, a = (np.zeros(ground.size) for _ in range(3))
    a[0] = -ground[0]
    for i in range(ground.size - 1):
        known = M * (4 / DT**2 * u[i] + 4 / DT * v[i] + a[i]) + c * (2 / DT * u[i] + v[i])
        u[i + 1] = (-M * ground[i + 1] + known) / (k + 2 * c / DT + 4 * M / DT**2)
        v[i + 1] = 2 / DT * (u[i + 1] - u[i]) - v[i]
        a[i + 1] = 4 / DT**2 * (u[i + 1] - u[i]) - 4 / DT * v[i] - a[i]
    return u, v, a


def ground_motion() -> np.ndarray:
    """The pulse times 2, at half its step, and 1.5 s of zeros."""
    fine = np.interp(np.arange(13) * 0.5, np.arange(7), 2 * np.array(PULSE))
    return np.concatenate((fine, np.zeros(150)))


def made(folder: Path, *analyses: str, damping: str = STATEMENT, outputs: str = "{}", storeys: int = 1) -> Project:
    (folder / "pulse.csv").write_text("\n".join(map(str, PULSE)))
    where = str(folder / "project.yaml")
    return shear_frame(*(analyses or (HISTORY,)), damping=damping, outputs=outputs, storeys=storeys, path=where)


def run(one: Project) -> Group:
    return run_analysis(one, one.analyses[0])


def test_response_of_one_degree_of_freedom(tmp_path: Path) -> None:
    """Beam and columns are rigid but for 1e-7 where they should be: peaks agree to 1e-5."""
    group = run(made(tmp_path))
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    ground = ground_motion()
    u, _, a = recursion(ground, STIFFNESS, 0.05)
    values = {name: variable.values for name, variable in group.variables.items()}
    scale = np.abs(u).max()
    assert values["ground_acceleration"] == pytest.approx(ground, abs=1e-14)
    assert group.coords["time"].values == pytest.approx(np.arange(ground.size) * DT, abs=1e-12)
    assert np.abs(values["floor_displacement"][:, 0] - u).max() < 1e-5 * scale
    assert values["floor_displacement_max"][0] == pytest.approx(u.max(), rel=1e-5)
    assert values["floor_displacement_min"][0] == pytest.approx(u.min(), rel=1e-5)
    assert values["floor_acceleration_max"][0] == pytest.approx((a + ground).max(), rel=1e-4)
    assert values["storey_drift_max"][0] == pytest.approx(u.max() / HEIGHT, rel=1e-5)
    # forces of the columns alone, without damping: k u to the left of the base, and the same in the storey
    assert np.abs(values["base_shear"] - STIFFNESS * u).max() < 1e-5 * STIFFNESS * scale
    assert np.abs(values["storey_shear"][:, 0] - values["base_shear"]).max() < 1e-6 * STIFFNESS * scale


def test_residual_is_a_mean_over_the_last_period(tmp_path: Path) -> None:
    group = run(made(tmp_path))
    period = 2 * np.pi * np.sqrt(M / STIFFNESS)
    assert group.attributes["fundamental_period_s"] == pytest.approx(period, rel=1e-5)
    u, _, _ = recursion(ground_motion(), STIFFNESS, 0.05)
    expected = u[-round(period / DT) :].mean()
    peak = np.abs(u).max()
    assert group.variables["residual_roof_displacement"].values == pytest.approx(expected, abs=1e-5 * peak)
    assert group.variables["residual_storey_drift"].values[0] == pytest.approx(expected / HEIGHT, abs=1e-5 * peak)
    assert group.variables["floor_displacement_final"].values[0] == pytest.approx(u[-1], abs=1e-5 * peak)
    assert "last whole fundamental period" in group.variables["residual_roof_displacement"].long_name


def test_residual_of_an_oscillation_about_an_offset() -> None:
    """A whole period of a sine has no mean; 100 samples a period."""
    t = np.arange(1000) * 0.01
    wave = np.stack([0.3 + np.sin(2 * np.pi * t), np.full(1000, -2.0)], axis=1)
    assert residual(wave, 0.01, 1.0) == pytest.approx([0.3, -2.0], abs=1e-12)
    assert residual(np.array([1.0, 3.0]), 0.01, 100.0) == pytest.approx(2.0)


def test_rayleigh_damping_of_two_storeys(tmp_path: Path) -> None:
    """Peaks of the free vibration fall by exp(2 pi zeta / sqrt(1 - zeta^2)) a period; energy goes into damping."""
    zeta, history = 0.08, "{name: h, kind: history, record: pulse, free_vibration: 7 s}"
    damping = "{kind: rayleigh, ratio: 8 %, modes: [1, 2], state: initial}"
    group = run(made(tmp_path, history, damping=damping, storeys=2))
    energy = dict(zip(group.coords["energy_term"].values, group.variables["energy_final"].values, strict=True))
    assert energy["damping"] > 0.9 * energy["input"] > 0.0
    assert group.attributes["statistics"]["energy_error"] < 1e-6
    late = group.variables["floor_displacement"].values[-400:, 1]  # the second mode, 2.6 times as fast, is gone
    inside = np.flatnonzero((late[1:-1] > late[:-2]) & (late[1:-1] > late[2:])) + 1
    assert inside.size >= 4
    # peaks between samples: (w dt / 2)^2 / 2 = 1e-3
    expected = np.exp(-2 * np.pi * zeta / np.sqrt(1 - zeta**2))
    assert late[inside[1:]] / late[inside[:-1]] == pytest.approx(np.full(inside.size - 1, expected), rel=5e-3)


def test_what_is_kept_does_not_change_the_results(tmp_path: Path) -> None:
    full = run(made(tmp_path))
    few = run(made(tmp_path, outputs="{histories: [storeys], every: 5}"))
    assert few.coords["time"].values == pytest.approx(full.coords["time"].values[::5])
    np.testing.assert_array_equal(few.variables["storey_drift"].values, full.variables["storey_drift"].values[::5])
    assert "floor_displacement" not in few.variables and "energy" not in few.variables
    for name, variable in full.variables.items():
        if name.startswith("residual") or name.endswith(("_max", "_min", "_final")):
            np.testing.assert_array_equal(few.variables[name].values, variable.values, err_msg=name)


def test_provenance_and_labels(tmp_path: Path) -> None:
    about = run(made(tmp_path)).attributes
    assert (about["record"], about["level"], about["variant"]) == ("pulse", "DBE", "bare")
    assert about["scale_factor"] == 2.0 and about["record_pga_m_s2"] == 3.0 and about["input_pga_m_s2"] == 6.0
    assert about["record_samples"] == 7 and len(str(about["record_checksum"])) == 64
    assert about["height"] == HEIGHT
    assert {"steps", "iterations", "refactorisations", "fallbacks", "cpu_s", "energy_error"} <= set(about["statistics"])
    unscaled = run(made(tmp_path, "{name: h, kind: history, record: pulse, pga: 0.1 g}")).attributes
    assert unscaled["input_pga_m_s2"] == pytest.approx(0.980665) and unscaled["level"] is None


def test_every_method_of_integration_finds_the_peak(tmp_path: Path) -> None:
    """HHT and generalised-alpha are of second order; at 58 steps a period they stay within 1 % of Newmark's peak."""
    reference = run(made(tmp_path)).variables["floor_displacement_max"].values[0]
    for method in ("hht, alpha: -0.1", "generalised_alpha, rho_inf: 0.8"):
        text = made(tmp_path).text.replace("method: newmark", f"method: {method}")
        other = run(project(text, tmp_path / "project.yaml"))
        assert other.variables["floor_displacement_max"].values[0] == pytest.approx(reference, rel=1e-2)
        assert other.variables["floor_displacement_max"].values[0] != reference


def test_a_stopped_history_says_so(tmp_path: Path) -> None:
    asked: list[int] = []

    def stop() -> bool:
        asked.append(1)
        return True

    shaken = made(tmp_path)
    group = run_analysis(shaken, shaken.analyses[0], stop=stop)
    assert asked and group.attributes["status"] == "interrupted"
    assert "residual_roof_displacement" not in group.variables


def test_progress_reaches_the_end(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    shaken = made(tmp_path)
    run_analysis(shaken, shaken.analyses[0], progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (162, 162)


def test_a_bad_record_is_an_input_error_that_names_both_files(tmp_path: Path) -> None:
    shaken = made(tmp_path)
    (tmp_path / "pulse.csv").write_text("1.0\nnan\n")
    with pytest.raises(InputError, match=r"project.yaml:\d+:\d+: records.pulse: .*pulse.csv:2.*E-TABLE-08"):
        run(shaken)


COLLAPSE = """\
edesign: 1
title: Two storeys that are pushed over
frame:
  bays: [6 m]
  storeys: [4 m, 3 m]
  columns: [{storeys: all, section: HEB160, material: S235}]
  beams: [{floors: all, section: IPE300, material: S235}]
materials:
  S235: {law: bilinear, E: 210 GPa, fy: 235 MPa}
loads:
  beams: [{floors: all, G: 40 kN/m}]
masses: {from_loads: {}}
damping: {kind: rayleigh, ratio: 2 %, state: initial}
integration: {method: newmark, time_step: 0.01 s}
records:
  push: {file: push.csv, acceleration_unit: g, time_step: 0.05 s}
analyses:
  - {name: h, kind: history, record: push, pga: 3 g}
"""


def test_a_collapse_is_kept_as_far_as_it_was_computed(tmp_path: Path) -> None:
    """A ground that accelerates one way at 3 g takes the frame beyond any equilibrium."""
    (tmp_path / "push.csv").write_text("0\n" + "1\n" * 600)
    group = run(project(f"{COLLAPSE}validity: {{drift: 1e9}}\n", tmp_path / "project.yaml"))
    assert group.attributes["status"] == "failed"
    assert "step" in str(group.attributes["reason"]) and group.attributes["record"] == "push"
    count = group.coords["time"].values.size
    assert 10 < count < 3000 and group.variables["storey_drift"].values.shape == (count, 2)
    assert np.all(np.isfinite(group.variables["storey_drift"].values))
    assert group.attributes["statistics"]["fallbacks"] > 0
    assert group.coords["event"].values.size == len(group.attributes["events"]) > 0
    assert "residual_roof_displacement" not in group.variables


def test_no_equilibrium_under_gravity_is_said_as_such(tmp_path: Path) -> None:
    (tmp_path / "push.csv").write_text("0\n1\n")
    group = run(project(COLLAPSE.replace("40 kN/m", "4000 kN/m"), tmp_path / "project.yaml"))
    assert group.attributes["status"] == "failed"
    assert str(group.attributes["reason"]).startswith("under the gravity loads: ")
