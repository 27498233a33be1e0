"""Damper tests as the loop sees them: motion freed from noise, measured force, temperature, place in the campaign."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

import numpy as np

from edesign.calibrate.problem import Use
from edesign.calibrate.spline import Spline
from edesign.damper.history import NONE, Extremes
from edesign.damper.testing.start import Start, widest

_RATE = 40.0  # samples per second that a fit needs at least
_PER_CYCLE = 25  # and in a cycle of the fastest motion
REFINED = 2
"""Times as many samples, at which tests are predicted: the MGMM exact to 3e-5, what most effects do to a few 1e-3."""
WARMER = 0.2
"""K, by which differences are taken."""
APART = 1.0
"""K between temperatures that are not the same: a thermometer may be wrong by 0.2 K in each test."""

_ROUNDED = 0.1  # parts of a step
_NEAR = 1e-3
"""Of a step, between samples before and after an onset: what it is late by is a thousandth of what a step tells."""


@dataclass(frozen=True, eq=False)
class Motion:
    """What a device is made to do: arrays (n,) of time s, displacement m, velocity m/s, acceleration m/s2.

    Attributes:
        passing: whether it stands between two rounds of a prediction, and is not asked for again.
        resampled: whether its samples are others than those of the test: what is defined from sample to sample is taken
            in the limit of short steps.
        onset: time s and velocity m/s with which it sets out from rest between two samples; None: it does not. No cubic
            between these follows a jump of the velocity.
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    passing: bool = field(default=False, kw_only=True)
    resampled: bool = field(default=False, kw_only=True)
    onset: tuple[float, float] | None = field(default=None, kw_only=True)

    def thinned(self, stride: int) -> Motion:
        """Every so many samples."""
        return Motion(
            *(
                np.ascontiguousarray(a[::stride])
                for a in (self.time, self.displacement, self.velocity, self.acceleration)
            ),
            resampled=self.resampled or stride > 1,
        )

    def times(self, factor: float) -> Motion:
        """So many times as large."""
        own = (factor * a for a in (self.displacement, self.velocity, self.acceleration))
        onset = None if self.onset is None else (self.onset[0], factor * self.onset[1])
        return Motion(self.time, *own, onset=onset)

    @cached_property
    def steps(self) -> np.ndarray:
        """Durations (n - 1,) between samples, s."""
        return np.diff(self.time)

    @cached_property
    def ways(self) -> np.ndarray:
        """Ways (n - 1,) between samples, m, signed."""
        return np.diff(self.displacement)

    @cached_property
    def frequency(self) -> float:
        """Of a sine with the root mean squares of velocity and acceleration, Hz."""
        ratio = np.mean(self.acceleration**2) / max(np.mean(self.velocity**2), 1e-300)
        return float(np.sqrt(ratio) / (2.0 * np.pi))

    @cached_property
    def spline(self) -> Spline:
        """Through histories on its samples."""
        return Spline(self.time)

    @cached_property
    def with_onset(self) -> tuple[Motion, np.ndarray] | None:
        """With a sample just before the onset and one just after it, and where (n,) its own ones stand; None: there is
        none. A sample of its own that is as near is the one after.

        The one before is half as far from the onset as the one after, so that the velocity of the cubic between them
        rises all the way, and not beyond its end.
        """
        if self.onset is None:
            return None
        time, velocity = self.onset
        near = _NEAR * float(np.min(self.steps))
        at = int(np.searchsorted(self.time, time - near))
        on_sample = int(self.time[at] <= time + near)
        if on_sample:
            time = self.time[at] - near
        if at == 0 or time - 0.5 * near <= self.time[at - 1]:
            return None
        u = self.displacement[at - 1]
        added = np.array(((time - 0.5 * near, time + near), (u, u + near * velocity), (0.0, velocity), (0.0, 0.0)))
        samples = np.array((self.time, self.displacement, self.velocity, self.acceleration))
        whole = np.hstack((samples[:, :at], added, samples[:, at + on_sample :]))
        own = np.arange(self.time.size)
        own[at:] += 2 - on_sample
        return Motion(*np.ascontiguousarray(whole), resampled=True), own

    @cached_property
    def path(self) -> np.ndarray:
        """Path length (n,) since the beginning of the test, m."""
        return np.concatenate(([0.0], np.cumsum(np.abs(self.ways))))

    @cached_property
    def _finer(self) -> dict[int, Motion]:
        return {}

    def finer(self, parts: int, known: Motion) -> Motion:
        """With every step cut into so many, along cubics through samples of the same motion, all that are known; kept,
        as models ask for it again and again, whatever else their tests are.
        """
        if parts not in self._finer:
            time = self.time
            fine = np.interp(np.arange((time.size - 1) * parts + 1) / parts, np.arange(time.size), time)
            between = (known.spline.at(a, fine) for a in (known.displacement, known.velocity, known.acceleration))
            self._finer[parts] = Motion(fine, *between, resampled=True)
        return self._finer[parts]

    def moved(self, displacement: np.ndarray) -> Motion:
        """Another displacement (n,) at the same times, with its velocity and acceleration by differences of the
        change.
        """
        change = displacement - self.displacement
        rate = np.gradient(change, self.time)
        acceleration = self.acceleration + np.gradient(rate, self.time)
        velocity = self.velocity + rate
        return replace(self, displacement=displacement, velocity=velocity, acceleration=acceleration, onset=None)


_KEPT = 256  # tests with what went before them


@dataclass(frozen=True, eq=False)
class Trial:
    """A test at one rate.

    Attributes:
        name: of the test.
        use: fit or validate.
        order: number of tests made before.
        motion: measured, freed from noise.
        force: measured (n,) N; not a number in a test that is not made yet.
        temperature: (n,) degC: measured, or ambient.
        displacement_noise: standard deviation of white noise as strong next to the motion as that of the displacement
            was, m.
        channel_noise: standard deviation of the noise of the force channel, N.
        motion_noise: standard deviation of the force that noise of the displacement makes through the law, N.
        weight: (n,) factors of a residual that make its noise as strong at all times; None: it is.
        whole: the test at full rate, if this is not.
        been: what the specimen went through before, and its law remembers.
        start: how its record starts away from rest; None: at rest.
    """

    name: str
    use: Use
    order: int
    motion: Motion
    force: np.ndarray
    temperature: np.ndarray
    displacement_noise: float = 0.0
    channel_noise: float = 0.0
    motion_noise: float = 0.0
    weight: np.ndarray | None = None
    whole: Trial | None = None
    been: Extremes = NONE
    start: Start | None = None

    def starting(self, start: Start | None) -> Trial:
        """With another start."""
        return replace(self, start=start, been=NONE if start is None else start.been)

    @cached_property
    def first(self) -> int:
        """First sample that is judged: what is before depends on how the test started."""
        return self.start.first(self.motion.time) if self.start else 0

    @cached_property
    def counted(self) -> np.ndarray | None:
        """`weight` (n,) without the samples that are not judged, for which the others stand; None: all count alike."""
        if not self.first:
            return self.weight
        size = self.motion.time.size
        counted = np.ones(size) if self.weight is None else self.weight.copy()
        counted[: self.first] = 0.0
        return counted * math.sqrt(size / (size - self.first))

    def thinned(self) -> Trial:
        """With no more samples than a fit needs."""
        stride = max(1, int(1.0 / self._coarseness))
        return replace(
            self,
            motion=self.motion.thinned(stride),
            force=np.ascontiguousarray(self.force[::stride]),
            temperature=np.ascontiguousarray(self.temperature[::stride]),
            weight=None if self.weight is None else np.ascontiguousarray(self.weight[::stride]),
            whole=self,
        )

    @cached_property
    def _coarseness(self) -> float:
        """Steps over those that a fit needs."""
        return float(np.median(self.motion.steps)) * max(_RATE, _PER_CYCLE * self.motion.frequency)

    @property
    def noise(self) -> float:
        """Standard deviation of what cannot be predicted, N: noise of the force, and of the motion by the law."""
        return math.hypot(self.channel_noise, self.motion_noise)

    @cached_property
    def made(self) -> bool:
        """Whether it has been made."""
        return bool(np.isfinite(self.force[0]))

    @cached_property
    def mean_temperature(self) -> float:
        """degC."""
        return float(np.mean(self.temperature))

    @cached_property
    def work(self) -> float:
        """Done on the specimen, J."""
        return float(np.sum(0.5 * (self.force[1:] + self.force[:-1]) * self.motion.ways))

    @cached_property
    def _finer(self) -> dict[int, Trial]:
        return {}

    def parts(self, refined: float) -> int:
        """Into how many each step is cut for so many times the samples that a fit needs."""
        return max(1, math.ceil(refined * self._coarseness - _ROUNDED))

    def finer(self, parts: int) -> Trial:
        """With every step cut into so many; kept, as models ask for it again and again."""
        if parts not in self._finer:
            known = self.motion if self.whole is None else self.whole.motion
            motion, time = self.motion.finer(parts, known), self.motion.time
            force, temperature = (np.interp(motion.time, time, values) for values in (self.force, self.temperature))
            self._finer[parts] = replace(self, motion=motion, force=force, temperature=temperature)
        return self._finer[parts]

    @cached_property
    def warmer(self) -> Trial:
        """By WARMER."""
        return replace(self, temperature=self.temperature + WARMER)


@lru_cache(maxsize=_KEPT)
def after(been: Extremes, trial: Trial) -> Trial:
    """A test of a specimen that went through something; kept, with what the test keeps itself."""
    both = widest(been, trial.been)
    return trial if both == trial.been else replace(trial, been=both)


@dataclass(frozen=True)
class Sizes:
    """How large things are in a campaign, over the tests fitted to; SI.

    Attributes:
        force, displacement, velocity, acceleration: largest.
        duration: of the longest test.
        path: of all tests.
        work: dissipated in all tests.
        tests: number in the campaign.
        fitted: (tests,) whether each of them is fitted to.
        period: of the slowest motion (longest time between reversals, times two).
        temperatures: lowest and highest, degC, whatever single readings say.
        levels: how many temperatures the tests fitted to have, each APART from the next.
    """

    force: float
    displacement: float
    velocity: float
    acceleration: float
    duration: float
    path: float
    work: float
    tests: int
    fitted: tuple[bool, ...]
    period: float
    temperatures: tuple[float, float]
    levels: int

    @property
    def stiffness(self) -> float:
        """Largest force over largest displacement, N/m."""
        return self.force / self.displacement

    @property
    def frequency(self) -> float:
        """Of a sine with the largest velocity and the largest acceleration, Hz."""
        return self.acceleration / self.velocity / (2.0 * np.pi)

    @staticmethod
    def of(trials: Sequence[Trial]) -> Sizes:
        """Sizes in trials."""
        fitted = [trial for trial in trials if trial.use == "fit"]

        def largest(values: Sequence[np.ndarray]) -> float:
            return max(float(np.max(np.abs(v))) for v in values)

        temperatures = [value for t in trials for value in _parts_of(t.temperature)]
        work = sum(t.work for t in trials)
        return Sizes(
            force=largest([t.force for t in fitted]),
            displacement=largest([t.motion.displacement for t in fitted]),
            velocity=largest([t.motion.velocity for t in fitted]),
            acceleration=largest([t.motion.acceleration for t in fitted]),
            duration=max(float(t.motion.time[-1] - t.motion.time[0]) for t in trials),
            path=sum(float(t.motion.path[-1]) for t in trials),
            work=abs(work),
            tests=len(trials),
            fitted=tuple(t.use == "fit" for t in trials),
            period=max(_slowest(t.motion) for t in fitted),
            temperatures=(min(temperatures), max(temperatures)),
            levels=_levels([value for t in fitted for value in _parts_of(t.temperature)]),
        )


def _parts_of(temperature: np.ndarray) -> list[float]:
    """Medians of tenths of a test: what it warms is no noise of the thermometer."""
    return [float(np.median(part)) for part in np.array_split(temperature, 10) if part.size]


def _levels(temperatures: Sequence[float]) -> int:
    """How many of them stand APART."""
    first, *others = sorted(temperatures)
    number = 1
    for value in others:
        if value - first >= APART:
            first, number = value, number + 1
    return number


def _slowest(motion: Motion) -> float:
    return float(2.0 * np.pi * np.sqrt(np.mean(motion.displacement**2) / max(np.mean(motion.velocity**2), 1e-300)))


Values = Mapping[str, float]
"""Parameters by name, SI."""
