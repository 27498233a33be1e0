"""From a steel section, its steel and its restraints to the constants that the checks of members need."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from edesign.building.sections.steel_section import SteelSection
from edesign.codes.ec3 import buckling, cross_section, lateral_torsional
from edesign.codes.ec3.buckling import GAMMA_M1
from edesign.codes.ec3.cross_section import GAMMA_M0
from edesign.codes.ec3.materials import E, G
from edesign.core.member_checks import MemberConstants
from edesign.errors import InputError


@dataclass(frozen=True)
class Stability:
    """Restraints of a member against buckling, and the shape of its moments.

    Attributes:
        L_cr_y, L_cr_z: buckling lengths, m; 0: held all along, chi = 1.
        L_LT: between restraints of the compressed flange and of twisting, m; 0: held all along, chi_LT = 1.
        C1, C2, z_g: of the critical moment; z_g in m.
        C_my, C_mz, C_mLT: equivalent uniform moment factors, Table B.3; 0.9 is that of sway members. With Annex A
            C_my and C_mz are C_mi,0 without compression.
        C_my_N, C_mz_N: slopes of C_mi,0 over N_Ed / N_cr,i, Table A.2.
        twists: susceptible to torsional deformation (Table B.2); hollow sections never are.
        general: chi_LT by the general case 6.3.2.2; otherwise 6.3.2.3 with f, k_c = 1 / sqrt(C1).
    """

    L_cr_y: float
    L_cr_z: float
    L_LT: float
    C1: float = 1.0
    C2: float = 0.0
    z_g: float = 0.0
    C_my: float = 0.9
    C_mz: float = 0.9
    C_mLT: float = 0.9
    C_my_N: float = 0.0
    C_mz_N: float = 0.0
    twists: bool = True
    general: bool = False


@dataclass(frozen=True)
class SteelMember:
    """Section, steel and restraints of a member for its checks.

    Attributes:
        section: by `steel_section`.
        fy: yield strength, Pa.
        stability: restraints.
        section_class: 1, 2 or 3.
        V_M: V_Ed,M of EN 1998-1, 6.6.2(2), N.
        E, G: Pa.
        gamma_M0, gamma_M1: partial factors.
        annex_a: k_ij of 6.3.3 by Annex A; otherwise by Annex B.
    """

    section: SteelSection
    fy: float
    stability: Stability
    section_class: int
    V_M: float = 0.0
    E: float = E
    G: float = G
    gamma_M0: float = GAMMA_M0
    gamma_M1: float = GAMMA_M1
    annex_a: bool = False

    @cached_property
    def constants(self) -> MemberConstants:
        """Resistances and factors of the member, by `member_constants`."""
        return member_constants(
            self.section,
            self.fy,
            self.stability,
            self.section_class,
            self.V_M,
            self.E,
            self.G,
            self.gamma_M0,
            self.gamma_M1,
            self.annex_a,
        )


def member_constants(
    section: SteelSection,
    yield_stress: float,
    stability: Stability,
    section_class: int,
    V_M: float = 0.0,
    modulus: float = E,
    shear_modulus: float = G,
    gamma_M0: float = GAMMA_M0,
    gamma_M1: float = GAMMA_M1,
    annex_a: bool = False,
) -> MemberConstants:
    """Return the resistances and factors of a member.

    Args:
        section: by `steel_section`.
        yield_stress: f_y, Pa.
        stability: restraints.
        section_class: 1, 2 or 3, by `section_class`.
        V_M: V_Ed,M of EN 1998-1, 6.6.2(2), N.
        modulus: E, Pa.
        shear_modulus: G, Pa.
        gamma_M0: partial factor of cross-sections.
        gamma_M1: partial factor of stability.
        annex_a: k_ij of 6.3.3 by Annex A; otherwise by Annex B.

    Returns:
        Resistances, slendernesses and reduction factors, as `edesign.core` checks members with.

    Raises:
        InputError: the class is 4, or a length is not greater than zero.

    Source: EN 1993-1-1:2005, 6.2 and 6.3; torsional buckling (6.3.1.4) counts where it is below flexural buckling.
    """
    s, fy = section, yield_stress
    if section_class not in (1, 2, 3):
        raise InputError(f"{s.name} is of class {section_class}; sections of class 1 to 3 are checked")
    plastic = section_class < 3
    W_y, W_z = (s.W_pl_y, s.W_pl_z) if plastic else (s.W_el_y, s.W_el_z)
    M_y_Rd = cross_section.moment_resistance(W_y, fy, gamma_M0)
    M_y_shear = M_y_Rd
    if plastic and s.webs:
        M_y_shear = cross_section.moment_of_shear_area(s.h_w, s.webs * s.tw, fy, gamma_M0)
    of = _buckling(s, fy, stability, modulus, shear_modulus)
    chi_LT, lambda_0 = _lateral_torsional(s, fy, stability, W_y, modulus, shear_modulus)
    return MemberConstants(
        N_Rd=cross_section.axial_resistance(s.A, fy, gamma_M0),
        V_y_Rd=cross_section.shear_resistance(s.A_vy, fy, gamma_M0),
        V_z_Rd=shear_resistance_z(s, fy, gamma_M0, gamma_M1),
        M_y_Rd=M_y_Rd,
        M_z_Rd=cross_section.moment_resistance(W_z, fy, gamma_M0),
        M_y_shear=M_y_shear,
        N_web=cross_section.axial_resistance(s.h_w * s.tw, fy, gamma_M0) if s.kind == "I" else 0.0,
        a_y=cross_section.web_share(s.A, 2.0 * s.b * s.tf) if s.kind != "CHS" else 0.0,
        a_z=cross_section.web_share(s.A, 2.0 * (s.b if s.kind == "I" else s.h) * s.tf) if s.kind != "CHS" else 0.0,
        N_b_y_Rd=buckling.buckling_resistance(s.A, fy, of.chi_y, gamma_M1),
        N_b_z_Rd=buckling.buckling_resistance(s.A, fy, min(of.chi_z, of.chi_T), gamma_M1),
        M_b_Rd=lateral_torsional.buckling_moment(chi_LT, W_y, fy, gamma_M1),
        M_z_Rk=cross_section.moment_resistance(W_z, fy, gamma_M1),
        lambda_y=of.lambda_y,
        lambda_z=of.lambda_z,
        C_my=stability.C_my,
        C_mz=stability.C_mz,
        C_mLT=stability.C_mLT,
        V_M=V_M,
        N_Rk=cross_section.axial_resistance(s.A, fy, gamma_M1),
        per_N_cr_y=1.0 / of.N_cr_y,
        per_N_cr_z=1.0 / of.N_cr_z,
        per_N_cr_T=1.0 / of.N_cr_T,
        chi_z=of.chi_z,
        elastic_y=s.W_el_y / s.W_pl_y,
        elastic_z=s.W_el_z / s.W_pl_z,
        a_LT=max(1.0 - s.I_t / s.I_y, 0.0),
        lambda_0=lambda_0,
        LT_limit=0.2 * math.sqrt(stability.C1),
        area_by_modulus=s.A / s.W_el_y,
        C_my_N=stability.C_my_N,
        C_mz_N=stability.C_mz_N,
        shape=s.kind,
        class_3=not plastic,
        twists=stability.twists and s.kind == "I" and stability.L_LT > 0.0,
        annex_a=annex_a,
    )


def shear_resistance_z(section: SteelSection, yield_stress: float, gamma_M0: float, gamma_M1: float) -> float:
    """Return V_z,Rd, N: of the whole shear area in yielding, or of slender webs in buckling if that is less.

    Args:
        section: by `steel_section`.
        yield_stress: f_y, Pa.
        gamma_M0: partial factor of cross-sections.
        gamma_M1: partial factor of stability, for slender webs.

    Source: EN 1993-1-1:2005, 6.2.6(2) and (6); EN 1993-1-5:2006, 5.2.
    """
    plastic = cross_section.shear_resistance(section.A_vz, yield_stress, gamma_M0)
    if not section.webs:
        return plastic
    web = cross_section.shear_buckling_resistance(section.h_w, section.tw, yield_stress, gamma_M1)
    return min(plastic, section.webs * web)


class _Buckling(NamedTuple):
    """Slendernesses, reduction factors and elastic critical forces; infinite where the member is held."""

    lambda_y: float
    lambda_z: float
    chi_y: float
    chi_z: float
    chi_T: float
    N_cr_y: float
    N_cr_z: float
    N_cr_T: float


def _buckling(s: SteelSection, fy: float, stability: Stability, modulus: float, shear_modulus: float) -> _Buckling:
    if s.kind == "I":
        curves = [buckling.rolled_i_curve(s.h, s.b, s.tf, axis, fy) for axis in ("y", "z")]
    else:
        curves = [buckling.hollow_curve(fy, s.cold_formed)] * 2
    axes = zip((s.I_y, s.I_z), (stability.L_cr_y, stability.L_cr_z), strict=True)
    N_cr = [
        buckling.critical_force(modulus, inertia, length) if length != 0.0 else math.inf for inertia, length in axes
    ]
    slender = [buckling.slenderness(s.A, fy, force) if force < math.inf else 0.0 for force in N_cr]
    chi = [buckling.reduction_factor(x, curve) for x, curve in zip(slender, curves, strict=True)]
    N_cr_T, chi_T = math.inf, 1.0
    if s.kind == "I" and stability.L_LT > 0.0:
        N_cr_T = buckling.torsional_critical_force(
            modulus, shear_modulus, s.A, s.I_y + s.I_z, s.I_t, s.I_w, stability.L_LT
        )
        chi_T = buckling.reduction_factor(buckling.slenderness(s.A, fy, N_cr_T), curves[1])
    return _Buckling(slender[0], slender[1], chi[0], chi[1], chi_T, N_cr[0], N_cr[1], N_cr_T)


def _lateral_torsional(
    s: SteelSection, fy: float, stability: Stability, W_y: float, modulus: float, shear_modulus: float
) -> tuple[float, float]:
    """chi_LT, and the slenderness under uniform moment; 1 and 0 of hollow sections and of members held all along."""
    if s.kind != "I" or stability.L_LT == 0.0:
        return 1.0, 0.0
    of_member = modulus, shear_modulus, s.I_z, s.I_t, s.I_w, stability.L_LT
    M_cr = lateral_torsional.critical_moment(*of_member, stability.C1, stability.C2, stability.z_g)
    lambda_0 = lateral_torsional.slenderness(W_y, fy, lateral_torsional.critical_moment(*of_member))
    slenderness = lateral_torsional.slenderness(W_y, fy, M_cr)
    if stability.general:
        curve = lateral_torsional.general_curve(s.h, s.b)
        return lateral_torsional.reduction_factor_general(slenderness, curve), lambda_0
    chi = lateral_torsional.reduction_factor(slenderness, lateral_torsional.rolled_curve(s.h, s.b))
    k_c = lateral_torsional.correction_of_factor(stability.C1)
    return lateral_torsional.modified_reduction_factor(chi, slenderness, k_c), lambda_0
