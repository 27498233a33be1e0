"""Normalised error of a predicted force history."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError


def nrms(predicted: ArrayLike, measured: ArrayLike) -> float:
    """Sum of squared errors over the sum of squared predictions; no root is taken. Times 100 it is in per cent.

    Args:
        predicted: analytical force F_A (n,), N.
        measured: experimental force F_E (n,), N.

    Returns:
        The ratio; infinite where the prediction is zero throughout and the measurement is not.

    Raises:
        InputError: the histories differ in length or are empty.

    Source: thesis Eq. 4.28.
    """
    analytical, experimental = np.asarray(predicted, dtype=float), np.asarray(measured, dtype=float)
    if analytical.shape != experimental.shape or not analytical.size:
        raise InputError(
            f"the error needs as many predicted forces as measured ones, at least one: "
            f"{analytical.size} and {experimental.size} were given"
        )
    error = float(np.sum((analytical - experimental) ** 2))
    power = float(np.sum(analytical**2))
    if power == 0.0:
        return 0.0 if error == 0.0 else np.inf
    return error / power
