"""The regressions of Lignos & Krawinkler (2011) against what others have of them, in full and rounded."""

from __future__ import annotations

import math

import pytest

from edesign.codes.lignos_krawinkler import CAPPING_RATIO, EFFECTIVE_YIELD, RESIDUAL_RATIO, rotation_capacity

# exponents of h/t_w, b_f/2t_f, L_b/r_y, L/d, d/533 mm, F_y/355 MPa, as public programs have them, which agree:
# reduced: GUAN-XINGQUAN/AutoSDAPlatform, beam_component.py; deep and shallow: DonCammne/OpenSeesPyAssistant, class
# ModifiedIMK; shallow: ioannis-vm/OpenSees_Model_Generator, too
PROGRAMS = {
    ("reduced", 0.70): (
        (0.19, -0.314, -0.100, -0.185, 0.113, -0.760, -0.070),
        (9.52, -0.513, -0.863, -0.108, 0.0, 0.0, -0.360),
        (585.0, -1.14, -0.632, -0.205, 0.0, 0.0, -0.391),
    ),
    ("deep", 0.70): (
        (0.318, -0.550, -0.345, -0.023, 0.090, -0.330, -0.130),
        (7.50, -0.610, -0.710, -0.110, 0.0, -0.161, -0.320),
        (536.0, -1.26, -0.525, -0.130, 0.0, 0.0, -0.291),
    ),
    ("shallow", 0.45): (
        (0.0865, -0.365, -0.140, 0.0, 0.340, -0.721, -0.230),
        (5.63, -0.565, -0.800, 0.0, 0.0, -0.280, -0.430),
        (495.0, -1.34, -0.595, 0.0, 0.0, 0.0, -0.360),
    ),
}


@pytest.mark.parametrize(("kind", "depth"), PROGRAMS)
def test_regressions_as_other_programs_have_them(kind: str, depth: float) -> None:
    found = rotation_capacity(45.0, 6.5, 48.0, 4.6, depth, 380e6, reduced=kind == "reduced")
    values = (45.0, 6.5, 48.0, 4.6, depth / 0.533, 380.0 / 355.0)
    expected = [
        factor * math.prod(value**exponent for value, exponent in zip(values, exponents, strict=True))
        for factor, *exponents in PROGRAMS[kind, depth]
    ]
    assert [found.plastic, found.post_capping, found.Lambda] == pytest.approx(expected, rel=1e-12)


def test_means_of_the_tests_as_other_programs_have_them() -> None:
    """1.17 and 1.06 M_p, M_c 1.11 and 1.09 M_y, kappa 0.4: OpenSees_Model_Generator, AutoSDAPlatform, ModifiedIMK."""
    assert EFFECTIVE_YIELD == {"other": 1.17, "reduced": 1.06}
    assert CAPPING_RATIO == {"other": 1.11, "reduced": 1.09}
    assert RESIDUAL_RATIO == 0.4


@pytest.mark.parametrize("depth", [0.6, 0.76, 0.9])
@pytest.mark.parametrize("flange", [5.0, 7.0])
def test_reduced_beams_by_the_rounded_forms_of_nist(depth: float, flange: float) -> None:
    """NIST GCR 17-917-46 (2017) rounds exponents and takes L_b / r_y = 50 into the factors: within 12 %.

    theta_p = 0.09 (h/tw)^-0.3 (bf/2tf)^-0.1 (L/d)^0.1 (d/21")^-0.8, theta_pc = 6.5 (h/tw)^-0.5 (bf/2tf)^-0.9.
    """
    web, span = 45.0, 5.0
    found = rotation_capacity(web, flange, 50.0, span, depth, 355e6, reduced=True)
    rounded = 0.09 * web**-0.3 * flange**-0.1 * span**0.1 * (depth / 0.533) ** -0.8
    assert found.plastic == pytest.approx(rounded, rel=0.12)
    assert found.post_capping == pytest.approx(6.5 * web**-0.5 * flange**-0.9, rel=0.12)


@pytest.mark.parametrize("depth", [0.3, 0.45, 0.533, 0.7])
def test_other_beams_by_the_rounded_forms_of_nist(depth: float) -> None:
    """The same for other beams within 12 %; deep ones, for which another regression counts, within 30 %.

    theta_p = 0.07 (h/tw)^-0.3 (bf/2tf)^-0.1 (L/d)^0.3 (d/21")^-0.7,
    theta_pc = 4.6 (h/tw)^-0.5 (bf/2tf)^-0.8 (d/21")^-0.3.
    """
    web, flange, span = 45.0, 6.5, 5.0
    found = rotation_capacity(web, flange, 50.0, span, depth, 355e6, reduced=False)
    plastic = 0.07 * web**-0.3 * flange**-0.1 * span**0.3 * (depth / 0.533) ** -0.7
    capping = 4.6 * web**-0.5 * flange**-0.8 * (depth / 0.533) ** -0.3
    tolerance = 0.12 if depth < 0.533 else 0.3
    assert found.plastic == pytest.approx(plastic, rel=tolerance)
    assert found.post_capping == pytest.approx(capping, rel=tolerance)


def test_capacities_fall_with_slenderness_depth_and_strength() -> None:
    one = rotation_capacity(40.0, 6.0, 50.0, 5.0, 0.5, 355e6, reduced=False)
    for changed in (
        (50.0, 6.0, 0.5, 355e6),
        (40.0, 7.0, 0.5, 355e6),
        (40.0, 6.0, 0.53, 355e6),
        (40.0, 6.0, 0.5, 400e6),
    ):
        web, flange, depth, stress = changed
        other = rotation_capacity(web, flange, 50.0, 5.0, depth, stress, reduced=False)
        assert other.plastic < one.plastic and other.post_capping < one.post_capping and other.Lambda <= one.Lambda
