"""How far apart the lines and the floors of a grid are."""

from __future__ import annotations

from functools import cached_property
from itertools import accumulate
from typing import TYPE_CHECKING, Annotated

from edesign.project.notation.repeated import Count, Repeated
from edesign.project.notation.units import PositiveLength
from edesign.project.reading.base import Model


class EqualBays(Model):
    """Bays of one width.

    Attributes:
        count: number of bays.
        width: width of each bay.
    """

    count: Count
    width: PositiveLength


class EqualStoreys(Model):
    """Storeys of one height.

    Attributes:
        count: number of storeys.
        height: height of each storey.
    """

    count: Count
    height: PositiveLength


Widths = Annotated[tuple[PositiveLength, ...], Repeated(EqualBays)]
Heights = Annotated[tuple[PositiveLength, ...], Repeated(EqualStoreys)]


def widths(bays: tuple[float, ...] | EqualBays) -> tuple[float, ...]:
    """Return the width of each bay, m."""
    return (bays.width,) * bays.count if isinstance(bays, EqualBays) else bays


class Storeys:
    """What has storeys, counted from 1 at the bottom; floor s closes storey s, and floor 0 is the base."""

    if TYPE_CHECKING:
        storeys: tuple[float, ...] | EqualStoreys

    @cached_property
    def storey_heights(self) -> tuple[float, ...]:
        """Height of each storey, bottom to top, m."""
        return (self.storeys.height,) * self.storeys.count if isinstance(self.storeys, EqualStoreys) else self.storeys

    @property
    def n_storeys(self) -> int:
        """The number of storeys."""
        return len(self.storey_heights)

    @cached_property
    def levels(self) -> tuple[float, ...]:
        """Level of each floor from the base (floor 0) to the roof, m; n_storeys + 1 values."""
        return tuple(accumulate(self.storey_heights, initial=0.0))

    @property
    def height(self) -> float:
        """Level of the roof above the base, m."""
        return self.levels[-1]
