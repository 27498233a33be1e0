"""Verdict on the loop of a substructure test: stable or not, its margins, and the damping each mode is left with."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.substructure.stability.loop import Loop, RigDelayLoop, phase_delay
from edesign.substructure.stability.roots import further_roots, loop_roots
from edesign.substructure.stability.sweep import GAIN_OF_INTEREST, Sweep, sweep
from edesign.substructure.stability.whole import StructureMode, WholeStructure

FREQUENCY_TOLERANCE = 1e-13
"""Of a crossing; some hundred rounding errors."""
ITERATIONS = 60
"""As many as halvings of an interval that reach it; ten are usual."""


@dataclass(frozen=True)
class Crossing:
    """Extra pure delay at which a root of the loop lies on the imaginary axis.

    Attributes:
        delay: s; beyond what rig and compensator have already; less than zero: a lead.
        frequency: Hz.
        mode: number, from 1, of the structure's mode whose frequency is nearest.
        grows: whether a longer delay makes that vibration grow; False: makes it decay.
    """

    delay: float
    frequency: float
    mode: int
    grows: bool


@dataclass(frozen=True)
class LoopMode:
    """Frequency and damping of a mode of the structure in the loop.

    Attributes:
        number: from 1.
        frequency, damping: of the structure itself, Hz and ratio; nan: it does not oscillate.
        loop_frequency, loop_damping: in the loop as it is, Hz and ratio; nan: the root was lost.
        share: p, of the mode's stiffness that is the specimen's.
        delay: of rig and compensator at the mode's frequency, -phase(G C)/omega, s.
        amplitude: |G C| there.
        critical_delay: extra delay at which this mode goes, s; inf: none; less than zero: it has gone already.
    """

    number: int
    frequency: float
    damping: float
    loop_frequency: float
    loop_damping: float
    share: float
    delay: float
    amplitude: float
    critical_delay: float

    @property
    def damping_error(self) -> float:
        """Damping ratio that the loop adds; less than zero: takes away."""
        return self.loop_damping - self.damping

    @property
    def simple_damping_error(self) -> float:
        """Error of the damping by the formula of small delays, -p omega tau / 2.

        Source: thesis Eq. 6.6, for the specimen's part.
        """
        return -self.share * math.pi * self.frequency * self.delay


@dataclass(frozen=True)
class LoopStability:
    """Verdict and margins.

    Attributes:
        stable: by the count of unstable roots.
        unstable_roots: in the right half plane, a pair counted twice, up to the highest frequency of the sweep.
        bounded: False: the loop does not fade, |L| >= 1 however high the frequency, and has roots without end there.
        gain_margin: least factor above 1 on the specimen's force that makes the loop unstable; inf: none below 20. Of
            an unstable loop: the largest factor below 1 with a root on the axis; 0: none.
        delay_margin: extra delay of the rig that makes the loop unstable, s; inf: none. Of an unstable loop, less than
            zero: the delay to be taken away until a root comes back; -inf: that does not help.
        first_mode: number of the mode that goes first; 0: none.
        crossings: by delay, from the least extra one.
        modes: from the lowest.
        other_roots: 1/s, near the imaginary axis or unstable: of rig, compensator and delay; not all of them.
        sweep: the loop over frequency, for figures.
    """

    stable: bool
    unstable_roots: int
    bounded: bool
    gain_margin: float
    delay_margin: float
    first_mode: int
    crossings: tuple[Crossing, ...]
    modes: tuple[LoopMode, ...]
    other_roots: tuple[complex, ...]
    sweep: Sweep

    @property
    def growth(self) -> float:
        """Rate at which the motion grows that grows most, 1/s; 0: none of the roots that were found grows."""
        modes = (-2.0 * math.pi * mode.loop_damping * mode.loop_frequency for mode in self.modes)
        others = (one.real for one in self.other_roots)
        return max([0.0, *(rate for rate in modes if math.isfinite(rate)), *others])


def loop_stability(
    loop: Loop, highest_frequency: float | None = None, delayed: RigDelayLoop | None = None
) -> LoopStability:
    """Find whether a substructure test is stable, and with what margins.

    Args:
        loop: with rig and compensator as they are; without them: the partition itself.
        highest_frequency: Hz, see `sweep`; give half the rate of the main step for a compensator that would grow
            without bound.
        delayed: the loop opened at its rig, whose delay the margin is of; None: it multiplies all of L.

    Raises:
        InputError: the structure itself is undamped, or a part of the loop has no finite transfer function.
    """
    own, swept = loop.whole.modes, sweep(loop, highest_frequency)
    roots = loop_roots(loop)
    found = crossings_of(loop, swept)
    if delayed is not None:
        found = crossings_of(delayed, sweep(delayed, highest_frequency))
    stable = swept.bounded and swept.unstable_roots == 0
    late = [one for one in found if one.delay > 0.0]
    early = [one for one in found if one.delay < 0.0]
    if stable:
        first = min((one for one in late if one.grows), key=lambda one: one.delay, default=None)
        delay_margin = first.delay if first else math.inf
    else:
        first = max((one for one in early if one.grows), key=lambda one: one.delay, default=None)
        delay_margin = first.delay if first else -math.inf
    return LoopStability(
        stable,
        swept.unstable_roots,
        swept.bounded,
        _gain_margin(loop, swept, stable),
        delay_margin,
        first.mode if first else 0,
        found,
        tuple(_mode(loop, i + 1, own[i], complex(roots[i]), found) for i in range(len(own))),
        further_roots(loop, _dips(swept), float(swept.omega[-1]), roots, swept.unstable_roots),
        swept,
    )


def delay_factor(critical: float, late: float, step: float) -> float:
    """Return how many times as late a test may be: critical delay over the delay; inf: no delay is critical.

    A delay below a main step, or a lead, counts as a step: no loop knows its own delay more closely.

    Args:
        critical: delay at which the test grows, that which it has included, s.
        late: delay that the test has, s; NaN: neither it nor the factor is determined.
        step: main step, s.
    """
    return critical / max(late, step) if math.isfinite(late) else math.nan


def critical_delays(whole: WholeStructure, highest_frequency: float | None = None) -> tuple[Crossing, ...]:
    """Return the pure delays of the specimen's force, without rig and compensator, at which modes go, the least first.

    Args:
        highest_frequency: Hz, see `sweep`.

    Raises:
        InputError: as `loop_stability`.
    """
    bare = Loop(whole)
    found = crossings_of(bare, sweep(bare, highest_frequency))
    return tuple(one for one in found if one.delay >= 0.0 and one.grows)


def crossings_of(loop: Loop, swept: Sweep) -> tuple[Crossing, ...]:
    """Return where |L| = 1: the delay that brings L to -1, and the lead one turn before it; the nearest first.

    Args:
        loop: with rig and compensator.
        swept: this loop over frequency.
    """
    size = np.abs(swept.transfer)
    with np.errstate(divide="ignore"):
        level = np.log(size)
    own = np.array([mode.omega for mode in loop.whole.modes])
    at = _sign_changes(level)
    omegas = _roots(lambda w: _above_one(loop, w), swept.omega[at], swept.omega[at + 1])
    delays = (np.angle(_aligned(loop, omegas)[0]) + np.pi) % (2.0 * np.pi) / omegas
    found = []
    for omega, delay, before in zip(omegas.tolist(), delays.tolist(), level[at].tolist(), strict=True):
        mode = int(np.argmin(np.abs(np.log(np.maximum(own, np.finfo(float).tiny) / omega)))) + 1
        turn = 2.0 * math.pi / omega
        found += [Crossing(one, omega / (2.0 * math.pi), mode, before > 0.0) for one in (delay, delay - turn)]
    return tuple(sorted(found, key=lambda one: abs(one.delay)))


def _gain_margin(loop: Loop, swept: Sweep, stable: bool) -> float:
    """Factor on L that brings it to -1 where it is real and negative."""
    L = swept.transfer
    at = _sign_changes(L.imag)
    at = at[(L[at].real < 0.0) & (L[at + 1].real < 0.0)]
    aligned, size = _aligned(loop, _roots(lambda w: _aligned(loop, w)[0].imag, swept.omega[at], swept.omega[at + 1]))
    factors = (-size[aligned.real != 0.0] / aligned.real[aligned.real != 0.0]).tolist()
    if stable:
        return min((factor for factor in factors if 1.0 < factor < GAIN_OF_INTEREST), default=math.inf)
    return max((factor for factor in factors if factor < 1.0), default=0.0)


def _mode(loop: Loop, number: int, own: StructureMode, root: complex, crossings: Sequence[Crossing]) -> LoopMode:
    """One mode's figures."""
    s = np.array([1j * own.omega])
    actuation = complex(loop.actuation(s)[0])
    mine = (one.delay for one in crossings if one.mode == number and one.grows)
    return LoopMode(
        number,
        own.frequency,
        own.damping,
        abs(root) / (2.0 * math.pi),
        -root.real / abs(root),
        loop.whole.share_of(own),
        phase_delay(loop.actuation, own.frequency),
        abs(actuation),
        _nearest_ahead(tuple(mine), gone=root.real > 0.0),
    )


def _nearest_ahead(delays: Sequence[float], gone: bool) -> float:
    """The least delay ahead; of a mode that has gone: the last behind."""
    if gone:
        return max((delay for delay in delays if delay <= 0.0), default=-math.inf)
    return min((delay for delay in delays if delay >= 0.0), default=math.inf)


def _dips(swept: Sweep) -> np.ndarray:
    """Frequencies of the minima of |R|, rad/s; a root may be near to each."""
    size = np.abs(swept.ratio)
    inner = size[1:-1]
    lowest = (inner <= size[:-2]) & (inner <= size[2:]) & (inner < 1.0)
    return np.asarray(swept.omega[1:-1][lowest])


def _sign_changes(values: np.ndarray) -> np.ndarray:
    """Indices i with a change of sign between i and i + 1, (k,); above zero frequency, where L may be infinite."""
    with np.errstate(invalid="ignore"):
        changes = values[1:-1] * values[2:] < 0.0
    return np.asarray(np.flatnonzero(changes) + 1)


def _roots(function: Callable[[np.ndarray], np.ndarray], low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Zeros between pairs of frequencies with values of opposite signs, (k,) rad/s; all at once, as calls are dear.

    Source: Illinois method, Dowell & Jarratt (1971), BIT 11, 168-174.
    """
    if not low.size:
        return low
    ends = function(np.concatenate((low, high)))
    other, root, at_other, at_root = low, high, ends[: low.size], ends[low.size :]
    for _ in range(ITERATIONS):
        steep = at_root != at_other
        step = np.where(steep, at_root * (root - other) / np.where(steep, at_root - at_other, 1.0), 0.0)
        if np.all(np.abs(step) <= FREQUENCY_TOLERANCE * high):
            break
        value = function(root - step)
        passed = value * at_root < 0.0
        other, at_other = np.where(passed, root, other), np.where(passed, at_root, 0.5 * at_other)
        root, at_root = root - step, value
    return np.asarray(root)


def _parts(loop: Loop, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A and B of L = A / B, both finite: without damping L is infinite at the frequencies of the numerical part."""
    s = 1j * omega
    return loop.parts(loop.actuation(s), loop.whole.specimen_share(s), s)


def _aligned(loop: Loop, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """L times |B|^2, which has the phase of L, and |B|^2."""
    over, under = _parts(loop, omega)
    return over * under.conj(), np.abs(under) ** 2


def _above_one(loop: Loop, omega: np.ndarray) -> np.ndarray:
    """Of the sign of |L| - 1."""
    over, under = _parts(loop, omega)
    return np.asarray(np.abs(over) - np.abs(under))
