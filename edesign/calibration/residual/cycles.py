"""Cycles in the motion of a test: steady ones, the band of frequencies, and the half cycle each sample is in."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.calibration.signals.sampling import even, step
from edesign.damper.testing.cycles import Block, find_blocks

FEWEST = 3  # cycles of a steady part
_FEWEST_TURNS = 4
_TURN = 0.02  # of the largest displacement: what must be passed to reverse
_EVEN = 0.25  # of a half cycle: departure of reversals from even ones
_POWER = 0.995  # of the motion's, in its band


@dataclass(frozen=True)
class Steady:
    """Steady cycles of one amplitude.

    Attributes:
        start: s.
        period: s.
        cycles: whole cycles.
        amplitude: m.
    """

    start: float
    period: float
    cycles: int
    amplitude: float

    @property
    def end(self) -> float:
        """End of the last cycle, s."""
        return self.start + self.cycles * self.period

    def samples(self, time: np.ndarray) -> slice:
        """Those within."""
        tolerance = 1e-6 * self.period
        first, last = np.searchsorted(time, (self.start - tolerance, self.end - tolerance))
        return slice(int(first), int(last))


@dataclass(frozen=True)
class HalfCycles:
    """The half cycle of each sample, from reversal to reversal by over 2 % of the largest displacement; (n,) each.

    Attributes:
        number: of half cycles before.
        amplitude: half its stroke, m.
        frequency: of a cycle of two such halves, Hz.
    """

    number: np.ndarray
    amplitude: np.ndarray
    frequency: np.ndarray


class Cycles:
    """What a displacement history says of the cycles in it; each thing is worked out when it is first asked for.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
    """

    def __init__(self, time: np.ndarray, displacement: np.ndarray) -> None:
        self.time = np.asarray(time, dtype=float)
        self.displacement = np.asarray(displacement, dtype=float)

    @cached_property
    def _blocks(self) -> tuple[Block, ...]:
        return find_blocks(self.time, self.displacement) if np.ptp(self.displacement) > 0.0 else ()

    def steady_parts(self, skip: int = 1) -> tuple[Steady, ...]:
        """Steady parts of at least three cycles, without the first of each, in which the force still settles.

        The period is that of a straight line through the zeros: a single one is known to the noise only.
        """
        parts = []
        for block in self._blocks:
            cycles = block.cycles - skip
            if cycles < FEWEST:
                continue
            period, start = np.polyfit(np.arange(block.bounds.size), block.bounds, 1)
            start = max(float(start + skip * period), float(self.time[0]))
            parts.append(Steady(start, float(period), cycles, block.amplitude))
        return tuple(parts)

    def longest(self, skip: int = 1) -> Steady | None:
        """The steady part with the most cycles, of these that of the largest amplitude."""
        return max(self.steady_parts(skip), key=lambda part: (part.cycles, part.amplitude), default=None)

    @cached_property
    def upper_frequency(self) -> float:
        """Frequency below which the motion has 99.5 % of the mean square of its displacement, Hz."""
        grid, values = even(self.time, self.displacement)
        spectrum = np.abs(np.fft.rfft((values - np.mean(values)) * np.hanning(values.size))) ** 2
        total = np.cumsum(spectrum)
        at = int(np.searchsorted(total, _POWER * total[-1]))
        return max(at, 1) / (values.size * step(grid))

    @cached_property
    def base_frequency(self) -> float | None:
        """Frequency of steady cycles, else of reversals that follow one another evenly, Hz; None of other motions."""
        part = self.longest(skip=0)
        if part is not None:
            return 1.0 / part.period
        at = self._turns[1:-1]
        if at.size < _FEWEST_TURNS:
            return None
        number = np.arange(at.size)
        slope, start = np.polyfit(number, self.time[at], 1)
        departure = self.time[at] - start - slope * number
        return float(0.5 / slope) if np.max(np.abs(departure)) < _EVEN * slope else None

    @cached_property
    def _turns(self) -> np.ndarray:
        """Samples of the reversals, the first and the last sample."""
        turns = reversals(self.displacement, _TURN * float(np.ptp(self.displacement)) / 2.0)
        return np.array(turns if len(turns) > 1 else [0, self.displacement.size - 1])

    @cached_property
    def half_cycles(self) -> HalfCycles:
        """The half cycle of each sample."""
        at = self._turns
        number = np.clip(np.searchsorted(at, np.arange(self.time.size), side="right") - 1, 0, at.size - 2)
        amplitude = 0.5 * np.abs(np.diff(self.displacement[at]))
        frequency = 0.5 / np.diff(self.time[at])
        return HalfCycles(number, amplitude[number], frequency[number])


def reversals(values: np.ndarray, least: float) -> list[int]:
    """First and last sample and the extremes between, each further than `least` from those beside it."""
    local = np.flatnonzero(np.diff(np.sign(np.diff(values))) != 0) + 1
    turns, sign, best = [0], 0.0, 0
    for i in [*local.tolist(), values.size - 1]:
        change = float(values[i] - values[best])
        if sign == 0.0:
            if abs(change) > least:
                sign, best = float(np.sign(change)), i
        elif sign * change > 0.0:
            best = i
        elif -sign * change > least:
            turns.append(best)
            sign, best = -sign, i
    if turns[-1] != values.size - 1:
        turns.append(values.size - 1)
    return turns
