"""Ground types, EN 1998-1:2004, 3.1.2 and Table 3.1."""

from __future__ import annotations

import math
from dataclasses import dataclass

from edesign.codes.names import unknown


@dataclass(frozen=True)
class GroundType:
    """A row of Table 3.1; None where the table gives no value.

    Attributes:
        name: A to E, S1 or S2.
        description: of the stratigraphic profile.
        v_s30: lower and upper mean shear wave velocity of the top 30 m, m/s.
    """

    name: str
    description: str
    v_s30: tuple[float, float] | None = None


_TABLE_3_1 = (
    GroundType("A", "rock, with at most 5 m of weaker material at the surface", (800.0, math.inf)),
    GroundType(
        "B",
        "very dense sand, gravel or very stiff clay, tens of metres thick, stiffer with depth",
        (360.0, 800.0),
    ),
    GroundType(
        "C",
        "dense or medium dense sand, gravel or stiff clay, tens to hundreds of metres thick",
        (180.0, 360.0),
    ),
    GroundType("D", "loose to medium cohesionless soil, or soft to firm cohesive soil", (0.0, 180.0)),
    GroundType("E", "5 m to 20 m of surface alluvium with the velocity of C or D over ground stiffer than 800 m/s"),
    GroundType(
        "S1",
        "at least 10 m of soft clay or silt of high plasticity (PI > 40) and high water content (velocity indicative)",
        (0.0, 100.0),
    ),
    GroundType("S2", "liquefiable soil, sensitive clay, or any profile outside A to E and S1"),
)


def ground_type(name: str) -> GroundType:
    """Return a ground type by its name.

    Args:
        name: A to E, S1 or S2.

    Raises:
        InputError: there is no such ground type.
    """
    for ground in _TABLE_3_1:
        if ground.name == name:
            return ground
    raise unknown("ground type", name, [ground.name for ground in _TABLE_3_1])
