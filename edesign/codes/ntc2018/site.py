"""What the ground and the relief of a site do to the action on rock, NTC 2018, 3.2.2 and 3.2.3.2.1."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

from edesign.codes.names import unknown
from edesign.codes.quantities import STANDARD_GRAVITY

TOPOGRAPHY = MappingProxyType({"T1": 1.0, "T2": 1.2, "T3": 1.2, "T4": 1.4})
"""Largest topographic amplification S_T by category, at the top of slope or ridge. Source: NTC 2018, Table 3.2.V."""


@dataclass(frozen=True)
class _Ground:
    """S_S = constant - slope F_0 a_g/g within bounds, and C_C = factor (T_C*)^exponent."""

    constant: float
    slope: float
    bounds: tuple[float, float]
    factor: float
    exponent: float


_TABLE_3_2_IV = MappingProxyType(
    {
        "A": _Ground(1.00, 0.00, (1.00, 1.00), 1.00, 0.00),
        "B": _Ground(1.40, 0.40, (1.00, 1.20), 1.10, -0.20),
        "C": _Ground(1.70, 0.60, (1.00, 1.50), 1.05, -0.33),
        "D": _Ground(2.40, 1.50, (0.90, 1.80), 1.25, -0.50),
        "E": _Ground(2.00, 1.10, (1.00, 1.60), 1.15, -0.40),
    }
)


@dataclass(frozen=True)
class Site:
    """Category of the subsoil and topographic amplification.

    Attributes:
        ground: category of the subsoil, A to E.
        S_T: topographic amplification factor, at least 1.

    Source: NTC 2018, 3.2.2, Tables 3.2.II, 3.2.IV and 3.2.V.
    """

    ground: str
    S_T: float = 1.0

    def __post_init__(self) -> None:
        if self.ground not in _TABLE_3_2_IV:
            raise unknown("category of subsoil", self.ground, _TABLE_3_2_IV)

    def S_S(self, a_g: float, F_0: float) -> float:
        """Return the stratigraphic amplification factor.

        Args:
            a_g: on rock, m/s2.
            F_0: largest amplification of the spectrum on rock.
        """
        row = _TABLE_3_2_IV[self.ground]
        low, high = row.bounds
        return min(max(row.constant - row.slope * F_0 * a_g / STANDARD_GRAVITY, low), high)

    def C_C(self, T_C_star: float) -> float:
        """Return the factor on T_C*, which gives T_C.

        Args:
            T_C_star: T_C*, s.
        """
        row = _TABLE_3_2_IV[self.ground]
        return float(row.factor * T_C_star**row.exponent)
