"""Wave passage: when the ground motion reaches the lines of columns."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import Duration, PositiveVelocity
from edesign.project.reading.base import Model


class WavePassage(Model):
    """The ground motion reaches the lines of columns one after the other.

    Attributes:
        velocity: apparent velocity of the wave along the frame; this key or `delays`.
        direction: of propagation; only with `velocity`.
        delays: delay of the motion by column line.
    """

    velocity: PositiveVelocity | None = None
    direction: Literal["right", "left"] | None = None
    delays: Annotated[dict[str, Duration], Field(min_length=1)] | None = None

    def delays_of(self, lines: Mapping[str, float]) -> dict[str, float]:
        """Return the delay of each line, s, from the places of lines, m; the wave reaches the first one at 0 s."""
        if self.velocity is None:
            given = self.delays or {}
            return {line: given.get(line, 0.0) for line in lines}
        first = min(lines.values()) if self.direction != "left" else max(lines.values())
        return {line: abs(x - first) / self.velocity for line, x in lines.items()}
