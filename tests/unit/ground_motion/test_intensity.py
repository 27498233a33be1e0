"""Measures of a motion against integrals done by hand."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.intensity import displacement, husid, measures, velocity
from edesign.ground_motion.record import Record

G = 9.80665  # m/s2


def test_constant_acceleration() -> None:
    """v = a t, d = a t^2 / 2, Arias pi a^2 t / (2 g), CAV a t, durations 0.9 t and 0.7 t."""
    seconds, a = 8.0, -1.5
    m = measures(Record("constant", np.full(801, a), 0.01, "test"))
    assert m.pga == 1.5
    assert m.pgv == pytest.approx(12.0, rel=1e-12) and m.end_velocity == pytest.approx(-12.0, rel=1e-12)
    assert m.pgd == pytest.approx(48.0, rel=1e-12) and m.end_displacement == pytest.approx(-48.0, rel=1e-12)
    assert m.arias == pytest.approx(np.pi * 1.5**2 * seconds / (2.0 * G), rel=1e-12)
    assert m.cav == pytest.approx(12.0, rel=1e-12)
    assert m.duration_5_95 == pytest.approx(0.9 * seconds, rel=1e-12)
    assert m.duration_5_75 == pytest.approx(0.7 * seconds, rel=1e-12)


def test_ramp() -> None:
    """a = t: v = t^2 / 2 and d = t^3 / 6 at every sample; Husid's share is (t / end)^3."""
    t = np.arange(11) * 0.3
    np.testing.assert_allclose(velocity(t, 0.3), t**2 / 2.0, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(displacement(t, 0.3), t**3 / 6.0, rtol=1e-13, atol=1e-15)
    np.testing.assert_allclose(husid(t, 0.3), (t / t[-1]) ** 3, rtol=1e-13, atol=1e-15)


def test_durations_of_a_ramp_converge_to_cube_roots() -> None:
    """The time of a share s is end s^(1/3); linear within a step, so the error falls with the square of the step."""
    exact = 0.95 ** (1.0 / 3.0) - 0.05 ** (1.0 / 3.0)
    errors = [
        abs(measures(Record("r", np.linspace(0, 1, n + 1), 1.0 / n, "t")).duration_5_95 - exact) for n in (7, 700)
    ]
    assert errors[0] < 0.02 and errors[1] < 2e-6


def test_sine() -> None:
    """Ten cycles of A sin: v goes from 0 to 2 A / omega, Arias pi A^2 t / (4 g), CAV 2 A t / pi.

    The polygon through m samples a cycle has (h / 2) / tan(h / 2) of the area and (2 + cos h) / 3 of the mean square,
    h = 2 pi / m.
    """
    amplitude, period, m, cycles = 2.0, 0.8, 40, 10
    h = 2.0 * np.pi / m
    area, square = 0.5 * h / np.tan(0.5 * h), (2.0 + np.cos(h)) / 3.0
    seconds = cycles * period
    samples = amplitude * np.sin(h * np.arange(m * cycles + 1))
    samples[:: m // 2] = 0.0  # where sin is zero but for rounding
    got = measures(Record("sine", samples, period / m, "test"))
    assert got.pgv == pytest.approx(2.0 * amplitude * period / (2.0 * np.pi) * area, rel=1e-12)
    assert got.end_velocity == pytest.approx(0.0, abs=1e-12)
    # the mean velocity is half the largest; a polygon displaces like its own samples of area
    assert got.end_displacement == pytest.approx(0.5 * got.pgv * seconds, rel=1e-12)
    assert got.pgd == pytest.approx(got.end_displacement, rel=1e-12)
    assert got.cav == pytest.approx(2.0 / np.pi * amplitude * seconds * area, rel=1e-12)
    assert got.arias == pytest.approx(np.pi / (2.0 * G) * 0.5 * amplitude**2 * seconds * square, rel=1e-12)
    assert got.duration_5_95 == pytest.approx(0.9 * seconds, abs=period / 4.0)


def test_absolute_velocity_across_a_change_of_sign() -> None:
    """From 1 to -3 in a second: triangles of 1/4 s and 3/4 s, 1/8 + 9/8."""
    assert measures(Record("crossing", np.array([1.0, -3.0]), 1.0, "test")).cav == pytest.approx(1.25, rel=1e-14)


def test_silence() -> None:
    m = measures(Record("silence", np.zeros(5), 0.01, "test"))
    assert (m.pga, m.pgv, m.pgd, m.arias, m.cav, m.duration_5_95, m.duration_5_75) == (0.0,) * 7
    assert np.all(husid(np.zeros(5), 0.01) == 0.0)


def test_scaling() -> None:
    """Peaks and CAV are proportional to the factor, Arias to its square; durations do not change."""
    record = Record("noise", np.random.default_rng(5).standard_normal(500), 0.01, "test")
    one, two = measures(record), measures(record.scaled(-2.0))
    assert (two.pga, two.pgv, two.pgd, two.cav) == (2 * one.pga, 2 * one.pgv, 2 * one.pgd, 2 * one.cav)
    assert two.arias == 4.0 * one.arias
    assert (two.duration_5_95, two.duration_5_75) == (one.duration_5_95, one.duration_5_75)


@pytest.mark.parametrize("function", [velocity, displacement, husid])
def test_bad_input(function) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(InputError, match="E-SPEC-01"):
        function([1.0], 0.01)
    with pytest.raises(InputError, match="E-SPEC-01"):
        function([1.0, np.nan], 0.01)
    with pytest.raises(InputError, match="E-REC-20"):
        function([1.0, 2.0], -1.0)
