"""Faults of instruments in some tests: in one of them alone, or a gain that changed from one on.

No search could move the test, so each place is a form. Of `places` forms that differ in it one acts at most: the prior
of each is 1/places, and its logarithm is part of the score.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import gain, lag
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.mechanisms import MotionChannel, Thermometer
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.form import Values, size

_FEWEST = 3  # tests: of two that differ either one may be wrong
_FAULT = 0.3
"""Standard deviation of a share by which one channel is wrong in one test: that of a declared parameter. A fault is no
error of a class; inches for millimetres (-0.96) and a wrong sign (-2) are within reach.
"""
_INCHES = 1.0 / 25.4 - 1.0
_MISREAD = 10.0  # K: a digit, or the level of another test


def _stretched(p: Values, test: Experiment, motion: Motion) -> Motion:
    faster = 1.0 + p["g"]
    onset = None if motion.onset is None else (motion.onset[0] / faster, motion.onset[1] * faster)
    return Motion(
        motion.time / faster,
        motion.displacement,
        motion.velocity * faster,
        motion.acceleration * faster**2,
        onset=onset,
        cornered=motion.cornered,
    )


_FORCE = replace(
    gain.FORCE,
    signature="proportional to the force itself",
    parameters=lambda s: (size("g", "", _FAULT, -3.0, 10.0),),
    starts=lambda s: ((_FAULT,),),
)
_DISPLACEMENT = replace(
    gain.DISPLACEMENT,
    parameters=lambda s: (size("g", "", _FAULT, -0.99, 10.0),),
    starts=lambda s: ((_FAULT,), (_INCHES,)),
)
_CLOCK = EffectForm(
    "clock",
    "stretched",
    "instrument",
    "time column",
    "forces that depend on the velocity are too large or too small by one share; what depends on displacement is right",
    "Mills (1991), IEEE Trans. Commun. 39, 1482-1493 (frequency error of a clock)",
    (MotionChannel(_stretched),),
    lambda s: (size("g", "", _FAULT, -0.95, 10.0),),
    lambda s: ((_FAULT,),),
    meanings={"g": "share by which durations read too long; negative: too short"},
)
_TEMPERATURE = EffectForm(
    "thermometer",
    "misread",
    "instrument",
    "temperature as written",
    "stiffness and damping of another temperature",
    "IEC 60751 (errors of thermometers, which are far smaller)",
    (Thermometer("error"),),
    lambda s: (size("error", "K", _MISREAD, -10.0 * _MISREAD, 10.0 * _MISREAD),),
    lambda s: ((_MISREAD,), (-_MISREAD,)),
    proportional=False,
    meanings={"error": "by which the reading is too high; negative: too low"},
)
_OF_ONE_TEST = (_FORCE, _DISPLACEMENT, lag.OF_ONE_TEST, _CLOCK, _TEMPERATURE)


def one_test(s: Sizes) -> tuple[EffectForm, ...]:
    """Return faults of instruments in one test that is fitted to, one form for each of them.

    A gain in the first test alone is that of all others with another law. One in the last test may go on after it.
    """
    fitted = _fitted(s) if sum(s.fitted) >= _FEWEST else []
    return tuple(_in_one(form, number, fitted, s) for form in _OF_ONE_TEST for number in fitted)


def from_test(s: Sizes) -> tuple[EffectForm, ...]:
    """Return gains that changed between two tests for good, two tests or more that are fitted to before and after it.

    Where other tests stand between two that are fitted to, these two leave open before which test it was.
    """
    places = list(pairwise(_fitted(s)))[1:-1] if s.between else []
    return tuple(
        replace(_changed(form, before + 1, after, s), places=len(places))
        for form in (gain.FORCE, gain.DISPLACEMENT)
        for before, after in places
    )


def _fitted(s: Sizes) -> list[int]:
    """Return the numbers of the tests that are fitted to."""
    return [order + 1 for order, of in enumerate(s.fitted) if of]


def _in_one(form: EffectForm, number: int, fitted: list[int], s: Sizes) -> EffectForm:
    """Return a fault in one test; that of a gain in the first or last one may go as far as the next that is fitted."""
    ending = f"of_test_{number}"
    channel = "" if form.name in ("clock", "thermometer") else f"{form.form}_"
    alone = replace(
        form,
        form=f"{channel}{ending}",
        title=f"{form.title} in one test, {s.name(number)}",
        signature=f"in one test alone: {form.signature}",
        numbers=range(number, number + 1),
        places=len(fitted),
    )
    if form.name != "gain" or not s.between:
        return alone
    wider = list[EffectForm]()
    if number == fitted[0]:
        wider += [_to(form, k, s) for k in range(number, fitted[1]) if k > 1]
    if number == fitted[-1]:
        wider += [_at(form, k, f"{k}", s.name(k), s) for k in range(fitted[-2] + 1, number + 1) if k < s.tests]
    return replace(alone, confounded=(alone, *wider)) if wider else alone


def _changed(form: EffectForm, earliest: int, latest: int, s: Sizes) -> EffectForm:
    """Return a gain that changed before one of some tests, of which the last one alone is fitted to."""
    if earliest == latest:
        return _at(form, latest, f"{latest}", s.name(latest), s)
    tests = f"one of {s.name(earliest)} to {s.name(latest)}"
    ranges = [
        _at(form, k, f"{k}", f"{s.name(k)}, as validation tests show; the fitted ones say before {tests}", s)
        for k in range(earliest, latest + 1)
    ]
    return replace(_at(form, latest, f"{earliest}_to_{latest}", tests, s), confounded=tuple(ranges))


def _to(form: EffectForm, last: int, s: Sizes) -> EffectForm:
    """Return a gain in the first tests."""
    return replace(
        form,
        form=f"{form.form}_to_test_{last}",
        title=f"{form.title} that changed after {s.name(last)}",
        signature="proportional to the force itself, by one share in the first tests",
        numbers=range(1, last + 1),
    )


def _at(form: EffectForm, first: int, place: str, title: str, s: Sizes) -> EffectForm:
    """Return a gain from one test on."""
    return replace(
        form,
        form=f"{form.form}_from_test_{place}",
        title=f"{form.title} that changed before {title}",
        signature="proportional to the force itself, by one share in all tests from one on",
        numbers=range(first, s.tests + 1),
        places=1,
    )
