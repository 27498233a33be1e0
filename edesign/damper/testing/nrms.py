"""Errors of a predicted force history: what a fit, a calibration and a laboratory read."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError


def nrms(predicted: ArrayLike, measured: ArrayLike) -> float:
    """Return the sum of squared errors over the sum of squared measurements; no root is taken.

    Times 100 it is in per cent. A law without any force has 1. Eq. 4.28 of the thesis divides by the predictions, which
    says the same of a law that follows the test, but grows without bound for one with hardly any force.

    Args:
        predicted: force (n,), N.
        measured: force (n,), N.

    Returns:
        The ratio; infinite where the measurement is zero throughout and the prediction is not.

    Raises:
        InputError: the histories differ in length or are empty.
    """
    analytical, experimental = _pair(predicted, measured)
    return _ratio(float(np.sum((analytical - experimental) ** 2)), float(np.sum(experimental**2)))


def error_of_peak(predicted: ArrayLike, measured: ArrayLike) -> float:
    """Return the root of the mean squared error over the largest measured magnitude; infinite as `nrms`.

    Args:
        predicted: (n,).
        measured: (n,) in the same unit.

    Raises:
        InputError: as `nrms`.
    """
    analytical, experimental = _pair(predicted, measured)
    return _ratio(float(np.sqrt(np.mean((analytical - experimental) ** 2))), float(np.max(np.abs(experimental))))


def determination(predicted: ArrayLike, measured: ArrayLike) -> float:
    """Return the coefficient of determination R2.

    It is 1 less the squared errors over the squares of the measurements about their mean. Below 0 the mean would
    predict better. It is minus infinity where only the prediction varies.

    Args:
        predicted: (n,).
        measured: (n,) in the same unit.

    Raises:
        InputError: as `nrms`.
    """
    analytical, experimental = _pair(predicted, measured)
    error = float(np.sum((analytical - experimental) ** 2))
    return 1.0 - _ratio(error, float(np.sum((experimental - np.mean(experimental)) ** 2)))


def _pair(predicted: ArrayLike, measured: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
    analytical, experimental = np.asarray(predicted, dtype=float), np.asarray(measured, dtype=float)
    if analytical.shape != experimental.shape or not analytical.size:
        raise InputError(
            f"the error needs as many predicted forces as measured ones, at least one: "
            f"{analytical.size} and {experimental.size} were given [E-SIGNAL-01]"
        )
    return analytical, experimental


def _ratio(error: float, size: float) -> float:
    if size == 0.0:
        return 0.0 if error == 0.0 else np.inf
    return error / size
