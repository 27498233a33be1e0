"""Values that shape a spectrum of EN 1998-1:2004; the tables themselves are in data/recommended.yaml."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from edesign.codes.names import unknown
from edesign.errors import InputError


@dataclass(frozen=True)
class HorizontalParameters:
    """Soil factor and corner periods of a horizontal spectrum, 3.2.2.2(2)P.

    Attributes:
        ground: ground type A to E.
        spectrum_type: 1, or 2 where earthquakes of surface-wave magnitude up to 5.5 govern the hazard.
        S: soil factor.
        T_B, T_C: ends of the branch of constant acceleration, s.
        T_D: beginning of the branch of constant displacement, s.
        F_0: largest amplification at 5 % damping, 2.5 in Eqs. 3.2-3.5.
    """

    ground: str
    spectrum_type: int
    S: float
    T_B: float
    T_C: float
    T_D: float
    F_0: float = 2.5

    def __post_init__(self) -> None:
        _positive("S", self.S, "")
        _positive("F_0", self.F_0, "")
        _ordered(self.T_B, self.T_C, self.T_D)


@dataclass(frozen=True)
class VerticalParameters:
    """Peak acceleration and corner periods of the vertical spectrum, 3.2.2.3(1)P.

    Attributes:
        spectrum_type: 1 or 2.
        ratio: a_vg / a_g.
        T_B, T_C, T_D: corner periods, s.
        F_0: largest amplification at 5 % damping, 3.0 in Eqs. 3.8-3.11.
    """

    spectrum_type: int
    ratio: float
    T_B: float
    T_C: float
    T_D: float
    F_0: float = 3.0

    def __post_init__(self) -> None:
        _positive("F_0", self.F_0, "")
        _positive("a_vg / a_g", self.ratio, "")
        _ordered(self.T_B, self.T_C, self.T_D)


def horizontal_of(table: Mapping[int, Any], spectrum_type: int, ground: str) -> HorizontalParameters:
    """Return a row of a table {type: {ground: {S, T_B, T_C, T_D}}}, where F_0 may stand too.

    Args:
        table: values by type of spectrum.
        spectrum_type: 1 or 2.
        ground: ground type, A to E.

    Raises:
        InputError: no such type or ground; S1 and S2 need a study of their own, 3.1.2(4)P.
    """
    if spectrum_type not in table:
        raise unknown("spectrum type", spectrum_type, table)
    if ground in ("S1", "S2"):
        raise InputError(
            f"ground {ground} needs a study of its own (EN 1998-1, 3.1.2(4)P): no spectrum of 3.2.2 applies [E-EC8-05]"
        )
    if ground not in table[spectrum_type]:
        raise unknown("ground type", ground, table[spectrum_type])
    return HorizontalParameters(ground, spectrum_type, **table[spectrum_type][ground])


def vertical_of(table: Mapping[int, Any], spectrum_type: int) -> VerticalParameters:
    """Return a row of a table {type: {ratio, T_B, T_C, T_D}}, where F_0 may stand too.

    Args:
        table: values by type of spectrum.
        spectrum_type: 1 or 2.

    Raises:
        InputError: no such type.
    """
    if spectrum_type not in table:
        raise unknown("spectrum type", spectrum_type, table)
    return VerticalParameters(spectrum_type, **table[spectrum_type])


def _positive(name: str, value: float, unit: str) -> None:
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"{name} must be greater than zero, not {value:g}{unit} [E-VALUE-02]")


def _ordered(T_B: float, T_C: float, T_D: float) -> None:
    for name, value in (("T_B", T_B), ("T_C", T_C), ("T_D", T_D)):
        _positive(name, value, " s")
    if not T_B <= T_C <= T_D:
        raise InputError(f"T_B <= T_C <= T_D is needed, not {T_B:g} s, {T_C:g} s and {T_D:g} s [E-VALUE-04]")
