"""Permanent (G) and variable (Q) loads, positive downwards, and the combination that acts during earthquakes."""

from __future__ import annotations

from edesign.project.base import Model
from edesign.project.members import BeamPlaces
from edesign.project.selections import ALL_LINES, Lines, Numbers
from edesign.project.units import Factor, Force, LineLoad


class Combination(Model):
    """Factors of G and Q in a sum."""

    G: Factor = 1.0
    Q: Factor = 0.3


class BeamLoad(BeamPlaces):
    """Uniform load on beams, N/m downwards; loads on one beam add up."""

    G: LineLoad = 0.0
    Q: LineLoad = 0.0


class NodeLoad(Model):
    """Load on nodes, N downwards; loads on one node add up."""

    lines: Lines = ALL_LINES
    floors: Numbers
    G: Force = 0.0
    Q: Force = 0.0


class Loads(Model):
    """All loads; `gravity` acts before and during earthquakes and pushovers."""

    beams: tuple[BeamLoad, ...] = ()
    nodes: tuple[NodeLoad, ...] = ()
    gravity: Combination = Combination()
