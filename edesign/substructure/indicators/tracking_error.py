"""Size of the tracking error: normalised sums of squares and the largest error."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from edesign.damper.testing.nrms import nrms as squared_ratio
from edesign.substructure.indicators.channels import channel
from edesign.substructure.indicators.undetermined import Undetermined


def nrms(target: ArrayLike, measured: ArrayLike) -> float:
    """Return the sum of squared errors over the sum of squared targets, without a root, as thesis Eq. 6.28 is printed.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.

    Raises:
        InputError: lengths that differ, NaN.
        Undetermined: the target is zero throughout.
    """
    x_t, x_m = _pair(target, measured)
    return squared_ratio(x_m, x_t)


def nrms_root(target: ArrayLike, measured: ArrayLike) -> float:
    """Return the root of `nrms`, which Tables 6.1, 6.3 and 6.4 of the thesis hold; of a short delay tau omega_rms tau.

    Args:
        target: (n,) m.
        measured: (n,) m.
    """
    return math.sqrt(nrms(target, measured))


def maximum_error(target: ArrayLike, measured: ArrayLike) -> float:
    """Return the largest |x_m - x_t| over the largest |x_t|; J3 of the benchmark is 100 times it.

    Args:
        target: (n,) m.
        measured: (n,) m.

    Raises:
        InputError: as `nrms`.
    """
    x_t, x_m = _pair(target, measured)
    return float(np.max(np.abs(x_m - x_t)) / np.max(np.abs(x_t)))


def _pair(target: ArrayLike, measured: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    if not np.any(x_t):
        raise Undetermined("the target is zero throughout")
    return x_t, x_m
