"""A parameter with its bounds and prior, and the standardised coordinate that a search moves in its place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_FARTHEST = 10.0
"""Prior standard deviations beyond which no value is searched: the prior there is below 1e-21 of that at its centre."""
_LARGEST = 600.0  # logarithm: exp of it is still a number


@dataclass(frozen=True)
class Parameter:
    """A parameter of a model.

    Its prior is normal, of the value or of its logarithm. The coordinate z is standardised by it: z ~ N(0, 1).

    Attributes:
        name: as in the page of the law or effect.
        unit: SI, "" without dimension.
        lower, upper: bounds of the value, SI.
        centre: mean (of a logarithmic parameter: median) of the prior, SI.
        spread: standard deviation of the prior, SI, of a logarithmic parameter that of its natural logarithm.
        logarithmic: whether the logarithm is normal: a positive parameter whose order of magnitude is not known.
        flat: whether nothing is known but the bounds: centre and spread are then the origin and unit of the coordinate.
        whole: whether it is a share of a whole: at its upper bound, all of it, the model is as right as below.
    """

    name: str
    unit: str
    lower: float
    upper: float
    centre: float
    spread: float
    logarithmic: bool = False
    flat: bool = False
    whole: bool = False

    def __post_init__(self) -> None:
        finite = math.isfinite(self.centre) and 0.0 < self.spread < math.inf
        if not (finite and self.lower < self.upper and (min(self.centre, self.upper) > 0.0 or not self.logarithmic)):
            raise ValueError(
                f"{self.name}: bounds {self.lower:g} to {self.upper:g}, centre {self.centre:g}, spread {self.spread:g}"
            )

    def coordinate(self, value: float) -> float:
        """Return the coordinate of a value, SI, which is moved inside the bounds."""
        low, high = self.range
        return min(max(self._coordinate(value), low), high)

    def value(self, coordinate: float) -> float:
        """Return the value, SI, of a coordinate, moved inside the bounds."""
        far = self.spread * coordinate
        found = self.centre * math.exp(min(far, _LARGEST)) if self.logarithmic else self.centre + far
        return min(max(found, self.lower), self.upper)

    @property
    def range(self) -> tuple[float, float]:
        """Bounds of the coordinate; a logarithm is searched ten prior standard deviations about its centre at most."""
        low, high = self._coordinate(self.lower), self._coordinate(self.upper)
        if self.logarithmic:
            middle = min(max(0.0, low), high)  # the centre may lie beyond a bound
            far = _LARGEST / self.spread if self.flat else _FARTHEST
            low, high = max(low, middle - far), min(high, middle + far)
        return low, high

    def _coordinate(self, value: float) -> float:
        if not self.logarithmic:
            return (value - self.centre) / self.spread
        return math.log(value / self.centre) / self.spread if value > 0.0 else -math.inf


def priors_of(parameters: Sequence[Parameter]) -> np.ndarray:
    """Return the precision (p,) of the prior of each coordinate: 1, or 0 of a flat one."""
    return np.array([0.0 if one.flat else 1.0 for one in parameters])


def values_of(parameters: Sequence[Parameter], coordinates: np.ndarray) -> np.ndarray:
    """Return values (p,), SI, of coordinates (p,)."""
    return np.array([one.value(float(z)) for one, z in zip(parameters, coordinates, strict=True)])


def coordinates_of(parameters: Sequence[Parameter], values: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return coordinates (p,) of values (p,), SI."""
    return np.array([one.coordinate(float(value)) for one, value in zip(parameters, values, strict=True)])


def ranges_of(parameters: Sequence[Parameter]) -> tuple[np.ndarray, np.ndarray]:
    """Return lower and upper bounds (p,) of the coordinates."""
    both = np.array([one.range for one in parameters]).reshape(-1, 2)
    return both[:, 0], both[:, 1]
