"""The steps of a calculation of a member: its forces, the resistances of its section, and its stability.

The steps use the clause functions of `edesign.codes.ec3`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from edesign.building.sections.steel_section import SteelSection
from edesign.building.steel_member import SteelMember
from edesign.codes.ec3 import buckling, cross_section, lateral_torsional
from edesign.space.checks.buckling_moments import quarter_moments

N, V_Y, V_Z, _, M_Y, M_Z = range(6)
_TABLE_5_1 = "EN 1993-1-5, 5.3(1), Table 5.1"
_SYMBOL = {N: "N_Ed", V_Y: "V_y,Ed", V_Z: "V_z,Ed", M_Y: "M_y,Ed", M_Z: "M_z,Ed"}


@dataclass(frozen=True)
class Step:
    """A quantity of a calculation.

    Attributes:
        symbol: as the code has it: `chi_LT`.
        value: in SI; or a word, such as the name of a buckling curve.
        unit: SI unit, "1" of a ratio, "" of a word.
        expression: what it follows from.
        clause: of EN 1993-1-1 unless another standard is named.
    """

    symbol: str
    value: float | str
    unit: str
    expression: str = ""
    clause: str = ""


@dataclass(frozen=True)
class ForcesAlong:
    """Internal forces N, V_y, V_z, T, M_y, M_z of a member under a combination; N is positive in tension.

    Attributes:
        stations: (n,) fractions of the length.
        steady: (n, 6) of the static actions, with sign, N and N m.
        swing: (n, 6) magnitudes of the seismic action.
    """

    stations: np.ndarray
    steady: np.ndarray
    swing: np.ndarray

    @property
    def size(self) -> np.ndarray:
        """Largest magnitudes, (n, 6) N and N m."""
        return np.asarray(np.abs(self.steady) + self.swing)


@dataclass(frozen=True)
class FreeBeam:
    """A beam that is held sideways at its ends alone.

    Attributes:
        length: between its ends, m.
        load: sum of P sin2(pi x / L) of the loads on its top flange in the combination, N, downwards.
        uniform: a uniform moment is taken for the diagram.
    """

    length: float
    load: float
    uniform: bool = False


class Flexural(NamedTuple):
    """Flexural buckling about an axis; without it lambda is 0 and N_cr infinite.

    Attributes:
        slenderness: lambda.
        N_cr: elastic critical force, N.
        chi: reduction factor.
        N_b_Rd: resistance, N; that of torsional buckling where it is less.
    """

    slenderness: float
    N_cr: float
    chi: float
    N_b_Rd: float


@dataclass
class Calculation:
    """The steps that are written so far; each method adds those of one quantity and returns its value.

    Attributes:
        member: as its checks see it.
        forces: of the combination.
        free_beam: of a beam that no slab holds.
        steps: in their order.
    """

    member: SteelMember
    forces: ForcesAlong
    free_beam: FreeBeam | None = None
    steps: list[Step] = field(default_factory=list)

    @property
    def section(self) -> SteelSection:
        """Section of the member."""
        return self.member.section

    @property
    def plastic(self) -> bool:
        """The section may be used to its plastic resistance: it is of class 1 or 2."""
        return self.member.section_class < 3

    def add(self, symbol: str, value: float, unit: str, expression: str = "", clause: str = "") -> float:
        """Write a step with a number, once.

        Args:
            symbol: of the quantity.
            value: in `unit`.
            unit: SI.
            expression: in symbols; "" for a given value.
            clause: of EN 1993-1-1, or with its code.

        Returns:
            The value.
        """
        step = Step(symbol, float(value), unit, expression, clause)
        if step not in self.steps:
            self.steps.append(step)
        return float(value)

    def word(self, symbol: str, value: str, expression: str = "", clause: str = "") -> str:
        """Write a step whose result is a word.

        Args:
            symbol: of the quantity.
            value: the word.
            expression: why.
            clause: of EN 1993-1-1.

        Returns:
            The word.
        """
        self.steps.append(Step(symbol, value, "", expression, clause))
        return value

    def use(self, value: float, expression: str, clause: str) -> None:
        """Write the utilisation.

        Args:
            value: dimensionless.
            expression: in symbols.
            clause: of EN 1993-1-1.
        """
        self.add("utilisation", value, "1", expression, clause)

    # ---- effects ----------------------------------------------------------------------------------------------------

    def force(self, of: int, station: int) -> float:
        """Write the magnitude of a force at a station.

        Args:
            of: index of the force: N, V_Y, ...
            station: its index.

        Returns:
            N or N m.
        """
        steady, swing = (float(part[station, of]) for part in (self.forces.steady, self.forces.swing))
        at = f"at x = {self.forces.stations[station]:.3g} L"
        return self.add(_SYMBOL[of], abs(steady) + swing, _unit(of), f"{_parts(steady, swing, of)} {at}")

    def largest(self, of: int) -> float:
        """Write the largest magnitude of a force along the member.

        Args:
            of: index of the force: N, V_Y, ...

        Returns:
            N or N m.
        """
        return self.force(of, int(self.forces.size[:, of].argmax()))

    def compression(self) -> float:
        """Write the largest compression along the member, at least 0.

        Returns:
            N.
        """
        along = self.forces.swing[:, N] - self.forces.steady[:, N]
        station = int(along.argmax())
        steady, swing = float(self.forces.steady[station, N]), float(self.forces.swing[station, N])
        at = f"at x = {self.forces.stations[station]:.3g} L"
        return self.add("N_Ed", max(swing - steady, 0.0), "N", f"compression, {_parts(steady, swing, N)} {at}")

    # ---- resistances of the section ---------------------------------------------------------------------------------

    def steel(self, stability: bool = False) -> None:
        """Write the strength and the partial factor.

        Args:
            stability: write the moduli and the factor of checks of stability.
        """
        self.add("f_y", self.member.fy, "Pa")
        if stability:
            self.add("E", self.member.E, "Pa")
            self.add("gamma_M1", self.member.gamma_M1, "1", "", "6.1(1)")
        else:
            self.add("gamma_M0", self.member.gamma_M0, "1", "", "6.1(1)")

    def area(self) -> float:
        """Write the area A.

        Returns:
            A, m2.
        """
        return self.add("A", self.section.A, "m2")

    def N_pl_Rd(self) -> float:
        """Write the area and the plastic resistance N_pl,Rd.

        Returns:
            N_pl,Rd, N.

        Source: EN 1993-1-1:2005, 6.2.4(2), Eq. 6.10.
        """
        self.area()
        value = cross_section.axial_resistance(self.section.A, self.member.fy, self.member.gamma_M0)
        return self.add("N_pl,Rd", value, "N", "A f_y / gamma_M0", "6.2.4(2), Eq. 6.10")

    def V_Rd(self, along: int) -> float:
        """Write the resistance to shear along an axis; slender webs have V_b,Rd where that is less.

        Args:
            along: V_Y or V_Z.

        Returns:
            V_Rd, N.

        Source: EN 1993-1-1:2005, 6.2.6(2), Eq. 6.18; EN 1993-1-5:2006, 5.2(1).
        """
        axis = "y" if along == V_Y else "z"
        area = self.add(f"A_v,{axis}", self.section.A_vy if along == V_Y else self.section.A_vz, "m2", "", "6.2.6(3)")
        value = cross_section.shear_resistance(area, self.member.fy, self.member.gamma_M0)
        self.add(f"V_pl,{axis},Rd", value, "N", f"A_v,{axis} f_y / (sqrt(3) gamma_M0)", "6.2.6(2), Eq. 6.18")
        return self._V_b_Rd(value) if self.shear_symbol(along) == "V_b,z,Rd" else value

    def shear_symbol(self, along: int) -> str:
        """Return the symbol V_pl,Rd, or V_b,Rd of webs that shear may buckle.

        Args:
            along: V_Y or V_Z.
        """
        s = self.section
        if along == V_Y:
            return "V_pl,y,Rd"
        slender = s.webs > 0 and cross_section.web_is_slender(s.h_w, s.tw, self.member.fy)
        return "V_b,z,Rd" if slender else "V_pl,z,Rd"

    def _V_b_Rd(self, plastic: float) -> float:
        s, member = self.section, self.member
        self.add("gamma_M1", member.gamma_M1, "1", "", "6.1(1)")
        h_w, t_w = self.add("h_w", s.h_w, "m"), self.add("t_w", s.tw, "m")
        slenderness = cross_section.web_slenderness(h_w, t_w, member.fy)
        self.add("lambda_w", slenderness, "1", "h_w / (86.4 t_w epsilon)", "EN 1993-1-5, 5.3(3), Eq. 5.5")
        self.add("chi_w", cross_section.shear_buckling_factor(slenderness), "1", "0.83 / lambda_w <= 1", _TABLE_5_1)
        value = min(s.webs * cross_section.shear_buckling_resistance(h_w, t_w, member.fy, member.gamma_M1), plastic)
        of = f"{s.webs} " if s.webs > 1 else ""
        expression = f"{of}chi_w f_y h_w t_w / (sqrt(3) gamma_M1) <= V_pl,z,Rd"
        return self.add("V_b,z,Rd", value, "N", expression, "EN 1993-1-5, 5.2(1), Eqs. 5.1, 5.2")

    @property
    def theory(self) -> str:
        """Index of symbols: "pl" for plastic and "el" for elastic moduli."""
        return "pl" if self.plastic else "el"

    def modulus(self, axis: str) -> float:
        """Write the section modulus that the class of the section permits.

        Args:
            axis: "y" or "z".

        Returns:
            W_pl or W_el, m3.
        """
        return self.add(f"W_{self.theory},{axis}", getattr(self.section, f"W_{self.theory}_{axis}"), "m3")

    def M_Rd(self, axis: str) -> float:
        """Write the resistance to bending about an axis without other forces.

        Args:
            axis: "y" or "z".

        Returns:
            M_c,Rd, N m.

        Source: EN 1993-1-1:2005, 6.2.5(2), Eqs. 6.13 and 6.14.
        """
        modulus = self.modulus(axis)
        value = cross_section.moment_resistance(modulus, self.member.fy, self.member.gamma_M0)
        clause = "6.2.5(2), Eq. 6.13" if self.plastic else "6.2.5(2), Eq. 6.14"
        expression = f"W_{self.theory},{axis} f_y / gamma_M0"
        return self.add(f"M_{self.theory},{axis},Rd", value, "N*m", expression, clause)

    def section_class(self) -> None:
        """Write the class of the section."""
        self.word("class", str(self.member.section_class), "plastic" if self.plastic else "elastic", "5.5.2, Table 5.2")

    # ---- stability --------------------------------------------------------------------------------------------------

    @property
    def twists(self) -> bool:
        """True if the member can buckle by twisting: not a hollow section, and not held all along."""
        return self.section.kind == "I" and self.member.stability.L_LT > 0.0

    def flexural(self, axis: str) -> Flexural:
        """Write the resistance to buckling about an axis; about z torsional buckling counts where it governs.

        Args:
            axis: "y" or "z".

        Returns:
            Slenderness, critical force, reduction factors and resistance.

        Source: EN 1993-1-1:2005, 6.3.1.
        """
        s, member = self.section, self.member
        length = getattr(member.stability, f"L_cr_{axis}")
        self.add(f"L_cr,{axis}", length, "m", "" if length > 0.0 else "held all along")
        slenderness, critical = 0.0, math.inf
        if length > 0.0:
            inertia = self.add(f"I_{axis}", getattr(s, f"I_{axis}"), "m4")
            critical = buckling.critical_force(member.E, inertia, length)
            self.add(f"N_cr,{axis}", critical, "N", f"pi^2 E I_{axis} / L_cr,{axis}^2", "6.3.1.2(1)")
            slenderness = buckling.slenderness(s.A, member.fy, critical)
            self.add(f"lambda_{axis}", slenderness, "1", f"sqrt(A f_y / N_cr,{axis})", "6.3.1.3(1), Eq. 6.50")
        curve = self._buckling_curve(axis)
        bending = chi = buckling.reduction_factor(slenderness, curve)
        formula = _reduction_formula(f"lambda_{axis}", slenderness, curve, buckling.NO_BUCKLING, 1.0)
        if axis == "z" and self.twists:
            self.add("chi by bending", chi, "1", formula, "6.3.1.2(1), Eq. 6.49")
            chi = self.torsional(chi, curve)
        else:
            self.add(f"chi_{axis}", chi, "1", formula, "6.3.1.2(1), Eq. 6.49")
        value = buckling.buckling_resistance(s.A, member.fy, chi, member.gamma_M1)
        resistance = self.add(f"N_b,{axis},Rd", value, "N", f"chi_{axis} A f_y / gamma_M1", "6.3.1.1(3), Eq. 6.47")
        return Flexural(slenderness, critical, bending, resistance)

    def torsional(self, chi: float, curve: str) -> float:
        """Write chi_z, by torsional buckling where that is less.

        Args:
            chi: reduction factor of flexural buckling.
            curve: buckling curve about z.

        Returns:
            chi_z, dimensionless.

        Source: EN 1993-1-1:2005, 6.3.1.4.
        """
        critical = self.N_cr_T()
        slenderness = buckling.slenderness(self.section.A, self.member.fy, critical)
        self.add("lambda_T", slenderness, "1", "sqrt(A f_y / N_cr,T)", "6.3.1.4(2), Eq. 6.52")
        twisting = buckling.reduction_factor(slenderness, curve)
        formula = _reduction_formula("lambda_T", slenderness, curve, buckling.NO_BUCKLING, 1.0)
        self.add("chi by torsion", twisting, "1", formula, "6.3.1.4(3), Eq. 6.49")
        return self.add("chi_z", min(chi, twisting), "1", "the smaller one", "6.3.1.4(1)")

    def N_cr_T(self) -> float:
        """Write the elastic critical force of torsional buckling, N; infinite where the member cannot twist."""
        if not self.twists:
            return math.inf
        s, member = self.section, self.member
        length = self.add("L_T", member.stability.L_LT, "m", "between restraints of twisting")
        self.torsion()
        critical = buckling.torsional_critical_force(member.E, member.G, s.A, s.I_y + s.I_z, s.I_t, s.I_w, length)
        return self.add("N_cr,T", critical, "N", "A / (I_y + I_z) (G I_t + pi^2 E I_w / L_T^2)", "6.3.1.4, SN001")

    def torsion(self) -> None:
        """Write the constants of the section that resist twisting."""
        self.add("G", self.member.G, "Pa")
        self.add("I_y", self.section.I_y, "m4")
        self.add("I_z", self.section.I_z, "m4")
        self.add("I_t", self.section.I_t, "m4")
        self.add("I_w", self.section.I_w, "m6")

    def _buckling_curve(self, axis: str) -> str:
        """Write the buckling curve about an axis.

        Args:
            axis: "y" or "z".

        Returns:
            Name of the curve.

        Source: EN 1993-1-1:2005, 6.3.1.2(2), Table 6.2.
        """
        s = self.section
        if s.kind == "I":
            which = "y" if axis == "y" else "z"
            curve = buckling.rolled_i_curve(s.h, s.b, s.tf, which, self.member.fy)  # type: ignore[arg-type]
            expression = f"h/b = {s.h / s.b:.3g}, t_f = {1e3 * s.tf:.3g} mm, about {axis}"
        else:
            curve = buckling.hollow_curve(self.member.fy, s.cold_formed)
            expression = "cold formed" if s.cold_formed else "hot finished"
        return self.word(f"curve {axis}", curve, expression, "6.3.1.2(2), Table 6.2")

    def M_b_Rd(self) -> float:
        """Write chi_LT M_y,Rk / gamma_M1, N m."""
        s, member = self.section, self.member
        modulus, W = self.modulus("y"), f"W_{self.theory},y"
        if not self.twists:
            why = "hollow section" if s.kind != "I" else "compressed flange held all along"
            chi, symbol = self.add("chi_LT", 1.0, "1", why, "6.3.2.1(2)"), "chi_LT"
        else:
            critical, C1 = self.M_cr() if self.free_beam is None else self._M_cr_of_diagram(self.free_beam)
            slenderness = lateral_torsional.slenderness(modulus, member.fy, critical)
            self.add("lambda_LT", slenderness, "1", f"sqrt({W} f_y / M_cr)", "6.3.2.2(1)")
            chi, symbol = self.chi_LT(slenderness, C1)
        value = lateral_torsional.buckling_moment(chi, modulus, member.fy, member.gamma_M1)
        return self.add("M_b,Rd", value, "N*m", f"{symbol} {W} f_y / gamma_M1", "6.3.2.1(3), Eq. 6.55")

    def M_cr(self) -> tuple[float, float]:
        """Write M_cr and C_1 of the member as it is held.

        Returns:
            M_cr, N m, and C_1.
        """
        s, member, held = self.section, self.member, self.member.stability
        length = self.add("L_LT", held.L_LT, "m", "between restraints of the compressed flange")
        self.torsion()
        C1 = self.add("C_1", held.C1, "1", "", "SN003")
        of = member.E, member.G, s.I_z, s.I_t, s.I_w, length
        critical = lateral_torsional.critical_moment(*of, C1, held.C2, held.z_g)
        load = ", C_2 and z_g of the load" if held.z_g else ""
        expression = f"C_1 pi^2 E I_z / L_LT^2 sqrt(I_w / I_z + L_LT^2 G I_t / (pi^2 E I_z)){load}"
        return self.add("M_cr", critical, "N*m", expression, "SN003"), C1

    def _M_cr_of_diagram(self, beam: FreeBeam) -> tuple[float, float]:
        """Write M_cr and C_1 by the moment diagram of the combination, with loads on the top flange.

        Args:
            beam: without a slab that holds it.

        Returns:
            M_cr, N m, and C_1.
        """
        s, member = self.section, self.member
        length = self.add("L_LT", beam.length, "m", "between restraints of the compressed flange")
        self.torsion()
        M_y = self.largest(M_Y)
        steady, swing = self.forces.steady[:, M_Y], self.forces.swing[:, M_Y]
        if beam.uniform:
            C1 = self.add("C_1", 1.0, "1", "uniform moment: braces that meet the beam do not hold it sideways")
        else:
            M_A, M_B, M_C = (float(M) for M in quarter_moments(steady, swing))
            self.add("M_A", M_A, "N*m", f"{_at_quarter(steady, swing)}, of x = L/6, L/3, L/2")
            self.add("M_B", M_B, "N*m", f"{_parts(float(steady[3]), float(swing[3]), M_Y)} at x = L/2")
            self.add("M_C", M_C, "N*m", f"{_at_quarter(steady[::-1], swing[::-1])}, of x = 5L/6, 2L/3, L/2")
            C1 = lateral_torsional.diagram_factor(M_y, M_A, M_B, M_C)
            root = "sqrt(35 M_y,Ed^2 / (M_y,Ed^2 + 9 M_A^2 + 16 M_B^2 + 9 M_C^2))"
            self.add("C_1", C1, "1", root if M_y > 0.0 else "without moment", "Serna et al. 2006")
        z_g = self.add("z_g", 0.5 * s.h, "m", "h / 2: loads on the top flange")
        expression = "sum of P_i sin^2(pi x_i / L_LT) of the loads on the beam, downwards, >= 0"
        load = self.add("P", max(beam.load, 0.0), "N", expression)
        C2_z_g = C1 * length * load * z_g / (math.pi**2 * M_y) if M_y > 0.0 else 0.0
        expression = "C_1 L_LT P z_g / (pi^2 M_y,Ed)" if M_y > 0.0 else "without moment"
        self.add("C_2 z_g", C2_z_g, "m", expression, "energy of one half-wave")
        of = member.E, member.G, s.I_z, s.I_t, s.I_w, length
        critical = lateral_torsional.critical_moment(*of, C1, 1.0, C2_z_g)
        root = "sqrt(I_w / I_z + L_LT^2 G I_t / (pi^2 E I_z) + (C_2 z_g)^2)"
        expression = f"C_1 pi^2 E I_z / L_LT^2 ({root} - C_2 z_g)"
        return self.add("M_cr", critical, "N*m", expression, "SN003, Eq. 1"), C1

    def chi_LT(self, slenderness: float, C1: float) -> tuple[float, str]:
        """Write chi_LT, or chi_LT,mod.

        Args:
            slenderness: lambda_LT.
            C1: of the moment diagram.

        Returns:
            The factor and its symbol.
        """
        s, held = self.section, self.member.stability
        if held.general:
            curve = self.word("curve LT", lateral_torsional.general_curve(s.h, s.b), f"h/b = {s.h / s.b:.3g}")
            chi = lateral_torsional.reduction_factor_general(slenderness, curve)
            formula = _reduction_formula("lambda_LT", slenderness, curve, 0.2, 1.0)
            return self.add("chi_LT", chi, "1", formula, "6.3.2.2(1), Eq. 6.56"), "chi_LT"
        expression = f"h/b = {s.h / s.b:.3g}"
        curve = self.word("curve LT", lateral_torsional.rolled_curve(s.h, s.b), expression, "Table 6.5")
        chi = lateral_torsional.reduction_factor(slenderness, curve)
        plateau, beta = lateral_torsional.LAMBDA_LT_0, lateral_torsional.BETA
        formula = _reduction_formula("lambda_LT", slenderness, curve, plateau, beta)
        self.add("chi_LT", chi, "1", formula, "6.3.2.3(1), Eq. 6.57")
        k_c = lateral_torsional.correction_of_factor(C1)
        if k_c == 1.0:
            return chi, "chi_LT"
        self.add("k_c", k_c, "1", "1 / sqrt(C_1) <= 1", "SCI P362")
        f = lateral_torsional.moment_distribution_factor(slenderness, k_c)
        self.add("f", f, "1", "1 - 0.5 (1 - k_c) (1 - 2 (lambda_LT - 0.8)^2) <= 1", "6.3.2.3(2)")
        chi = lateral_torsional.modified_reduction_factor(chi, slenderness, k_c)
        least = "min(chi_LT / f, 1, 1 / lambda_LT^2)"
        return self.add("chi_LT,mod", chi, "1", least, "6.3.2.3(2), Eq. 6.58"), "chi_LT,mod"


def _reduction_formula(symbol: str, slenderness: float, curve: str, plateau: float, beta: float) -> str:
    """Return the formula of chi by its slenderness, in symbols."""
    if slenderness <= plateau:
        return f"no buckling up to {symbol} = {plateau:g}"
    square = f"{symbol}^2" if beta == 1.0 else f"{beta:g} {symbol}^2"
    alpha = buckling.IMPERFECTION[curve]
    phi = f"Phi = 0.5 (1 + {alpha:g} ({symbol} - {plateau:g}) + {square})"
    bound = f" <= 1/{symbol}^2" if beta != 1.0 else ""
    return f"1 / (Phi + sqrt(Phi^2 - {square})){bound}, {phi}"


def _at_quarter(steady: np.ndarray, swing: np.ndarray) -> str:
    """The moment at the first quarter, from those at sixths, as `quarter_moments` has it; in kN m."""
    a, b, c = (_digits(M / 1e3) if M >= 0.0 else f"({_digits(M / 1e3)})" for M in steady[1:4].tolist())
    text = f"|3 x {a} + 6 x {b} - {c}| / 8"
    if swing.any():
        text += f" + ({' + '.join(_digits(M / 1e3) for M in swing[1:3].tolist())}) / 2"
    return f"{text} kN*m"


def _parts(steady: float, swing: float, of: int) -> str:
    unit = "kN" if of < M_Y else "kN*m"
    if swing == 0.0:
        return f"{_digits(steady / 1e3)} {unit}"
    return f"{_digits(steady / 1e3)} +- {_digits(swing / 1e3)} {unit}"


def _digits(value: float) -> str:
    return f"{value:#.4g}".rstrip(".") if abs(value) < 1e4 else f"{value:.0f}"


def _unit(of: int) -> str:
    return "N" if of < M_Y else "N*m"
