"""Bilinear idealisation of a capacity curve, FEMA 356, 3.3.3.2.4; ASCE/SEI 41 has the same first two lines."""

from __future__ import annotations

import math
from dataclasses import dataclass

from edesign.codes.capacity_curve import SETTLED, CapacityCurve, zero

SECANT = 0.6
"""The first line has the slope of the secant at this share of the yield strength. Source: FEMA 356, 3.3.3.2.4."""


@dataclass(frozen=True)
class Bilinear:
    """Two lines that stand for a capacity curve up to a displacement.

    Attributes:
        K_i: initial slope of the curve, N/m.
        K_e: effective lateral stiffness, N/m.
        V_y: effective yield strength, N.
        D_y: V_y / K_e, m.
        V_d, D_d: where the second line ends, on the curve, N and m.
    """

    K_i: float
    K_e: float
    V_y: float
    D_y: float
    V_d: float
    D_d: float

    @property
    def alpha(self) -> float:
        """Slope of the second line over K_e; 1 where the curve is straight."""
        length = self.D_d - self.D_y
        return (self.V_d - self.V_y) / length / self.K_e if length > SETTLED * self.D_d else 1.0

    def effective_period(self, period: float) -> float:
        """Return T_e = T_i sqrt(K_i / K_e), s.

        Args:
            period: elastic fundamental period T_i, s.

        Source: FEMA 356, Eq. 3-14; ASCE/SEI 41-17, Eq. 7-27.
        """
        return period * math.sqrt(self.K_i / self.K_e)


def bilinear(curve: CapacityCurve, D_d: float) -> Bilinear:
    """Return the two lines with the area of the curve below them.

    The yield strength is at most the largest base shear. Of a curve that is straight up to D_d any strength would do;
    it is then the base shear at D_d.

    Args:
        curve: base shear against displacement of the control node.
        D_d: where the second line ends, m.

    Source: FEMA 356, 3.3.3.2.4 and Figure 3-1; ASCE/SEI 41-17, 7.4.3.2.4 and Figure 7-3.
    """
    V_d, energy, most = curve.force_at(D_d), curve.energy(D_d), curve.largest_up_to(D_d)

    def lines(V_y: float) -> Bilinear:
        K_e = SECANT * V_y / curve.first_at(SECANT * V_y)
        return Bilinear(curve.stiffness, K_e, V_y, V_y / K_e, V_d, D_d)

    def excess(V_y: float) -> float:
        found = lines(V_y)
        return 0.5 * V_y * D_d + 0.5 * V_d * (D_d - found.D_y) - energy

    if excess(most) <= SETTLED * energy or excess(SETTLED * most) >= 0.0:  # straight, or stiffening throughout
        return lines(most)
    return lines(zero(excess, SETTLED * most, most))
