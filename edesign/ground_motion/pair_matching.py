"""Fit of a pair of components to a spectrum: by one factor, each by itself, or both with their ratio kept."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes import Spectrum
from edesign.codes.tabulated import TabulatedSpectrum
from edesign.ground_motion.component_pairs import PairFit, combined_shares, comparable_spectrum, fit_pair, judged
from edesign.ground_motion.matching import Match, MatchOptions, match_record
from edesign.ground_motion.matching.closeness import judging_periods
from edesign.ground_motion.matching.match import check_band, match_again
from edesign.ground_motion.record import Record
from edesign.project.records.records import CombinedSpectrum

_ROUNDS, _STEPS = 6, {"wavelets": 3, "frequency": 12}
"""Of matching both components again, and the iterations of each: matched components reach their peaks at other moments
than recorded ones, which changes RotD50 and RotD100. With few wavelets a round the moments change little; the factor on
the Fourier transform begins with coarse steps."""
_BEYOND = 1.0 + 1e-6


@dataclass(frozen=True)
class PairMatch:
    """Both components of a pair, fitted.

    Attributes:
        matches: of both.
        fit: how near their combined spectrum is to the target; None: each was fitted by itself.
    """

    matches: tuple[Match, Match]
    fit: PairFit | None

    @property
    def records(self) -> tuple[Record, Record]:
        """Both fitted components on one time axis."""
        first, second = on_one_axis([(match.matched, match.lead) for match in self.matches])
        return first, second


def match_pair(
    first: Record, second: Record, target: Spectrum, options: MatchOptions, spectrum: CombinedSpectrum | None
) -> PairMatch:
    """Fit both components of a pair to a spectrum.

    With `scale` both have one factor. Otherwise each component is matched to its share of the target, that of its own
    spectrum in the combined one, so that at each period they stay to each other as they were recorded; what the
    combined spectrum of the matched components then lacks is added to both targets alike, and they are matched again.
    Without a combined spectrum each component is matched to the target.

    Args:
        second: component at right angles to it, with the same time axis.
        target: of the damping of the options.
        options: method, band and bounds.
        spectrum: of both that is to be the target; None: each component by itself.

    Raises:
        InputError: a component is zero throughout, or does not reach over the band; or the target does not.

    Source: Montejo (2021), Earthquake Spectra 37(2), 1127-1144, for matching both components to one RotDnn.
    """
    check_band(target, options)
    if spectrum is None:
        each = match_record(first, target, options), match_record(second, target, options)
        return PairMatch(each, None)
    fit = fit_pair(first, second, target, options, spectrum)
    options = replace(options, factor=fit.factor)
    if options.method == "scale":
        return PairMatch((match_record(first, target, options), match_record(second, target, options)), fit)
    periods = np.append(0.0, judging_periods(options.matching_periods))
    goal = np.append(target.zero_period, target.acceleration(periods[1:]))
    wanted = goal * combined_shares(first, second, periods, options.damping, spectrum)
    one, other = (_share(target, periods, ordinates) for ordinates in wanted)
    found = PairMatch((match_record(first, one, options), match_record(second, other, options)), fit)
    fit = judged(fit, *found.records, target)
    best, nearest, again = replace(found, fit=fit), fit.misfit.rms, replace(options, iterations=_STEPS[options.method])
    for _ in range(_ROUNDS):
        if fit.misfit.rms <= options.tolerance:
            break
        wanted = wanted * goal / comparable_spectrum(*found.records, periods, options.damping, spectrum)
        one, other = (_share(target, periods, ordinates) for ordinates in wanted)
        found = PairMatch((match_again(found.matches[0], one, again), match_again(found.matches[1], other, again)), fit)
        fit = judged(fit, *found.records, target)
        if fit.misfit.rms < nearest:
            best, nearest = replace(found, fit=fit), fit.misfit.rms
    return best


def on_one_axis(records: Sequence[tuple[Record, float]]) -> list[Record]:
    """Return records that begin at different times on one time axis, with zeros where one has not begun or has ended.

    Args:
        records: of one time step, each with the time between its first sample and time 0 of the recording, s.
    """
    step = records[0][0].time_step
    before = [round(lead / step) for _, lead in records]
    front = [max(before) - count for count in before]
    longest = max(count + record.acceleration.size for count, (record, _) in zip(front, records, strict=True))
    found = []
    for count, (record, _) in zip(front, records, strict=True):
        behind = longest - count - record.acceleration.size
        samples = np.concatenate((np.zeros(count), record.acceleration, np.zeros(behind)))
        found.append(record if not count and not behind else replace(record, acceleration=samples))
    return found


def _share(target: Spectrum, periods: np.ndarray, ordinates: np.ndarray) -> TabulatedSpectrum:
    """The share of the target that one component has; it ends behind the band, so that rounding stays within it."""
    return TabulatedSpectrum(
        (*periods.tolist(), periods[-1] * _BEYOND),
        (*ordinates.tolist(), ordinates[-1]),
        target.damping,
        target.set_rules,
        label=f"share of {target.label}",
    )
