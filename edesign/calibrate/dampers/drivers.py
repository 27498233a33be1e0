"""Histories inside a test that drive effects, on its samples; edesign.damper.amendments takes the same in steps."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.special import gamma

from edesign.calibrate.dampers.trial import Motion
from edesign.core.fading import fading

_SWEEPS = 40
_STILL = 1e-6  # relative
_FINER = 4  # steps into which one between samples is cut, for a derivative that remembers all of them
_KEPT = 32  # motions whose cycles have been counted


def envelope(motion: Motion, forgets: float) -> np.ndarray:
    """Fading envelope (n,) m of the displacement: a = max(|u|, a before * exp(-h / forgets)), zero before the test."""
    elapsed = (motion.time - motion.time[0]) / forgets
    size = np.log(np.maximum(np.abs(motion.displacement), 1e-300))
    return np.asarray(np.exp(np.maximum.accumulate(size + elapsed) - elapsed))


def largest(motion: Motion, before: float) -> np.ndarray:
    """Largest displacement (n,) m ever, `before` the one of earlier tests."""
    return np.maximum.accumulate(np.maximum(np.abs(motion.displacement), before))


def weighted_path(motion: Motion, weight: np.ndarray) -> np.ndarray:
    """Path (n,) m since the beginning of the test, each way by its weight (n,)."""
    ways = 0.5 * (weight[1:] + weight[:-1]) * np.abs(motion.ways)
    return np.concatenate(([0.0], np.cumsum(ways)))


@lru_cache(maxsize=_KEPT)
def cycles(motion: Motion, least: float) -> np.ndarray:
    """Number of cycles (n,) since the beginning of the test: a half for each way from one reversal to the next, growing
    with the path between; ways back of less than `least` m are no reversals.
    """
    u = motion.displacement
    turns, high, low, way = [0], 0, 0, 0
    for i, value in enumerate(u.tolist()):
        if way >= 0:
            if value > u[high]:
                high = i
            elif u[high] - value > least:
                turns += [high] if way else []
                way, low = -1, i
        if way <= 0:
            if value < u[low]:
                low = i
            elif value - u[low] > least:
                turns += [low] if way else []
                way, high = 1, i
    path = motion.path
    ends = path[[*turns, u.size - 1]]
    found = np.interp(path, ends, 0.5 * np.arange(ends.size))
    found.setflags(write=False)
    return found


@lru_cache(maxsize=_KEPT)
def equivalent_cycles(motion: Motion, least: float) -> np.ndarray:
    """Number of cycles (n,) since the beginning of the test: path over four times the largest displacement so far, at
    least `least` m.
    """
    found = weighted_path(motion, 0.25 / largest(motion, least))
    found.setflags(write=False)
    return found


def work(motion: Motion, force: np.ndarray) -> np.ndarray:
    """Work (n,) J done by a force (n,) N since the beginning of the test."""
    return np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * motion.ways)))


def relaxed(motion: Motion, tau: float) -> np.ndarray:
    """Deformation (n,) m of the spring of a Maxwell branch, q' + q / tau = v: exact for v linear between samples.

    Args:
        motion: of the branch; it has been held before.
        tau: relaxation time, s.
    """
    x = motion.steps / tau
    decay, mean = np.exp(-x), -np.expm1(-x) / x
    v = motion.velocity
    made = tau * ((1.0 - mean) * v[1:] + (mean - decay) * v[:-1])
    return fading(decay, made, 0.0)


@lru_cache(maxsize=2 * _KEPT)
def fractional_rate(motion: Motion, order: float) -> np.ndarray:
    """Derivative (n,) m/s^order of the displacement since the beginning of the test, held before (Caputo).

    Args:
        motion: of the specimen.
        order: of the derivative, in (0, 1).

    Source: scheme L1, exact for a displacement linear between samples: Oldham & Spanier (1974), section 8.2.
    """
    even, step, spectrum, size = _even_changes(motion)
    n = even.size
    power = np.arange(n) ** (1.0 - order)
    summed = np.fft.irfft(spectrum * np.fft.rfft(np.diff(power), size), size)[: n - 1]
    scale = gamma(2.0 - order) * step**order
    found = np.interp(motion.time, even, np.concatenate(([0.0], summed / scale)))
    found.setflags(write=False)
    return found


@lru_cache(maxsize=_KEPT)
def _even_changes(motion: Motion) -> tuple[np.ndarray, float, np.ndarray, int]:
    """Even times (m,) s, the step between them, and the spectrum of the changes of the displacement in these, padded to
    a size.
    """
    time = motion.time
    even = np.linspace(time[0], time[-1], _FINER * (time.size - 1) + 1)
    change = np.diff(motion.spline.at(motion.displacement, even))
    size = 1 << (2 * even.size).bit_length()
    return even, float(even[1] - even[0]), np.fft.rfft(change, size), size


def worked(
    motion: Motion,
    left_by: Callable[[np.ndarray], np.ndarray],
    factor: Callable[[np.ndarray], np.ndarray],
    before: float = 0.0,
    gain: float = 1.0,
    forgets: float = math.inf,
    quick: tuple[float, float] = (0.0, math.inf),
    beside: np.ndarray | float = 0.0,
    sized: float = 0.0,
    evened: float = 0.0,
) -> tuple[np.ndarray, float]:
    """A factor of e that follows the work done on a specimen: e' = gain F v - e / forgets, F = what the factor
    leaves of the law's force + beside.

    The definition is in steps, the factor at the end of a step taking e of its beginning; at samples that are not the
    test's own it takes e of its end, as both do where steps are short. All steps are iterated at once, from no
    softening on, until e stays (Picard): its errors fall as those of an exponential series.

    Args:
        motion: of the specimen.
        left_by: what a factor (n,) leaves of the force (n,) N of the law.
        factor: of e (n,), those of the beginnings of the steps, the first one twice.
        before: e at the beginning.
        gain: 1 for e in J.
        forgets: s.
        quick: gain and s of a second e, zero at the beginning, that counts as much.
        beside: force (n,) N in the specimen beside the law's.
        sized: share of the work that counts by its size, done or given back: (1 - sized) F v + sized |F v| for F v.
        evened: s; the power that counts is behind by them, q' + q / evened = F v / evened, and never below zero.

    Returns:
        The factor (n,); e at the end.
    """
    way = 0.5 * motion.ways
    kinds = [(gain, np.exp(-motion.steps / forgets), before)]
    if quick[0]:
        kinds.append((quick[0], np.exp(-motion.steps / quick[1]), 0.0))
    fade = np.exp(-motion.steps / evened) if evened else np.zeros_like(way)
    e = late = np.full(motion.time.size, before)
    for _ in range(_SWEEPS):
        phi = factor(late)
        softened = left_by(phi) + beside
        done = way * (softened[1:] + softened[:-1])
        if sized:
            done += sized * (np.abs(done) - done)
        if evened:
            done = motion.steps * np.maximum(fading(fade, (1.0 - fade) * done / motion.steps, 0.0)[1:], 0.0)
        first, *others = (fading(decay, each * done, start) for each, decay, start in kinds)
        after = sum(others, start=first)
        moved = float(np.max(np.abs(after - e)))
        e, late = after, after if motion.resampled else np.concatenate((after[:1], after[:-1]))
        if moved <= _STILL * float(np.max(np.abs(e))):
            break
    return phi, float(e[-1])
