"""The Menegotto-Pinto law in a bar against its own closed form, evaluated here, and its behaviour after small
unloadings.

Menegotto & Pinto (1973), Filippou, Popov & Bertero (1983): from a reversal (er, sr) towards the asymptote
s = b E e +- (1 - b) fy, met by the elastic line at (e0, s0):
    s* = b e* + (1 - b) e* / (1 + |e*|^R)^(1/R),  e* = (e - er)/(e0 - er),  R = R0 (1 - cR1 xi / (cR2 + xi)),
    xi = |(e_extreme - e0) / eps_y| with the extreme strain so far in the direction of loading.
"""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from verification.structures import FY, E, channel, oscillator

from edesign.core import MenegottoPinto

YIELD = FY / E
B, R0, CR1, CR2 = 0.02, 20.0, 0.925, 0.15
LAW = MenegottoPinto(E, FY, B, R0, CR1, CR2)
ROUNDING = 1e-10 * FY


def drive(targets: list[float], steps: int = 10) -> tuple[np.ndarray, np.ndarray]:
    """Strain (eps_y) and stress along targets in eps_y."""
    s = oscillator(E, 0.0, LAW)
    s.model.nodal_load(s.pattern, s.nodes[1], fx=1.0)
    a = s.analysis(tolerance=1e-12)
    strain, stress = [np.zeros(1)], [np.zeros(1)]
    channels = [channel("displacement", s.nodes[1], 0, "u"), channel("axial_force", s.elements[0], 0, "s")]
    for target in targets:
        r = a.pushover(s.pattern, s.nodes[1], "ux", target * YIELD, steps, channels)
        assert r.status == "completed", r.reason
        strain.append(r.values["u"][1:] / YIELD)
        stress.append(r.values["s"][1:])
    return np.concatenate(strain), np.concatenate(stress)


def curve(e: np.ndarray, er: float, sr: float, direction: float, extreme: float, virgin: bool = False) -> np.ndarray:
    """One branch in strains over eps_y and stresses over fy."""
    e0 = (direction * (1 - B) - sr + er) / (1 - B)
    s0 = sr + e0 - er
    xi = 0.0 if virgin else abs(extreme - e0)
    R = R0 * (1 - CR1 * xi / (CR2 + xi))
    x = (e - er) / (e0 - er)
    return sr + (s0 - sr) * (B * x + (1 - B) * x / (1 + np.abs(x) ** R) ** (1 / R))


def test_virgin_curve() -> None:
    strain, stress = drive([8.0], 80)
    expected = FY * curve(strain, 0.0, 0.0, 1.0, 0.0, virgin=True)
    np.testing.assert_allclose(stress, expected, atol=ROUNDING)


def test_reversal_rule() -> None:
    """Large reversals, every one beyond the last: each branch starts at the reversal with R of the extreme strains."""
    targets = [3.0, -4.0, 5.0, -7.0, 8.0]
    strain, stress = drive(targets, 25)
    er = sr = 0.0
    high, low = 1.0, -1.0
    for k, target in enumerate(targets):
        direction = 1.0 if target > er else -1.0
        part = slice(25 * k + 1, 25 * k + 26)
        expected = curve(strain[part], er, sr, direction, high if direction > 0 else low, virgin=k == 0)
        np.testing.assert_allclose(stress[part] / FY, expected, atol=1e-10, err_msg=f"branch {k}")
        er, sr = target, float(expected[-1])
        high, low = max(high, target), min(low, target)


def test_initial_slope_of_unloading_is_elastic() -> None:
    """Slope at the reversal; |e*|^R with R > 1.5 is below 1e-3 for this step."""
    strain, stress = drive([4.0, 3.99], 1)
    assert (stress[2] - stress[1]) / (E * YIELD * (strain[2] - strain[1])) == pytest.approx(1.0, rel=2e-3)


@pytest.mark.parametrize("peak", [0.5, 1.0, 1.5, 4.0])
@pytest.mark.parametrize("drop", [0.01, 0.1, 0.4])
def test_no_overshoot_after_a_small_unloading(peak: float, drop: float) -> None:
    """Reloading never rises above the curve without unloading and comes back to it."""
    strain, stress = drive([peak, peak - drop, peak + 3.0], 60)
    backbone = FY * curve(strain, 0.0, 0.0, 1.0, 0.0, virgin=True)
    assert np.all(stress <= backbone + ROUNDING)
    assert stress[-1] == pytest.approx(backbone[-1], abs=ROUNDING)


def test_no_overshoot_on_a_later_branch() -> None:
    """The same after a full cycle, where the classical rule rises most (R is small)."""
    strain, stress = drive([4.0, -4.0, 0.5, 0.3, 6.0], 60)
    branch = FY * curve(strain[-60:], -4.0, float(stress[120] / FY), 1.0, 4.0)
    assert np.all(stress[-60:] <= branch + ROUNDING)
    assert stress[-1] == pytest.approx(branch[-1], abs=ROUNDING)


@settings(max_examples=30, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.floats(1.2, 5.0), st.lists(st.floats(0.05, 1.0), min_size=1, max_size=6))
def test_no_overshoot_after_any_wiggles(peak: float, wiggles: list[float]) -> None:
    """Reversals inside reversals, anywhere between a little strain and the peak: still below the virgin curve.

    (A long way back makes a branch of smaller R, which comes up to the virgin curve only asymptotically.)
    """
    targets = [peak] + [0.02 + share * (peak - 0.04) for share in wiggles] + [peak + 3.0]
    targets = [t for k, t in enumerate(targets) if k == 0 or abs(t - targets[k - 1]) > 1e-6]
    strain, stress = drive(targets, 12)
    backbone = FY * curve(strain, 0.0, 0.0, 1.0, 0.0, virgin=True)
    assert np.all(stress <= backbone + ROUNDING)
    assert stress[-1] == pytest.approx(backbone[-1], rel=0.1)


@pytest.mark.parametrize("low, turn, drop", [(2.5, 3.2, 0.05), (1.0, 3.0, 0.3), (3.0, 3.8, 0.02), (-2.0, 3.0, 0.2)])
def test_no_overshoot_of_a_nested_branch(low: float, turn: float, drop: float) -> None:
    """A small unloading on a branch that itself began after an unloading from 4 eps_y: not above that branch either."""
    strain, stress = drive([4.0, low, turn, turn - drop, 4.0, 7.0], 40)
    plain_strain, plain = drive([4.0, low, turn, 4.0, 7.0], 40)
    start = float(stress[80] / FY)

    def undisturbed(e: np.ndarray) -> np.ndarray:
        """The branch from `low`, bounded by the virgin curve it came from if it is a small reversal."""
        branch = FY * curve(e, low, start, 1.0, 4.0)
        virgin = FY * curve(e, 0.0, 0.0, 1.0, 0.0, virgin=True)
        return np.minimum(branch, virgin) if low > 0.0 else branch

    np.testing.assert_allclose(plain[-80:], undisturbed(plain_strain[-80:]), atol=ROUNDING)
    assert np.max(stress[-80:] - undisturbed(strain[-80:])) / FY <= 1e-10


@settings(max_examples=20, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
@given(st.lists(st.floats(-6.0, 6.0), min_size=2, max_size=8))
def test_stress_stays_between_the_asymptotes(targets: list[float]) -> None:
    """No path leaves b E e +- (1 - b) fy."""
    targets = [t for k, t in enumerate(targets) if abs(t - (targets[k - 1] if k else 0.0)) > 1e-3]
    strain, stress = drive(targets, 8)
    assert np.all(np.abs(stress / FY - B * strain) <= (1 - B) * (1 + 1e-9))


def test_symmetry() -> None:
    """Tension and compression are alike."""
    path = [2.0, 1.5, 3.0, -2.0, -1.0, -5.0, 4.0]
    _, stress = drive(path)
    _, mirrored = drive([-t for t in path])
    np.testing.assert_array_equal(stress, -mirrored)
