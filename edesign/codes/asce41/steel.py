"""Acceptance criteria of steel beams and columns in flexure, ASCE/SEI 41-17, nonlinear procedures, Table 9-7.1."""

from __future__ import annotations

from dataclasses import astuple, dataclass
from functools import lru_cache

from edesign.codes.fema356.sections import ISection
from edesign.codes.fema356.strength import beam_yield_rotation
from edesign.codes.names import unknown

FORCE_CONTROLLED = 0.6
"""P_G/P_ye above which a column is force-controlled in flexure."""

FLANGE = (0.30, 0.38)
"""Coefficients of sqrt(E/F_ye) that b_f/(2 t_f) of lines a and b is compared with."""

WEB_OF_BEAMS = (2.45, 3.76)
"""The same of h/t_w of beams."""


@dataclass(frozen=True)
class PlasticRotations:
    """One line of Table 9-7.1, rad, or multiples of theta_y.

    Attributes:
        a: plastic rotation where the strength drops.
        b: plastic rotation where the gravity loads are lost.
        c: residual strength, a ratio in both cases.
        io, ls, cp: plastic rotations that Immediate Occupancy, Life Safety and Collapse Prevention allow.
    """

    a: float
    b: float
    c: float
    io: float
    ls: float
    cp: float

    def allowed(self, level: str) -> float:
        """Return the plastic rotation that a performance level allows.

        Args:
            level: IO, LS or CP.

        Raises:
            InputError: there is no such level.
        """
        allowed = {"IO": self.io, "LS": self.ls, "CP": self.cp}
        if level not in allowed:
            raise unknown("performance level", level, allowed)
        return allowed[level]


COMPACT = PlasticRotations(9.0, 11.0, 0.6, 1.0, 9.0, 11.0)
"""Line a of beams, in theta_y."""
SLENDER = PlasticRotations(4.0, 6.0, 0.2, 0.25, 3.0, 4.0)
"""Line b of beams, in theta_y."""


def web_limits(ratio: float) -> tuple[float, float]:
    """Return the coefficients of sqrt(E/F_ye) that h/t_w of lines a and b of columns is compared with.

    Args:
        ratio: P_G/P_ye, not negative.

    Source: ASCE/SEI 41-17, Table 9-7.1: below P_G/P_ye = 0.2 2.45 (1 - 0.71 P_G/P_ye) and 3.76 (1 - 1.83 P_G/P_ye),
        from there on 0.77 (2.93 - P_G/P_ye) and 1.12 (2.33 - P_G/P_ye), not less than 1.49.
    """
    if ratio < 0.2:
        return 2.45 * (1.0 - 0.71 * ratio), 3.76 * (1.0 - 1.83 * ratio)
    return max(0.77 * (2.93 - ratio), 1.49), max(1.12 * (2.33 - ratio), 1.49)


def compact_column(ratio: float, slenderness: float, web: float) -> PlasticRotations:
    """Return line a of columns, rad.

    Args:
        ratio: P_G/P_ye, not negative.
        slenderness: L/r_y.
        web: h/t_w.

    Source: ASCE/SEI 41-17, Table 9-7.1, columns, line a:
        a = 0.8 (1 - P_G/P_ye)^2.2 (0.1 L/r_y + 0.8 h/t_w)^-1 - 0.0035,
        b = 7.4 (1 - P_G/P_ye)^2.3 (0.5 L/r_y + 2.9 h/t_w)^-1 - 0.006,
        c = 0.9 - 0.9 P_G/P_ye; none is negative.
    """
    left = 1.0 - ratio
    a = 0.8 * left**2.2 / (0.1 * slenderness + 0.8 * web) - 0.0035
    b = 7.4 * left**2.3 / (0.5 * slenderness + 2.9 * web) - 0.006
    return _of_column(a, b, 0.9 - 0.9 * ratio)


def slender_column(ratio: float, slenderness: float, web: float, flange: float) -> PlasticRotations:
    """Return line b of columns, rad.

    Args:
        ratio: P_G/P_ye, not negative.
        slenderness: L/r_y.
        web: h/t_w.
        flange: b_f/(2 t_f).

    Source: ASCE/SEI 41-17, Table 9-7.1, columns, line b:
        a = 1.2 (1 - P_G/P_ye)^1.2 (1.4 L/r_y + 0.1 h/t_w + 0.9 b_f/(2 t_f))^-1 - 0.0023,
        b = 2.5 (1 - P_G/P_ye)^1.8 (0.1 L/r_y + 0.2 h/t_w + 2.7 b_f/(2 t_f))^-1 - 0.0097,
        c = 0.5 - 0.5 P_G/P_ye; none is negative.
    """
    left = 1.0 - ratio
    a = 1.2 * left**1.2 / (1.4 * slenderness + 0.1 * web + 0.9 * flange) - 0.0023
    b = 2.5 * left**1.8 / (0.1 * slenderness + 0.2 * web + 2.7 * flange) - 0.0097
    return _of_column(a, b, 0.5 - 0.5 * ratio)


def _of_column(a: float, b: float, c: float) -> PlasticRotations:
    a, b, c = (max(value, 0.0) for value in (a, b, c))
    return PlasticRotations(a, b, c, 0.5 * a, 0.75 * b, b)


def beam_rotations(section: ISection, length: float) -> PlasticRotations:
    """Return the line of a beam in flexure, rad (c: ratio).

    theta_y leaves out what Eq. 9-1 adds for shear, which is on the safe side.

    Args:
        length: of the beam, m.

    Source: ASCE/SEI 41-17, Table 9-7.1, beams.
    """
    theta_y = beam_yield_rotation(section, length)
    found = _between(section, WEB_OF_BEAMS, COMPACT, SLENDER)
    return PlasticRotations(
        found.a * theta_y, found.b * theta_y, found.c, found.io * theta_y, found.ls * theta_y, found.cp * theta_y
    )


@lru_cache(maxsize=4096)  # a history is judged by every performance level
def column_rotations(section: ISection, length: float, gravity: float) -> PlasticRotations | None:
    """Return the line of a column in flexure, rad (c: ratio); None where it is force-controlled.

    Args:
        length: L, m.
        gravity: P_G, N, compression positive; tension counts as none.

    Source: ASCE/SEI 41-17, Table 9-7.1, columns; 9.4.2.4.3 for P_G/P_ye > 0.6.
    """
    ratio = max(gravity, 0.0) / section.yield_axial_force
    if ratio > FORCE_CONTROLLED:
        return None
    slenderness = length / (section.weak_inertia / section.area) ** 0.5
    web = section.web_slenderness
    compact = compact_column(ratio, slenderness, web)
    slender = slender_column(ratio, slenderness, web, section.flange_slenderness)
    return _between(section, web_limits(ratio), compact, slender)


def _between(
    section: ISection, web: tuple[float, float], compact: PlasticRotations, slender: PlasticRotations
) -> PlasticRotations:
    """Interpolate between lines a and b for flange and for web; of each value the lower one holds."""
    root = (section.E / section.expected_yield) ** 0.5
    gone = [
        min(max((slenderness / root - low) / (high - low), 0.0), 1.0)
        for slenderness, (low, high) in ((section.flange_slenderness, FLANGE), (section.web_slenderness, web))
    ]
    pairs = zip(astuple(compact), astuple(slender), strict=True)
    return PlasticRotations(*(min(first + part * (last - first) for part in gone) for first, last in pairs))
