"""EN 1993-1-1: limits, continuity and what is impossible; worked examples are in tests/published/test_ec3_*.py."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from edesign.codes.ec3 import classes, cross_section, imperfections, lateral_torsional, materials, moment_factors
from edesign.codes.ec3.interaction import annex_b_factors
from edesign.codes.ec3.member import Member, Stability, Strength
from edesign.codes.ec3.section import Shape
from edesign.errors import InputError
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.steel_section import steel_section

ratios = st.floats(0.0, 1.5)


def test_table_5_2() -> None:
    """The rows for pure bending and pure compression are those of the row for both at alpha 0.5, psi -1 and 1, 1."""
    assert classes.internal_part_limits(1.0, 0.5, -1.0) == pytest.approx((72, 83, 124))
    assert classes.internal_part_limits(1.0) == pytest.approx((33, 38, 42))
    assert classes.internal_part_limits(1.0, 0.0, -2.0) == (math.inf, math.inf, math.inf)
    assert classes.outstand_limits(0.5) == (4.5, 5.0, 7.0)
    assert classes.tubular_limits(2.0) == (200, 280, 360)
    assert [classes.class_of_part(x, (33, 38, 42)) for x in (33, 33.1, 38.1, 42.1)] == [1, 2, 3, 4]
    assert classes.epsilon(235e6) == 1.0
    with pytest.raises(InputError, match="f_y: 0 Pa .*E-VALUE-02"):
        classes.epsilon(0.0)


@given(st.floats(0.5, 1.0), st.floats(0.0, 0.5))
def test_more_compression_lowers_the_limits(alpha: float, more: float) -> None:
    limits = classes.internal_part_limits(1.0, alpha, 2 * alpha - 2)
    lower = classes.internal_part_limits(1.0, min(alpha + more, 1.0), min(2 * alpha - 2 + more, 1.0))
    # the branches meet at alpha 0.5 and psi -1 within the rounding of the table: 62 x 2 is 124, 42 / 0.34 is 123.5
    assert all(b <= a * 1.005 for a, b in zip(limits, lower, strict=True))


def test_class_by_force_and_bending() -> None:
    ipe, fy = steel_section("IPE600"), 355e6
    assert section_class(ipe, fy).number == 1
    assert section_class(ipe, fy, N_Ed=-5e6, about_y=False).number == 4
    assert section_class(ipe, fy, N_Ed=5e6, about_y=False).number == 1  # tension
    assert section_class(ipe, fy, about_y=False, about_z=True).number == 1  # the web is not stressed
    numbers = [section_class(ipe, fy, N_Ed=-N).number for N in (0.0, 0.5e6, 1e6, 2e6, 4e6)]
    assert numbers == sorted(numbers) and numbers[-1] == 4
    tube = steel_section("SHS200x5")
    assert section_class(tube, 235e6, about_y=True).number == 2  # the flange, 37
    assert section_class(tube, 235e6, about_y=False, about_z=True).number == 2
    assert section_class(steel_section("CHS600x8"), 235e6).number == 3  # 75
    assert section_class(steel_section("CHS600x8"), 235e6, 1.0, about_y=False).number == 1
    wide = steel_section("RHS300x100x6")
    about_y = section_class(wide, 235e6).number
    assert about_y == 1 and section_class(wide, 235e6, about_y=False, about_z=True).number == 4  # walls of c/t 47


def test_materials() -> None:
    assert materials.yield_stress("S275", 0.016) == 275e6
    assert [materials.yield_stress("S275", t) for t in (0.0161, 0.04, 0.063, 0.0631)] == [265e6, 265e6, 255e6, 245e6]
    assert materials.yield_stress("S355", 0.04, "table-3.1") == 355e6
    assert materials.ultimate_strength("S355H", 0.05, "table-3.1") == 490e6
    with pytest.raises(InputError, match="no steel `S335`; did you mean `S355`"):
        materials.yield_stress("S335", 0.01)
    with pytest.raises(InputError, match="S275 of 200 mm .* 150 mm.*E-EC3-02"):
        materials.yield_stress("S275", 0.2)
    with pytest.raises(InputError, match="E-VALUE-02"):
        materials.yield_stress("S275", 0.0)


def test_shear_and_bending() -> None:
    assert cross_section.shear_reduction(0.5, 1.0) == 0.0
    assert cross_section.shear_reduction(-0.75, 1.0) == 0.25
    assert cross_section.shear_reduction(2.0, 1.0) == 1.0
    s, fy = steel_section("IPE330"), 235e6
    web = cross_section.moment_of_shear_area(s.h - 2 * s.tf, s.tw, fy)
    flanges = s.b * s.tf * (s.h - s.tf) * fy
    rest = cross_section.moment_resistance_with_shear(s.W_pl_y * fy, 1.0, web)
    lever = s.h / 2 - s.tf - 0.2234 * s.r  # of the fillets' centroid
    assert rest == pytest.approx(flanges + (4 - math.pi) * s.r**2 * lever * fy, rel=1e-5)
    hollow = Strength(Member(steel_section("RHS300x200x10"), fy, Stability(5.0, 5.0, 5.0), 1))
    assert hollow.M_of_shear_area("y") == pytest.approx(0.28**2 * 0.02 * fy / 4.0)  # both webs
    assert hollow.M_of_shear_area("z") == hollow.M_Rd("z")


def test_slenderness_of_a_web_is_that_of_a_long_plate_in_shear() -> None:
    """lambda_w^2 = (f_y / sqrt 3) / tau_cr, tau_cr = 5.34 pi2 E / (12 (1 - nu2)) (t / h)2 (Timoshenko & Gere, 9.7)."""
    h, t, fy = 1.2, 0.01, 355e6
    critical = 5.34 * math.pi**2 * materials.E / (12.0 * (1.0 - 0.3**2)) * (t / h) ** 2
    expected = math.sqrt(fy / math.sqrt(3.0) / critical)
    assert cross_section.web_slenderness(h, t, fy) == pytest.approx(expected, rel=1e-3)  # 86.4 has three digits


def test_shear_buckling_begins_where_the_code_asks_for_it() -> None:
    """At h_w / t_w = 72 epsilon the web buckles with 0.996 of its yielding, and with less beyond."""
    h = 72.0 * 0.01
    assert cross_section.shear_buckling_resistance(0.9999 * h, 0.01, 235e6, 1.0) == math.inf
    just, far = (cross_section.shear_buckling_resistance(x * h, 0.01, 235e6, 1.1) for x in (1.0001, 2.0))
    assert just == pytest.approx(0.83 / (72.0 / 86.4) * h * 0.01 * 235e6 / math.sqrt(3.0) / 1.1, rel=2e-4)
    assert far == pytest.approx(just, rel=2e-4)  # chi_w falls as h_w grows: the tension field beyond is left out


@pytest.mark.parametrize(("name", "fy", "share"), [("HEA900", 460e6, 0.803), ("UB762x267x134", 355e6, 0.859)])
def test_slender_webs_of_rolled_sections(name: str, fy: float, share: float) -> None:
    """V_b,Rd / V_pl,Rd by hand: 0.83 x 86.4 t2 epsilon / A_vz."""
    s = steel_section(name)
    expected = 0.83 * 86.4 * s.tw**2 * math.sqrt(235e6 / fy) / s.A_vz
    assert expected == pytest.approx(share, abs=5e-4)
    plastic = cross_section.shear_resistance(s.A_vz, fy)
    stability = Stability(5.0, 5.0, 5.0)
    assert Strength(Member(s, fy, stability, 1)).V_Rd("z") == pytest.approx(expected * plastic, rel=1e-12)
    assert Strength(Member(s, 235e6, stability, 1)).V_Rd("z") == cross_section.shear_resistance(s.A_vz, 235e6)


def _plastic_rectangles(h: float, b: float, tw: float, tf: float, n: float) -> float:
    """M/M_pl of an I section of three rectangles about y under n = N/N_pl, by the plastic neutral axis."""
    area, web = 2 * b * tf + (h - 2 * tf) * tw, (h - 2 * tf) * tw
    plastic = b * tf * (h - tf) + (h - 2 * tf) ** 2 * tw / 4
    if n * area <= web:
        return (plastic - (n * area) ** 2 / (4 * tw)) / plastic
    left = (1 - n) * area / 2  # of each flange that still bends
    depth = left / b
    return left * (h - depth) / plastic


def test_axial_force_and_bending_against_the_plastic_section() -> None:
    """Eq. 6.36 has no reduction up to n = a/2, where the exact moment has lost a quarter of what the web carries."""
    for h, b, tw, tf in ((0.33, 0.16, 0.0075, 0.0115), (0.3, 0.3, 0.011, 0.019), (0.6, 0.22, 0.012, 0.019)):
        a = cross_section.web_share(2 * b * tf + (h - 2 * tf) * tw, 2 * b * tf)
        web = tw * (h - 2 * tf) ** 2 / 4
        most = 0.25 * web / (b * tf * (h - tf) + web)
        assert 1.0 - _plastic_rectangles(h, b, tw, tf, 0.5 * a) == pytest.approx(most)
        for n in (0.05, 0.2, 0.4, 0.6, 0.8, 0.95):
            found = cross_section.moment_resistance_with_axial_force_y(1.0, n, a)
            assert found - _plastic_rectangles(h, b, tw, tf, n) <= most


def test_axial_force_about_the_weak_axis() -> None:
    f = cross_section.moment_resistance_with_axial_force_z
    assert f(2.0, 0.3, 0.3) == 2.0
    assert f(2.0, 0.65, 0.3) == pytest.approx(1.5)
    assert f(2.0, 1.2, 0.3) == 0.0
    assert cross_section.moment_resistance_with_axial_force_round(1.0, 0.5) == pytest.approx(1 - 0.5**1.7)
    # exact for a thin tube: cos(pi n / 2); the formula is within 0.03
    for n in (0.1, 0.3, 0.5, 0.7, 0.9):
        exact = math.cos(math.pi * n / 2)
        assert cross_section.moment_resistance_with_axial_force_round(1.0, n) == pytest.approx(exact, abs=0.03)
    assert cross_section.axial_force_may_be_ignored_y(0.25, 100.0, 200.0)
    assert not cross_section.axial_force_may_be_ignored_y(0.25, 101.0, 200.0)


@given(ratios, ratios, ratios, st.sampled_from(["I", "RHS", "CHS"]))
def test_biaxial_criterion(n: float, m_y: float, m_z: float, shape: Shape) -> None:
    reduced = max(1.0 - n, 0.0)
    found = cross_section.plastic_interaction(shape, n, m_y, m_z, reduced, reduced)
    assert 0.0 <= found <= n + m_y + m_z  # the linear sum is always enough
    if n < 1.0 and m_z == 0.0:
        assert found <= max(m_y / reduced, (m_y / reduced) ** 2) * (1.0 + 1e-12)
    # a larger load along the same ray never becomes safe
    if found > 1.0:
        larger = cross_section.plastic_interaction(
            shape, 1.2 * n, 1.2 * m_y, 1.2 * m_z, max(1.0 - 1.2 * n, 0.0), max(1.0 - 1.2 * n, 0.0)
        )
        assert larger > 1.0


def test_biaxial_exponents() -> None:
    assert cross_section.biaxial_exponents("I", 0.1) == (2.0, 1.0)
    assert cross_section.biaxial_exponents("I", 0.5) == (2.0, 2.5)
    assert cross_section.biaxial_exponents("CHS", 0.5) == (2.0, 2.0)
    assert cross_section.biaxial_exponents("RHS", 0.0) == (1.66, 1.66)
    assert cross_section.biaxial_exponents("RHS", 0.9) == (6.0, 6.0)
    assert cross_section.biaxial_exponents("RHS", 0.99) == (6.0, 6.0)


def test_critical_moment_limits() -> None:
    """Without warping M_cr = pi/L sqrt(E I_z G I_t), Timoshenko; load below the shear centre helps."""
    plain = lateral_torsional.critical_moment(210e9, 81e9, 1e-6, 1e-7, 0.0, 5.0)
    assert plain == pytest.approx(math.pi / 5 * math.sqrt(210e9 * 1e-6 * 81e9 * 1e-7))
    above, below = (
        lateral_torsional.critical_moment(210e9, 81e9, 1e-6, 1e-7, 1e-8, 5.0, 1.127, 0.454, z) for z in (0.1, -0.1)
    )
    assert above < below
    with pytest.raises(InputError, match="L: 0 .*E-VALUE-02"):
        lateral_torsional.critical_moment(210e9, 81e9, 1e-6, 1e-7, 0.0, 0.0)


def test_moment_diagram_factors() -> None:
    """C1 of SN003 and of Serna's formula, exact for uniform moment, close for others; k_c = 1/sqrt(C1) of Table 6.6."""
    assert lateral_torsional.diagram_factor(1, 1, 1, 1) == pytest.approx(1.0)
    assert lateral_torsional.diagram_factor(1, 0.75, 1, 0.75) == pytest.approx(1.127, abs=0.02)
    assert lateral_torsional.diagram_factor(1, 0.75, 0.5, 0.25) == pytest.approx(1.77, rel=0.05)
    assert lateral_torsional.diagram_factor(0, 0, 0, 0) == 1.0
    assert lateral_torsional.end_moment_factor(0.125) == pytest.approx((1.77 + 1.52) / 2)
    for psi in (1.0, 0.5, 0.0):
        C1 = lateral_torsional.end_moment_factor(psi)
        assert lateral_torsional.correction_of_factor(C1) == pytest.approx(
            1.0 / (1.33 - 0.33 * psi),  # Table 6.6
            rel=0.02,  # two approximations of one curve
        )
    with pytest.raises(InputError, match="psi: 1.5 .*E-VALUE-02"):
        lateral_torsional.end_moment_factor(1.5)


def test_reduction_factors_of_lateral_torsional_buckling() -> None:
    for curve in "bcd":
        assert lateral_torsional.reduction_factor(0.4, curve) == 1.0
        assert lateral_torsional.reduction_factor_general(0.2, curve) == 1.0
        assert lateral_torsional.reduction_factor(3.0, curve) <= 1 / 9
        assert lateral_torsional.reduction_factor(0.4001, curve) == pytest.approx(1.0, abs=1e-3)
    assert lateral_torsional.modified_reduction_factor(0.9, 0.8, 0.8) == pytest.approx(1.0)
    assert lateral_torsional.modified_reduction_factor(0.5, 1.6, 0.8) == pytest.approx(0.390625)
    assert lateral_torsional.modified_reduction_factor(1.0, 0.0, 0.9) == 1.0
    with pytest.raises(InputError, match="`e`.*E-NAME-01"):
        lateral_torsional.reduction_factor(1.0, "e")
    with pytest.raises(InputError, match="E-VALUE-02"):
        lateral_torsional.reduction_factor_general(-1.0, "a")


def test_table_a_2() -> None:
    assert moment_factors.linear_moment_factor_a(1.0, 0.0, 1.0) == 1.0


def test_annex_b_rows() -> None:
    k = annex_b_factors(0.9, 0.8, 0.7, 0.8, 1.2, 0.4, 0.5, twists=False)
    assert k == pytest.approx((0.9 * 1.24, 0.6 * 0.8 * 1.7, 0.6 * 0.9 * 1.24, 0.8 * 1.7))
    assert annex_b_factors(0.9, 0.8, 0.7, 0.8, 1.2, 0.4, 0.5, hollow=True).k_zz == pytest.approx(0.8 * 1.4)
    assert annex_b_factors(0.9, 0.8, 0.7, 0.8, 0.3, 0.4, 0.5).k_zy == pytest.approx(0.9)
    elastic = annex_b_factors(0.9, 0.8, 0.7, 0.8, 1.2, 0.4, 0.5, plastic=False)
    assert elastic == pytest.approx((0.9 * 1.192, 0.8 * 1.3, 1 - 0.05 / 0.45 * 0.5, 0.8 * 1.3))
    assert annex_b_factors(0.9, 0.8, 0.7, 0.8, 1.2, 0.4, 0.5, plastic=False, twists=False).k_zy == pytest.approx(
        0.8 * 0.9 * 1.192
    )


def test_imperfections() -> None:
    """Portal frame of SSB04, Appendix D: h 6 m, two columns: alpha_h 0.816, alpha_m 0.866, phi 3.54e-3."""
    assert imperfections.initial_sway(6.0, 2) == pytest.approx(3.54e-3, abs=5e-6)
    assert imperfections.initial_sway(3.0, 1) == pytest.approx(1 / 200)
    assert imperfections.initial_sway(100.0, 1) == pytest.approx(1 / 300)
    assert imperfections.sway_amplification(10.0) == 1.0
    assert imperfections.sway_amplification(5.0) == pytest.approx(1.25)
    with pytest.raises(InputError, match="E-EC3-01"):
        imperfections.sway_amplification(2.9)
    with pytest.raises(InputError, match="0 columns.*E-VALUE-02"):
        imperfections.initial_sway(3.0, 0)
