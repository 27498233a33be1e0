"""What a code asks of a set of ground motions that stands for a spectrum: their number, and their mean spectrum."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.rule_check import ROUNDING, RuleCheck
from edesign.errors import InputError

if TYPE_CHECKING:
    from edesign.codes.spectrum import Spectrum

DAMPING = 0.05
"""Ratio of critical damping of the spectra that are compared, in all codes here."""

FOR_MEAN = "number of histories for which the mean response counts"
"""What the criterion on the use of responses says."""
STATIONARY_DURATION = 10.0
"""Least duration of the stationary part of artificial motions (EN 1998-1, 3.2.3.1.2(3); NTC 2018, 3.2.3.6), s."""

_WIDEST_STEP = 1.05  # of neighbouring periods: a coarser grid could step over a valley of the mean spectrum


@dataclass(frozen=True)
class SetClauses:
    """Clauses of the rules for a set; empty for a rule that the code does not have.

    Attributes:
        number: least number of motions.
        zero_period: mean peak acceleration.
        mean: mean spectrum.
        stationary: shortest stationary part of artificial motions.
        use: from how many motions on the mean of the responses counts.
    """

    number: str
    mean: str
    use: str
    zero_period: str = ""
    stationary: str = ""


@dataclass(frozen=True)
class PairRule:
    """What a code compares of pairs of horizontal components that act on a model in space.

    Attributes:
        compared: the components along each direction of the building, for T_1 of that direction, or the largest
            ordinate of each pair over all directions.
        clauses: of the rule.
        text: the rule for people.
        orientation: clause by which neither direction may have the stronger components; empty without such a rule.
        tolerance: by which the mean spectrum along a direction may differ from that of all components.
    """

    compared: Literal["each direction", "maximum direction"] = "each direction"
    clauses: str = ""
    text: str = "the components along each direction are a set of their own, for T_1 of that direction"
    orientation: str = ""
    tolerance: float = 0.0


@dataclass(frozen=True)
class SetCheck:
    """All criteria of a set.

    Attributes:
        criteria: one for each rule.
        worst_period: where the ratio of mean to target spectrum is lowest, s; None where T_1 is not known.
        worst_ratio: that ratio.
    """

    criteria: tuple[RuleCheck, ...]
    worst_period: float | None
    worst_ratio: float | None

    @property
    def passed(self) -> bool | None:
        """True if all criteria that apply hold; None where none fails but the mean spectrum could not be checked."""
        if self.failed:
            return False
        return None if self.worst_ratio is None else True

    @property
    def failed(self) -> tuple[RuleCheck, ...]:
        """The criteria that fail."""
        return tuple(criterion for criterion in self.criteria if criterion.passed is False)


@dataclass(frozen=True)
class SetRules:
    """Rules of a code for a set of motions of one direction.

    Attributes:
        code: its title, for tables.
        clauses: of the rules.
        least_number: of motions.
        number_for_mean: of motions from which on the mean of the responses counts.
        band: ends of the band of periods, in multiples of T_1; a first multiple of 0 leaves `shortest` alone.
        shortest: the band begins at this period at the latest, s; infinite where the code names none.
        longest: the band ends at this period at the earliest, s; 0 where the code names none.
        least_ratio: of mean to target spectrum in the band.
        greatest_ratio: of the same; None where the code has no such limit.
        least_ratio_matched: of sets whose motions were fitted in shape; None: as `least_ratio`.
        fewer: what holds with fewer motions than `number_for_mean`.
        note: what is said of the mean spectrum: assumptions on a plane frame.
        pairs: what is compared of pairs on a model in space.
    """

    code: str
    clauses: SetClauses
    least_number: int
    number_for_mean: int
    band: tuple[float, float]
    least_ratio: float
    shortest: float = math.inf
    longest: float = 0.0
    greatest_ratio: float | None = None
    least_ratio_matched: float | None = None
    fewer: str = "the most unfavourable response counts"
    note: str = ""
    pairs: PairRule = PairRule()

    @property
    def has_zero_period(self) -> bool:
        """True if the mean peak acceleration must reach that of the spectrum."""
        return bool(self.clauses.zero_period)

    def of(self, matched: bool) -> SetRules:
        """Return the rules for motions that were fitted in shape, or only scaled."""
        if not matched or self.least_ratio_matched is None:
            return self
        return replace(self, least_ratio=self.least_ratio_matched)

    def over(self, first_periods: Sequence[float]) -> tuple[SetRules, float]:
        """Return the rules with one band for all directions of a structure, and the T_1 with which it ends.

        Args:
            first_periods: of a plane frame one; of a building those along x and y, s.
        """
        longest = max(first_periods)
        if len(first_periods) == 1:
            return self, longest
        low, high = self.band
        start = low * min(first_periods) if math.isinf(self.shortest) else self.shortest
        note = f"from {low:g} times the shorter first period; T_1 is the longer one"
        return replace(self, band=(0.0, high), shortest=start, note=note), longest

    @property
    def band_text(self) -> str:
        """The ends of the band for people: `0.2 T_1 to 2 T_1`."""
        low, high = (f"{multiple:g} T_1" for multiple in self.band)
        first = low if math.isinf(self.shortest) else f"{self.shortest:g} s"
        return f"{first} to {high}" if self.longest == 0.0 else f"{first} to {high}, at least {self.longest:g} s"

    def period_band(self, T_1: float) -> tuple[float, float]:
        """Return the ends of the band of periods, s.

        Args:
            T_1: fundamental period, s.

        Returns:
            Shortest and longest period, s.

        Raises:
            InputError: T_1 is not greater than zero.
        """
        if not (math.isfinite(T_1) and T_1 > 0.0):
            raise InputError(f"the fundamental period T_1 must be greater than zero, not {T_1:g} s [E-VALUE-02]")
        low = self.band[0] * T_1 if math.isinf(self.shortest) else self.shortest
        return low, max(self.band[1] * T_1, self.longest)

    def check_periods(self, T_1: float, points: int = 201) -> np.ndarray:
        """Return periods for `check`: logarithmic over the band, ends included.

        Args:
            T_1: fundamental period in the direction of the motions, s.
            points: how many; of a band from 0.2 T_1 to 2 T_1 201 are 1.2 % apart.

        Returns:
            shape (points,), s.

        Raises:
            InputError: the period is not greater than zero, or the grid would be coarser than 5 %.
        """
        low, high = self.period_band(T_1)
        periods = np.geomspace(low, high, points)
        if points < 2 or periods[1] / periods[0] > _WIDEST_STEP:
            raise InputError(f"{points} points from {low:g} s to {high:g} s are more than 5 % apart [E-EC8-07]")
        return periods

    def missing(self, target: Spectrum, T_1: float | None) -> str:
        """Return why the mean spectrum cannot be compared with a target; "" if it can.

        Args:
            T_1: fundamental period, s; None: it is not known.
        """
        if T_1 is None:
            return "T_1 is not known"
        _, high = self.period_band(T_1)
        if high > target.last_period * (1.0 + ROUNDING):
            return f"the target ends at {target.last_period:g} s, before the {high:.3g} s of the band"
        return ""

    def in_band(self, periods: np.ndarray, T_1: float) -> np.ndarray:
        """Return which periods count for the mean spectrum, shape of `periods`, bool.

        Args:
            periods: (n,) s, rising.
            T_1: fundamental period, s.

        Raises:
            InputError: the periods do not rise, do not reach both ends of the band, or are more than 5 % apart in it.
        """
        low, high = self.period_band(T_1)
        if periods.ndim != 1 or periods.size < 2 or np.any(np.diff(periods) <= 0.0):
            raise InputError("the periods must be a rising list [E-EC8-07]")
        inside = (periods >= low * (1.0 - ROUNDING)) & (periods <= high * (1.0 + ROUNDING))
        chosen = periods[inside]
        covered = chosen.size > 1 and chosen[0] <= low * (1.0 + ROUNDING) and chosen[-1] >= high * (1.0 - ROUNDING)
        if not covered or np.max(chosen[1:] / chosen[:-1]) > _WIDEST_STEP * (1.0 + ROUNDING):
            raise InputError(
                f"the check needs periods from {low:g} s to {high:g} s ({self.band_text}), ends included, at most 5 % "
                "apart (`check_periods` makes them) [E-EC8-07]"
            )
        return inside

    def check(
        self,
        periods: ArrayLike,
        spectra: ArrayLike,
        pgas: ArrayLike,
        target: Spectrum,
        T_1: float | None,
        artificial_durations: Sequence[float] | None = None,
    ) -> SetCheck:
        """Check a set of motions of one direction.

        Args:
            periods: shape (n_T,), s, rising; must hold a dense grid over the band. Others are not used.
            spectra: pseudo-acceleration at 5 % damping, shape (n_records, n_T), m/s2, scaled as used.
            pgas: peak ground acceleration, shape (n_records,), m/s2, scaled as used.
            target: elastic spectrum at 5 % damping.
            T_1: fundamental period of the structure in the direction of the motions, s; None where it is not known,
                which leaves the mean spectrum unchecked.
            artificial_durations: duration of the stationary part of each artificial motion, s; None or empty where
                none is artificial. The codes leave open how it is measured; edesign uses the time from 5 % to 95 %
                of the Arias intensity (Trifunac & Brady 1975), which of a motion of constant intensity is 90 %.

        Returns:
            One criterion for each rule.

        Raises:
            InputError: the shapes do not fit, the target is not at 5 % damping, or the periods do not cover the band.
        """
        T, psa, pga = np.asarray(periods, dtype=float), np.asarray(spectra, dtype=float), np.asarray(pgas, dtype=float)
        if psa.ndim != 2 or psa.shape[0] < 1 or psa.shape[1:] != T.shape or pga.shape != psa.shape[:1]:
            raise InputError(
                f"spectra of shape (records, periods) are needed, not {psa.shape} for {pga.size} peaks and {T.size} "
                "periods [E-VALUE-01]"
            )
        if not (np.all(np.isfinite(psa)) and np.all(np.isfinite(pga)) and np.all(psa >= 0.0) and np.all(pga >= 0.0)):
            raise InputError("spectra and peak accelerations must be finite and at least zero [E-VALUE-02]")
        if not math.isclose(target.damping, DAMPING, rel_tol=1e-9):
            raise InputError(f"the target spectrum must have 5 % damping, not {100.0 * target.damping:g} % [E-EC8-07]")
        count, missing = psa.shape[0], self.missing(target, T_1)
        extremes = None if T_1 is None or missing else self._extremes(T, psa, target, T_1)
        criteria = [self._number(count)]
        if self.has_zero_period:
            criteria.append(self._zero_period(float(np.mean(pga)), target.zero_period))
        criteria.append(self._least(extremes, T_1, missing))
        if self.greatest_ratio is not None:
            criteria.append(self._greatest(extremes, T_1, self.greatest_ratio, missing))
        if self.clauses.stationary:
            criteria.append(self._stationary(artificial_durations or ()))
        criteria.append(self._use_of_results(count))
        at, lowest = (None, None) if extremes is None else extremes[:2]
        return SetCheck(tuple(criteria), at, lowest)

    def _extremes(
        self, T: np.ndarray, psa: np.ndarray, target: Spectrum, T_1: float
    ) -> tuple[float, float, float, float]:
        """Period and value of the lowest ratio of mean to target spectrum, then of the greatest."""
        inside = self.in_band(T, T_1)
        ratio = np.mean(psa[:, inside], axis=0) / target.acceleration(T[inside])
        low, high = int(np.argmin(ratio)), int(np.argmax(ratio))
        return float(T[inside][low]), float(ratio[low]), float(T[inside][high]), float(ratio[high])

    def _number(self, count: int) -> RuleCheck:
        enough = bool(count >= self.least_number)
        return RuleCheck(self.clauses.number, "number of accelerograms", self.least_number, float(count), "", enough)

    def _zero_period(self, mean: float, a_g_S: float) -> RuleCheck:
        text = "mean zero-period spectral acceleration at least a_g S"
        passed = mean >= a_g_S * (1.0 - ROUNDING)
        return RuleCheck(self.clauses.zero_period, text, a_g_S, mean, "m/s2", passed)

    def _least(self, extremes: tuple[float, float, float, float] | None, T_1: float | None, missing: str) -> RuleCheck:
        text, limit = "lowest ratio of mean 5 % spectrum to elastic spectrum", self.least_ratio
        if extremes is None or T_1 is None:
            return self._open(text, limit, missing)
        at, lowest = extremes[:2]
        passed = lowest >= limit * (1.0 - ROUNDING)
        detail = f"at T = {at:.3g} s" + (f"; {self.note}" if self.note else "")
        return RuleCheck(self.clauses.mean, self._over_band(text, T_1), limit, lowest, "", passed, detail)

    def _greatest(
        self, extremes: tuple[float, float, float, float] | None, T_1: float | None, limit: float, missing: str
    ) -> RuleCheck:
        text = "greatest ratio of mean 5 % spectrum to elastic spectrum"
        if extremes is None or T_1 is None:
            return self._open(text, limit, missing)
        at, greatest = extremes[2:]
        passed = greatest <= limit * (1.0 + ROUNDING)
        return RuleCheck(
            self.clauses.mean, self._over_band(text, T_1), limit, greatest, "", passed, f"at T = {at:.3g} s"
        )

    def _open(self, text: str, limit: float, missing: str) -> RuleCheck:
        return RuleCheck(self.clauses.mean, f"{text} from {self.band_text}", limit, None, "", None, missing)

    def _over_band(self, text: str, T_1: float) -> str:
        low, high = self.period_band(T_1)
        return f"{text} from {low:.3g} s to {high:.3g} s ({self.band_text})"

    def _stationary(self, durations: Sequence[float]) -> RuleCheck:
        clause, text = self.clauses.stationary, "shortest stationary part of artificial accelerograms"
        if len(durations) == 0:
            return RuleCheck(clause, text, STATIONARY_DURATION, None, "s", None, "not applicable: none is artificial")
        shortest = min(durations)
        passed = bool(shortest >= STATIONARY_DURATION * (1.0 - ROUNDING))
        detail = "unless site-specific data say otherwise"
        return RuleCheck(clause, text, STATIONARY_DURATION, shortest, "s", passed, detail)

    def _use_of_results(self, count: int) -> RuleCheck:
        enough = count >= self.number_for_mean
        detail = "the mean of the responses may be used" if enough else self.fewer
        return RuleCheck(self.clauses.use, FOR_MEAN, self.number_for_mean, float(count), "", None, detail)
