"""How many independent errors a history holds."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np


def independent_errors(histories: Iterable[np.ndarray]) -> float:
    """Return the number of independent errors in histories.

    It is the number of samples over 1 + 2 sum of rho_k, up to the first rho_k < 0.

    Args:
        histories: (n,) each.

    Source: Geyer (1992), Statistical Science 7, section 3.3, of which this is the simplest form.
    """
    return sum(error.size / _correlation_time(error) for error in histories)


def _correlation_time(error: np.ndarray) -> float:
    """In samples; 1 for white noise."""
    spectrum = np.fft.rfft(error, 2 * error.size)
    covariance = np.fft.irfft(np.abs(spectrum) ** 2)[: error.size]
    if covariance[0] <= 0.0:
        return 1.0
    rho = covariance / covariance[0]
    below = np.flatnonzero(rho < 0.0)
    return float(max(1.0, 1.0 + 2.0 * np.sum(rho[1 : below[0] if below.size else rho.size])))
