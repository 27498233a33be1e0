"""A zero and a late force beside a law without an exact step: Bouc-Wen's by Euler in numpy, nothing of edesign."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.results.law_file import law_text
from edesign.damper.testing.campaign import load_campaign

ZERO, LATE, NOISE = 0.1, 0.025, 0.004  # kN, s, kN
HEAD = """\
specimen: {name: S, layers: 1, layer_area: 1000 mm^2, layer_thickness: 100 mm}
law: {type: bouc_wen, parameters: {Fy: 0.8 kN, Y: 1.5 mm, alpha: 0.05}}
tests:
"""


def campaign(folder: Path) -> Path:
    """Bouc-Wen as declared (beta = gamma = 0.5, n = 1, twenty steps a sample), a zero of the force, and a delay."""
    random, rows = np.random.default_rng(1), ""
    for number, (amplitude, frequency) in enumerate(((10.0, 0.9), (8.0, 1.0), (6.0, 1.1), (9.0, 0.95)), start=1):
        t = np.arange(0.0, 8.0, 5e-4)
        u = amplitude * np.clip(np.minimum(t, 8.0 - t) / 2.0, 0.0, 1.0) * np.sin(2.0 * np.pi * frequency * t)
        z = np.zeros_like(u)
        for i, du in enumerate(np.diff(u)):
            z[i + 1] = z[i] + (du - 0.5 * abs(du) * z[i] - 0.5 * du * abs(z[i])) / 1.5
        force = 0.05 * 0.8 / 1.5 * u + 0.95 * 0.8 * z
        force = np.interp(t - LATE, t, force)[::20] + ZERO + NOISE * random.standard_normal(t[::20].size)
        lines = [f"{a:.2f},{b:.5f},{c:.5f}" for a, b, c in zip(t[::20], u[::20], force, strict=True)]
        text = "\n".join(["time_s,displacement_mm,force_kN", *lines, ""])
        (folder / f"test_{number}.csv").write_text(text, encoding="utf-8")
        use = "validate" if number == 4 else "fit"
        rows += f"  - {{file: test_{number}.csv, temperature: 20 degC, use: {use}}}\n"
    path = folder / "campaign.yaml"
    path.write_text(HEAD + rows, encoding="utf-8")
    return path


@pytest.mark.slow
def test_a_zero_and_a_late_force_are_found_beside_a_law_without_an_exact_step(tmp_path: Path) -> None:
    loaded = load_campaign(campaign(tmp_path))
    found = calibrate(loaded, threads=1)
    by_name = {effect.name: effect for effect in found.effects}
    assert set(by_name) == {"offset", "lag"} and found.verdict == "explained"
    # noise of 4 N in 2400 samples of a sine; Euler's steps of the truth are late by half a step, 0.25 ms
    assert by_name["offset"].parameters["offset"].value == pytest.approx(1e3 * ZERO, abs=2.0)
    # a delay at low frequencies; a filter of second order is one up to some tenths of its own
    lag = {name: one.value for name, one in by_name["lag"].parameters.items()}
    late = lag["lag"] if "lag" in lag else lag["zeta"] / (np.pi * lag["f"])
    assert late == pytest.approx(LATE, rel=0.06)
    # what other parameters do is not fitted, and that is said
    assert {"A", "gamma"} == set(found.fixed) and "n" in found.parameters["refit"]
    assert "A is fixed: A only scales z" in law_text(found, loaded)
