"""How well successive steady cycles repeat at the same phase."""

from __future__ import annotations

import numpy as np

from edesign.calibration.residual.cycles import Cycles, Steady
from edesign.calibration.signals.sampling import evenly, step

_FEWEST = 16  # samples a cycle
_MEDIAN = 0.454936  # of the square of a standard normal variable


def repeatability(motion: Cycles, values: np.ndarray) -> float | None:
    """Standard deviation of what does not repeat from cycle to cycle, in the unit of the values.

    Second differences x(t-P) - 2 x(t) + x(t+P) over three cycles, which also end a change in proportion to the number
    of cycles; the values between samples by cubic Lagrange interpolation, whose gain for noise is known at each
    fraction of a sample. Medians are taken within cycles, as jumps at reversals fall between samples, and over cycles,
    so that early ones which still settle count little.

    Args:
        motion: of the test.
        values: (n,).

    Returns:
        None if the test has no three steady cycles of one amplitude beside the first, or is sampled unevenly.
    """
    if not evenly(motion.time):
        return None
    powers = [power for part in motion.steady_parts() for power in _powers(motion.time, values, part)]
    return float(np.sqrt(np.median(powers))) if powers else None


def _powers(time: np.ndarray, values: np.ndarray, part: Steady) -> list[float]:
    """Mean square noise, from each cycle with one before and one after."""
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
    after = sum(w * values[at + whole + k] for w, k in zip(weights, (-1, 0, 1, 2), strict=True))
    before = sum(w * values[at - whole - k] for w, k in zip(weights, (-1, 0, 1, 2), strict=True))
    squared = (before - 2.0 * values[at] + after) ** 2 / (4.0 + 2.0 * float(np.sum(weights**2)))
    cycles = max(int(round(at.size / lag)), 1)
    return [float(np.median(cycle)) / _MEDIAN for cycle in np.array_split(squared, cycles)]


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
