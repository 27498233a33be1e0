"""From the parameters of a law to the numbers a search moves, and back."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Parameter
from edesign.errors import InputError

ABOVE = {"fractional_zener": {"b": "a"}, "chaboche": {"gamma1": "gamma2"}}
"""Parameters that must exceed another one of their law, or may change places with it."""

_FARTHEST = 1e6  # a positive parameter is searched so far from the size the data suggest, up and down
_INSIDE = 1e-6  # distance kept from a bound that is not allowed itself
_STEP = 1e-3  # of differences, in the units of the search: errors of the law's integration (1e-6) vanish beside it

Bounds = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class Axis:
    """One unknown.

    Attributes:
        parameter: of the law, or an unknown of the temperature.
        lower, upper: of the parameter, in SI; those of the law narrowed by the user.
        lower_allowed, upper_allowed: whether the value may be the bound itself.
        logarithmic: whether the search moves its logarithm.
        fixed_scale: whether its size must not follow an exponent: bounds hold for the parameter itself.
    """

    parameter: Parameter
    lower: float
    upper: float
    lower_allowed: bool
    upper_allowed: bool
    logarithmic: bool
    fixed_scale: bool


class Coordinates:
    """Free parameters as coordinates of a search: dimensionless, logarithms of those that are positive.

    A coefficient with an exponent in its unit, c |v|^alpha, is searched as its force at the typical velocity of the
    tests, which data determine almost independently of the exponent.

    Args:
        parameters: all of the law, and further unknowns.
        start: all values, SI.
        scales: sizes in the tests.
        bounds: narrower than the law's own, SI, by name.
        above: parameters that must exceed another one, by name.
        held: all parameters with those that others hold, of all of them.

    Raises:
        InputError: a bound is of no free parameter, is empty, or is outside the law's; a start is outside the bounds.
    """

    def __init__(
        self,
        parameters: Sequence[Parameter],
        free: Sequence[str],
        start: Mapping[str, float],
        scales: Scales,
        bounds: Bounds | None = None,
        above: Mapping[str, str] | None = None,
        held: Callable[[Mapping[str, float]], dict[str, float]] = dict,
    ) -> None:
        given = dict(bounds or {})
        self.names = tuple(free)
        self.start = dict(start)
        self.bounded = bool(given)
        self.scales = scales
        self._held = held
        self.above = {name: other for name, other in (above or {}).items() if name in self.names}
        known = {parameter.name: parameter for parameter in parameters}
        for name in given:
            if name not in self.names:
                raise InputError(
                    f"bounds of `{name}`: it is not fitted (fitted are: {', '.join(self.names)}) [E-FIT-03]"
                )
        self.axes = tuple(_axis(known[name], given.get(name), name in self.above) for name in self.names)
        for axis in self.axes:
            value = self.start[axis.parameter.name]
            if not axis.lower <= value <= axis.upper:
                raise InputError(
                    f"start of `{axis.parameter.name}`: {value:g} {axis.parameter.unit} is outside its bounds "
                    f"{axis.lower:g} to {axis.upper:g} [E-FIT-03]"
                )

    def values(self, x: np.ndarray) -> dict[str, float]:
        """Return all parameters, SI, of the free ones' coordinates.

        Args:
            x: (n,) coordinates.
        """
        found = dict(self.start)
        for axis, place in self._in_order(x):
            found[axis.parameter.name] = self._value(axis, place, found)
        return self._held(found)

    def at(self, values: Mapping[str, float]) -> np.ndarray:
        """Return the coordinates (n,) of parameters, moved inside the bounds.

        Args:
            values: parameters by name, SI.
        """
        x = np.empty(len(self.axes))
        for i, axis in enumerate(self.axes):
            name = axis.parameter.name
            relative = (values[name] - self._floor(axis, values)) / self._scale(axis, values)
            x[i] = math.log(max(relative, 1e-300)) if axis.logarithmic else relative
        return np.clip(x, self.lower, self.upper)

    @cached_property
    def lower(self) -> np.ndarray:
        """Lower bounds (n,) of the search."""
        return np.array([self._bound(axis, axis.lower, axis.lower_allowed, -1.0) for axis in self.axes])

    @cached_property
    def upper(self) -> np.ndarray:
        """Upper bounds (n,) of the search."""
        return np.array([self._bound(axis, axis.upper, axis.upper_allowed, 1.0) for axis in self.axes])

    def steps(self, x: np.ndarray) -> np.ndarray:
        """Return the steps (n,) for differences about a point.

        Args:
            x: (n,) coordinates.
        """
        return np.array(
            [_STEP if axis.logarithmic else _STEP * max(abs(v), 0.1) for axis, v in zip(self.axes, x, strict=True)]
        )

    def is_bound(self, name: str, value: float) -> bool:
        """Say whether a value is at a bound of the law or the user, not at an end that the search has without one.

        Args:
            name: of the parameter.
            value: SI.
        """
        axis = self.axes[self.names.index(name)]
        scale = self._scale(axis, self.start)
        return any(
            math.isfinite(bound)
            and (bound > 0.0 or not axis.logarithmic)
            and abs(value - bound) <= 2.0 * _INSIDE * max(scale, abs(bound))
            for bound in (axis.lower, axis.upper)
        )

    def slopes(self, x: np.ndarray) -> np.ndarray:
        """Return the derivatives (n, n) of the free parameters (rows) to the coordinates (columns).

        Args:
            x: (n,) coordinates.
        """
        matrix = np.empty((len(self.axes), len(self.axes)))
        for j in range(len(self.axes)):
            step = np.zeros(len(self.axes))
            step[j] = 1e-6 * max(1.0, abs(x[j]))
            high, low = self.values(x + step), self.values(x - step)
            matrix[:, j] = [(high[name] - low[name]) / (2.0 * step[j]) for name in self.names]
        return matrix

    def _in_order(self, x: np.ndarray) -> list[tuple[Axis, float]]:
        """Exponents and floors before what needs them."""
        pairs = list(zip(self.axes, x.tolist(), strict=True))
        return sorted(pairs, key=lambda pair: (bool(pair[0].parameter.unit), pair[0].parameter.name in self.above))

    def _scale(self, axis: Axis, values: Mapping[str, float]) -> float:
        return self.scales.of(axis.parameter.unit, self.start if axis.fixed_scale else values)

    def _floor(self, axis: Axis, values: Mapping[str, float]) -> float:
        other = self.above.get(axis.parameter.name)
        return values[other] if other else 0.0

    def _value(self, axis: Axis, place: float, values: Mapping[str, float]) -> float:
        relative = math.exp(place) if axis.logarithmic else place
        value = self._floor(axis, values) + relative * self._scale(axis, values)
        lowest = axis.lower if axis.lower_allowed else math.nextafter(axis.lower, math.inf)
        highest = axis.upper if axis.upper_allowed else math.nextafter(axis.upper, -math.inf)
        return min(max(value, lowest), highest)

    def _bound(self, axis: Axis, value: float, allowed: bool, side: float) -> float:
        scale = self._scale(axis, self.start)
        if axis.logarithmic:
            limit = side * math.log(_FARTHEST)
            here = math.log(max(self.start[axis.parameter.name] - self._floor(axis, self.start), 1e-300) / scale)
            if value <= 0.0 or math.isinf(value):  # nothing but the farthest place, wider if the start is far out
                return min(limit, here - 1.0) if side < 0.0 else max(limit, here + 1.0)
            return math.log(value / scale) - (0.0 if allowed else side * _INSIDE)
        return value / scale if allowed or math.isinf(value) else value / scale - side * _INSIDE


def _axis(parameter: Parameter, given: tuple[float, float] | None, has_floor: bool) -> Axis:
    lower, upper = parameter.lower, parameter.upper
    lower_allowed, upper_allowed = parameter.lower_allowed, parameter.upper_allowed
    if given is not None:
        if not (given[0] < given[1] and given[0] >= lower and given[1] <= upper):
            raise InputError(
                f"bounds of `{parameter.name}`: {given[0]:g} to {given[1]:g} is no range inside what the law allows: "
                f"{parameter.allowed} [E-FIT-03]"
            )
        lower_allowed = lower_allowed if given[0] == lower else True
        upper_allowed = upper_allowed if given[1] == upper else True
        lower, upper = float(given[0]), float(given[1])
    positive = lower > 0.0 or (lower == 0.0 and not lower_allowed)
    logarithmic = positive and (math.isinf(upper) or lower > 0.0 or given is not None)
    return Axis(parameter, lower, upper, lower_allowed, upper_allowed, logarithmic or has_floor, given is not None)
