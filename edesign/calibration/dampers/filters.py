"""First and second order systems that a history passes, exact for cubic splines between samples."""

from __future__ import annotations

import numpy as np

from edesign.calibration.dampers.motion import Motion
from edesign.core.fading import fading

_MOMENTS = 18  # from which those of steps shorter than the relaxation are found in double precision


def relaxed(motion: Motion, values: np.ndarray, tau: complex) -> np.ndarray:
    """Return Q (n,) with Q + tau Q' = values, a cubic spline between samples; at rest before the first.

    Args:
        motion: whose samples the values stand at.
        values: (n,) in any unit.
        tau: time constant, s, its real part positive; a complex one makes Q complex.
    """
    decay, begin, end, slope_begin, slope_end = _weights(motion.steps, tau)
    slope = motion.spline.slopes(values)
    made = begin * values[:-1] + end * values[1:] + slope_begin * slope[:-1] + slope_end * slope[1:]
    return fading(decay, made, float(values[0]))


def second_order(motion: Motion, values: np.ndarray, frequency: float, damping: float) -> np.ndarray:
    """Return Q (n,) with Q + 2 zeta Q'/w + Q''/w^2 = values, w = 2 pi frequency.

    1 / (1 + 2 zeta s/w + s^2/w^2) is twice the real part of r / (1 - s/pole) for real values.

    Args:
        motion: whose samples the values stand at.
        values: (n,) in any unit.
        frequency: Hz.
        damping: zeta, below 1.
    """
    w = 2.0 * np.pi * frequency
    damped = w * np.sqrt(1.0 - damping**2)
    pole = complex(-damping * w, damped)
    return np.asarray((1j * w**2 / (damped * pole) * relaxed(motion, values, -1.0 / pole)).real)


def _weights(steps: np.ndarray, tau: complex) -> tuple[np.ndarray, ...]:
    """Return of each step what is left of Q, and what values and slopes at its beginning and end make of it."""
    x = steps / tau
    decay = np.exp(-x)
    # moments m_k = x integral exp(-x (1 - s)) s^k ds over a step, k m_(k-1) = x (1 - m_k), taken in the way in which
    # errors die out
    short = np.abs(x) < 1.0
    down, up = x[short], x[~short]
    m = np.empty((4, x.size), dtype=x.dtype)
    last: np.ndarray = down / (_MOMENTS + 1.0)
    for k in range(_MOMENTS, 0, -1):
        last = down * (1.0 - last) / k
        if k <= 4:
            m[k - 1, short] = last
    last = 1.0 - decay[~short]
    for k in range(4):
        last = 1.0 - k / up * last if k else last
        m[k, ~short] = last
    rise = 3.0 * m[2] - 2.0 * m[3]
    return decay, m[0] - rise, rise, steps * (m[1] - 2.0 * m[2] + m[3]), steps * (m[3] - m[2])
