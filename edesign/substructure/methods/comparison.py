"""What the records of all methods share: a checked ground motion, and the response against the direct one."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError


def checked_ground(step: float, ground: ArrayLike) -> np.ndarray:
    """Return the acceleration of the ground (n,) in m/s2, sampled at `step` (s).

    Raises:
        InputError: the step is not greater than zero, there are less than two samples, one is not finite, or the
            ground does not move.
    """
    values = np.ascontiguousarray(ground, dtype=float)
    if not 0.0 < step < math.inf:
        raise InputError(f"step: must be greater than zero, not {step:g} s")
    if values.ndim != 1 or values.size < 2:
        raise InputError(f"ground motion: needs a series of at least two samples, not the shape {values.shape}")
    if not np.all(np.isfinite(values)):
        raise InputError(f"ground motion: sample {int(np.argmin(np.isfinite(values))) + 1} is not finite")
    if not np.any(values):
        raise InputError("ground motion: all samples are zero")
    return values


def positive(name: str, value: float) -> None:
    """Refuse a number that is not greater than zero and finite.

    Raises:
        InputError: so it is; the message begins with the name.
    """
    if not 0.0 < value < math.inf:
        raise InputError(f"{name}: must be greater than zero, not {value:g}")


def response_error(found: np.ndarray, direct: np.ndarray) -> float:
    """Return the root mean square of the difference over that of the direct response, dimensionless.

    Where the test ended early, the direct response is cut at the same sample.

    Args:
        found: (n, ...) of the test.
        direct: (m, ...) of the direct analysis, m >= n, in the same unit.
    """
    same = direct[: len(found)]
    scale = float(np.sqrt(np.mean(same**2)))
    return float(np.sqrt(np.mean((found - same) ** 2))) / scale if scale > 0.0 else math.nan
