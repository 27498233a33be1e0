"""What every target spectrum offers, whatever code it comes from."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike


class Spectrum(Protocol):
    """A response spectrum of pseudo-acceleration and displacement of oscillators of one damping."""

    @property
    def label(self) -> str:
        """Name for plots and tables."""

    @property
    def damping(self) -> float:
        """Ratio of critical damping of the oscillators."""

    @property
    def zero_period(self) -> float:
        """Acceleration at period zero, the peak acceleration of the ground surface (a_g S in EN 1998-1), m/s2."""

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Pseudo-acceleration, m/s2, in the shape of `period` (s, at least 0)."""

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Relative displacement, m, in the shape of `period` (s, at least 0)."""
