"""Spectra as tables: a power law is met exactly by log-log interpolation, a straight line by the linear one."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.codes.asce7 import AsceSpectrum, damping_coefficient
from edesign.codes.ec8 import SET_RULES, ElasticSpectrum, damping_correction, national_parameters
from edesign.codes.spectrum import Spectrum, characteristic_period
from edesign.codes.tabulated import Correction, Interpolation, TabulatedSpectrum
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
    with pytest.raises(InputError, match="4 s; .* 4.5 s .*E-CURVE-03"):
        table().acceleration([1.0, 4.5])
    assert table().with_damping(0.05) == table()
    with pytest.raises(InputError, match="5 % .* 10 % .*E-CURVE-04"):
        table().with_damping(0.10)


def of_code(spectrum: Spectrum, correction: Correction | None) -> TabulatedSpectrum:
    """A table of a code's spectrum at its corners, between which it is a straight line or a power of T."""
    periods = (0.0, *spectrum.corners.values(), 10.0)
    ordinates = tuple(spectrum.acceleration(periods).tolist())
    return TabulatedSpectrum(periods, ordinates, spectrum.damping, SET_RULES, correction=correction)


EC8 = ElasticSpectrum(2.0, national_parameters(None).horizontal(1, "C"))
ASCE = AsceSpectrum(10.0, 6.0, 6.0)


@pytest.mark.parametrize(("spectrum", "correction"), [(EC8, "ec8"), (ASCE, "asce7")])
@pytest.mark.parametrize("tabulated", [0.02, 0.05, 0.10])
@pytest.mark.parametrize("wanted", [0.01, 0.05, 0.17, 0.50])
def test_a_table_of_a_code_changes_with_damping_as_the_code(
    spectrum: Spectrum, correction: Correction, tabulated: float, wanted: float
) -> None:
    """A table of the spectrum of one damping gives that of another: EN 1998-1, Eqs. 3.2-3.6, ASCE 41-17, 2.4.1.7.1."""
    T = np.linspace(0.0, 10.0, 2001)
    found = of_code(spectrum.with_damping(tabulated), correction).with_damping(wanted)
    np.testing.assert_allclose(found.acceleration(T), spectrum.with_damping(wanted).acceleration(T), rtol=1e-9)
    assert found.zero_period == pytest.approx(spectrum.zero_period) and found.damping == wanted


def test_a_corrected_table_goes_back_to_its_own_damping() -> None:
    first = of_code(EC8, "ec8")
    T = np.linspace(0.0, 10.0, 101)
    again = first.with_damping(0.17).with_damping(0.30).with_damping(0.05)
    np.testing.assert_allclose(again.acceleration(T), first.acceleration(T), rtol=1e-12)


def test_a_dip_before_the_largest_ordinate_keeps_what_it_has() -> None:
    """Ordinates below S(0) stay; a straight line through S(0) would go below zero there."""
    dipping = TabulatedSpectrum((0.0, 0.1, 0.5, 1.0), (2.0, 0.2, 5.0, 2.5), 0.05, SET_RULES, correction="ec8")
    found = dipping.with_damping(0.0).acceleration([0.0, 0.1, 0.5, 1.0])
    np.testing.assert_allclose(found, [2.0, 0.2, 5.0 * 2**0.5, 2.5 * 2**0.5], rtol=1e-12)


def test_the_corrections_are_those_of_the_codes() -> None:
    """eta = sqrt(10/22) at 17 %; B = 1.2 + 0.7 x 0.3 there."""
    assert damping_correction(0.17) == pytest.approx((10.0 / 22.0) ** 0.5)
    assert damping_coefficient(0.17) == pytest.approx(1.41)


def test_the_end_of_the_constant_branch() -> None:
    known = TabulatedSpectrum((0.0, 0.1, 0.5, 4.0), (2.0, 5.0, 5.0, 0.625), 0.05, SET_RULES, corner_period=0.5)
    assert characteristic_period(known) == 0.5 and characteristic_period(table()) is None


@pytest.mark.parametrize("corner", [0.05, 4.5])
def test_a_corner_period_outside_of_the_table(corner: float) -> None:
    with pytest.raises(InputError, match="corner_period: .* 0.1 s, .*E-CURVE-02"):
        TabulatedSpectrum((0.0, 0.1, 0.5, 4.0), (2.0, 5.0, 5.0, 0.625), 0.05, SET_RULES, corner_period=corner)


def test_tables_that_no_correction_applies_to() -> None:
    with pytest.raises(InputError, match="E-CURVE-04"):
        TabulatedSpectrum((0.0, 1.0), (2.0, 1.0), 0.05, SET_RULES, correction="asce7")
    with pytest.raises(InputError, match="0.55 for 30 % .*E-CURVE-04"):
        TabulatedSpectrum((0.0, 1.0), (1.0, 2.0), 0.30, SET_RULES, correction="ec8")


@pytest.mark.parametrize(
    ("periods", "ordinates"),
    [
        ((0.1, 1.0), (1.0, 1.0)),
        ((0.0,), (1.0,)),
        ((0.0, 1.0), (1.0,)),
        ((0.0, 1.0, 1.0), (1.0, 1.0, 1.0)),
        ((0.0, 1.0), (1.0, 0.0)),
        ((0.0, np.inf), (1.0, 1.0)),
    ],
)
def test_wrong_tables(periods: tuple[float, ...], ordinates: tuple[float, ...]) -> None:
    with pytest.raises(InputError, match="E-CURVE-01"):
        table(periods, ordinates)
