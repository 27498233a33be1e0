"""Zeros of the channels: offsets, drift, hum of the mains."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import EffectForm, either
from edesign.calibration.dampers.effects.gas_spring import FLUID, PRESSED
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import ForceChannel, MotionChannel, NuisanceAmplitudes
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.nuisance import Told
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, size

_CLASS = 0.05  # of the largest force or displacement: standard deviation of a zero
# of a test: time constant of an amplifier that warms up; with a line it stands for longer and shorter ones
_WARM = 0.25
_DOEBELIN = "Doebelin, Measurement Systems, chapter 2 (zero drift)"


def _zero(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["offset"])


def _line(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["rate"] * motion.since)


def _through(p: Values, test: Experiment, motion: Motion, force: np.ndarray) -> np.ndarray:
    return np.asarray(force + p["rate"] * (test.elapsed + motion.since))


def _running(p: Values, test: Experiment, motion: Motion) -> Motion:
    gone = p["rate"] * motion.since
    return replace(motion, displacement=motion.displacement - gone, velocity=motion.velocity - p["rate"])


def _own_zero(p: Values, test: Experiment) -> np.ndarray:
    return np.full((test.force.size, 1), p["size"])


def _own_line(p: Values, test: Experiment) -> np.ndarray:
    """Return a line from nothing at the first sample: what the channel shows there is its zero, another fault."""
    since = test.motion.since
    return p["size"] * (since / since[-1])[:, np.newaxis]


def _own_warming(p: Values, test: Experiment) -> np.ndarray:
    """Return that line, and what comes to an end within the test."""
    gone = test.motion.since / test.motion.since[-1]
    return p["size"] * np.column_stack((gone, -np.expm1(-gone / _WARM)))


def _waves(p: Values, test: Experiment) -> np.ndarray:
    """Return sine and cosine of each frequency, whose shares are amplitude and phase of a test."""
    angles = [2.0 * np.pi * f * test.motion.since for name, f in p.items() if name != "size"]
    return p["size"] * np.column_stack([wave(angle) for angle in angles for wave in (np.sin, np.cos)])


def _told_zero(p: Values, test: Experiment) -> tuple[Told, ...]:
    return (Told("zero", "N", np.array([p["size"]])),)


def _told_line(p: Values, test: Experiment) -> tuple[Told, ...]:
    return (Told("drift over the test", "N", np.array([p["size"]])),)


def _told_warming(p: Values, test: Experiment) -> tuple[Told, ...]:
    return (Told("drift over the test", "N", p["size"] * np.array([1.0, -np.expm1(-1.0 / _WARM)])),)


def _told_waves(p: Values, test: Experiment) -> tuple[Told, ...]:
    tones = [f for name, f in p.items() if name != "size"]
    each = p["size"] * np.eye(2 * len(tones))
    return tuple(Told("hum", "N", each[2 * i : 2 * i + 2], f) for i, f in enumerate(tones))


def _of_class(s: Sizes) -> dict[str, float]:
    return {"size": _CLASS * s.force}


_CONSTANT = EffectForm(
    "offset",
    "constant",
    "instrument",
    "zero of the force channel, the same in all tests",
    "a constant force, the same in all tests, there before anything moves",
    "ISO 376:2011 (zero error); Doebelin, Measurement Systems, chapter 2 (zero drift)",
    (ForceChannel(_zero),),
    lambda s: (size("offset", "N", _CLASS * s.force, -s.force, s.force),),
    lambda s: ((_CLASS * s.force,),),
    meanings={"offset": "reading of the load cell under no force; negative: to the other side"},
    exact=True,
)
_PER_TEST = replace(
    _CONSTANT,
    form="per_test",
    title="zero of the force channel, set anew for each test",
    signature="a constant force in each test, another one from test to test",
    mechanisms=(NuisanceAmplitudes(_own_zero, _told_zero),),
    parameters=lambda s: (),
    starts=lambda s: ((),),
    constants=_of_class,
)
_PER_TEST_LINE = EffectForm(
    "drift",
    "per_test_line",
    "instrument",
    "drift of the force channel at one rate, set to zero before each test",
    "grows in proportion to time in every test, at one rate, whatever the motion",
    _DOEBELIN,
    (ForceChannel(_line),),
    lambda s: (size("rate", "N/s", _CLASS * s.force / s.duration, -s.force / s.duration, s.force / s.duration),),
    lambda s: ((_CLASS * s.force / s.duration,),),
    meanings={"rate": "at which the zero of the channel moves; negative: to the other side"},
)
_CAMPAIGN = replace(
    _PER_TEST_LINE,
    form="campaign",
    title="drift of the force channel through the whole campaign",
    signature="grows in proportion to time in every test and goes on in the next",
    mechanisms=(ForceChannel(_through),),
    parameters=lambda s: (
        size("rate", "N/s", _CLASS * s.force / s.total, -s.force / s.duration, s.force / s.duration),
    ),
    starts=lambda s: ((_CLASS * s.force / s.total,),),
    shown=lambda s: s.ordered,
)
_DISPLACEMENT = replace(
    _PER_TEST_LINE,
    form="displacement",
    title="drift of the displacement channel within each test",
    signature="the force of a shear that grows in proportion to time, the same in every test",
    mechanisms=(MotionChannel(_running),),
    parameters=lambda s: (
        size(
            "rate",
            "m/s",
            _CLASS * s.displacement / s.duration,
            -s.displacement / s.duration,
            s.displacement / s.duration,
        ),
    ),
    starts=lambda s: ((_CLASS * s.displacement / s.duration,),),
)
_EACH_OWN = replace(
    _PER_TEST,
    name="drift",
    form="each_own",
    title="drift of the force channel, another in each test",
    signature="a straight line over time in each test, from nothing at its first sample, another from test to test",
    source=_DOEBELIN,
    mechanisms=(NuisanceAmplitudes(_own_line, _told_line),),
)
_WARMING = replace(
    _EACH_OWN,
    form="warming",
    title="drift of the force channel that slows down, another in each test",
    signature="a line over time in each test, steeper in its beginning, another from test to test",
    mechanisms=(NuisanceAmplitudes(_own_warming, _told_warming),),
)


def _hum(form: str, title: str, signature: str, number: int, orders: tuple[int, ...] = (1,)) -> EffectForm:
    """Return hum of so many of the tones that tests have in common, each with multiples of its frequency.

    Their frequencies are no parameters: spectra show them to a small share of what a fit would find.
    """

    def frequencies(s: Sizes) -> dict[str, float]:
        base = s.tones[:number] if orders == (1,) else (min(s.tones),)
        named = {f"f{i + 1}_{order}": order * f for i, f in enumerate(base) for order in orders}
        return {**_of_class(s), **named}

    return EffectForm(
        "hum",
        form,
        "instrument",
        title,
        signature,
        "Lomb (1976), Astrophys. Space Sci. 39, 447-462 (least squares of sines); EN 50160 (mains)",
        (NuisanceAmplitudes(_waves, _told_waves),),
        lambda s: (),
        lambda s: ((),),
        frequencies,
        shown=lambda s: len(s.tones) >= number,
    )


FORMS = (
    either(_CONSTANT, "constant force of the damper, as of its gas", (PRESSED,), laws=FLUID),
    _PER_TEST,
    _PER_TEST_LINE,
    _CAMPAIGN,
    _DISPLACEMENT,
    _EACH_OWN,
    _WARMING,
    _hum(
        "tone",
        "hum of one frequency in the force channel",
        "a narrow peak of the spectrum at one frequency in all tests, at no harmonic of the motion",
        1,
    ),
    _hum(
        "harmonics",
        "hum with harmonics in the force channel",
        "narrow peaks of the spectrum at a frequency, twice and three times it, in all tests",
        1,
        (1, 2, 3),
    ),
    _hum(
        "two_tones",
        "hum of two frequencies in the force channel",
        "two narrow peaks of the spectrum at the same frequencies in all tests",
        2,
    ),
)
