"""Rotation capacities of steel W-section beams from tests.

Source: Lignos & Krawinkler 2011, Deterioration modeling of steel components in support of collapse prediction of steel
moment frames under earthquake loading, Journal of Structural Engineering 137(11), 1291-1302; regressions for beams
other than with a reduced section, for those of at least 533 mm (21 in) depth, and with a reduced section.
"""

from __future__ import annotations

from dataclasses import dataclass

DEEP = 0.533
"""Depth in m from which the regression of deep beams counts; depths are taken over it (533 mm)."""
NOMINAL_YIELD = 355e6
"""Yield stress in Pa over which yield stresses are taken."""
ULTIMATE_ROTATION = 0.2
"""theta_u, rad: 0.06 in tests with many cycles; near collapse, with few large ones, more (ATC-72-1, 3.2.3)."""
RESIDUAL_RATIO = 0.4
"""kappa, residual over effective yield moment, mean of the tests."""
EFFECTIVE_YIELD = {"other": 1.17, "reduced": 1.06}
"""M_y / M_p of the tests, mean: with the isotropic hardening of the first cycles, other sections and reduced ones."""
CAPPING_RATIO = {"other": 1.11, "reduced": 1.09}
"""M_c / M_y, mean of the tests."""


@dataclass(frozen=True)
class RotationCapacity:
    """Rotations and deterioration of a plastic hinge by the regressions.

    Attributes:
        plastic: theta_p, rad.
        post_capping: theta_pc, rad.
        Lambda: reference cumulative plastic rotation, rad.
    """

    plastic: float
    post_capping: float
    Lambda: float


def rotation_capacity(
    web_slenderness: float,
    flange_slenderness: float,
    unbraced_slenderness: float,
    shear_span_ratio: float,
    depth: float,
    yield_stress: float,
    reduced: bool,
) -> RotationCapacity:
    """Return the rotation capacities of a beam.

    Args:
        web_slenderness: h / t_w, h between fillets.
        flange_slenderness: b_f / (2 t_f).
        unbraced_slenderness: L_b / r_y.
        shear_span_ratio: L / d, from the hinge to the point of inflection.
        depth: d, m.
        yield_stress: expected, Pa.
        reduced: whether the beam has a reduced section (RBS).
    """
    h, f, b, s = web_slenderness, flange_slenderness, unbraced_slenderness, shear_span_ratio
    d, y = depth / DEEP, yield_stress / NOMINAL_YIELD
    if reduced:
        return RotationCapacity(
            0.19 * h**-0.314 * f**-0.100 * b**-0.185 * s**0.113 * d**-0.760 * y**-0.070,
            9.52 * h**-0.513 * f**-0.863 * b**-0.108 * y**-0.360,
            585.0 * h**-1.14 * f**-0.632 * b**-0.205 * y**-0.391,
        )
    if depth >= DEEP:
        return RotationCapacity(
            0.318 * h**-0.550 * f**-0.345 * b**-0.023 * s**0.090 * d**-0.330 * y**-0.130,
            7.50 * h**-0.610 * f**-0.710 * b**-0.110 * d**-0.161 * y**-0.320,
            536.0 * h**-1.26 * f**-0.525 * b**-0.130 * y**-0.291,
        )
    return RotationCapacity(
        0.0865 * h**-0.365 * f**-0.140 * s**0.340 * d**-0.721 * y**-0.230,
        5.63 * h**-0.565 * f**-0.800 * d**-0.280 * y**-0.430,
        495.0 * h**-1.34 * f**-0.595 * y**-0.360,
    )
