"""Elastic response spectra, NTC 2018, 3.2.3.2."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.action.branches import displacement_of, four_branches
from edesign.codes.ec8.action.elastic import damping_correction
from edesign.codes.motion_sets import SetRules
from edesign.codes.ntc2018.accelerograms import ULTIMATE
from edesign.codes.ntc2018.site import Site
from edesign.codes.quantities import STANDARD_GRAVITY, check_positive


@dataclass(frozen=True)
class _Spectrum(ABC):
    """What the horizontal and the vertical spectrum have in common.

    Attributes:
        a_g: largest horizontal acceleration on rock of the limit state, m/s2.
        F_0: largest amplification of the horizontal spectrum, at least 2.2.
        T_C_star: T_C* of the horizontal spectrum on rock, s.
        site: ground and relief.
        damping: ratio of critical; eta = sqrt(10 / (5 + xi)) >= 0.55 as in EN 1998-1.
        rules: for a set of motions of the limit state.
        label: for plots and tables.
    """

    a_g: float
    F_0: float
    T_C_star: float
    site: Site
    damping: float = 0.05
    rules: SetRules = ULTIMATE
    label: str = "NTC 2018 elastic"

    def __post_init__(self) -> None:
        check_positive(a_g=self.a_g, F_0=self.F_0, T_C_star=self.T_C_star)
        damping_correction(self.damping)

    @property
    def eta(self) -> float:
        """Damping correction factor (Eq. 3.2.4)."""
        return damping_correction(self.damping)

    @property
    def last_period(self) -> float:
        """Infinite: the last branch has no end."""
        return math.inf

    @property
    def set_rules(self) -> SetRules:
        """The rules of 3.2.3.6 for the limit state."""
        return self.rules

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same action for another ratio of critical damping."""
        return replace(self, damping=damping)

    @property
    @abstractmethod
    def corners(self) -> Mapping[str, float]:
        """T_B, T_C and T_D, s."""

    @property
    @abstractmethod
    def zero_period(self) -> float:
        """The ordinate at period zero, m/s2."""

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_e(T) (Eq. 3.2.2) or S_ve(T) (Eq. 3.2.8), m/s2, in the shape of `period` (s)."""
        c = self.corners
        return self.zero_period * four_branches(
            period, (c["T_B"], c["T_C"], c["T_D"]), start=1.0, plateau=self.eta * self.F_0
        )

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period` (s): S (T / 2 pi)2 (3.2.3.2.3), beyond T_E too."""
        return displacement_of(self.acceleration(period), period)


@dataclass(frozen=True)
class NtcSpectrum(_Spectrum):
    """Elastic response spectrum S_e(T) of the horizontal components.

    NTC 2018 states it for structures with periods up to 4 s. Here its last branch, 1/T2, goes on without an end.

    Source: NTC 2018, 3.2.3.2.1, Eqs. 3.2.2 to 3.2.7.
    """

    @property
    def S(self) -> float:
        """Site factor S_S S_T (Eq. 3.2.3)."""
        return self.site.S_S(self.a_g, self.F_0) * self.site.S_T

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_B = T_C / 3, T_C = C_C T_C*, T_D = 4 a_g/g + 1.6 (Eqs. 3.2.5 to 3.2.7), s."""
        T_C = self.site.C_C(self.T_C_star) * self.T_C_star
        return {"T_B": T_C / 3.0, "T_C": T_C, "T_D": 4.0 * self.a_g / STANDARD_GRAVITY + 1.6}

    @property
    def zero_period(self) -> float:
        """Acceleration at period zero, a_g S, m/s2."""
        return self.a_g * self.S


@dataclass(frozen=True)
class NtcVerticalSpectrum(_Spectrum):
    """Elastic response spectrum S_ve(T) of the vertical component; the ground does not count, the relief does.

    Source: NTC 2018, 3.2.3.2.2, Eqs. 3.2.8 and 3.2.9, Table 3.2.VI.
    """

    @property
    def F_V(self) -> float:
        """Largest amplification, 1.35 F_0 sqrt(a_g / g) (Eq. 3.2.9)."""
        return 1.35 * self.F_0 * math.sqrt(self.a_g / STANDARD_GRAVITY)

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_B, T_C and T_D of Table 3.2.VI, s."""
        return {"T_B": 0.05, "T_C": 0.15, "T_D": 1.0}

    @property
    def zero_period(self) -> float:
        """Acceleration at period zero, a_g S_T F_V / F_0, m/s2."""
        return self.a_g * self.site.S_T * self.F_V / self.F_0
