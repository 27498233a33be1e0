"""Behaviour factor of steel buildings, NTC 2018, 7.3.1, 7.5.2.2 and 7.5.3.2."""

from __future__ import annotations

from edesign.codes.ec8.analysis.regularity import IRREGULAR_Q
from edesign.codes.ec8.steel.behaviour_factor import reference_q

NON_DISSIPATIVE_SHARE = 2.0 / 3.0
"""q_ND over q of class B. Source: NTC 2018, 7.3.1, Eq. 7.3.2."""
LARGEST_NON_DISSIPATIVE_Q = 1.5
"""Source: NTC 2018, 7.3.1, Eq. 7.3.2 and Table 7.3.I."""


def limit_of_q(
    system: str,
    ductility: str,
    alpha_ratio: float = 1.0,
    regular_in_elevation: bool = True,
    low_ductility_q: float = 1.5,
) -> float:
    """Return q_lim = q_0 K_R, or q_ND of buildings that do not dissipate energy.

    The base values q_0 of Table 7.3.II for steel, and alpha_u / alpha_1 of 7.5.2.2, are those of EN 1998-1, Table 6.2
    and Figures 6.1-6.8. K_R is 1 of buildings regular in elevation, else 0.8.

    Args:
        system: structural type, as in `edesign.codes.ec8.steel.behaviour_factor`.
        ductility: `high` for class A, `medium` for class B, `low` for a building that does not dissipate energy.
        alpha_ratio: alpha_u / alpha_1; counts in class A.
        regular_in_elevation: otherwise K_R is 0.8.
        low_ductility_q: does not count; the code has its own.

    Returns:
        q, dimensionless.

    Raises:
        InputError: there is no such system or class, or a number is out of its range.

    Source: NTC 2018, 7.3.1, Eqs. 7.3.1 and 7.3.2, Table 7.3.II.
    """
    K_R = 1.0 if regular_in_elevation else IRREGULAR_Q
    if ductility != "low":
        return K_R * reference_q(system, ductility, alpha_ratio)
    return non_dissipative_q(K_R * reference_q(system, "medium"))


def non_dissipative_q(q_B: float) -> float:
    """Return q_ND = 2/3 q of class B, at least 1 and at most 1.5.

    Args:
        q_B: behaviour factor of the same building in class B.

    Source: NTC 2018, 7.3.1, Eq. 7.3.2.
    """
    return min(max(NON_DISSIPATIVE_SHARE * q_B, 1.0), LARGEST_NON_DISSIPATIVE_Q)


def largest_section_class(ductility: str, q_0: float) -> int:
    """Return the largest class of section that dissipative members may have.

    Args:
        ductility: `high` for class A, `medium` for class B, `low` for a building that does not dissipate energy.
        q_0: base value of the behaviour factor that the design uses.

    Source: NTC 2018, 7.5.3.2, Table 7.5.I: class 1 for q_0 above 4, else class 1 or 2, which 7.5.5 asks of all
        diagonals. Buildings that do not dissipate energy have no such rule (7.3.6).
    """
    if ductility == "low":
        return 4
    return 1 if q_0 > 4.0 else 2


def limit_of_q_for_damage(q_ND: float, S_e_SLV: float, S_e_SLD: float) -> float:
    """Return q' = q_ND S_e,SLV(T_1) / S_e,SLD(T_1), up to which members that resist SLV resist SLD as well.

    Args:
        q_ND: behaviour factor of the building if it did not dissipate energy.
        S_e_SLV: elastic ordinate of SLV at T_1 of the direction, m/s2.
        S_e_SLD: elastic ordinate of SLD at T_1, m/s2.

    Source: Circolare 7/2019, C7.3.1, Eq. C7.3.1.
    """
    return q_ND * S_e_SLV / S_e_SLD
