"""Own load cases of a building, beside its loads G and Q: wind, snow drifts, cranes and the like."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from edesign.project.building.members import BeamPlaces
from edesign.project.building.places import ALL_BAYS, Bays, ColumnLines
from edesign.project.notation.selections import ALL_NUMBERS, Numbers
from edesign.project.notation.units import AreaLoad as ForcePerArea
from edesign.project.notation.units import Force, Length, LineLoad
from edesign.project.reading.base import Model

CaseName = Annotated[str, Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$", max_length=24)]
Side = Literal["x-", "x+", "y-", "y+"]
"""Of a building: `x-` is the facade that looks against axis x, on which wind along x blows."""
NAMED_CATEGORIES = ("wind", "snow")
"""Of own cases beside those that the file names under `loads.psi`."""


class CaseArea(Model):
    """Load of a case on some bays of some floors, which comes to the beams as that of `loads.areas`.

    Attributes:
        floors: floors that have the load.
        bays: bays of the plan that have the load; `all` takes those that a floor covers.
        q: load, positive downwards, negative of suction.
        spans: the way that the floor spans.
        secondary_beams: beams across the span in each bay.
    """

    floors: Numbers = ALL_NUMBERS
    bays: Bays = ALL_BAYS
    q: ForcePerArea
    spans: Literal["x", "y", "two_way"]
    secondary_beams: Annotated[int, Field(ge=0, le=20)] = 0


class CaseBeamLoad(BeamPlaces):
    """Load of a case along beams.

    Attributes:
        q: load a length, positive downwards.
    """

    q: LineLoad


class CaseNodeForce(Model):
    """Forces of a case on each of some nodes.

    Attributes:
        at: column lines of the nodes.
        floors: floors of the nodes.
        x: force along x.
        y: force along y.
        down: force downwards.
    """

    at: ColumnLines
    floors: Numbers
    x: Force = 0.0
    y: Force = 0.0
    down: Force = 0.0


class PlanPlace(Model):
    """A place in plan, from the corner of lines A and 1.

    Attributes:
        x: along x.
        y: along y.
    """

    x: Length
    y: Length


class FloorForce(Model):
    """The horizontal force of a case on each of some rigid floors.

    Attributes:
        floors: rigid floors.
        x: whole force on each floor along x.
        y: whole force on each floor along y.
        at: place through which the force goes; without the key the middle of what the floor covers.
    """

    floors: Numbers
    x: Force = 0.0
    y: Force = 0.0
    at: PlanPlace | None = None


class FacadePressure(Model):
    """Pressure of a case on one side of some storeys; half of a storey's load goes to the floors above and below.

    Attributes:
        side: which way the facade looks.
        storeys: storeys, counted from 1.
        pressure: positive towards the facade, negative of suction (EN 1991-1-4, 5.2).
    """

    side: Side
    storeys: Numbers = ALL_NUMBERS
    pressure: ForcePerArea


class LoadCaseOfFile(Model):
    """A load case of the elastic design; cases of one category never act together, those of different ones do.

    Attributes:
        category: `wind`, `snow`, or one that `loads.psi` names.
        reversed: whether the same loads also act the other way, as a case of their own.
        areas: loads on bays of floors.
        beams: loads along beams.
        nodes: forces on nodes.
        floors: horizontal forces on rigid floors.
        facades: pressures on the sides of storeys.
    """

    category: str
    reversed: bool = False
    areas: tuple[CaseArea, ...] = ()
    beams: tuple[CaseBeamLoad, ...] = ()
    nodes: tuple[CaseNodeForce, ...] = ()
    floors: tuple[FloorForce, ...] = ()
    facades: tuple[FacadePressure, ...] = ()

    @property
    def relieving(self) -> bool:
        """Whether some of its loads do not act downwards, so that it may relieve what others load."""
        sideways = any(force.x or force.y or force.down < 0.0 for force in self.nodes)
        lifting = any(area.q < 0.0 for area in self.areas) or any(beam.q < 0.0 for beam in self.beams)
        return self.reversed or sideways or lifting or bool(self.floors or self.facades)

    def values(self) -> Iterator[tuple[str, int, str, float]]:
        """Yield list, place in it, key and value of every load."""
        for part in ("areas", "beams", "nodes", "floors", "facades"):
            for i, load in enumerate(getattr(self, part)):
                for key in ("q", "x", "y", "down", "pressure"):
                    if (value := getattr(load, key, 0.0)) != 0.0:
                        yield part, i, key, value


def facing(side: Side) -> tuple[int, float]:
    """Return the axis across a facade, 0 of x and 1 of y, and the sign of a pressure towards it along this axis."""
    return (0 if side[0] == "x" else 1), (1.0 if side[1] == "-" else -1.0)


def cases_of(cases: dict[str, LoadCaseOfFile]) -> Iterator[tuple[str, LoadCaseOfFile, float]]:
    """Yield the name, the case and its factor of all cases: a reversed one is a second one, `-wind_x`."""
    for name, case in cases.items():
        yield name, case, 1.0
        if case.reversed:
            yield f"-{name}", case, -1.0
