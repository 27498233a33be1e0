"""Response spectra as tables of the user: uniform hazard, conditional mean, site response, multi-period spectra."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Literal, Self

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.asce7.spectrum import damping_coefficient
from edesign.codes.ec8.action.branches import checked_periods, displacement_of
from edesign.codes.ec8.action.elastic import SMALLEST_CORRECTION, damping_correction
from edesign.codes.interpolation import log_log
from edesign.codes.motion_sets import SetRules
from edesign.errors import InputError

Interpolation = Literal["log-log", "linear"]
Correction = Literal["ec8", "asce7"]


@dataclass(frozen=True)
class CorrectionLaw:
    """Law by which the ordinates of a code change with damping.

    Attributes:
        factor: on the ordinates of 5 % damping, of a ratio of critical.
        title: for people.
    """

    factor: Callable[[float], float]
    title: str


CORRECTIONS: Mapping[Correction, CorrectionLaw] = MappingProxyType(
    {
        "ec8": CorrectionLaw(damping_correction, "eta of EN 1998-1, 3.2.2.2(3)"),
        "asce7": CorrectionLaw(lambda damping: 1.0 / damping_coefficient(damping), "1/B of ASCE/SEI 7, Table 18.7-1"),
    }
)
"""By the name that a project file gives them."""


@dataclass(frozen=True)
class TabulatedSpectrum:
    """A response spectrum by its ordinates; there is none beyond the last period.

    Between the rows S_e goes as a power of T (`log-log`) or as a straight line (`linear`). From period zero to the
    first period after it, where a power has no sense, it goes as a straight line in both.

    With a `correction` there are ordinates S' of another damping. From the period of the largest ordinate S_max on
    S' = r S, r the factor of this damping over that of the table. Before it the peak ground acceleration S(0) stays:
    S' = S(0) + (S - S(0)) (r S_max - S(0)) / (S_max - S(0)), and S' = S where S is less than S(0). Of a spectrum whose
    first branch is straight this is the one that EN 1998-1, Eqs. 3.2 to 3.5, or ASCE/SEI 41-17, 2.4.1.7.1, has of that
    damping.

    Attributes:
        periods: rising from 0, shape (n,), n >= 2, s.
        ordinates: pseudo-accelerations above zero, shape (n,), m/s2; the first is the peak ground acceleration.
        damping: ratio of critical of the oscillators.
        rules: for a set of motions.
        interpolation: between the rows.
        factor: on the ordinates.
        label: for plots and tables.
        correction: how the ordinates change with damping; None: they hold for one alone.
        corner_period: T_C, the end of the branch of constant acceleration, s; None: not known.
        tabulated: ratio of critical that the ordinates hold for; None: `damping`.
    """

    periods: tuple[float, ...]
    ordinates: tuple[float, ...]
    damping: float
    rules: SetRules
    interpolation: Interpolation = "log-log"
    factor: float = 1.0
    label: str = "spectrum of the user"
    correction: Correction | None = None
    corner_period: float | None = None
    tabulated: float | None = None

    def __post_init__(self) -> None:
        T, S = np.array(self.periods), np.array(self.ordinates)
        if T.size != S.size:
            raise InputError(f"there are {T.size} periods and {S.size} ordinates; each period has one [E-CURVE-01]")
        if T.size < 2:
            raise InputError("a spectrum has two periods at least: zero, and the last one [E-CURVE-01]")
        if T[0] != 0.0:
            raise InputError(
                f"the first period is {T[0]:g} s; the table begins at 0 s, with the peak ground acceleration"
                " [E-CURVE-01]"
            )
        if not (np.all(np.isfinite(T)) and np.all(np.isfinite(S))):
            raise InputError("periods and ordinates must be finite [E-CURVE-01]")
        falling = np.flatnonzero(np.diff(T) <= 0.0)
        if falling.size:
            i = int(falling[0]) + 1
            raise InputError(f"the period {T[i]:g} s stands after {T[i - 1]:g} s; periods rise [E-CURVE-01]")
        if np.any(S <= 0.0):
            raise InputError(f"the ordinate at {T[np.argmax(S <= 0.0)]:g} s must be greater than zero [E-CURVE-01]")
        peak = float(T[np.argmax(S)])
        if self.corner_period is not None and not peak <= self.corner_period <= T[-1]:
            raise InputError(
                f"corner_period: {self.corner_period:g} s is not between the largest ordinate, at {peak:g} s, and the "
                f"last period, {T[-1]:g} s; T_C ends the branch of constant acceleration [E-CURVE-02]"
            )
        if self.correction is not None:
            self._check_correction(peak)

    def _check_correction(self, peak: float) -> None:
        if peak == 0.0:
            raise InputError(
                "the largest ordinate is that at 0 s, which no damping changes; `damping_correction` needs larger ones"
                " [E-CURVE-04]"
            )
        damping = self._table_damping
        if self.correction == "ec8" and damping_correction(damping) <= SMALLEST_CORRECTION:
            raise InputError(
                f"eta of EN 1998-1, 3.2.2.2(3), is {SMALLEST_CORRECTION:g} for {100.0 * damping:g} % damping and for "
                "all above; `damping_correction` does not lead from there to less [E-CURVE-04]"
            )

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
        """Corner period T_C, s, where it is known."""
        return {} if self.corner_period is None else {"T_C": self.corner_period}

    @property
    def set_rules(self) -> SetRules:
        """Rules of the code that the user names."""
        return self.rules

    def with_damping(self, damping: float) -> Self:
        """Return the spectrum of the same action for another ratio of critical damping.

        Raises:
            InputError: the table is of another damping, and has no correction; or the ratio is not between 0 and 1.
        """
        if math.isclose(damping, self.damping, rel_tol=1e-9):
            return self
        if self.correction is None:
            raise InputError(
                f"{self.label} is a table for {100.0 * self.damping:g} % damping; what it would be for "
                f"{100.0 * damping:g} % is not known, unless `damping_correction` says how it changes [E-CURVE-04]"
            )
        CORRECTIONS[self.correction].factor(damping)
        return replace(self, damping=damping, tabulated=self._table_damping)

    @property
    def _table_damping(self) -> float:
        return self.damping if self.tabulated is None else self.tabulated

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        """Return S_e(T), m/s2, in the shape of `period` (s).

        Args:
            period: s, of any shape; not negative.

        Raises:
            InputError: a period is negative, not finite, or beyond the table.
        """
        T = checked_periods(period)
        beyond = T[self.last_period < T]
        if beyond.size:
            raise InputError(
                f"{self.label} ends at {self.last_period:g} s; it has no ordinate at {beyond.flat[0]:g} s [E-CURVE-03]"
            )
        known, S = np.array(self.periods), np.array(self.ordinates)
        linear = np.interp(T, known, S)
        if self.interpolation == "linear" or known.size == 2:  # one point has no line
            return self.factor * self._corrected(T, linear)
        inner = np.maximum(T, known[1])  # without a logarithm of zero
        power = log_log(inner, known[1:], S[1:])
        return self.factor * self._corrected(T, np.where(known[1] > T, linear, power))

    def _corrected(self, period: np.ndarray, ordinates: np.ndarray) -> np.ndarray:
        """Return the ordinates (m/s2) of the table at periods (s) as they are for the damping of the oscillators."""
        if self.correction is None or self.tabulated is None:
            return ordinates
        law = CORRECTIONS[self.correction].factor
        ratio = law(self.damping) / law(self.tabulated)
        start, peak = self.ordinates[0], max(self.ordinates)
        slope = (ratio * peak - start) / (peak - start)
        rising = ordinates + np.maximum(ordinates - start, 0.0) * (slope - 1.0)
        return np.where(period < self.periods[int(np.argmax(self.ordinates))], rising, ratio * ordinates)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        """Return the displacement, m, in the shape of `period` (s): S_e (T / 2 pi)2.

        Args:
            period: s, of any shape; not negative.
        """
        return displacement_of(self.acceleration(period), period)
