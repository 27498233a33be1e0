"""Displacements of the structure under the design seismic action, NTC 2018, 7.3.3.3."""

from __future__ import annotations


def displacement_ductility(q: float, T_1: float, T_C: float) -> float:
    """Return mu_d, by which displacements of the linear analysis at SLV are multiplied: d_E = mu_d d_Ee.

    Args:
        q: behaviour factor.
        T_1: period of the main mode in the direction, s.
        T_C: corner period of the spectrum, s.

    Returns:
        q for T_1 >= T_C, else 1 + (q - 1) T_C / T_1, and at most 5 q - 4.

    Source: NTC 2018, 7.3.3.3, Eqs. 7.3.8 and 7.3.9.
    """
    return min(q if T_1 >= T_C else 1.0 + (q - 1.0) * T_C / T_1, 5.0 * q - 4.0)
