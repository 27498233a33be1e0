"""Elastic response spectra, EN 1998-1:2004, 3.2.2.2: what both components share, and the horizontal one."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.codes.ec8.action.branches import checked_action, displacement_of, four_branches
from edesign.codes.ec8.action.parameters import HorizontalParameters, VerticalParameters
from edesign.codes.motion_sets import SetRules
from edesign.errors import InputError

SMALLEST_CORRECTION = 0.55
"""Of eta, EN 1998-1:2004, 3.2.2.2(3)."""


def damping_correction(damping: float) -> float:
    """Return eta = sqrt(10 / (5 + xi)), at least 0.55; xi in per cent, 5 % gives 1.

    Args:
        damping: ratio of critical damping (0.05, not 5).

    Raises:
        InputError: the ratio is not between 0 and 1.

    Source: EN 1998-1:2004, 3.2.2.2(3), Eq. 3.6.
    """
    if not 0.0 <= damping <= 1.0:
        raise InputError(f"the damping is a ratio between 0 and 1, such as 0.05 for 5 %, not {damping:g} [E-VALUE-02]")
    return max(math.sqrt(10.0 / (5.0 + 100.0 * damping)), SMALLEST_CORRECTION)


@dataclass(frozen=True)
class ComponentSpectrum(ABC):
    """Elastic response spectrum of one component of the ground motion, horizontal or vertical.

    EN 1998-1 states it up to 4 s. Here its last branch, 1/T2, that is constant displacement, goes on without an end.

    The action enters as a last factor gamma_I, so spectra of two levels differ by it to the last bit.

    Attributes:
        a_gR: reference peak ground acceleration on ground A, m/s2 (horizontal).
        parameters: factor of the peak and corner periods.
        gamma_I: importance factor; a_g = gamma_I a_gR.
        damping: ratio of critical.
        label: for plots and tables.

    Source: EN 1998-1:2004, 3.2.2.2(1)P and 3.2.2.3(1)P, whose equations are alike.
    """

    a_gR: float
    parameters: HorizontalParameters | VerticalParameters
    gamma_I: float = 1.0
    damping: float = 0.05
    label: str = ""

    def __post_init__(self) -> None:
        checked_action(self.a_gR, self.gamma_I)
        damping_correction(self.damping)

    @property
    @abstractmethod
    def peak_factor(self) -> float:
        """Peak acceleration of the component over that of the horizontal one on ground A."""

    @property
    def eta(self) -> float:
        """Damping correction factor."""
        return damping_correction(self.damping)

    @property
    def zero_period(self) -> float:
        """Peak acceleration, m/s2: a_g S, or a_vg."""
        return self.gamma_I * (self.a_gR * self.peak_factor)

    @property
    def last_period(self) -> float:
        """Last period that has an ordinate: infinite."""
        return math.inf

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_B, T_C and T_D, s."""
        p = self.parameters
        return {"T_B": p.T_B, "T_C": p.T_C, "T_D": p.T_D}

    @property
    def set_rules(self) -> SetRules:
        """The rules of 3.2.3.1."""
        return SET_RULES

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same action for another ratio of critical damping."""
        return replace(self, damping=damping)

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_e(T) or S_ve(T), m/s2, in the shape of `period`.

        Args:
            period: s, of any shape; not negative.

        Source: EN 1998-1:2004, Eqs. 3.2-3.5, 3.8-3.11.
        """
        p = self.parameters
        shape = four_branches(period, (p.T_B, p.T_C, p.T_D), start=1.0, plateau=p.F_0 * self.eta)
        return self.gamma_I * (self.a_gR * self.peak_factor * shape)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period`; EN 1998-1 applies the equation up to 4 s.

        Args:
            period: s, of any shape; not negative.

        Source: EN 1998-1:2004, Eq. 3.7.
        """
        return displacement_of(self.acceleration(period), period)


@dataclass(frozen=True)
class ElasticSpectrum(ComponentSpectrum):
    """Elastic response spectrum S_e(T) of the horizontal components.

    Annex A says the same up to T_E (type 1: 4.5 s on ground A, 5 s on B, 6 s on C, D and E) and lower displacements
    beyond, for which there is `LongPeriodSpectrum`.

    Source: EN 1998-1:2004, 3.2.2.2(1)P, Eqs. 3.2-3.5.
    """

    parameters: HorizontalParameters
    label: str = "EN 1998-1 elastic"

    @property
    def a_g(self) -> float:
        """Design ground acceleration on ground A, m/s2: gamma_I a_gR (3.2.1(3))."""
        return self.gamma_I * self.a_gR

    @property
    def peak_factor(self) -> float:
        """The soil factor S."""
        return self.parameters.S
