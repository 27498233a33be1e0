"""Baseline correction by polynomials of low order."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.intensity import displacement, velocity
from edesign.ground_motion.record import Record

HIGHEST_ORDER = 8
"""Of the polynomials here; more follows the motion itself."""


def correct_baseline(record: Record, order: int = 1, fit: Literal["acceleration", "velocity"] = "velocity") -> Record:
    """Subtract a polynomial of time from the acceleration.

    Args:
        order: of the polynomial; 0 is a constant, 1 a straight line.
        fit: what is fitted by least squares: the acceleration itself, or the velocity (by the integral of the
            polynomial, so that the velocity still begins at zero). The velocity shows small offsets better: their
            integral grows with time, that of the motion does not.

    Returns:
        The corrected record.

    Raises:
        InputError: the order is negative, above HIGHEST_ORDER, or not below the number of samples.

    Source: Boore (2001), Bull. Seism. Soc. Am. 91, 1199-1211; Boore & Bommer (2005), Soil Dyn. Earthq. Eng. 25, 93-115.
    """
    _check_order(record, order, 0)
    if fit not in ("acceleration", "velocity"):
        raise InputError(
            f"{record.name}: a baseline is fitted to `acceleration` or `velocity`, not to `{fit}` [E-VALUE-03]"
        )
    basis = _legendre(record, order)
    if fit == "acceleration":
        observed, columns = record.acceleration, basis
    else:
        step = record.time_step
        observed = velocity(record.acceleration, step)
        columns = np.column_stack([velocity(column, step) for column in basis.T])
    scale = np.max(np.abs(columns), axis=0)
    factors = np.linalg.lstsq(columns / scale, observed, rcond=None)[0] / scale
    done = f"polynomial of order {order} fitted to the {fit} subtracted from the acceleration"
    return replace(record, acceleration=record.acceleration - basis @ factors, source=f"{record.source}; {done}")


def remove_drift(record: Record, order: int = 6) -> Record:
    """Subtract a polynomial so that the motion ends at rest: velocity and displacement are zero at the last sample.

    The displacement is fitted by a polynomial of time without constant and linear term, whose second derivative is
    subtracted from the acceleration: so the PEER NGA records are corrected. Of all such polynomials this takes the one
    of least squares that has the record's velocity and displacement at its end. For records that cover the whole
    motion and have no permanent displacement.

    Args:
        order: of the polynomial of displacement, 3 to HIGHEST_ORDER.

    Returns:
        The corrected record; velocity and displacement are those of `intensity`, exact for linear interpolation.

    Raises:
        InputError: the order is out of range, or not below the number of samples.

    Source: Boore, Azari Sisi & Akkar (2012), Bull. Seism. Soc. Am. 102, 751-760, and Ancheta et al. (2013), PEER
        2013/03, section 3 (order 6); Chiu (1997), Bull. Seism. Soc. Am. 87, 932-944 (initial velocity).
    """
    _check_order(record, order, 3)
    step = record.time_step
    basis = _legendre(record, order - 2)
    moved = np.column_stack([displacement(column, step) for column in basis.T])
    ends = np.vstack((moved[-1], [velocity(column, step)[-1] for column in basis.T]))
    d = displacement(record.acceleration, step)
    target = np.array([d[-1], velocity(record.acceleration, step)[-1]])
    # all that meets the ends: a particular solution plus the null space; the fit chooses within it
    rows = ends / np.max(np.abs(ends), axis=1, keepdims=True)
    wanted = target / np.max(np.abs(ends), axis=1)
    factors = np.linalg.lstsq(rows, wanted, rcond=None)[0]
    free = np.linalg.svd(rows)[2][2:].T
    if free.size:
        factors = factors + free @ np.linalg.lstsq(moved @ free, d - moved @ factors, rcond=None)[0]
    done = f"polynomial of displacement of order {order} removed, velocity and displacement zero at the end"
    return replace(record, acceleration=record.acceleration - basis @ factors, source=f"{record.source}; {done}")


def _check_order(record: Record, order: int, least: int) -> None:
    highest = min(HIGHEST_ORDER, record.acceleration.size - 1)
    if not least <= order <= highest:
        raise InputError(
            f"{record.name}: the order of the polynomial must be from {least} to {highest}, not {order} [E-VALUE-02]"
        )


def _legendre(record: Record, order: int) -> np.ndarray:
    """Legendre polynomials of time on the length of the record, shape (n, order + 1): well conditioned."""
    return np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, record.acceleration.size), order)
