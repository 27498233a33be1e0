"""A steel member with the constants that the pass of the core checks it by."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

from edesign.codes.ec3 import cross_section
from edesign.codes.ec3.member import Member, Strength
from edesign.core.member_checks import MemberConstants

UNCHECKED = MemberConstants(1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0)
"""Constants of members whose section has no class. No check of them is asked for."""


@dataclass(frozen=True)
class SteelMember(Member):
    """A member as the clauses have it, with its constants for the core."""

    @cached_property
    def constants(self) -> MemberConstants:
        """Resistances, slendernesses and factors, SI."""
        s, stability = self.section, self.stability
        if s.kind == "other" or s.kind == "U":
            return UNCHECKED
        strength = Strength(self)
        if s.kind == "BRB":  # its casing keeps it from buckling
            N_Rd = strength.N_pl_Rd()
            return replace(UNCHECKED, N_Rd=N_Rd, N_b_y_Rd=N_Rd, N_b_z_Rd=N_Rd)
        y, z = strength.flexural("y"), strength.flexural("z")
        if s.kind == "L" or s.kind == "2U":
            return replace(UNCHECKED, N_Rd=strength.N_pl_Rd(), N_b_y_Rd=y.N_b_Rd, N_b_z_Rd=z.N_b_Rd)
        return MemberConstants(
            N_Rd=strength.N_pl_Rd(),
            V_y_Rd=strength.V_Rd("y"),
            V_z_Rd=strength.V_Rd("z"),
            M_y_Rd=strength.M_Rd("y"),
            M_z_Rd=strength.M_Rd("z"),
            M_y_shear=strength.M_of_shear_area("y"),
            N_web=strength.N_web,
            a_y=strength.web_share("y"),
            a_z=strength.web_share("z"),
            N_b_y_Rd=y.N_b_Rd,
            N_b_z_Rd=z.N_b_Rd,
            M_b_Rd=strength.M_b_Rd(),
            M_z_Rk=cross_section.moment_resistance(strength.modulus("z"), self.fy, self.gamma_M1),
            lambda_y=y.slenderness,
            lambda_z=z.slenderness,
            C_my=stability.C_my,
            C_mz=stability.C_mz,
            C_mLT=stability.C_mLT,
            V_M=self.V_M,
            N_Rk=cross_section.axial_resistance(s.A, self.fy, self.gamma_M1),
            per_N_cr_y=1.0 / y.N_cr,
            per_N_cr_z=1.0 / z.N_cr,
            per_N_cr_T=1.0 / strength.N_cr_T(),
            chi_z=z.chi,
            elastic_y=s.W_el_y / s.W_pl_y,
            elastic_z=s.W_el_z / s.W_pl_z,
            a_LT=max(1.0 - s.I_t / s.I_y, 0.0),
            lambda_0=strength.lambda_0(),
            LT_limit=0.2 * math.sqrt(stability.C1),
            area_by_modulus=s.A / s.W_el_y,
            C_my_N=stability.C_my_N,
            C_mz_N=stability.C_mz_N,
            shape=s.kind,
            class_3=not self.plastic,
            twists=self.twists,
            annex_a=self.annex_a,
        )
