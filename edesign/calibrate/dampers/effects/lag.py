"""Lag between the channels: the force is recorded later than the displacement, or earlier."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.drivers import envelope
from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.inside import relaxed_force, swung_force
from edesign.calibrate.dampers.trial import REFINED, Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LONGEST, _SLOWEST = 0.05, 20.0
"""Of the slowest period, s, up to this one: more is another test, not a lag; no logger is a second late."""
_LATEST, _QUARTER = 0.03, 0.25
"""s: a rig may be as late behind its target, however fast the motion (Bonnet et al., in thesis 6.2.1: 5 to 30 ms). And
of the slowest period, beyond which it moves against its target.
"""
_STARTS = (0.002, 0.02)  # of it: what a long lag does is not linear in it where tests are fast
_SWINGS, _DAMPED, _STIFF = 20.0, 0.5, 200.0
"""Frequency (Hz) and damping from which that of an actuator is sought, as servo-hydraulic ones have 10 to 40 Hz; and
the highest one: at a twentieth of it the motion is 0.25 % larger than behind a plain delay.
"""
_REMEMBERED = (0.05, 50.0)
"""s: for which an amplitude acts: from a part of a fast swing to more than a test."""
_UNCHANGED = (0.0, 1.0)  # per amplitude, s/m, and memory, s, from which they are sought
_ROUNDED = 1e-9  # relative: an envelope is an exponential of sums


def _later(motion: Motion, lag: float | np.ndarray, rate: float | np.ndarray = 0.0, from_rest: bool = False) -> Motion:
    """A motion late by a time, s, so that its force is as late; (n,) times of each sample grow at a rate, s/s.

    Before the record it went on as it begins, or was at rest where it begins; after it goes on as it ends.
    The force itself has cusps at reversals, that no interpolation between its samples follows.
    """
    time = motion.time
    then = time - lag
    known = np.clip(then, time[0], time[-1])
    u, v, a = (motion.spline.at(one, known) for one in (motion.displacement, motion.velocity, motion.acceleration))
    onset = None
    if from_rest:
        v = np.where(then < time[0], 0.0, v)
        begins = float(np.interp(time[0], then, time))
        if time[0] < begins < time[-1] and motion.velocity[0]:
            onset = (begins, float(motion.velocity[0]))
    passing = 1.0 - rate  # of the time of what is late
    a = np.where(then == known, a * passing**2, 0.0)
    return Motion(time, u + v * (then - known), v * passing, a, onset=onset)


def _period(sizes: Sizes) -> float:
    return min(sizes.period, _SLOWEST)


def _longest(sizes: Sizes) -> float:
    """Of a motion that is late, s."""
    period = _period(sizes)
    return max(_LONGEST * period, min(_LATEST, _QUARTER * period))


class _Lag(Form):
    name: ClassVar[str] = "lag"
    kind: ClassVar[Kind] = "instrument"
    signature: ClassVar[str] = (
        "proportional to the rate of the force: loops too fat or too thin by as much at all amplitudes, in "
        "proportion to frequency"
    )


class Delay(_Lag):
    """The force channel is late by a time: F(t) = F_true(t - lag)."""

    form: ClassVar[str] = "delay"
    title: ClassVar[str] = "lag between the channels of force and displacement"
    source: ClassVar[str] = "Horiuchi et al. (1999), Earthquake Engng Struct. Dyn. 28, 1121-1141; thesis chapter 6"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        longest = _longest(sizes)
        return (Unknown("lag", "s", -longest, longest, 0.1 * longest),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((share * _period(sizes),) for share in _STARTS)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return _later(motion, p["lag"], from_rest=trial.start is None)

    def finer(self) -> tuple[Form, ...]:
        """An actuator that swings behind what was recorded, or is later in larger motions."""
        return Actuator(), WithAmplitude()


class Growing(_Lag):
    """A lag that changes by as much from test to test and from second to second of a test, as two recorders' clocks do.

    F(t) = F_true(t - lag - grown n/N - skew t): n tests before, N before the last one, t since the test began.
    """

    by_order: ClassVar[bool] = True
    form: ClassVar[str] = "growing"
    title: ClassVar[str] = "lag between the channels that changes within tests and over the campaign"
    signature: ClassVar[str] = "proportional to the rate of the force, more and more so as time goes on"
    source: ClassVar[str] = "skew of clocks: Mills (1991), IEEE Trans. Commun. 39, 1482-1493; as `delay`"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        longest = _longest(sizes)
        most = longest / sizes.duration
        return (
            Unknown("lag", "s", -longest, longest, 0.1 * longest),
            Unknown("grown", "s", -longest, longest, 0.1 * longest),
            Unknown("skew", "", -most, most, 0.1 * most),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        own = _STARTS[0] * _period(sizes)
        return (own, own, 0.0), (own, 0.0, own / sizes.duration)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"N": max(sizes.tests - 1.0, 1.0)}

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A lag that stays."""
        return ((Delay(), p),)

    def finer(self) -> tuple[Form, ...]:
        """One that is later in larger motions too: those of some tests may be larger than those of others."""
        return (GrowingWithAmplitude(),)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return _later(motion, self._late(p, trial, motion), p["skew"], trial.start is None)

    @staticmethod
    def _late(p: Values, trial: Trial, motion: Motion) -> np.ndarray:
        return p["lag"] + p["grown"] * trial.order / p["N"] + p["skew"] * (motion.time - motion.time[0])


class Filter(_Lag):
    """A first-order filter in the force channel: tau F' + F = F_true."""

    refined: int = 4  # the force bends between samples of a fit more than a filter is long
    form: ClassVar[str] = "filter"
    title: ClassVar[str] = "analogue filter in the force channel alone"
    source: ClassVar[str] = "first-order low-pass; Doebelin, Measurement Systems, section 3.3"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        longest = _LONGEST * _period(sizes)
        return (Unknown("time_constant", "s", 1e-6 * longest, longest, 0.1 * longest, logarithmic=True),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((share * _period(sizes),) for share in _STARTS)

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return relaxed_force(trial.motion, force, p["time_constant"])


class SecondOrder(_Lag):
    """A second-order filter in the force channel: F + 2 zeta F'/w + F''/w^2 = F_true, w = 2 pi f; late by 2 zeta/w."""

    refined: int = 4
    form: ClassVar[str] = "second_order"
    title: ClassVar[str] = "analogue filter of second order in the force channel alone"
    source: ClassVar[str] = "second-order low-pass; Doebelin, Measurement Systems, section 3.3"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        least = 1.0 / (np.pi * _LONGEST * _period(sizes))  # of damping 1 and the longest lag
        return (
            Unknown("f", "Hz", 0.2 * least, 1e4 * least, 10.0 * least, logarithmic=True),
            Unknown("zeta", "", 0.2, 0.99, 0.7, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.8 / (np.pi * share * _period(sizes)), 0.8) for share in _STARTS)

    def finer(self) -> tuple[Form, ...]:
        """An actuator that swings likewise."""
        return (Actuator(),)

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return swung_force(trial.motion, force - force[0], p["f"], p["zeta"]) + force[0]


class DisplacementFilter(Filter):
    """A first-order filter in the displacement channel: the specimen has moved by u + tau u'."""

    refined: int = REFINED
    form: ClassVar[str] = "displacement_filter"
    title: ClassVar[str] = "analogue filter in the displacement channel alone"

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        tau = p["time_constant"]
        return Motion(
            motion.time,
            motion.displacement + tau * motion.velocity,
            motion.velocity + tau * motion.acceleration,
            motion.acceleration + tau * np.gradient(motion.acceleration, motion.time),
        )

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return force


class Actuator(_Lag):
    """The displacement was recorded before the actuator, as its target: the specimen moves by P(s) times that, late.

    P(s) = e^(-tau s) / (1 + 2 zeta s/w + s^2/w^2), w = 2 pi f; slow motions are late by lag = tau + 2 zeta/w. No
    candidate of a search: beside other effects it would take for its own what dashpots and masses do. It is asked
    where a plain delay or a filter of second order was found and more than noise is left.
    """

    refined: int = 4
    form: ClassVar[str] = "actuator"
    title: ClassVar[str] = "actuator that follows the recorded displacement late, as its target"
    signature: ClassVar[str] = (
        "as a delay, and more force in fast motions than in slow ones: the actuator overshoots below its own frequency"
    )
    source: ClassVar[str] = (
        "Horiuchi et al. (1999), Earthquake Engng Struct. Dyn. 28, 1121-1141; thesis 6.2 (target, command, measured)"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        longest = _longest(sizes)
        least = 1.0 / (np.pi * longest)  # of damping 1 and the longest lag
        return (
            Unknown("lag", "s", -longest, longest, 0.1 * longest),
            Unknown("f", "Hz", min(least, 0.2 * _SWINGS), _STIFF, _SWINGS, logarithmic=True),
            Unknown("zeta", "", 0.1, 0.99, _DAMPED, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((share * _period(sizes), _SWINGS, _DAMPED) for share in _STARTS)

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A plain delay, of an actuator that is stiff next to the motion."""
        return ((Delay(), p),)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        from_rest, swings = trial.start is None, p["zeta"] / (np.pi * p["f"])
        return _later(_swung(motion, p["f"], p["zeta"], from_rest), p["lag"] - swings, from_rest=from_rest)


class WithAmplitude(_Lag):
    """A lag that grows with the amplitude, as that of an actuator does whose valve or pump comes to its limits.

    F(t) = F_true(t - lag - per_amplitude a(t)), a = max(|u|, a before * exp(-h / memory)). No candidate of a search:
    beside other effects it would take for its own what dashpots that soften do. It is asked where a delay was found and
    more than noise is left.
    """

    refined: int = 4
    form: ClassVar[str] = "with_amplitude"
    title: ClassVar[str] = "lag that grows with the amplitude of the motion"
    signature: ClassVar[str] = "proportional to the rate of the force, more so in large motions than in small ones"
    source: ClassVar[str] = (
        "delays that change in a test: Darby, Williams & Blakeborough (2002), J. Eng. Mech. 128, 1276"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*Delay().unknowns(sizes), *_of_amplitude(sizes))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, *_UNCHANGED) for row in Delay().starts(sizes))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """A plain delay, of motions whose amplitude changes nothing."""
        return ((Delay(), p),)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        amplitude, rate = _amplitude(motion, p["memory"])
        late = p["lag"] + p["per_amplitude"] * amplitude
        return _later(motion, late, p["per_amplitude"] * rate, trial.start is None)


class GrowingWithAmplitude(Growing):
    """A lag that changes from test to test and in a test, and grows with the amplitude.

    F(t) = F_true(t - lag - grown n/N - skew t - per_amplitude a(t)). Asked where a growing one was found, as `growing`
    takes for its own that some tests are larger than others.
    """

    refined: int = WithAmplitude.refined
    form: ClassVar[str] = "growing_with_amplitude"
    title: ClassVar[str] = "lag that changes within tests and over the campaign, and grows with the amplitude"
    signature: ClassVar[str] = "proportional to the rate of the force, more so as time goes on and in large motions"
    source: ClassVar[str] = "as `growing` and `with_amplitude`"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), *_of_amplitude(sizes))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, *_UNCHANGED) for row in super().starts(sizes))

    def finer(self) -> tuple[Form, ...]:
        return ()

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """What grows in one way alone."""
        return (WithAmplitude(), p), (Growing(), p)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        amplitude, rate = _amplitude(motion, p["memory"])
        late = self._late(p, trial, motion) + p["per_amplitude"] * amplitude
        return _later(motion, late, p["skew"] + p["per_amplitude"] * rate, trial.start is None)


def _of_amplitude(sizes: Sizes) -> tuple[Unknown, Unknown]:
    """What a lag grows by with the amplitude, and the memory of that."""
    most = _longest(sizes) / sizes.displacement
    return (
        Unknown("per_amplitude", "s/m", -most, most, 0.1 * most),
        Unknown("memory", "s", *_REMEMBERED, _UNCHANGED[1], logarithmic=True),
    )


def _amplitude(motion: Motion, memory: float) -> tuple[np.ndarray, np.ndarray]:
    """Amplitude (n,) m of a motion with a memory, s, and its rate (n,) m/s."""
    amplitude = envelope(motion, memory)
    rises = np.abs(motion.displacement) >= (1.0 - _ROUNDED) * amplitude
    rises &= motion.displacement * motion.velocity > 0.0
    return amplitude, np.where(rises, np.abs(motion.velocity), -amplitude / memory)


def _swung(motion: Motion, frequency: float, damping: float, from_rest: bool) -> Motion:
    """A motion behind a second order of a frequency (Hz) and damping; before it was at rest, or went on as it begins.

    What it begins with is taken off and added again as the response to a ramp, exact however coarse the samples.
    """
    since = motion.time - motion.time[0]
    u, v, a = motion.displacement[0], motion.velocity[0], motion.acceleration[0]
    ramp, step = _ramp_and_step(since, frequency, damping, from_rest)
    return Motion(
        motion.time,
        swung_force(motion, motion.displacement - u - v * since, frequency, damping) + u + v * ramp,
        swung_force(motion, motion.velocity - v, frequency, damping) + v * step,
        swung_force(motion, motion.acceleration - a, frequency, damping) + a * step,
    )


def _ramp_and_step(
    since: np.ndarray, frequency: float, damping: float, from_rest: bool
) -> tuple[np.ndarray, np.ndarray]:
    """Responses (n,) of a second order to a ramp of 1/s and to its velocity, begun at rest or settled."""
    w = 2.0 * np.pi * frequency
    late = 2.0 * damping / w
    if not from_rest:
        return since - late, np.ones_like(since)
    swings, decay = w * np.sqrt(1.0 - damping**2), np.exp(-damping * w * since)
    cosine, sine = decay * np.cos(swings * since), decay * np.sin(swings * since) / swings
    return since - late + late * cosine + (2.0 * damping**2 - 1.0) * sine, 1.0 - cosine - damping * w * sine


FORMS = (Delay, Growing, Filter, SecondOrder, DisplacementFilter)
