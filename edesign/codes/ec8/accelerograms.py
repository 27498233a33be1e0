"""What a suite of accelerograms must satisfy, EN 1998-1:2004, 3.2.3.1 and 4.3.3.4.3(3)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.codes.ec8.criterion import ROUNDING, Criterion
from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError

DAMPING = 0.05
"""Ratio of critical damping of the spectra that are compared."""
MIN_RECORDS = 3
RECORDS_FOR_MEAN = 7
LOWEST_RATIO = 0.90
BAND = (0.2, 2.0)
"""Ends of the band of periods, in multiples of T_1."""
STATIONARY_DURATION = 10.0
"""Least duration of the stationary part of artificial accelerograms, s."""

_WIDEST_STEP = 1.05  # of neighbouring periods: a coarser grid could step over a valley of the mean spectrum


@dataclass(frozen=True)
class AccelerogramCheck:
    """All criteria of a suite.

    Attributes:
        criteria: number of records, zero-period acceleration, mean spectrum, stationary duration, use of the results.
        worst_period: where the ratio of mean to target spectrum is lowest, s; None where T_1 is not known.
        worst_ratio: that ratio.
    """

    criteria: tuple[Criterion, ...]
    worst_period: float | None
    worst_ratio: float | None

    @property
    def passed(self) -> bool | None:
        """Whether all criteria that apply hold; None where none fails but the mean spectrum could not be checked."""
        if self.failed:
            return False
        return None if self.worst_ratio is None else True

    @property
    def failed(self) -> tuple[Criterion, ...]:
        """The criteria that fail."""
        return tuple(criterion for criterion in self.criteria if criterion.passed is False)


def check_periods(T_1: float, points: int = 201) -> np.ndarray:
    """Return periods for `check_accelerograms`: logarithmic from 0.2 T_1 to 2 T_1, ends included.

    Args:
        T_1: fundamental period in the direction of the accelerogram, s.
        points: how many; 201 are 1.2 % apart.

    Returns:
        shape (points,), s.

    Raises:
        InputError: the period is not greater than zero, or the grid would be coarser than 5 %.
    """
    low, high = period_band(T_1)
    periods = np.geomspace(low, high, points)
    if points < 2 or periods[1] / periods[0] > _WIDEST_STEP:
        raise InputError(f"{points} points from {low:g} s to {high:g} s are more than 5 % apart")
    return periods


def period_band(T_1: float) -> tuple[float, float]:
    """Return 0.2 T_1 and 2 T_1, s, 3.2.3.1.2(4)c.

    Raises:
        InputError: the period is not greater than zero.
    """
    if not (math.isfinite(T_1) and T_1 > 0.0):
        raise InputError(f"the fundamental period T_1 must be greater than zero, not {T_1:g} s")
    return BAND[0] * T_1, BAND[1] * T_1


def in_band(periods: np.ndarray, T_1: float) -> np.ndarray:
    """Return which periods count for 3.2.3.1.2(4)c, shape of `periods`, bool.

    Raises:
        InputError: the periods do not rise, do not reach both ends of the band, or are more than 5 % apart in it.
    """
    low, high = period_band(T_1)
    if periods.ndim != 1 or periods.size < 2 or np.any(np.diff(periods) <= 0.0):
        raise InputError("the periods must be a rising list")
    inside = (periods >= low * (1.0 - ROUNDING)) & (periods <= high * (1.0 + ROUNDING))
    chosen = periods[inside]
    covered = chosen.size > 1 and chosen[0] <= low * (1.0 + ROUNDING) and chosen[-1] >= high * (1.0 - ROUNDING)
    if not covered or np.max(chosen[1:] / chosen[:-1]) > _WIDEST_STEP * (1.0 + ROUNDING):
        raise InputError(
            f"the check needs periods from 0.2 T_1 = {low:g} s to 2 T_1 = {high:g} s, ends included, at most 5 % apart "
            "(`check_periods` makes them)"
        )
    return inside


def check_accelerograms(
    periods: ArrayLike,
    spectra: ArrayLike,
    pgas: ArrayLike,
    target: Spectrum,
    T_1: float | None,
    artificial_durations: Sequence[float] | None = None,
) -> AccelerogramCheck:
    """Check the accelerograms of one direction against EN 1998-1.

    Args:
        periods: shape (n_T,), s, rising; must hold a dense grid from 0.2 T_1 to 2 T_1. Others are not used.
        spectra: pseudo-acceleration at 5 % damping, shape (n_records, n_T), m/s2, scaled as used.
        pgas: peak ground acceleration, shape (n_records,), m/s2, scaled as used.
        target: elastic spectrum at 5 % damping.
        T_1: fundamental period of the structure in the direction of the accelerograms, s; None where it is not known,
            which leaves the mean spectrum unchecked.
        artificial_durations: duration of the stationary part of each artificial accelerogram, s; None or empty where
            none is artificial. EN 1998-1 leaves open how it is measured; edesign uses the time from 5 % to 95 % of
            the Arias intensity (Trifunac & Brady 1975), which of a motion of constant intensity is 90 %.

    Returns:
        One criterion for each rule.

    Raises:
        InputError: the shapes do not fit, the target is not at 5 % damping, or the periods do not cover the band.

    Source: EN 1998-1:2004, 3.2.3.1.2(2)-(4), which 3.2.3.1.3(3) extends to recorded and simulated accelerograms.
    """
    T, psa, pga = np.asarray(periods, dtype=float), np.asarray(spectra, dtype=float), np.asarray(pgas, dtype=float)
    if psa.ndim != 2 or psa.shape[0] < 1 or psa.shape[1:] != T.shape or pga.shape != psa.shape[:1]:
        raise InputError(
            f"spectra of shape (records, periods) are needed, not {psa.shape} for {pga.size} peaks and {T.size} periods"
        )
    if not (np.all(np.isfinite(psa)) and np.all(np.isfinite(pga)) and np.all(psa >= 0.0) and np.all(pga >= 0.0)):
        raise InputError("spectra and peak accelerations must be finite and at least zero")
    if not math.isclose(target.damping, DAMPING, rel_tol=1e-9):
        raise InputError(f"the target spectrum must have 5 % damping, not {100.0 * target.damping:g} %")
    at, lowest = (None, None) if T_1 is None else _worst(T, psa, target, T_1)
    criteria = (
        _number(psa.shape[0]),
        _zero_period(float(np.mean(pga)), target.zero_period),
        _mean_spectrum(lowest, at, T_1),
        _stationary(artificial_durations or ()),
        _use_of_results(psa.shape[0]),
    )
    return AccelerogramCheck(criteria, at, lowest)


def _number(count: int) -> Criterion:
    return Criterion(
        "3.2.3.1.2(4)a", "number of accelerograms", MIN_RECORDS, float(count), "", bool(count >= MIN_RECORDS)
    )


def _zero_period(mean: float, a_g_S: float) -> Criterion:
    text = "mean zero-period spectral acceleration at least a_g S"
    return Criterion("3.2.3.1.2(4)b", text, a_g_S, mean, "m/s2", mean >= a_g_S * (1.0 - ROUNDING))


def _worst(T: np.ndarray, psa: np.ndarray, target: Spectrum, T_1: float) -> tuple[float, float]:
    """Period and value of the lowest ratio of mean to target spectrum."""
    inside = in_band(T, T_1)
    ratio = np.mean(psa[:, inside], axis=0) / target.acceleration(T[inside])
    worst = int(np.argmin(ratio))
    return float(T[inside][worst]), float(ratio[worst])


def _mean_spectrum(lowest: float | None, at: float | None, T_1: float | None) -> Criterion:
    clause, text = "3.2.3.1.2(4)c", "lowest ratio of mean 5 % spectrum to elastic spectrum"
    if lowest is None or T_1 is None:
        return Criterion(clause, f"{text} from 0.2 T_1 to 2 T_1", LOWEST_RATIO, None, "", None, "T_1 is not known")
    low, high = period_band(T_1)
    text = f"{text} from {low:.3g} s to {high:.3g} s (0.2 T_1 to 2 T_1)"
    passed = lowest >= LOWEST_RATIO * (1.0 - ROUNDING)
    return Criterion(clause, text, LOWEST_RATIO, lowest, "", passed, f"at T = {at:.3g} s")


def _stationary(durations: Sequence[float]) -> Criterion:
    clause, text = "3.2.3.1.2(2)P, (3)", "shortest stationary part of artificial accelerograms"
    if len(durations) == 0:
        return Criterion(clause, text, STATIONARY_DURATION, None, "s", None, "not applicable: none is artificial")
    shortest = min(durations)
    passed = bool(shortest >= STATIONARY_DURATION * (1.0 - ROUNDING))
    detail = "unless site-specific data say otherwise"
    return Criterion(clause, text, STATIONARY_DURATION, shortest, "s", passed, detail)


def _use_of_results(count: int) -> Criterion:
    enough = count >= RECORDS_FOR_MEAN
    detail = "the mean of the responses may be used" if enough else "the most unfavourable response counts"
    text = "number of histories for which the mean response counts"
    return Criterion("4.3.3.4.3(3)", text, RECORDS_FOR_MEAN, float(count), "", None, detail)
