"""The least scale of dampers with which the first mode has a damping, or the largest that it can have."""

from __future__ import annotations

from collections.abc import Callable

import scipy

REACHABLE = 0.95
"""Of the largest damping: towards it the dampers grow without limit."""
_GROWTH = 1.5  # of the scale between trials on the way to a target


def reach(damping_of: Callable[[float], float], target: float, first: float, last: float) -> tuple[float, float]:
    """Return the least scale of a distribution with a damping ratio, or the scale of the largest, and the ratio there.

    Damping grows with the dampers until they lock, one after the other, so that it may fall and grow again.

    Args:
        target: damping ratio; infinite: the largest is wanted.
        first: scale below all that may be needed.
        last: scale at which all dampers are locked.
    """
    trials, values = [first], [damping_of(first)]
    while values[0] >= target:
        trials.insert(0, trials[0] / _GROWTH)
        values.insert(0, damping_of(trials[0]))
    best = (trials[-1], values[-1])
    while values[-1] < target:
        if len(values) > 2 and values[-2] > max(values[-3], values[-1]):
            found = scipy.optimize.minimize_scalar(
                lambda x: -damping_of(x),
                bounds=(trials[-3], trials[-1]),
                method="bounded",
                options={"xatol": 1e-6 * trials[-3]},
            )
            best = max(best, (float(found.x), -float(found.fun)), key=lambda item: item[1])
            if best[1] >= target:
                trials = [trials[-3], best[0]]
                break
        if values[-1] >= 1.0 or trials[-1] >= last:
            return max(best, (trials[-1], values[-1]), key=lambda item: item[1])
        trials.append(trials[-1] * _GROWTH)
        values.append(damping_of(trials[-1]))
    low, high = trials[-2], trials[-1]
    scale = scipy.optimize.brentq(lambda x: damping_of(x) - target, low, high, xtol=1e-12 * high, rtol=1e-12)
    return float(scale), target
