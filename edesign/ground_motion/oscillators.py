"""Oscillators of many periods under a motion: each gets a time step that its period can be followed with."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.band_limited import polygon_samples, upsampled
from edesign.stopping import in_threads

STEPS = 16  # a period has at least so many
COARSEST = 0.01  # s; a longer step misses velocity peaks of motions with content up to 25 Hz between its ends
STATIC = 8  # below a step of the record over this, 16 times its Nyquist frequency, an oscillator moves with the ground
_PORTION = 32  # periods of a task: what the core advances side by side

Task = Callable[[tuple[np.ndarray, ...], float, np.ndarray, np.ndarray], None]


def upsampling_factors(step: float, period: np.ndarray) -> np.ndarray:
    """Return the number of parts of the record's step for each period: the least power of two that is fine enough.

    Args:
        step: of the record, s.
        period: (n_T,) greater than zero, s.

    Returns:
        (n_T,) whole numbers.
    """
    needed = np.maximum(STEPS * step / period, max(step / COARSEST, 1.0))
    return np.exp2(np.ceil(np.log2(needed) - 1e-9)).astype(int)


def over_periods(
    motions: Sequence[np.ndarray], step: float, period: np.ndarray, threads: int, task: Task
) -> np.ndarray:
    """Call task(corners of each motion, their step, indices, periods at these) until all periods are done.

    Args:
        motions: (n,) each, m/s2.
        step: s.
        period: (n_T,) s.
        threads: how many tasks may run at a time; tasks write to separate places.
        task: what to do.

    Returns:
        (n_T,) the periods that were computed, s: those given, but none below the static limit.

    Raises:
        InputError: there is less than one thread.
    """
    if threads < 1:
        raise InputError(f"response spectrum: the number of threads must be at least 1, not {threads} [E-VALUE-02]")
    computed = np.maximum(period, step / STATIC)
    factors = upsampling_factors(step, computed)
    each = np.unique(factors).tolist()
    size = _PORTION if threads > 1 else computed.size

    def tasks() -> Iterator[tuple[tuple[np.ndarray, ...], float, np.ndarray, np.ndarray]]:
        for factor, *fine in zip(each, *(upsampled(motion, each) for motion in motions), strict=True):
            corners = tuple(polygon_samples(motion) for motion in fine)
            at = np.flatnonzero(factors == factor)
            for portion in np.split(at, range(size, at.size, size)):
                yield corners, step / factor, portion, computed[portion]

    for _ in in_threads(lambda arguments: task(*arguments), tasks(), threads):
        pass
    return computed
