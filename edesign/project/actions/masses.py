"""Masses at the nodes: given, or from the loads."""

from __future__ import annotations

from typing import Literal

from edesign.project.actions.loads import Combination
from edesign.project.notation.selections import ALL_LINES, Lines, Numbers
from edesign.project.notation.units import PositiveMass
from edesign.project.reading.base import Model


class GivenMass(Model):
    """The mass of each of some nodes; a node is given its mass once.

    Attributes:
        lines: column lines of the nodes.
        floors: floors of the nodes.
        mass: mass of each of the nodes.
    """

    lines: Lines = ALL_LINES
    floors: Numbers
    mass: PositiveMass


class Masses(Model):
    """Masses of the nodes, given or from the loads.

    Attributes:
        given: masses node by node; this key or `from_loads`.
        from_loads: factors of the vertical loads that are masses, divided by 9.80665 m/s^2; this key or `given`.
        directions: whether a mass resists horizontal motion only, or vertical motion too.
    """

    given: tuple[GivenMass, ...] | None = None
    from_loads: Combination | None = None
    directions: Literal["both", "horizontal"] = "both"
