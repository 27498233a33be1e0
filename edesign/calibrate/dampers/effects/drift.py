"""Drift of the force channel's zero: warming amplifiers, creeping strain gauges."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.cross_validation import FEWEST
from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_MOST_COSINES = 8
_SLOW = 0.01  # share of a motion's power below what is called its slowest frequency


class _Drift(Form):
    name: ClassVar[str] = "drift"
    kind: ClassVar[Kind] = "instrument"
    source: ClassVar[str] = "Doebelin, Measurement Systems, chapter 2 (zero drift)"


class PerTestLine(_Drift):
    """The zero runs away at one rate in every test, set anew before each: F + rate t."""

    form: ClassVar[str] = "per_test_line"
    title: ClassVar[str] = "drift of the force channel at one rate, set to zero before each test"
    signature: ClassVar[str] = "grows in proportion to time in every test, at one rate, whatever the motion"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        rate = sizes.force / sizes.duration
        return (Unknown("rate", "N/s", -rate, rate, 0.1 * rate),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.force / sizes.duration,),)

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return np.asarray(force + p["rate"] * (trial.motion.time - trial.motion.time[0]))


class Campaign(_Drift):
    """The zero runs away at one rate from the first test to the last: F + rate (time tested so far)."""

    form: ClassVar[str] = "campaign"
    title: ClassVar[str] = "drift of the force channel through the whole campaign"
    signature: ClassVar[str] = "grows in proportion to time in every test and goes on in the next"
    remembers: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        rate = sizes.force / sizes.duration
        return (Unknown("rate", "N/s", -rate, rate, 0.1 * rate / sizes.tests),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.force / (sizes.duration * sizes.tests),),)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        before = memory.get("elapsed", 0.0)
        since = before + motion.time - motion.time[0]
        memory["elapsed"] = float(since[-1])
        return np.asarray(p["rate"] * since)


class Displacement(_Drift):
    """The zero of the displacement channel runs away at one rate in every test: u_true = u - rate t."""

    form: ClassVar[str] = "displacement"
    title: ClassVar[str] = "drift of the displacement channel within each test"
    signature: ClassVar[str] = "the force of a shear that grows in proportion to time, the same in every test"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        rate = sizes.displacement / sizes.duration
        return (Unknown("rate", "m/s", -rate, rate, 0.1 * rate),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.displacement / sizes.duration,),)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        gone = p["rate"] * (motion.time - motion.time[0])
        return replace(motion, displacement=motion.displacement - gone, velocity=motion.velocity - p["rate"])


class _Own(_Drift):
    """Each test's own drift: no parameters, but shares of columns."""

    has_columns: bool = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        # where parts of tests are left out a slow course in the rest of a test goes on in them, whatever made it
        return self._in_time(sizes) if sum(sizes.fitted) >= FEWEST else ()

    def _in_time(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        """The starts."""
        return ((),)


class EachOwn(_Own):
    """Each test has a zero and a rate of its own."""

    form: ClassVar[str] = "each_own"
    title: ClassVar[str] = "drift of the force channel, another in each test"
    signature: ClassVar[str] = "a straight line over time in each test, another from test to test"

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        since = trial.motion.time - trial.motion.time[0]
        return np.column_stack((np.ones_like(since), since / since[-1]))


class Warming(_Own):
    """The zero runs to an end as the amplifier warms, at one time of all tests: F + a_i + b_i (1 - exp(-t/tau))."""

    form: ClassVar[str] = "warming"
    title: ClassVar[str] = "drift of the force channel that comes to rest, of another size in each test"
    signature: ClassVar[str] = "fast at the beginning of each test, then ever slower, whatever the motion"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        t = sizes.duration
        return (Unknown("tau", "s", 0.02 * t, 3.0 * t, 0.3 * t, logarithmic=True),)

    def _in_time(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((share * sizes.duration,) for share in (0.1, 0.4, 1.0))

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        since = trial.motion.time - trial.motion.time[0]
        return np.column_stack((np.ones_like(since), -np.expm1(-since / p["tau"])))


class Swinging(_Own):
    """The zero swings with one period of all tests, as with a room's heating: F + a_i + b_i sin(2 pi t/T + phase_i)."""

    form: ClassVar[str] = "swinging"
    title: ClassVar[str] = "zero of the force channel that swings slowly, with one period"
    signature: ClassVar[str] = "a slow sine over time in each test, of one period, whatever the motion"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        t, least = sizes.duration, self._least(sizes)
        return (Unknown("period", "s", least, 10.0 * max(t, least), 0.2 * t, logarithmic=True),)

    def _in_time(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        periods = (max(share * sizes.duration, self._least(sizes)) for share in (0.6, 1.2, 2.4))
        return tuple((period,) for period in dict.fromkeys(periods))

    def _least(self, sizes: Sizes) -> float:
        return max(0.3 * sizes.duration, 2.0 * sizes.period)

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        angle = 2.0 * np.pi * (trial.motion.time - trial.motion.time[0]) / p["period"]
        return np.column_stack((np.ones_like(angle), np.sin(angle), np.cos(angle)))


class Wandering(_Own):
    """The zero wanders: in each test a sum of cosines, all slower than half the slowest motion of the test."""

    form: ClassVar[str] = "wandering"
    beside_motion: ClassVar[bool] = True
    title: ClassVar[str] = "zero of the force channel that wanders slowly"
    signature: ClassVar[str] = "slower than anything that moves, another in each test"

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        time = trial.motion.time
        duration = float(time[-1] - time[0])
        # the cosine of order j has the frequency j / (2 duration)
        orders = np.arange(min(_MOST_COSINES, int(duration * slowest_frequency(trial.motion))) + 1)
        return np.asarray(np.cos(np.pi * np.outer((time - time[0]) / duration, orders)))


def slowest_frequency(motion: Motion) -> float:
    """Frequency Hz below which a hundredth of the power of the displacement lies."""
    u = (motion.displacement - motion.displacement.mean()) * np.hanning(motion.displacement.size)
    power = np.cumsum(np.abs(np.fft.rfft(u)) ** 2)
    at = int(np.searchsorted(power, _SLOW * power[-1]))
    return at / float(motion.time[-1] - motion.time[0])


FORMS = (PerTestLine, Campaign, Displacement, EachOwn, Warming, Swinging, Wandering)
