"""From a section, its steel and its restraints to resistances and critical forces of a member.

A `Trace` records each quantity when it is asked for, with its formula and clause.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from edesign.codes.ec3 import buckling, cross_section, lateral_torsional
from edesign.codes.ec3.buckling import GAMMA_M1, Flexural
from edesign.codes.ec3.cross_section import GAMMA_M0
from edesign.codes.ec3.materials import E, G
from edesign.codes.ec3.section import SteelSection
from edesign.codes.trace import Trace, kept
from edesign.errors import InputError

_TABLE_5_1 = "EN 1993-1-5, 5.3(1), Table 5.1"


@dataclass(frozen=True)
class Stability:
    """Restraints of a member against buckling, and the shape of its moments.

    Attributes:
        L_cr_y, L_cr_z: buckling lengths, m; 0: restrained all along, chi = 1.
        L_LT: between restraints of the compressed flange and of twisting, m; 0: restrained all along, chi_LT = 1.
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
class Member:
    """Section, steel and restraints of a member for its checks.

    Attributes:
        section: its properties.
        fy: yield strength, Pa.
        stability: restraints.
        section_class: 1, 2 or 3.
        V_M: V_Ed,M of EN 1998-1, 6.6.2(2), N.
        E, G: Pa.
        gamma_M0, gamma_M1: partial factors.
        annex_a: k_ij of 6.3.3 by Annex A; otherwise by Annex B.

    Raises:
        InputError: the class is 4.
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

    def __post_init__(self) -> None:
        if self.section_class not in (1, 2, 3):
            name, number = self.section.name, self.section_class
            raise InputError(f"{name} is of class {number}; sections of class 1 to 3 are checked [E-EC3-03]")

    @property
    def plastic(self) -> bool:
        """Whether the section may be used to its plastic resistance: it is of class 1 or 2."""
        return self.section_class < 3

    @property
    def theory(self) -> str:
        """Index of symbols: "pl" for plastic and "el" for elastic moduli."""
        return "pl" if self.plastic else "el"

    @property
    def buckles_by_twisting(self) -> bool:
        """Whether torsional and lateral torsional buckling are possible: an I section, not restrained all along."""
        return self.section.kind == "I" and self.stability.L_LT > 0.0

    @property
    def twists(self) -> bool:
        """Whether the member is susceptible to torsional deformation (Table B.2)."""
        return self.stability.twists and self.buckles_by_twisting


class Strength:
    """Resistances of a member, each computed, and recorded, when it is asked for.

    Args:
        member: section, steel and restraints.

    Attributes:
        member: section, steel and restraints.
        section: of the member.
        trace: of the calculation; it may be one that records nothing.
    """

    def __init__(self, member: Member, trace: Trace | None = None) -> None:
        self.member, self.section, self.trace = member, member.section, kept(trace)

    @cached_property
    def quiet(self) -> Strength:
        """The same resistances, unrecorded."""
        return Strength(self.member)

    # ---- given values -----------------------------------------------------------------------------------------------

    def steel(self, stability: bool = False) -> None:
        """Record the strength and the partial factor.

        Args:
            stability: record the modulus and the factor of checks of stability.
        """
        self.trace.add("f_y", self.member.fy, "Pa")
        if stability:
            self.trace.add("E", self.member.E, "Pa")
            self.trace.add("gamma_M1", self.member.gamma_M1, "1", "", "6.1(1)")
        else:
            self.trace.add("gamma_M0", self.member.gamma_M0, "1", "", "6.1(1)")

    def section_class(self) -> None:
        """Record the class of the section."""
        theory = "plastic" if self.member.plastic else "elastic"
        self.trace.word("class", str(self.member.section_class), theory, "5.5.2, Table 5.2")

    def area(self) -> float:
        """Return A, m2."""
        return self.trace.add("A", self.section.A, "m2")

    def modulus(self, axis: str) -> float:
        """Return W_pl or W_el, as the class of the section permits, m3.

        Args:
            axis: "y" or "z".
        """
        of = f"W_{self.member.theory}"
        return self.trace.add(f"{of},{axis}", getattr(self.section, f"{of}_{axis}"), "m3")

    def torsion(self) -> None:
        """Record the constants of the section that resist twisting."""
        self.trace.add("G", self.member.G, "Pa")
        for symbol, unit in (("I_y", "m4"), ("I_z", "m4"), ("I_t", "m4"), ("I_w", "m6")):
            self.trace.add(symbol, getattr(self.section, symbol), unit)

    # ---- the section, 6.2 -------------------------------------------------------------------------------------------

    def N_pl_Rd(self) -> float:
        """Return N_pl,Rd, N. Source: EN 1993-1-1:2005, 6.2.4(2), Eq. 6.10."""
        value = cross_section.axial_resistance(self.area(), self.member.fy, self.member.gamma_M0)
        return self.trace.add("N_pl,Rd", value, "N", "A f_y / gamma_M0", "6.2.4(2), Eq. 6.10")

    def V_Rd(self, axis: str) -> float:
        """Return the resistance to shear, N; of slender webs V_b,Rd where that is less.

        Args:
            axis: "y" or "z", along which the shear acts.

        Source: EN 1993-1-1:2005, 6.2.6(2), Eq. 6.18, and (6); EN 1993-1-5:2006, 5.2(1).
        """
        area = self.trace.add(f"A_v,{axis}", getattr(self.section, f"A_v{axis}"), "m2", "", "6.2.6(3)")
        value = cross_section.shear_resistance(area, self.member.fy, self.member.gamma_M0)
        expression = f"A_v,{axis} f_y / (sqrt(3) gamma_M0)"
        self.trace.add(f"V_pl,{axis},Rd", value, "N", expression, "6.2.6(2), Eq. 6.18")
        return self._V_b_Rd(value) if self.shear_symbol(axis) == "V_b,z,Rd" else value

    def shear_symbol(self, axis: str) -> str:
        """Return the symbol V_pl,Rd, or V_b,Rd of webs that shear may buckle.

        Args:
            axis: "y" or "z", along which the shear acts.
        """
        s = self.section
        slender = axis == "z" and s.webs > 0 and cross_section.web_is_slender(s.h_w, s.tw, self.member.fy)
        return "V_b,z,Rd" if slender else f"V_pl,{axis},Rd"

    def _V_b_Rd(self, plastic: float) -> float:
        s, member, trace = self.section, self.member, self.trace
        trace.add("gamma_M1", member.gamma_M1, "1", "", "6.1(1)")
        h_w, t_w = trace.add("h_w", s.h_w, "m"), trace.add("t_w", s.tw, "m")
        slenderness = cross_section.web_slenderness(h_w, t_w, member.fy)
        trace.add("lambda_w", slenderness, "1", "h_w / (86.4 t_w epsilon)", "EN 1993-1-5, 5.3(3), Eq. 5.5")
        trace.add("chi_w", cross_section.shear_buckling_factor(slenderness), "1", "0.83 / lambda_w <= 1", _TABLE_5_1)
        value = min(s.webs * cross_section.shear_buckling_resistance(h_w, t_w, member.fy, member.gamma_M1), plastic)
        of = f"{s.webs} " if s.webs > 1 else ""
        expression = f"{of}chi_w f_y h_w t_w / (sqrt(3) gamma_M1) <= V_pl,z,Rd"
        return trace.add("V_b,z,Rd", value, "N", expression, "EN 1993-1-5, 5.2(1), Eqs. 5.1, 5.2")

    def M_Rd(self, axis: str) -> float:
        """Return M_c,Rd, N m: the resistance to bending about an axis without other forces.

        Args:
            axis: "y" or "z".

        Source: EN 1993-1-1:2005, 6.2.5(2), Eqs. 6.13 and 6.14.
        """
        value = cross_section.moment_resistance(self.modulus(axis), self.member.fy, self.member.gamma_M0)
        clause = "6.2.5(2), Eq. 6.13" if self.member.plastic else "6.2.5(2), Eq. 6.14"
        theory = self.member.theory
        return self.trace.add(f"M_{theory},{axis},Rd", value, "N*m", f"W_{theory},{axis} f_y / gamma_M0", clause)

    def M_of_shear_area(self, axis: str) -> float:
        """Return the part of M_c,Rd that the shear area carries, N m; all of it is on the safe side.

        Args:
            axis: "y" or "z", of the moment.

        Source: EN 1993-1-1:2005, 6.2.8(5), Eq. 6.30.
        """
        s, member = self.section, self.member
        if axis == "y" and member.plastic and s.webs:
            return cross_section.moment_of_shear_area(s.h_w, s.webs * s.tw, member.fy, member.gamma_M0)
        return self.quiet.M_Rd(axis)

    def web_share(self, axis: str) -> float:
        """Return the share of the webs in the area, at most 0.5; 0 of a CHS.

        Args:
            axis: "y" or "z", of the moment that the axial force reduces.

        Source: EN 1993-1-1:2005, 6.2.9.1(5), Eqs. 6.36 to 6.40.
        """
        s = self.section
        if s.kind == "CHS":
            return 0.0
        return cross_section.web_share(s.A, 2.0 * (s.h * s.tw if axis == "z" and s.kind == "RHS" else s.b * s.tf))

    @property
    def N_web(self) -> float:
        """h_w t_w f_y / gamma_M0 of an I section, N; 0 of others. Source: EN 1993-1-1:2005, 6.2.9.1(4), Eq. 6.34."""
        s, member = self.section, self.member
        return cross_section.axial_resistance(s.h_w * s.tw, member.fy, member.gamma_M0) if s.kind == "I" else 0.0

    def reduced_by_axial_force(self, N_Ed: float, n: float, rho_z: float) -> tuple[float, float]:
        """Return M_N,Rd / M_Rd about y and z.

        Args:
            N_Ed: magnitude, N.
            n: N_Ed / N_V,Rd.
            rho_z: reduction by the shear along z.

        Source: EN 1993-1-1:2005, 6.2.9.1(4) and (5).
        """
        kind = self.section.kind
        if kind == "CHS":
            return (cross_section.moment_resistance_with_axial_force_round(1.0, n),) * 2
        y = cross_section.moment_resistance_with_axial_force_y(1.0, n, self.web_share("y"))
        if kind == "RHS":
            return y, cross_section.moment_resistance_with_axial_force_y(1.0, n, self.web_share("z"))
        if cross_section.axial_force_may_be_ignored_y(n, N_Ed, (1.0 - rho_z) * self.N_web):
            y = 1.0
        return y, cross_section.moment_resistance_with_axial_force_z(1.0, n, self.web_share("z"))

    # ---- flexural and torsional buckling, 6.3.1 ---------------------------------------------------------------------

    def flexural(self, axis: str) -> Flexural:
        """Return the resistance to buckling about an axis; about z torsional buckling counts where it governs.

        Args:
            axis: "y" or "z".

        Source: EN 1993-1-1:2005, 6.3.1.
        """
        s, member, trace = self.section, self.member, self.trace
        length = getattr(member.stability, f"L_cr_{axis}")
        trace.add(f"L_cr,{axis}", length, "m", "" if length > 0.0 else "restrained all along")
        slenderness, critical = 0.0, math.inf
        if length != 0.0:
            inertia = trace.add(f"I_{axis}", getattr(s, f"I_{axis}"), "m4")
            critical = buckling.critical_force(member.E, inertia, length)
            trace.add(f"N_cr,{axis}", critical, "N", f"pi^2 E I_{axis} / L_cr,{axis}^2", "6.3.1.2(1)")
            slenderness = buckling.slenderness(s.A, member.fy, critical)
            trace.add(f"lambda_{axis}", slenderness, "1", f"sqrt(A f_y / N_cr,{axis})", "6.3.1.3(1), Eq. 6.50")
            if s.kind == "L" and axis == "z":
                slenderness = buckling.angle_slenderness(slenderness)
                trace.add("lambda_eff,v", slenderness, "1", "max(lambda_z, 0.35 + 0.7 lambda_z)", "BB.1.2(2)")
        curve = self._buckling_curve(axis)
        bending = chi = buckling.reduction_factor(slenderness, curve)
        formula = _reduction_formula(f"lambda_{axis}", slenderness, curve, buckling.NO_BUCKLING, 1.0)
        if axis == "z" and (member.buckles_by_twisting or s.kind == "2U"):
            trace.add("chi by bending", chi, "1", formula, "6.3.1.2(1), Eq. 6.49")
            chi = self._torsional(chi, curve)
        else:
            trace.add(f"chi_{axis}", chi, "1", formula, "6.3.1.2(1), Eq. 6.49")
        value = buckling.buckling_resistance(s.A, member.fy, chi, member.gamma_M1)
        resistance = trace.add(f"N_b,{axis},Rd", value, "N", f"chi_{axis} A f_y / gamma_M1", "6.3.1.1(3), Eq. 6.47")
        return Flexural(slenderness, critical, bending, resistance)

    def _torsional(self, chi: float, curve: str) -> float:
        """Return chi_z, by torsional buckling where that is less (6.3.1.4)."""
        slenderness = buckling.slenderness(self.section.A, self.member.fy, self.N_cr_T())
        self.trace.add("lambda_T", slenderness, "1", "sqrt(A f_y / N_cr,T)", "6.3.1.4(2), Eq. 6.52")
        twisting = buckling.reduction_factor(slenderness, curve)
        formula = _reduction_formula("lambda_T", slenderness, curve, buckling.NO_BUCKLING, 1.0)
        self.trace.add("chi by torsion", twisting, "1", formula, "6.3.1.4(3), Eq. 6.49")
        return self.trace.add("chi_z", min(chi, twisting), "1", "the smaller one", "6.3.1.4(1)")

    def N_cr_T(self) -> float:
        """Return the elastic critical force of torsional buckling, N; infinite where the member cannot twist."""
        s, member = self.section, self.member
        if s.kind == "2U":  # I_w = 0, so that no length counts
            self.torsion()
            critical = s.A / (s.I_y + s.I_z) * member.G * s.I_t
            return self.trace.add("N_cr,T", critical, "N", "A / (I_y + I_z) G I_t", "6.3.1.4, SN001")
        if not member.buckles_by_twisting:
            return math.inf
        length = self.trace.add("L_T", member.stability.L_LT, "m", "between restraints of twisting")
        self.torsion()
        critical = buckling.torsional_critical_force(member.E, member.G, s.A, s.I_y + s.I_z, s.I_t, s.I_w, length)
        expression = "A / (I_y + I_z) (G I_t + pi^2 E I_w / L_T^2)"
        return self.trace.add("N_cr,T", critical, "N", expression, "6.3.1.4, SN001")

    def _buckling_curve(self, axis: str) -> str:
        s = self.section
        if s.kind == "I" and s.welded:
            curve = buckling.welded_i_curve(s.tf, "y" if axis == "y" else "z")
            expression = f"welded, t_f = {1e3 * s.tf:.3g} mm, about {axis}"
        elif s.kind == "I":
            curve = buckling.rolled_i_curve(s.h, s.b, s.tf, "y" if axis == "y" else "z", self.member.fy)
            expression = f"h/b = {s.h / s.b:.3g}, t_f = {1e3 * s.tf:.3g} mm, about {axis}"
        elif s.kind == "2U":
            curve, expression = buckling.solid_curve(), "channels"
        elif s.kind == "L":
            curve, expression = buckling.angle_curve(), f"angle, about {'u' if axis == 'y' else 'v'}"
        elif s.welded:
            curve = buckling.welded_box_curve(s.h, s.b, s.tf, s.tw)
            expression = f"welded box, b/t_f = {s.b / s.tf:.3g}, h/t_w = {s.h / s.tw:.3g}"
        else:
            curve = buckling.hollow_curve(self.member.fy, s.cold_formed)
            expression = "cold formed" if s.cold_formed else "hot finished"
        return self.trace.word(f"curve {axis}", curve, expression, "6.3.1.2(2), Table 6.2")

    # ---- lateral torsional buckling, 6.3.2 --------------------------------------------------------------------------

    def M_b_Rd(self, critical: Callable[[Strength], tuple[float, float]] | None = None) -> float:
        """Return chi_LT M_y,Rk / gamma_M1, N m.

        Args:
            critical: of a member under a known moment diagram: records and returns M_cr, N m, and C_1; without it
                those of its restraints.
        """
        s, member, trace = self.section, self.member, self.trace
        modulus, W = self.modulus("y"), f"W_{member.theory},y"
        if not member.buckles_by_twisting:
            why = "hollow section" if s.kind != "I" else "compressed flange restrained all along"
            chi, symbol = trace.add("chi_LT", 1.0, "1", why, "6.3.2.1(2)"), "chi_LT"
        else:
            M_cr, C1 = self.M_cr() if critical is None else critical(self)
            slenderness = lateral_torsional.slenderness(modulus, member.fy, M_cr)
            trace.add("lambda_LT", slenderness, "1", f"sqrt({W} f_y / M_cr)", "6.3.2.2(1)")
            chi, symbol = self._chi_LT(slenderness, C1)
        value = lateral_torsional.buckling_moment(chi, modulus, member.fy, member.gamma_M1)
        return trace.add("M_b,Rd", value, "N*m", f"{symbol} {W} f_y / gamma_M1", "6.3.2.1(3), Eq. 6.55")

    def M_cr(self) -> tuple[float, float]:
        """Return M_cr, N m, and C_1 of the member as it is restrained."""
        s, member, stability = self.section, self.member, self.member.stability
        length = self.trace.add("L_LT", stability.L_LT, "m", "between restraints of the compressed flange")
        self.torsion()
        C1 = self.trace.add("C_1", stability.C1, "1", "", "SN003")
        of = member.E, member.G, s.I_z, s.I_t, s.I_w, length
        critical = lateral_torsional.critical_moment(*of, C1, stability.C2, stability.z_g)
        load = ", C_2 and z_g of the load" if stability.z_g else ""
        expression = f"C_1 pi^2 E I_z / L_LT^2 sqrt(I_w / I_z + L_LT^2 G I_t / (pi^2 E I_z)){load}"
        return self.trace.add("M_cr", critical, "N*m", expression, "SN003"), C1

    def lambda_0(self) -> float:
        """Return the slenderness in lateral torsional buckling under uniform moment; 0 without it.

        Source: EN 1993-1-1:2005, Table A.1.
        """
        s, member, table = self.section, self.member, "Annex A, Table A.1"
        if not member.buckles_by_twisting:
            return self.trace.add("lambda_0", 0.0, "1", "no lateral torsional buckling", table)
        of = member.E, member.G, s.I_z, s.I_t, s.I_w, member.stability.L_LT
        critical = lateral_torsional.critical_moment(*of)
        self.trace.add("M_cr,0", critical, "N*m", "M_cr of a uniform moment over L_T: C_1 = 1, C_2 = 0", "SN003")
        slenderness = lateral_torsional.slenderness(self.modulus("y"), member.fy, critical)
        return self.trace.add("lambda_0", slenderness, "1", f"sqrt(W_{member.theory},y f_y / M_cr,0)", table)

    def _chi_LT(self, slenderness: float, C1: float) -> tuple[float, str]:
        """Return chi_LT or chi_LT,mod, and its symbol."""
        s, trace = self.section, self.trace
        expression = f"{'welded, ' if s.welded else ''}h/b = {s.h / s.b:.3g}"
        if self.member.stability.general:
            curve = trace.word("curve LT", lateral_torsional.general_curve(s.h, s.b, not s.welded), expression)
            chi = lateral_torsional.reduction_factor_general(slenderness, curve)
            formula = _reduction_formula("lambda_LT", slenderness, curve, 0.2, 1.0)
            return trace.add("chi_LT", chi, "1", formula, "6.3.2.2(1), Eq. 6.56"), "chi_LT"
        curve = trace.word("curve LT", lateral_torsional.rolled_curve(s.h, s.b, not s.welded), expression, "Table 6.5")
        chi = lateral_torsional.reduction_factor(slenderness, curve)
        plateau, beta = lateral_torsional.LAMBDA_LT_0, lateral_torsional.BETA
        formula = _reduction_formula("lambda_LT", slenderness, curve, plateau, beta)
        trace.add("chi_LT", chi, "1", formula, "6.3.2.3(1), Eq. 6.57")
        k_c = lateral_torsional.correction_of_factor(C1)
        if k_c == 1.0:
            return chi, "chi_LT"
        trace.add("k_c", k_c, "1", "1 / sqrt(C_1) <= 1", "SCI P362")
        f = lateral_torsional.moment_distribution_factor(slenderness, k_c)
        trace.add("f", f, "1", "1 - 0.5 (1 - k_c) (1 - 2 (lambda_LT - 0.8)^2) <= 1", "6.3.2.3(2)")
        chi = lateral_torsional.modified_reduction_factor(chi, slenderness, k_c)
        least = "min(chi_LT / f, 1, 1 / lambda_LT^2)"
        return trace.add("chi_LT,mod", chi, "1", least, "6.3.2.3(2), Eq. 6.58"), "chi_LT,mod"


def _reduction_formula(symbol: str, slenderness: float, curve: str, plateau: float, beta: float) -> str:
    """Return the formula of chi by its slenderness, in symbols."""
    if slenderness <= plateau:
        return f"no buckling up to {symbol} = {plateau:g}"
    square = f"{symbol}^2" if beta == 1.0 else f"{beta:g} {symbol}^2"
    alpha = buckling.IMPERFECTION[curve]
    phi = f"Phi = 0.5 (1 + {alpha:g} ({symbol} - {plateau:g}) + {square})"
    bound = f" <= 1/{symbol}^2" if beta != 1.0 else ""
    return f"1 / (Phi + sqrt(Phi^2 - {square})){bound}, {phi}"
