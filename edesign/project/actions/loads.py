"""Permanent (G) and variable (Q) loads, positive downwards, and the combination that acts during earthquakes."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic_core import PydanticCustomError

from edesign.project.frame.members import BeamPlaces, ColumnPlaces
from edesign.project.notation.positions import Place, Places
from edesign.project.notation.quantities import AREA_LOAD, LINE_LOAD
from edesign.project.notation.selections import ALL_LINES, Lines, Numbers
from edesign.project.notation.units import AreaLoad, Factor, Force, PositiveLength, parse_quantity
from edesign.project.notation.written import Written, either, items, quantity
from edesign.project.reading.base import Model, refuse


def _line_load(value: Any) -> float:
    """Read a force per length; a force per area is refused with where it belongs."""
    try:
        return parse_quantity(value, LINE_LOAD)
    except PydanticCustomError:
        try:
            parse_quantity(value, AREA_LOAD)
        except PydanticCustomError:
            pass
        else:
            raise refuse(
                f"`{value}` is an area load, which needs a tributary width: give it under `loads.floors` with its "
                f"`width`; a force per length is written like `{LINE_LOAD.example}` [E-VALUE-01]"
            ) from None
        raise


def _line_loads(value: Any) -> tuple[float, float]:
    """Read a force per length, or two of them: at the start and at the end."""
    if not isinstance(value, (list, tuple)):
        load = _line_load(value)
        return load, load
    if len(value) != 2:
        raise refuse(f"{len(value)} values, but two are needed: at the start and at the end [E-VALUE-04]")
    found = []
    for i, item in enumerate(value):
        try:
            found.append(_line_load(item))
        except PydanticCustomError as error:
            raise refuse((error.context or {})["message"], i) from None
    return found[0], found[1]


LineLoad = Annotated[float, Written(_line_load, quantity(LINE_LOAD))]
LineLoads = Annotated[
    tuple[float, float],
    Written(_line_loads, either(quantity(LINE_LOAD), items(quantity(LINE_LOAD), quantity(LINE_LOAD)))),
]
"""N/m at the start and at the end."""


class Combination(Model):
    """Factors of G and Q in a sum.

    Attributes:
        G: factor of permanent loads.
        Q: factor of variable loads.
    """

    G: Factor = 1.0
    Q: Factor = 0.3


class PointLoad(Model):
    """Loads of one size at places along a beam, downwards.

    Attributes:
        at: one place along each beam from its left end, or a list: a length, or a share of the span.
        G: permanent force, positive downwards.
        Q: variable force, positive downwards.
    """

    at: Places
    G: Force = 0.0
    Q: Force = 0.0


class PartialLoad(Model):
    """Load on a part of a beam, downwards, linear from its start to its end.

    Attributes:
        start: where the load begins, from the left end of each beam: a length, or a share of the span.
        end: where the load ends.
        G: permanent load, positive downwards; one value, or two at start and end.
        Q: variable load, positive downwards; one value, or two at start and end.
    """

    start: Place
    end: Place
    G: LineLoads = (0.0, 0.0)
    Q: LineLoads = (0.0, 0.0)


class BeamLoad(BeamPlaces):
    """Loads on beams, downwards: uniform, at points and on parts; loads on one beam add up.

    Attributes:
        G: permanent load on the whole beam, positive downwards.
        Q: variable load on the whole beam, positive downwards.
        points: forces at places along each beam.
        partial: loads on a part of each beam.
    """

    G: LineLoad = 0.0
    Q: LineLoad = 0.0
    points: tuple[PointLoad, ...] = ()
    partial: tuple[PartialLoad, ...] = ()


class FloorLoad(BeamPlaces):
    """Area load on floors, downwards, of which the beams of the frame carry a strip of the tributary width.

    Attributes:
        width: tributary width of the frame, by which the area load is multiplied.
        G: permanent load, positive downwards.
        Q: variable load, positive downwards.
    """

    width: PositiveLength
    G: AreaLoad = 0.0
    Q: AreaLoad = 0.0


class ColumnLoad(ColumnPlaces):
    """Uniform horizontal load on columns, to the right; loads on one column add up.

    Attributes:
        G: permanent load, positive to the right.
        Q: variable load, positive to the right.
    """

    G: LineLoad = 0.0
    Q: LineLoad = 0.0


class NodeLoad(Model):
    """Load on nodes, downwards; loads on one node add up.

    Attributes:
        lines: column lines of the nodes.
        floors: floors of the nodes.
        G: permanent force, positive downwards.
        Q: variable force, positive downwards.
    """

    lines: Lines = ALL_LINES
    floors: Numbers
    G: Force = 0.0
    Q: Force = 0.0


class Loads(Model):
    """All loads; `gravity` acts before and during earthquakes and pushovers.

    Attributes:
        floors: area loads, of which the beams carry the tributary width.
        beams: loads on beams; loads on one beam add up.
        columns: horizontal loads along columns.
        nodes: forces on nodes.
        gravity: factors of the combination that acts before and during earthquakes and pushovers.
    """

    floors: tuple[FloorLoad, ...] = ()
    beams: tuple[BeamLoad, ...] = ()
    columns: tuple[ColumnLoad, ...] = ()
    nodes: tuple[NodeLoad, ...] = ()
    gravity: Combination = Combination()

    @property
    def are_vertical(self) -> bool:
        """Whether any load acts downwards, from which masses may follow."""
        return bool(self.floors or self.beams or self.nodes)
