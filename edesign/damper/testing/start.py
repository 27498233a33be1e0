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
import scipy

from edesign.damper.history import NONE, Extremes
from edesign.damper.testing.independence import independent_errors

StartKind = Literal["at_rest", "in_motion", "continued", "unknown"]
"""What is said of a test: the specimen was undeformed and at rest before the first sample; it was moving; it was moving
as the test before shows; it is to be found out.
"""

SOFTENED = ("mgmm",)
"""Laws that extremes soften for good."""
BEYOND = 100.0
"""Times what a test shows: a largest deformation or velocity after which nothing of the softening is left to come."""

ForceOf = Callable[[np.ndarray, np.ndarray, np.ndarray, Extremes], np.ndarray]
"""Force (n,) N of a damper at times (n,) s under deformation (n,) m and velocity (n,) m/s. It went through extremes and
was then held at the first deformation for long.
"""

_FEWEST = 8  # samples: fewer show no start and something after it
_ROUNDING = 1e-9  # of a time
_SURE = 4.0  # standard errors: one test in sixteen thousand that is at rest seems not to be
_NEARER = 0.5  # share of the way from the force after rest to that in motion
_LONGEST = 0.5  # of a test that is not judged: what lasts longer does not die away
_PEAK = 1.5  # largest velocity of the cubic of a step from rest to rest, over its mean
_LEAST_BIC = 10.0  # Kass and Raftery (1995): "very strong"
_GRID = 2.0 ** np.arange(-6.0, 7.0)  # largest values before a test that are tried, over the largest in it
_PASSES = 2  # over deformation and velocity in turn


@dataclass(frozen=True)
class Start:
    """Start of the record of a test that begins away from rest.

    Attributes:
        displacement, velocity: of the first sample, m, m/s.
        judged_from: s from the first sample; what went before matters until then.
        dies_away: whether it does within the longest time that is left out.
        prior_extremes: what the specimen went through before: as a step from rest has it, or as the force asks for.
        known: whether `prior_extremes` follow from what is said of the test.
    """

    displacement: float
    velocity: float
    judged_from: float
    dies_away: bool
    prior_extremes: Extremes = NONE
    known: bool = False

    @property
    def words(self) -> str:
        """Description, for people, of what is not judged and of what softened the law before."""
        longer = "" if self.dies_away else ", though what went before matters longer"
        texts = [f"its first {self.judged_from:.3g} s are not judged{longer}"]
        softened = [f"{1e3 * size:.3g} {unit}" for size, unit in zip(self.before, ("mm", "mm/s"), strict=True) if size]
        if softened:
            how = "as a step from rest" if self.known else "as its force shows"
            texts.append(f"the law was softened before by {' and '.join(softened)} at least, {how}")
        return "; ".join(texts)

    def first(self, time: np.ndarray) -> int:
        """Return the number of the first sample that is judged.

        Args:
            time: (n,) s.
        """
        return int(np.searchsorted(time, time[0] + self.judged_from * (1.0 - _ROUNDING)))

    @property
    def before(self) -> tuple[float, float]:
        """Largest deformation, m, and velocity, m/s, before the test, the larger one of both ways."""
        prior = self.prior_extremes
        return max(prior[0], -prior[1]), max(prior[2], -prior[3])


class Recorded(NamedTuple):
    """Record of a test in the form in which its start is sought.

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
        """Largest deformation, m, and velocity, m/s."""
        return float(np.max(np.abs(self.displacement))), float(np.max(np.abs(self.velocity)))


def widest(one: Extremes, other: Extremes) -> Extremes:
    """Return the extremes of two histories together.

    Args:
        one: extremes of a history.
        other: extremes of another one.
    """
    return max(one[0], other[0]), min(one[1], other[1]), max(one[2], other[2]), min(one[3], other[3])


def either_way(deformation: float, velocity: float) -> Extremes:
    """Return the extremes of a motion that went as far and as fast to both sides.

    Args:
        deformation: largest, m.
        velocity: largest, m/s.
    """
    return deformation, 0.0 - deformation, velocity, 0.0 - velocity


def one_way(deformation: float, velocity: float) -> Extremes:
    """Return the extremes of a motion from rest to one side, that of the signs.

    Args:
        deformation: m.
        velocity: m/s.
    """
    return max(deformation, 0.0), min(deformation, 0.0) + 0.0, max(velocity, 0.0), min(velocity, 0.0) + 0.0


def find_start(
    test: Recorded, kind: StartKind, ramp: float, force_of: ForceOf, wrong: float | None = None
) -> Start | None:
    """Find how a test starts; None: at rest as a law has it, in motion from there.

    Unless it is said, a test starts away from rest if its first sample is displaced, or if it moves and its force is
    nearer to that of a motion that went on before as it goes on after, mirrored at the first sample, than to the force
    after rest.

    Args:
        ramp: duration of the way from rest to a first sample that is displaced, s.
        wrong: share by which the law may be wrong, where what both mirror images of the test make of its force is
            estimated with it: samples are not judged as long as that is not enough, and the motion alone says how a
            test starts of which the law remembers nothing; None: it is not estimated.
    """
    if test.time.size < _FEWEST:
        return None
    kind = "in_motion" if kind == "continued" else kind  # nothing is asked here but the test itself
    u, v = float(test.displacement[0]), float(test.velocity[0])
    far, jerked = abs(u) > max(_SURE * test.displacement_noise, 1e-8 * test.largest[0]), _jerked(test)
    stepped = _difference(test, force_of, _from_rest(test, ramp)) if far else np.zeros(test.time.size)
    displaced = far and bool(np.any(np.abs(stepped) > test.noise))
    moves = kind == "in_motion" or (kind == "unknown" and (displaced or jerked))
    moving = _difference(test, force_of, _mirrored(test, 1.0)) if moves else np.zeros(test.time.size)
    remembers = bool(np.any(np.maximum(np.abs(stepped), np.abs(moving)) > test.noise))
    if wrong is not None and kind == "unknown" and (far or jerked) and not remembers:
        return Start(u, v, 0.0, True)  # the law says nothing of it, and effects that it lacks may remember
    if not (displaced or moves):
        return None
    left = test.force - force_of(test.time, test.displacement, test.velocity, NONE)
    if not (displaced or kind == "in_motion" or _moved(test, left, moving)):
        return None
    known, most = kind == "at_rest", np.maximum(np.abs(stepped), np.abs(moving))
    if wrong is not None and not known:
        most, left = _beside_ways(test, force_of, (moving, stepped), left, wrong)
    if not known:  # what is said to have been at rest has come from nowhere else, whatever the law leaves
        most = _as_much_as_is_left(most, left, test.noise)
    late = np.flatnonzero(most > test.noise)
    first = min(int(late[-1]) + 1 if late.size else 0, int(_LONGEST * test.time.size))
    dies_away = not late.size or first == int(late[-1]) + 1
    prior = one_way(u, u / ramp) if known else NONE
    return Start(u, v, float(test.time[first] - test.time[0]), dies_away, prior, known)


def extremes_before(
    test: Recorded, first: int, weight: np.ndarray, force_of: Callable[[Extremes], np.ndarray]
) -> Extremes:
    """Find the extremes of a specimen's motion before a test, as its force asks for.

    It is a motion either way, or one to the side of the first sample, whichever suits better. The least that is within
    one standard error of the best is taken, and nothing where that is no better by more than chance.

    Args:
        first: sample that is judged.
        weight: (n,) factors of the residuals that make noise as strong at all times.
        force_of: force (n,) N of the test after extremes.

    Returns:
        The extremes of deformation and velocity.
    """
    side = math.copysign(1.0, test.displacement[0])

    def residual(prior: Extremes) -> np.ndarray:
        return np.asarray((weight * (test.force - force_of(prior)) / test.noise)[first:])

    def to_the_side(deformation: float, velocity: float) -> Extremes:
        return one_way(side * deformation, side * velocity)

    plain = residual(NONE)
    found = [_Went(way, residual, float(plain @ plain)) for way in (either_way, to_the_side)]
    for one in found:
        one.search(test.largest)
    best = min(found, key=lambda one: one.left)
    independent = max(independent_errors([residual(best.prior_extremes)]), 2.0)
    best.drop(math.exp((_LEAST_BIC + math.log(independent)) / independent))
    best.least(max(best.left / independent, 1.0))
    return best.prior_extremes


class _Went:
    """The search for how far and how fast a specimen went before a test.

    Args:
        way: extremes of a deformation and a velocity.
        residual: (n,) in units of noise, after extremes.
        left: sum of squares after none.
    """

    def __init__(
        self, way: Callable[[float, float], Extremes], residual: Callable[[Extremes], np.ndarray], left: float
    ):
        self._way, self._residual = way, residual
        self._size = [0.0, 0.0]
        self.left = left

    @property
    def prior_extremes(self) -> Extremes:
        """As far as it was found."""
        return self._way(*self._size)

    def search(self, reach: tuple[float, float]) -> None:
        """Velocity and deformation in turn, each over a grid and finer; `reach`: largest in the test."""
        for _ in range(_PASSES):
            for which in (1, 0):
                self._size[which], self.left = _best(self._of(which), reach[which], self._size[which], self.left)

    def drop(self, times: float) -> None:
        """Without a deformation or velocity that leaves no more than so many times as much."""
        for which in (0, 1):
            left = self._of(which)(0.0)
            if left <= times * self.left:
                self._size[which], self.left = 0.0, left

    def least(self, more: float) -> None:
        """The least deformation and velocity that leave so much more, which is one standard error."""
        most = self.left + more
        for which in (0, 1):
            self._size[which] = _least(self._of(which), self._size[which], most)

    def _of(self, which: int) -> Callable[[float], float]:
        """Sum of squares by one of them, the other one as it was found."""

        def left(value: float) -> float:
            r = self._residual(self._way(*(value if i == which else size for i, size in enumerate(self._size))))
            return float(r @ r)

        return left


def _best(left: Callable[[float], float], reach: float, here: float, least: float) -> tuple[float, float]:
    """Value at which least is left, and how much that is; here, if no other one is better."""
    tried = [(left(value), value) for value in reach * _GRID]
    at = min(range(len(tried)), key=lambda i: tried[i])
    low, high = tried[max(at - 1, 0)][1], tried[min(at + 1, len(tried) - 1)][1]
    finer = scipy.optimize.minimize_scalar(
        left, bounds=(low, high), method="bounded", options={"xatol": 1e-3 * high, "maxiter": 20}
    )
    best = min((least, here), tried[at], (float(finer.fun), float(finer.x)))
    return best[1], best[0]


def _least(left: Callable[[float], float], value: float, most: float) -> float:
    """The least value up to this one that leaves no more than `most`."""
    if value == 0.0:
        return 0.0
    if left(value) >= most:  # the other one has taken its share since
        return value
    return float(scipy.optimize.brentq(lambda one: left(one) - most, 0.0, value, xtol=1e-3 * value))


def _jerked(test: Recorded) -> bool:
    """Say whether the first sample is too fast for the test's largest acceleration in one interval from rest."""
    largest = float(np.max(np.abs(np.diff(test.velocity) / np.diff(test.time))))
    return abs(float(test.velocity[0])) > largest * float(test.time[1] - test.time[0])


def _moved(test: Recorded, left: np.ndarray, moving: np.ndarray) -> bool:
    """Say whether the force is surely nearer to that of a motion that went on before than to that after rest.

    Args:
        left: (n,) N, what the force leaves of that after rest.
        moving: (n,) N, the difference that a motion before makes.
    """
    power = float(moving @ moving)
    return math.sqrt(power) * (1.0 - _NEARER) > _SURE * test.noise and float(moving @ left) > _NEARER * power


def _as_much_as_is_left(most: np.ndarray, left: np.ndarray, noise: float) -> np.ndarray:
    """Return the difference (n,) N of two ways to the first sample, made as large as the force that is left.

    It is made larger where it lasts: the specimen may have come from farther away.
    """
    lasts = most > noise
    if not np.any(lasts):
        return most
    return most * max(float(np.linalg.norm(left[lasts]) / np.linalg.norm(most[lasts])), 1.0)


Before = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Times, deformations, velocities before the first sample."""


def _from_rest(test: Recorded, duration: float) -> Before:
    return np.array([test.time[0] - duration]), np.zeros(1), np.zeros(1)


def _mirrored(test: Recorded, way: float) -> Before:
    """The test mirrored, and so many times as far: at its first point, if positive; negative: in time."""
    t, u = test.time, test.displacement
    return 2.0 * t[0] - t[:0:-1], u[0] + way * (u[0] - u[:0:-1]), way * test.velocity[:0:-1]


def _beside_ways(
    test: Recorded, force_of: ForceOf, known: tuple[np.ndarray, np.ndarray], left: np.ndarray, wrong: float
) -> tuple[np.ndarray, np.ndarray]:
    """Return what mirror images of the test leave of other ways (n,) N, of the largest, and of the force that is left.

    It is at least the share of the mirror images by which the law may be wrong.

    Args:
        known: (n,) N, what the mirror image through the first point makes of the force, and a step from rest.
    """
    moving, stepped = known
    ways = np.column_stack((moving, _difference(test, force_of, _mirrored(test, -1.0))))
    halves = (_difference(test, force_of, _mirrored(test, way)) for way in (0.5, -0.5))
    others = np.column_stack((*halves, stepped, left))
    others -= ways @ np.linalg.lstsq(ways, others, rcond=None)[0]
    most = np.maximum(np.max(np.abs(others[:, :-1]), axis=1), wrong * np.max(np.abs(ways), axis=1))
    return most, others[:, -1]


def _difference(test: Recorded, force_of: ForceOf, before: Before) -> np.ndarray:
    """What a way to the first sample makes of the force (n,) N, beside being held there for long, extremes alike."""
    own = test.time, test.displacement, test.velocity
    t, u, v = (np.concatenate(both) for both in zip(before, own, strict=True))
    fastest = max(float(np.max(np.abs(v))), _PEAK * float(np.max(np.abs(np.diff(u) / np.diff(t)))))
    prior = either_way(float(np.max(np.abs(u))), fastest)
    return np.asarray(force_of(t, u, v, prior)[before[0].size :] - force_of(*own, prior))
