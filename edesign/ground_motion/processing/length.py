"""Length of a record: cutting with tapers, and zeros in front and behind."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.intensity import husid
from edesign.ground_motion.record import Record

_TOLERANCE = 1e-9  # of a step
_MOST_ZEROS = 10_000_000  # samples; more is a mistake, and would not fit into memory


def taper(record: Record, start: float, end: float) -> Record:
    """Bring the first and last seconds smoothly to zero with half a cosine wave; the end samples become zero.

    Args:
        start: length of the taper at the start, s; 0 for none.
        end: length of the taper at the end, s; 0 for none; together at most the length of the record.

    Returns:
        The tapered record.

    Raises:
        InputError: a length is negative, or both together are longer than the record.
    """
    if not (start >= 0.0 and end >= 0.0 and start + end <= record.duration * (1.0 + _TOLERANCE)):
        raise InputError(
            f"{record.name}: tapers of {start:g} s and {end:g} s; they must not be negative nor together longer than "
            f"the record ({record.duration:g} s) [E-MOTION-02]"
        )
    time = record.time
    weight = _rise(time, start) * _rise(record.duration - time, end)
    done = f"tapered over {start:.9g} s at the start and {end:.9g} s at the end"
    return replace(record, acceleration=weight * record.acceleration, source=f"{record.source}; {done}")


def trim(record: Record, start: float, end: float, taper_length: float = 0.5) -> Record:
    """Keep what lies between two times, tapered within at both ends so that no step is left.

    Args:
        start: s from the first sample; moved back to a whole step, and to the record's start.
        end: s from the first sample; moved on to a whole step, and to the record's end.
        taper_length: s at each end; where the record itself begins or ends too.

    Returns:
        The part; its first sample is at time 0.

    Raises:
        InputError: the times are not in order, or nothing or no room for the tapers is left between them.
    """
    first, last = 0, 0
    if np.isfinite(start) and np.isfinite(end):
        first = max(0, int(np.floor(start / record.time_step + _TOLERANCE)))
        last = min(record.acceleration.size - 1, int(np.ceil(end / record.time_step - _TOLERANCE)))
    if last - first < 1:
        raise InputError(
            f"{record.name}: nothing to keep from {start:g} s to {end:g} s of a record of {record.duration:g} s"
            " [E-MOTION-02]"
        )
    done = f"cut to {first * record.time_step:.9g} s to {last * record.time_step:.9g} s"
    part = replace(record, acceleration=record.acceleration[first : last + 1], source=f"{record.source}; {done}")
    return taper(part, taper_length, taper_length)


def trim_to_significant(
    record: Record,
    bounds: tuple[float, float] = (0.001, 0.999),
    lead: float = 1.0,
    tail: float = 1.0,
    taper_length: float = 0.5,
) -> Record:
    """Keep the part in which the Arias intensity grows from one share of its final value to another.

    Args:
        bounds: shares of the Husid diagram, 0 <= lower < upper <= 1.
        lead: s kept before the part as well, where the record has them.
        tail: s kept after the part as well, where the record has them.
        taper_length: s at each end.

    Returns:
        The part, tapered; less than 1 - (upper - lower) of the Arias intensity is lost where the tapers lie in lead
        and tail.

    Raises:
        InputError: the bounds are not in order, lead or tail is negative, or the record is zero throughout.

    Source: Husid (1969); Trifunac & Brady (1975), Bull. Seism. Soc. Am. 65, 581-626.
    """
    low, high = bounds
    if not 0.0 <= low < high <= 1.0:
        raise InputError(
            f"{record.name}: bounds of {low:g} and {high:g}; 0 <= lower < upper <= 1 is needed [E-VALUE-04]"
        )
    if not (lead >= 0.0 and tail >= 0.0):
        raise InputError(
            f"{record.name}: lead and tail must not be negative, not {lead:g} s and {tail:g} s [E-VALUE-02]"
        )
    if record.pga == 0.0:
        raise InputError(f"{record.name}: the record is zero throughout; no part of it is significant [E-REC-23]")
    growth = husid(record.acceleration, record.time_step)
    first = int(np.searchsorted(growth, low, side="right")) - 1
    last = int(np.searchsorted(growth, high, side="left"))
    return trim(record, max(0, first) * record.time_step - lead, last * record.time_step + tail, taper_length)


def pad(record: Record, before: float = 0.0, after: float = 0.0) -> Record:
    """Put zeros in front and behind, as many whole steps as last at least so many seconds.

    Args:
        before: s in front.
        after: s behind.

    Returns:
        The longer record.

    Raises:
        InputError: a length is negative, or so many zeros are no record any more.
    """
    if not (before >= 0.0 and after >= 0.0 and np.isfinite(before + after)):
        raise InputError(f"{record.name}: pads of {before:g} s and {after:g} s; they must not be negative [E-VALUE-02]")
    counts = [int(np.ceil(seconds / record.time_step - _TOLERANCE)) for seconds in (before, after)]
    if counts == [0, 0]:
        return record
    if sum(counts) > _MOST_ZEROS:
        raise InputError(
            f"{record.name}: zeros of {before:g} s and {after:g} s are {sum(counts):.3g} samples of "
            f"{record.time_step:g} s; {_MOST_ZEROS} are possible [E-VALUE-02]"
        )
    samples = np.concatenate((np.zeros(counts[0]), record.acceleration, np.zeros(counts[1])))
    lengths = [count * record.time_step for count in counts]
    done = f"zeros added: {lengths[0]:.9g} s in front, {lengths[1]:.9g} s behind"
    return replace(record, acceleration=samples, source=f"{record.source}; {done}")


def _rise(time: np.ndarray, length: float) -> np.ndarray:
    """Half a cosine wave from 0 at time 0 to 1 at `length`, and 1 beyond."""
    if length == 0.0:
        return np.ones_like(time)
    return 0.5 - 0.5 * np.cos(np.pi * np.clip(time / length, 0.0, 1.0))
