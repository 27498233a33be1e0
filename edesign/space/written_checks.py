"""A check of a member written out: from its section, its forces and its restraints to its utilisation.

The steps use the clause functions of `edesign.codes.ec3`. The core computes the same utilisations for all members and
combinations at once; that both agree is tested.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from edesign.building.steel_member import SteelMember
from edesign.building.steel_section import SteelSection
from edesign.codes.ec3 import buckling, cross_section, interaction, lateral_torsional
from edesign.codes.ec8.moment_frames import AXIAL_LIMIT, SHEAR_LIMIT

N, V_Y, V_Z, _, M_Y, M_Z = range(6)
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
        """(n, 6) largest magnitudes."""
        return np.asarray(np.abs(self.steady) + self.swing)


def written_check(member: SteelMember, forces: ForcesAlong, check: str, station: int) -> tuple[Step, ...]:
    """Return the steps of a check, the utilisation last; none for a check that is not known here.

    Args:
        member: as its checks see it.
        forces: of the combination.
        check: its name, as in `MemberResults.checks`.
        station: number of the governing station; checks of the whole member take the largest forces along it.
    """
    writer = _CHECKS.get(check)
    if writer is None:
        return ()
    written = _Written(member, forces)
    writer(written, station)
    return tuple(written.steps)


@dataclass
class _Written:
    """The steps that are written already, and what most of them are made from."""

    member: SteelMember
    forces: ForcesAlong
    steps: list[Step] = field(default_factory=list)

    @property
    def section(self) -> SteelSection:
        return self.member.section

    @property
    def plastic(self) -> bool:
        return self.member.section_class < 3

    def add(self, symbol: str, value: float, unit: str, expression: str = "", clause: str = "") -> float:
        step = Step(symbol, float(value), unit, expression, clause)
        if step not in self.steps:
            self.steps.append(step)
        return float(value)

    def word(self, symbol: str, value: str, expression: str = "", clause: str = "") -> str:
        self.steps.append(Step(symbol, value, "", expression, clause))
        return value

    def use(self, value: float, expression: str, clause: str) -> None:
        """The utilisation."""
        self.add("utilisation", value, "1", expression, clause)

    # ---- effects ----------------------------------------------------------------------------------------------------

    def force(self, of: int, station: int) -> float:
        """The magnitude of a force at a station."""
        steady, swing = (float(part[station, of]) for part in (self.forces.steady, self.forces.swing))
        at = f"at x = {self.forces.stations[station]:.3g} L"
        return self.add(_SYMBOL[of], abs(steady) + swing, _unit(of), f"{_parts(steady, swing, of)} {at}")

    def largest(self, of: int) -> float:
        """The largest magnitude of a force along the member."""
        return self.force(of, int(self.forces.size[:, of].argmax()))

    def compression(self) -> float:
        """The largest compression along the member, at least 0."""
        along = self.forces.swing[:, N] - self.forces.steady[:, N]
        station = int(along.argmax())
        steady, swing = float(self.forces.steady[station, N]), float(self.forces.swing[station, N])
        at = f"at x = {self.forces.stations[station]:.3g} L"
        return self.add("N_Ed", max(swing - steady, 0.0), "N", f"compression, {_parts(steady, swing, N)} {at}")

    # ---- resistances of the section ---------------------------------------------------------------------------------

    def steel(self, stability: bool = False) -> None:
        """Strength and partial factor; of checks of stability the moduli and the factor of these."""
        self.add("f_y", self.member.fy, "Pa")
        if stability:
            self.add("E", self.member.E, "Pa")
            self.add("gamma_M1", self.member.gamma_M1, "1", "", "6.1(1)")
        else:
            self.add("gamma_M0", self.member.gamma_M0, "1", "", "6.1(1)")

    def area(self) -> float:
        return self.add("A", self.section.A, "m2")

    def N_pl_Rd(self) -> float:
        self.area()
        value = cross_section.axial_resistance(self.section.A, self.member.fy, self.member.gamma_M0)
        return self.add("N_pl,Rd", value, "N", "A f_y / gamma_M0", "6.2.4(2), Eq. 6.10")

    def V_pl_Rd(self, along: int) -> float:
        axis = "y" if along == V_Y else "z"
        area = self.add(f"A_v,{axis}", self.section.A_vy if along == V_Y else self.section.A_vz, "m2", "", "6.2.6(3)")
        value = cross_section.shear_resistance(area, self.member.fy, self.member.gamma_M0)
        return self.add(f"V_pl,{axis},Rd", value, "N", f"A_v,{axis} f_y / (sqrt(3) gamma_M0)", "6.2.6(2), Eq. 6.18")

    @property
    def theory(self) -> str:
        return "pl" if self.plastic else "el"

    def modulus(self, axis: str) -> float:
        return self.add(f"W_{self.theory},{axis}", getattr(self.section, f"W_{self.theory}_{axis}"), "m3")

    def M_Rd(self, axis: str) -> float:
        modulus = self.modulus(axis)
        value = cross_section.moment_resistance(modulus, self.member.fy, self.member.gamma_M0)
        clause = "6.2.5(2), Eq. 6.13" if self.plastic else "6.2.5(2), Eq. 6.14"
        expression = f"W_{self.theory},{axis} f_y / gamma_M0"
        return self.add(f"M_{self.theory},{axis},Rd", value, "N*m", expression, clause)

    def section_class(self) -> None:
        self.word("class", str(self.member.section_class), "plastic" if self.plastic else "elastic", "5.5.2, Table 5.2")

    # ---- stability --------------------------------------------------------------------------------------------------

    def flexural(self, axis: str) -> tuple[float, float]:
        """lambda and N_b,Rd about an axis."""
        s, member = self.section, self.member
        length = getattr(member.stability, f"L_cr_{axis}")
        self.add(f"L_cr,{axis}", length, "m", "" if length > 0.0 else "held all along")
        slenderness = 0.0
        if length > 0.0:
            inertia = self.add(f"I_{axis}", getattr(s, f"I_{axis}"), "m4")
            critical = buckling.critical_force(member.E, inertia, length)
            self.add(f"N_cr,{axis}", critical, "N", f"pi^2 E I_{axis} / L_cr,{axis}^2", "6.3.1.2(1)")
            slenderness = buckling.slenderness(s.A, member.fy, critical)
            self.add(f"lambda_{axis}", slenderness, "1", f"sqrt(A f_y / N_cr,{axis})", "6.3.1.3(1), Eq. 6.50")
        curve = self.buckling_curve(axis)
        chi = buckling.reduction_factor(slenderness, curve)
        if axis == "z" and s.kind == "I" and member.stability.L_LT > 0.0:
            chi = self.torsional(chi, curve)
        else:
            self.add(f"chi_{axis}", chi, "1", f"curve {curve}", "6.3.1.2(1), Eq. 6.49")
        value = buckling.buckling_resistance(s.A, member.fy, chi, member.gamma_M1)
        resistance = self.add(f"N_b,{axis},Rd", value, "N", f"chi_{axis} A f_y / gamma_M1", "6.3.1.1(3), Eq. 6.47")
        return slenderness, resistance

    def torsional(self, chi: float, curve: str) -> float:
        """chi_z, by torsional buckling where that is less."""
        s, member = self.section, self.member
        length = self.add("L_T", member.stability.L_LT, "m", "between restraints of twisting")
        self.torsion()
        critical = buckling.torsional_critical_force(member.E, member.G, s.A, s.I_y + s.I_z, s.I_t, s.I_w, length)
        self.add("N_cr,T", critical, "N", "A / (I_y + I_z) (G I_t + pi^2 E I_w / L_T^2)", "6.3.1.4, SN001")
        slenderness = buckling.slenderness(s.A, member.fy, critical)
        self.add("lambda_T", slenderness, "1", "sqrt(A f_y / N_cr,T)", "6.3.1.4(2), Eq. 6.52")
        twisting = buckling.reduction_factor(slenderness, curve)
        expression = f"curve {curve}: min({chi:.4g} by bending, {twisting:.4g} by torsion)"
        return self.add("chi_z", min(chi, twisting), "1", expression, "6.3.1.2(1), Eq. 6.49")

    def torsion(self) -> None:
        """The constants of the section that resist twisting."""
        self.add("G", self.member.G, "Pa")
        self.add("I_y", self.section.I_y, "m4")
        self.add("I_z", self.section.I_z, "m4")
        self.add("I_t", self.section.I_t, "m4")
        self.add("I_w", self.section.I_w, "m6")

    def buckling_curve(self, axis: str) -> str:
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
        """chi_LT M_y,Rk / gamma_M1."""
        s, member, held = self.section, self.member, self.member.stability
        modulus, W = self.modulus("y"), f"W_{self.theory},y"
        if s.kind != "I" or held.L_LT == 0.0:
            why = "hollow section" if s.kind != "I" else "compressed flange held all along"
            chi = self.add("chi_LT", 1.0, "1", why, "6.3.2.1(2)")
        else:
            length = self.add("L_LT", held.L_LT, "m", "between restraints of the compressed flange")
            self.torsion()
            self.add("C_1", held.C1, "1", "", "SN003")
            shape = held.C1, held.C2, held.z_g
            critical = lateral_torsional.critical_moment(member.E, member.G, s.I_z, s.I_t, s.I_w, length, *shape)
            load = ", C_2 and z_g of the load" if held.z_g else ""
            expression = f"C_1 pi^2 E I_z / L_LT^2 sqrt(I_w / I_z + L_LT^2 G I_t / (pi^2 E I_z)){load}"
            self.add("M_cr", critical, "N*m", expression, "SN003")
            slenderness = lateral_torsional.slenderness(modulus, member.fy, critical)
            self.add("lambda_LT", slenderness, "1", f"sqrt({W} f_y / M_cr)", "6.3.2.2(1)")
            chi = self.chi_LT(slenderness)
        value = lateral_torsional.buckling_moment(chi, modulus, member.fy, member.gamma_M1)
        return self.add("M_b,Rd", value, "N*m", f"chi_LT {W} f_y / gamma_M1", "6.3.2.1(3), Eq. 6.55")

    def chi_LT(self, slenderness: float) -> float:
        s, held = self.section, self.member.stability
        if held.general:
            curve = self.word("curve LT", lateral_torsional.general_curve(s.h, s.b), f"h/b = {s.h / s.b:.3g}")
            chi = lateral_torsional.reduction_factor_general(slenderness, curve)
            return self.add("chi_LT", chi, "1", f"curve {curve}", "6.3.2.2(1), Eq. 6.56")
        expression = f"h/b = {s.h / s.b:.3g}"
        curve = self.word("curve LT", lateral_torsional.rolled_curve(s.h, s.b), expression, "Table 6.5")
        chi = lateral_torsional.reduction_factor(slenderness, curve)
        k_c = lateral_torsional.correction_of_factor(held.C1)
        chi = lateral_torsional.modified_reduction_factor(chi, slenderness, k_c)
        return self.add("chi_LT", chi, "1", f"curve {curve}, k_c = {k_c:.3g}", "6.3.2.3, Eq. 6.57, 6.58")


def _parts(steady: float, swing: float, of: int) -> str:
    unit = "kN" if of < M_Y else "kN*m"
    if swing == 0.0:
        return f"{steady / 1e3:#.4g} {unit}"
    return f"{steady / 1e3:#.4g} +- {swing / 1e3:#.4g} {unit}"


def _unit(of: int) -> str:
    return "N" if of < M_Y else "N*m"


# ---- the checks ----


def _axial(w: _Written, station: int) -> None:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    w.use(N_Ed / N_Rd, "N_Ed / N_pl,Rd", "6.2.3(1), 6.2.4(1)")


def _shear(along: int) -> Callable[[_Written, int], None]:
    def write(w: _Written, station: int) -> None:
        w.steel()
        V_Ed, V_Rd = w.largest(along), w.V_pl_Rd(along)
        axis = "y" if along == V_Y else "z"
        w.use(V_Ed / V_Rd, f"V_{axis},Ed / V_pl,{axis},Rd", "6.2.6(1), Eq. 6.17")

    return write


def _moment(of: int) -> Callable[[_Written, int], None]:
    axis = "y" if of == M_Y else "z"

    def write(w: _Written, station: int) -> None:
        w.section_class()
        w.steel()
        M_Ed = w.force(of, station)
        M_Rd, symbol = w.M_Rd(axis), f"M_{w.theory},{axis},Rd"
        across = V_Z if of == M_Y else V_Y
        rho = _reduction(w, across, station)
        if rho > 0.0:
            M_Rd, symbol = _with_shear(w, axis, M_Rd, rho)
        w.use(_ratio(M_Ed, M_Rd), f"M_{axis},Ed / {symbol}", "6.2.5(1), Eq. 6.12")

    return write


def _reduction(w: _Written, along: int, station: int) -> float:
    """rho of the shear at a station; written where it counts."""
    resistance = w.member.constants.V_y_Rd if along == V_Y else w.member.constants.V_z_Rd
    rho = cross_section.shear_reduction(float(w.forces.size[station, along]), resistance)
    if rho > 0.0:
        axis = "y" if along == V_Y else "z"
        w.force(along, station)
        w.V_pl_Rd(along)
        w.add(f"rho_{axis}", rho, "1", f"(2 V_{axis},Ed / V_pl,{axis},Rd - 1)^2 <= 1", "6.2.8(3)")
    return rho


def _with_shear(w: _Written, axis: str, M_Rd: float, rho: float) -> tuple[float, str]:
    """M_V,Rd and its symbol."""
    of_area = w.member.constants.M_y_shear if axis == "y" else M_Rd
    across = "z" if axis == "y" else "y"
    value = cross_section.moment_resistance_with_shear(M_Rd, rho, of_area)
    expression = f"M_{axis},Rd - rho_{across} {of_area / 1e3:.4g} kN*m"
    return w.add(f"M_V,{axis},Rd", value, "N*m", expression, "6.2.8(3), (5)"), f"M_V,{axis},Rd"


def _ratio(load: float, resistance: float) -> float:
    return 0.0 if load <= 0.0 else load / resistance if resistance > 0.0 else math.inf


def _section(w: _Written, station: int) -> None:
    """N-M of the section at a station; N takes the sign of the seismic action that gives more."""
    w.section_class()
    w.steel()
    N_Ed, M_y, M_z = (w.force(of, station) for of in (N, M_Y, M_Z))
    N_Rd, M_y_Rd, M_z_Rd = w.N_pl_Rd(), w.M_Rd("y"), w.M_Rd("z")
    rho_y, rho_z = _reduction(w, V_Y, station), _reduction(w, V_Z, station)
    c = w.member.constants
    if rho_y > 0.0 or rho_z > 0.0:
        value = cross_section.axial_resistance_with_shear(N_Rd, rho_y, c.V_y_Rd, rho_z, c.V_z_Rd)
        expression = "N_pl,Rd - sqrt(3) (rho_y V_pl,y,Rd + rho_z V_pl,z,Rd)"
        N_Rd = w.add("N_V,Rd", value, "N", expression, "6.2.10(3), Eq. 6.45")
    if rho_z > 0.0:
        M_y_Rd, _ = _with_shear(w, "y", M_y_Rd, rho_z)
    if rho_y > 0.0:
        M_z_Rd, _ = _with_shear(w, "z", M_z_Rd, rho_y)
    steady, swing = float(w.forces.steady[station, N]), float(w.forces.swing[station, N])
    other = abs(abs(steady) - swing)
    ratios = _ratio(M_y, M_y_Rd), _ratio(M_z, M_z_Rd)
    if swing > 0.0 and _plain_section(w, other, N_Rd, *ratios, rho_z) > _plain_section(w, N_Ed, N_Rd, *ratios, rho_z):
        N_Ed = w.add("N_Ed", other, "N", "with the other sign of the seismic action, which gives more")
    n = w.add("n", _ratio(N_Ed, N_Rd), "1", "N_Ed / N_Rd", "6.2.9.1(5)")
    m_y = w.add("m_y", ratios[0], "1", "M_y,Ed / M_y,Rd")
    m_z = w.add("m_z", ratios[1], "1", "M_z,Ed / M_z,Rd")
    value = _plain_section(w, N_Ed, N_Rd, m_y, m_z, rho_z)
    linear = cross_section.linear_interaction(n, m_y, m_z)
    if not w.plastic or value == linear:
        clause = "6.2.1(7), Eq. 6.2" if w.plastic else "6.2.9.2(1), Eq. 6.42"
        w.use(value, f"n + m_y + m_z = {n:.4g} + {m_y:.4g} + {m_z:.4g}", clause)
        return
    shares = _reduced(w, N_Ed, n, rho_z)
    reduced_y = w.add("M_N,y,Rd / M_y,Rd", shares[0], "1", "", "6.2.9.1(4), (5)")
    reduced_z = w.add("M_N,z,Rd / M_z,Rd", shares[1], "1", "", "6.2.9.1(4), (5)")
    alpha, beta = cross_section.biaxial_exponents(w.section.kind, n)
    about_y, about_z = _ratio(m_y, reduced_y), _ratio(m_z, reduced_z)
    if value == max(about_y, about_z):
        axis = "y" if about_y >= about_z else "z"
        w.use(value, f"M_{axis},Ed / M_N,{axis},Rd", "6.2.9.1(2), Eq. 6.31")
    else:
        w.use(value, f"{about_y:.4g}^{alpha:.3g} + {about_z:.4g}^{beta:.3g}", "6.2.9.1(6), Eq. 6.41")


def _reduced(w: _Written, N_Ed: float, n: float, rho_z: float) -> tuple[float, float]:
    """M_N,Rd / M_Rd about y and z."""
    c = w.member.constants
    if w.section.kind == "CHS":
        of = cross_section.moment_resistance_with_axial_force_round(1.0, n)
        return of, of
    y = cross_section.moment_resistance_with_axial_force_y(1.0, n, c.a_y)
    if w.section.kind == "RHS":
        return y, cross_section.moment_resistance_with_axial_force_y(1.0, n, c.a_z)
    if cross_section.axial_force_may_be_ignored_y(n, N_Ed, (1.0 - rho_z) * c.N_web):
        y = 1.0
    return y, cross_section.moment_resistance_with_axial_force_z(1.0, n, c.a_z)


def _plain_section(w: _Written, N_Ed: float, N_Rd: float, m_y: float, m_z: float, rho_z: float) -> float:
    n = _ratio(N_Ed, N_Rd)
    if not w.plastic:
        return cross_section.linear_interaction(n, m_y, m_z)
    return cross_section.plastic_interaction(w.section.kind, n, m_y, m_z, *_reduced(w, N_Ed, n, rho_z))


def _buckling(w: _Written, station: int) -> None:
    w.steel(stability=True)
    N_Ed = w.compression()
    w.area()
    c = w.member.constants
    axis = "y" if c.N_b_y_Rd <= c.N_b_z_Rd else "z"
    _, N_Rd = w.flexural(axis)
    w.use(N_Ed / N_Rd, f"N_Ed / N_b,{axis},Rd", "6.3.1.1(1), Eq. 6.46")


def _lateral_torsional(w: _Written, station: int) -> None:
    w.section_class()
    w.steel(stability=True)
    M_Ed, M_Rd = w.largest(M_Y), w.M_b_Rd()
    w.use(M_Ed / M_Rd, "M_y,Ed / M_b,Rd", "6.3.2.1(1), Eq. 6.54")


def _bending_and_compression(equation: int) -> Callable[[_Written, int], None]:
    def write(w: _Written, station: int) -> None:
        w.section_class()
        w.steel(stability=True)
        N_Ed, M_y, M_z = w.compression(), w.largest(M_Y), w.largest(M_Z)
        w.area()
        lambda_y, N_y = w.flexural("y")
        lambda_z, N_z = w.flexural("z")
        M_b = w.M_b_Rd()
        modulus = w.modulus("z")
        M_z_Rk = cross_section.moment_resistance(modulus, w.member.fy, w.member.gamma_M1)
        w.add("M_z,Rk / gamma_M1", M_z_Rk, "N*m", f"W_{w.theory},z f_y / gamma_M1", "6.3.3, Table 6.7")
        held = w.member.stability
        for symbol, value in (("C_my", held.C_my), ("C_mz", held.C_mz), ("C_mLT", held.C_mLT)):
            w.add(symbol, value, "1", "", "Annex B, Table B.3")
        n_y = w.add("n_y", N_Ed / N_y, "1", "N_Ed / (chi_y N_Rk / gamma_M1)")
        n_z = w.add("n_z", N_Ed / N_z, "1", "N_Ed / (chi_z N_Rk / gamma_M1)")
        m_y = w.add("m_y", M_y / M_b, "1", "M_y,Ed / (chi_LT M_y,Rk / gamma_M1)")
        m_z = w.add("m_z", M_z / M_z_Rk, "1", "M_z,Ed / (M_z,Rk / gamma_M1)")
        c = w.member.constants
        hollow = w.section.kind != "I"
        shape = (held.C_my, held.C_mz, held.C_mLT, lambda_y, lambda_z, n_y, n_z, w.plastic, hollow, c.twists)
        k = interaction.annex_b_factors(*shape)
        table = "Annex B, Table B.2" if c.twists else "Annex B, Table B.1"
        pair = ("yy", "yz") if equation == 61 else ("zy", "zz")
        k_y, k_z = (w.add(f"k_{of}", getattr(k, f"k_{of}"), "1", "", table) for of in pair)
        uses = interaction.member_interaction(k, n_y, n_z, m_y, m_z)
        axis, n, value = ("y", n_y, uses[0]) if equation == 61 else ("z", n_z, uses[1])
        symbols = f"n_{axis} + k_{pair[0]} m_y + k_{pair[1]} m_z"
        numbers = f"{n:.4g} + {k_y:.4g} x {m_y:.4g} + {k_z:.4g} x {m_z:.4g}"
        w.use(value, f"{symbols} = {numbers}", f"6.3.3(4), Eq. 6.{equation}")

    return write


def _beam_moment(w: _Written, station: int) -> None:
    w.section_class()
    w.steel()
    M_Ed, M_Rd = w.largest(M_Y), w.M_Rd("y")
    w.use(M_Ed / M_Rd, f"M_y,Ed / M_{w.theory},y,Rd", "EN 1998-1, 6.6.2(2), Eq. 6.2")


def _beam_axial(w: _Written, station: int) -> None:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    w.use(N_Ed / N_Rd / AXIAL_LIMIT, f"N_Ed / N_pl,Rd / {AXIAL_LIMIT}", "EN 1998-1, 6.6.2(2), Eq. 6.3")


def _beam_shear(w: _Written, station: int) -> None:
    w.steel()
    along = np.abs(w.forces.steady[:, V_Z])
    at = int(along.argmax())
    V_G = w.add("V_Ed,G", along[at], "N", f"of the non-seismic actions at x = {w.forces.stations[at]:.3g} L")
    V_M = w.add("V_Ed,M", w.member.V_M, "N", "(M_pl,A + M_pl,B) / L of its hinges", "EN 1998-1, Eq. 6.5")
    V_Rd = w.V_pl_Rd(V_Z)
    w.use(
        (V_G + V_M) / V_Rd / SHEAR_LIMIT,
        f"(V_Ed,G + V_Ed,M) / V_pl,z,Rd / {SHEAR_LIMIT}",
        "EN 1998-1, 6.6.2(2), Eq. 6.4",
    )


def _column_shear(w: _Written, station: int) -> None:
    w.steel()
    c, size = w.member.constants, w.forces.size
    of = V_Y if size[:, V_Y].max() / c.V_y_Rd > size[:, V_Z].max() / c.V_z_Rd else V_Z
    V_Ed, V_Rd = w.largest(of), w.V_pl_Rd(of)
    axis = "y" if of == V_Y else "z"
    expression = f"V_{axis},Ed / V_pl,{axis},Rd / {SHEAR_LIMIT}"
    w.use(V_Ed / V_Rd / SHEAR_LIMIT, expression, "EN 1998-1, 6.6.3(4), Eq. 6.7")


_CHECKS: dict[str, Callable[[_Written, int], None]] = {
    "N": _axial,
    "V_Y": _shear(V_Y),
    "V_Z": _shear(V_Z),
    "M_Y": _moment(M_Y),
    "M_Z": _moment(M_Z),
    "N_M": _section,
    "N_B": _buckling,
    "M_B": _lateral_torsional,
    "EQ_6_61": _bending_and_compression(61),
    "EQ_6_62": _bending_and_compression(62),
    "BEAM_M": _beam_moment,
    "BEAM_N": _beam_axial,
    "BEAM_V": _beam_shear,
    "COLUMN_V": _column_shear,
}
