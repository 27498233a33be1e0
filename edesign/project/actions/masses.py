"""Masses at the nodes: given, or from the loads."""

from __future__ import annotations

from typing import Literal

from edesign.project.actions.loads import Combination
from edesign.project.notation.selections import ALL_LINES, Lines, Numbers
from edesign.project.notation.units import PositiveMass
from edesign.project.reading.base import Model


class GivenMass(Model):
    """The mass of each of some nodes, kg; a node is given its mass once."""

    lines: Lines = ALL_LINES
    floors: Numbers
    mass: PositiveMass


class Masses(Model):
    """Nodal masses; exactly one of `given` and `from_loads` is not None.

    `directions` says whether a mass resists horizontal motion only, or vertical motion too.
    """

    given: tuple[GivenMass, ...] | None = None
    from_loads: Combination | None = None
    directions: Literal["both", "horizontal"] = "both"
