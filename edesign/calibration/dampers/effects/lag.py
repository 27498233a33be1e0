"""Lag between the channels: the force is recorded later than the displacement, or earlier."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import REFINED, EffectForm
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.filters import relaxed, second_order
from edesign.calibration.dampers.mechanisms import ForceChannel, MotionChannel
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, shape, size
from edesign.estimation.parameters import Parameter

_CLASS = 0.01  # s: lag of a logger's channels
_LONGEST = 0.05  # of the slowest period: more is another test, not a lag
_LATEST, _QUARTER = 0.03, 0.25
"""s: a rig may be as late behind its target, however fast the motion (Bonnet et al., in thesis 6.2.1: 5 to 30 ms). And
of the slowest period, beyond which it moves against its target.
"""
_STARTS = (0.002, 0.02)  # of it: what a long lag does is not linear in it where tests are fast


def later(motion: Motion, lag: float | np.ndarray, rate: float = 0.0, from_rest: bool = False) -> Motion:
    """Return a motion that is late, so that its force is as late.

    After the record it went on as it ends. The force itself has cusps at reversals, which no interpolation between
    its samples follows.

    Args:
        motion: that was measured.
        lag: s, or (n,) s of each sample.
        rate: at which the lag grows, s/s.
        from_rest: whether it was at rest before the record, where it begins; else it went on as it begins.
    """
    time = motion.time
    then = time - lag
    known = np.clip(then, time[0], time[-1])
    u, v, a = (motion.spline.at(values, known) for values in motion.samples[1:])
    onset = None
    if from_rest:
        v = np.where(then < time[0], 0.0, v)
        begins = float(np.interp(time[0], then, time))
        if time[0] < begins < time[-1] and motion.velocity[0]:
            onset = (begins, float(motion.velocity[0]))
    passing = 1.0 - rate  # of the time of what is late
    a = np.where(then == known, a * passing**2, 0.0)
    return Motion(time, u + v * (then - known), v * passing, a, onset=onset)


def _longest(s: Sizes) -> float:
    """Return the longest lag of a motion, s."""
    return max(_LONGEST * s.lag_period, min(_LATEST, _QUARTER * s.lag_period))


def _lag(name: str, s: Sizes) -> Parameter:
    return size(name, "s", min(_CLASS, 0.5 * _longest(s)), -_longest(s), _longest(s))


def _delayed(p: Values, test: Experiment, motion: Motion) -> Motion:
    return later(motion, p["lag"], from_rest=test.from_rest)


def _growing(p: Values, test: Experiment, motion: Motion) -> Motion:
    late = p["lag"] + p["grown"] * test.order / p["N"] + p["skew"] * motion.since
    return later(motion, late, p["skew"], test.from_rest)


def _ahead(p: Values, test: Experiment, motion: Motion) -> Motion:
    tau = p["time_constant"]
    return Motion(
        motion.time,
        motion.displacement + tau * motion.velocity,
        motion.velocity + tau * motion.acceleration,
        motion.acceleration + tau * np.gradient(motion.acceleration, motion.time),
    )


def _filtered(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return relaxed(motion, force, p["time_constant"])


def _of_second_order(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return second_order(motion, force - force[0], p["f"], p["zeta"]) + force[0]


def _time_constant(s: Sizes) -> tuple[Parameter, ...]:
    longest = _LONGEST * s.lag_period
    return (shape("time_constant", "s", min(0.5 * _CLASS, 0.5 * longest), 1e-6 * longest, longest),)


def _second_order(s: Sizes) -> tuple[Parameter, ...]:
    least = 1.0 / (np.pi * _LONGEST * s.lag_period)  # of damping 1 and the longest lag
    return shape("f", "Hz", 10.0 * least, 0.2 * least, 1e4 * least), shape("zeta", "", 0.7, 0.2, 0.99, spread=0.4)


DELAY = EffectForm(
    "lag",
    "delay",
    "instrument",
    "lag between the channels of force and displacement",
    "proportional to the rate of the force: loops too fat or too thin by as much at all amplitudes, in proportion to "
    "frequency",
    "Horiuchi et al. (1999), Earthquake Engng Struct. Dyn. 28, 1121-1141; thesis chapter 6",
    (MotionChannel(_delayed),),
    lambda s: (_lag("lag", s),),
    lambda s: tuple((part * s.lag_period,) for part in _STARTS),
    meanings={
        "lag": "by which the force is late; negative: early, or the displacement late",
        "grown": "by how much more it is late in the last test",
        "skew": "seconds that the lag grows in a second of a test, as of two clocks",
        "time_constant": "of a first-order low-pass in the channel",
        "f": "own frequency of a second-order low-pass",
        "zeta": "damping ratio of it: 0.87 of a Bessel filter, 0.71 of a Butterworth",
    },
)


def _fault(s: Sizes) -> tuple[Parameter, ...]:
    """Return the lag of one test: no error of a class, and within a quarter of the slowest period."""
    return (size("lag", "s", _LONGEST * s.lag_period, -_QUARTER * s.lag_period, _QUARTER * s.lag_period),)


OF_ONE_TEST = replace(DELAY, parameters=_fault)
_FILTER = replace(
    DELAY,
    form="filter",
    title="analogue filter in the force channel alone",
    source="first-order low-pass; Doebelin, Measurement Systems, section 3.3",
    mechanisms=(ForceChannel(_filtered),),
    parameters=_time_constant,
    refined=4,  # the force bends between samples of a fit more than a filter is long
)
_GROWING = replace(
    DELAY,
    form="growing",
    title="lag between the channels that changes within tests and over the campaign",
    signature="proportional to the rate of the force, more and more so as time goes on",
    source="skew of clocks: Mills (1991), IEEE Trans. Commun. 39, 1482-1493; as `delay`",
    mechanisms=(MotionChannel(_growing),),
    parameters=lambda s: (
        _lag("lag", s),
        _lag("grown", s),
        size("skew", "", _CLASS / s.duration, -_longest(s) / s.duration, _longest(s) / s.duration),
    ),
    starts=lambda s: (
        (_STARTS[0] * s.lag_period, _STARTS[0] * s.lag_period, 0.0),
        (_STARTS[0] * s.lag_period, 0.0, _STARTS[0] * s.lag_period / s.duration),
    ),
    constants=lambda s: {"N": max(s.tests - 1.0, 1.0)},
    shown=lambda s: s.ordered,
    proportional=False,
)

FORMS = (
    DELAY,
    _FILTER,
    replace(
        _FILTER,
        form="displacement_filter",
        title="analogue filter in the displacement channel alone",
        mechanisms=(MotionChannel(_ahead),),
        refined=REFINED,
    ),
    replace(
        _FILTER,
        form="second_order",
        title="analogue filter of second order in the force channel alone",
        source="second-order low-pass; Doebelin, Measurement Systems, section 3.3",
        mechanisms=(ForceChannel(_of_second_order),),
        parameters=_second_order,
        starts=lambda s: tuple((0.8 / (np.pi * part * s.lag_period), 0.8) for part in _STARTS),
    ),
    _GROWING,
)
