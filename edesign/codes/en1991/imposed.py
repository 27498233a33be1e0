"""Categories of imposed loads and their reduction, EN 1991-1-1:2002, 6.2 and 6.3."""

from __future__ import annotations

from edesign.codes.names import unknown
from edesign.codes.quantities import check_not_negative, check_positive
from edesign.errors import InputError

CATEGORIES = {
    "A": "domestic and residential",
    "B": "offices",
    "C": "congregation of people",
    "D": "shopping",
    "E": "storage and industrial",
    "F": "traffic, vehicles up to 30 kN",
    "G": "traffic, vehicles of 30 kN to 160 kN",
    "H": "roofs, only accessible for maintenance and repair",
}
"""Categories of use. Source: EN 1991-1-1:2002, Tables 6.1, 6.3, 6.7 and 6.9."""

REFERENCE_AREA = 10.0
"""A_0, m2. Source: EN 1991-1-1:2002, 6.3.1.2(10)."""
LEAST_ALPHA_A = 0.6
"""Lower limit of alpha_A for categories C and D. Source: the same."""

REDUCED = "ABCD"
"""Categories whose loads may be reduced. Source: EN 1991-1-1:2002, 6.3.1.2(10) and (11)."""


def alpha_A(area: float, category: str, psi_0: float) -> float:
    """Return alpha_A = 5/7 psi_0 + A_0/A <= 1: the reduction of an imposed load by the area that a member carries.

    Args:
        area: A, loaded area, m2.
        category: A, B, C or D; in C and D the factor is at least 0.6.
        psi_0: combination factor of the category (EN 1990, Table A1.1).

    Raises:
        InputError: the loads of the category are not reduced, or a number makes no sense.

    Source: EN 1991-1-1:2002, 6.3.1.2(10), Eq. 6.1; 6.2.1(4) allows it for floors, beams and roofs.
    """
    _check_category(category)
    check_positive(area=area)
    check_not_negative(psi_0=psi_0)
    factor = min(5.0 / 7.0 * psi_0 + REFERENCE_AREA / area, 1.0)
    return max(factor, LEAST_ALPHA_A) if category in "CD" else factor


def alpha_n(storeys: int, category: str, psi_0: float, leading: bool = True) -> float:
    """Return alpha_n = (2 + (n - 2) psi_0) / n: the reduction of imposed loads of several storeys in a column or wall.

    It applies to the total of more than two storeys of one category; for up to two it is 1.

    Args:
        storeys: n, loaded storeys above the member.
        category: A, B, C or D.
        psi_0: combination factor of the category (EN 1990, Table A1.1).
        leading: the load leads its combination; as an accompanying action psi reduces it already, and alpha_n is 1.

    Raises:
        InputError: the loads of the category are not reduced, or a number makes no sense.

    Source: EN 1991-1-1:2002, 6.3.1.2(11), Eq. 6.2; 6.2.2(2) allows it for columns and walls, 3.3.2(2)P not with psi.
    """
    _check_category(category)
    check_not_negative(storeys=storeys, psi_0=psi_0)
    return 1.0 if storeys <= 2 or not leading else (2.0 + (storeys - 2) * psi_0) / storeys


def _check_category(category: str) -> None:
    if category not in CATEGORIES:
        raise unknown("category of imposed load", category, CATEGORIES)
    if category not in REDUCED:
        raise InputError(
            f"imposed loads of category {category} ({CATEGORIES[category]}) are not reduced; EN 1991-1-1, 6.3.1.2(10) "
            "and (11) allow it for categories A to D [E-EN1990-03]"
        )
