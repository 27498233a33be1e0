"""How records act on a building: turned from x towards y, with its masses in place or beside it."""

from __future__ import annotations

from typing import Annotated, Any, Literal, get_args

from pydantic import Field

from edesign.project.notation.several import several
from edesign.project.notation.units import Angle, PositiveRatio
from edesign.project.notation.written import Written, given, one_or_list
from edesign.project.reading.base import Model

Position = Literal["0", "+x", "-x", "+y", "-y", "+x+y", "+x-y", "-x+y", "-x-y"]
"""Where the masses of rigid floors stand: `0` in place, else beside it in the directions that it says."""
IN_PLACE: Position = "0"
ECCENTRICITY = 0.05
"""Accidental eccentricity over the length of a floor, where the file does not say it (EN 1998-1:2004, Eq. 4.3)."""


def _position(value: Any) -> Any:
    return IN_PLACE if value == 0 and not isinstance(value, bool) else value


_NAMES = given({"enum": [0, *get_args(Position)[1:]]})
Angles = Annotated[tuple[Angle, ...], Field(min_length=1), Written(several, one_or_list)]
Positions = Annotated[
    tuple[Annotated[Position, Written(_position, _NAMES)], ...], Field(min_length=1), Written(several, one_or_list)
]
EccentricityRatio = PositiveRatio | None


def eccentricity_of(position: str, ratio: float) -> tuple[float, float]:
    """Return by what shares of the lengths of a floor its masses stand beside their places, along x and y.

    Args:
        position: one of `Position`.
    """
    signs = {position[i + 1]: 1.0 if position[i] == "+" else -1.0 for i in range(0, len(position) - 1, 2)}
    return ratio * signs.get("x", 0.0), ratio * signs.get("y", 0.0)


class Eccentric(Model):
    """Accidental eccentricity of a building.

    Attributes:
        eccentricity: of a building, where the masses of rigid floors stand, on which lateral loads act: `0` in place,
            `+x-y` beside it towards x and against y; a list stands for several analyses.
        eccentricity_ratio: how far beside it over the length of the floor; without the key `design.accidental_torsion`
            of the building, and 5 % without a design.
    """

    eccentricity: Positions = (IN_PLACE,)
    eccentricity_ratio: EccentricityRatio = None

    def eccentricity_with(self, accidental_torsion: float) -> tuple[float, float]:
        """Return by what shares of the lengths of a floor its masses stand beside their places, along x and y.

        Args:
            accidental_torsion: of the building, where nothing here says how far.
        """
        return eccentricity_of(self.eccentricity[0], self.eccentricity_ratio or accidental_torsion)


class Shaking(Eccentric):
    """How records act on a building.

    Attributes:
        angles: of a building, angles by which each record is turned from x towards y, a pair from x and y; a history
            becomes one of each.
    """

    angles: Angles = (0.0,)
