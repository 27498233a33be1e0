"""Channels of a test as they come in: equal lengths, finite numbers, a time step."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError

FEWEST = 3
"""Samples: a parabola through a peak needs three."""

_HUGE = (
    1e100  # squares and their sums neither overflow nor vanish between it and its inverse; in m or N no test is there
)


def channel(name: str, values: ArrayLike, samples: int | None = None) -> np.ndarray:
    """Return a channel as an array of finite numbers.

    Args:
        name: for people.
        values: (n,), any unit.
        samples: n that it must have; None: any from `FEWEST` on.

    Returns:
        (n,).

    Raises:
        InputError: not a list of numbers, too short, another length than `samples`, NaN, infinity or values too
            large to square.
    """
    array = _numbers(name, values)
    if array.ndim != 1:
        raise InputError(f"{name}: one value a time step is needed, (n,); its shape is {array.shape} [E-SIGNAL-01]")
    _length(name, array.size, samples)
    return _usable(name, array)


def time_step(step: float) -> float:
    """Check the time step.

    Args:
        step: s.

    Returns:
        The step, s.

    Raises:
        InputError: not above zero or not finite.
    """
    if not (math.isfinite(step) and step > 0.0):
        raise InputError(f"step = {step:g} s is out of range: a time above 0 is needed [E-VALUE-02]")
    return float(step)


def _numbers(name: str, values: ArrayLike) -> np.ndarray:
    try:
        return np.asarray(values, dtype=float)
    except (TypeError, ValueError) as problem:
        raise InputError(f"{name}: not an array of numbers ({problem}) [E-SIGNAL-01]") from None


def _length(name: str, found: int, samples: int | None) -> None:
    if samples is None and found < FEWEST:
        raise InputError(f"{name}: {found} samples were given; at least {FEWEST} are needed [E-SIGNAL-01]")
    if samples is not None and found != samples:
        raise InputError(f"{name}: {found} samples were given, but the target has {samples} [E-SIGNAL-01]")


def _usable(name: str, array: np.ndarray) -> np.ndarray:
    """The array, zero where it is too small to square; InputError: NaN, infinity or too large to square."""
    bad = np.flatnonzero(~np.isfinite(array))
    if bad.size:
        raise InputError(
            f"{name}: {bad.size} of {len(array)} samples are NaN or infinity, the first is number {bad[0]}"
            " [E-SIGNAL-02]"
        )
    size = np.abs(array)
    if np.max(size) > _HUGE:
        raise InputError(
            f"{name}: values up to {np.max(size):.3g} are out of range: at most {_HUGE:g} is allowed [E-SIGNAL-02]"
        )
    return np.where(size < 1.0 / _HUGE, 0.0, array)
