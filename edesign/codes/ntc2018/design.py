"""Design spectrum for elastic analysis, NTC 2018, 3.2.3.5."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.action.branches import four_branches
from edesign.codes.ntc2018.elastic import NtcSpectrum, NtcVerticalSpectrum
from edesign.errors import InputError

LOWER_BOUND = 0.2
"""Least design acceleration in shares of a_g."""


@dataclass(frozen=True)
class NtcDesignSpectrum:
    """Design spectrum S_d(T): the elastic one with 1/q in the place of eta, at least 0.2 a_g.

    Attributes:
        elastic: of the same action; its damping does not enter.
        q: behaviour factor, at least 1.
        label: for plots and tables.
        beta: lower bound, in shares of a_g.

    Source: NTC 2018, 3.2.3.5.
    """

    elastic: NtcSpectrum | NtcVerticalSpectrum
    q: float
    label: str = "NTC 2018 design"
    beta: float = LOWER_BOUND

    def __post_init__(self) -> None:
        if not (math.isfinite(self.q) and self.q >= 1.0):
            raise InputError(f"the behaviour factor q must be at least 1, not {self.q:g} [E-VALUE-02]")

    @property
    def corners(self) -> Mapping[str, float]:
        """Corner periods T_B, T_C and T_D, s."""
        return self.elastic.corners

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_d(T), m/s2, in the shape of `period` (s).

        Args:
            period: s, of any shape; not negative.
        """
        c = self.elastic.corners
        shape = four_branches(period, (c["T_B"], c["T_C"], c["T_D"]), start=1.0, plateau=self.elastic.F_0 / self.q)
        return np.maximum(self.elastic.zero_period * shape, self.beta * self.elastic.a_g)
