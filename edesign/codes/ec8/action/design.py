"""Design spectrum for elastic analysis, EN 1998-1:2004, 3.2.2.5."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.action.branches import checked_action, four_branches
from edesign.codes.ec8.action.elastic import ElasticSpectrum
from edesign.codes.ec8.action.vertical import VerticalSpectrum
from edesign.errors import InputError

LARGEST_VERTICAL_Q = 1.5


@dataclass(frozen=True)
class DesignSpectrum:
    """Design spectrum S_d(T): the elastic one divided by the behaviour factor q, which covers damping too.

    Attributes:
        a_gR: reference peak ground acceleration, m/s2 (vertical: times a_vg / a_g).
        S: soil factor (vertical: 1).
        corners: T_B, T_C, T_D, s.
        q: behaviour factor, at least 1.
        gamma_I: importance factor.
        beta: lower bound factor; beyond T_C the spectrum is at least beta a_g.
        label: for plots and tables.
        F_0: largest amplification, 2.5 (vertical too, 3.2.2.5(5)).

    Source: EN 1998-1:2004, 3.2.2.5(4)P, Eqs. 3.13-3.16; thesis Eqs. 5.1-5.4.
    """

    a_gR: float
    S: float
    corners: tuple[float, float, float]
    q: float
    gamma_I: float = 1.0
    beta: float = 0.2
    label: str = "EN 1998-1 design"
    F_0: float = 2.5

    def __post_init__(self) -> None:
        checked_action(self.a_gR, self.gamma_I)
        if not (math.isfinite(self.q) and self.q >= 1.0):
            raise InputError(f"the behaviour factor q must be at least 1, not {self.q:g} [E-VALUE-02]")
        if not (math.isfinite(self.beta) and self.beta >= 0.0):
            raise InputError(f"the lower bound factor beta must be at least 0, not {self.beta:g} [E-VALUE-02]")

    @classmethod
    def of(cls, elastic: ElasticSpectrum, q: float, beta: float = 0.2, label: str = "") -> DesignSpectrum:
        """Return the design spectrum of the same action; the damping of `elastic` does not enter.

        Args:
            q: behaviour factor.
            beta: lower bound, by a_g.
            label: for legends.
        """
        p = elastic.parameters
        label = label or f"EN 1998-1 design, q = {q:g}"
        return cls(elastic.a_gR, p.S, (p.T_B, p.T_C, p.T_D), q, elastic.gamma_I, beta, label, p.F_0)

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_d(T), m/s2, in the shape of `period`.

        Args:
            period: s, of any shape; not negative.

        Source: EN 1998-1:2004, Eqs. 3.13-3.16.
        """
        shape = self._shape(period)
        bounded = np.where(self.lower_bound_governs(period), self.beta, shape)
        return self.gamma_I * (self.a_gR * bounded)

    def lower_bound_governs(self, period: ArrayLike) -> np.ndarray:
        """Return whether beta a_g stands in place of the branch of the spectrum, in the shape of `period`.

        Where it does, a larger q saves nothing any more: forces stay, and only the demands of ductility grow.

        Args:
            period: s, of any shape; not negative.
        """
        return (np.asarray(period) > self.corners[1]) & (self._shape(period) < self.beta)

    def _shape(self, period: ArrayLike) -> np.ndarray:
        """S_d(T) / a_g without the lower bound."""
        return self.S * four_branches(period, self.corners, start=2.0 / 3.0, plateau=self.F_0 / self.q)


def vertical_design_spectrum(
    elastic: VerticalSpectrum, q: float = LARGEST_VERTICAL_Q, beta: float = 0.2, justified: bool = False
) -> DesignSpectrum:
    """Return the design spectrum of the vertical component: a_vg for a_g, S = 1, corner periods of the vertical.

    Args:
        elastic: the vertical elastic spectrum; its damping does not enter.
        q: behaviour factor.
        beta: lower bound factor.
        justified: an appropriate analysis justifies a q above 1.5.

    Raises:
        InputError: q is above 1.5 and not justified.

    Source: EN 1998-1:2004, 3.2.2.5(5)-(7).
    """
    if q > LARGEST_VERTICAL_Q and not justified:
        raise InputError(
            f"q = {q:g} is too large for the vertical component: up to {LARGEST_VERTICAL_Q:g} is generally adopted, "
            "more must be justified by an appropriate analysis (EN 1998-1, 3.2.2.5(6) and (7)) [E-EC8-01]"
        )
    p = elastic.parameters
    label = f"EN 1998-1 design, vertical, q = {q:g}"
    corners = (p.T_B, p.T_C, p.T_D)
    return DesignSpectrum(elastic.a_gR * p.ratio, 1.0, corners, q, elastic.gamma_I, beta, label)
