"""Lag between the channels: the force is recorded later than the displacement, or earlier."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.inside import relaxed_force, swung_force
from edesign.calibrate.dampers.trial import REFINED, Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LONGEST, _SLOWEST = 0.05, 20.0
"""Of the slowest period, s, up to this one: more is another test, not a lag; no logger is a second late."""
_STARTS = (0.002, 0.02)  # of it: what a long lag does is not linear in it where tests are fast


def _later(motion: Motion, lag: float, skew: float = 0.0) -> Motion:
    """A motion late by a time, s, and a share of the time since its beginning: what it makes of force is as late.

    The force itself has cusps at reversals, that no interpolation between its samples follows.
    """
    time = motion.time
    then = time - lag - skew * (time - time[0])
    known = np.clip(then, time[0], time[-1])
    u, v, a = (motion.spline.at(one, known) for one in (motion.displacement, motion.velocity, motion.acceleration))
    return Motion(time, u + v * (then - known), v, np.where(then == known, a, 0.0))  # on as it was, beyond the record


def _period(sizes: Sizes) -> float:
    return min(sizes.period, _SLOWEST)


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
        longest = _LONGEST * _period(sizes)
        return (Unknown("lag", "s", -longest, longest, 0.1 * longest),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((share * _period(sizes),) for share in _STARTS)

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return _later(motion, p["lag"])


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
        longest = _LONGEST * _period(sizes)
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

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return _later(motion, p["lag"] + p["grown"] * trial.order / p["N"], p["skew"])


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


FORMS = (Delay, Growing, Filter, SecondOrder, DisplacementFilter)
