"""All delays of the rig with which a substructure test is stable, not only the next at which it is not."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from edesign.substructure.stability.loop import Loop
from edesign.substructure.stability.margins import crossings_of
from edesign.substructure.stability.sweep import sweep


def stable_delays(
    loop: Loop, least: float, largest: float, highest_frequency: float | None = None
) -> tuple[tuple[float, float], ...]:
    """Return the intervals of a further delay of the rig, s, in which the loop is stable.

    A delay d multiplies L by exp(-i omega d), so a root meets the imaginary axis only where |L| = 1: at the same few
    frequencies for all delays, once a turn, and always in the same direction. The unstable roots at d = 0, counted by
    the sweep, and these crossings give their number at every d. A loop with |L| >= 1 at the highest frequency is of
    neutral type, and unstable with every delay that is not known to the last turn: it has no interval.

    Args:
        loop: at d = 0; a `RigDelayLoop` where the delay does not multiply all of k_E H G C.
        least: smallest delay that is looked at, s; at most 0.
        largest: largest delay that is looked at, s; at least 0.
        highest_frequency: Hz, see `sweep`.

    Returns:
        Intervals, s, rising, without common points.

    Raises:
        InputError: a part of the loop is not finite at a frequency.

    Source: Walton & Marshall (1987), Direct method for TDS stability analysis, IEE Proceedings D 134, 101-107.
    """
    swept = sweep(loop, highest_frequency)
    if not swept.bounded or abs(swept.transfer[-1]) >= 1.0:
        return ()
    events: list[tuple[float, int]] = []
    for one in crossings_of(loop, swept):
        if one.delay >= 0.0:  # the other of the pair is one turn before
            turn, roots = 1.0 / one.frequency, 2 if one.grows else -2
            first, last = math.ceil((least - one.delay) / turn), math.floor((largest - one.delay) / turn)
            events += [(one.delay + number * turn, roots) for number in range(first, last + 1)]
    events.sort()
    unstable = swept.unstable_roots - sum(roots for delay, roots in events if delay <= 0.0)
    return tuple(_joined(_stable(events, unstable, least, largest)))


def _stable(
    events: Sequence[tuple[float, int]], unstable: int, least: float, largest: float
) -> Iterator[tuple[float, float]]:
    """Intervals without unstable roots between one event and the next; unstable: their number at the least delay."""
    begin = least
    for delay, roots in (*events, (largest, 0)):
        if unstable <= 0 and delay > begin:
            yield begin, delay
        begin, unstable = delay, unstable + roots


def _joined(intervals: Iterator[tuple[float, float]]) -> Iterator[tuple[float, float]]:
    """Intervals of which none begins where another ends."""
    joined: tuple[float, float] | None = None
    for begin, end in intervals:
        if joined is not None and joined[1] == begin:
            joined = (joined[0], end)
            continue
        if joined is not None:
            yield joined
        joined = (begin, end)
    if joined is not None:
        yield joined
