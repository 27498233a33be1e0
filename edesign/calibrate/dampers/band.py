"""Where a residual has its power: in the band of the motion, or everywhere as noise has it."""

from __future__ import annotations

import numpy as np

from edesign.calibrate.dampers.trial import Motion

_HARMONICS = 5.0  # of the fastest motion: where laws, friction and play leave their residual
_HIGH = 0.5  # of the Nyquist frequency: what is above is noise
_LEAST = 64  # samples


def band_power(residual: np.ndarray, motion: Motion) -> tuple[float, float]:
    """Power of a residual (n,) in units of noise.

    Returns:
        In the band of the motion, and what white noise would have there; both as sums over frequencies.
    """
    if residual.size < _LEAST:
        return float(residual @ residual), float(residual.size)
    window = np.hanning(residual.size)
    power = np.abs(np.fft.rfft(window * (residual - residual.mean()))) ** 2 / float(window @ window)
    frequency = np.fft.rfftfreq(residual.size, float(np.median(motion.steps)))
    fastest = float(np.sqrt(np.mean(motion.acceleration**2) / max(np.mean(motion.velocity**2), 1e-300)) / (2.0 * np.pi))
    inside = frequency <= min(_HARMONICS * fastest, _HIGH * frequency[-1])
    # noise below a tenth of what it was taken for is no noise: a fit cannot go below the floor by so much
    noise = max(float(np.median(power[frequency > _HIGH * frequency[-1]])) / np.log(2.0), 0.1)
    count = float(np.count_nonzero(inside))
    return float(power[inside].sum() + count * residual.mean() ** 2), count * noise
