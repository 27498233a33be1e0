"""Limits that virtual tests met: what the rig could not do is reported, and never a result."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.archive.reader import Archive, open_archive
from edesign.cli.main import main
from edesign.project.substructure import load_rts_file
from edesign.report.archive.document import page_text
from edesign.report.archive.tables import overview
from edesign.report.substructure.tables import runs, substructure_summary
from edesign.report.tables.text import printed
from edesign.substructure.run import run_tests

K, C = 6.7e6, 150e3  # N/m, N s/m
FREE = """\
edesign_rts: 1
structure: {masses: [143.26 t], stiffnesses: [22.6 kN/mm], damping: {kind: modal, ratio: 2 %}}
specimen: {law: {type: kelvin_voigt, parameters: {k: 6.7 kN/mm, c: 150 kN*s/m}}}
rig: {kind: delay, delay: 10 ms, LIMITS}
compensators: {none: {kind: none}}
records: {kick: {file: kick.csv, acceleration_unit: m/s^2, columns: {time: t, acceleration: a}}}
tests: [{name: kick, kind: rts, record: kick, free_vibration: 20 s}]
"""
SINE = """\
edesign_rts: 1
specimen: {law: {type: kelvin_voigt, parameters: {k: 6.7 kN/mm, c: 150 kN*s/m}}}
rig: {kind: ideal, limits: {force: 20 kN}}
compensators: {none: {kind: none}}
tests: [{name: sine, kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz, cycles: 4}}]
"""
OMEGA = 2.0 * np.pi * 2.0
STIFFNESS = K + C * (1.0 - np.exp(-1e-3j * OMEGA)) / 1e-3  # as the rig moves in ramps of 1 ms
AMPLITUDE = 5e-3 * abs(STIFFNESS)  # N, under 5 mm at 2 Hz


def ran(folder: Path, text: str, limits: str = "") -> Path:
    """The archive of a file with a kick of the ground; `limits` of its rig."""
    (folder / "kick.csv").write_text("t,a\n0,0\n0.1,2\n0.2,-2\n0.3,0\n0.4,0\n", encoding="utf-8")
    path = folder / "rts.yaml"
    text = text.replace("LIMITS", f"limits: {{{limits}}}") if limits else text.replace(", LIMITS", "")
    path.write_text(text, encoding="utf-8")
    return run_tests(load_rts_file(path), overwrite=True)[0]


def said(archive: Archive) -> str:
    return " ".join(" ".join(cell for row in printed(table).rows for cell in row) for table in overview(archive))


def test_a_force_beyond_that_of_a_linear_rig_is_no_result(tmp_path: Path) -> None:
    """34.9 kN under a sine of 5 mm: |F| > 20 kN for 2/pi acos(20/34.9) of the time, by hand."""
    with open_archive(ran(tmp_path, SINE)) as archive:
        (run,) = runs(archive)
        assert run.text("outcome") == "saturated"
        assert f"took {1e-3 * AMPLITUDE:.4g} kN, and the actuator has 20 kN (first at" in run.text("reason")
        assert "no balance of forces" in run.text("reason")
        assert np.isnan(run.value("nrms")) and np.isnan(run.value("peak_error"))
        found = {name: (first, duration) for name, first, _, duration in run.limits()}
        assert set(found) == {"force", "range of a sensor"}
        share = 2.0 / np.pi * np.arccos(20e3 / AMPLITUDE)
        assert found["force"][1] == pytest.approx(share * 2.0, abs=16 * 1e-3)  # a step at each of 16 crossings
        first = (np.arcsin(20e3 / AMPLITUDE) - np.angle(STIFFNESS)) / OMEGA
        assert found["force"][0] == pytest.approx(first, abs=2e-3)
        assert "saturated" in said(archive) and "kelvin" not in said(archive)
        (json,) = substructure_summary(archive)
        assert json["outcome"] == "saturated" and json["nrms"] is None
        assert [one["limit"] for one in json["limits"]] == ["force", "range of a sensor"]  # type: ignore[attr-defined]
    page = page_text(tmp_path / "rts.h5")
    assert "Runs without a result" in page and "What could not be shown" not in page
    assert main(["rts", "run", str(tmp_path / "rts.yaml"), "--check", "--quiet"]) == 3


def test_a_servo_hydraulic_rig_stalls_at_its_force_and_is_judged(tmp_path: Path) -> None:
    """Its flow falls with the force, so the motion is that of the actuator."""
    rig = "rig: {kind: servo_hydraulic, proportional_gain: 100 /s, limits: {velocity: 0.5 m/s, force: 20 kN}}"
    text = SINE.replace("rig: {kind: ideal, limits: {force: 20 kN}}", rig)
    with open_archive(ran(tmp_path, text)) as archive:
        (run,) = runs(archive)
        assert run.text("outcome") == "done" and run.value("nrms_root") > 0.1
        assert "velocity" in run.text("saturated")


@pytest.mark.parametrize(
    ("limits", "reason"), [("velocity: 5 mm/s", "velocity limit of the rig"), ("stroke: 1 mm", "stroke limit")]
)
def test_a_limit_cycle_is_reported_as_unstable_and_held(tmp_path: Path, limits: str, reason: str) -> None:
    """With 60 ms of delay the loop grows: without limits it diverges, with them it oscillates for ever."""
    late = FREE.replace("delay: 10 ms", "delay: 60 ms")
    with open_archive(ran(tmp_path, late)) as archive:
        assert "diverged" in runs(archive)[0].text("reason")
    with open_archive(ran(tmp_path, late, limits)) as archive:
        (run,) = runs(archive)
        assert run.text("outcome") == "unstable" and np.isnan(run.value("response_error"))
        assert run.text("reason").startswith(f"limited by the {reason}") and "first at" in run.text("reason")
        motion = np.abs(archive.group("tests/kick/none").variables["deformation"].values)
        assert np.max(motion[-1000:]) > 0.5 * np.max(motion)


def test_a_stable_loop_at_a_limit_is_judged_by_its_error(tmp_path: Path) -> None:
    """The rig is late at its limit, so that the motion need not come to rest: the last time says so."""
    with open_archive(ran(tmp_path, FREE, "velocity: 10 mm/s")) as archive:
        (run,) = runs(archive)
        assert run.text("outcome") == "done" and run.value("response_error") > 0.05
        assert "too wrong; it met the velocity limit of the rig (first at" in said(archive)
        assert ", last at 20.4 s" in said(archive)


def test_warnings_about_a_run_are_reported(tmp_path: Path) -> None:
    """An adaptive compensator below its threshold, and a motion below the noise."""
    pair = "{ats: {kind: ats, threshold: 20 mm}, live: {kind: live_delay, delay: 5 ms, threshold: 20 mm}}"
    with open_archive(ran(tmp_path, FREE.replace("{none: {kind: none}}", pair))) as archive:
        warnings = archive.attributes["warnings"]
    assert isinstance(warnings, list) and len(warnings) == 2
    for name, warning in zip(("ats", "live"), warnings, strict=True):
        assert f'test kick: "{name}" never adapted, and kept what it began with' in warning
        assert "its threshold is 20 mm" in warning
    noisy = FREE + "sensors: {encoder_noise: 200 mm, force_noise: 500 kN}\n"
    with open_archive(ran(tmp_path, noisy)) as archive:
        reported = " ".join(archive.attributes["warnings"])  # type: ignore[arg-type]
    assert "the noise of the displacement, 200 mm, is not below the largest" in reported
    assert "the noise of the force, 500 kN, is not below the largest force of the specimen" in reported
