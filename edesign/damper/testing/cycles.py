"""Cycles in a displacement history: blocks of them with one amplitude, robust to noise and ramps."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from edesign.damper.testing.local_fit import noise, peak, zero

SAME_AMPLITUDE = 0.05  # relative: half cycles of a block; of a ramp over two cycles the last reaches 0.875
SAME_PERIOD = 0.05  # relative, of all cycles of a test at one frequency
SAME_LENGTH = 0.15  # relative, of half cycles: an offset of the displacement makes them alternate
REST, NEARLY = 1e-5, 1e-2  # of the largest amplitude: a displacement at rest before or after all cycles
LEAST_LEVEL, LARGEST_LEVEL = 0.05, 0.3  # of the largest amplitude: what must be passed on both sides of a zero


@dataclass(frozen=True)
class Block:
    """Successive cycles of one amplitude.

    Attributes:
        bounds: (cycles + 1,) s, zero crossings in one direction.
        middles: (cycles,) s, zero crossings in the other direction, one in each cycle.
        amplitude: mean of the half cycles, m.
        rising: whether the cycles begin upwards.
    """

    bounds: np.ndarray
    middles: np.ndarray
    amplitude: float
    rising: bool

    @property
    def cycles(self) -> int:
        """Number of full cycles."""
        return self.bounds.size - 1

    @property
    def steady(self) -> bool:
        """True if the motion has a steady frequency: periods differ by 5 % at most, from the first to the last.

        Several cycles of a sweep may be a block, as each of them is like those before it.
        """
        periods = np.diff(self.bounds)
        return float(np.ptp(periods)) <= SAME_PERIOD * float(np.mean(periods))

    def part(self, first: int, last: int) -> Block:
        """Return the block from the first to the last cycle named.

        Args:
            first: number of the cycle, from 1.
        """
        return replace(self, bounds=self.bounds[first - 1 : last + 1], middles=self.middles[first - 1 : last])


def find_blocks(time: np.ndarray, displacement: np.ndarray) -> tuple[Block, ...]:
    """Find the full cycles of a history, in blocks of one amplitude.

    Half cycles run from zero to zero about the middle between the largest and the smallest displacement. A zero counts
    if the displacement passes 5 % of the largest amplitude, or four standard deviations of its noise, on both sides.
    Half cycles whose peaks agree within 5 % and whose lengths within 15 % make a block; two of them are a cycle.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.

    Returns:
        Blocks with at least one full cycle, in order.
    """
    middle = 0.5 * (float(np.max(displacement)) + float(np.min(displacement)))
    u = displacement - middle
    crossings, signs = _crossings(time, u)
    amplitudes = np.array([_amplitude(time, u, crossings[i], crossings[i + 1], signs[i]) for i in range(len(signs))])
    lengths = np.diff(crossings)
    blocks = []
    first = 0
    while first < len(signs):
        last = first + 1
        while last < len(signs) and _alike(amplitudes[first : last + 1], lengths[first : last + 1]):
            last += 1
        if last - first >= 2:
            bounds = np.array(crossings[first : last + 1 : 2])
            middles = np.array(crossings[first + 1 : last + 1 : 2])[: bounds.size - 1]
            blocks.append(Block(bounds, middles, float(np.mean(amplitudes[first:last])), signs[first] > 0))
        first = last
    return tuple(blocks)


def _alike(amplitudes: np.ndarray, lengths: np.ndarray) -> bool:
    """Say whether the last half cycle belongs to those before it."""
    amplitude, length = np.mean(amplitudes[:-1]), np.mean(lengths[:-1])
    return bool(
        abs(amplitudes[-1] - amplitude) <= SAME_AMPLITUDE * amplitude
        and abs(lengths[-1] - length) <= SAME_LENGTH * length
    )


def _crossings(time: np.ndarray, u: np.ndarray) -> tuple[list[float], list[int]]:
    """Times of the zeros, and the sign between each two of them."""
    reach, spread = float(np.max(np.abs(u))), noise(u)
    level = reach * min(max(LEAST_LEVEL, 4.0 * spread / reach), LARGEST_LEVEL)
    outside = np.flatnonzero(np.abs(u) > level)
    sign = np.sign(u[outside])
    turns = np.flatnonzero(np.diff(sign))
    before, after = outside[turns], outside[turns + 1]
    zeros = [zero(time, u, int(i), int(j), spread) for i, j in zip(before, after, strict=True)]
    signs = [int(s) for s in sign[turns + 1][:-1]]
    # a history that starts or ends at rest has its first and last zero there
    rest = REST * reach + 3.0 * spread
    start = _rest(time[: outside[0]][::-1], sign[0] * u[: outside[0]][::-1], rest, reach)
    end = _rest(time[outside[-1] + 1 :], sign[-1] * u[outside[-1] + 1 :], rest, reach)
    if start is not None:
        zeros, signs = [start, *zeros], [int(sign[0]), *signs]
    if end is not None:
        zeros, signs = [*zeros, end], [*signs, int(sign[-1])]
    return zeros, signs[: max(len(zeros) - 1, 0)]


def _rest(time: np.ndarray, u: np.ndarray, rest: float, reach: float) -> float | None:
    """Time of the first sample at rest; else of the last one, if it is nearly there."""
    still = np.flatnonzero(u <= rest)
    if still.size:
        return float(time[still[0]])
    return float(time[-1]) if time.size and u[-1] <= NEARLY * reach else None


def _amplitude(time: np.ndarray, u: np.ndarray, start: float, end: float, sign: int) -> float:
    inside = slice(int(np.searchsorted(time, start)), int(np.searchsorted(time, end, side="right")))
    at = inside.start + int(np.argmax(sign * u[inside]))
    return peak(time, sign * u, float(time[at]), np.pi / (end - start), (start, end), noise(u)).value
