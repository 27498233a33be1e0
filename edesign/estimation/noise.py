"""How residuals are weighted: noise of the channels, and correlated discrepancy that a model leaves beyond it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

FIRST = 0.05
"""Of the size of measured values: what a fair model leaves."""
MOST = 2.0
"""Times its floor, up to which an error (NRMS, a power) is noise alone: 1.4 times the noise in rms. Estimates of noise
from spectra, and of what does not repeat from a few cycles, are no better."""
_CHANCE = 0.01  # with which noise alone makes one of all tests seem to be above its floor
_LEAST = 1e-12  # share of the largest size of measured values: no residual is known to be smaller


@dataclass(frozen=True)
class Noise:
    """What stands between predictions and measured values, of each test.

    It is white noise of the channel, and discrepancy of a size that is one share of the size of the measured values in
    all tests, correlated over some time. Their long-run variance L (variance times correlation length) is what
    n samples determine a parameter as if n v / L of them were independent.

    Attributes:
        variance: (tests,) v, of a residual.
        long_run: (tests,) L >= v.
    """

    variance: tuple[float, ...]
    long_run: tuple[float, ...]

    def __post_init__(self) -> None:
        if not all(0.0 < v <= long and v < math.inf for v, long in zip(self.variance, self.long_run, strict=True)):
            raise ValueError(f"variances {self.variance} must be positive, and at most {self.long_run}")

    @staticmethod
    def white(deviations: Sequence[float]) -> Noise:
        """Return the noise of the channels alone, of standard deviations (tests,)."""
        variance = tuple(float(one) ** 2 for one in deviations)
        return Noise(variance, variance)

    @staticmethod
    def of_first_fit(deviations: Sequence[float], sizes: Sequence[float]) -> Noise:
        """Return the noise under which a model is fitted before it is known what it leaves.

        Args:
            deviations: (tests,) standard deviations of the channels' noise.
            sizes: (tests,) root mean square of the measured values.
        """
        return Noise.white([max(FIRST * size, one) for one, size in zip(deviations, sizes, strict=True)])

    @staticmethod
    def left_by(residuals: Sequence[np.ndarray], deviations: Sequence[float], sizes: Sequence[float]) -> Noise:
        """Return the noise of the channels with the discrepancy that residuals of a model show.

        Args:
            residuals: (n_i,) of each test, in the unit of the measured values.
            deviations: (tests,) standard deviations of the channels' noise.
            sizes: (tests,) root mean square of the measured values.
        """
        power = np.asarray(sizes, dtype=float) ** 2
        white = np.maximum(np.asarray(deviations, dtype=float) ** 2, _LEAST**2 * power.max())
        samples = np.array([r.size for r in residuals], dtype=float)
        found = np.array([float(r @ r) / r.size for r in residuals])
        lasting = np.array([one * correlation_length(r) for one, r in zip(found, residuals, strict=True)])

        def share(values: np.ndarray) -> float:
            return max(float(np.sum(samples * (values - white)) / max(np.sum(samples * power), 1e-300)), 0.0)

        variance, long_run = white + share(found) * power, white + share(lasting) * power
        return Noise(tuple(variance.tolist()), tuple(np.maximum(long_run, variance).tolist()))

    def weight(self, test: int) -> float:
        """Return the factor of residuals and slopes of a test."""
        return 1.0 / math.sqrt(self.long_run[test])

    def without(self, test: int) -> Noise:
        """Return the noise with which a test says nothing."""
        return replace(self, long_run=tuple(math.inf if i == test else one for i, one in enumerate(self.long_run)))

    def independent(self, test: int, samples: int) -> float:
        """Return how many samples of a test would say as much as these many if they were independent."""
        return samples * self.variance[test] / self.long_run[test]


def most_noise(samples: int, tests: int) -> float:
    """Return the mean square that noise may leave of a test, over its variance: more has another cause.

    Args:
        tests: how many are asked, of which chance makes one seem to be above.
    """
    from scipy.special import chdtri  # scipy takes time at the start of every command

    return MOST * float(chdtri(samples, _CHANCE / tests)) / samples


def correlation_length(residual: np.ndarray) -> float:
    """Return the number of samples over which a residual (n,) is correlated: 1 for white noise.

    It is the sum of the autocorrelations by the initial positive sequence.

    Source: Geyer (1992), Practical Markov chain Monte Carlo, Statistical Science 7, 473-483, section 3.3.
    """
    n = residual.size
    r = residual - residual.mean()
    power = float(r @ r)
    if power <= 0.0 or n < 4:
        return 1.0
    size = 1 << (2 * n - 1).bit_length()
    spectrum = np.fft.rfft(r, size)
    rho = np.fft.irfft(spectrum * np.conj(spectrum), size)[: n // 2] / power
    pairs = rho[1::2][: rho.size // 2 - 1] + rho[2::2][: rho.size // 2 - 1]
    negative = np.flatnonzero(pairs <= 0.0)
    last = int(negative[0]) if negative.size else pairs.size
    return max(1.0, 1.0 + 2.0 * float(pairs[:last].sum()))
