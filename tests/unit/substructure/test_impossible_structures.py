"""Structures too fast for the steps, too slow for the test, or without damping: what is said of them."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.cli.main import main
from edesign.project.analysis.damping import ModalDamping
from edesign.substructure.structure.numerical import shear_building
from edesign.substructure.structure.recursion import growth, recursion

MASS, STORY, SPECIMEN = 1e3, 1e9, 5e8  # kg, N/m, N/m: 195 Hz with the specimen
FILE = """\
edesign_rts: 1
structure: {masses: [MASS], stiffnesses: [STIFFNESS], damping: DAMPING}
specimen: {law: {type: kelvin_voigt, parameters: {k: 6.7 kN/mm, c: 150 kN*s/m}}}
rig: {kind: delay, delay: 5 ms}
compensators: {none: {kind: none}}
records: {kick: {file: kick.csv, acceleration_unit: m/s^2, columns: {time: t, acceleration: a}}}
tests: [{name: kick, kind: rts, record: kick, free_vibration: 1 s}]
"""


def said(
    folder: Path,
    capsys: pytest.CaptureFixture[str],
    command: str,
    mass: str,
    stiffness: str,
    damping: str = "{kind: modal, ratio: 2 %}",
) -> tuple[int, str]:
    """Exit code of a command, and all that it says, in one line."""
    (folder / "kick.csv").write_text("t,a\n0,0\n0.1,2\n0.2,-2\n0.3,0\n", encoding="utf-8")
    path = folder / "rts.yaml"
    text = FILE.replace("MASS", mass).replace("STIFFNESS", stiffness).replace("DAMPING", damping)
    path.write_text(text, encoding="utf-8")
    code = main(["rts", command, str(path)])
    shown = capsys.readouterr()
    return code, " ".join((shown.out + shown.err).split())


@pytest.mark.parametrize("step", [5e-5, 2e-4, 1e-3])
def test_growth_of_a_step_is_that_of_a_history(step: float) -> None:
    """The core's recursion, stepped by hand with a spring: its motion grows as the largest eigenvalue says."""
    part = shear_building([MASS], [STORY], ModalDamping(kind="modal", ratio=0.02, modes=1, state="initial"), 1)
    numerical = recursion(part, step, "exact", "extrapolated")
    z, force, before, size = np.array([1e-3, 0.0]), SPECIMEN * 1e-3, SPECIMEN * 1e-3, []
    for _ in range(400):
        w = np.array([force, before, 0.0, 0.0])
        z, moved = numerical.A @ z + numerical.B @ w, float(numerical.C[0] @ z + numerical.D[0] @ w)
        before, force = force, SPECIMEN * moved
        size.append(float(np.linalg.norm([*z * [1.0, 1e-3], force / SPECIMEN])))
    measured = (max(size[-50:]) / max(size[100:150])) ** (1.0 / 250.0)
    assert growth(numerical, SPECIMEN, 0.0, step) == pytest.approx(measured, rel=5e-3)
    assert (measured > 1.0) == (step > 0.5e-3)


def test_a_dashpot_alone_makes_long_steps_grow() -> None:
    part = shear_building([MASS], [1e5], ModalDamping(kind="modal", ratio=0.02, modes=1, state="initial"), 1)
    small, large = (growth(recursion(part, 1e-3, "exact", "held"), 0.0, c * MASS / 1e-3, 1e-3) for c in (0.1, 10.0))
    assert small < 1.0 < large


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_specimen_on_hardly_any_mass(tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str) -> None:
    code, text = said(tmp_path, capsys, command, "1 kg", "1 kN/m")
    assert code == 2 and says(text, "rts.yaml:1:1: loop.main_step: 1 ms E-RTS-03")
    assert "check masses and stiffnesses" in text and "not a finite number" not in text
    assert sorted(item.name for item in tmp_path.iterdir()) == ["kick.csv", "rts.yaml"]


def test_a_structure_faster_than_the_steps(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    code, text = said(tmp_path, capsys, "run", "100 t", "1e11 kN/mm")
    frequency = math.sqrt(1e17 / 100e3) / (2.0 * math.pi)
    assert code == 2 and f"structure.stiffnesses: the lowest frequency is {frequency:.3g} Hz" in text
    assert says(text, "500 Hz; E-RTS-03")


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_structure_slower_than_the_test(tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str) -> None:
    code, text = said(tmp_path, capsys, command, "1e9 t", "22.6 kN/mm")
    assert code == 0 and "Hz, and completes no oscillation in the 1.3 s of the test" in text


def test_no_damping_in_the_numerical_part(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The loop's transfer function is infinite at its frequency; the dashpot of the specimen damps the structure."""
    code, text = said(tmp_path, capsys, "check", "143.26 t", "22.6 kN/mm", "{kind: none}")
    assert code == 0 and "recommended" in text


@pytest.mark.parametrize("command", ["check", "run"])
def test_a_ground_at_rest_is_no_test(tmp_path: Path, capsys: pytest.CaptureFixture[str], command: str) -> None:
    assert said(tmp_path, capsys, "check", "143.26 t", "22.6 kN/mm")[0] == 0
    (tmp_path / "kick.csv").write_text("t,a\n0,0\n0.1,0\n0.2,0\n0.3,0\n", encoding="utf-8")
    assert main(["rts", command, str(tmp_path / "rts.yaml")]) == 2
    assert says(capsys.readouterr().err, "rts.yaml:7:9: test kick: E-RTS-02")
