"""A check of a member written out: from its section, its forces and its restraints to its utilisation.

The core computes the same utilisations for all members and combinations at once; that both agree is tested.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from edesign.building.steel_member import SteelMember
from edesign.codes.ec3 import cross_section
from edesign.codes.ec8.moment_frames import AXIAL_LIMIT, SHEAR_LIMIT
from edesign.space.checks.written_interaction import bending_and_compression
from edesign.space.checks.written_steps import M_Y, M_Z, V_Y, V_Z, Calculation, ForcesAlong, FreeBeam, N, Step


def written_check(
    member: SteelMember, forces: ForcesAlong, check: str, station: int, free_beam: FreeBeam | None = None
) -> tuple[Step, ...]:
    """Return the steps of a check, the utilisation last; none for a check that is not known here.

    Args:
        member: as its checks see it.
        forces: of the combination.
        check: its name, as in `MemberResults.checks`.
        station: number of the governing station; checks of the whole member take the largest forces along it.
        free_beam: of a beam that no slab holds; then M_b,Rd is that of its moment diagram.
    """
    writer = _CHECKS.get(check)
    if writer is None:
        return ()
    written = Calculation(member, forces, free_beam)
    writer(written, station)
    return tuple(written.steps)


def _axial(w: Calculation, station: int) -> None:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    w.use(N_Ed / N_Rd, "N_Ed / N_pl,Rd", "6.2.3(1), 6.2.4(1)")


def _shear(along: int) -> Callable[[Calculation, int], None]:
    def write(w: Calculation, station: int) -> None:
        w.steel()
        V_Ed, V_Rd = w.largest(along), w.V_Rd(along)
        axis = "y" if along == V_Y else "z"
        w.use(V_Ed / V_Rd, f"V_{axis},Ed / {w.shear_symbol(along)}", "6.2.6(1), Eq. 6.17")

    return write


def _moment(of: int) -> Callable[[Calculation, int], None]:
    axis = "y" if of == M_Y else "z"

    def write(w: Calculation, station: int) -> None:
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


def _reduction(w: Calculation, along: int, station: int) -> float:
    """Return rho of the shear at a station, written where it counts."""
    resistance = w.member.constants.V_y_Rd if along == V_Y else w.member.constants.V_z_Rd
    rho = cross_section.shear_reduction(float(w.forces.size[station, along]), resistance)
    if rho > 0.0:
        axis = "y" if along == V_Y else "z"
        w.force(along, station)
        w.V_Rd(along)
        w.add(f"rho_{axis}", rho, "1", f"(2 V_{axis},Ed / {w.shear_symbol(along)} - 1)^2 <= 1", "6.2.8(3)")
    return rho


def _with_shear(w: Calculation, axis: str, M_Rd: float, rho: float) -> tuple[float, str]:
    """M_V,Rd and its symbol."""
    of_area = w.member.constants.M_y_shear if axis == "y" else M_Rd
    across = "z" if axis == "y" else "y"
    value = cross_section.moment_resistance_with_shear(M_Rd, rho, of_area)
    expression = f"M_{axis},Rd - rho_{across} {of_area / 1e3:.4g} kN*m"
    return w.add(f"M_V,{axis},Rd", value, "N*m", expression, "6.2.8(3), (5)"), f"M_V,{axis},Rd"


def _ratio(load: float, resistance: float) -> float:
    return 0.0 if load <= 0.0 else load / resistance if resistance > 0.0 else math.inf


def _section(w: Calculation, station: int) -> None:
    """N-M of the section at a station; N takes the sign of the seismic action that gives more."""
    w.section_class()
    w.steel()
    N_Ed, M_y, M_z = (w.force(of, station) for of in (N, M_Y, M_Z))
    N_Rd, M_y_Rd, M_z_Rd = w.N_pl_Rd(), w.M_Rd("y"), w.M_Rd("z")
    rho_y, rho_z = _reduction(w, V_Y, station), _reduction(w, V_Z, station)
    c = w.member.constants
    if rho_y > 0.0 or rho_z > 0.0:
        value = cross_section.axial_resistance_with_shear(N_Rd, rho_y, c.V_y_Rd, rho_z, c.V_z_Rd)
        expression = f"N_pl,Rd - sqrt(3) (rho_y V_pl,y,Rd + rho_z {w.shear_symbol(V_Z)})"
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


def _reduced(w: Calculation, N_Ed: float, n: float, rho_z: float) -> tuple[float, float]:
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


def _plain_section(w: Calculation, N_Ed: float, N_Rd: float, m_y: float, m_z: float, rho_z: float) -> float:
    n = _ratio(N_Ed, N_Rd)
    if not w.plastic:
        return cross_section.linear_interaction(n, m_y, m_z)
    return cross_section.plastic_interaction(w.section.kind, n, m_y, m_z, *_reduced(w, N_Ed, n, rho_z))


def _buckling(w: Calculation, station: int) -> None:
    w.steel(stability=True)
    N_Ed = w.compression()
    w.area()
    c = w.member.constants
    axis = "y" if c.N_b_y_Rd <= c.N_b_z_Rd else "z"
    N_Rd = w.flexural(axis).N_b_Rd
    w.use(N_Ed / N_Rd, f"N_Ed / N_b,{axis},Rd", "6.3.1.1(1), Eq. 6.46")


def _lateral_torsional(w: Calculation, station: int) -> None:
    w.section_class()
    w.steel(stability=True)
    M_Ed, M_Rd = w.largest(M_Y), w.M_b_Rd()
    w.use(M_Ed / M_Rd, "M_y,Ed / M_b,Rd", "6.3.2.1(1), Eq. 6.54")


def _beam_moment(w: Calculation, station: int) -> None:
    w.section_class()
    w.steel()
    M_Ed, M_Rd = w.largest(M_Y), w.M_Rd("y")
    w.use(M_Ed / M_Rd, f"M_y,Ed / M_{w.theory},y,Rd", "EN 1998-1, 6.6.2(2), Eq. 6.2")


def _beam_axial(w: Calculation, station: int) -> None:
    w.steel()
    N_Ed, N_Rd = w.largest(N), w.N_pl_Rd()
    w.use(N_Ed / N_Rd / AXIAL_LIMIT, f"N_Ed / N_pl,Rd / {AXIAL_LIMIT}", "EN 1998-1, 6.6.2(2), Eq. 6.3")


def _beam_shear(w: Calculation, station: int) -> None:
    w.steel()
    along = np.abs(w.forces.steady[:, V_Z])
    at = int(along.argmax())
    V_G = w.add("V_Ed,G", along[at], "N", f"of the non-seismic actions at x = {w.forces.stations[at]:.3g} L")
    V_M = w.add("V_Ed,M", w.member.V_M, "N", "(M_pl,A + M_pl,B) / L of its hinges", "EN 1998-1, Eq. 6.5")
    V_Rd = w.V_Rd(V_Z)
    w.use(
        (V_G + V_M) / V_Rd / SHEAR_LIMIT,
        f"(V_Ed,G + V_Ed,M) / {w.shear_symbol(V_Z)} / {SHEAR_LIMIT}",
        "EN 1998-1, 6.6.2(2), Eq. 6.4",
    )


def _column_shear(w: Calculation, station: int) -> None:
    w.steel()
    c, size = w.member.constants, w.forces.size
    of = V_Y if size[:, V_Y].max() / c.V_y_Rd > size[:, V_Z].max() / c.V_z_Rd else V_Z
    V_Ed, V_Rd = w.largest(of), w.V_Rd(of)
    axis = "y" if of == V_Y else "z"
    expression = f"V_{axis},Ed / {w.shear_symbol(of)} / {SHEAR_LIMIT}"
    w.use(V_Ed / V_Rd / SHEAR_LIMIT, expression, "EN 1998-1, 6.6.3(4), Eq. 6.7")


_CHECKS: dict[str, Callable[[Calculation, int], None]] = {
    "N": _axial,
    "V_Y": _shear(V_Y),
    "V_Z": _shear(V_Z),
    "M_Y": _moment(M_Y),
    "M_Z": _moment(M_Z),
    "N_M": _section,
    "N_B": _buckling,
    "M_B": _lateral_torsional,
    "EQ_6_61": bending_and_compression(61),
    "EQ_6_62": bending_and_compression(62),
    "BEAM_M": _beam_moment,
    "BEAM_N": _beam_axial,
    "BEAM_V": _beam_shear,
    "COLUMN_V": _column_shear,
}
