"""How a test starts: at rest, or away from it, so that its record does not show how the specimen came there.

What went before the first sample acts in two ways. Forces inside a law die away, with its relaxation times or along the
way that a hysteresis forgets: samples are not judged as long as two ways to the first one make forces that differ by
more than noise. The largest deformation and velocity soften some laws for good: they are numbers of their own of each
test.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from edesign.damper.independence import independent_errors

StartKind = Literal["at_rest", "in_motion", "unknown"]
"""What is said of a test: the specimen was undeformed and at rest before the first sample; it was moving; it is to be
found out.
"""

Extremes = tuple[float, float, float, float]
"""Largest and smallest deformation, m, largest and smallest velocity, m/s."""
NONE: Extremes = (0.0, 0.0, 0.0, 0.0)
"""Of a specimen that has not moved."""
SOFTENED = ("mgmm",)
"""Laws that extremes soften for good."""
BEYOND = 100.0
"""Times what a test shows: a largest deformation or velocity after which nothing of the softening is left to come."""

ForceOf = Callable[[np.ndarray, np.ndarray, np.ndarray, Extremes], np.ndarray]
"""Force (n,) N of a damper at times (n,) s under deformation (n,) m and velocity (n,) m/s. It went through extremes and
was then held at the first deformation for long.
"""

_SURE = 4.0  # standard errors: one test in sixteen thousand that is at rest seems not to be
_NEARER = 0.5  # share of the way from the force after rest to that in motion
_LONGEST = 0.5  # of a test that is not judged: what lasts longer does not die away
_PEAK = 1.5  # largest velocity of the cubic of a step from rest to rest, over its mean
_LEAST_BIC = 10.0  # Kass and Raftery (1995): "very strong"
_GRID = 2.0 ** np.arange(-6.0, 7.0)  # largest values before a test that are tried, over the largest in it
_PASSES = 2  # over deformation and velocity in turn


@dataclass(frozen=True)
class Start:
    """How the record of a test starts away from rest.

    Attributes:
        displacement, velocity: of the first sample, m, m/s.
        judged_from: s from the first sample; what went before matters until then.
        dies_away: whether it does within the longest time that is left out.
        been: what the specimen went through before: as a step from rest has it, or as the force asks for.
        known: whether `been` follows from what is said of the test.
    """

    displacement: float
    velocity: float
    judged_from: float
    dies_away: bool
    been: Extremes = NONE
    known: bool = False

    @property
    def before(self) -> tuple[float, float]:
        """Deformation m and velocity m/s, mean of both ways, of `been`."""
        return 0.5 * (self.been[0] - self.been[1]), 0.5 * (self.been[2] - self.been[3])


class Recorded(NamedTuple):
    """A test as its start is looked at.

    Attributes:
        time, displacement, velocity, force: (n,) s, m, m/s, N; the motion freed from noise where that can be done.
        displacement_noise, noise: standard deviations of the displacement, m, and of what cannot be predicted, N.
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    displacement_noise: float
    noise: float

    @property
    def largest(self) -> tuple[float, float]:
        """Deformation and velocity, m, m/s."""
        return float(np.max(np.abs(self.displacement))), float(np.max(np.abs(self.velocity)))


def widest(one: Extremes, other: Extremes) -> Extremes:
    """Extremes of two histories together."""
    return max(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), min(one[3], other[3])


def either_way(deformation: float, velocity: float) -> Extremes:
    """Extremes of a motion that went as far and as fast to both sides."""
    return deformation, -deformation, velocity, -velocity


def find_start(test: Recorded, kind: StartKind, ramp: float, force_of: ForceOf) -> Start | None:
    """How a test starts; None: at rest as a law has it, in motion from there.

    Unless it is said, a test starts away from rest if its first sample is displaced, or if it moves and its force is
    nearer to that of a motion that went on before as it goes on after, mirrored at the first sample, than to the force
    after rest.

    Args:
        test: the record.
        kind: what is said of it.
        ramp: duration of the way from rest to a first sample that is displaced, s.
        force_of: the damper.
    """
    displaced = abs(float(test.displacement[0])) > max(_SURE * test.displacement_noise, 1e-8 * test.largest[0])
    stepped = _difference(test, force_of, _from_rest(test, ramp)) if displaced else np.zeros(test.time.size)
    displaced = displaced and bool(np.any(np.abs(stepped) > test.noise))
    moves = kind == "in_motion" or (kind == "unknown" and (displaced or _jerked(test)))
    moving = _difference(test, force_of, _mirrored(test)) if moves else np.zeros(test.time.size)
    if not (displaced or kind == "in_motion" or (moves and _moved(test, force_of, moving))):
        return None
    late = np.flatnonzero(np.maximum(np.abs(stepped), np.abs(moving)) > test.noise)
    first = min(int(late[-1]) + 1 if late.size else 0, int(_LONGEST * test.time.size))
    dies_away = not late.size or first == int(late[-1]) + 1
    u, v = float(test.displacement[0]), float(test.velocity[0])
    been, known = NONE, kind == "at_rest"
    if known:
        rate = u / ramp
        been = (max(u, 0.0), min(u, 0.0), max(rate, 0.0), min(rate, 0.0))
    return Start(u, v, float(test.time[first] - test.time[0]), dies_away, been, known)


def extremes_before(
    test: Recorded, first: int, weight: np.ndarray, force_of: Callable[[Extremes], np.ndarray]
) -> Extremes:
    """What the specimen went through before a test, as its force asks for: the least that is within one standard error
    of the best, and nothing where that is no better by more than chance.

    Args:
        test: the record.
        first: sample that is judged.
        weight: (n,) factors of the residuals that make noise as strong at all times.
        force_of: force (n,) N of the test after extremes.
    """

    def residual(been: Extremes) -> np.ndarray:
        return np.asarray((weight * (test.force - force_of(been)) / test.noise)[first:])

    plain, reach = residual(NONE), test.largest
    found, least = [0.0, 0.0], float(plain @ plain)

    def with_one(which: int) -> Callable[[float], float]:
        """Sum of squares by a deformation or velocity, the other one as it was found."""

        def left(value: float) -> float:
            r = residual(either_way(value, found[1]) if which == 0 else either_way(found[0], value))
            return float(r @ r)

        return left

    for _ in range(_PASSES):
        for which in (1, 0):
            found[which], least = _best(with_one(which), reach[which], found[which], least)
    best = residual(either_way(*found))
    independent = independent_errors([best])
    size = max(least / independent, 1.0)  # of a change by one standard error
    gain = independent * math.log(max(float(plain @ plain), 1e-300) / max(least, 1e-300))
    if gain - sum(one > 0.0 for one in found) * math.log(max(independent, 2.0)) <= _LEAST_BIC:
        return NONE
    for which in (0, 1):
        found[which] = _least(with_one(which), found[which], least + size)
    return either_way(*found)


def _best(left: Callable[[float], float], reach: float, here: float, least: float) -> tuple[float, float]:
    """Value at which least is left, and how much that is; here, if no other one is better."""
    tried = [(left(value), value) for value in reach * _GRID]
    at = min(range(len(tried)), key=lambda i: tried[i])
    low, high = tried[max(at - 1, 0)][1], tried[min(at + 1, len(tried) - 1)][1]
    finer = minimize_scalar(left, bounds=(low, high), method="bounded", options={"xatol": 1e-3 * high, "maxiter": 20})
    best = min((least, here), tried[at], (float(finer.fun), float(finer.x)))
    return best[1], best[0]


def _least(left: Callable[[float], float], value: float, most: float) -> float:
    """The least value up to this one that leaves no more than `most`."""
    if value == 0.0 or left(0.0) <= most:
        return 0.0
    if left(value) >= most:  # the other one has taken its share since
        return value
    return float(brentq(lambda one: left(one) - most, 0.0, value, xtol=1e-2 * value))


def _jerked(test: Recorded) -> bool:
    """Whether the first sample is faster than the test's largest acceleration makes it in one interval from rest."""
    largest = float(np.max(np.abs(np.diff(test.velocity) / np.diff(test.time))))
    return abs(float(test.velocity[0])) > largest * float(test.time[1] - test.time[0])


def _moved(test: Recorded, force_of: ForceOf, moving: np.ndarray) -> bool:
    """Whether the force is surely nearer to that of a motion that went on before than to that after rest."""
    power = float(moving @ moving)
    if math.sqrt(power) * (1.0 - _NEARER) <= _SURE * test.noise:
        return False
    rest = force_of(test.time, test.displacement, test.velocity, NONE)
    return float(moving @ (test.force - rest)) > _NEARER * power


Before = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times, deformations, velocities before the first sample."""


def _from_rest(test: Recorded, duration: float) -> Before:
    return np.array([test.time[0] - duration]), np.zeros(1), np.zeros(1)


def _mirrored(test: Recorded) -> Before:
    """The test mirrored at its first sample: deformation and velocity go on through it."""
    t, u = test.time, test.displacement
    return 2.0 * t[0] - t[:0:-1], 2.0 * u[0] - u[:0:-1], test.velocity[:0:-1]


def _difference(test: Recorded, force_of: ForceOf, before: Before) -> np.ndarray:
    """What a way to the first sample makes of the force (n,) N, beside being held there for long, extremes alike."""
    own = test.time, test.displacement, test.velocity
    t, u, v = (np.concatenate(both) for both in zip(before, own, strict=True))
    fastest = max(float(np.max(np.abs(v))), _PEAK * float(np.max(np.abs(np.diff(u) / np.diff(t)))))
    been = either_way(float(np.max(np.abs(u))), fastest)
    return np.asarray(force_of(t, u, v, been)[before[0].size :] - force_of(*own, been))
