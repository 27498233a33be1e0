"""Modelling parameters and acceptance criteria of steel beams and columns in flexure, nonlinear procedures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from edesign.codes.fema356.sections import ISection
from edesign.codes.fema356.strength import beam_yield_rotation, column_yield_rotation
from edesign.codes.names import unknown

Component = Literal["primary", "secondary"]

FORCE_CONTROLLED = 0.5
"""P/P_CL above which a column is force-controlled in flexure: no plastic rotation counts on it."""


@dataclass(frozen=True)
class RotationLimits:
    """One line of Table 5-6, in multiples of theta_y or, times theta_y, in rad.

    Attributes:
        a: plastic rotation where the strength drops.
        b: plastic rotation where the gravity loads are lost.
        c: residual strength, a ratio in both cases.
        io: plastic rotation that Immediate Occupancy allows.
        primary_ls, primary_cp: Life Safety and Collapse Prevention, primary components.
        secondary_ls, secondary_cp: the same of secondary components.
    """

    a: float
    b: float
    c: float
    io: float
    primary_ls: float
    primary_cp: float
    secondary_ls: float
    secondary_cp: float

    def allowed(self, level: str, component: Component = "primary") -> float:
        """Return the plastic rotation that a performance level allows.

        Args:
            level: IO, LS or CP.
            component: "primary" or "secondary".

        Returns:
            In the unit of the limits: rad, or multiples of theta_y.

        Raises:
            InputError: there is no such level.
        """
        allowed = {
            "IO": self.io,
            "LS": self.primary_ls if component == "primary" else self.secondary_ls,
            "CP": self.primary_cp if component == "primary" else self.secondary_cp,
        }
        if level not in allowed:
            raise unknown("performance level", level, allowed)
        return allowed[level]


COMPACT = RotationLimits(9.0, 11.0, 0.6, 1.0, 6.0, 8.0, 9.0, 11.0)
"""Line a of beams, and of columns with P/P_CL < 0.2, in theta_y."""
SLENDER = RotationLimits(4.0, 6.0, 0.2, 0.25, 2.0, 3.0, 3.0, 4.0)
"""Line b of the same."""
LOADED_SLENDER = RotationLimits(1.0, 1.5, 0.2, 0.25, 0.5, 0.8, 1.2, 1.2)
"""Line b of columns with 0.2 <= P/P_CL <= 0.5."""
FLANGE = (52.0, 65.0)
"""Coefficients of the flange's slenderness limits of lines a and b, of all members."""


def loaded_compact(ratio: float) -> RotationLimits:
    """Return line a of columns with 0.2 <= P/P_CL <= 0.5, in theta_y.

    Args:
        ratio: P/P_CL.

    Source: FEMA 356, Table 5-6, footnotes 3 to 6.
    """
    left = 1.0 - 5.0 / 3.0 * ratio
    return RotationLimits(11.0 * left, 17.0 * left, 0.2, 0.25, 8.0 * left, 11.0 * left, 14.0 * left, 17.0 * left)


def beam_limits(section: ISection) -> RotationLimits:
    """Return the line of a beam in flexure, in multiples of theta_y.

    Between the limits of slenderness it is interpolated for flange and web, and the lower value holds.

    Source: FEMA 356, Table 5-6, Beams - flexure.
    """
    return _between(section, (418.0, 640.0), COMPACT, SLENDER)


def column_limits(section: ISection, ratio: float) -> RotationLimits | None:
    """Return the line of a column in flexure, in multiples of theta_y; None where it is force-controlled.

    Args:
        ratio: P/P_CL, compression positive.

    Source: FEMA 356, Table 5-6, Columns - flexure; 5.5.2.4.2 for P/P_CL > 0.5.
    """
    if ratio > FORCE_CONTROLLED:
        return None
    if ratio < 0.2:
        return _between(section, (300.0, 460.0), COMPACT, SLENDER)
    return _between(section, (260.0, 400.0), loaded_compact(ratio), LOADED_SLENDER)


def beam_rotations(section: ISection, length: float) -> RotationLimits:
    """Return the line of a beam in rad (c: ratio).

    Args:
        length: l_b, m.
    """
    return _times(beam_limits(section), beam_yield_rotation(section, length))


@lru_cache(maxsize=4096)  # a history is judged by every performance level
def column_rotations(section: ISection, length: float, compression: float, strength: float) -> RotationLimits | None:
    """Return the line of a column in rad (c: ratio); None where it is force-controlled.

    Args:
        length: l_c, m.
        compression: P, N; tension (negative) counts as none.
        strength: P_CL, N.
    """
    limits = column_limits(section, max(compression, 0.0) / strength)
    return None if limits is None else _times(limits, column_yield_rotation(section, length, compression))


def _times(limits: RotationLimits, rotation: float) -> RotationLimits:
    values = [value * rotation for value in _values(limits)]
    values[2] = limits.c
    return RotationLimits(*values)


def _between(
    section: ISection, web: tuple[float, float], compact: RotationLimits, slender: RotationLimits
) -> RotationLimits:
    """Interpolate between lines a and b by the part of the way that flange or web, whichever is further, has gone."""
    gone = 0.0
    for slenderness, (low, high) in ((section.flange_slenderness, FLANGE), (section.web_slenderness, web)):
        start, end = section.slenderness_limit(low), section.slenderness_limit(high)
        gone = max(gone, min((slenderness - start) / (end - start), 1.0))
    pairs = zip(_values(compact), _values(slender), strict=True)
    return RotationLimits(*(first + gone * (last - first) for first, last in pairs))


def _values(limits: RotationLimits) -> tuple[float, ...]:
    return tuple(vars(limits).values())
