"""Delay between the zero crossings of target and measured displacement."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.substructure.indicators.channels import channel, time_step
from edesign.substructure.indicators.correlation_delay import correlation_delay
from edesign.substructure.indicators.half_cycles import half_cycles, quarter_period, threshold_of
from edesign.substructure.indicators.undetermined import Undetermined


@dataclass(frozen=True)
class CrossingDelay:
    """Delays of the zero crossings.

    Attributes:
        mean: s; above zero if the measured channel is late.
        largest: the one of largest magnitude, s.
        delays: of each pair of crossings, (k,) s.
        instants: of the target's crossings, (k,) s from the first sample.
    """

    mean: float
    largest: float
    delays: np.ndarray
    instants: np.ndarray


def crossing_delay(
    target: ArrayLike, measured: ArrayLike, step: float, threshold: float | None = None, expected: float | None = None
) -> CrossingDelay:
    """Compare the instants at which target and measured displacement cross zero.

    A crossing counts if it leads from beyond the threshold on one side to beyond it on the other, within a quarter of
    the period at the target's rms frequency: rest is no crossing. Crossings of one direction are a pair if each is the
    nearest of the other, once the expected delay is taken off. What then is left must be shorter than half
    of the way to the target's next crossing.

    An offset of the measured channel makes rising crossings early and falling ones late; it drops out of the mean.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.
        step: s.
        threshold: m; None: `QUIET` of the largest target.
        expected: delay by which pairs are found, s; None: that of `correlation_delay`.

    Raises:
        InputError: lengths that differ, NaN, a step out of range.
        Undetermined: no pair of crossings; a measured channel that does not follow the target.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    time_step(step)
    late = (correlation_delay(x_t, x_m, step).delay if expected is None else expected) / step
    level, longest = threshold_of(x_t, threshold), quarter_period(x_t)
    at_target, rising = _quick_crossings("target", x_t, level, longest)
    at_measured, measured_rising = _quick_crossings("measured", x_m, level, longest)
    reach = _reach(at_target)
    chosen, delays = [], []
    for way in (True, False):
        mine, other = np.flatnonzero(rising == way), at_measured[measured_rising == way]
        pairs = _mutual(at_target[mine] + late, other)
        distance = other[pairs[:, 1]] - at_target[mine[pairs[:, 0]]]
        near = np.abs(distance - late) < reach[mine[pairs[:, 0]]]
        chosen.append(mine[pairs[near, 0]])
        delays.append(distance[near])
    return _result(at_target[np.concatenate(chosen)], np.concatenate(delays), step)


def _result(instants: np.ndarray, late: np.ndarray, step: float) -> CrossingDelay:
    if not late.size:
        raise Undetermined("no zero crossing of the measured channel belongs to one of the target")
    order = np.argsort(instants)
    delays = step * late[order]
    return CrossingDelay(
        float(np.mean(delays)), float(delays[np.argmax(np.abs(delays))]), delays, step * instants[order]
    )


def _quick_crossings(name: str, values: np.ndarray, level: float, longest: float) -> tuple[np.ndarray, np.ndarray]:
    """Instants (samples) of the crossings within `longest` samples, and whether they rise."""
    try:
        cycles = half_cycles(values, level)
    except Undetermined as reason:
        raise Undetermined(f"{name}: {reason}") from None
    quick = cycles.dwell <= max(longest, 1.0)
    if not np.any(quick):
        raise Undetermined(f"the {name} channel does not cross zero from one threshold of {level:g} m to the other")
    return cycles.crossing[quick], cycles.rising[quick]


def _reach(instants: np.ndarray) -> np.ndarray:
    """Half of the way from each crossing to the nearest other one; of a single one without end."""
    gap = np.concatenate(([np.inf], np.diff(instants), [np.inf]))
    return 0.5 * np.minimum(gap[:-1], gap[1:])


def _mutual(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Index pairs (k, 2) of two sorted lists whose members are each other's nearest."""
    if not (left.size and right.size):
        return np.empty((0, 2), dtype=int)
    there, back = _nearest(left, right), _nearest(right, left)
    mine = np.arange(left.size)
    both = back[there] == mine
    return np.column_stack((mine[both], there[both]))


def _nearest(of: np.ndarray, among: np.ndarray) -> np.ndarray:
    after = np.clip(np.searchsorted(among, of), 1, max(among.size - 1, 1))
    after = np.minimum(after, among.size - 1)
    before = np.maximum(after - 1, 0)
    return np.where(np.abs(of - among[before]) <= np.abs(of - among[after]), before, after)
