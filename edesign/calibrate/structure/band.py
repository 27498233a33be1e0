"""Where the residual of a channel has its power: where the channel has its own, or everywhere as noise has it."""

from __future__ import annotations

import numpy as np

_MOST = 0.999  # of the measured power lies in the band
_HIGH = 0.5  # of the Nyquist frequency: what is above is noise
_LEAST = 64  # samples
_QUIET = 0.1  # of the noise's power: a record that was filtered has less there than in the band


def band_power(residual: np.ndarray, measured: np.ndarray) -> tuple[float, float]:
    """Power of a residual (n,) in units of noise, where the measured channel (n,) has its own.

    Returns:
        In that band, and what white noise as strong as above it would have there; both as sums over frequencies.
    """
    if residual.size < _LEAST:
        return float(residual @ residual), float(residual.size)
    window = np.hanning(residual.size)
    power = np.abs(np.fft.rfft(window * (residual - residual.mean()))) ** 2 / float(window @ window)
    signal = np.cumsum(np.abs(np.fft.rfft(window * (measured - measured.mean()))) ** 2)
    high = int(_HIGH * power.size)
    last = min(int(np.searchsorted(signal, _MOST * signal[-1])), high)
    noise = max(float(np.median(power[high:])) / np.log(2.0), _QUIET)
    return float(power[: last + 1].sum()), (last + 1) * noise
