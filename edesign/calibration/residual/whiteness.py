"""How much of a residual is structure rather than noise, and how many independent samples it is worth."""

from __future__ import annotations

import numpy as np

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.signals.noise import white_noise
from edesign.calibration.signals.sampling import even, step

_HARMONICS = 7.0  # of the upper frequency of the motion, in the band in which models act


def structured_share(motion: Cycles, values: np.ndarray) -> float:
    """Return the share of the mean square of a residual that lies in the band of the motion above what noise has there.

    The band goes up to 7 times the upper frequency of the motion, at most half the Nyquist frequency.

    Args:
        motion: of the test.
        values: (n,) N.
    """
    grid, residual = even(motion.time, values)
    dt = step(grid)
    power = _spectrum(residual)
    inside = np.fft.rfftfreq(residual.size, dt) <= min(_HARMONICS * motion.upper_frequency, 0.25 / dt)
    total = float(np.sum(power))
    excess = float(np.sum(power[inside])) - white_noise(residual, grid) ** 2 * float(np.mean(inside))
    return float(np.clip(excess / total, 0.0, 1.0)) if total > 0.0 else 0.0


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
