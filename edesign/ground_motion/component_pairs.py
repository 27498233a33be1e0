"""The spectrum of two horizontal components together, and the one factor that brings it to a target."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes import Spectrum
from edesign.ground_motion.matching import MatchOptions, Misfit, misfit
from edesign.ground_motion.matching.closeness import judging_periods
from edesign.ground_motion.matching.match import check_record
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa, rotated_spectra
from edesign.project.records.records import CombinedSpectrum

NAMES: dict[CombinedSpectrum, str] = {
    "geometric_mean": "geometric mean",
    "srss": "SRSS",
    "rotd50": "RotD50",
    "rotd100": "RotD100",
}
"""The combined spectra, for people."""

_OF_EQUAL = {"srss": math.sqrt(2.0)}
"""How many times the spectrum of one component it is, where both have the same; 1 of those that are not here."""


@dataclass(frozen=True)
class PairFit:
    """Pair of components scaled together.

    Attributes:
        spectrum: what of them was compared.
        factor: on both.
        best: what it would be without bounds.
        periods: shape (n,), s.
        combined: of the scaled components, shape (n,), m/s2; SRSS over the square root of 2, as two components that
            both have the target spectrum have that SRSS.
        misfit: of it to the target.
    """

    spectrum: CombinedSpectrum
    factor: float
    best: float
    periods: np.ndarray
    combined: np.ndarray
    misfit: Misfit


def combined_spectrum(
    first: Record, second: Record, periods: np.ndarray, damping: float, spectrum: CombinedSpectrum
) -> np.ndarray:
    """Return the spectrum of two components at right angles together.

    Args:
        first: component in one direction.
        second: component at right angles to it, with the same time axis.
        periods: shape (n,), s.
        damping: ratio of critical.
        spectrum: the geometric mean of both, the square root of the sum of their squares, or the median or largest
            ordinate over all directions.

    Returns:
        Pseudo-acceleration, shape (n,), m/s2.

    Source: Boore (2010), Bulletin of the Seismological Society of America 100, 1830-1835; RotD100 is the maximum
    direction of ASCE 7-16, 16.2.2.
    """
    if spectrum in ("geometric_mean", "srss"):
        one, other = (psa(record.acceleration, record.time_step, periods, damping) for record in (first, second))
        return np.sqrt(one * other) if spectrum == "geometric_mean" else np.hypot(one, other)
    percentile = {"rotd50": 50, "rotd100": 100}[spectrum]
    found = rotated_spectra(first.acceleration, second.acceleration, first.time_step, periods, damping, (percentile,))
    return np.asarray(found[0])


def fit_pair(
    first: Record, second: Record, target: Spectrum, options: MatchOptions, spectrum: CombinedSpectrum
) -> PairFit:
    """Find the one factor on both components that is best in least squares of ln(combined / target), within bounds.

    Args:
        first: component as recorded.
        second: component at right angles to it, with the same time axis.
        target: of the damping of the options.
        options: band and bounds.
        spectrum: what of the components is compared.

    Returns:
        The factor and the combined spectrum that it gives.

    Raises:
        InputError: a component is zero throughout, or does not reach over the band.
    """
    for record in (first, second):
        check_record(record, options)
    periods = options.matching_periods
    ordinates = comparable_spectrum(first, second, periods, options.damping, spectrum)
    best = float(np.exp(np.mean(np.log(target.acceleration(periods) / ordinates))))
    factor = float(np.clip(best, *options.scale_bounds))
    shown = judging_periods(periods)
    combined = factor * comparable_spectrum(first, second, shown, options.damping, spectrum)
    return PairFit(spectrum, factor, best, shown, combined, misfit(combined, target.acceleration(shown), shown))


def judged(fit: PairFit, first: Record, second: Record, target: Spectrum) -> PairFit:
    """Return the fit of a pair with the combined spectrum of other components, and its misfit.

    Args:
        fit: of the pair before its components were matched or raised.
        first: component in one direction, as it is used.
        second: component at right angles to it.
        target: of the damping that is compared.
    """
    combined = comparable_spectrum(first, second, fit.periods, target.damping, fit.spectrum)
    return replace(fit, combined=combined, misfit=misfit(combined, target.acceleration(fit.periods), fit.periods))


def combined_shares(
    first: Record, second: Record, periods: np.ndarray, damping: float, spectrum: CombinedSpectrum
) -> np.ndarray:
    """Return what the spectrum of each component is of that of both together.

    Args:
        first: component in one direction.
        second: component at right angles to it, with the same time axis.
        periods: (n,) s; 0 stands for the peak ground acceleration.
        damping: ratio of critical.
        spectrum: of both together; the SRSS counts over the square root of 2.

    Returns:
        (2, n), dimensionless.
    """
    each = [psa(record.acceleration, record.time_step, periods, damping) for record in (first, second)]
    return np.array(each) / comparable_spectrum(first, second, periods, damping, spectrum)


def comparable_spectrum(
    first: Record, second: Record, periods: np.ndarray, damping: float, spectrum: CombinedSpectrum
) -> np.ndarray:
    """Return the combined spectrum as it is compared with that of one component.

    Args:
        first: component in one direction.
        second: component at right angles to it, with the same time axis.
        periods: (n,) s.
        damping: ratio of critical.
        spectrum: of both; the SRSS counts over the square root of 2.

    Returns:
        Pseudo-acceleration, (n,) m/s2.
    """
    return combined_spectrum(first, second, periods, damping, spectrum) / _OF_EQUAL.get(spectrum, 1.0)
