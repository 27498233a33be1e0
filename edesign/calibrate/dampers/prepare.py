"""From a campaign of damper tests to the loop: declared law, tests freed from displacement noise, what looks wrong."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.ndimage import uniform_filter1d

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.readings import read
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.calibrate.noise import least_noise, smooth, white_noise
from edesign.calibrate.problem import Part, PredictionError
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import InputError

_AGAIN = 6  # times that noise is added
_EVENED = 0.1  # s, over which its effect is evened out
_MOST_TIMES = 4.0  # its power over that by a model
_THERMOMETER = 0.2  # K: tolerance of a platinum resistor of class A near room temperature, IEC 60751
_ABSURD = 30.0  # ratio of measured to predicted force beyond which a unit is wrong, not a law
_OPPOSITE = -0.3
"""Correlation of measured and predicted force below which the sign is wrong, if the damper did work too: a mass that
moves with the load cell may turn the force around, but it dissipates nothing.
"""


def damper_problem(campaign: Campaign) -> DamperProblem:
    """The problem of a campaign at full rate.

    Raises:
        InputError: there is no law, or too few tests, or the tests cannot be those of this law.
    """
    if campaign.law is None or campaign.law.parameters is None:
        raise InputError(
            f"{campaign.path}: law: the loop needs the law thought of, for example `law: {{type: mgmm}}`, "
            "which is fitted first, or with its parameters `law: {type: mgmm, parameters: thesis_table_4_2}`"
        )
    _check_tests(campaign)
    chosen = law_of(campaign.law.type)
    start = read_parameters(chosen, campaign.law.parameters)
    trials = tuple(_trial(test, order) for order, test in enumerate(campaign.tests))
    problem = read(DamperProblem(chosen, start, trials, Sizes.of(trials)), campaign.law)
    _check_law(problem, campaign)
    _check_forces(problem, campaign)
    noisy = with_noise(problem)
    means = [trial.mean_temperature for trial in trials]
    return replace(noisy, thermometer=_THERMOMETER) if max(means) - min(means) > _THERMOMETER else noisy


def thinned(problem: DamperProblem) -> DamperProblem:
    """The same at the rate of a fit."""
    return replace(problem, trials=tuple(trial.thinned() for trial in problem.trials))


def _check_tests(campaign: Campaign) -> None:
    fitted, validating = campaign.used_for("fit"), campaign.used_for("validate")
    if len(fitted) < 2:
        raise InputError(
            f"{campaign.path}: tests: {len(fitted)} with `use: fit`; an effect is adopted when it lowers the error on "
            "tests it was not fitted to, so that two are the least (six or more are better)"
        )
    if not validating:
        raise InputError(
            f"{campaign.path}: tests: none has `use: validate`; the error before and after is reported on tests that "
            "nothing was fitted to, so that one is the least"
        )
    for test in campaign.tests:
        test.varying_force()


def _trial(test: DamperTest, order: int) -> Trial:
    displacement, velocity, acceleration, noise = smooth(test.time, test.displacement)
    history = test.temperature_history
    temperature = np.full(test.time.size, test.temperature_C) if history is None else history
    motion = Motion(test.time, displacement, velocity, acceleration)
    return Trial(test.name, test.use, order, motion, test.measured_force(), temperature, noise)


def with_noise(problem: DamperProblem, base: np.ndarray | None = None, parts: Sequence[Part] = ()) -> DamperProblem:
    """With the noise of each test: that of the force channel, in what a model leaves of the force, too, as the model
    takes the harmonics away; and what noise of the displacement makes of force: such noise added and taken off again.
    That is most where the damper is slow and its force steep over the velocity, and as many times larger as the force
    is than the model's.

    Args:
        problem: at full rate.
        base: values of the law's parameters, SI; None: as declared.
        parts: effects.
    """
    values = problem.declared if base is None else base

    def predicted(trials: Sequence[Trial]) -> list[np.ndarray]:
        found = replace(problem, trials=tuple(trials)).predict(values, parts, ("fit", "validate"))
        return [force for force in found if force is not None]

    random = np.random.default_rng(len(problem.trials))
    plain = predicted(problem.trials)
    power = [np.zeros(trial.motion.time.size) for trial in problem.trials]
    for _ in range(_AGAIN if any(trial.displacement_noise for trial in problem.trials) else 0):
        again = []
        for trial in problem.trials:
            motion = trial.motion
            if trial.displacement_noise > 0.0:
                noisy = motion.displacement + trial.displacement_noise * random.standard_normal(motion.time.size)
                motion = Motion(motion.time, *smooth(motion.time, noisy)[:3])
            again.append(replace(trial, motion=motion))
        for own, force, moved in zip(power, plain, predicted(again), strict=True):
            own += (moved - force) ** 2 / _AGAIN
    return replace(problem, trials=tuple(map(_noisy, problem.trials, plain, power)))


def _noisy(trial: Trial, predicted: np.ndarray, power: np.ndarray) -> Trial:
    """With the noise of force and motion, of which the latter makes of the predicted force (n,) N the power (n,) N^2,
    evened out.
    """
    time, force = trial.motion.time, trial.force
    channel = min(white_noise(force, time), white_noise(force - predicted, time))
    channel = max(channel, least_noise(force))
    if not np.any(power):
        return replace(trial, channel_noise=channel)
    wide = min(max(int(_EVENED / float(np.median(np.diff(time)))), 1), time.size)
    times = float(force @ force) / max(float(predicted @ predicted), 1e-300)
    power = min(max(times, 1.0 / _MOST_TIMES), _MOST_TIMES) * uniform_filter1d(power, wide, mode="nearest")
    all_of_it = power + channel**2
    weight = np.sqrt(np.mean(all_of_it) / all_of_it)
    return replace(trial, channel_noise=channel, motion_noise=float(np.sqrt(np.mean(power))), weight=weight)


def _check_law(problem: DamperProblem, campaign: Campaign) -> None:
    """Refuse tests of which the declared law has no prediction: it is not for their temperature, say."""
    for trial, test in zip(problem.trials, campaign.tests, strict=True):
        try:
            replace(problem, trials=(trial.thinned(),)).predict(problem.declared, (), ("fit", "validate"))
        except PredictionError as error:
            raise InputError(f"{campaign.path}: {test.name}: the declared law cannot predict it: {error}") from error


def _check_forces(problem: DamperProblem, campaign: Campaign) -> None:
    """Refuse forces of the wrong sign or unit, which no effect is to absorb."""
    small = thinned(problem)
    predicted = small.predict(small.declared, (), ("fit", "validate"))
    flipped, scales = [], []
    for trial, test, force in zip(small.trials, campaign.tests, predicted, strict=True):
        assert force is not None
        size = float(np.sqrt((force @ force) * (trial.force @ trial.force)))
        if size and float(force @ trial.force) / size < _OPPOSITE and trial.work < 0.0:
            flipped.append(test)
        scales.append(float(np.sqrt((trial.force @ trial.force) / max(force @ force, 1e-300))))
    if flipped:
        raise InputError(
            _told(
                flipped,
                campaign,
                "the force is negative where the damper is stretched; a positive force must go with a positive "
                "displacement: say `reversed: [force]`, or change the sign of one of the channels",
            )
        )
    wrong = [test for test, scale in zip(campaign.tests, scales, strict=True) if not 1 / _ABSURD < scale < _ABSURD]
    if wrong:
        middle = float(np.median([s for s in scales if not 1 / _ABSURD < s < _ABSURD]))
        raise InputError(_told(wrong, campaign, _scale_text(middle)))


def _scale_text(scale: float) -> str:
    thousand = next((f for f in (1e-6, 1e-3, 1e3, 1e6) if 1 / 5.0 < scale / f < 5.0), None)
    text = f"the force is {scale:.3g} times what the declared law gives"
    if thousand == 1e3:
        return text + ", a scale of 1000: is it in N, and declared as kN?"
    if thousand == 1e-3:
        return (
            text
            + ", a scale of 1/1000: is it in kN or MN and declared as N or kN, or the displacement in m declared as mm?"
        )
    if thousand is not None:
        return text + f", a scale of {thousand:g}: are the units of the columns right?"
    return text + ": are the units of the columns and the parameters of the law right?"


def _told(tests: Sequence[DamperTest], campaign: Campaign, what: str) -> str:
    if len(tests) == len(campaign.tests):
        return f"{campaign.path}: all {len(tests)} tests: {what}"
    return f"{campaign.path}: {', '.join(test.where for test in tests)}: {what}"
