"""Tests whose thermometers are wrong, and tests whose thermometers are right, are both of a law that lacks nothing.

Reference: the parameters and temperatures with which the forces were made (thesis Table 4.2, gamma_T of Table 4.4).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.results.result import Calibration
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen

NOISE = 20.0  # N, of forces of some 20 kN
TEMPERATURES = (20.0, 22.5, 25.0, 27.5, 30.0, 33.0, 24.0, 29.0)
TRUE = read_parameters(law("mgmm"), "thesis_table_4_2")


def found_with(folder: Path, thermometer: float) -> Calibration:
    """What is found in tests whose thermometer was wrong by so many kelvin, one way and the other."""
    random = np.random.default_rng(4)
    tests = []
    for i, temperature in enumerate(TEMPERATURES):
        t = np.arange(0.0, 6.0, 1.0 / 250.0)
        w = 2.0 * np.pi * (0.6, 1.5, 1.0, 2.0, 0.8, 1.2, 1.0, 1.5)[i]
        u = (5e-3, 3e-3, 8e-3, 4e-3, 6e-3, 7e-3, 5e-3, 4e-3)[i] * (1.0 - np.exp(-2.0 * t)) * np.sin(w * t)
        force = Damper(law("mgmm"), TRUE).at(temperature)[0].force(t, u) + NOISE * random.standard_normal(t.size)
        use = "fit" if i < 6 else "validate"
        tests.append(DamperTest(f"test_{i + 1:02d}", t, u, force, temperature + (-1) ** i * thermometer, use=use))
    written = write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, LawChoice("mgmm", "thesis_table_4_2"))
    return calibrate(written, threads=1)


@pytest.mark.parametrize("thermometer", [0.0, 0.3])
def test_an_error_of_the_thermometer_is_no_effect(tmp_path: Path, thermometer: float) -> None:
    found = found_with(tmp_path, thermometer)
    assert (found.verdict, found.effects, found.worst) == ("none", (), None)
    sizes = [np.mean(one.measured**2) for one in found.series if one.use == "validate"]
    # errors of 0.2 K are allowed for besides noise: 0.5 % of the force a kelvin (gamma_T of Table 4.4), and more
    assert found.noise_floor > NOISE**2 / np.mean(sizes)
    for name in ("k1", "k_a"):
        low, high = found.parameters["corrected"][name].interval
        assert low < TRUE[name] < high
