"""Members in bending and axial compression, EN 1993-1-1:2005, 6.3.3, with Annex A or Annex B.

Compression and moments are magnitudes; moments are the largest along the member. Sections are of class 1, 2 or 3, so
that no shift of the centroid enters.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple


class InteractionFactors(NamedTuple):
    """The factors k of Eqs. 6.61 and 6.62."""

    k_yy: float
    k_yz: float
    k_zy: float
    k_zz: float


def member_interaction(
    factors: InteractionFactors, n_y: float, n_z: float, m_y: float, m_z: float
) -> tuple[float, float]:
    """Return the left sides of Eqs. 6.61 and 6.62, which must not exceed 1.

    Args:
        factors: by `annex_a_factors` or `annex_b_factors`.
        n_y: N_Ed / (chi_y N_Rk / gamma_M1).
        n_z: N_Ed / (chi_z N_Rk / gamma_M1).
        m_y: M_y,Ed / (chi_LT M_y,Rk / gamma_M1).
        m_z: M_z,Ed / (M_z,Rk / gamma_M1).

    Source: EN 1993-1-1:2005, 6.3.3(4), Eqs. 6.61 and 6.62.
    """
    return (
        n_y + factors.k_yy * m_y + factors.k_yz * m_z,
        n_z + factors.k_zy * m_y + factors.k_zz * m_z,
    )


def annex_b_factors(
    C_my: float,
    C_mz: float,
    C_mLT: float,
    lambda_y: float,
    lambda_z: float,
    n_y: float,
    n_z: float,
    plastic: bool = True,
    hollow: bool = False,
    twists: bool = True,
) -> InteractionFactors:
    """Return the factors of Annex B.

    Args:
        C_my: equivalent uniform moment factor about y, Table B.3.
        C_mz: equivalent uniform moment factor about z.
        C_mLT: equivalent uniform moment factor for lateral-torsional buckling.
        lambda_y: slenderness in flexural buckling about y.
        lambda_z: slenderness in flexural buckling about z.
        n_y: N_Ed / (chi_y N_Rk / gamma_M1).
        n_z: N_Ed / (chi_z N_Rk / gamma_M1).
        plastic: class 1 or 2; otherwise class 3.
        hollow: an RHS, whose k_zz is that of k_yy; circular sections are taken as these.
        twists: the member is susceptible to torsional deformation (Table B.2); hollow sections and members whose
            twisting is prevented are not (Table B.1).

    Returns:
        k_yy, k_yz, k_zy and k_zz.

    Source: EN 1993-1-1:2005, Annex B, Tables B.1 and B.2; SCI P362, Designers' Guide to EN 1993-1-1 (Gardner &
        Nethercot), 6.3.3.
    """
    if plastic:
        k_yy = C_my * (1.0 + min(lambda_y - 0.2, 0.8) * n_y)
        k_zz = C_mz * (1.0 + (min(lambda_z - 0.2, 0.8) if hollow else min(2.0 * lambda_z - 0.6, 1.4)) * n_z)
        k_yz, k_zy = 0.6 * k_zz, 0.6 * k_yy
        if twists and lambda_z < 0.4:
            k_zy = min(0.6 + lambda_z, 1.0 - 0.1 * lambda_z / (C_mLT - 0.25) * n_z)
        elif twists:
            k_zy = 1.0 - 0.1 * min(lambda_z, 1.0) / (C_mLT - 0.25) * n_z
        return InteractionFactors(k_yy, k_yz, k_zy, k_zz)
    k_yy = C_my * (1.0 + 0.6 * min(lambda_y, 1.0) * n_y)
    k_zz = C_mz * (1.0 + 0.6 * min(lambda_z, 1.0) * n_z)
    k_zy = 1.0 - 0.05 * min(lambda_z, 1.0) / (C_mLT - 0.25) * n_z if twists else 0.8 * k_yy
    return InteractionFactors(k_yy, k_zz, k_zy, k_zz)


@dataclass(frozen=True)
class AnnexAMember:
    """Constants of a member for Annex A.

    Attributes:
        N_Rk: A f_y by gamma_M1, N.
        N_cr_y, N_cr_z, N_cr_T: elastic critical forces of flexural and torsional buckling, N.
        chi_y, chi_z, chi_LT: reduction factors.
        lambda_y, lambda_z: slendernesses in flexural buckling.
        lambda_0: slenderness in lateral torsional buckling under uniform moment (C1 = 1).
        C1: of the moment diagram.
        W_pl_y, W_el_y, W_pl_z, W_el_z: m3.
        A, I_y, I_t: m2, m4, m4.
        M_pl_y, M_pl_z: W_pl f_y by gamma_M1, N m.
        plastic: class 1 or 2; otherwise class 3.
    """

    N_Rk: float
    N_cr_y: float
    N_cr_z: float
    N_cr_T: float
    chi_y: float
    chi_z: float
    chi_LT: float
    lambda_y: float
    lambda_z: float
    lambda_0: float
    C1: float
    W_pl_y: float
    W_el_y: float
    W_pl_z: float
    W_el_z: float
    A: float
    I_y: float
    I_t: float
    M_pl_y: float
    M_pl_z: float
    plastic: bool = True


class AnnexATerms(NamedTuple):
    """Intermediate results of Annex A, which worked examples print; lambda_0_lim is the limit of lambda_0."""

    mu_y: float
    mu_z: float
    C_my: float
    C_mz: float
    C_mLT: float
    C_yy: float
    C_yz: float
    C_zy: float
    C_zz: float
    a_LT: float
    lambda_0_lim: float
    w_y: float
    w_z: float
    n_pl: float
    b_LT: float
    c_LT: float
    d_LT: float
    e_LT: float


def annex_a_terms(
    member: AnnexAMember, N_Ed: float, M_y_Ed: float, M_z_Ed: float, C_my_0: float, C_mz_0: float
) -> AnnexATerms:
    """Return mu, C_m, C_ij and what they follow from in Annex A.

    Args:
        member: its constants.
        N_Ed: compression, N; below N_cr,z and N_cr,T.
        M_y_Ed: largest moment about y along the member, N m.
        M_z_Ed: largest moment about z along the member, N m.
        C_my_0: factor of the moments about y by Table A.2.
        C_mz_0: factor of the moments about z by Table A.2.

    Returns:
        The terms of Table A.1.

    Source: EN 1993-1-1:2005 + AC:2009, Table A.1; ECCS publication 119, Rules for member stability in EN 1993-1-1.
        Below the limit of lambda_0 the terms b_LT to e_LT vanish, as in ECCS 119. Public programs differ in C_zz: two
        multiply e_LT by n_pl, as here, one does not.
    """
    m = member
    by_y, by_z, by_T = N_Ed / m.N_cr_y, N_Ed / m.N_cr_z, N_Ed / m.N_cr_T
    mu_y = (1.0 - by_y) / (1.0 - m.chi_y * by_y)
    mu_z = (1.0 - by_z) / (1.0 - m.chi_z * by_z)
    a_LT = max(1.0 - m.I_t / m.I_y, 0.0)
    C_my, C_mz, C_mLT = C_my_0, C_mz_0, 1.0
    lambda_0 = 0.0  # without lateral torsional buckling
    lambda_0_lim = 0.2 * math.sqrt(m.C1) * ((1.0 - by_z) * (1.0 - by_T)) ** 0.25
    if m.lambda_0 > lambda_0_lim:
        root = math.sqrt(M_y_Ed / N_Ed * m.A / m.W_el_y) if N_Ed > 0.0 else math.inf
        share = 1.0 if math.isinf(root) else root * a_LT / (1.0 + root * a_LT)
        C_my = C_my_0 + (1.0 - C_my_0) * share
        lambda_0 = m.lambda_0
        C_mLT = max(C_my**2 * a_LT / math.sqrt((1.0 - by_z) * (1.0 - by_T)), 1.0)
    w_y, w_z = min(m.W_pl_y / m.W_el_y, 1.5), min(m.W_pl_z / m.W_el_z, 1.5)
    n_pl, most = N_Ed / m.N_Rk, max(m.lambda_y, m.lambda_z)
    r_y, r_z = M_y_Ed / (m.chi_LT * m.M_pl_y), M_z_Ed / m.M_pl_z
    b_LT = 0.5 * a_LT * lambda_0**2 * r_y * r_z
    c_LT = 10.0 * a_LT * lambda_0**2 / (5.0 + m.lambda_z**4) * r_y / C_my
    d_LT = 2.0 * a_LT * lambda_0 / (0.1 + m.lambda_z**4) * r_y / C_my * r_z / C_mz
    e_LT = 1.7 * a_LT * lambda_0 / (0.1 + m.lambda_z**4) * r_y / C_my

    def same(w: float, C: float) -> float:
        return 2.0 - 1.6 / w * C**2 * (most + most**2)

    def cross(w: float, C: float) -> float:
        return 2.0 - 14.0 * C**2 * most**2 / w**5

    elastic_y, elastic_z = m.W_el_y / m.W_pl_y, m.W_el_z / m.W_pl_z
    return AnnexATerms(
        mu_y,
        mu_z,
        C_my,
        C_mz,
        C_mLT,
        C_yy=max(1.0 + (w_y - 1.0) * (same(w_y, C_my) * n_pl - b_LT), elastic_y),
        C_yz=max(1.0 + (w_z - 1.0) * (cross(w_z, C_mz) * n_pl - c_LT), 0.6 * math.sqrt(w_z / w_y) * elastic_z),
        C_zy=max(1.0 + (w_y - 1.0) * (cross(w_y, C_my) * n_pl - d_LT), 0.6 * math.sqrt(w_y / w_z) * elastic_y),
        C_zz=max(1.0 + (w_z - 1.0) * (same(w_z, C_mz) - e_LT) * n_pl, elastic_z),
        a_LT=a_LT,
        lambda_0_lim=lambda_0_lim,
        w_y=w_y,
        w_z=w_z,
        n_pl=n_pl,
        b_LT=b_LT,
        c_LT=c_LT,
        d_LT=d_LT,
        e_LT=e_LT,
    )


def annex_a_factors(member: AnnexAMember, N_Ed: float, terms: AnnexATerms) -> InteractionFactors:
    """Return the factors of Annex A; infinite where N_Ed reaches an elastic critical force of flexural buckling.

    Args:
        member: its constants.
        N_Ed: compression, N.
        terms: by `annex_a_terms`.

    Source: EN 1993-1-1:2005, Table A.1.
    """
    left_y, left_z = 1.0 - N_Ed / member.N_cr_y, 1.0 - N_Ed / member.N_cr_z
    if left_y <= 0.0 or left_z <= 0.0:
        return InteractionFactors(math.inf, math.inf, math.inf, math.inf)
    y, z = terms.C_my * terms.C_mLT / left_y, terms.C_mz / left_z
    if not member.plastic:
        return InteractionFactors(y * terms.mu_y, z * terms.mu_y, y * terms.mu_z, z * terms.mu_z)
    return InteractionFactors(
        y * terms.mu_y / terms.C_yy,
        z * terms.mu_y / terms.C_yz * 0.6 * math.sqrt(terms.w_z / terms.w_y),
        y * terms.mu_z / terms.C_zy * 0.6 * math.sqrt(terms.w_y / terms.w_z),
        z * terms.mu_z / terms.C_zz,
    )
