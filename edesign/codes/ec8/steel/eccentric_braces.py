"""Frames with eccentric bracings of steel, EN 1998-1:2004, 6.8; NTC 2018, 7.5.6, has the same equations.

The links yield, in shear or in bending. Columns, braces and the beams beside links take the amplified effects of
`capacity`, with the least overstrength of all links.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt
from typing import Literal

from edesign.codes.quantities import check_not_negative, check_positive
from edesign.errors import InputError

Category = Literal["short", "intermediate", "long"]

HARDENING = 1.5
"""Of a link that has yielded, over its plastic resistance. Source: EN 1998-1:2004, 6.8.3(1); NTC 2018, 7.5.6."""
SMALL_AXIAL = 0.15
"""N_Ed / N_pl,Rd up to which it does not count. Source: EN 1998-1:2004, 6.8.2(4)-(6); NTC 2018, 7.5.6."""
SHORT, LONG = 0.8, 1.5
"""e_s and e_L over (1 + alpha) M_p / V_p. Source: EN 1998-1:2004, 6.8.2(8)-(9); NTC 2018, Eqs. 7.5.16."""
ROTATIONS = (0.08, 0.02)
"""Largest rotations of short and of long links, rad. Source: EN 1998-1:2004, 6.8.2(10); NTC 2018, 7.5.6."""
HOMOGENEITY = 0.25
"""(max Omega_i - Omega) / Omega. Source: EN 1998-1:2004, 6.8.2(7); NTC 2018, 7.5.6."""
_SMALL_R = 0.3  # 6.8.2(6)
_NO_STIFFENERS = 5.0  # e over M_p / V_p, 6.8.2(12) d
_ONE_SIDED_BELOW = 0.6  # m, depth of the link, 6.8.2(12) e
_LEAST_THICKNESS = 0.01  # m


@dataclass(frozen=True)
class LinkResistance:
    """The plastic resistances of a link.

    Attributes:
        M_p: M_p,link, of the flanges alone, N m.
        V_p: V_p,link, of the web alone, N.
        N_pl: N_pl,Rd, N.
    """

    M_p: float
    V_p: float
    N_pl: float

    def reduced(self, N_Ed: float) -> LinkResistance:
        """Return the resistances beside an axial force; above 0.15 N_pl,Rd they are less.

        Args:
            N_Ed: N, any sign.

        Source: EN 1998-1:2004, 6.8.2(5), Eqs. 6.17 and 6.18; NTC 2018, Eqs. 7.5.21 and 7.5.22.
        """
        n = min(abs(N_Ed) / self.N_pl, 1.0)
        if n <= SMALL_AXIAL:
            return self
        return LinkResistance(self.M_p * (1.0 - n), self.V_p * sqrt(1.0 - n**2), self.N_pl)

    def limits(self, alpha: float) -> tuple[float, float]:
        """Return e_s, up to which a link is short, and e_L, from which it is long, m.

        Args:
            alpha: the smaller over the greater of the moments at its ends in the seismic design situation, without
                sign; 1 of links with equal moments.

        Source: EN 1998-1:2004, 6.8.2(8)-(9), Eqs. 6.21 to 6.26; NTC 2018, Eqs. 7.5.16a to 7.5.16c.
        """
        if not 0.0 <= alpha <= 1.0:
            raise InputError(f"alpha lies between 0 and 1, not {alpha:g} [E-VALUE-02]")
        each = (1.0 + alpha) * self.M_p / self.V_p
        return SHORT * each, LONG * each

    def category(self, e: float, alpha: float) -> Category:
        """Return whether a link is short, intermediate or long.

        Args:
            e: its length, m.
            alpha: see `limits`.
        """
        e_s, e_L = self.limits(alpha)
        return "short" if e <= e_s else "long" if e >= e_L else "intermediate"


def link_resistance(f_y: float, A: float, b: float, t_f: float, t_w: float, d: float) -> LinkResistance:
    """Return the plastic resistances of a link of I section.

    Args:
        f_y: yield strength, Pa.
        A: area, m2.
        b: width of the flanges, m.
        t_f: thickness of the flanges, m.
        t_w: thickness of the web, m.
        d: depth of the section, m.

    Raises:
        InputError: a number is not greater than zero, or the flanges are thicker than the section is deep.

    Source: EN 1998-1:2004, 6.8.2(3), Eqs. 6.13 and 6.14; NTC 2018, Eqs. 7.5.17 and 7.5.18.
    """
    check_positive(f_y=f_y, A=A, b=b, t_f=t_f, t_w=t_w, d_less_t_f=d - t_f)
    return LinkResistance(f_y * b * t_f * (d - t_f), f_y / sqrt(3.0) * t_w * (d - t_f), A * f_y)


def longest_under_axial_force(of: LinkResistance, N_Ed: float, V_Ed: float, web_share: float) -> float | None:
    """Return the largest length of a link with N_Ed >= 0.15 N_pl,Rd, m; None of others.

    Args:
        of: its resistances without axial force.
        N_Ed: N, any sign.
        V_Ed: shear in the seismic design situation, N.
        web_share: t_w (d - 2 t_f) / A.

    Source: EN 1998-1:2004, 6.8.2(6), Eqs. 6.19 and 6.20; NTC 2018, Eqs. 7.5.23 and 7.5.24.
    """
    check_not_negative(V_Ed=V_Ed, web_share=web_share)
    if abs(N_Ed) < SMALL_AXIAL * of.N_pl:
        return None
    R = abs(N_Ed) * web_share / V_Ed if V_Ed > 0.0 else float("inf")
    factor = 1.0 if R < _SMALL_R else max(1.15 - 0.5 * R, 0.0)
    return factor * 1.6 * of.M_p / of.V_p


def overstrength_of_link(of: LinkResistance, category: Category, V_Ed: float, M_Ed: float) -> float:
    """Return Omega_i of a link: 1.5 V_p / V_Ed of a short one, 1.5 M_p / M_Ed of others; infinite without effect.

    Args:
        of: its resistances without axial force.
        category: of its length.
        V_Ed: in the seismic design situation, N, without sign.
        M_Ed: in the seismic design situation, N m, without sign.

    Source: EN 1998-1:2004, 6.8.3(1); NTC 2018, 7.5.6.
    """
    resistance, effect = (of.V_p, V_Ed) if category == "short" else (of.M_p, M_Ed)
    check_not_negative(V_Ed=V_Ed, M_Ed=M_Ed)
    return HARDENING * resistance / effect if effect > 0.0 else float("inf")


def rotation(drift: float, span: float, e: float) -> float:
    """Return theta_p between a horizontal link and the beam beside it, rad: drift L / e.

    All but the link is rigid. A braced part turns by the drift about the foot of its column, so that the ends of the
    link part by drift (L - e) across it, while both turn by the drift: together drift L / e.

    Args:
        drift: plastic drift of the storey over its height.
        span: L, of the bay, m.
        e: length of the link, m.

    Source: EN 1998-1:2004, 6.8.2(10): consistent with global deformations. Kinematics of the mechanism as in AISC 341,
        Commentary F3.4a.
    """
    check_positive(span=span, e=e)
    return drift * span / e


def largest_rotation(e: float, e_s: float, e_L: float) -> float:
    """Return theta_pR, rad: 0.08 of short links, 0.02 of long ones, linear between them.

    Args:
        e: length of the link, m.
        e_s: up to which it is short, m.
        e_L: from which it is long, m.

    Source: EN 1998-1:2004, 6.8.2(10), Eqs. 6.27 to 6.29; NTC 2018, 7.5.6, of short and of long links.
    """
    share = min(max((e - e_s) / (e_L - e_s), 0.0), 1.0)
    return ROTATIONS[0] + share * (ROTATIONS[1] - ROTATIONS[0])


@dataclass(frozen=True)
class LinkStiffeners:
    """Stiffeners of the web of a link, over the whole depth.

    Attributes:
        end_thickness: of those at both sides of the web where a brace meets the link, m.
        end_width: least width of both together, m.
        spacing: largest distance of those between the ends, m; infinite: none for shear.
        flange_distance: distance from either end of one more each, m; 0: none for bending.
        count: of all between the ends of the link.
        thickness: of those between the ends, m; 0 without any.
        width: least width of each, m.
        sides: of the web at which they stand, 1 or 2.
    """

    end_thickness: float
    end_width: float
    spacing: float
    flange_distance: float
    count: int
    thickness: float
    width: float
    sides: int


def link_stiffeners(
    of: LinkResistance, category: Category, e: float, theta_p: float, b: float, t_w: float, d: float
) -> LinkStiffeners:
    """Return the stiffeners that a link needs.

    Args:
        of: its resistances without axial force.
        category: of its length.
        e: its length, m.
        theta_p: its rotation, rad.
        b: width of the flanges, m.
        t_w: thickness of the web, m.
        d: depth of the section, m.

    Source: EN 1998-1:2004, 6.8.2(11) and (12). IS 18168:2023, 11.4, has the same at the ends and at 0.08 rad, NTC
        2018, 7.5.6, the same 1.5 b, thickness, width and side. Of 52 t_w - d/5 at 0.02 rad, and of no stiffeners
        beyond 5 M_p / V_p, as in AISC 341, no public text could be read.
    """
    check_positive(e=e, b=b, t_w=t_w, d=d)
    spacing, flange = float("inf"), 0.0
    if e <= _NO_STIFFENERS * of.M_p / of.V_p:
        if category != "long":
            share = min(max((theta_p - ROTATIONS[1]) / (ROTATIONS[0] - ROTATIONS[1]), 0.0), 1.0)
            spacing = (52.0 - 22.0 * share) * t_w - d / 5.0
        if category != "short":
            flange = 1.5 * b
    parts = [e] if flange == 0.0 else [flange, e - 2.0 * flange, flange] if flange < 0.5 * e else [0.5 * e, 0.5 * e]
    count = len(parts) - 1 + sum(_between(part, spacing) for part in parts)
    return LinkStiffeners(
        end_thickness=max(0.75 * t_w, _LEAST_THICKNESS),
        end_width=b - 2.0 * t_w,
        spacing=spacing,
        flange_distance=flange,
        count=count,
        thickness=max(t_w, _LEAST_THICKNESS) if count else 0.0,
        width=0.5 * b - t_w,
        sides=2 if d >= _ONE_SIDED_BELOW else 1,
    )


def _between(length: float, spacing: float) -> int:
    """Return how many stiffeners divide a length into parts that are no longer than a spacing."""
    return max(ceil(length / spacing * (1.0 - 1e-9)) - 1, 0) if spacing > 0.0 else 0
