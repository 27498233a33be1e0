"""Envelope of an accelerogram in time."""

from __future__ import annotations

import math

import numpy as np

_PEAK_AT = 0.2  # epsilon: time of the peak over the length of the window
_END_LEVEL = 0.05  # eta: level at the end over the peak
_LENGTH = 2.12  # f_Tgm: 2.0 in Boore (2003), 2.12 in SMSIM 6.0 for the durations of Boore & Thompson (2014)


def window_length(duration: float) -> float:
    """Return the length t_eta of the window, in s.

    Args:
        duration: T_gm of the ground motion, s.
    """
    return _LENGTH * duration


def saragoni_hart(time: np.ndarray, length: float) -> np.ndarray:
    """Return the window a (t/t_eta)^b exp(-c t/t_eta): 1 at its peak, 5 % at its end, zero outside.

    Args:
        time: shape (n,), s; the window begins at 0.
        length: t_eta, s.

    Returns:
        Shape (n,), dimensionless.

    Source: Saragoni & Hart (1974), as in Boore (2003).
    """
    power = -_PEAK_AT * math.log(_END_LEVEL) / (1.0 + _PEAK_AT * (math.log(_PEAK_AT) - 1.0))
    decay = power / _PEAK_AT
    factor = (math.e / _PEAK_AT) ** power
    inside = (time >= 0.0) & (time <= length)
    ratio = np.where(inside, time, 0.0) / length
    return np.where(inside, factor * ratio**power * np.exp(-decay * ratio), 0.0)
