"""The loop on property tables made by formulas of the test itself: it finds what is hidden, and nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad

from edesign.calibrate.properties.campaign import load_property_campaign
from edesign.calibrate.properties.result import PropertyCalibration
from edesign.calibrate.properties.run import calibrate_properties

LAYERS, AREA, THICKNESS = 2, 0.0414, 0.012
K0, K1, C1 = 5e6, 4e6, 2e5  # N/m, N/m, N*s/m: relaxes in 50 ms
NOISE = 0.003
STRAINS, FREQUENCIES = (0.1, 0.2, 0.3, 0.4, 0.5), (0.25, 0.5, 1.0, 2.0, 3.0, 4.0)
CAMPAIGN = """\
specimen: {name: made, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}
law: {type: zener, parameters: {k0: 5.2 kN/mm, k1: 3.9 kN/mm, c1: 0.19 kN*s/mm}}
properties: {table: table.csv, hold_out: {strains: [20 %, 40 %]}}
"""


def _properties(strain: float, frequency: float, c: float, alpha: float, peak: float) -> tuple[float, float, float]:
    """G', G_eq and n of a Zener solid beside c |v|^alpha, in closed form but for its work and its largest force."""
    omega, u0 = 2.0 * np.pi * frequency, strain * THICKNESS
    s = 1j * omega * C1 / K1
    stiffness = K0 + K1 * s / (1.0 + s)

    def force(t: float) -> float:
        v = u0 * omega * np.cos(t)
        return u0 * float((stiffness * np.exp(1j * t)).imag) + c * abs(v) ** alpha * np.sign(v)

    # the dashpot's work; that of the solid is pi u0^2 Im K
    quarter = quad(lambda t: np.cos(t) ** (1.0 + alpha), 0.0, np.pi / 2.0)[0]
    work = 4.0 * c * (u0 * omega) ** (1.0 + alpha) * quarter / omega
    loss = stiffness.imag + work / (np.pi * u0**2)
    largest = max(force(t) for t in np.linspace(0.0, np.pi, 2001)) / u0
    to_modulus = THICKNESS / (LAYERS * AREA)
    return stiffness.real * to_modulus, (1.0 + peak) * largest * to_modulus, loss / stiffness.real


def _calibrated(folder: Path, c: float = 0.0, alpha: float = 1.0, peak: float = 0.0) -> PropertyCalibration:
    rng = np.random.default_rng(1)
    lines = ["temperature_C,shear_strain_percent,frequency_Hz,G_storage_MPa,G_eq_MPa,loss_factor"]
    for strain in STRAINS:
        for frequency in FREQUENCIES:
            noise = np.exp(NOISE * rng.standard_normal(3))
            G, G_eq, n = np.array(_properties(strain, frequency, c, alpha, peak)) * noise
            lines.append(f"20,{100 * strain:g},{frequency:g},{1e-6 * G:.5f},{1e-6 * G_eq:.5f},{n:.5f}")
    (folder / "table.csv").write_text("\n".join(lines) + "\n")
    (folder / "campaign.yaml").write_text(CAMPAIGN)
    return calibrate_properties(load_property_campaign(folder / "campaign.yaml"), workers=1)


@pytest.mark.slow
def test_power_of_the_velocity(tmp_path: Path) -> None:
    """A dashpot of 6 kN at 0.1 m/s with alpha = 0.3 beside a Zener solid: about a sixth of the force."""
    c = 6e3 / 0.1**0.3
    found = _calibrated(tmp_path, c, 0.3)
    effects = found.found.effects
    assert [effect.name for effect in effects][:1] == ["velocity_exponent"]
    assert found.found.errors["corrected"].validate < 2.0 * found.found.noise_floor
    assert found.found.errors["refit"].validate > 10.0 * found.found.noise_floor
    if effects[0].form == "dashpot":
        assert effects[0].parameters["alpha"].value == pytest.approx(0.3, abs=0.08)


@pytest.mark.slow
def test_peak_read_too_large(tmp_path: Path) -> None:
    """No law makes G_eq 8 % too large at one G' and loss factor; no part of the damper is made of it."""
    found = _calibrated(tmp_path, peak=0.08)
    assert [(effect.name, effect.form) for effect in found.found.effects] == [("peak_reading", "share")]
    assert found.found.effects[0].parameters["share"].value == pytest.approx(0.08, abs=0.005)
    assert found.law.effects == ()


def test_nothing_where_nothing_is(tmp_path: Path) -> None:
    found = _calibrated(tmp_path)
    assert found.found.effects == ()
    assert found.found.verdict == "none"
    assert 0.9 * NOISE < found.noise < 1.6 * NOISE  # the upper end of what the table leaves open
    for name, true in (("k0", K0), ("k1", K1), ("c1", C1)):
        assert found.found.parameters["corrected"][name].value == pytest.approx(true, rel=0.06)
