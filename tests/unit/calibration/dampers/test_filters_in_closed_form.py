"""Systems of first and second order that a force passes, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibration.dampers.filters import relaxed, second_order
from edesign.calibration.dampers.motion import Motion


def _motion(time: np.ndarray) -> Motion:
    still = np.zeros_like(time)
    return Motion(time, still, still, still)


def _uneven(end: float = 2.0) -> np.ndarray:
    steps = np.random.default_rng(3).uniform(0.5, 1.5, 150)
    return np.concatenate(([0.0], np.cumsum(steps))) * end / float(steps.sum())


@pytest.mark.parametrize("tau", [1e-5, 1e-3, 0.0133, 0.05, 3.0, 1e6])
def test_a_cubic_force_is_relaxed_exactly(tau: float) -> None:
    # Q + tau Q' = t^3 - 2 t, Q(0) = 0: the polynomial t^3 - 3 tau t^2 + (6 tau^2 - 2) t - 6 tau^3 + 2 tau, and its
    # value at the beginning forgotten; steps from a thousand times to a millionth of tau
    time = _uneven()
    particular = np.poly1d([1.0, -3.0 * tau, 6.0 * tau**2 - 2.0, -6.0 * tau**3 + 2.0 * tau])
    # of a long tau the polynomial cancels: integrals of the force over powers of tau do not
    series = (time**4 / 4.0 - time**2) / tau - (time**5 / 20.0 - time**3 / 3.0) / tau**2
    expected = series if tau > 1e3 else particular(time) - particular(0.0) * np.exp(-time / tau)
    found = relaxed(_motion(time), time**3 - 2.0 * time, tau)
    np.testing.assert_allclose(found, expected, atol=1e-11 * np.max(np.abs(expected)))  # rounding


def test_a_second_order_channel_rings_as_in_closed_form() -> None:
    # a ramp t from rest: t - 2 zeta/w + exp(-zeta w t) (2 zeta/w cos wd t - (1 - 2 zeta^2)/wd sin wd t)
    time, f, zeta = _uneven(), 3.0, 0.2
    w = 2.0 * np.pi * f
    wd = w * np.sqrt(1.0 - zeta**2)
    decaying = 2.0 * zeta / w * np.cos(wd * time) - (1.0 - 2.0 * zeta**2) / wd * np.sin(wd * time)
    expected = time - 2.0 * zeta / w + np.exp(-zeta * w * time) * decaying
    np.testing.assert_allclose(second_order(_motion(time), time, f, zeta), expected, atol=1e-12)
