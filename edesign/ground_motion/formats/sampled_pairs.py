"""Accelerograms that are written as pairs of time and acceleration, as film was digitized."""

from __future__ import annotations

import numpy as np

from edesign.errors import InputError

_GAP = 1.0  # s; digitized kinks of a ground motion are some hundredths of a second apart
_STEPS = (0.01, 0.005, 0.0025, 0.002, 0.001)  # s; those of processed records, from which the next finer is taken


def evenly_sampled(where: str, times: np.ndarray, values: np.ndarray, digit: float) -> tuple[np.ndarray, float, str]:
    """Return samples at an even step.

    Times that are even to their printed digits stay as they are. Between others lies a straight line, as in the
    volume 2 processing of digitized film, and the step is the largest usual one below the median of their intervals.

    Args:
        where: the file, for messages.
        times: shape (n,), s.
        values: shape (n,), in the unit of the result.
        digit: one unit in the last digit of the times, s.

    Returns:
        The samples; the step, s; what was done, for the source of the record ("" if nothing).

    Raises:
        InputError: fewer than two pairs, times that do not rise, or a gap in them.
    """
    if times.size < 2:
        raise InputError(f"{where}: {times.size} pairs of time and acceleration; a record needs at least 2 [E-REC-21]")
    intervals = np.diff(times)
    if np.any(intervals < 0.0) or times[-1] <= times[0]:
        at = int(np.argmax(intervals < 0.0)) + 1
        raise InputError(
            f"{where}: the times must rise, but pair {at + 1} has {times[at]:g} s after {times[at - 1]:g} [E-REC-19]"
        )
    mean = float(times[-1] - times[0]) / intervals.size
    for step in (round(mean, 4), round(mean, 6), mean):
        if step > 0.0 and np.all(np.abs(times - times[0] - step * np.arange(times.size)) <= 1.01 * digit):
            return values, step, ""
    if np.max(intervals) > _GAP:
        at = int(np.argmax(intervals))
        raise InputError(
            f"{where}: {intervals[at]:g} s pass between pairs {at + 1} and {at + 2}, at {times[at]:g} s; "
            f"across more than {_GAP:g} s no line stands for the motion [E-REC-19]"
        )
    median = float(np.median(intervals))
    step = next((usual for usual in _STEPS if usual <= 1.05 * median), _STEPS[-1])  # the median is of rounded times
    rising = np.concatenate(([True], intervals > 0.0))  # of pairs at one printed time the first counts
    count = int(np.floor((times[-1] - times[0]) / step + 1e-9)) + 1
    samples = np.interp(times[0] + step * np.arange(count), times[rising], values[rising])
    return samples, step, f"digitized at uneven times, interpolated linearly to {step:g} s"
