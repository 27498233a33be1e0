"""Checks of a member by EN 1993-1-1 and EN 1998-1: from its forces under a combination to its utilisation.

`edesign.core.member_checks` computes the same for all members and combinations at once;
tests/unit/space/test_member_checks.py compares all branches.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3 import cross_section, interaction, lateral_torsional
from edesign.codes.ec3.buckling import Flexural
from edesign.codes.ec3.interaction import InteractionFactors
from edesign.codes.ec3.member import Member, Strength
from edesign.codes.ec8.steel.moment_frames import AXIAL_LIMIT, SHEAR_LIMIT
from edesign.codes.trace import Trace

N, V_Y, V_Z, _, M_Y, M_Z = range(6)
_SYMBOL = {N: "N_Ed", V_Y: "V_y,Ed", V_Z: "V_z,Ed", M_Y: "M_y,Ed", M_Z: "M_z,Ed"}
_AXIS = {V_Y: "y", V_Z: "z", M_Y: "y", M_Z: "z"}


@dataclass(frozen=True)
class ForcesAlong:
    """Internal forces N, V_y, V_z, T, M_y, M_z of a member under a combination; N is positive in tension.

    Attributes:
        stations: (n,) fractions of the length.
        steady: (n, 6) of the static actions, with sign, N and N m.
        alternating: (n, 6) magnitudes of the seismic action.
    """

    stations: np.ndarray
    steady: np.ndarray
    alternating: np.ndarray

    @property
    def size(self) -> np.ndarray:
        """Largest magnitudes, (n, 6) N and N m."""
        return np.asarray(np.abs(self.steady) + self.alternating)


@dataclass(frozen=True)
class FreeBeam:
    """A beam with lateral restraints at its ends alone.

    Attributes:
        length: between its ends, m.
        load: sum of P sin2(pi x / L) of the loads on its top flange in the combination, N, downwards.
        uniform: a uniform moment is taken for the diagram.
    """

    length: float
    load: float
    uniform: bool = False


def utilisation(
    member: Member,
    forces: ForcesAlong,
    check: str,
    station: int,
    free_beam: FreeBeam | None = None,
    trace: Trace | None = None,
) -> float | None:
    """Return the utilisation of a member in a check: 1 is the limit; None for a check that is not known here.

    Args:
        member: section, steel and restraints.
        check: its name: `N`, `V_Y`, `V_Z`, `M_Y`, `M_Z`, `N_M`, `N_B`, `M_B`, `EQ_6_61`, `EQ_6_62`, `BEAM_M`, `BEAM_N`,
            `BEAM_V` or `COLUMN_V`.
        station: number of the station of `M_Y`, `M_Z` and `N_M`; others take the largest forces along the member.
        free_beam: of a beam that no slab holds; then M_b,Rd is that of its moment diagram.
        trace: records the steps, the utilisation last.
    """
    of = _CHECKS.get(check)
    return None if of is None else of(_Check(member, forces, free_beam, trace), station)


class _Check(Strength):
    """Resistances and effects of a member under a combination."""

    def __init__(
        self, member: Member, forces: ForcesAlong, free_beam: FreeBeam | None = None, trace: Trace | None = None
    ) -> None:
        super().__init__(member, trace)
        self.forces, self.free_beam = forces, free_beam

    def use(self, value: float, expression: str, clause: str) -> float:
        return self.trace.add("utilisation", value, "1", expression, clause)

    def force(self, of: int, station: int) -> float:
        """Return the magnitude of a force at a station, N or N m."""
        steady, alternating = (float(part[station, of]) for part in (self.forces.steady, self.forces.alternating))
        expression = f"{_parts(steady, alternating, of)} {self._at(station)}"
        return self.trace.add(_SYMBOL[of], abs(steady) + alternating, _unit(of), expression)

    def largest(self, of: int) -> float:
        """Return the largest magnitude of a force along the member, N or N m."""
        return self.force(of, int(self.forces.size[:, of].argmax()))

    def compression(self) -> float:
        """Return the largest compression along the member, at least 0, N."""
        along = self.forces.alternating[:, N] - self.forces.steady[:, N]
        station = int(along.argmax())
        steady, alternating = float(self.forces.steady[station, N]), float(self.forces.alternating[station, N])
        expression = f"compression, {_parts(steady, alternating, N)} {self._at(station)}"
        return self.trace.add("N_Ed", max(alternating - steady, 0.0), "N", expression)

    def _at(self, station: int) -> str:
        return f"at x = {self.forces.stations[station]:.3g} L"

    def shear_reduction(self, along: int, station: int) -> float:
        """Return rho of the shear at a station, recorded where it counts."""
        axis = _AXIS[along]
        V_Rd = self.quiet.V_Rd(axis)
        rho = cross_section.shear_reduction(float(self.forces.size[station, along]), V_Rd)
        if rho > 0.0:
            self.force(along, station)
            self.V_Rd(axis)
            expression = f"(2 V_{axis},Ed / {self.shear_symbol(axis)} - 1)^2 <= 1"
            self.trace.add(f"rho_{axis}", rho, "1", expression, "6.2.8(3)")
        return rho

    def M_V_Rd(self, axis: str, M_Rd: float, rho: float) -> float:
        """Return the resistance to bending that shear leaves, N m."""
        of_area, across = self.M_of_shear_area(axis), "z" if axis == "y" else "y"
        value = cross_section.moment_resistance_with_shear(M_Rd, rho, of_area)
        expression = f"M_{axis},Rd - rho_{across} {of_area / 1e3:.4g} kN*m"
        return self.trace.add(f"M_V,{axis},Rd", value, "N*m", expression, "6.2.8(3), (5)")

    def M_b(self) -> float:
        """Return M_b,Rd, N m; of a free beam by its moment diagram."""
        return self.M_b_Rd(None if self.free_beam is None else self._M_cr_of_diagram)

    def _M_cr_of_diagram(self, _: Strength) -> tuple[float, float]:
        """Return M_cr, N m, and C_1 by the moment diagram of the combination, with loads on the top flange."""
        assert self.free_beam is not None
        s, member, beam, trace = self.section, self.member, self.free_beam, self.trace
        length = trace.add("L_LT", beam.length, "m", "between restraints of the compressed flange")
        self.torsion()
        M_y = self.largest(M_Y)
        steady, alternating = self.forces.steady[:, M_Y], self.forces.alternating[:, M_Y]
        if beam.uniform:
            C1 = trace.add("C_1", 1.0, "1", "uniform moment: braces that meet the beam do not hold it sideways")
        else:
            M_A, M_B, M_C = (float(M) for M in lateral_torsional.quarter_moments(steady, alternating))
            trace.add("M_A", M_A, "N*m", f"{_at_quarter(steady, alternating)}, of x = L/6, L/3, L/2")
            trace.add("M_B", M_B, "N*m", f"{_parts(float(steady[3]), float(alternating[3]), M_Y)} at x = L/2")
            trace.add("M_C", M_C, "N*m", f"{_at_quarter(steady[::-1], alternating[::-1])}, of x = 5L/6, 2L/3, L/2")
            root = "sqrt(35 M_y,Ed^2 / (M_y,Ed^2 + 9 M_A^2 + 16 M_B^2 + 9 M_C^2))"
            C1 = float(lateral_torsional.diagram_factor(M_y, M_A, M_B, M_C))
            trace.add("C_1", C1, "1", root if M_y > 0.0 else "without moment", "Serna et al. 2006")
        z_g = trace.add("z_g", 0.5 * s.h, "m", "h / 2: loads on the top flange")
        expression = "sum of P_i sin^2(pi x_i / L_LT) of the loads on the beam, downwards, >= 0"
        load = trace.add("P", max(beam.load, 0.0), "N", expression)
        C2_z_g = C1 * length * load * z_g / (math.pi**2 * M_y) if M_y > 0.0 else 0.0
        expression = "C_1 L_LT P z_g / (pi^2 M_y,Ed)" if M_y > 0.0 else "without moment"
        trace.add("C_2 z_g", C2_z_g, "m", expression, "energy of one half-wave")
        of = member.E, member.G, s.I_z, s.I_t, s.I_w, length
        critical = lateral_torsional.critical_moment(*of, C1, 1.0, C2_z_g)
        root = "sqrt(I_w / I_z + L_LT^2 G I_t / (pi^2 E I_z) + (C_2 z_g)^2)"
        expression = f"C_1 pi^2 E I_z / L_LT^2 ({root} - C_2 z_g)"
        return trace.add("M_cr", critical, "N*m", expression, "SN003, Eq. 1"), C1


# ---- the section, 6.2 -----------------------------------------------------------------------------------------------


def _axial(w: _Check, station: int) -> float:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    return w.use(N_Ed / N_Rd, "N_Ed / N_pl,Rd", "6.2.3(1), 6.2.4(1)")


def _shear(along: int) -> Callable[[_Check, int], float]:
    axis = _AXIS[along]

    def check(w: _Check, station: int) -> float:
        w.steel()
        V_Ed, V_Rd = w.largest(along), w.V_Rd(axis)
        return w.use(V_Ed / V_Rd, f"V_{axis},Ed / {w.shear_symbol(axis)}", "6.2.6(1), Eq. 6.17")

    return check


def _moment(of: int, across: int) -> Callable[[_Check, int], float]:
    axis = _AXIS[of]

    def check(w: _Check, station: int) -> float:
        w.section_class()
        w.steel()
        M_Ed = w.force(of, station)
        M_Rd, symbol = w.M_Rd(axis), f"M_{w.member.theory},{axis},Rd"
        rho = w.shear_reduction(across, station)
        if rho > 0.0:
            M_Rd, symbol = w.M_V_Rd(axis, M_Rd, rho), f"M_V,{axis},Rd"
        return w.use(_ratio(M_Ed, M_Rd), f"M_{axis},Ed / {symbol}", "6.2.5(1), Eq. 6.12")

    return check


def _section(w: _Check, station: int) -> float:
    """N-M of the section at a station; N takes the sign of the seismic action that gives more."""
    w.section_class()
    w.steel()
    N_Ed, M_y, M_z = (w.force(of, station) for of in (N, M_Y, M_Z))
    N_Rd, M_y_Rd, M_z_Rd = w.N_pl_Rd(), w.M_Rd("y"), w.M_Rd("z")
    rho_y, rho_z = w.shear_reduction(V_Y, station), w.shear_reduction(V_Z, station)
    if rho_y > 0.0 or rho_z > 0.0:
        V_Rd = w.quiet.V_Rd("y"), w.quiet.V_Rd("z")
        value = cross_section.axial_resistance_with_shear(N_Rd, rho_y, V_Rd[0], rho_z, V_Rd[1])
        expression = f"N_pl,Rd - sqrt(3) (rho_y V_pl,y,Rd + rho_z {w.shear_symbol('z')})"
        N_Rd = w.trace.add("N_V,Rd", value, "N", expression, "6.2.10(3), Eq. 6.45")
    if rho_z > 0.0:
        M_y_Rd = w.M_V_Rd("y", M_y_Rd, rho_z)
    if rho_y > 0.0:
        M_z_Rd = w.M_V_Rd("z", M_z_Rd, rho_y)
    m_y, m_z = _ratio(M_y, M_y_Rd), _ratio(M_z, M_z_Rd)

    def interaction_of(N_Ed: float) -> tuple[float, float, tuple[float, float]]:
        n = _ratio(N_Ed, N_Rd)
        if not w.member.plastic:
            return cross_section.linear_interaction(n, m_y, m_z), n, (1.0, 1.0)
        shares = w.reduced_by_axial_force(N_Ed, n, rho_z)
        return cross_section.plastic_interaction(w.section.kind, n, m_y, m_z, *shares), n, shares

    value, n, shares = interaction_of(N_Ed)
    steady, alternating = float(w.forces.steady[station, N]), float(w.forces.alternating[station, N])
    other = abs(abs(steady) - alternating)
    if alternating > 0.0 and interaction_of(other)[0] > value:
        w.trace.add("N_Ed", other, "N", "with the other sign of the seismic action, which gives more")
        value, n, shares = interaction_of(other)
    w.trace.add("n", n, "1", "N_Ed / N_Rd", "6.2.9.1(5)")
    w.trace.add("m_y", m_y, "1", "M_y,Ed / M_y,Rd")
    w.trace.add("m_z", m_z, "1", "M_z,Ed / M_z,Rd")
    if not w.member.plastic or value == cross_section.linear_interaction(n, m_y, m_z):
        clause = "6.2.1(7), Eq. 6.2" if w.member.plastic else "6.2.9.2(1), Eq. 6.42"
        return w.use(value, f"n + m_y + m_z = {n:.4g} + {m_y:.4g} + {m_z:.4g}", clause)
    for axis, share in zip("yz", shares, strict=True):
        w.trace.add(f"M_N,{axis},Rd / M_{axis},Rd", share, "1", "", "6.2.9.1(4), (5)")
    alpha, beta = cross_section.biaxial_exponents(w.section.kind, n)
    about_y, about_z = _ratio(m_y, shares[0]), _ratio(m_z, shares[1])
    if value == max(about_y, about_z):
        axis = "y" if about_y >= about_z else "z"
        return w.use(value, f"M_{axis},Ed / M_N,{axis},Rd", "6.2.9.1(2), Eq. 6.31")
    return w.use(value, f"{about_y:.4g}^{alpha:.3g} + {about_z:.4g}^{beta:.3g}", "6.2.9.1(6), Eq. 6.41")


# ---- the member, 6.3 ------------------------------------------------------------------------------------------------


def _buckling(w: _Check, station: int) -> float:
    w.steel(stability=True)
    N_Ed = w.compression()
    w.area()
    axis = "y" if w.quiet.flexural("y").N_b_Rd <= w.quiet.flexural("z").N_b_Rd else "z"
    N_Rd = w.flexural(axis).N_b_Rd
    return w.use(N_Ed / N_Rd, f"N_Ed / N_b,{axis},Rd", "6.3.1.1(1), Eq. 6.46")


def _lateral_torsional(w: _Check, station: int) -> float:
    w.section_class()
    w.steel(stability=True)
    M_Ed, M_Rd = w.largest(M_Y), w.M_b()
    return w.use(M_Ed / M_Rd, "M_y,Ed / M_b,Rd", "6.3.2.1(1), Eq. 6.54")


def _bending_and_compression(equation: int) -> Callable[[_Check, int], float]:
    """Return the check of Eq. 6.61 or 6.62."""
    pair = ("yy", "yz") if equation == 61 else ("zy", "zz")

    def check(w: _Check, station: int) -> float:
        w.section_class()
        w.steel(stability=True)
        N_Ed, M_y, M_z = w.compression(), w.largest(M_Y), w.largest(M_Z)
        w.area()
        y, z, M_b = w.flexural("y"), w.flexural("z"), w.M_b()
        M_z_Rk = cross_section.moment_resistance(w.modulus("z"), w.member.fy, w.member.gamma_M1)
        expression = f"W_{w.member.theory},z f_y / gamma_M1"
        w.trace.add("M_z,Rk / gamma_M1", M_z_Rk, "N*m", expression, "6.3.3, Table 6.7")
        n_y = w.trace.add("n_y", N_Ed / y.N_b_Rd, "1", "N_Ed / (chi_y N_Rk / gamma_M1)")
        n_z = w.trace.add("n_z", N_Ed / z.N_b_Rd, "1", "N_Ed / (chi_z N_Rk / gamma_M1)")
        m_y = w.trace.add("m_y", M_y / M_b, "1", "M_y,Ed / (chi_LT M_y,Rk / gamma_M1)")
        m_z = w.trace.add("m_z", M_z / M_z_Rk, "1", "M_z,Ed / (M_z,Rk / gamma_M1)")
        if w.member.annex_a:
            k = _annex_a(w, y, z, (N_Ed, M_y, m_y, m_z), pair)
        else:
            k = _annex_b(w, y, z, n_y, n_z, pair)
        axis, n = ("y", n_y) if equation == 61 else ("z", n_z)
        uses = interaction.member_interaction(k, n_y, n_z, m_y, m_z)
        symbols = f"n_{axis} + k_{pair[0]} m_y + k_{pair[1]} m_z"
        k_y, k_z = (getattr(k, f"k_{index}") for index in pair)
        numbers = f"{n:.4g} + {k_y:.4g} x {m_y:.4g} + {k_z:.4g} x {m_z:.4g}"
        return w.use(uses[0 if equation == 61 else 1], f"{symbols} = {numbers}", f"6.3.3(4), Eq. 6.{equation}")

    return check


def _annex_b(w: _Check, y: Flexural, z: Flexural, n_y: float, n_z: float, pair: tuple[str, str]) -> InteractionFactors:
    stability = w.member.stability
    for symbol in ("C_my", "C_mz", "C_mLT"):
        w.trace.add(symbol, getattr(stability, symbol), "1", "", "Annex B, Table B.3")
    slender, kind = (y.slenderness, z.slenderness), (w.member.plastic, w.section.kind != "I", w.member.twists)
    return interaction.annex_b_factors(
        stability.C_my, stability.C_mz, stability.C_mLT, *slender, n_y, n_z, *kind, trace=w.trace, recorded=pair
    )


def _annex_a(
    w: _Check, y: Flexural, z: Flexural, effects: tuple[float, float, float, float], pair: tuple[str, str]
) -> InteractionFactors:
    s, stability, N_cr_T, N_Ed = w.section, w.member.stability, w.N_cr_T(), effects[0]
    for axis, N_cr in (("y", y.N_cr), ("z", z.N_cr), ("T", N_cr_T)):
        why = "" if N_cr < math.inf else "hollow section" if axis == "T" and s.kind != "I" else "restrained all along"
        if w.trace.add(f"N_Ed / N_cr,{axis}", N_Ed / N_cr, "1", why) >= 1.0:
            return interaction.beyond_critical(axis, *effects[2:], w.trace, pair)
    lambda_0, C_m_0 = w.lambda_0(), []
    for axis, C_m, slope, by in (
        ("y", stability.C_my, stability.C_my_N, N_Ed / y.N_cr),
        ("z", stability.C_mz, stability.C_mz_N, N_Ed / z.N_cr),
    ):
        expression = f"{C_m:.4g} {'-' if slope < 0.0 else '+'} {abs(slope):.4g} N_Ed / N_cr,{axis}"
        C_m_0.append(w.trace.add(f"C_m{axis},0", C_m + slope * by, "1", expression, "Annex A, Table A.2"))
    N_Rk = cross_section.axial_resistance(s.A, w.member.fy, w.member.gamma_M1)
    of = s, y, z, N_cr_T, lambda_0, stability.C1, N_Rk
    return interaction.annex_a_factors(*of, *effects, C_m_0[0], C_m_0[1], w.member.plastic, w.trace, pair)


# ---- frames that dissipate energy, EN 1998-1, 6.6 -------------------------------------------------------------------


def _beam_moment(w: _Check, station: int) -> float:
    w.section_class()
    w.steel()
    M_Ed, M_Rd = w.largest(M_Y), w.M_Rd("y")
    return w.use(M_Ed / M_Rd, f"M_y,Ed / M_{w.member.theory},y,Rd", "EN 1998-1, 6.6.2(2), Eq. 6.2")


def _beam_axial(w: _Check, station: int) -> float:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    return w.use(N_Ed / N_Rd / AXIAL_LIMIT, f"N_Ed / N_pl,Rd / {AXIAL_LIMIT}", "EN 1998-1, 6.6.2(2), Eq. 6.3")


def _beam_shear(w: _Check, station: int) -> float:
    w.steel()
    along = np.abs(w.forces.steady[:, V_Z])
    at = int(along.argmax())
    V_G = w.trace.add("V_Ed,G", along[at], "N", f"of the non-seismic actions at x = {w.forces.stations[at]:.3g} L")
    V_M = w.trace.add(
        "V_Ed,M", w.member.V_M, "N", "(M_pl,A + M_pl,B) / L of its hinges", "EN 1998-1, 6.6.2(2), Eq. 6.5"
    )
    V_Rd = w.V_Rd("z")
    expression = f"(V_Ed,G + V_Ed,M) / {w.shear_symbol('z')} / {SHEAR_LIMIT}"
    return w.use((V_G + V_M) / V_Rd / SHEAR_LIMIT, expression, "EN 1998-1, 6.6.2(2), Eq. 6.4")


def _column_shear(w: _Check, station: int) -> float:
    w.steel()
    size = w.forces.size
    of = V_Y if size[:, V_Y].max() / w.quiet.V_Rd("y") > size[:, V_Z].max() / w.quiet.V_Rd("z") else V_Z
    V_Ed, V_Rd = w.largest(of), w.V_Rd(_AXIS[of])
    expression = f"V_{_AXIS[of]},Ed / {w.shear_symbol(_AXIS[of])} / {SHEAR_LIMIT}"
    return w.use(V_Ed / V_Rd / SHEAR_LIMIT, expression, "EN 1998-1, 6.6.3(4), Eq. 6.7")


_CHECKS: dict[str, Callable[[_Check, int], float]] = {
    "N": _axial,
    "V_Y": _shear(V_Y),
    "V_Z": _shear(V_Z),
    "M_Y": _moment(M_Y, V_Z),
    "M_Z": _moment(M_Z, V_Y),
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


def _ratio(load: float, resistance: float) -> float:
    return 0.0 if load <= 0.0 else load / resistance if resistance > 0.0 else math.inf


def _at_quarter(steady: np.ndarray, alternating: np.ndarray) -> str:
    """The moment at the first quarter, from those at sixths, as `quarter_moments` has it; in kN m."""
    a, b, c = (_digits(M / 1e3) if M >= 0.0 else f"({_digits(M / 1e3)})" for M in steady[1:4].tolist())
    text = f"|3 x {a} + 6 x {b} - {c}| / 8"
    if alternating.any():
        text += f" + ({' + '.join(_digits(M / 1e3) for M in alternating[1:3].tolist())}) / 2"
    return f"{text} kN*m"


def _parts(steady: float, alternating: float, of: int) -> str:
    unit = "kN" if of < M_Y else "kN*m"
    if alternating == 0.0:
        return f"{_digits(steady / 1e3)} {unit}"
    return f"{_digits(steady / 1e3)} +- {_digits(alternating / 1e3)} {unit}"


def _digits(value: float) -> str:
    if value == 0.0:
        return "0"
    return f"{value:#.4g}".rstrip(".") if abs(value) < 1e4 else f"{value:.0f}"


def _unit(of: int) -> str:
    return "N" if of < M_Y else "N*m"
