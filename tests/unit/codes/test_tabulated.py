"""Spectra as tables: a power law is met exactly by log-log interpolation, a straight line by the linear one."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.codes.ec8 import SET_RULES
from edesign.codes.tabulated import Interpolation, TabulatedSpectrum
from edesign.errors import InputError


def table(
    periods: tuple[float, ...] = (0.0, 0.1, 0.5, 4.0),
    ordinates: tuple[float, ...] = (2.0, 5.0, 5.0, 0.625),
    interpolation: Interpolation = "log-log",
) -> TabulatedSpectrum:
    return TabulatedSpectrum(periods, ordinates, 0.05, SET_RULES, interpolation, label="UHS")


def test_a_power_law_between_two_rows() -> None:
    """From 5 at 0.5 s to 0.625 at 4 s S_e goes as 1/T: 2.5 / T."""
    T = np.array([0.5, 0.7, 1.0, 2.0, 3.9, 4.0])
    np.testing.assert_allclose(table().acceleration(T), 2.5 / T, rtol=1e-12)


def test_straight_lines() -> None:
    np.testing.assert_allclose(table().acceleration([0.0, 0.05, 0.1, 0.3]), [2.0, 3.5, 5.0, 5.0], rtol=1e-12)
    linear = table(interpolation="linear")
    np.testing.assert_allclose(linear.acceleration([0.05, 2.25]), [3.5, 2.8125], rtol=1e-12)


def test_displacement_and_peak() -> None:
    assert table().zero_period == 2.0 and table().last_period == 4.0
    assert float(table().displacement(2.0)) == pytest.approx(1.25 / np.pi**2, rel=1e-12)  # 1.25 (T / 2 pi)2


def test_nothing_beyond_the_table_and_no_other_damping() -> None:
    with pytest.raises(InputError, match="UHS ends at 4 s; it has no ordinate at 4.5 s"):
        table().acceleration([1.0, 4.5])
    assert table().with_damping(0.05) == table()
    with pytest.raises(InputError, match="for 5 % damping; what it would be for 10 % is not known"):
        table().with_damping(0.10)


@pytest.mark.parametrize(
    ("periods", "ordinates", "message"),
    [
        ((0.1, 1.0), (1.0, 1.0), "begins at 0 s"),
        ((0.0,), (1.0,), "two periods at least"),
        ((0.0, 1.0), (1.0,), "2 periods and 1 ordinates"),
        ((0.0, 1.0, 1.0), (1.0, 1.0, 1.0), "1 s stands after 1 s"),
        ((0.0, 1.0), (1.0, 0.0), "at 1 s must be greater than zero"),
        ((0.0, np.inf), (1.0, 1.0), "finite"),
    ],
)
def test_wrong_tables(periods: tuple[float, ...], ordinates: tuple[float, ...], message: str) -> None:
    with pytest.raises(InputError, match=message):
        table(periods, ordinates)
