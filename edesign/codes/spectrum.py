"""What every target spectrum offers, whatever code it comes from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.motion_sets import SetRules


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

    @property
    def last_period(self) -> float:
        """The longest period that has an ordinate, s; infinite where the last branch has no end."""

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods by the names that the code gives them, s; empty where the spectrum has none."""

    @property
    def set_rules(self) -> SetRules:
        """Rules of the code for a set of motions that stands for the spectrum."""

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same action for another ratio of critical damping.

        Raises:
            InputError: the code has no spectrum of this damping.
        """

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return the pseudo-acceleration, m/s2, in the shape of `period`.

        Args:
            period: s, at least 0.
        """

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the relative displacement, m, in the shape of `period`.

        Args:
            period: s, at least 0.
        """


class DesignOrdinates(Protocol):
    """A spectrum reduced for elastic analysis, by q or R."""

    @property
    def label(self) -> str:
        """Name for plots and tables."""

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return the design acceleration, m/s2, in the shape of `period`.

        Args:
            period: s, at least 0.
        """


def characteristic_period(spectrum: Spectrum) -> float | None:
    """Return the end of the branch of constant acceleration, T_C or T_S, s; None of a spectrum without corners."""
    return spectrum.corners.get("T_C", spectrum.corners.get("T_S"))
