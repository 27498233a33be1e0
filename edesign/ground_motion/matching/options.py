"""What a user may choose when a record is matched to a spectrum."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean

Method = Literal["wavelets", "frequency", "scale"]
METHODS: tuple[Method, ...] = ("wavelets", "frequency", "scale")


@dataclass(frozen=True)
class MatchOptions:
    """Settings of spectrum matching.

    Attributes:
        method: wavelets added in the time domain, a factor on the Fourier spectrum (the thesis' method), or the
            constant factor alone, which leaves the shape as it was recorded.
        periods: shortest and longest period of the band to match, s.
        damping: ratio to critical of spectrum and target.
        points: number of matching periods, spaced evenly in log period over the band, ends included.
        iterations: the most iterations.
        tolerance: root mean square of psa/target - 1 over the matching periods at which the iteration ends.
        scale_bounds: least and largest constant factor on the record before its shape is changed.
        factor: this constant factor instead of the one that fits best; None looks for that.

    Raises:
        InputError: a value out of range; the message names it.
    """

    method: Method = "wavelets"
    periods: tuple[float, float] = (0.05, 6.0)
    damping: float = 0.05
    points: int = 100
    iterations: int = 30
    tolerance: float = 0.01
    scale_bounds: tuple[float, float] = (0.1, 10.0)
    factor: float | None = None

    def __post_init__(self) -> None:
        if self.method not in METHODS:
            hint = did_you_mean(str(self.method), METHODS)
            raise InputError(
                f"matching: there is no method `{self.method}`{hint} (methods: {', '.join(METHODS)}) [E-VALUE-03]"
            )
        _positive_pair("periods", self.periods, " s", equal=False)
        _positive_pair("scale_bounds", self.scale_bounds, "", equal=True)
        if self.factor is not None and not (math.isfinite(self.factor) and self.factor > 0.0):
            raise InputError(f"matching: factor must be greater than zero and finite, not {self.factor:g} [E-VALUE-02]")
        if not 0.0 < self.damping < 1.0:
            raise InputError(f"matching: damping must lie between 0 and 1, not {self.damping:g} [E-VALUE-02]")
        if self.points < 2:
            raise InputError(
                f"matching: at least two points (matching periods) are needed, not {self.points} [E-VALUE-02]"
            )
        if self.iterations < 1:
            raise InputError(f"matching: at least one of iterations is needed, not {self.iterations} [E-VALUE-02]")
        if not (math.isfinite(self.tolerance) and self.tolerance > 0.0):
            raise InputError(f"matching: tolerance must be greater than zero, not {self.tolerance:g} [E-VALUE-02]")

    @property
    def matching_periods(self) -> np.ndarray:
        """The matching periods, increasing, shape (points,), s."""
        return np.geomspace(*self.periods, self.points)


def _positive_pair(key: str, pair: tuple[float, float], unit: str, equal: bool) -> None:
    if len(pair) != 2:
        raise InputError(f"matching: {key} needs two values, not {len(pair)} [E-VALUE-01]")
    low, high = pair
    if not (math.isfinite(low) and math.isfinite(high) and low > 0.0 and high > 0.0):
        raise InputError(
            f"matching: {key} must be greater than zero and finite, not {low:g} and {high:g}{unit} [E-VALUE-02]"
        )
    if low > high or (low == high and not equal):
        raise InputError(f"matching: {key} must increase; {low:g}{unit} stands before {high:g}{unit} [E-VALUE-04]")
