"""Cubic splines of many histories on one grid, against scipy's and against cubics."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from edesign.calibration.signals.spline import Spline


@pytest.mark.parametrize("n", [2, 3, 4, 5, 200])
def test_it_is_the_spline_of_scipy(n: int) -> None:
    random = np.random.default_rng(n)
    time = np.cumsum(random.uniform(0.002, 0.05, n))
    values = random.standard_normal(n)
    spline, expected = Spline(time), CubicSpline(time, values)  # not-a-knot as well
    at = np.linspace(time[0] - 0.01, time[-1] + 0.01, 777)  # beyond the ends too
    scale = np.max(np.abs(expected(at)))
    np.testing.assert_allclose(spline.at(values, at), expected(at), atol=1e-11 * scale)  # rounding
    np.testing.assert_allclose(spline.slopes(values), expected(time, 1), rtol=1e-9)


def test_cubics_are_met_exactly() -> None:
    time = np.array([0.0, 0.1, 0.15, 0.4, 0.41, 1.0])
    spline, cubic = Spline(time), np.poly1d([2.0, -3.0, 0.5, 7.0])
    at = np.linspace(0.0, 1.0, 50)
    np.testing.assert_allclose(spline.at(cubic(time), at), cubic(at), rtol=1e-12)
    np.testing.assert_allclose(spline.slopes(cubic(time)), cubic.deriv()(time), atol=1e-12)
