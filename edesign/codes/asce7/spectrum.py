"""Two-period response spectra, ASCE/SEI 7-22, 11.4.5.2 and 11.4.6 (7-16: 11.4.6 and 11.4.7)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.asce7.ground_motions import set_rules
from edesign.codes.ec8.action.branches import checked_periods, displacement_of
from edesign.codes.motion_sets import SetRules
from edesign.codes.quantities import check_positive
from edesign.errors import InputError

EARTHQUAKES = MappingProxyType({"DE": 1.0, "MCE_R": 1.5})
"""Spectrum of an earthquake over the design spectrum. Source: ASCE/SEI 7-22, 11.4.6 (7-16: 11.4.7)."""

_TABLE_18_7_1 = (
    (0.02, 0.05, 0.10, 0.20, 0.30, 0.40, 0.50, 0.60, 0.70, 0.80, 0.90, 1.00),
    (0.8, 1.0, 1.2, 1.5, 1.8, 2.1, 2.4, 2.7, 3.0, 3.3, 3.6, 4.0),
)


def damping_coefficient(damping: float) -> float:
    """Return B, by which the ordinates of 5 % damping are divided; 5 % gives 1.

    Args:
        damping: ratio of critical; below 2 % as 2 %.

    Raises:
        InputError: the ratio is not between 0 and 1.

    Source: ASCE/SEI 7-16 and 7-22, Table 18.7-1, linear between its rows.
    """
    if not 0.0 <= damping <= 1.0:
        raise InputError(f"the damping is a ratio between 0 and 1, such as 0.05 for 5 %, not {damping:g} [E-VALUE-02]")
    return float(np.interp(damping, *_TABLE_18_7_1))


@dataclass(frozen=True)
class AsceSpectrum:
    """Two-period response spectrum of the horizontal components.

    For another damping than 5 % the ordinates from T_0 on are divided by B; from 0.4 S_DS at period zero a straight
    line leads to S_DS / B at T_0, as in ASCE/SEI 41-17, 2.4.1.7.1.

    Attributes:
        S_DS, S_D1: design spectral accelerations at short periods and at 1 s, m/s2.
        T_L: long-period transition period, s.
        factor: of the earthquake, 1 for the design earthquake, 1.5 for MCE_R.
        damping: ratio of critical.
        edition: of the standard, for the rules of a set: "7-16" or "7-22".
        label: for plots and tables.

    Source: ASCE/SEI 7-22, 11.4.5.2; 7-16, 11.4.6, Eqs. 11.4-5 to 11.4-7.
    """

    S_DS: float
    S_D1: float
    T_L: float
    factor: float = 1.0
    damping: float = 0.05
    edition: str = "7-22"
    label: str = "ASCE 7-22 design"

    def __post_init__(self) -> None:
        check_positive(S_DS=self.S_DS, S_D1=self.S_D1, T_L=self.T_L, factor=self.factor)
        damping_coefficient(self.damping)
        if self.corners["T_S"] > self.T_L:
            T_S = self.corners["T_S"]
            raise InputError(
                f"T_S = S_D1/S_DS = {T_S:g} s is beyond T_L = {self.T_L:g} s; T_S <= T_L is needed [E-VALUE-04]"
            )

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_0 = 0.2 T_S, T_S = S_D1/S_DS, and T_L, s."""
        T_S = self.S_D1 / self.S_DS
        return {"T_0": 0.2 * T_S, "T_S": T_S, "T_L": self.T_L}

    @property
    def zero_period(self) -> float:
        """Acceleration at period zero, 0.4 S_DS, m/s2."""
        return self.factor * (0.4 * self.S_DS)

    @property
    def last_period(self) -> float:
        """Last period that has an ordinate: infinite."""
        return math.inf

    @property
    def set_rules(self) -> SetRules:
        """The rules of 16.2."""
        return set_rules(self.edition)

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same earthquake for another ratio of critical damping."""
        return replace(self, damping=damping)

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_a(T), m/s2, in the shape of `period` (s).

        Args:
            period: s, of any shape; not negative.
        """
        T, c, B = checked_periods(period), self.corners, damping_coefficient(self.damping)
        rising = self.S_DS * (0.4 + (1.0 / B - 0.4) * T / c["T_0"])
        longer = np.maximum(T, c["T_S"])
        falling = self.S_D1 / B * np.where(T <= self.T_L, 1.0 / longer, self.T_L / longer**2)
        return self.factor * np.where(T < c["T_0"], rising, np.where(T <= c["T_S"], self.S_DS / B, falling))

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period` (s): S_a (T / 2 pi)2.

        Args:
            period: s, of any shape; not negative.
        """
        return displacement_of(self.acceleration(period), period)


@dataclass(frozen=True)
class AsceDesignSpectrum:
    """Spectrum of modal response spectrum analysis: S_a / (R / I_e).

    Attributes:
        elastic: at 5 % damping.
        R: response modification coefficient, at least 1.
        I_e: importance factor, at least 1.
        label: for plots and tables.

    Source: ASCE/SEI 7-22 (and 7-16), 12.9.1.2.
    """

    elastic: AsceSpectrum
    R: float
    I_e: float = 1.0
    label: str = "ASCE 7-22 design, reduced"

    def __post_init__(self) -> None:
        for name, value in (("R", self.R), ("I_e", self.I_e)):
            if not (math.isfinite(value) and value >= 1.0):
                raise InputError(f"{name} must be at least 1, not {value:g} [E-VALUE-02]")

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_a / (R / I_e), m/s2, in the shape of `period` (s).

        Args:
            period: s, of any shape; not negative.
        """
        return self.elastic.with_damping(0.05).acceleration(period) * (self.I_e / self.R)
