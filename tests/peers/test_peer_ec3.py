"""Members in bending and compression by EN 1993-1-1, 6.3.3, side by side with eurocodepy, Annex A and Annex B."""

from __future__ import annotations

import random

import pytest

from edesign.codes.ec3 import buckling, lateral_torsional
from edesign.codes.ec3.interaction import annex_a_factors, annex_b_factors
from edesign.codes.ec3.moment_factors import linear_moment_factor_a
from edesign.frame.sections.steel_section import steel_section

pytestmark = pytest.mark.peer
peer = pytest.importorskip("eurocodepy.ec3.uls.member_buckling")

E = 210e9


@pytest.mark.parametrize("seed", range(200))
def test_interaction_factors(seed: int) -> None:
    draw = random.Random(seed)
    s = steel_section(draw.choice(["IPE160", "IPE300", "IPE500", "HEA200", "HEB300", "HEM300", "UB457x191x67"]))
    fy, G, plastic = draw.choice([235e6, 275e6, 355e6]), peer.G_STEEL * 1e6, draw.random() < 0.5
    W_y, W_z = (s.W_pl_y, s.W_pl_z) if plastic else (s.W_el_y, s.W_el_z)
    L_y, L_z, L_T = (draw.uniform(1.0, 10.0) for _ in range(3))
    N_cr_y, N_cr_z = buckling.critical_force(E, s.I_y, L_y), buckling.critical_force(E, s.I_z, L_z)
    N_cr_T = buckling.torsional_critical_force(E, G, s.A, s.I_y + s.I_z, s.I_t, s.I_w, L_T)
    curves = [buckling.rolled_i_curve(s.h, s.b, s.tf, axis, fy) for axis in ("y", "z")]
    lambda_y, lambda_z = (buckling.slenderness(s.A, fy, N_cr) for N_cr in (N_cr_y, N_cr_z))
    chi_y, chi_z = buckling.reduction_factor(lambda_y, curves[0]), buckling.reduction_factor(lambda_z, curves[1])
    curve_LT, C1 = lateral_torsional.rolled_curve(s.h, s.b), draw.uniform(1.0, 2.5)
    M_cr_0 = lateral_torsional.critical_moment(E, G, s.I_z, s.I_t, s.I_w, L_T)
    lambda_0 = lateral_torsional.slenderness(W_y, fy, M_cr_0)
    chi_LT = lateral_torsional.reduction_factor(lateral_torsional.slenderness(W_y, fy, C1 * M_cr_0), curve_LT)
    N = min(draw.uniform(0.01, 0.9) * min(chi_y, chi_z) * s.A * fy, 0.9 * N_cr_T)
    M_y, M_z = draw.uniform(0.05, 0.8) * W_y * fy, draw.uniform(0.01, 0.8) * W_z * fy
    psi_y, psi_z = draw.uniform(-1.0, 1.0), draw.uniform(-1.0, 1.0)
    given = peer.MemberInput(
        n_ed=N / 1e3,
        my_ed=M_y / 1e3,
        mz_ed=M_z / 1e3,
        area=s.A * 1e6,
        w_y=W_y * 1e9,
        w_z=W_z * 1e9,
        iy=s.I_y * 1e12,
        iz=s.I_z * 1e12,
        it=s.I_t * 1e12,
        iw=s.I_w * 1e18,
        lcr_y=L_y * 1e3,
        lcr_z=L_z * 1e3,
        l_lt=L_T * 1e3,
        curve_y=curves[0],
        curve_z=curves[1],
        curve_lt=curve_LT,
        c1=C1,
        cmy=0.7,
        cmz=0.8,
        cm_lt=0.9,
        fy=fy / 1e6,
        section_class=1 if plastic else 3,
        psi_y=psi_y,
        psi_z=psi_z,
        wpl_y=s.W_pl_y * 1e9,
        wpl_z=s.W_pl_z * 1e9,
        wel_y=s.W_el_y * 1e9,
        wel_z=s.W_el_z * 1e9,
    )
    n_y, n_z = N / (chi_y * s.A * fy), N / (chi_z * s.A * fy)
    given.method = "B"
    theirs = peer.eurocode3_member_check(given)
    ours = annex_b_factors(0.7, 0.8, 0.9, lambda_y, lambda_z, n_y, n_z, plastic)
    assert ours == pytest.approx((theirs.kyy, theirs.kyz, theirs.kzy, theirs.kzz), rel=1e-12)
    y, z = buckling.Flexural(lambda_y, N_cr_y, chi_y, 0.0), buckling.Flexural(lambda_z, N_cr_z, chi_z, 0.0)
    m_y, m_z = M_y / (chi_LT * s.W_pl_y * fy), M_z / (s.W_pl_z * fy)
    C_my_0, C_mz_0 = linear_moment_factor_a(psi_y, N, N_cr_y), linear_moment_factor_a(psi_z, N, N_cr_z)
    effects = N, M_y, m_y, m_z, C_my_0, C_mz_0
    ours = annex_a_factors(s, y, z, N_cr_T, lambda_0, C1, s.A * fy, *effects, plastic=plastic)
    given.method = "A"
    theirs = peer.eurocode3_member_check(given)
    assert ours == pytest.approx((theirs.kyy, theirs.kyz, theirs.kzy, theirs.kzz), rel=1e-12)
