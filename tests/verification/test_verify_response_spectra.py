"""Response spectra against closed solutions, limits, orders of convergence, and scipy's filters on a far finer grid.

Closed forms: Chopra, Dynamics of Structures (2012), 4.7 to 4.9. Reference: benchmarks/peers/scipy_spectrum.py, which
uses nothing of edesign; its own error is below 0.01 %, as a test below shows.
"""

from __future__ import annotations

import numpy as np
import pytest
import scipy.signal
from shared_records import needs_recordings, recordings

from benchmarks.peers.scipy_spectrum import noise_motion, reference_spectra, upsampled
from edesign.core.errors import CoreError
from edesign.core.spectrum import peak_displacement, peak_responses
from edesign.ground_motion.band_limited import polygon_samples
from edesign.ground_motion.band_limited import upsampled as upsampled_here
from edesign.ground_motion.intensity import displacement, velocity
from edesign.ground_motion.response_spectrum import psa, response_spectra, rotated_spectra

PERIODS = np.geomspace(0.02, 6.0, 60)


def bump(step: float, frequency: float = 2.0, width: float = 0.6) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Displacement 0.1 exp(-(t / width)^2) cos(2 pi frequency t), its rate and acceleration, at rest at both ends."""
    t = np.arange(round(8.0 / step) + 1) * step - 4.0
    q = 2.0 * np.pi * frequency
    factor = -2.0 / width**2
    envelope = np.exp(-((t / width) ** 2))
    d = envelope * np.cos(q * t)
    v = envelope * (factor * t * np.cos(q * t) - q * np.sin(q * t))
    a = envelope * ((factor + factor**2 * t**2 - q**2) * np.cos(q * t) - 2.0 * factor * t * q * np.sin(q * t))
    return 0.1 * d, 0.1 * v, 0.1 * a


def half_sine_response(pulse: float, period: float) -> float:
    """Largest displacement over the static one of an undamped oscillator under sin(pi t / pulse) (Chopra 4.8)."""
    p, omega = np.pi / pulse, 2.0 * np.pi / period
    t = np.linspace(0.0, pulse, 20001)
    u = (np.sin(p * t) - p / omega * np.sin(omega * t)) / (1.0 - (p / omega) ** 2)
    rate = (p * np.cos(p * pulse) - p * np.cos(omega * pulse)) / (1.0 - (p / omega) ** 2)
    return float(max(np.max(np.abs(u)), np.hypot(u[-1], rate / omega)))


def test_sudden_load_doubles_the_static_response() -> None:
    """Constant acceleration from rest: 1 + exp(-pi zeta / sqrt(1 - zeta^2)), 2 without damping; any steps a period."""
    periods = np.array([0.011, 0.05, 0.1, 0.3, 1.0, 4.0])
    for zeta in (0.0, 0.02, 0.05, 0.2, 0.6):
        expected = 1.0 + np.exp(-np.pi * zeta / np.sqrt(1.0 - zeta**2))
        # the peak is that of the harmonic through three samples: exact without damping, else to zeta (2 pi / 16)^4 / 4
        tolerance = 1e-6 if zeta == 0.0 else 6e-3 * zeta
        np.testing.assert_allclose(psa(np.ones(801), 0.01, periods, zeta), expected, rtol=tolerance)


def test_rectangular_pulse() -> None:
    """Undamped: 2 if the pulse lasts at least half a period, 2 sin(pi t / T) if it is shorter (Chopra 4.7)."""
    step, samples = 0.005, 81
    pulse = (samples - 0.5) * step  # the fall within a step has the area of half a step
    motion = np.concatenate((np.ones(samples), np.zeros(1000)))
    periods = np.array([0.3, 0.5, 0.7, 1.0, 1.5, 3.0])
    ratio = pulse / periods
    expected = np.where(ratio >= 0.5, 2.0, 2.0 * np.sin(np.pi * ratio))
    np.testing.assert_allclose(psa(motion, step, periods, 0.0), expected, rtol=1e-4)  # (pi step / T)^2 / 6


def test_half_sine_pulse() -> None:
    """The shock spectrum of a half-sine, in the pulse and after it (Chopra 4.8)."""
    step, pulse = 0.005, 0.5
    t = np.arange(round(2.0 / step)) * step
    motion = np.where(t <= pulse, np.sin(np.pi * t / pulse), 0.0)
    periods = np.array([0.12, 0.2, 0.31, 0.5, 0.9, 1.3, 2.0, 5.0])
    expected = [half_sine_response(pulse, period) for period in periods]
    np.testing.assert_allclose(psa(motion, step, periods, 0.0), expected, rtol=5e-4)  # the kinks are not band-limited


def test_orders_of_convergence() -> None:
    """A polygon through the samples errs with the square of the step, the corrected one with its fourth power."""
    period, zeta = np.array([0.4]), np.array([0.05])
    exact = peak_displacement(bump(0.0005)[2], 0.0005, period, zeta)[0]
    errors: dict[str, list[float]] = {"samples": [], "corners": []}
    for step in (0.02, 0.01, 0.005):
        motion = bump(step)[2]
        for name, polygon in (("samples", motion), ("corners", polygon_samples(motion))):
            errors[name].append(abs(peak_displacement(polygon, step, period, zeta)[0] / exact - 1.0))
    order = {name: np.log2(np.array(e[:-1]) / np.array(e[1:])) for name, e in errors.items()}
    np.testing.assert_allclose(order["samples"], 2.0, atol=0.15)
    assert order["corners"][0] > 3.5
    assert errors["corners"][1] < 1e-4 < errors["samples"][1]


def test_stiff_limit_is_the_peak_of_the_motion() -> None:
    """Short periods: the pseudo acceleration is the largest acceleration, between samples too."""
    motion = noise_motion(2000, 0.01)
    peak = np.max(np.abs(upsampled(motion, 64)))
    periods = np.array([1e-6, 1e-3, 2e-3])
    np.testing.assert_allclose(psa(motion, 0.01, periods), peak, rtol=3e-3)  # content at 25 Hz: (25 x 0.002)^2
    np.testing.assert_allclose(response_spectra(motion, 0.01, periods).sa[0], peak, rtol=3e-3)


def test_soft_limit_is_the_motion_of_the_ground() -> None:
    """Long periods: the mass stays where it was. The motion comes to rest, so nothing grows after it."""
    d, v, a = bump(0.01)
    spectra = response_spectra(a, 0.01, [1e5], (0.0, 0.05))
    # sampled peaks of the exact motion miss (2 pi 2 Hz 0.01 s / 2)^2 / 2 at most; damping adds 2 zeta omega v
    np.testing.assert_allclose(spectra.sd[:, 0], np.max(np.abs(d)), rtol=1e-3)
    np.testing.assert_allclose(spectra.sv[:, 0], np.max(np.abs(v)), rtol=2e-3)
    assert np.all(spectra.sa[:, 0] < 1e-4)


def test_integrals_of_the_same_motion() -> None:
    """Velocity and displacement of the bump, known in closed form, by the trapezoidal rule and its cubic."""
    d, v, a = bump(0.005)
    np.testing.assert_allclose(velocity(a, 0.005), v, atol=1e-3 * np.max(np.abs(v)))
    np.testing.assert_allclose(displacement(a, 0.005), d, atol=1e-3 * np.max(np.abs(d)))


def test_free_vibration_after_the_end_counts() -> None:
    """A record that ends in its strong phase: as if zeros followed, and more than what happens before its end."""
    step = 0.005
    motion = noise_motion(4000, step)[:600]
    left = np.arange(motion.size)[::-1] / 60.0
    motion = motion * np.sin(0.5 * np.pi * np.minimum(1.0, left)) ** 2
    long = np.concatenate((motion, np.zeros(1600)))
    periods = np.geomspace(0.2, 8.0, 30)
    cut, whole = response_spectra(motion, step, periods), response_spectra(long, step, periods)
    for kind in ("sd", "sv", "sa"):
        np.testing.assert_allclose(getattr(cut, kind), getattr(whole, kind), rtol=1e-4)
    omega = 2.0 * np.pi / periods[-1]
    oscillator = scipy.signal.lti([-1.0], [1.0, 0.1 * omega, omega**2])
    _, before_the_end, _ = scipy.signal.lsim(oscillator, motion, step * np.arange(motion.size))
    assert cut.sd[0, -1] > 1.1 * np.max(np.abs(before_the_end))


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.2])
def test_a_record_that_ends_with_a_jump(zeta: float) -> None:
    """The largest sample is the last; the fall to zero within the next step has a kink that peaks between samples miss.

    Reference: the polygon at 50 points a step by scipy.signal.lsim, exact for straight lines; at 16 steps a period.
    """
    step, fine = 0.01, 50
    omega = 2.0 * np.pi / (16.0 * step)
    oscillator = scipy.signal.lti(
        [[0.0, 1.0], [-(omega**2), -2.0 * zeta * omega]], [[0.0], [-1.0]], np.eye(2), [[0], [0]]
    )
    for length in range(30, 94, 9):
        motion = np.concatenate((np.zeros(5), np.linspace(0.0, 1.0, length) ** 2))
        corners = np.concatenate((motion, np.zeros(32)))
        at = np.arange((corners.size - 1) * fine + 1) / fine
        _, states, _ = scipy.signal.lsim(oscillator, np.interp(at, np.arange(corners.size), corners), at * step)
        u, v = states.T
        sd, sv, sa = (float(x[0]) for x in peak_responses(motion, step, np.array([16.0 * step]), np.array([zeta])))
        assert sd == pytest.approx(np.max(np.abs(u)), rel=0.01)
        assert sv == pytest.approx(np.max(np.abs(v)), rel=0.01)
        assert sa == pytest.approx(np.max(np.abs(omega**2 * u + 2.0 * zeta * omega * v)), rel=0.015)


def test_spectra_are_linear_in_the_motion() -> None:
    motion = noise_motion(2000, 0.01)
    one = response_spectra(motion, 0.01, PERIODS, (0.05, 0.2))
    other = response_spectra(-3.7 * motion, 0.01, PERIODS, (0.05, 0.2))
    for kind in ("sd", "sv", "sa"):
        np.testing.assert_allclose(getattr(other, kind), 3.7 * getattr(one, kind), rtol=1e-12)


def test_time_scales() -> None:
    """A motion played at half the speed gives the same pseudo acceleration at twice the period."""
    motion = noise_motion(3000, 0.0025)  # both steps are below the coarsest
    np.testing.assert_allclose(psa(motion, 0.005, 2.0 * PERIODS), psa(motion, 0.0025, PERIODS), rtol=1e-10)


def test_rotated_spectra_do_not_depend_on_the_axes() -> None:
    """Turning the pair by whole degrees turns the directions into each other."""
    first, second = noise_motion(2000, 0.01), noise_motion(2000, 0.01, seed=2)
    base = rotated_spectra(first, second, 0.01, PERIODS, percentiles=(0, 50, 84, 100))
    for degrees in (30.0, 77.0, 90.0, 180.0):
        c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
        turned = rotated_spectra(
            c * first + s * second, c * second - s * first, 0.01, PERIODS, percentiles=(0, 50, 84, 100)
        )
        np.testing.assert_allclose(turned, base, rtol=1e-9)


def test_rotated_spectra_by_rotating_the_motion() -> None:
    """Every direction by a spectrum of its own."""
    first, second = noise_motion(2000, 0.01), noise_motion(2000, 0.01, seed=2)
    periods = np.array([0.03, 0.1, 0.33, 1.0, 3.0])
    angles = np.radians(np.arange(180))
    all_directions = [psa(np.cos(x) * first + np.sin(x) * second, 0.01, periods) for x in angles]
    expected = np.percentile(all_directions, (0, 50, 100), axis=0)
    got = rotated_spectra(first, second, 0.01, periods, percentiles=(0, 50, 100))
    np.testing.assert_allclose(got, expected, rtol=1e-9)


def test_linearly_polarised_motion() -> None:
    """All of it along one line: RotD100 is the spectrum along it, RotD50 that times cos 45 degrees."""
    motion = noise_motion(2000, 0.01)
    along = psa(motion, 0.01, PERIODS)
    for degrees in (0.0, 33.0, 90.0):
        pair = np.cos(np.radians(degrees)) * motion, np.sin(np.radians(degrees)) * motion
        median, largest = rotated_spectra(*pair, 0.01, PERIODS)
        np.testing.assert_allclose(largest, along, rtol=1e-9)
        np.testing.assert_allclose(median, along * np.sqrt(0.5), rtol=1e-9)


def test_upsampling_agrees_with_an_independent_one() -> None:
    """The same motion between samples, away from the ends, where the continuation beyond them differs."""
    motion = noise_motion(1000, 0.01)
    (here,) = upsampled_here(motion, [8])
    np.testing.assert_allclose(here, upsampled(motion, 8), atol=1e-4 * np.max(np.abs(motion)))
    assert np.array_equal(here[::8], motion)


# each step and each damping ratio once; the other pairs are slow
@pytest.mark.parametrize(
    ("step", "damping"),
    [
        pytest.param(step, damping, marks=[pytest.mark.slow] * (i != j))
        for i, step in enumerate((0.02, 0.01, 0.005))
        for j, damping in enumerate((0.2, 0.01, 0.05))
    ],
)
def test_synthetic_motion_against_scipy(step: float, damping: float) -> None:
    """Displacement within 0.1 %, acceleration 0.2 %, velocity 0.5 % at every period.

    Harsher than recordings: content up to 25 Hz at full strength, which shows in velocity and in strongly damped
    acceleration between the samples that the oscillator's period alone asks for.
    """
    motion = noise_motion(round(20.0 / step), step)
    spectra = response_spectra(motion, step, PERIODS, damping)
    for got, expected, tolerance in zip(
        (spectra.sd, spectra.sv, spectra.sa),
        reference_spectra(motion, step, PERIODS, damping),
        (1e-3, 5e-3, 2e-3),
        strict=True,
    ):
        np.testing.assert_allclose(got[0], expected, rtol=tolerance)


@pytest.mark.slow
@needs_recordings
def test_real_records_against_scipy() -> None:
    """Every real record, 5 % damping; 0.062, 0.16 and 0.048 % were measured, of 200 periods."""
    for record in recordings():
        spectra = response_spectra(record.acceleration, record.time_step, PERIODS)
        expected = reference_spectra(record.acceleration, record.time_step, PERIODS, 0.05)
        for got, reference, tolerance in zip(
            (spectra.sd, spectra.sv, spectra.sa), expected, (1e-3, 3e-3, 1e-3), strict=True
        ):
            np.testing.assert_allclose(got[0], reference, rtol=tolerance, err_msg=record.name)


def test_the_reference_has_converged() -> None:
    """Four times finer changes it by less than 0.01 %."""
    motion, periods = noise_motion(2000, 0.01), PERIODS[::6]
    coarse = reference_spectra(motion, 0.01, periods, 0.05)
    fine = reference_spectra(motion, 0.01, periods, 0.05, resolution=1600, factor=64)
    np.testing.assert_allclose(coarse, fine, rtol=1e-4)


def test_core_refuses_what_it_cannot_follow() -> None:
    """Periods below four steps have to be upsampled first; the message comes from the core."""
    with pytest.raises(CoreError, match="invalid argument"):
        peak_responses(np.ones(10), 0.01, np.array([0.039]), np.array([0.05]))
