"""Elastic response spectra of ground acceleration, of one component or rotated over two."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.spectrum import peak_displacement, peak_responses, rotated_peak_displacement
from edesign.errors import InputError
from edesign.ground_motion.arguments import checked_dampings, checked_motion, checked_periods
from edesign.ground_motion.oscillators import over_periods

ANGLES = 180  # directions of rotated spectra in half a turn
PERIODS = np.geomspace(0.02, 10.0, 300)
"""Of the spectra of records that are not fitted, s."""


@dataclass(frozen=True)
class ResponseSpectra:
    """Peak responses of oscillators to one motion.

    Attributes:
        period: (n_T,) s.
        damping: (n_z,) ratio of critical.
        sd: (n_z, n_T) relative displacement, m.
        sv: (n_z, n_T) relative velocity, m/s.
        sa: (n_z, n_T) absolute acceleration, m/s2.
    """

    period: np.ndarray
    damping: np.ndarray
    sd: np.ndarray
    sv: np.ndarray
    sa: np.ndarray

    @property
    def psa(self) -> np.ndarray:
        """Pseudo acceleration omega^2 SD, (n_z, n_T), m/s2; the peak ground acceleration at period 0."""
        return np.where(self.period > 0.0, self.sd * _frequency(self.period) ** 2, self.sa)


def response_spectra(
    acceleration: ArrayLike, time_step: float, periods: ArrayLike, dampings: ArrayLike = (0.05,), threads: int = 1
) -> ResponseSpectra:
    """Return spectra of relative displacement, true relative velocity and true absolute acceleration.

    Args:
        acceleration: (n,) m/s2; the motion through them without content above their Nyquist frequency is meant.
        time_step: s.
        periods: (n_T,) s, in any order; 0 is the rigid oscillator.
        dampings: (n_z,) ratios of critical, 0 <= damping < 1.
        threads: how many to use; the result is the same bit for bit.

    Raises:
        InputError: fewer than two samples, one that is not finite, a time step that is not positive, a negative period,
            or a damping ratio out of range.

    Source: Nigam & Jennings (1969); docs/theory/response_spectra.md for what is done between samples.

    Examples:
        Fifty cycles of 1 m/s2 in resonance approach 1/(2 zeta), ten times the motion:

        >>> import numpy as np
        >>> motion = np.sin(2.0 * np.pi * np.arange(0.0, 50.0, 0.01))
        >>> spectra = edesign.response_spectra(motion, 0.01, periods=[0.0, 1.0], dampings=[0.05])
        >>> [f"{value:.1f}" for value in spectra.psa[0]]
        ['1.0', '10.0']
    """
    motion, step = checked_motion(acceleration, time_step)
    period, ratio = checked_periods(periods), checked_dampings(dampings)
    sd, sv, sa = (np.empty((ratio.size, period.size)) for _ in range(3))

    def task(motions: tuple[np.ndarray, ...], fine: float, at: np.ndarray, computed: np.ndarray) -> None:
        values = peak_responses(motions[0], fine, np.tile(computed, ratio.size), np.repeat(ratio, at.size))
        for spectrum, value in zip((sd, sv, sa), values, strict=True):
            spectrum[:, at] = value.reshape(ratio.size, at.size)

    computed = over_periods([motion], step, period, threads, task)
    share = (period / computed) ** 2  # of a static response, which is proportional to the square of the period
    sd *= share
    sv *= share
    sa[:, period == 0.0] = np.max(np.abs(motion))
    return ResponseSpectra(period, ratio, sd, sv, sa)


def psa(
    acceleration: ArrayLike, time_step: float, periods: ArrayLike, damping: float = 0.05, threads: int = 1
) -> np.ndarray:
    """Return the pseudo acceleration spectrum omega^2 SD for one damping ratio, quicker than `response_spectra`.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        periods: (n_T,) s, in any order; 0 gives the peak ground acceleration.
        damping: ratio of critical, 0 <= damping < 1.
        threads: how many to use; the result is the same bit for bit.

    Returns:
        (n_T,) m/s2.

    Raises:
        InputError: as for `response_spectra`.
    """
    motion, step = checked_motion(acceleration, time_step)
    period, ratio = checked_periods(periods), _one_damping(damping)
    sd = np.empty(period.size)

    def task(motions: tuple[np.ndarray, ...], fine: float, at: np.ndarray, computed: np.ndarray) -> None:
        sd[at] = peak_displacement(motions[0], fine, computed, np.full(at.size, ratio))

    computed = over_periods([motion], step, period, threads, task)
    spectrum = sd * (period / computed) ** 2 * _frequency(period) ** 2
    spectrum[period == 0.0] = np.max(np.abs(motion))
    return np.asarray(spectrum)


def rotated_spectra(
    first: ArrayLike,
    second: ArrayLike,
    time_step: float,
    periods: ArrayLike,
    damping: float = 0.05,
    percentiles: Sequence[float] = (50, 100),
    threads: int = 1,
) -> np.ndarray:
    """Return percentiles over all directions of the pseudo acceleration of two horizontal components.

    RotD50 and RotD100 are such percentiles. The peak displacement of the rotated motion is taken in steps of one
    degree, for each period by itself.

    Args:
        first: (n,) m/s2.
        second: (n,) m/s2, at right angles to it, with the same time axis.
        time_step: s, of both.
        periods: (n_T,) s; 0 gives the percentiles of the peak ground acceleration.
        damping: ratio of critical, 0 <= damping < 1.
        percentiles: from 0 to 100; between two directions linear.
        threads: how many to use; the result is the same bit for bit.

    Returns:
        (n_percentiles, n_T) m/s2.

    Raises:
        InputError: as for `response_spectra`, components of different length, or a percentile out of range.

    Source: Boore (2010).
    """
    a, step = checked_motion(first, time_step)
    b, _ = checked_motion(second, time_step)
    if a.size != b.size:
        raise InputError(
            f"rotated spectra: both components need the same samples, but one has {a.size} and the other {b.size}"
            " [E-SPEC-01]"
        )
    shares = np.array(percentiles, dtype=float, ndmin=1)
    wrong = ~((shares >= 0.0) & (shares <= 100.0))
    if wrong.any():
        raise InputError(f"rotated spectra: a percentile must be from 0 to 100, not {shares[wrong][0]:g} [E-SPEC-02]")
    period, ratio = checked_periods(periods), _one_damping(damping)
    peaks = np.empty((period.size, ANGLES))

    def task(motions: tuple[np.ndarray, ...], fine: float, at: np.ndarray, computed: np.ndarray) -> None:
        one, two = motions
        peaks[at] = rotated_peak_displacement(one, two, fine, computed, np.full(at.size, ratio), ANGLES)

    computed = over_periods([a, b], step, period, threads, task)
    peaks *= ((period / computed) ** 2 * _frequency(period) ** 2)[:, None]
    if np.any(period == 0.0):
        turn = np.pi * np.arange(ANGLES) / ANGLES
        peaks[period == 0.0] = [np.max(np.abs(np.cos(angle) * a + np.sin(angle) * b)) for angle in turn]
    return np.asarray(np.percentile(peaks, shares, axis=1))


def _one_damping(damping: float) -> float:
    ratio = checked_dampings(damping)
    if ratio.size != 1:
        raise InputError(f"damping: one ratio is needed here, not {ratio.size} [E-SPEC-02]")
    return float(ratio[0])


def _frequency(period: np.ndarray) -> np.ndarray:
    """Circular frequency of each period, rad/s; 0 for period 0."""
    return np.divide(2.0 * np.pi, period, out=np.zeros_like(period), where=period > 0.0)
