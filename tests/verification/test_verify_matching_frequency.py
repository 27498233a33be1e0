"""Matching by a factor on the Fourier spectrum: fixed point, scaling, phase, untouched frequencies, convergence, drift.

Spectra are checked with oscillators of this file (scipy's first-order hold), not with those that the method uses.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from scipy.signal import cont2discrete, dlsim
from shared_records import needs_recordings, recordings

from edesign.codes.ec8 import ElasticSpectrum, HorizontalParameters
from edesign.ground_motion.intensity import displacement, velocity
from edesign.ground_motion.matching import Match, MatchOptions, match_record
from edesign.ground_motion.matching.closeness import Closeness
from edesign.ground_motion.matching.fourier_factor import FourierFactor
from edesign.ground_motion.matching.frequency import adjust
from edesign.ground_motion.matching.sensitivity import Sensitivity
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa

G = 9.80665  # m/s2
DBE = ElasticSpectrum(
    0.36 * G, HorizontalParameters(ground="C", spectrum_type=1, S=1.15, T_B=0.2, T_C=0.6, T_D=2.0), label="DBE"
)
OPTIONS = MatchOptions(method="frequency")


@dataclass(frozen=True)
class Times:
    """A target times a factor."""

    of: Any
    factor: float
    damping: float = 0.05
    label: str = "target times a factor"
    last_period: float = np.inf

    @property
    def zero_period(self) -> float:
        return self.factor * float(self.of.zero_period)

    def acceleration(self, period: Any) -> np.ndarray:
        return self.factor * np.asarray(self.of.acceleration(period))

    def displacement(self, period: Any) -> np.ndarray:
        return self.factor * np.asarray(self.of.displacement(period))


def synthetic(seed: int = 11, step: float = 0.01, seconds: float = 40.0) -> Record:
    """Noise filtered by the ground (Kanai-Tajimi, 2.5 Hz, 60 %), high-passed, under an envelope; it ends at rest."""
    time = np.arange(round(seconds / step) + 1) * step
    envelope = (time / 6.0) ** 2 * np.exp(2.0 * (1.0 - time / 6.0))
    noise = envelope * np.random.default_rng(seed).normal(size=time.size)
    size = 2 * time.size
    frequency = np.fft.rfftfreq(size, step)
    ground = (1.0 + 1.2j * frequency / 2.5) / (1.0 - (frequency / 2.5) ** 2 + 1.2j * frequency / 2.5)
    high = (frequency / 0.2) ** 4 / (1.0 + (frequency / 0.2) ** 4)
    motion = np.fft.irfft(np.fft.rfft(noise, size) * ground * high, size)[: time.size]
    x = time / time[-1]
    bumps = [x**2 * (1.0 - x) ** 2, x**3 * (1.0 - x) ** 2]
    ends = [[f(a, step)[-1] for a in (*bumps, motion)] for f in (velocity, displacement)]
    first, second = np.linalg.solve(np.array(ends)[:, :2], np.array(ends)[:, 2])
    return Record("synthetic", motion - first * bumps[0] - second * bumps[1], step, "synthetic")


def independent_psa(record: Record, periods: np.ndarray, damping: float = 0.05) -> np.ndarray:
    """Pseudo-acceleration by scipy's discretisation of the oscillator for linear interpolation between samples."""
    peaks = []
    for period in periods:
        w = 2.0 * np.pi / period
        system = (
            np.array([[0.0, 1.0], [-w * w, -2.0 * damping * w]]),
            np.array([[0.0], [-1.0]]),
            np.eye(2),
            np.zeros((2, 1)),
        )
        _, u, _ = dlsim(cont2discrete(system, record.time_step, method="foh"), record.acceleration)
        peaks.append(w * w * np.max(np.abs(u[:, 0])))
    return np.array(peaks)


@pytest.fixture(scope="module")
def matched() -> Match:
    return match_record(synthetic(), DBE, OPTIONS)


def test_scaling_twice_the_target_gives_twice_the_motion(matched: Match) -> None:
    double = match_record(synthetic(), Times(DBE, 2.0), OPTIONS)
    assert double.matched.acceleration == pytest.approx(2.0 * matched.matched.acceleration, rel=1e-12, abs=1e-12)


def test_scaling_the_record_does_not_matter(matched: Match) -> None:
    half = match_record(synthetic().scaled(0.5), DBE, OPTIONS)
    assert half.matched.acceleration == pytest.approx(matched.matched.acceleration, rel=1e-6, abs=1e-6)


def test_a_matched_record_matched_again_to_a_multiple_is_that_multiple(matched: Match) -> None:
    # its misfit is below the tolerance now: nothing is left to do but to scale it
    motion, periods = matched.matched, OPTIONS.matching_periods
    measure = Closeness(DBE.acceleration, periods, motion.time_step, OPTIONS.damping, DBE.zero_period)
    options = replace(OPTIONS, tolerance=1.05 * measure(motion.acceleration))
    again = match_record(matched.matched, Times(DBE, 1.7), options)
    assert again.iterations == 0
    # the best constant factor in the logarithms is within the misfit of one
    assert again.scale == pytest.approx(1.7, rel=min(matched.history))


def test_the_factor_is_real_and_one_outside_of_its_band() -> None:
    step, samples = 0.01, 3000
    factor = FourierFactor(samples, step, 0.5, 8.0, 0.3)
    motion = np.zeros(samples)
    motion[samples // 2] = 1.0  # an impulse: all frequencies alike
    theta = 0.5 * np.sin(np.arange(factor.nodes.size))
    theta[[0, -1]] = 0.0
    spectrum, added = np.fft.rfft(motion, factor.length), np.fft.rfft(factor.added(motion, theta), factor.length)
    ratio, frequency = 1.0 + added / spectrum, np.fft.rfftfreq(factor.length, step)
    within = (frequency > 0.5) & (frequency < 8.0)
    # what the factor adds is cut at the ends of the duration, 15 s from the impulse, where it has nearly decayed
    expected = np.exp(np.interp(np.log(frequency[within]), np.log(factor.nodes), theta))
    assert np.max(np.abs(ratio[within] - expected)) < 0.02
    assert np.max(np.abs(ratio[~within] - 1.0)) < 0.02


def test_frequencies_below_and_above_the_band_keep_their_fourier_amplitudes() -> None:
    options = replace(OPTIONS, periods=(0.2, 2.0))
    match = match_record(synthetic(), DBE, options)
    step, size = match.scaled.time_step, 2 * match.scaled.acceleration.size
    before, after = (np.fft.rfft(r.acceleration, size) for r in (match.scaled, match.matched))
    frequency = np.fft.rfftfreq(size, step)
    share = np.linalg.norm(after - before) / np.linalg.norm(before)
    assert share > 0.1  # something was done
    # transitions: 0.58 octaves below; the octave above serves the peak of the ground
    for outside in ((frequency > 0.0) & (frequency < 0.3), frequency > 11.0):
        change = np.linalg.norm((after - before)[outside]) / np.linalg.norm(after - before)
        assert change < 0.02  # what the taper and the drift correction leave there


def test_phases_stay(matched: Match) -> None:
    size = matched.scaled.acceleration.size
    before, after = (np.fft.rfft(r.acceleration) for r in (matched.scaled, matched.matched))
    turn = np.angle(after / before)
    energy = np.abs(after) ** 2
    frequency = np.fft.rfftfreq(size, matched.scaled.time_step)
    band = (frequency > 0.2) & (frequency < 20.0)
    # the factor turns nothing; tapers and the end of the duration turn a little where little energy is
    assert np.sqrt(np.average(turn[band] ** 2, weights=energy[band])) < np.radians(10.0)


def test_sensitivity_is_the_derivative_of_the_ordinates() -> None:
    record, periods = synthetic(), np.array([0.3, 0.8, 2.0])
    factor = FourierFactor(record.acceleration.size, record.time_step, 0.1, 20.0, 0.2)
    matrix = Sensitivity(factor, record.time_step, periods, 0.05).matrix(record.acceleration)
    ordinates, size = np.concatenate(([0.0], periods)), 1e-4
    for node in range(2, factor.nodes.size - 2, 4):
        theta = np.zeros(factor.nodes.size)
        theta[node] = size
        moved = [
            psa(
                record.acceleration + sign * factor.added(record.acceleration, sign * theta) * sign,
                record.time_step,
                ordinates,
            )
            for sign in (1.0, -1.0)
        ]
        central = (np.log(moved[0]) - np.log(moved[1])) / (2.0 * size)
        # the peak is that of a sample in one and of the polygon's maximum in the other: up to 1 % of the largest, 1
        assert matrix[:, node] == pytest.approx(central, abs=0.01)


def test_all_derivatives_of_an_ordinate_add_up_to_one() -> None:
    # a constant factor e^theta on everything multiplies the ordinate by e^theta; all energy is inside the nodes
    record, periods = synthetic(), np.array([0.1, 0.5, 3.0])
    factor = FourierFactor(record.acceleration.size, record.time_step, 0.01, 50.0, 0.1)
    matrix = Sensitivity(factor, record.time_step, periods, 0.05).matrix(record.acceleration)
    assert np.sum(matrix, axis=1) == pytest.approx(np.ones(4), rel=1e-12)


def test_a_synthetic_record_converges_to_the_design_spectrum(matched: Match) -> None:
    assert matched.misfit_before.rms > 0.2
    assert matched.misfit_after.rms < 0.03
    assert min(matched.history) == matched.history[int(np.argmin(matched.history))] < 0.1 * matched.history[0]
    assert matched.pga_ratio == pytest.approx(1.0, abs=0.15)


def test_the_misfit_holds_for_independent_oscillators(matched: Match) -> None:
    periods = np.geomspace(0.16, 6.0, 61)  # from 16 steps a period on, how samples are joined hardly matters
    ratio = independent_psa(matched.matched, periods) / DBE.acceleration(periods)
    assert np.sqrt(np.mean((ratio - 1.0) ** 2)) < 0.035


def test_no_drift(matched: Match) -> None:
    motion, step = matched.matched.acceleration, matched.matched.time_step
    assert abs(velocity(motion, step)[-1]) < 1e-6  # m/s
    assert abs(displacement(motion, step)[-1]) < 1e-6  # m
    assert matched.after.pgd < 2.0 * matched.before.pgd


def test_more_iterations_are_never_worse() -> None:
    record, periods = synthetic(), OPTIONS.matching_periods
    samples = 4.0 * record.with_zeros(6.0).acceleration
    reached = [
        min(
            adjust(
                samples, record.time_step, DBE.acceleration, periods, replace(OPTIONS, iterations=n), DBE.zero_period
            ).history
        )
        for n in (1, 3, 10, 20)
    ]
    assert reached == sorted(reached, reverse=True)


def test_without_the_peak_of_the_ground_nothing_above_the_transition_is_touched() -> None:
    record, periods = synthetic(), np.geomspace(0.2, 4.0, 60)
    samples = record.with_zeros(6.0).acceleration
    target = DBE.acceleration(periods)
    result = adjust(samples, record.time_step, DBE.acceleration, periods, OPTIONS)
    size = 2 * samples.size
    change = np.fft.rfft(result.acceleration - samples, size)
    frequency = np.fft.rfftfreq(size, record.time_step)
    assert np.linalg.norm(change[frequency > 1.6 / 0.2]) < 0.02 * np.linalg.norm(change)
    ratio = psa(result.acceleration, record.time_step, periods) / target
    assert np.sqrt(np.mean((ratio - 1.0) ** 2)) < 0.03


@pytest.mark.slow
@needs_recordings
def test_all_thesis_recordings_reach_the_design_spectrum() -> None:
    ratios = []
    for record in recordings():
        match = match_record(record, DBE, OPTIONS)
        assert match.misfit_after.rms < 0.05, record.name  # the bar; 0.018 to 0.033 when this was written
        assert match.misfit_after.rms < 0.2 * match.misfit_before.rms
        assert abs(match.after.end_velocity) < 1e-3 and abs(match.after.end_displacement) < 1e-3, record.name
        assert match.after.pgd < 1.5 * match.before.pgd, record.name
        ratios.append(match.pga_ratio)
    assert np.mean(ratios) >= 1.0  # EN 1998-1, 3.2.3.1.2(4)b: the mean peak of the ground is at least a_g S
