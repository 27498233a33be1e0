"""How a brace buckles, and whether it breaks."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from edesign.project.frame.sections import SectionAxis
from edesign.project.notation.quantities import ROTATIONAL_STIFFNESS
from edesign.project.notation.units import PositiveFactor, parse_ratio, restraint
from edesign.project.notation.written import Written, ratio, words_or
from edesign.project.reading.base import Model, refuse

CAMBER = 1e-3
"""Camber / buckling length. Source: Uriz, Filippou & Mahin (2008): 0.05 % to 0.1 % fit tests of braces."""

LARGEST_CAMBER = 0.1

ELEMENTS = {"pinned": 4, "restrained": 8}
"""Beams over the buckling length of pinned braces, and of those whose ends are restrained.

Within a beam the moment is linear, so that n beams over a half wave have an Euler load of (pi / n)^2 / 12 too much: 5 %
with four, between two neighbouring buckling curves of EN 1993-1-1. Fixed ends leave half of the beams to the half wave.
"""


def _camber(value: Any) -> float | Literal["ec3"]:
    if isinstance(value, str) and value.isidentifier() and value != "ec3":
        raise refuse(f"`{value}` is unknown; give a ratio such as `0.1 %`, or `ec3` [E-VALUE-03]")
    return "ec3" if value == "ec3" else parse_ratio(value, 0.0, LARGEST_CAMBER, low_allowed=False)


def _even(value: int) -> int:
    if value % 2:
        raise refuse(f"{value} is odd; half of the brace is modelled, so that the number of beams is even [E-VALUE-02]")
    return value


class Fracture(Model):
    """Low-cycle fatigue: fibres break by Manson and Coffin's law, rainflow and Miner's sum.

    Attributes:
        strain: range of the strain cycle that breaks a fibre at once.
        exponent: exponent m of Coffin and Manson: N cycles of the range strain N^m break a fibre.
    """

    strain: PositiveFactor = 0.095
    exponent: Annotated[float, Field(ge=-1.0, lt=0.0)] = -0.5


class BraceBuckling(Model):
    """The model of a brace that buckles.

    Attributes:
        camber: height of the initial bow over the buckling length; with `ec3` first yield is at N_b,Rd of EN 1993-1-1.
        axis: axis of the section about which the brace buckles; a stack of rectangles has but one.
        ends: rotation of the ends against the chord: `pinned`, `fixed`, or the stiffness of a gusset plate.
        elements: fibre beams over the buckling length, an even number; without the key 4 of pinned ends, 8 of others.
        fracture: fibres break by low-cycle fatigue; `{}` takes the defaults, without the key they do not.
    """

    camber: Annotated[
        float | Literal["ec3"], Written(_camber, words_or(ratio(0.0, LARGEST_CAMBER, low_allowed=False), "ec3"))
    ] = CAMBER
    axis: SectionAxis = "weak"
    ends: Annotated[
        Literal["pinned", "fixed"] | float,
        restraint(ROTATIONAL_STIFFNESS, "the ends are `pinned`, `fixed`, or have a stiffness", "pinned", "fixed"),
    ] = "pinned"
    elements: Annotated[int, Field(ge=2, le=16), AfterValidator(_even)] | None = None
    fracture: Fracture | None = None

    @property
    def n_elements(self) -> int:
        """The number of elements over the buckling length."""
        return self.elements or ELEMENTS["pinned" if self.ends == "pinned" else "restrained"]
