"""A force that a load cell, its amplifier or a converter could not follow: samples at the end of the range."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.damper.testing.measured_histories import DamperTest
from edesign.estimation.differences import difference_noise

_SHORTEST = 3  # samples in a row that are equal to the last digit
_BEYOND = 5.0  # standard deviations of the noise, by which the force would have gone beyond
_SLOPE = 3  # samples before and after a row, by which it comes and goes
MEASURED = 1e-5  # of the largest force, or of the range: no measured channel has less noise, of 16 bits at least


def clipped(force: np.ndarray) -> np.ndarray:
    """Return which samples (n,) of a measured force stand at the end of a range.

    They are equal to the largest or the smallest one to the last digit, three of them or more in a row. The force
    comes to such a row, and leaves it, so steeply that a smooth peak with these slopes would be higher by five standard
    deviations of its noise. A force without any noise is none that was measured: one of an ideal plastic or friction
    device is flat at its yield force, and is not clipped.

    Args:
        force: (n,) in any unit.
    """
    force = np.asarray(force, dtype=float)
    found = np.zeros(force.size, dtype=bool)
    if not force.size:
        return found
    ends = force == np.max(force), -force == np.max(-force)
    rows = [_rows(end) for end in ends]
    if not any(rows):
        return found
    noise = difference_noise(force, ~(ends[0] | ends[1]))
    if noise < MEASURED * float(np.max(np.abs(force))):
        return found
    for side, end, of_side in zip((1.0, -1.0), ends, rows, strict=True):
        if any(_gone(side * force, first, last) > _BEYOND * noise for first, last in of_side):
            found |= end
    return found


def clipping_warning(test: DamperTest) -> str:
    """Return what is to be said of a force that was clipped, for people; "" if it was not.

    Args:
        test: with or without a force.
    """
    return "" if test.force is None else clipping_text(1e-3 * test.force, "kN", test.time)


def clipping_text(force: np.ndarray, unit: str, time: np.ndarray | None) -> str:
    """Return what is to be said of a force that was clipped, for people; "" if it was not.

    Args:
        force: (n,).
        time: (n,) s; None: it is not known.
    """
    at = np.flatnonzero(clipped(force))
    if not at.size:
        return ""
    ends = " and ".join(f"{end:.4g} {unit}" for end in np.unique(force[at]))
    first = f"line {at[0] + 1} of the numbers" if time is None else f"{time[at[0]]:.6g} s"
    return (
        f"force: {at.size} samples stand at {ends} exactly, the first at {first}: was the load cell or its amplifier "
        "at the end of its range?"
    )


def clipping_notes(tests: Sequence[DamperTest]) -> tuple[str, ...]:
    """Return what is to be said of forces that were clipped and are not judged, one line for each test that has some.

    Args:
        tests: of a campaign.
    """
    warnings = ((test.name, clipping_warning(test)) for test in tests)
    return tuple(f"{name}: {warning} They are not judged" for name, warning in warnings if warning)


def _rows(end: np.ndarray) -> list[tuple[int, int]]:
    """First and last sample of the rows that are long enough, and do not begin or end the record."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], end.astype(np.int8), [0]))))
    rows = zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True)
    return [
        (first, last) for first, last in rows if last - first + 1 >= _SHORTEST and first > 0 and last < end.size - 1
    ]


def _gone(force: np.ndarray, first: int, last: int) -> float:
    """Return by how much a parabola with the slopes at both ends of a row is higher than the row."""
    rise = (force[first] - force[max(first - _SLOPE, 0)]) / min(_SLOPE, first)
    after = min(last + _SLOPE, force.size - 1)
    fall = (force[last] - force[after]) / (after - last)
    # a peak over a chord of length h with slope s at its ends is s h/4 high
    return 0.25 * min(float(rise), float(fall)) * (last - first)
