"""The bilinear law in a bar of 1 m and 1 m2, driven through cycles in displacement control: force is stress,
motion is strain."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, Structure, channel, oscillator

from edesign.core import Bilinear, Steel

YIELD = FY / E
# strains in eps_y: yield, growing cycles with small reversals, back to zero strain
CYCLES = [2.0, 1.2, 3.0, -1.0, -4.0, -3.5, -5.0, 4.0, 3.0, 6.0, -6.0, 0.0]


def drive(law: Steel, targets: list[float], steps: int = 20) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Strain, stress and energies of the bar along the targets (in eps_y); an elastic spring beside it keeps it
    stable."""
    s: Structure = oscillator(E, 0.0, law, parallel=0.1 * E)
    s.model.nodal_load(s.pattern, s.nodes[1], fx=1.0)
    a = s.analysis(tolerance=1e-12)
    strain, stress = [np.zeros(1)], [np.zeros(1)]
    energy: dict[str, list[np.ndarray]] = {}
    channels = [channel("displacement", s.nodes[1], 0, "u"), channel("axial_force", s.elements[0], 0, "s")]
    for target in targets:
        r = a.pushover(s.pattern, s.nodes[1], "ux", target * YIELD, steps, channels)
        assert r.status == "completed", r.reason
        strain.append(r.values["u"][1:])
        stress.append(r.values["s"][1:])
        for name, values in r.energy.items():
            energy.setdefault(name, []).append(values[1:])
    return np.concatenate(strain), np.concatenate(stress), {k: np.concatenate(v) for k, v in energy.items()}


def bilinear(strain: np.ndarray, b: float) -> np.ndarray:
    """Stress between the parallel lines b E eps +- (1 - b) fy: a form without plastic strains."""
    stress = np.zeros(strain.size)
    for k in range(1, strain.size):
        trial = stress[k - 1] + E * (strain[k] - strain[k - 1])
        centre = b * E * strain[k]
        stress[k] = np.clip(trial, centre - (1 - b) * FY, centre + (1 - b) * FY)
    return stress


@pytest.mark.parametrize("b", [0.0, 0.02, 0.3])
def test_cycles(b: float) -> None:
    """Rounding of some hundred steps."""
    strain, stress, _ = drive(Bilinear(E, FY, b), CYCLES)
    np.testing.assert_allclose(stress, bilinear(strain, b), atol=1e-9 * FY)


@pytest.mark.parametrize("b", [0.0, 0.05])
def test_dissipated_energy_is_the_area_of_the_loop(b: float) -> None:
    """A closed loop between -e and e: 4 (1 - b) fy (e - eps_y), trapezoids of straight lines being exact."""
    e = 5.0
    strain, stress, energy = drive(Bilinear(E, FY, b), [e, -e, e, -e, e])
    start = 2 * 20 + 20  # the first time back at +e: from there two loops
    loops = energy["hysteretic"][-1] - energy["hysteretic"][start - 1]
    assert loops == pytest.approx(4 * (1 - b) * FY * (e - 1) * YIELD, rel=1e-9)
    area = np.sum(0.5 * (stress[start + 1 :] + stress[start:-1]) * np.diff(strain[start:]))
    assert loops == pytest.approx(area, rel=1e-3)  # a step in which the bar yields is cut off by a corner
    assert np.all(np.diff(energy["hysteretic"]) >= -1e-12 * loops) or b > 0.0


def test_energy_balance_of_cycles() -> None:
    """Input = stored + dissipated; the trapezoidal rule misses the corners only: 1 % of it for 20 steps a branch."""
    _, _, energy = drive(Bilinear(E, FY, 0.02), CYCLES)
    assert np.abs(energy["residual"]).max() < 1e-2 * energy["hysteretic"][-1]
    _, _, finer = drive(Bilinear(E, FY, 0.02), CYCLES, 200)
    assert np.abs(finer["residual"]).max() < 0.1 * np.abs(energy["residual"]).max()


def test_step_size_does_not_matter() -> None:
    """A law without rate: the end of a path does not depend on its steps."""
    _, coarse, _ = drive(Bilinear(E, FY, 0.02), CYCLES, 1)
    _, fine, _ = drive(Bilinear(E, FY, 0.02), CYCLES, 37)
    assert coarse[1:] == pytest.approx(fine[37::37], abs=1e-9 * FY)
