"""The motion of a test, and what is derived from it alone: finer samples, turning points, extremes, amplitude."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from edesign.calibration.signals.interpolation import CUBIC, through
from edesign.calibration.signals.spline import Spline
from edesign.damper.history import Extremes

_NEAR = 1e-3
"""Of a step, between samples before and after an onset: what it is late by is a thousandth of what a step shows."""
_AT_END = 3
"""Samples at an end whose derivatives follow from the end condition of a spline: the equations (1, 4, 1) of its slopes
have the solution (3^(1/2) - 2)^k, so that what it is wrong by falls to 0.27 a sample, and to 2 % after these.
"""
_MOST = 0.1  # of a record, that its ends may be
_SLOW = 0.01  # of the largest velocity: a motion that is no faster at an end is at rest there


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion at samples.

    Attributes:
        time: (n,) s, ascending.
        displacement: (n,) m.
        velocity: (n,) m/s.
        acceleration: (n,) m/s2.
        onset: time s and velocity m/s with which the motion sets out from rest between two samples; None: it does not.
            No cubic between these follows a jump of the velocity.
        cornered: whether samples are too few for a spline: cubics with the velocities at the samples stand between.
        preceded: number of samples that were before the test.
        degree: of the spline that stands between otherwise.
    """

    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    onset: tuple[float, float] | None = field(default=None, kw_only=True)
    cornered: bool = field(default=False, kw_only=True)
    preceded: int = field(default=0, kw_only=True)
    degree: int = field(default=CUBIC, kw_only=True)

    @staticmethod
    def along(time: np.ndarray, displacement: np.ndarray, degree: int) -> Motion:
        """Return the motion of a spline of a degree through samples (n,) s and m."""
        spline = through(time, displacement, degree)
        return Motion(time, displacement, spline(time, 1), spline(time, 2), degree=degree)

    @property
    def samples(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Time, displacement, velocity, acceleration."""
        return self.time, self.displacement, self.velocity, self.acceleration

    def each(self, change: Callable[[np.ndarray], np.ndarray]) -> Motion:
        """Return the motion with displacement, velocity and acceleration changed in the same way.

        Args:
            change: linear function of a history (n,).
        """
        return Motion(self.time, *(change(values) for values in self.samples[1:]))

    def scaled(self, factor: float) -> Motion:
        """Return the motion, so many times as large.

        Args:
            factor: without unit.
        """
        onset = None if self.onset is None else (self.onset[0], factor * self.onset[1])
        return replace(self.each(lambda values: factor * values), onset=onset)

    def thinned(self, stride: int) -> Motion:
        """Return the motion at every so many samples.

        Args:
            stride: at least 1.
        """
        samples = (np.ascontiguousarray(values[::stride]) for values in self.samples)
        return Motion(*samples, cornered=self.cornered)

    def finer(self, parts: int, known: Motion) -> Motion:
        """Return the motion with every step cut into parts, along cubics through all that is known of it.

        Args:
            parts: of a step, at least 1.
            known: the same motion at more samples, or itself.
        """
        if parts == 1:
            return self
        n = self.time.size
        time = np.interp(np.arange((n - 1) * parts + 1) / parts, np.arange(n), self.time)
        if known.cornered:
            cubics = CubicHermiteSpline(known.time, known.displacement, known.velocity)
            return Motion(time, cubics(time), cubics(time, 1), cubics(time, 2), cornered=True)
        if known.degree != CUBIC:
            spline = through(known.time, known.displacement, known.degree)
            return Motion(time, spline(time), spline(time, 1), spline(time, 2))
        return Motion(time, *(known.spline.at(values, time) for values in known.samples[1:]))

    def after(self, way: float) -> Motion:
        """Return the motion after its own mirror image, which ends with the first sample.

        Args:
            way: 1.0: mirrored at the first point, so that it goes on with its velocity; -1.0: in time, so that it comes
                back.
        """
        t, u, v, a = (values[:0:-1] for values in self.samples)
        first, here = self.time[0], self.displacement[0]
        before = 2.0 * first - t, here + way * (here - u), way * v, -way * a
        whole = (np.concatenate(both) for both in zip(before, self.samples, strict=True))
        return Motion(*whole, cornered=self.cornered, degree=self.degree, preceded=t.size)

    def joined(self, before: Motion) -> Motion:
        """Return the motion after another one, which ends one step before its first sample, or when its times say.

        Args:
            before: of the same specimen.
        """
        earlier = before if before.with_onset is None else before.with_onset[0]
        gap = self.time[0] - earlier.time[-1]
        t = earlier.time + (0.0 if gap > 0.0 else gap - float(self.steps[0]))
        both = zip((t, *earlier.samples[1:]), self.samples, strict=True)
        return Motion(*(np.concatenate(pair) for pair in both), cornered=self.cornered, preceded=t.size)

    @cached_property
    def ends(self) -> np.ndarray:
        """Samples (n,) at an end in motion, where velocity and acceleration are not known."""
        found, speed = np.zeros(self.time.size, dtype=bool), np.abs(self.velocity)
        if not self.cornered and 2 * _AT_END <= _MOST * found.size:
            fast = _SLOW * float(np.max(speed))
            found[:_AT_END], found[-_AT_END:] = speed[0] > fast, speed[-1] > fast
        return found

    @cached_property
    def steps(self) -> np.ndarray:
        """Durations (n - 1,) between samples, s."""
        return np.diff(self.time)

    @cached_property
    def increments(self) -> np.ndarray:
        """Changes (n - 1,) of the displacement between samples, m."""
        return np.diff(self.displacement)

    @cached_property
    def since(self) -> np.ndarray:
        """Time (n,) since the first sample, s."""
        return self.time - self.time[0]

    @cached_property
    def path(self) -> float:
        """Path length, m."""
        return float(np.sum(np.abs(self.increments)))

    @cached_property
    def frequency(self) -> float:
        """Frequency of a sine with the root mean squares of velocity and acceleration, Hz.

        It is at most half of the sampling: where two samples are much closer than the others, a corner between them
        has an acceleration that is that of no motion.
        """
        ratio = np.mean(self.acceleration**2) / max(np.mean(self.velocity**2), 1e-300)
        return min(float(np.sqrt(ratio) / (2.0 * np.pi)), 0.5 / float(np.median(self.steps)))

    @cached_property
    def spline(self) -> Spline:
        """Spline through histories on its samples."""
        return Spline(self.time)

    @cached_property
    def with_onset(self) -> tuple[Motion, np.ndarray] | None:
        """The motion with samples just before and after the onset, and where (n,) its own stand; None: there is none.

        A sample of its own that is as near is the one after. The one before is half as far from the onset as the one
        after, so that the velocity of the cubic between them rises all the way, and not beyond its end.
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
        samples = np.array(self.samples)
        whole = np.hstack((samples[:, :at], added, samples[:, at + on_sample :]))
        own = np.arange(self.time.size)
        own[at:] += 2 - on_sample
        return Motion(*np.ascontiguousarray(whole)), own

    @cached_property
    def turning_points(self) -> tuple[np.ndarray, np.ndarray]:
        """Displacements (m,) m, monotone from one to the next, and the index (n,) of each sample among them.

        They are the samples, and the extremes of the cubics between them: at 30 samples in a cycle the largest sample
        may be 0.5 % short of the extreme, which matters beside a play of 1 %.
        """
        u, v, h = self.displacement, self.velocity, self.steps
        turned = np.flatnonzero(v[:-1] * v[1:] < 0.0)
        index = np.arange(u.size)
        if not turned.size:
            return u, index
        u0, u1, step = u[turned], u[turned + 1], h[turned]
        v0, v1 = v[turned] * step, v[turned + 1] * step
        # velocity of the cubic over s = 0..1: v0 + 2 b s + 3 c s^2; its one root there, by the form that never cancels
        b, c = 3.0 * (u1 - u0) - 2.0 * v0 - v1, 2.0 * (u0 - u1) + v0 + v1
        root = np.sqrt(np.maximum(b**2 - 3.0 * c * v0, 0.0))
        s = np.clip(-v0 / (b - np.sign(v0) * root), 0.0, 1.0)
        points = np.insert(u, turned + 1, u0 + s * (v0 + s * (b + s * c)))
        index[1:] += np.cumsum(v[:-1] * v[1:] < 0.0)
        return points, index

    @cached_property
    def extremes(self) -> Extremes:
        """Extremes of a specimen after the motion, along the cubics between its samples; it begins at zero."""
        deformations, _ = self.turning_points
        v, h = self.velocity, self.steps
        rate = self.increments / h
        # over s = 0..1 the velocity is v0 + 2 b s + 3 c s^2 (cubic through displacement and velocity at both ends)
        b, c = 3.0 * rate - 2.0 * v[:-1] - v[1:], v[:-1] + v[1:] - 2.0 * rate
        inside = (np.abs(b) < np.abs(3.0 * c)) & (b * c < 0.0)
        velocities = np.concatenate((v, v[:-1][inside] - b[inside] ** 2 / (3.0 * c[inside])))
        return (
            max(0.0, float(deformations.max())),
            min(0.0, float(deformations.min())) + 0.0,
            max(0.0, float(velocities.max())),
            min(0.0, float(velocities.min())) + 0.0,
        )
