"""Elastic displacement spectrum of long periods, EN 1998-1:2004, 3.2.2.2(6), 3.2.2.4 and Annex A."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.action.branches import checked_periods
from edesign.codes.ec8.action.elastic import ElasticSpectrum
from edesign.codes.motion_sets import SetRules
from edesign.codes.names import unknown
from edesign.errors import InputError

TABLE_A_1 = {"A": (4.5, 10.0), "B": (5.0, 10.0), "C": (6.0, 10.0), "D": (6.0, 10.0), "E": (6.0, 10.0)}
"""Additional control periods T_E and T_F of the type 1 displacement spectrum by ground type, s."""


def design_ground_displacement(spectrum: ElasticSpectrum) -> float:
    """Return d_g = 0.025 a_g S T_C T_D, m.

    Source: EN 1998-1:2004, 3.2.2.4(1), Eq. 3.12.
    """
    p = spectrum.parameters
    return 0.025 * spectrum.zero_period * p.T_C * p.T_D


@dataclass(frozen=True)
class LongPeriodSpectrum:
    """The elastic spectrum with the displacements of Annex A beyond T_E; type 1 only.

    Up to T_E it is the elastic spectrum. From T_E to T_F the displacement goes in a straight line from 2.5 eta d_g to
    d_g, the peak displacement of the ground, where it stays. The accelerations are those displacements by Eq. 3.7
    (3.2.2.2(6) Note). As d_g has 0.025 for 1/(4 pi2) = 0.02533, the ordinates printed in EN 1998-1 step down by 1.3 %
    at T_E; they are kept as printed.

    Attributes:
        elastic: the spectrum up to T_E.

    Source: EN 1998-1:2004, Annex A (informative), Eqs. A.1 and A.2, Table A.1.
    """

    elastic: ElasticSpectrum

    def __post_init__(self) -> None:
        p = self.elastic.parameters
        if p.spectrum_type != 1:
            raise InputError(f"Annex A of EN 1998-1 is for spectra of type 1, not of type {p.spectrum_type} [E-EC8-02]")
        if p.ground not in TABLE_A_1:
            raise unknown("ground type", p.ground, TABLE_A_1)
        if p.T_D > self.T_E:
            raise InputError(f"Annex A of EN 1998-1 needs T_D <= T_E, not {p.T_D:g} s and {self.T_E:g} s [E-VALUE-04]")

    @property
    def T_E(self) -> float:
        """End of the branch of constant displacement, s."""
        return TABLE_A_1[self.elastic.parameters.ground][0]

    @property
    def T_F(self) -> float:
        """Period from which the oscillator moves with the ground displacement, s."""
        return TABLE_A_1[self.elastic.parameters.ground][1]

    @property
    def label(self) -> str:
        """Name for plots and tables."""
        return f"{self.elastic.label}, Annex A"

    @property
    def damping(self) -> float:
        """Ratio of critical damping."""
        return self.elastic.damping

    @property
    def zero_period(self) -> float:
        """Acceleration at period zero, a_g S, m/s2."""
        return self.elastic.zero_period

    @property
    def last_period(self) -> float:
        """Last period that has an ordinate: infinite."""
        return math.inf

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_B to T_F, s."""
        return {**self.elastic.corners, "T_E": self.T_E, "T_F": self.T_F}

    @property
    def set_rules(self) -> SetRules:
        """Rules for sets of motions of the elastic spectrum."""
        return self.elastic.set_rules

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same action for another ratio of critical damping."""
        return type(self)(self.elastic.with_damping(damping))

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return S_De(T), m, in the shape of `period`.

        Args:
            period: s, of any shape; not negative.

        Source: EN 1998-1:2004, Eqs. 3.7, A.1 and A.2.
        """
        T = checked_periods(period)
        plateau = self.elastic.parameters.F_0 * self.elastic.eta
        beyond = np.interp(T, (self.T_E, self.T_F), (plateau, 1.0))
        return np.where(T <= self.T_E, self.elastic.displacement(T), design_ground_displacement(self.elastic) * beyond)

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_e(T), m/s2, in the shape of `period` (s): the inverse of Eq. 3.7 beyond T_E.

        Args:
            period: s, of any shape; not negative.
        """
        T = checked_periods(period)
        longer = np.maximum(T, self.T_E)
        inverse = self.displacement(longer) * (2.0 * math.pi / longer) ** 2
        return np.where(T <= self.T_E, self.elastic.acceleration(T), inverse)
