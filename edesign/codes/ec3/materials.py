"""Structural steels: material coefficients, yield stress and ultimate strength by thickness.

Two sets of values exist, and the National Annex chooses (EN 1993-1-1:2005, 3.2.1(1)): those of the product standard
EN 10025-2, which fall in six steps of thickness, and those of Table 3.1, with two.
"""

from __future__ import annotations

from typing import Literal

from edesign.codes.names import unknown
from edesign.errors import InputError

E = 210e9
"""Modulus of elasticity, Pa. Source: EN 1993-1-1:2005, 3.2.6."""
NU = 0.3
"""Poisson's ratio. Source: EN 1993-1-1:2005, 3.2.6."""
G = E / (2.0 * (1.0 + NU))
"""Shear modulus, Pa; the clause rounds it to 81 GPa. Source: EN 1993-1-1:2005, 3.2.6."""

Standard = Literal["en10025-2", "table-3.1"]

_EN_10025_2: dict[str, tuple[tuple[float, float, float], ...]] = {  # thickness up to, mm; f_y; f_u, MPa
    "S235": ((16, 235, 360), (40, 225, 360), (63, 215, 360), (80, 215, 360), (100, 215, 360), (150, 195, 350)),
    "S275": ((16, 275, 410), (40, 265, 410), (63, 255, 410), (80, 245, 410), (100, 235, 410), (150, 225, 400)),
    "S355": ((16, 355, 470), (40, 345, 470), (63, 335, 470), (80, 325, 470), (100, 315, 470), (150, 295, 450)),
    "S450": ((16, 450, 550), (40, 430, 550), (63, 410, 550), (80, 390, 550), (100, 380, 550), (150, 380, 530)),
}
"""Source: EN 10025-2:2004, Table 7."""

GRADES = tuple(_EN_10025_2)

_TABLE_3_1: dict[str, tuple[tuple[float, float, float], ...]] = {
    "S235": ((40, 235, 360), (80, 215, 360)),
    "S275": ((40, 275, 430), (80, 255, 410)),
    "S355": ((40, 355, 490), (80, 335, 470)),
    "S450": ((40, 440, 550), (80, 410, 550)),
    "S235H": ((40, 235, 360), (80, 215, 340)),
    "S275H": ((40, 275, 430), (80, 255, 410)),
    "S355H": ((40, 355, 510), (80, 335, 490)),
}
"""Source: EN 1993-1-1:2005 + AC:2009, Table 3.1: EN 10025-2, and hollow sections of EN 10210-1 (H)."""

_TABLES = {"en10025-2": _EN_10025_2, "table-3.1": _TABLE_3_1}


def yield_stress(grade: str, thickness: float, standard: Standard = "en10025-2") -> float:
    """Return f_y, Pa, of a steel.

    Args:
        grade: S235, S275, S355 or S450; with an H behind it (Table 3.1 only) that of hollow sections.
        thickness: of the thickest part, m.

    Raises:
        InputError: there is no such steel, or it is not made so thick.

    Source: EN 10025-2:2004, Table 7; EN 1993-1-1:2005, Table 3.1.
    """
    return _row(grade, thickness, standard)[1] * 1e6


def ultimate_strength(grade: str, thickness: float, standard: Standard = "en10025-2") -> float:
    """Return f_u, Pa, of a steel; of EN 10025-2 the lower bound.

    Args:
        grade: see `yield_stress`.
        thickness: m.
        standard: see `yield_stress`.

    Raises:
        InputError: as `yield_stress`.
    """
    return _row(grade, thickness, standard)[2] * 1e6


def thickness_step(grade: str, thickness: float, standard: Standard = "en10025-2") -> float:
    """Return up to which thickness the values of `yield_stress` hold, m.

    Args:
        grade: see `yield_stress`.
        thickness: m.
        standard: see `yield_stress`.

    Raises:
        InputError: as `yield_stress`.
    """
    return _row(grade, thickness, standard)[0] * 1e-3


def _row(grade: str, thickness: float, standard: Standard) -> tuple[float, float, float]:
    if standard not in _TABLES:
        raise unknown("table of steels", standard, _TABLES)
    table = _TABLES[standard]
    if grade not in table:
        raise unknown("steel", grade, table)
    if not thickness > 0.0:
        raise InputError(f"a thickness of {1e3 * thickness:g} mm is not greater than zero [E-VALUE-02]")
    for row in table[grade]:
        if 1e3 * thickness <= row[0] * (1.0 + 1e-12):  # a size typed in mm is not exact in m
            return row
    raise InputError(
        f"{grade} of {1e3 * thickness:g} mm is thicker than {table[grade][-1][0]:g} mm, where {standard} ends"
        " [E-EC3-02]"
    )
