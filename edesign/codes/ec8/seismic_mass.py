"""Masses in the seismic design situation, EN 1998-1:2004, 3.2.4 and 4.2.4."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.codes.quantities import check_not_negative

_WITH_STOREYS = "ABC"


def phi(category: str, factors: Mapping[str, float], roof: bool = False, correlated: bool = False) -> float:
    """Return phi of Table 4.2: what share of the quasi-permanent load is thought to be there in all storeys at once.

    Args:
        category: of the action: A to H, `snow`, ...; only A, B and C have a phi below 1.
        factors: `NationalParameters.phi`.
        roof: the load stands on the roof.
        correlated: the storeys have correlated occupancies; otherwise they are occupied independently.

    Source: EN 1998-1:2004, 4.2.4(2)P, Table 4.2.
    """
    if category not in _WITH_STOREYS:
        return factors["other"]
    if roof:
        return factors["roof"]
    return factors["correlated" if correlated else "independent"]


def psi_E(phi: float, psi_2: float) -> float:
    """Return psi_E = phi psi_2, the share of a variable load that has mass in an earthquake.

    Args:
        phi: by storey and category, Table 4.2.
        psi_2: quasi-permanent factor of the load.

    Source: EN 1998-1:2004, 4.2.4(2)P, Eq. 4.2.
    """
    check_not_negative(phi=phi, psi_2=psi_2)
    return phi * psi_2
