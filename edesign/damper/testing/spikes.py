"""Spikes of a channel, as of a connector or of telemetry: samples that nothing before or after them leads to."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from edesign.damper.testing.clipping import MEASURED
from edesign.damper.testing.measured_histories import DamperTest
from edesign.estimation.differences import difference_gain, difference_noise, robust_deviation

_LONGEST = 3  # samples in a row: a row that is longer may as well be an event
_BESIDE = 6  # samples before a row and after it by which it is predicted: a cubic leaves eight degrees of freedom
_ONE_SIDE, _BOTH = 2, 3
"""Degrees of the polynomials. What a smooth curve of which a parabola before a sample is short has beyond it, one after
it is as long: such a curve lies between both.
"""
_CHANCE = 0.01  # that a record without spikes has one
_MOVES = 4.0  # steps of the resolution, between which a motion that is read as none would have stopped
_TOLD = 6  # spikes whose times are said
_SPIKES = "is a spike", "are spikes", "was it a connector, or the telemetry?"
_FRAMES = (
    "has the readings of the one before",
    "have the readings of those before",
    "had the controller no new ones?",
)


class Spikes(NamedTuple):
    """Spikes of a channel.

    Attributes:
        at: (n,) which samples are spikes.
        mended: (n,) the channel with cubics through the samples beside a spike in its place.
    """

    at: np.ndarray
    mended: np.ndarray


def spikes(time: np.ndarray, values: np.ndarray, drivers: Sequence[np.ndarray] = ()) -> Spikes:
    """Return the spikes of a channel.

    A row of three samples or fewer is a spike if all of it lies beyond three predictions, to the same side of them: of
    a parabola through the six samples before it, one through the six after it, and a cubic through both. A corner, a
    step or the end of a slip has one side that leads to it. The bound is Bonferroni's of deleted residuals, which have
    Student's distribution if the noise is normal. So coarse sampling and curves that the cubic does not follow have
    wide bounds. The noise is that of the samples beside the row, and not less than that of the record.

    Impacts may be as short, but what moves makes them: they recur where it is the same. Spikes come at any time. Those
    of which chance would put as many so close together in a driver are none.

    Args:
        time: (n,) s, ascending.
        values: (n,) in any unit.
        drivers: (n,) of what may make impacts: displacement and velocity.

    Source: Cook & Weisberg (1982), Residuals and Influence in Regression, 2.2.2 (deleted residuals, Bonferroni); Glaz,
    Naus & Wallenstein (2001), Scan Statistics, Springer, chapter 2 (points close together by chance).
    """
    none = Spikes(np.zeros(values.size, dtype=bool), values)
    if values.size <= 2 * _BESIDE + 1 or not np.ptp(values):
        return none
    curve = _Curve(time, values)
    suspects = curve.suspects()
    if not np.any(suspects):
        return none
    off = np.zeros(values.size, dtype=bool)
    for first, last in _rows(suspects):
        off[first : last + 1] = curve.beyond_both(first, last, suspects)
    every = _rows(off)
    event = np.zeros(len(every), dtype=bool)
    for driver in drivers:
        begun = driver[[first for first, _ in every]]
        event |= _gathered(np.searchsorted(np.sort(driver), begun) / values.size, len(drivers))
    rows = [
        (first, last)
        for (first, last), recurs in zip(every, event, strict=True)
        if not recurs and last - first < _LONGEST and curve.is_spike(first, last, off)
    ]
    found, mended = np.zeros(values.size, dtype=bool), values.copy()
    for first, last in rows:
        found[first : last + 1] = True
    for first, last in rows:
        mended[first : last + 1] = curve.through_both(first, last, found).value
    return Spikes(found, mended)


def spikes_beside(
    time: np.ndarray, values: np.ndarray, predicted: np.ndarray, drivers: Sequence[np.ndarray] = ()
) -> Spikes:
    """Return the spikes of a channel in what a model leaves of it, which is smoother than the channel.

    Where a model is late at a corner it leaves rows that are as short. The channel has one side that leads to these. So
    a spike is beyond the lines through the two samples before and after it in the channel too, by more than half of
    what it is off by.

    Args:
        time: (n,) s, ascending.
        values: (n,) in any unit.
        predicted: (n,) in that unit.
        drivers: as of `spikes`.
    """
    left = values - predicted
    found = spikes(time, left, drivers)
    at, off = found.at.copy(), left - found.mended
    for first, last in _rows(found.at):
        row = np.arange(first, last + 1)
        for near, far in ((first - 1, first - 2), (last + 1, last + 2)):
            slope = (values[far] - values[near]) / (time[far] - time[near])
            beyond = values[row] - values[near] - slope * (time[row] - time[near])
            at[row] &= bool(np.all(np.sign(off[row]) * beyond > 0.5 * np.abs(off[row])))
    return Spikes(at, np.where(at, predicted + found.mended, values))


class _Prediction(NamedTuple):
    """Of a row of samples, by a polynomial through others: value and standard deviation, (k,)."""

    value: np.ndarray
    deviation: np.ndarray
    noise: float


class _Curve:
    """A channel whose samples are predicted by those beside them."""

    def __init__(self, time: np.ndarray, values: np.ndarray) -> None:
        self._time, self._values = time, values
        differences = np.abs(np.diff(values, 4)) / difference_gain(4)
        changes = np.abs(np.diff(values))
        rounded = float(np.min(changes[changes > 0.0])) / math.sqrt(12.0)  # to steps of a digitiser, if it has any
        least = max(rounded, MEASURED * float(np.ptp(values)))
        self._noise = max(robust_deviation(differences), least)
        self._differences = np.concatenate((np.zeros(2), differences, np.zeros(2)))
        self._quantile = 1.0 - 0.5 * _CHANCE / values.size

    def suspects(self) -> np.ndarray:
        """Return the samples (n,) that may be spikes, or beside one: others are taken as good."""
        return self._differences > self._bound(math.inf) * self._noise

    def beyond_both(self, first: int, last: int, without: np.ndarray) -> np.ndarray:
        """Return which samples (k,) of a row are beyond what samples before and after it predict."""
        if (beside := self._beside(first, last, without)) is None:
            return np.zeros(last - first + 1, dtype=bool)
        of_both = self._predicted(first, last, np.concatenate(beside), _BOTH)
        return np.abs(self._beyond(first, last, of_both)) > self._bound(2 * _BESIDE - _BOTH - 1)

    def is_spike(self, first: int, last: int, without: np.ndarray) -> bool:
        """Return whether all of a row is beyond what the samples before, after, and on both sides of it predict."""
        if (beside := self._beside(first, last, without)) is None:
            return False
        of_both = self._predicted(first, last, np.concatenate(beside), _BOTH)
        of_each = [self._predicted(first, last, side, _ONE_SIDE, of_both.noise) for side in beside]
        beyond = np.array([self._beyond(first, last, one) for one in (of_both, *of_each)])
        least = np.min(np.abs(beyond), axis=0) > self._bound(2 * _BESIDE - _BOTH - 1)
        return bool(np.all(least & (np.abs(np.sum(np.sign(beyond), axis=0)) == len(beyond))))

    def through_both(self, first: int, last: int, without: np.ndarray) -> _Prediction:
        """Return what samples on both sides of a row predict; there are enough."""
        beside = self._beside(first, last, without)
        assert beside is not None
        return self._predicted(first, last, np.concatenate(beside), _BOTH)

    def _bound(self, freedom: float) -> float:
        from scipy.special import stdtrit  # scipy takes time at the start of every command

        return float(stdtrit(min(freedom, 1e9), self._quantile))

    def _beside(self, first: int, last: int, without: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Return the nearest samples before and after a row; None: there are too few."""
        before, after = np.flatnonzero(~without[:first])[-_BESIDE:], np.flatnonzero(~without[last + 1 :])[:_BESIDE]
        return (before, after + last + 1) if min(before.size, after.size) == _BESIDE else None

    def _predicted(self, first: int, last: int, by: np.ndarray, degree: int, noise: float = 0.0) -> _Prediction:
        """Return what a polynomial through samples predicts; a noise of 0.0 is that which it leaves of them."""
        unit = 1.0 / max(float(np.ptp(self._time[by])), 1e-300)
        middle = float(self._time[first])
        rows, at = (np.vander((self._time[i] - middle) * unit, degree + 1) for i in (by, np.arange(first, last + 1)))
        orthogonal, triangle = np.linalg.qr(rows)
        shape = np.linalg.solve(triangle.T, at.T)  # (p, k)
        coordinates = orthogonal.T @ self._values[by]
        left = self._values[by] - orthogonal @ coordinates
        own = noise or max(float(np.sqrt(left @ left / (by.size - degree - 1))), self._noise)
        return _Prediction(shape.T @ coordinates, own * np.sqrt(1.0 + np.sum(shape**2, axis=0)), own)

    def _beyond(self, first: int, last: int, predicted: _Prediction) -> np.ndarray:
        return (self._values[first : last + 1] - predicted.value) / predicted.deviation


def _rows(of: np.ndarray) -> list[tuple[int, int]]:
    """First and last sample of each row."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], of.astype(np.int8), [0]))))
    return list(zip(edges[::2].tolist(), (edges[1::2] - 1).tolist(), strict=True))


def _gathered(places: np.ndarray, drivers: int) -> np.ndarray:
    """Return which places (k,), of numbers from 0 to 1, are in a part in which chance would not put as many."""
    order, k = np.argsort(places), places.size
    found = np.zeros(k, dtype=bool)
    for m in range(2, k + 1):
        spans = np.maximum(places[order[m - 1 :]] - places[order[: k - m + 1]], 1e-12)
        chance = math.log(math.comb(k, m) * m * drivers * k * (k - 1) // 2) + (m - 1) * np.log(spans)
        for i in np.flatnonzero(chance < math.log(_CHANCE)):
            found[order[i : i + m]] = True
    return found


def repeated_frames(test: DamperTest) -> np.ndarray:
    """Return which samples (n,) repeat the frame before, of both channels, while the specimen moves on.

    A motion does not stop for one to three samples between steps of four times its resolution to the same side. Noise
    s makes two equal readings between steps L of a motion whatever its speed with a chance of exp(-L^2/(10 s^2)) at
    most: the likeliest four errors for that have the sum of squares L^2/5.
    """
    u, found = test.displacement, np.zeros(test.time.size, dtype=bool)
    steps = np.diff(u)
    same = found[1:] if test.force is None else (steps == 0.0) & (np.diff(test.force) == 0.0)
    by_noise = math.sqrt(10.0 * math.log(u.size / _CHANCE)) * difference_noise(u, np.ones(u.size))
    least = max(_MOVES * float(np.min(np.abs(steps[steps != 0.0]), initial=math.inf)), by_noise)
    for first, last in _rows(np.concatenate(([False], same))):
        if last - first < _LONGEST and min(first, u.size - 1 - last) > _BESIDE:
            before, after = steps[first - 2], steps[last]
            found[first : last + 1] = before * after > 0.0 and min(abs(before), abs(after)) > least
    return found


def _without(test: DamperTest, values: np.ndarray, frames: np.ndarray, drivers: Sequence[np.ndarray] = ()) -> Spikes:
    """Return the spikes of a channel (n,) of a test, and the frames that are none of its own as such."""
    mended = values.copy()
    for first, last in _rows(frames):
        mended[first : last + 1] = _Curve(test.time, values).through_both(first, last, frames).value
    found = spikes(test.time, mended, drivers)
    return Spikes(found.at | frames, found.mended)


def spikes_of(test: DamperTest) -> tuple[Spikes, Spikes | None]:
    """Return the spikes of the displacement of a test, and those of its force; None: it was not measured.

    Frames that repeat the one before are spikes of both.
    """
    frames = repeated_frames(test)
    of_motion = _without(test, test.displacement, frames)
    if test.force is None:
        return of_motion, None
    drivers = of_motion.mended, np.gradient(of_motion.mended, test.time)
    return of_motion, _without(test, test.force, frames, drivers)


def without_spikes(test: DamperTest) -> DamperTest:
    """Return a test whose channels are interpolated at their spikes; itself if there are none."""
    of_motion, of_force = spikes_of(test)
    if not np.any(of_motion.at) and (of_force is None or not np.any(of_force.at)):
        return test
    return replace(test, displacement=of_motion.mended, force=None if of_force is None else of_force.mended)


def spike_warnings(test: DamperTest) -> list[str]:
    """Return what is to be said of spikes of a test, for people, one text for each channel that has some.

    Args:
        test: with or without a force.
    """
    of_motion, of_force = spikes_of(test)
    found, frames = [], repeated_frames(test)
    if of_force is not None and np.any(at := of_force.at & ~frames):
        off = 1e-3 * (test.measured_force() - of_force.mended)
        said = _said(test.time, at, off, "kN", *_SPIKES)
        found.append(f"force: {said} A calibration does not judge them")
    for at, words in ((of_motion.at & ~frames, _SPIKES), (frames, _FRAMES)):
        if np.any(at):
            said = _said(test.time, at, 1e3 * (test.displacement - of_motion.mended), "mm", *words)
            found.append(
                f"displacement: {said} A calibration interpolates over them, and does not judge the force there"
            )
    return found


def spike_notes(tests: Iterable[DamperTest]) -> tuple[str, ...]:
    """Return what is to be said of spikes, one line for each channel of a test that has some.

    Args:
        tests: of a campaign.
    """
    return tuple(f"{test.name}: {text}" for test in tests for text in spike_warnings(test))


def _said(time: np.ndarray, at: np.ndarray, off: np.ndarray, unit: str, one: str, several: str, cause: str) -> str:
    times = time[at]
    when = ", ".join(f"{each:.6g}" for each in times[:_TOLD]) + (" ..." if times.size > _TOLD else "")
    number = f"1 sample {one}" if times.size == 1 else f"{times.size} samples {several}"
    far = np.max(np.abs(off[at]))
    return f"{number}, at {when} s, up to {far:.3g} {unit} from what the samples before and after say: {cause}"
