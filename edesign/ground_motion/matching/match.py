"""Matching of one record, by either method: scale, pad, adjust, judge."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError
from edesign.ground_motion.intensity import husid, measures
from edesign.ground_motion.matching.closeness import Closeness, judging_periods
from edesign.ground_motion.matching.options import MatchOptions, Method
from edesign.ground_motion.matching.result import Adjust, Adjusted, Match, misfit
from edesign.ground_motion.matching.shape import compare
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.one_thread import one_thread

_LEAST_CYCLES = 2.0  # of the longest period that a record must have room for
_QUIET = 1e-3  # of the Arias intensity: before and after it, the motion counts as not begun and over


def match_record(record: Record, target: Spectrum, options: MatchOptions | None = None) -> Match:
    """Scale a record, then change its shape, until its response spectrum is the target.

    Args:
        record: as recorded.
        options: method, band and so on; default `MatchOptions()`.

    Returns:
        The matched record, compared with the scaled original on a grid of periods finer than the one matched.

    Raises:
        InputError: the record or the target cannot be matched over the band; the message says why.

    Source: EN 1998-1:2004, 3.2.3.1.2 (what is matched); thesis, section 5.3.3.
    """
    options = options or MatchOptions()
    check_record(record, options)
    periods = options.matching_periods
    wanted, zero_period = _ordinates(target, periods, options)
    scale, notes = _scale(record, wanted, periods, options)
    scaled, lead = record.scaled(scale), 0.0
    matched, adjusted = scaled, Adjusted(scaled.acceleration, 0, ())
    ordinates = partial(_wanted, target=target, options=options)
    if options.method != "scale" and not _fits(scaled, ordinates, periods, options, zero_period):
        scaled, lead = _with_room(scaled, options)
        adjusted = _adjusted(scaled, target, options, zero_period)
        if np.array_equal(adjusted.acceleration, scaled.acceleration):
            matched, notes = scaled, (*notes, "no step came closer to the target; the record is scaled only")
        else:
            matched = replace(scaled, acceleration=adjusted.acceleration, source=_source(scaled, target, options))
    return _judged(_Seed(record, scale, scaled, lead, notes), matched, adjusted, target, options)


def match_again(match: Match, target: Spectrum, options: MatchOptions) -> Match:
    """Change the shape of a matched record further, to a target that has changed a little.

    Args:
        match: by one of the methods that change the shape.
        target: spectrum that is matched now.
        options: of the match before.

    Returns:
        The matched record, compared with the scaled original of before.
    """
    if np.array_equal(match.matched.acceleration, match.scaled.acceleration):  # it has no room for waves yet
        return match_record(match.original, target, replace(options, factor=match.scale))
    _, zero_period = _ordinates(target, options.matching_periods, options)
    more = _adjusted(match.matched, target, options, zero_period)
    adjusted = replace(more, iterations=match.iterations + more.iterations, history=(*match.history, *more.history))
    matched = replace(match.matched, acceleration=more.acceleration, source=_source(match.scaled, target, options))
    seed = _Seed(match.original, match.scale, match.scaled, match.lead, match.messages)
    return _judged(seed, matched, adjusted, target, options)


@dataclass(frozen=True)
class _Seed:
    """What is matched: the record, its constant factor, and both together with room for waves."""

    original: Record
    scale: float
    scaled: Record
    lead: float
    notes: tuple[str, ...]


def _adjusted(record: Record, target: Spectrum, options: MatchOptions, zero_period: float) -> Adjusted:
    ordinates, periods = partial(_wanted, target=target, options=options), options.matching_periods
    with one_thread():
        return _method(options.method)(record.acceleration, record.time_step, ordinates, periods, options, zero_period)


def _source(scaled: Record, target: Spectrum, options: MatchOptions) -> str:
    band = f"{options.periods[0]:g} to {options.periods[1]:g} s"
    return f"{scaled.source}; matched to {target.label} over {band} ({options.method})"


def _judged(seed: _Seed, matched: Record, adjusted: Adjusted, target: Spectrum, options: MatchOptions) -> Match:
    """The match, with all that is told of it."""
    scaled = seed.scaled
    checked = judging_periods(options.matching_periods)
    goal, zero_period = _ordinates(target, checked, options)
    psa_before = psa(scaled.acceleration, scaled.time_step, checked, options.damping)
    psa_after = psa(matched.acceleration, matched.time_step, checked, options.damping)
    after_misfit = misfit(psa_after, goal, checked)
    after, shape = measures(matched), compare(scaled, matched)
    return Match(
        original=seed.original,
        scale=seed.scale,
        scaled=scaled,
        matched=replace(matched, band_limited=True),
        lead=seed.lead,
        method=options.method,
        damping=options.damping,
        periods=checked,
        target=goal,
        psa_before=psa_before,
        psa_after=psa_after,
        misfit_before=misfit(psa_before, goal, checked),
        misfit_after=after_misfit,
        zero_period=zero_period,
        before=measures(scaled),
        after=after,
        shape=shape,
        iterations=adjusted.iterations,
        history=adjusted.history,
        messages=(*seed.notes, *adjusted.notes),
    )


def constant_factor(record: Record, target: Spectrum, options: MatchOptions) -> float:
    """Return the factor on a record before its shape is changed, as `match_record` takes it.

    Args:
        target: spectrum that is matched.

    Raises:
        InputError: the record or the target cannot be matched over the band.
    """
    check_record(record, options)
    periods = options.matching_periods
    return _scale(record, _ordinates(target, periods, options)[0], periods, options)[0]


def check_band(target: Spectrum, options: MatchOptions) -> None:
    """Check that a target has ordinates over the band to be matched.

    Raises:
        InputError: it ends before.
    """
    if options.periods[1] > target.last_period:
        raise InputError(
            f"the band ends at {options.periods[1]:g} s, and {target.label} at {target.last_period:g} s; end the band "
            "there [E-MATCH-01]"
        )


def check_record(record: Record, options: MatchOptions) -> None:
    """Check that a record reaches over the band to be matched.

    Raises:
        InputError: it is zero throughout, its time step is too long or it is too short.
    """
    shortest, longest = options.periods
    if record.pga == 0.0:
        raise InputError(f"{record.name}: the record is zero throughout; it cannot be matched [E-REC-23]")
    if shortest < 2.0 * record.time_step:
        raise InputError(
            f"{record.name}: the band begins at {shortest:g} s, but a record with a time step of "
            f"{record.time_step:g} s carries no period below {2.0 * record.time_step:g} s; "
            "begin the band there or later [E-MATCH-02]"
        )
    if longest * _LEAST_CYCLES > record.duration:
        raise InputError(
            f"{record.name}: the band ends at {longest:g} s, but a record of {record.duration:g} s has no room for two "
            f"cycles of periods above {record.duration / _LEAST_CYCLES:.4g} s; end the band there or earlier"
            " [E-MATCH-02]"
        )


def _fits(
    scaled: Record,
    target: Callable[[np.ndarray], np.ndarray],
    periods: np.ndarray,
    options: MatchOptions,
    zero_period: float,
) -> bool:
    """Say whether a scaled record is within the tolerance as it is, so that its shape is left alone."""
    closeness = Closeness(target, periods, scaled.time_step, options.damping, zero_period)
    return closeness(scaled.acceleration) <= options.tolerance


def _method(method: Method) -> Adjust:
    if method == "frequency":
        from edesign.ground_motion.matching.frequency import adjust as by_frequency

        return by_frequency
    from edesign.ground_motion.matching.wavelets import adjust as by_wavelets

    return by_wavelets


def _wanted(periods: np.ndarray, target: Spectrum, options: MatchOptions) -> np.ndarray:
    """The target over periods, checked, m/s2."""
    return _ordinates(target, periods, options)[0]


def _ordinates(target: Spectrum, periods: np.ndarray, options: MatchOptions) -> tuple[np.ndarray, float]:
    """The target over the periods and at period zero, checked."""
    if abs(target.damping - options.damping) > 1e-9:
        raise InputError(
            f"the target {target.label} is a spectrum of {100 * target.damping:g} % damping, "
            f"but {100 * options.damping:g} % are to be matched [E-MATCH-03]"
        )
    check_band(target, options)
    wanted, zero_period = np.asarray(target.acceleration(periods), dtype=float), float(target.zero_period)
    good = np.isfinite(wanted) & (wanted > 0.0)
    if not np.all(good):
        at = int(np.flatnonzero(~good)[0])
        raise InputError(
            f"the target {target.label} is {wanted[at]:g} m/s2 at {periods[at]:.4g} s; "
            "within the band it must be greater than zero and finite [E-MATCH-01]"
        )
    if not (np.isfinite(zero_period) and zero_period > 0.0):
        raise InputError(
            f"the target {target.label} is {zero_period:g} m/s2 at period zero; it must be greater than zero and finite"
            " [E-MATCH-01]"
        )
    return wanted, zero_period


def _scale(
    record: Record, wanted: np.ndarray, periods: np.ndarray, options: MatchOptions
) -> tuple[float, tuple[str, ...]]:
    """The factor that is given, or the best in least squares of the logarithms, kept within its bounds."""
    if options.factor is not None:
        return options.factor, ()
    ordinates = psa(record.acceleration, record.time_step, periods, options.damping)
    best = float(np.exp(np.mean(np.log(wanted / ordinates))))
    low, high = options.scale_bounds
    if low <= best <= high:
        return best, ()
    scale = min(max(best, low), high)
    return scale, (f"the best constant factor would be {best:.3g}; its bound {scale:g} was used",)


def _with_room(scaled: Record, options: MatchOptions) -> tuple[Record, float]:
    """The record with zeros where its motion begins or ends too near to the ends; and how many seconds come before.

    Waves of the longest period need half of it before the motion begins and all of it after the motion has ended.
    """
    longest, step = options.periods[1], scaled.time_step
    energy = husid(scaled.acceleration, step)
    begins = float(np.searchsorted(energy, _QUIET)) * step
    ends = float(np.searchsorted(energy, 1.0 - _QUIET)) * step
    before = int(np.ceil(max(0.0, 0.5 * longest - begins) / step))
    padded = scaled.with_zeros(longest - (scaled.duration - ends))
    if before == 0:
        return padded, 0.0
    samples = np.concatenate((np.zeros(before), padded.acceleration))
    source = f"{padded.source}; {before * step:.9g} s of zeros before"
    return replace(padded, acceleration=samples, source=source), before * step
