"""Fixed points x = g(x) of vectors, with relaxation that learns from the last two residuals."""

from __future__ import annotations

import numpy as np

AGREEMENT = 1e-6  # relative, of what follows from itself: a frequency, a strain, the dashpots of an amplitude
MOST_ITERATIONS = 50


class Relaxation:
    """The relaxation of a fixed-point iteration: it damps oscillation and speeds up slow convergence.

    Source: Irons and Tuck (1969), A version of the Aitken accelerator for computer iteration, International Journal for
        Numerical Methods in Engineering 1.
    """

    def __init__(self) -> None:
        self._factor = 1.0
        self._residual: np.ndarray | None = None

    def __call__(self, taken: np.ndarray, found: np.ndarray) -> np.ndarray:
        """The next x (n,) after g(taken) = found."""
        residual = found - taken
        if self._residual is not None:
            change = residual - self._residual
            squared = float(change @ change)
            if squared > 0.0:
                self._factor *= -float(self._residual @ change) / squared
        self._residual = residual
        return np.asarray(taken + self._factor * residual)
