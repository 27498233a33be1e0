"""How well successive steady cycles repeat at the same phase."""

from __future__ import annotations

import numpy as np

from edesign.calibration.residual.cycles import Cycles, Steady
from edesign.calibration.signals.sampling import evenly, step

SAME = 0.02
"""Of the rms displacement: motions that differ by less are one motion made twice."""

_FEWEST = 16  # samples a cycle
_MEDIAN = 0.454936  # of the square of a standard normal variable


def repeatability(motion: Cycles, values: np.ndarray) -> float | None:
    """Standard deviation of what does not repeat from cycle to cycle, in the unit of the values.

    Second differences x(t-P) - 2 x(t) + x(t+P) over three cycles, which also end a change in proportion to the number
    of cycles; the values between samples by cubic Lagrange interpolation, whose gain for noise is known at each
    fraction of a sample. Medians are taken within cycles, as jumps at reversals fall between samples, and over cycles,
    so that early ones which still settle count little. Cycles whose motion does not repeat, as in a sweep, say nothing.

    Args:
        motion: of the test.
        values: (n,).

    Returns:
        None if the test has no three steady cycles of one motion beside the first, or is sampled unevenly.
    """
    if not evenly(motion.time):
        return None
    powers = [power for part in motion.steady_parts() for power in _powers(motion, values, part)]
    return float(np.sqrt(np.median(powers))) if powers else None


def _powers(motion: Cycles, values: np.ndarray, part: Steady) -> list[float]:
    """Mean square noise, from each cycle with one before and one after, if the motion itself repeats in them."""
    time = motion.time
    lag = part.period / step(time)
    if lag < _FEWEST:
        return []
    whole = int(np.floor(lag))
    weights = _lagrange(lag - whole)
    inside = part.samples(time)
    first, last = max(inside.start, 1) + whole + 2, min(inside.stop, time.size) - whole - 2
    at = np.arange(first, last)
    if at.size < 0.5 * lag:
        return []
    cycles = max(int(round(at.size / lag)), 1)

    def squared(of: np.ndarray) -> list[np.ndarray]:
        after = sum(w * of[at + whole + k] for w, k in zip(weights, (-1, 0, 1, 2), strict=True))
        before = sum(w * of[at - whole - k] for w, k in zip(weights, (-1, 0, 1, 2), strict=True))
        return np.array_split((before - 2.0 * of[at] + after) ** 2 / (4.0 + 2.0 * float(np.sum(weights**2))), cycles)

    most = (SAME * float(np.std(motion.displacement[inside]))) ** 2
    both = zip(squared(values), squared(motion.displacement), strict=True)
    return [float(np.median(of_values)) / _MEDIAN for of_values, moved in both if np.mean(moved) <= most]


def _lagrange(fraction: float) -> np.ndarray:
    """Weights (4,) of the samples at -1, 0, 1, 2 for the value at a fraction of 0 to 1."""
    x = fraction
    return np.array(
        (
            -x * (x - 1.0) * (x - 2.0) / 6.0,
            (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
            -(x + 1.0) * x * (x - 2.0) / 2.0,
            (x + 1.0) * x * (x - 1.0) / 6.0,
        )
    )
