"""The leaning column: what the frame does not carry and yet must hold upright."""

from __future__ import annotations

from typing import Annotated

from edesign.project.notation.repeated import Repeated, equal_values
from edesign.project.notation.units import Mass, NotNegativeForce
from edesign.project.reading.base import Model
from edesign.project.reading.one_of import OneOf

_Forces = Annotated[tuple[NotNegativeForce, ...], Repeated(equal_values("EqualFloorForces", NotNegativeForce))]
FloorForces = Annotated[NotNegativeForce | _Forces, OneOf()]
_Masses = Annotated[tuple[Mass, ...], Repeated(equal_values("EqualFloorMasses", Mass))]
FloorMasses = Annotated[Mass | _Masses, OneOf()]


class LeaningColumn(Model):
    """Pin-ended struts from the base to the roof, each floor tied to that of the frame.

    They carry the gravity loads of the part of the plan that leans on the frame.

    Attributes:
        G: permanent load at each floor beside that of the frame; one for all, or a list from the lowest floor.
        Q: variable load at each floor beside that of the frame; one for all, or a list from the lowest floor.
        mass: mass at each floor, against horizontal motion; without the key that of its loads with `masses.from_loads`,
            else none.
    """

    G: FloorForces = 0.0
    Q: FloorForces = 0.0
    mass: FloorMasses | None = None


def of_floors(values: float | tuple[float, ...], floors: int) -> tuple[float, ...]:
    """Return the value of each floor from the lowest.

    Args:
        values: of each floor, or one of all.
    """
    return values if isinstance(values, tuple) else (values,) * floors
