"""Checks of what is asked of a motion given as an array: samples, time step, periods, damping."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError


def checked_motion(acceleration: ArrayLike, time_step: float) -> tuple[np.ndarray, float]:
    """Check the samples and the step of a motion.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.

    Returns:
        Samples (n,) and step.

    Raises:
        InputError: fewer than two samples, a sample that is not finite, or a time step that is not positive.
    """
    motion = np.ascontiguousarray(acceleration, dtype=float)
    if motion.ndim != 1 or motion.size < 2:
        raise InputError(
            f"acceleration: one row of at least two samples is needed, not an array of shape {motion.shape} [E-SPEC-01]"
        )
    finite = np.isfinite(motion)
    if not finite.all():
        at = int(np.argmin(finite))
        raise InputError(f"acceleration: sample {at + 1} is {motion[at]:g}, not a finite number [E-SPEC-01]")
    step = float(time_step)
    if not (np.isfinite(step) and step > 0.0):
        raise InputError(f"the time step must be greater than zero, not {step:g} s [E-REC-20]")
    return motion, step


def checked_periods(periods: ArrayLike) -> np.ndarray:
    """Check periods.

    Args:
        periods: a number or (n_T,) s.

    Returns:
        (n_T,) s.

    Raises:
        InputError: there is none, or one is negative or not finite.
    """
    period = np.array(periods, dtype=float, ndmin=1)
    if period.ndim != 1 or period.size == 0:
        raise InputError(f"periods: one row is needed, not an array of shape {period.shape} [E-SPEC-02]")
    wrong = ~(np.isfinite(period) & (period >= 0.0))
    if wrong.any():
        raise InputError(f"periods: a period must be zero or greater, not {period[wrong][0]:g} s [E-SPEC-02]")
    return period


def checked_dampings(dampings: ArrayLike) -> np.ndarray:
    """Check damping ratios.

    Args:
        dampings: a number or (n_z,) ratios of critical.

    Returns:
        (n_z,).

    Raises:
        InputError: there is none, or one is negative, not below 1, or not a number.
    """
    ratio = np.array(dampings, dtype=float, ndmin=1)
    if ratio.ndim != 1 or ratio.size == 0:
        raise InputError(f"damping: one row of ratios is needed, not an array of shape {ratio.shape} [E-SPEC-02]")
    wrong = ~((ratio >= 0.0) & (ratio < 1.0))
    if wrong.any():
        raise InputError(
            f"damping: a ratio must be at least 0 and below 1 (of critical), not {ratio[wrong][0]:g} [E-SPEC-02]"
        )
    return ratio
