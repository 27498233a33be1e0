"""Rayleigh coefficients, and the damping of members with hinges."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from edesign.errors import InputError
from edesign.frame.damping import rayleigh_coefficients
from edesign.frame.hinges import _damping_factor


@given(st.floats(0.1, 100.0), st.floats(1.01, 50.0), st.floats(0.001, 0.5))
def test_both_modes_get_the_ratio(omega: float, factor: float, ratio: float) -> None:
    """zeta = a0 / (2 w) + a1 w / 2 (Chopra, Eq. 11.4.8)."""
    a0, a1 = rayleigh_coefficients(omega, factor * omega, ratio)
    for w in (omega, factor * omega):
        assert a0 / (2 * w) + a1 * w / 2 == pytest.approx(ratio, rel=1e-12)


def test_known_coefficients() -> None:
    """5 % at 1 and 3 rad/s: a1 = 0.1 / 4, a0 = 3 a1."""
    assert rayleigh_coefficients(3.0, 1.0, 0.05) == pytest.approx((0.075, 0.025), rel=1e-14)


@pytest.mark.parametrize("pair", [(0.0, 1.0), (1.0, -1.0), (math.nan, 1.0), (2.0, 2.0), (math.inf, 1.0)])
def test_impossible_frequencies(pair: tuple[float, float]) -> None:
    with pytest.raises(InputError, match="E-VALUE-0[24]"):
        rayleigh_coefficients(*pair, 0.02)


@pytest.mark.parametrize("n", [1.0, 3.0, 10.0])
def test_damping_of_a_member_with_hinges(n: float) -> None:
    """Exact in double curvature, 1 + 2 / (3 n) in single curvature and nowhere more: flexibilities in series, by hand.

    The member between its hinges of (n + 1) 6 E I / L has damping in proportion to its stiffness, times a factor.
    """
    EI, L = 3e7, 4.0
    plain = L / EI * np.array([[1 / 3, -1 / 6], [-1 / 6, 1 / 3]])
    hinge = L / (6.0 * EI * (n + 1.0))
    inner = plain - hinge * np.eye(2)
    turned = inner @ np.linalg.inv(plain)  # rotations of the member between the hinges under those of the ends
    damping = _damping_factor([hinge, hinge], EI, L) * turned.T @ np.linalg.inv(inner) @ turned
    ratios = np.linalg.eigvals(plain @ damping).real
    np.testing.assert_allclose(sorted(ratios), [1.0, 1.0 + 2.0 / (3.0 * n)], rtol=1e-12)
