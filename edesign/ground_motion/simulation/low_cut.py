"""Low-cut filter, and ends at rest, so that velocity and displacement do not drift."""

from __future__ import annotations

import math

import numpy as np

LOW_CUT = 0.05
"""Hz: corner of the filter; the records are meant for periods well below its inverse, 20 s."""

_ORDER = 2  # of the Butterworth filter, run forwards and backwards

PAD = 0.75 * _ORDER / LOW_CUT
"""s: zeros at each end while filtering. Source: Converse & Brady (1992); Boore (2005, BSSA 95, 745-750)."""


def low_cut(frequency: np.ndarray) -> np.ndarray:
    """Return the amplitude of the low-cut filter, which shifts no phase.

    Args:
        frequency: (n,) Hz.

    Returns:
        In the shape of `frequency`, dimensionless.

    Source: Butterworth filter run forwards and backwards, as recordings are processed; Boore (2005).
    """
    power = 2 * _ORDER
    return np.asarray(frequency**power / (frequency**power + LOW_CUT**power))


def between_rests(spectrum: np.ndarray, count: int, time_step: float, kept: slice, quiet: int) -> np.ndarray:
    """Return a part of an acceleration such that ground velocity and displacement begin and end at zero.

    What the filter leaves in the pads would become drift once they are cut. So the displacement u is multiplied by a
    taper w that rises over the first `quiet` samples and falls over the last: (w u)'' = w u'' + 2 w' u' + w'' u.

    Args:
        spectrum: of the acceleration without mean, shape (count // 2 + 1,), m/s2, as of np.fft.rfft.
        time_step: s.
        kept: which samples are wanted.
        quiet: number of samples of either taper.

    Returns:
        The acceleration, m/s2, shape of `kept`.
    """
    omega = 2.0 * math.pi * np.fft.rfftfreq(count, time_step)
    omega[0] = 1.0  # any: there is no mean
    acceleration, velocity, displacement = (np.fft.irfft(spectrum / (1j * omega) ** n, count)[kept] for n in range(3))
    rise = (np.arange(quiet) / quiet, 1.0 / (quiet * time_step))
    for end, (s, rate) in ((slice(0, quiet), rise), (slice(None, -quiet - 1, -1), (rise[0], -rise[1]))):
        # the lowest polynomial with zero slope and curvature at both ends
        taper = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
        slope = rate * 30.0 * s**2 * (1.0 - s) ** 2
        curvature = rate**2 * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)
        acceleration[end] = taper * acceleration[end] + 2.0 * slope * velocity[end] + curvature * displacement[end]
    return np.asarray(acceleration)
