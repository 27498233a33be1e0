"""Vertical elastic response spectrum, EN 1998-1:2004, 3.2.2.3."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.accelerograms import SET_RULES
from edesign.codes.ec8.branches import checked_action, displacement_of, four_branches
from edesign.codes.ec8.elastic import damping_correction
from edesign.codes.ec8.parameters import VerticalParameters
from edesign.codes.motion_sets import SetRules


@dataclass(frozen=True)
class VerticalSpectrum:
    """Elastic response spectrum S_ve(T) of the vertical component; no soil factor enters.

    As for `ElasticSpectrum` the last branch, stated up to 4 s, goes on without an end.

    Attributes:
        a_gR: reference peak ground acceleration on ground A, m/s2 (horizontal).
        parameters: a_vg / a_g and corner periods.
        gamma_I: importance factor.
        damping: ratio of critical.
        label: for plots and tables.

    Source: EN 1998-1:2004, 3.2.2.3(1)P, Eqs. 3.8-3.11.
    """

    a_gR: float
    parameters: VerticalParameters
    gamma_I: float = 1.0
    damping: float = 0.05
    label: str = "EN 1998-1 elastic, vertical"

    def __post_init__(self) -> None:
        checked_action(self.a_gR, self.gamma_I)
        damping_correction(self.damping)

    @property
    def zero_period(self) -> float:
        """a_vg, m/s2."""
        return self.gamma_I * (self.a_gR * self.parameters.ratio)

    @property
    def last_period(self) -> float:
        """Infinite: the last branch has no end."""
        return math.inf

    @property
    def corners(self) -> Mapping[str, float]:
        """T_B, T_C and T_D, s."""
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
        """Return S_ve(T), m/s2, in the shape of `period` (s); Eqs. 3.8-3.11."""
        p = self.parameters
        plateau = p.F_0 * damping_correction(self.damping)
        shape = four_branches(period, (p.T_B, p.T_C, p.T_D), start=1.0, plateau=plateau)
        return self.gamma_I * (self.a_gR * p.ratio * shape)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period` (s); Eq. 3.7."""
        return displacement_of(self.acceleration(period), period)
