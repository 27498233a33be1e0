"""From a campaign of damper tests to the problem: tests freed of noise, how they start, what looks wrong."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.noise_of_tests import smoothed_motion, with_noise
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.dampers.tones import common_tones
from edesign.calibration.search.settings import SearchSettings
from edesign.core import CoreError
from edesign.core.damper import CoreDamper
from edesign.damper.fitting.identifiable import as_held
from edesign.damper.history import Extremes
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaT, at
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.clipping import clipped
from edesign.damper.testing.measured_histories import DamperTest, Use, lost_motion
from edesign.damper.testing.spikes import spikes_beside, spikes_of, without_spikes
from edesign.damper.testing.start import SOFTENED, Recorded, Start, extremes_before, find_start
from edesign.errors import InputError
from edesign.estimation.least_squares import Fit, fit
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import FIRST, Noise

_UNKNOWN = 2.0  # standard deviation of the logarithm of a parameter of which only the order of magnitude is known
_STARTS, _WIDE = 4, 0.7  # of the law alone; standard deviation of the logarithm of their parameters
_ABSURD = 30.0  # ratio of measured to predicted force beyond which a unit is wrong, not a law
_OPPOSITE = -0.3
"""Correlation of measured and predicted force below which the sign is wrong, if the damper did work too: a mass that
moves with the load cell may turn the force around, but it dissipates nothing.
"""


def damper_problem(campaign: Campaign, threads: int | None = None) -> DamperProblem:
    """Return the problem of a campaign, at the sampling of a fit; `full_rate` of it has all samples.

    Args:
        campaign: with the law thought of.
        threads: of predictions, at most so many; None: as many as there are processors.

    Raises:
        InputError: there is no law, or too few tests, or the tests cannot be those of this law.
    """
    if campaign.law is None or campaign.law.parameters is None:
        raise InputError(
            f"{campaign.path}: law: the law thought of is needed, for example "
            "`law: {type: mgmm, parameters: thesis_table_4_2}`; without parameters it is fitted first [E-CALIB-01]"
        )
    check_uses(campaign.path, campaign.tests)
    for test in campaign.tests:
        test.varying_force()
        _check_motion(test)
    experiments = _experiments(campaign.tests)
    while True:
        found, of_law = _prepared(campaign, experiments, threads)
        mended = [_without_spikes_beside(*each) for each in zip(experiments, of_law, strict=True)]
        if all(one is before for one, before in zip(mended, experiments, strict=True)):
            return found
        experiments = tuple(mended)


def _prepared(
    campaign: Campaign, experiments: tuple[Experiment, ...], threads: int | None
) -> tuple[DamperProblem, list[np.ndarray]]:
    """Return the problem of tests at full rate, and the force (n_i,) N of the law fitted alone in each of them."""
    assert campaign.law is not None and campaign.law.parameters is not None
    law = law_of(campaign.law.type)
    declared = law.complete(read_parameters(law, campaign.law.parameters))
    declared = as_held(law, declared) if campaign.law.refit else declared
    problem = DamperProblem(
        law,
        declared,
        experiments,
        Sizes.of(experiments, ordered=campaign.ordered),
        campaign.law.refit,
        campaign.law.extremes == "lasting",
        campaign.law.gamma_T_of or "parameters",
        threads,
        belongs_to=campaign.belongs_to,
    )
    predicted = _declared_forces(problem, campaign)
    _check_forces(problem, campaign, predicted)
    noisy = problem.with_experiments(with_noise(problem, predicted, _forces)).weighed(FIRST**2)
    thin = noisy.with_experiments([one.thinned() for one in noisy.experiments])
    started = _started(thin, campaign)
    fitted = [problem.experiments[i] for i in problem.fitted]
    of_law = [predicted[i] for i in problem.fitted]
    tones = common_tones([one.motion for one in fitted], [one.force for one in fitted], of_law)
    found = replace(started, typical=Sizes.of(problem.experiments, tones, campaign.ordered))
    alone = _alone(found)
    if alone and any(one.start is not None for one in found.experiments):
        # how a test starts is read from its force beside a law: the declared one may be far off
        found = replace(
            _started(replace(found, declared=found.law_values(alone.values())), campaign), declared=declared
        )
    with suppress(PredictionError):
        predicted = _forces(replace(problem, declared=found.law_values(alone.values())))
    return _weighed(replace(found, alone=alone)), predicted


def _weighed(problem: DamperProblem) -> DamperProblem:
    """Return the problem with residuals weighted by their noise, and by what a model leaves beside it.

    That is no more than a fair model leaves: where the law alone leaves more, effects are to be found.
    """
    model = problem.model(())
    (forces,) = model.predict(np.array([problem.start]))
    if isinstance(forces, PredictionError):
        return problem
    left = [y - f for y, f in zip(model.measured, forces, strict=True)]
    return problem.weighed(min(problem.share_of(left), FIRST**2))


def _started(problem: DamperProblem, campaign: Campaign) -> DamperProblem:
    """Return the problem with tests that start as their forces show beside its law."""
    starts = [_start(problem, i, test) for i, test in enumerate(campaign.tests)]
    return problem.with_experiments(
        [
            replace(one, start=start, full=None if one.full is None else replace(one.full, start=start))
            for one, start in zip(problem.experiments, starts, strict=True)
        ]
    )


def _alone(problem: DamperProblem) -> dict[str, float]:
    """Return parameters of the law alone by the tests alone, from several starts; {}: none are fitted."""
    model = replace(problem, within=_UNKNOWN).model(())
    noise = Noise.of_first_fit(problem.deviations, problem.sizes)
    random, found = np.random.default_rng(len(problem.base)), list[Fit]()
    for number in range(_STARTS if model.parameters else 0):
        start = random.standard_normal(len(model.parameters)) * (_WIDE / _UNKNOWN if number else 0.0)
        with suppress(PredictionError):
            found.append(fit(model, noise, start))
    if not found:
        return {}
    best = min(found, key=lambda one: sum(float(r @ r) for r in one.weighted().residuals) + float(one.z @ one.z))
    return {one.name: float(value) for one, value in zip(model.parameters, best.values, strict=True)}


class _Used(Protocol):
    @property
    def use(self) -> Use: ...


def check_uses(path: Path, tests: Sequence[_Used]) -> None:
    """Refuse a campaign with too few tests to be fitted to, or with none for validation.

    Raises:
        InputError: there are too few.
    """
    fitted = sum(test.use == "fit" for test in tests)
    if fitted < 2:
        raise InputError(
            f"{path}: tests: {fitted} with `use: fit`; an effect is adopted when it lowers the error on tests it was "
            "not fitted to, so that two are the least (six or more are better) [E-CALIB-02]"
        )
    if fitted == len(tests):
        raise InputError(
            f"{path}: tests: none has `use: validate`; the error before and after is reported on tests that nothing "
            "was fitted to, so that one is the least [E-CALIB-02]"
        )


def _check_motion(test: DamperTest) -> None:
    """Refuse a test of which a part of the motion is not known.

    Raises:
        InputError: there is such a part.
    """
    lost = lost_motion(test.time, test.displacement)
    if lost is not None:
        raise InputError(
            f"{test.where}: no samples from {lost[0]:.6g} s to {lost[1]:.6g} s, while the specimen moved: what it did "
            "there is not known, and what it remembers of that neither. Make two tests of the file, one before and one "
            "after it; or correct its times [E-CALIB-03]"
        )


def _experiments(tests: Sequence[DamperTest]) -> tuple[Experiment, ...]:
    found, elapsed = [], 0.0
    for order, measured in enumerate(tests):
        test, (of_motion, of_force) = without_spikes(measured), spikes_of(measured)
        force = test.measured_force()
        motion, noise = smoothed_motion(test.time, test.displacement, force)
        history = test.temperature_history
        degrees = test.temperature_C if history is None else float(np.mean(history))
        at_end = clipped(force)
        spikes = None if of_force is None else of_force.at
        found.append(
            Experiment(
                *(test.name, test.use, order, elapsed, motion, force, degrees, noise),
                conditions=dict(test.conditions),
                clipped=at_end if np.any(at_end) else None,
                spikes=spikes if np.any(spikes) else None,
                motion_spikes=of_motion.at if np.any(of_motion.at) else None,
                continued=test.start == "continued",
            )
        )
        elapsed += float(motion.since[-1])
    return tuple(found)


def _without_spikes_beside(one: Experiment, predicted: np.ndarray) -> Experiment:
    """Return a test without spikes that its force (n,) N beside the law shows, as the force alone does not."""
    motion = one.motion
    found = spikes_beside(motion.time, one.force, predicted, (motion.displacement, motion.velocity))
    known = np.zeros(one.force.size, dtype=bool) if one.spikes is None else one.spikes
    if not np.any(found.at & ~known):
        return one
    return replace(one, force=np.where(known, one.force, found.mended), spikes=known | found.at)


def _forces(problem: DamperProblem) -> list[np.ndarray]:
    """Return the forces (n_i,) N of the declared law in all tests.

    Raises:
        PredictionError: there is none.
    """
    (found,) = problem.prediction.predict([(problem.declared, ())], range(len(problem.experiments)))
    if isinstance(found, PredictionError):
        raise found
    return found


def _declared_forces(problem: DamperProblem, campaign: Campaign) -> list[np.ndarray]:
    """Return the forces (n_i,) N of the declared law, or refuse tests of which it has none."""
    found = []
    for i, test in enumerate(campaign.tests):
        (one,) = problem.prediction.predict([(problem.declared, ())], (i,))
        if isinstance(one, PredictionError):
            raise InputError(
                f"{campaign.path}: {test.name}: the declared law cannot predict it: {one} [E-CALIB-04]"
            ) from one
        found += one
    return found


def _start(problem: DamperProblem, index: int, test: DamperTest) -> Start | None:
    """Return how a test starts, declared or found from its force beside the declared law; None: at rest."""
    one = problem.experiments[index]
    if one.continued:
        return None
    motion = one.motion
    record = Recorded(motion.time, motion.displacement, motion.velocity, one.force, one.displacement_noise, one.noise)
    gamma = GammaT(of=problem.gamma_of)
    model = gamma if problem.law.name in gamma.laws else None
    values = tuple(at(problem.law, problem.declared, one.temperature, model)[0].values())

    def force_of(time: np.ndarray, displacement: np.ndarray, velocity: np.ndarray, prior: Extremes) -> np.ndarray:
        return CoreDamper(problem.law.name, values, prior_extremes=prior).force(time, displacement, velocity)

    try:
        start = find_start(record, test.start, test.ramp, force_of, SearchSettings.own_discrepancy)
        if start is None or start.known or problem.law.name not in SOFTENED:
            return start
        weight = np.ones(motion.time.size) if one.local_noise is None else one.noise / one.local_noise
        first, known = start.first(motion.time), (motion.time, motion.displacement, motion.velocity)
        prior = extremes_before(record, first, weight, lambda prior: force_of(*known, prior))
    except CoreError:  # a test that the law cannot predict from another beginning keeps the usual one
        return None
    return replace(start, prior_extremes=prior)


def _check_forces(problem: DamperProblem, campaign: Campaign, predicted: Sequence[np.ndarray]) -> None:
    """Refuse forces of the wrong sign or unit, which no effect is to absorb."""
    flipped, scales = [], []
    for one, test, force in zip(problem.experiments, campaign.tests, predicted, strict=True):
        size = float(np.sqrt((force @ force) * (one.force @ one.force)))
        if size and float(force @ one.force) / size < _OPPOSITE and one.work < 0.0:
            flipped.append(test)
        scales.append(float(np.sqrt((one.force @ one.force) / max(force @ force, 1e-300))))
    if flipped:
        text = (
            "the force is negative where the damper is stretched; a positive force must belong to a positive "
            "displacement: say `reversed: [force]`, or change the sign of one of the channels [E-CALIB-07]"
        )
        raise InputError(_of_tests(flipped, campaign, text))
    wrong = [i for i, scale in enumerate(scales) if not 1 / _ABSURD < scale < _ABSURD]
    if wrong:
        of = [problem.experiments[i] for i in wrong]
        causes = [_cause_text(one.motion.time, one.force, predicted[i]) for one, i in zip(of, wrong, strict=True)]
        text = causes[0] if all(causes) else _scale_text(float(np.median([scales[i] for i in wrong])))
        raise InputError(_of_tests([campaign.tests[i] for i in wrong], campaign, text))


def _cause_text(time: np.ndarray, force: np.ndarray, predicted: np.ndarray) -> str:
    """Return what to say of a force (n,) N that is absurd by few samples or its mean alone; "" if by more than that."""
    middle = float(np.median(force))
    about, of_law = force - middle, predicted - float(np.median(predicted))
    if not 1 / _ABSURD < _usual(about) / max(_usual(of_law), 1e-300) < _ABSURD:
        return ""
    at = int(np.argmax(np.abs(about)))
    if np.std(force) > _ABSURD * np.std(predicted):
        at_peak = f"the force is {1e-3 * force[at]:.3g} kN at {time[at]:.6g} s"
        return f"{at_peak}, and usual elsewhere: is that a spike? [E-CALIB-03]"
    means = 1e-3 * float(np.mean(force)), 1e-3 * float(np.mean(predicted))
    text = f"the mean force is {means[0]:.3g} kN where the declared law gives {means[1]:.3g} kN, and about it all fits"
    if abs(means[0]) > abs(means[1]):
        return f"{text}: has the force channel an offset? Take it off in the file [E-CALIB-03]"
    return f"{text}: has the displacement an offset? See the key `displacement_zero` [E-CALIB-03]"


def _usual(values: np.ndarray) -> float:
    return float(np.median(np.abs(values)))


def _scale_text(scale: float) -> str:
    thousand = next((f for f in (1e-6, 1e-3, 1e3, 1e6) if 1 / 5.0 < scale / f < 5.0), None)
    text = f"the force is {scale:.3g} times what the declared law gives"
    if thousand == 1e3:
        cause = "is it in N and declared as kN, or the displacement in m and declared as mm?"
        return f"{text}, a scale of 1000: {cause} [E-CALIB-07]"
    if thousand == 1e-3:
        cause = "is it in kN or MN and declared as N or kN, or the displacement in mm and declared as m?"
        return f"{text}, a scale of 1/1000: {cause} [E-CALIB-07]"
    if thousand is not None:
        return f"{text}, a scale of {thousand:g}: are the units of the columns right? [E-CALIB-07]"
    return f"{text}: are the units of the columns and the parameters of the law right? [E-CALIB-07]"


def _of_tests(tests: Sequence[DamperTest], campaign: Campaign, what: str) -> str:
    if len(tests) == len(campaign.tests):
        return f"{campaign.path}: all {len(tests)} tests: {what}"
    return f"{campaign.path}: {', '.join(test.where for test in tests)}: {what}"
