"""Resistance of cross-sections, EN 1993-1-1:2005, 6.2.3 to 6.2.10.

M is a moment resistance and N, V forces; resistances are magnitudes. Class 1 and 2 sections count with plastic, class 3
sections with elastic moduli; class 4 is not in it.
"""

from __future__ import annotations

import math

from edesign.codes.ec3.classes import epsilon
from edesign.codes.ec3.section import Shape

GAMMA_M0 = 1.0
"""Partial factor of cross-sections. Source: EN 1993-1-1:2005, 6.1(1), recommended."""


def axial_resistance(area: float, yield_stress: float, gamma_M0: float = GAMMA_M0) -> float:
    """Return N_pl,Rd = A f_y / gamma_M0, N, in tension of the gross section and in compression.

    Args:
        area: A, m2.
        yield_stress: f_y, Pa.
        gamma_M0: partial factor.

    Source: EN 1993-1-1:2005, 6.2.3(2)a, Eq. 6.6, and 6.2.4(2), Eq. 6.10.
    """
    return area * yield_stress / gamma_M0


def moment_resistance(modulus: float, yield_stress: float, gamma_M0: float = GAMMA_M0) -> float:
    """Return M_c,Rd = W f_y / gamma_M0, N m.

    Args:
        modulus: W_pl of class 1 and 2, W_el of class 3, m3.
        yield_stress: f_y, Pa.
        gamma_M0: partial factor.

    Source: EN 1993-1-1:2005, 6.2.5(2), Eqs. 6.13 and 6.14.
    """
    return modulus * yield_stress / gamma_M0


def shear_resistance(shear_area: float, yield_stress: float, gamma_M0: float = GAMMA_M0) -> float:
    """Return V_pl,Rd = A_v f_y / (sqrt(3) gamma_M0), N.

    Args:
        shear_area: A_v, m2.
        yield_stress: f_y, Pa.
        gamma_M0: partial factor.

    Source: EN 1993-1-1:2005, 6.2.6(2), Eq. 6.18.
    """
    return shear_area * yield_stress / (math.sqrt(3.0) * gamma_M0)


def web_is_slender(web_height: float, web_thickness: float, yield_stress: float) -> bool:
    """Return whether h_w / t_w > 72 epsilon / eta with eta = 1, so that shear may buckle the web.

    Args:
        web_height: h_w, between the flanges, m.
        web_thickness: t_w, m.
        yield_stress: f_y, Pa.

    Source: EN 1993-1-1:2005, 6.2.6(6), Eq. 6.22.
    """
    return web_height / web_thickness > 72.0 * epsilon(yield_stress)


def web_slenderness(web_height: float, web_thickness: float, yield_stress: float) -> float:
    """Return lambda_w = h_w / (86.4 t_w epsilon) of a web with stiffeners at the supports alone.

    Args:
        web_height: h_w, between the flanges, m.
        web_thickness: t_w, m.
        yield_stress: f_y, Pa.

    Returns:
        lambda_w, dimensionless.

    Source: EN 1993-1-5:2006, 5.3(3)a, Eq. 5.5.
    """
    return web_height / (86.4 * web_thickness * epsilon(yield_stress))


def shear_buckling_factor(slenderness: float) -> float:
    """Return chi_w = 0.83 / lambda_w <= 1 of a web with end posts that are not rigid, eta = 1.

    Args:
        slenderness: lambda_w.

    Source: EN 1993-1-5:2006, 5.3(1), Table 5.1.
    """
    return min(0.83 / slenderness, 1.0)


def shear_buckling_resistance(web_height: float, web_thickness: float, yield_stress: float, gamma_M1: float) -> float:
    """Return V_bw,Rd = chi_w f_y h_w t_w / (sqrt(3) gamma_M1), N; infinite where the web is not slender.

    What the flanges add (5.4) is left out, which is on the safe side.

    Args:
        web_height: h_w, between the flanges, m.
        web_thickness: t_w, m.
        yield_stress: f_y, Pa.
        gamma_M1: partial factor of stability.

    Source: EN 1993-1-5:2006, 5.2(1), Eq. 5.2.
    """
    if not web_is_slender(web_height, web_thickness, yield_stress):
        return math.inf
    chi = shear_buckling_factor(web_slenderness(web_height, web_thickness, yield_stress))
    return chi * shear_resistance(web_height * web_thickness, yield_stress, gamma_M1)


def shear_reduction(V_Ed: float, V_pl_Rd: float) -> float:
    """Return rho = (2 V_Ed / V_pl,Rd - 1)2 <= 1, and 0 up to half the plastic shear resistance.

    Args:
        V_Ed: N, of any sign.
        V_pl_Rd: plastic resistance to shear, N.

    Source: EN 1993-1-1:2005, 6.2.8(2) and (3).
    """
    ratio = abs(V_Ed) / V_pl_Rd
    return min((2.0 * ratio - 1.0) ** 2, 1.0) if ratio > 0.5 else 0.0


def moment_of_shear_area(
    web_height: float, web_thickness: float, yield_stress: float, gamma_M0: float = GAMMA_M0
) -> float:
    """Return A_w2 f_y / (4 t_w gamma_M0), N m: what the webs carry of the plastic moment about the strong axis.

    Args:
        web_height: h_w, between the flanges, m.
        web_thickness: t_w, of all webs together, m.
        yield_stress: f_y, Pa.
        gamma_M0: partial factor.

    Source: EN 1993-1-1:2005, 6.2.8(5), Eq. 6.30.
    """
    return web_height**2 * web_thickness * yield_stress / (4.0 * gamma_M0)


def moment_resistance_with_shear(M_c_Rd: float, rho: float, M_of_shear_area: float) -> float:
    """Return M_V,Rd = M_c,Rd - rho M of the shear area, N m: f_y of the shear area is reduced by 1 - rho.

    Args:
        M_c_Rd: without shear, N m.
        rho: by `shear_reduction`.
        M_of_shear_area: by `moment_of_shear_area` for class 1 and 2 sections about the strong axis; elsewhere M_c,Rd,
            as if all of it were carried by the shear area, which is on the safe side.

    Source: EN 1993-1-1:2005, 6.2.8(3), Eq. 6.29, and (5), Eq. 6.30.
    """
    return M_c_Rd - rho * M_of_shear_area


def axial_resistance_with_shear(
    N_pl_Rd: float, rho_y: float, V_pl_y_Rd: float, rho_z: float, V_pl_z_Rd: float
) -> float:
    """Return N_V,Rd, N: A f_y, in which f_y of both shear areas is reduced by 1 - rho; at least 0.

    Args:
        N_pl_Rd: without shear, N.
        rho_y: reduction by the shear along y, 0 to 1, by `shear_reduction`.
        V_pl_y_Rd: resistance to shear along y, N.
        rho_z: reduction by the shear along z, 0 to 1.
        V_pl_z_Rd: resistance to shear along z, N.

    Source: EN 1993-1-1:2005, 6.2.10(3), Eq. 6.45.
    """
    return max(N_pl_Rd - math.sqrt(3.0) * (rho_y * V_pl_y_Rd + rho_z * V_pl_z_Rd), 0.0)


def web_share(area: float, flanges: float) -> float:
    """Return a = (A - flanges) / A <= 0.5, of an I section with flanges 2 b t_f, of a hollow one 2 b t or 2 h t.

    Args:
        area: A, m2.
        flanges: area of the flanges, m2.

    Source: EN 1993-1-1:2005, 6.2.9.1(5), Eqs. 6.36 to 6.40.
    """
    return min((area - flanges) / area, 0.5)


def axial_force_may_be_ignored_y(n: float, N_Ed: float, N_web: float) -> bool:
    """Return whether N leaves the plastic moment of an I section about y as it is.

    Args:
        n: N_Ed / N_pl,Rd.
        N_Ed: magnitude, N.
        N_web: h_w t_w f_y / gamma_M0, N.

    Source: EN 1993-1-1:2005, 6.2.9.1(4), Eqs. 6.33 and 6.34.
    """
    return n <= 0.25 and N_Ed <= 0.5 * N_web


def moment_resistance_with_axial_force_y(M_Rd: float, n: float, a: float) -> float:
    """Return M_N,Rd = M_Rd (1 - n) / (1 - 0.5 a) <= M_Rd, N m, about y of I sections and either axis of an RHS.

    Args:
        M_Rd: plastic, reduced by shear if need be, N m.
        n: N_Ed / N_pl,Rd, magnitude.
        a: by `web_share`.

    Returns:
        0 from n = 1 on.

    Source: EN 1993-1-1:2005, 6.2.9.1(5), Eqs. 6.36, 6.39 and 6.40.
    """
    return M_Rd * min(max(1.0 - n, 0.0) / (1.0 - 0.5 * a), 1.0)


def moment_resistance_with_axial_force_z(M_Rd: float, n: float, a: float) -> float:
    """Return M_N,z,Rd, N m, of an I section: M_Rd up to n = a, then M_Rd [1 - ((n - a) / (1 - a))2].

    Args:
        M_Rd: plastic, reduced by shear if need be, N m.
        n: N_Ed / N_pl,Rd, magnitude.
        a: share of the web in the area, by `web_share`.

    Source: EN 1993-1-1:2005, 6.2.9.1(5), Eqs. 6.37 and 6.38.
    """
    if n <= a:
        return M_Rd
    return M_Rd * max(1.0 - ((n - a) / (1.0 - a)) ** 2, 0.0)


def moment_resistance_with_axial_force_round(M_Rd: float, n: float) -> float:
    """Return M_N,Rd = M_Rd (1 - n^1.7), N m, of a circular hollow section.

    Args:
        M_Rd: plastic, reduced by shear if need be, N m.
        n: N_Ed / N_pl,Rd, magnitude.

    Source: EN 1993-1-1:2005/AC:2009, 6.2.9.1(5).
    """
    return M_Rd * max(1.0 - math.pow(n, 1.7), 0.0)


def biaxial_exponents(shape: Shape, n: float) -> tuple[float, float]:
    """Return alpha and beta of the biaxial criterion.

    Args:
        shape: I, RHS or CHS.
        n: N_Ed / N_pl,Rd, magnitude.

    Returns:
        alpha and beta.

    Source: EN 1993-1-1:2005, 6.2.9.1(6), Eq. 6.41.
    """
    if shape == "CHS":
        return 2.0, 2.0
    if shape == "I":
        return 2.0, max(5.0 * n, 1.0)
    below = 1.0 - 1.13 * n**2
    exponent = min(1.66 / below, 6.0) if below > 0.0 else 6.0
    return exponent, exponent


def linear_interaction(n: float, m_y: float, m_z: float) -> float:
    """Return N_Ed/N_Rd + M_y,Ed/M_y,Rd + M_z,Ed/M_z,Rd: for class 3 the stress by f_y, for class 1 and 2 a safe check.

    Args:
        n: N_Ed / N_Rd, magnitude.
        m_y: M_y,Ed / M_y,Rd, magnitude.
        m_z: M_z,Ed / M_z,Rd, magnitude.

    Returns:
        The sum of the ratios.

    Source: EN 1993-1-1:2005, 6.2.1(7), Eq. 6.2, and 6.2.9.2(1), Eq. 6.42.
    """
    return n + m_y + m_z


def plastic_interaction(shape: Shape, n: float, m_y: float, m_z: float, reduced_y: float, reduced_z: float) -> float:
    """Return the utilisation of a class 1 or 2 section in bending and axial force.

    It is the least that the clauses ask for: the larger of M_y/M_N,y, M_z/M_N,z and the sum of their powers, or the
    linear sum, which is enough too and stays finite up to N_pl,Rd.

    Args:
        shape: I, RHS or CHS.
        n: N_Ed / N_pl,Rd, magnitude.
        m_y: M_y,Ed / M_y,Rd, magnitude.
        m_z: M_z,Ed / M_z,Rd, magnitude.
        reduced_y: M_N,y,Rd / M_y,Rd, 0 to 1.
        reduced_z: M_N,z,Rd / M_z,Rd, 0 to 1.

    Returns:
        The utilisation; at most 1 is safe.

    Source: EN 1993-1-1:2005, 6.2.9.1(2), Eq. 6.31, (6), Eq. 6.41, and 6.2.1(7), Eq. 6.2.
    """
    linear = linear_interaction(n, m_y, m_z)
    if n >= 1.0 or (m_y > 0.0 and reduced_y <= 0.0) or (m_z > 0.0 and reduced_z <= 0.0):
        return linear
    about_y = m_y / reduced_y if m_y > 0.0 else 0.0
    about_z = m_z / reduced_z if m_z > 0.0 else 0.0
    alpha, beta = biaxial_exponents(shape, n)
    return min(max(about_y, about_z, math.pow(about_y, alpha) + math.pow(about_z, beta)), linear)
