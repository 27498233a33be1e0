"""How each test of a campaign starts, as its record and its force say beside a model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Trial
from edesign.calibrate.problem import Part, PredictionError
from edesign.damper.history import Extremes
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.start import SOFTENED, Recorded, Start, extremes_before, find_start


def with_starts(
    problem: DamperProblem, tests: Sequence[DamperTest], base: np.ndarray | None = None, parts: Sequence[Part] = ()
) -> DamperProblem:
    """With the start of each test, found from its own force beside a model; a test that the model cannot predict from
    another beginning keeps the start that it has.

    Args:
        problem: with the noise of each test.
        tests: of the campaign, which may say how they start.
        base: values of the law's parameters, SI; None: as declared.
        parts: effects.
    """
    values = problem.declared if base is None else base

    def started(index: int, trial: Trial) -> Trial:
        try:
            return trial.starting(_start(problem, index, tests[index], values, parts))
        except PredictionError:
            return trial

    return replace(problem, trials=tuple(started(i, trial) for i, trial in enumerate(problem.trials)))


def as_started(problem: DamperProblem, like: DamperProblem) -> DamperProblem:
    """Tests that start as those of another rate do."""
    pairs = zip(problem.trials, like.trials, strict=True)
    return replace(problem, trials=tuple(trial.starting(other.start) for trial, other in pairs))


def settled(problem: DamperProblem) -> DamperProblem:
    """With what went before each test as it was found: no share of a larger softening is a test's own any more, which
    no specimen might have.
    """

    def known(trial: Trial) -> Trial:
        return trial if trial.start is None else trial.starting(replace(trial.start, known=True))

    return replace(problem, trials=tuple(map(known, problem.trials)))


def _start(
    problem: DamperProblem, index: int, test: DamperTest, base: np.ndarray, parts: Sequence[Part]
) -> Start | None:
    trial = problem.trials[index].starting(None)
    motion = trial.motion
    record = Recorded(
        motion.time, motion.displacement, motion.velocity, trial.force, trial.displacement_noise, trial.noise
    )

    physical = [part for part in parts if part[0].kind != "instrument"]  # a step before the record is in no channel

    def force_of(time: np.ndarray, displacement: np.ndarray, velocity: np.ndarray, been: Extremes) -> np.ndarray:
        other = Motion(time, displacement, velocity, np.gradient(velocity, time))
        force, temperature = (np.interp(time, motion.time, one) for one in (trial.force, trial.temperature))
        lone = Trial(trial.name, trial.use, trial.order, other, force, temperature, been=been)
        return problem.force_of(index, lone, base, physical)

    start = find_start(record, test.start, test.ramp, force_of)
    if start is None or start.known or problem.law.name not in SOFTENED:
        return start
    started = trial.starting(start)
    weight = np.ones(motion.time.size) if trial.weight is None else trial.weight
    been = extremes_before(
        record,
        started.first,
        weight,
        lambda been: problem.force_of(index, replace(trial, been=been), base, parts),
    )
    return replace(start, been=been)
