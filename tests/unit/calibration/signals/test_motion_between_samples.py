"""What a motion does between its samples, against motions in closed form: which spline, its error, what is told."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibration.signals.interpolation import CUBIC, SMOOTH, Interpolation, sampling_notes, through
from edesign.damper.testing.measured_histories import DamperTest

DT = 0.01  # s
T = DT * np.arange(1600)
INSIDE = slice(50, -50)  # ends of a record have samples on one side only


def error(u: np.ndarray, v: np.ndarray, degree: int) -> float:
    """Share of the power of the velocity that the spline of a degree errs by, away from the ends."""
    left = through(T, u, degree)(T, 1) - v
    return float(np.sum(left[INSIDE] ** 2) / np.sum(v[INSIDE] ** 2))


@pytest.mark.parametrize(("samples", "degree"), [(6, SMOOTH), (10, CUBIC), (20, CUBIC), (50, CUBIC)])
def test_sines(samples: int, degree: int) -> None:
    """A cubic spline multiplies the velocity of a sine by 3 sin(x)/(x (2 + cos(x))), x = 2 pi / samples."""
    omega = 2.0 * np.pi / samples
    u, v = np.sin(omega * T / DT + 0.3), omega / DT * np.cos(omega * T / DT + 0.3)
    found = Interpolation.of(T, u)
    assert found is not None and found.degree == degree
    cubic = (3.0 * np.sin(omega) / (omega * (2.0 + np.cos(omega))) - 1.0) ** 2
    assert error(u, v, CUBIC) == pytest.approx(cubic, rel=0.02)
    assert found.lost == pytest.approx(cubic if degree == CUBIC else error(u, v, SMOOTH), rel=0.05, abs=1e-10)
    assert found.samples_a_period == pytest.approx(samples, rel=0.15)
    assert found.lost < 1e-6  # less than a transducer shows: nothing is told


@pytest.mark.parametrize(("share", "most"), [(0.3, 1e-10), (0.6, 1e-5), (0.9, 0.1)])
def test_random_motion_that_ends_below_the_nyquist_frequency(share: float, most: float) -> None:
    """The cubic spline errs by up to a third of the velocity; the estimate holds within a factor of two."""
    random, turns = np.random.default_rng(1), int(share * np.pi / DT / 2.0 / np.pi * T[-1])
    omega = 2.0 * np.pi * np.arange(1, turns) / T[-1]
    phase = random.uniform(0.0, 2.0 * np.pi, omega.size)
    u = np.sin(np.outer(T, omega) + phase).sum(axis=1)
    v = (omega * np.cos(np.outer(T, omega) + phase)).sum(axis=1)
    found = Interpolation.of(T, u)
    assert found is not None and found.degree == SMOOTH
    assert error(u, v, SMOOTH) < most and error(u, v, SMOOTH) < 0.2 * error(u, v, CUBIC)
    assert 0.5 < found.lost / error(u, v, SMOOTH) < 2.0
    both = through(T, u, CUBIC)(T, 1) - through(T, u, SMOOTH)(T, 1)
    of_difference = found.of_difference(T.size)
    assert 0.5 < np.sum((of_difference * both**2)[INSIDE]) / np.sum(v**2) / found.lost < 2.0


def test_corners_keep_the_spline_that_rings_least() -> None:
    """A triangle of 50.3 samples a period: its velocity jumps, and the error is told within a factor of three."""
    phase = np.mod(T / DT / 50.3 + 0.0131, 1.0)
    u = np.where(phase < 0.5, 4.0 * phase - 1.0, 3.0 - 4.0 * phase)
    v = np.where(phase < 0.5, 4.0, -4.0) / (50.3 * DT)
    found = Interpolation.of(T, u)
    assert found is not None and found.degree == CUBIC and np.isnan(found.enough)
    assert 1.0 / 3.0 < found.lost / error(u, v, CUBIC) < 3.0


def test_what_is_told_of_a_test() -> None:
    def test(name: str, top: float) -> DamperTest:
        omega = 2.0 * np.pi * np.linspace(0.5, top, 80)
        phase = np.random.default_rng(2).uniform(0.0, 6.0, omega.size)
        u = 1e-3 * np.sin(np.outer(T, omega) + phase).sum(axis=1)
        return DamperTest(name, T, u, 1e6 * u, 20.0)

    (note,) = sampling_notes([test("slow", 5.0), test("fast", 40.0)])
    assert note.startswith("fast: 2.5 samples in a period of the fastest motion (40 Hz)")
    assert "of its velocity; 1" in note and note.endswith("samples a second would be enough")
    enough = Interpolation.of(T, test("fast", 40.0).displacement)
    assert enough is not None and 100.0 < enough.enough < 200.0
