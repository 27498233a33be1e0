"""Response spectra as tables of the user: uniform hazard, conditional mean, site response, multi-period spectra."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.branches import checked_periods, displacement_of
from edesign.codes.interpolation import log_log
from edesign.codes.motion_sets import SetRules
from edesign.errors import InputError

Interpolation = Literal["log-log", "linear"]


@dataclass(frozen=True)
class TabulatedSpectrum:
    """A response spectrum by its ordinates; there is none beyond the last period.

    Between the rows S_e goes as a power of T (`log-log`) or as a straight line (`linear`). From period zero to the
    first period after it, where a power has no sense, it goes as a straight line in both.

    Attributes:
        periods: rising from 0, shape (n,), n >= 2, s.
        ordinates: pseudo-accelerations above zero, shape (n,), m/s2; the first is the peak ground acceleration.
        damping: ratio of critical for which they hold.
        rules: for a set of motions.
        interpolation: between the rows.
        factor: on the ordinates.
        label: for plots and tables.
    """

    periods: tuple[float, ...]
    ordinates: tuple[float, ...]
    damping: float
    rules: SetRules
    interpolation: Interpolation = "log-log"
    factor: float = 1.0
    label: str = "spectrum of the user"

    def __post_init__(self) -> None:
        T, S = np.array(self.periods), np.array(self.ordinates)
        if T.size != S.size:
            raise InputError(f"there are {T.size} periods and {S.size} ordinates; each period has one")
        if T.size < 2:
            raise InputError("a spectrum has two periods at least: zero, and the last one")
        if T[0] != 0.0:
            raise InputError(
                f"the first period is {T[0]:g} s; the table begins at 0 s, with the peak ground acceleration"
            )
        if not (np.all(np.isfinite(T)) and np.all(np.isfinite(S))):
            raise InputError("periods and ordinates must be finite")
        falling = np.flatnonzero(np.diff(T) <= 0.0)
        if falling.size:
            i = int(falling[0]) + 1
            raise InputError(f"the period {T[i]:g} s stands after {T[i - 1]:g} s; periods rise")
        if np.any(S <= 0.0):
            raise InputError(f"the ordinate at {T[np.argmax(S <= 0.0)]:g} s must be greater than zero")

    @property
    def zero_period(self) -> float:
        """The ordinate at period zero, m/s2."""
        return self.factor * self.ordinates[0]

    @property
    def last_period(self) -> float:
        """The last period of the table, s."""
        return self.periods[-1]

    @property
    def corners(self) -> Mapping[str, float]:
        """None."""
        return {}

    @property
    def set_rules(self) -> SetRules:
        """Those of the code that the user names."""
        return self.rules

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum itself; a table says nothing of another damping.

        Raises:
            InputError: the table is of another damping.
        """
        if not math.isclose(damping, self.damping, rel_tol=1e-9):
            raise InputError(
                f"{self.label} is a table for {100.0 * self.damping:g} % damping; what it would be for "
                f"{100.0 * damping:g} % is not known"
            )
        return self

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_e(T), m/s2, in the shape of `period` (s).

        Raises:
            InputError: a period is negative, not finite, or beyond the table.
        """
        T = checked_periods(period)
        beyond = T[self.last_period < T]
        if beyond.size:
            raise InputError(f"{self.label} ends at {self.last_period:g} s; it has no ordinate at {beyond.flat[0]:g} s")
        known, S = np.array(self.periods), np.array(self.ordinates)
        linear = np.interp(T, known, S)
        if self.interpolation == "linear" or known.size == 2:  # one point has no line
            return self.factor * linear
        inner = np.maximum(T, known[1])  # without a logarithm of zero
        power = log_log(inner, known[1:], S[1:])
        return self.factor * np.where(known[1] > T, linear, power)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period` (s): S_e (T / 2 pi)2."""
        return displacement_of(self.acceleration(period), period)
