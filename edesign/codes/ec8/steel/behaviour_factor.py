"""Behaviour factor and ductility classes of steel buildings, EN 1998-1:2004, 6.1.2, 6.3 and 6.5.3."""

from __future__ import annotations

from typing import Literal

from edesign.codes.ec8.analysis.regularity import IRREGULAR_Q
from edesign.codes.names import unknown
from edesign.errors import InputError

Ductility = Literal["low", "medium", "high"]
"""DCL, DCM, DCH."""

LARGEST_ALPHA_RATIO = 1.6
"""alpha_u / alpha_1, even from a pushover analysis. Source: EN 1998-1:2004, 6.3.2(6)."""
LOWEST_Q = 1.5
"""q of class low that irregularity need not reduce, and up to which no class of section is asked.

Source: EN 1998-1:2004, 6.1.2(3) and (4).
"""
LARGEST_LOW_DUCTILITY_Q = 2.0
"""Upper end of q for DCL that a National Annex may choose. Source: EN 1998-1:2004, Table 6.1 and its note."""

# q of DCM, q of DCH, and whether the latter is multiplied by alpha_u / alpha_1
_LIMITS: dict[str, tuple[float, float, bool]] = {
    "moment_frame": (4.0, 5.0, True),
    "concentric_diagonal": (4.0, 4.0, False),
    "concentric_v": (2.0, 2.5, False),
    "eccentric": (4.0, 5.0, True),
    "inverted_pendulum": (2.0, 2.0, True),
    "moment_frame_with_concentric_bracing": (4.0, 4.0, True),
    "moment_frame_with_infills_in_contact": (2.0, 2.0, False),
    "moment_frame_with_isolated_infills": (4.0, 5.0, True),
}
SYSTEMS = tuple(_LIMITS)
"""Structural types of Table 6.2, but those with concrete cores, walls or connected infills, which are not of steel."""


def alpha_ratio(system: str, storeys: int, bays: int, regular_in_plan: bool = True) -> float:
    """Return the default of alpha_u / alpha_1, the overstrength of the system beyond its first hinge.

    Args:
        system: one of `SYSTEMS`.
        storeys: number of storeys of the frame.
        bays: number of bays of the frame.
        regular_in_plan: otherwise the mean of 1 and the default.

    Returns:
        alpha_u / alpha_1, dimensionless.

    Raises:
        InputError: there is no such system, or it has no storey or bay.

    Source: EN 1998-1:2004, Figures 6.1-6.8 with 6.3.2(3): 1.1 for moment frames of one storey, 1.2 for one bay, 1.3 for
        several storeys and bays; 1.2 for eccentric bracings and for moment frames with concentric bracings; 1.0 for
        inverted pendulums with dissipative zones at the base of their columns. 6.3.2(4) for irregular plans. Where
        Table 6.2 has no such factor it is 1.
    """
    _check_system(system)
    if storeys < 1 or bays < 1:
        raise InputError(f"a frame has at least one storey and one bay, not {storeys} and {bays} [E-VALUE-02]")
    if system in ("moment_frame", "moment_frame_with_isolated_infills"):
        ratio = 1.1 if storeys == 1 else 1.2 if bays == 1 else 1.3
    elif system in ("eccentric", "moment_frame_with_concentric_bracing"):
        ratio = 1.2
    else:
        ratio = 1.0
    return ratio if regular_in_plan else 0.5 * (1.0 + ratio)


def reference_q(system: str, ductility: str, alpha_ratio: float = 1.0, low_ductility_q: float = 1.5) -> float:
    """Return the upper limit of the behaviour factor of a system that is regular in elevation.

    Args:
        system: one of `SYSTEMS`.
        ductility: `low`, `medium` or `high`.
        alpha_ratio: alpha_u / alpha_1; counts in class high where Table 6.2 says so.
        low_ductility_q: of the country, 1.5 to 2 (`NationalParameters.low_ductility_q`).

    Raises:
        InputError: there is no such system or class, or a number is out of its range.

    Source: EN 1998-1:2004, 6.3.2(1), Table 6.2; Table 6.1; 6.1.2(1).
    """
    _check_system(system)
    _check_ductility(ductility)
    if not 1.0 <= alpha_ratio <= LARGEST_ALPHA_RATIO:
        raise InputError(
            f"alpha_u / alpha_1 lies between 1 and {LARGEST_ALPHA_RATIO}, not {alpha_ratio:g} (EN 1998-1, 6.3.2(6))"
            " [E-VALUE-02]"
        )
    if not 1.0 <= low_ductility_q <= LARGEST_LOW_DUCTILITY_Q:
        raise InputError(
            f"q of ductility class low is at most {LARGEST_LOW_DUCTILITY_Q:g}, not {low_ductility_q:g} [E-VALUE-02]"
        )
    medium, high, with_ratio = _LIMITS[system]
    if ductility == "low":
        return low_ductility_q
    if ductility == "medium":
        return medium
    return high * alpha_ratio if with_ratio else high


def behaviour_factor(
    system: str,
    ductility: str,
    alpha_ratio: float = 1.0,
    regular_in_elevation: bool = True,
    low_ductility_q: float = 1.5,
) -> float:
    """Return the upper limit of the behaviour factor q, regularity in elevation included.

    Args:
        system: one of `SYSTEMS`.
        ductility: ductility class: `low`, `medium` or `high`.
        alpha_ratio: alpha_u / alpha_1.
        regular_in_elevation: otherwise q is reduced by 20 %.
        low_ductility_q: q of ductility class low.

    Returns:
        q, dimensionless.

    Raises:
        InputError: as `reference_q`.

    Source: EN 1998-1:2004, 6.3.2(1) and (2), 4.2.3.1(7); 6.1.2(3): in class low no less than 1.5 is needed.
    """
    q = reference_q(system, ductility, alpha_ratio, low_ductility_q)
    if regular_in_elevation:
        return q
    return max(IRREGULAR_Q * q, min(q, LOWEST_Q)) if ductility == "low" else IRREGULAR_Q * q


def largest_section_class(ductility: str, q: float) -> int:
    """Return the largest cross-sectional class (EN 1993-1-1) that dissipative members may have.

    Args:
        ductility: `low`, `medium` or `high`.
        q: reference value of the behaviour factor, before a reduction for irregularity.

    Raises:
        InputError: there is no such class of ductility, or q is above 4 in class medium.

    Source: EN 1998-1:2004, 6.5.3(2), Table 6.3: class 1 in DCH; in DCM class 1 or 2 for q above 2, else up to 3. DCL
        needs nothing up to q = 1.5, and up to class 3 beyond (6.1.2(4)). The table gives DCH for q above 4 only;
        class 1 is taken here for every q of DCH.
    """
    _check_ductility(ductility)
    if ductility == "high":
        return 1
    if ductility == "medium":
        if q > 4.0:
            raise InputError(
                f"q = {q:g} is too large for ductility class medium: at most 4 (EN 1998-1, Table 6.1) [E-EC8-01]"
            )
        return 2 if q > 2.0 else 3
    return 3 if q > LOWEST_Q else 4


def _check_system(system: str) -> None:
    if system not in _LIMITS:
        raise unknown("structural type", system, _LIMITS)


def _check_ductility(ductility: str) -> None:
    if ductility not in ("low", "medium", "high"):
        raise unknown("ductility class", ductility, ("low", "medium", "high"))
