"""How much of a residual is structure rather than noise, and how many independent samples it is worth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.calibration.residual.motion import Motion
from edesign.calibration.signals.noise import white_noise
from edesign.calibration.signals.sampling import even, step

_HARMONICS = 7.0  # of the upper frequency of the motion, in the band in which models act


@dataclass(frozen=True)
class Whiteness:
    """Structure of a residual.

    Attributes:
        structured: share of its mean square that lies in the band of the motion above what the noise has there.
        noise: standard deviation of the broadband noise, N.
        band: upper frequency of the band (7 times that of the motion, at most half the Nyquist frequency), Hz.
        effective_samples: number of independent samples with the same scatter of averages; that of all if white.
        correlation_time: duration over that number, s.
    """

    structured: float
    noise: float
    band: float
    effective_samples: float
    correlation_time: float


def whiteness(motion: Motion, values: np.ndarray) -> Whiteness:
    """Structure of a residual (n,), N."""
    grid, residual = even(motion.time, values)
    dt, n = step(grid), residual.size
    noise = white_noise(residual, grid)
    power = _spectrum(residual)
    frequency = np.fft.rfftfreq(n, dt)
    band = min(_HARMONICS * motion.upper_frequency, 0.25 / dt)
    inside = frequency <= band
    total = float(np.sum(power))
    excess = float(np.sum(power[inside])) - noise**2 * float(np.mean(inside))
    samples = effective_samples(residual)
    return Whiteness(
        float(np.clip(excess / total, 0.0, 1.0)) if total > 0.0 else 0.0, noise, band, samples, n * dt / samples
    )


def effective_samples(values: np.ndarray) -> float:
    """Number of independent samples, n over the sum of the squared autocorrelation at all lags.

    From the spectrum: 4 (sum P)^2 / sum P^2 of the periodogram, whose squares have twice the square of their mean.

    Source: Bartlett, J. R. Stat. Soc. 98 (1935) 536; Bretherton et al., J. Climate 12 (1999) 1990, Eq. 31.
    """
    power = _spectrum(values)
    squares = float(np.sum(power**2))
    found = 4.0 * float(np.sum(power)) ** 2 / squares if squares > 0.0 else float(values.size)
    return float(np.clip(found, 1.0, values.size))


def _spectrum(values: np.ndarray) -> np.ndarray:
    """Mean square by frequency, one-sided."""
    power = np.abs(np.fft.rfft(values)) ** 2 / values.size**2
    power[1 : None if values.size % 2 else -1] *= 2.0
    return np.asarray(power, dtype=float)
