"""Wave passage: when the ground motion reaches the lines of columns."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.grid import Grid
from edesign.project.notation.units import Duration, PositiveVelocity, angle_or
from edesign.project.reading.base import Model

_WAYS = {"right": (1.0,), "left": (-1.0,)}
Propagation = Annotated[
    Literal["right", "left"] | float, angle_or("a frame has `right` or `left`, a building an angle", "right", "left")
]


class WavePassage(Model):
    """The ground motion reaches the lines of columns one after the other.

    Attributes:
        velocity: apparent velocity of the wave along its direction; this key or `delays`.
        direction: of propagation, of a building the angle from x towards y; only with `velocity`.
        delays: delay of the motion by column line, of a building by selections of them.
    """

    velocity: PositiveVelocity | None = None
    direction: Propagation | None = None
    delays: Annotated[dict[str, Duration], Field(min_length=1)] | None = None

    def delays_of(self, grid: Grid) -> dict[str, float]:
        """Return the delay of each line of columns, s; the wave reaches the first one at 0 s.

        Args:
            grid: of the frame or building.
        """
        if self.velocity is None:
            named = {line: delay for name, delay in (self.delays or {}).items() for line in grid.lines_in(name)}
            return {line: named.get(line, 0.0) for line in grid.lines}
        if isinstance(self.direction, float):
            way: tuple[float, ...] = (math.cos(self.direction), math.sin(self.direction))
        else:
            way = _WAYS[self.direction or "right"]
        along = {line: sum(c * x for c, x in zip(way, grid.line_place(line), strict=False)) for line in grid.lines}
        first = min(along.values())
        return {line: (x - first) / self.velocity for line, x in along.items()}
