"""Peak responses of oscillators under ground acceleration that is linear between samples, computed by the core."""

from __future__ import annotations

from typing import Any

import numpy as np

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name
from edesign.core.stop import STOP, raise_if_stopped


def peak_displacement(
    acceleration: np.ndarray, time_step: float, period: np.ndarray, damping: np.ndarray
) -> np.ndarray:
    """Return the largest relative displacement of oscillators from rest, during the motion and after it.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        period: (m,) s, each at least ED_MIN_PERIOD_STEPS time steps.
        damping: (m,) ratio of critical, 0 <= damping < 1.

    Returns:
        (m,) m.

    Raises:
        CoreError: an argument is out of range or a sample not finite.

    Source: the exact recurrence of Nigam & Jennings (1969).
    """
    a, (t, z) = _array(acceleration), _oscillators(period, damping)
    sd = np.empty(t.size)
    _check(lib.ed_response_spectrum(a.size, time_step, _c(a), t.size, _c(t), _c(z), _c(sd), ffi.NULL, ffi.NULL, STOP))
    return sd


def peak_responses(
    acceleration: np.ndarray, time_step: float, period: np.ndarray, damping: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return largest relative displacements, relative velocities and absolute accelerations of oscillators.

    Args:
        acceleration: see `peak_displacement`.
        time_step: s.
        period: (m,) s.
        damping: (m,) ratio of critical.

    Returns:
        Displacements (m,) m, velocities (m,) m/s and accelerations (m,) m/s2.

    Raises:
        CoreError: as `peak_displacement`.
    """
    a, (t, z) = _array(acceleration), _oscillators(period, damping)
    sd, sv, sa = np.empty(t.size), np.empty(t.size), np.empty(t.size)
    _check(lib.ed_response_spectrum(a.size, time_step, _c(a), t.size, _c(t), _c(z), _c(sd), _c(sv), _c(sa), STOP))
    return sd, sv, sa


def rotated_peak_displacement(
    first: np.ndarray, second: np.ndarray, time_step: float, period: np.ndarray, damping: np.ndarray, angles: int
) -> np.ndarray:
    """Return largest relative displacements in directions from the first of two components towards the second.

    Args:
        first: (n,) m/s2, first component.
        second: (n,) m/s2, component at right angles to it.
        time_step: s.
        period: (m,) s, as for `peak_displacement`.
        damping: (m,) ratio of critical, as for `peak_displacement`.
        angles: how many directions in half a turn, evenly spaced from the first component on.

    Returns:
        (m, angles) m.

    Raises:
        CoreError: an argument is out of range or a sample not finite.
        ValueError: the components are not equally long.
    """
    a, b, (t, z) = _array(first), _array(second), _oscillators(period, damping)
    if a.size != b.size:
        raise ValueError(f"components of {a.size} and {b.size} samples")
    sd = np.empty((t.size, angles))
    _check(lib.ed_rotated_spectrum(a.size, time_step, _c(a), _c(b), t.size, _c(t), _c(z), angles, _c(sd), STOP))
    return sd


def recursion_peaks(
    samples: np.ndarray, numerator: np.ndarray, denominator: np.ndarray, share: float, most: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return local maxima of |y| of recursions of the second order from rest, as `scipy.signal.lfilter` runs them.

    Args:
        samples: (n,), at least three.
        numerator: b0, b1, b2 of each recursion, shape (m, 3).
        denominator: a1, a2 of each recursion (a0 is 1), shape (m, 2).
        share: of the largest sample of a recursion, from which on its maxima are kept.
        most: so many of each, the largest.

    Returns:
        Index of the recursion, ascending; place in samples from the first; signed value: (p,) each, those of one
        recursion by their size, the largest first.

    Raises:
        CoreError: an argument is out of range, no memory, or a response is not finite.
    """
    x, b, a = _array(samples), _array(numerator), _array(denominator)
    count = np.empty(b.shape[0], dtype=np.intc)
    place, value = np.empty((count.size, most)), np.empty((count.size, most))
    counts = ffi.from_buffer("int[]", count)
    found = counts, _c(place), _c(value)
    _check(lib.ed_recursion_peaks(x.size, _c(x), count.size, _c(b), _c(a), share, most, *found, STOP))
    kept = np.arange(most) < count[:, None]
    return np.repeat(np.arange(count.size), count), place[kept], value[kept]


def _array(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=float)


def _oscillators(period: np.ndarray, damping: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    t, z = _array(period), _array(damping)
    if t.shape != z.shape:
        raise ValueError(f"{t.size} periods and {z.size} damping ratios")
    return t, z


def _c(array: np.ndarray) -> Any:
    return ffi.from_buffer("double[]", array)


def _check(status: int) -> None:
    raise_if_stopped(status)
    if status < 0:
        raise CoreError(status_name(status), ffi.string(lib.ed_status_text(status)).decode())
