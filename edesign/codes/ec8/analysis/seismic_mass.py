"""Masses in the seismic design situation, EN 1998-1:2004, 3.2.4 and 4.2.4."""

from __future__ import annotations

from collections.abc import Mapping

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
