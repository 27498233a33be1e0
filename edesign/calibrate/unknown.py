"""An unknown of the loop: a parameter of a law or of an effect, and the number that a search moves in its place."""

from __future__ import annotations

import math
from dataclasses import dataclass

_FARTHEST = 1e6  # from its size, up and down, where there is no bound
_STEP = 1e-3  # of differences: errors of the law's integration (1e-8) vanish beside it


@dataclass(frozen=True)
class Unknown:
    """A parameter to be found.

    Attributes:
        name: as in the page of the law or effect.
        unit: SI, "" without dimension.
        lower, upper: of the value, SI.
        size: of a typical value, SI; the search moves value / size, or its logarithm.
        logarithmic: whether it moves the logarithm: a positive parameter of unknown order of magnitude.
    """

    name: str
    unit: str
    lower: float
    upper: float
    size: float
    logarithmic: bool = False

    def __post_init__(self) -> None:
        if not (self.lower < self.upper and self.size > 0.0):
            raise ValueError(f"{self.name}: bounds {self.lower:g} to {self.upper:g}, size {self.size:g}")

    def coordinate(self, value: float) -> float:
        """The number that the search moves, of a value."""
        inside = min(max(value, self.lower), self.upper)
        return math.log(max(inside / self.size, 1.0 / _FARTHEST)) if self.logarithmic else inside / self.size

    def value(self, coordinate: float) -> float:
        """The value of a coordinate, inside the bounds."""
        found = self.size * (math.exp(min(coordinate, 40.0)) if self.logarithmic else coordinate)
        return min(max(found, self.lower), self.upper)

    @property
    def span(self) -> tuple[float, float]:
        """Bounds of the coordinate."""
        if not self.logarithmic:
            return self.lower / self.size, self.upper / self.size
        low = math.log(self.lower / self.size) if self.lower > 0.0 else -math.log(_FARTHEST)
        return low, math.log(self.upper / self.size) if math.isfinite(self.upper) else math.log(_FARTHEST)

    def slope(self, coordinate: float) -> float:
        """d value / d coordinate."""
        return self.value(coordinate) if self.logarithmic else self.size

    def step(self, coordinate: float) -> float:
        """Step of differences about a coordinate, into the bounds."""
        step = _STEP if self.logarithmic else _STEP * max(abs(coordinate), 0.1)
        return step if coordinate + step <= self.span[1] else -step
