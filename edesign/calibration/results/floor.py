"""What no model of the tests can predict: noise of the channels, what does not repeat, errors of the thermometer."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.noise_of_tests import with_channel_noise, with_noise
from edesign.calibration.dampers.nuisance import joined
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import APART
from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.repeatability import SAME, repeatability
from edesign.calibration.residual.series import Errors, Worst
from edesign.calibration.residual.tones import without_tones
from edesign.calibration.results.predictions import judged
from edesign.calibration.search.models import FittedModel
from edesign.calibration.signals.noise import least_noise
from edesign.damper.testing.measured_histories import USES, Use
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import MOST, most_noise

_LONG, _MUCH = 0.25, 0.5  # of a test and of the range of its motion: beginnings that stand for all of it
_FARTHEST = 2.0  # standard deviations of a thermometer's error, up to which it is one


@dataclass(frozen=True, eq=False)
class Floor:
    """What no model can predict.

    Attributes:
        problem: with all tests, at full rate.
        noise: (tests,) standard deviation, N: the larger one of the noise of the channels and of what does not repeat.
        thermal: (tests,) mean square of what an error of the thermometer changes, N^2.
        interpolation: (tests,) standard deviation, N, that `noise` has of motions that are not known between samples.
        measured: whether the noise was measured in any test.
        times: mean square of what is left of all samples, each over the standard deviation of its own noise.
    """

    problem: DamperProblem
    noise: tuple[float, ...]
    thermal: tuple[float, ...]
    interpolation: tuple[float, ...]
    measured: bool
    times: float = 1.0

    @staticmethod
    def under(problem: DamperProblem, model: FittedModel, forces: Sequence[np.ndarray]) -> Floor:
        """Return the floor, by what a good model leaves.

        Args:
            problem: with all tests, at full rate.
            model: through which noise of the displacement makes force, and errors of the thermometer.
            forces: (n_i,) N of every test, predicted by it.
        """
        left = [judged(one, one.judged * (one.force - f)) for one, f in zip(problem.experiments, forces, strict=True)]
        cycles = [_from_cycle_to_cycle(one, r) for one, r in zip(problem.experiments, left, strict=True)]
        again = _from_test_to_test(problem.experiments, left)
        repeats = [
            max(both) if (both := [x for x in each if not math.isnan(x)]) else math.nan
            for each in zip(cycles, again, strict=True)
        ]
        known = _through(problem, model, forces)
        noise = [max(one.noise, 0.0 if math.isnan(r) else r) for one, r in zip(known, repeats, strict=True)]
        nuisances = problem.model(model.effects, USES).nuisances(model.fit.values)
        changes = [joined(of_test, False) for of_test in nuisances]
        thermal = [0.0 if d is None else float(np.mean(np.sum(d**2, axis=1))) for d in changes]
        measured = any(one.noise_measured for one in known) or not all(math.isnan(r) for r in repeats)
        between = tuple(one.interpolation_noise for one in known)
        over = [_over_own(*each) for each in zip(known, left, noise, thermal, strict=True)]
        return Floor(problem, tuple(noise), tuple(thermal), between, measured, float(np.mean(np.concatenate(over))))

    def nrms(self, use: Use) -> float:
        """Return the NRMS over the tests of one use."""
        return self._nrms(use, [noise**2 + thermal for noise, thermal in zip(self.noise, self.thermal, strict=True)])

    def interpolated(self, use: Use) -> float:
        """Return the part of it, NRMS, of what is not known of motions between samples."""
        return self._nrms(use, [one**2 for one in self.interpolation])

    def _nrms(self, use: Use, power: Sequence[float]) -> float:
        every = zip(self.problem.experiments, power, strict=True)
        forces = [(one.force[one.judged], p) for one, p in every if one.use == use]
        return sum(p * f.size for f, p in forces) / max(sum(float(f @ f) for f, _ in forces), 1e-300)

    def doubtful(self, errors: Errors, parameters: int) -> str:
        """Return why the floor does not say whether only noise is left, for people; "" if it does.

        Noise that was measured nowhere is assumed, as the least that an instrument has: what a model leaves beyond it
        may be noise or not. And neither noise nor errors of interpolation are more than what a model of few parameters
        leaves: an estimate that says so hides what is smaller. Noise of few samples hides what is left of the others.
        """
        fitted = [one for one in self.problem.experiments if one.use == "fit"]
        samples = sum(int(np.count_nonzero(one.judged)) for one in fitted)
        floor, left = self.nrms("fit"), errors.fit * samples / max(samples - parameters, 1)
        noise = self._nrms("fit", [a**2 - b**2 for a, b in zip(self.noise, self.interpolation, strict=True)])
        both = noise + self.interpolated("fit")
        if not self.measured and left > MOST * floor:
            return (
                "the noise was measured nowhere, as the motions reach up to the highest frequency of the sampling, and "
                f"nothing rests or repeats; what is left, {_percent(left)}, may be noise, of which {_percent(floor)} "
                "is assumed (0.1 % of the rms force, ISO 376)"
            )
        least = self._nrms("fit", [least_noise(one.force) ** 2 for one in self.problem.experiments])
        for estimate, hides, of in (
            (noise, noise > MOST * max(left, least), "of the noise"),
            (both, left > MOST * noise and both > MOST * left, "of what is not known of the motion between samples"),
        ):
            if hides:
                return (
                    f"the estimate {of}, {_percent(estimate)}, is more than the model leaves, {_percent(left)}: "
                    "whether something smaller is missing is not known"
                )
        if self.times > MOST and left <= MOST * floor:
            return (
                f"most of the noise is in few samples, and what is left of all is {self.times:.2g} times their own "
                "noise (power)"
            )
        return ""

    def worst(self, errors: Errors) -> Worst | None:
        """Return the test that leaves most over its noise; None: every test is at its floor."""
        parts = []
        for one, noise, thermal in zip(self.problem.experiments, self.noise, self.thermal, strict=True):
            force = one.force[one.judged]
            power = max(float(np.mean(force**2)), 1e-300)
            parts.append(Part(one.name, errors.tests[one.name], noise**2 / power, force.size, thermal / power))
        return worst_of(parts)


def only_noise(errors: Errors, floor: Mapping[Use, float], worst: Worst | None) -> bool:
    """Say whether only noise is left, in all tests of a use together and in every single one.

    Args:
        errors: NRMS of a model.
        floor: NRMS of what no model can predict, by the use of tests.
        worst: test that leaves more than noise.
    """
    every: Mapping[Use, float] = {"fit": errors.fit, "validate": errors.validate}
    return worst is None and all(error <= MOST * floor[use] for use, error in every.items())


def _over_own(one: Experiment, left: np.ndarray, noise: float, thermal: float) -> np.ndarray:
    """Return the squares of what is left (n,) N of a test from the first sample that is judged, over its own noise.

    Args:
        one: with the noise of its channels.
        noise: standard deviation of all noise of the test, N.
        thermal: mean square of what an error of the thermometer changes, N^2.
    """
    local = one.noise if one.local_noise is None else judged(one, one.local_noise)
    return np.asarray((left**2 / (local**2 + noise**2 - one.noise**2 + thermal))[judged(one, one.judged)])


def _through(problem: DamperProblem, model: FittedModel, predicted: Sequence[np.ndarray]) -> Sequence[Experiment]:
    """Return the tests with noise of the displacement, and what is not known between samples, through a model.

    Beside it the noise of the force is measured again. Through the law as declared both are known.
    """
    if not model.effects and np.array_equal(model.fit.values, [one.centre for one in problem.base]):
        measured = all(one.noise_measured for one in problem.experiments)
        return problem.experiments if measured else with_channel_noise(problem.experiments, predicted)

    def forces_of(other: DamperProblem) -> list[np.ndarray]:
        (found,) = other.model(model.effects, USES).forces(model.fit.values)
        if isinstance(found, PredictionError):
            raise found
        return found

    try:
        return with_noise(problem, predicted, forces_of)
    except PredictionError:  # what cannot be predicted with noise keeps the noise through the law
        return problem.experiments


def _percent(nrms: float) -> str:
    return f"{100.0 * nrms:.2g} % NRMS"


class Part(NamedTuple):
    """A part of the data, as a test.

    Attributes:
        name: for people.
        error, floor: NRMS, and that of random noise.
        size: number of values.
        thermal: NRMS of what an error of the thermometer changes.
    """

    name: str
    error: float
    floor: float
    size: int
    thermal: float = 0.0


def worst_of(parts: Sequence[Part]) -> Worst | None:
    """Return the part that leaves most over its noise, and more than chance makes of that; None: there is none."""
    found: Worst | None = None
    for one in parts:
        floor = one.floor + one.thermal
        allowed = most_noise(one.size, len(parts)) * one.floor + _FARTHEST**2 * one.thermal
        if one.error > allowed and (found is None or one.error / floor > found.times):
            found = Worst(one.name, one.error, floor)
    return found


def _from_cycle_to_cycle(one: Experiment, left: np.ndarray) -> float:
    """Return what of a residual (n,) N does not repeat from cycle to cycle; nan: the test has no steady cycles."""
    motion = Cycles(judged(one, one.motion.time), judged(one, one.motion.displacement))
    found = repeatability(motion, without_tones(motion, left))
    return math.nan if found is None else found


def _from_test_to_test(tests: Sequence[Experiment], left: Sequence[np.ndarray]) -> list[float]:
    """Return what of the residuals (n_i,) N does not repeat in the nearest test that begins with the same motion.

    A force has its cause in what went before: two tests of one motion have one force until their motions part.

    Returns:
        (tests,) standard deviation, N; nan: no other test begins so.
    """
    found = [math.nan] * len(tests)
    for i, one in enumerate(tests):
        together = [(abs(k - i), k, n) for k, other in enumerate(tests) if k != i and (n := _together(one, other))]
        if together:
            _, k, n = min(together)
            time, other = judged(one, one.motion.since), judged(tests[k], tests[k].motion.since)
            both = (time >= other[0]) & (time <= min(other[-1], one.motion.since[n - 1]))
            if np.any(both):
                change = left[i][both] - np.interp(time[both], other, left[k])
                found[i] = float(np.sqrt(0.5 * np.mean(change**2)))
    return found


def _together(one: Experiment, other: Experiment) -> int:
    """Return the number of samples of a test for which another one has the same motion at the same temperature.

    0: not for as long, or not in motions so large, as to stand for the test.
    """
    if abs(one.temperature - other.temperature) > APART or one.continued or other.continued:
        return 0
    since, own = one.motion.since, one.motion.displacement
    longest = int(np.searchsorted(since, other.motion.since[-1], side="right"))
    apart = own - np.interp(since, other.motion.since, other.motion.displacement)
    alike = np.flatnonzero(np.cumsum(apart**2)[:longest] <= SAME**2 * np.cumsum(own**2)[:longest])
    n = int(alike[-1]) + 1 if alike.size else 0
    large = n > 0 and float(np.ptp(own[:n])) >= _MUCH * float(np.ptp(own))
    return n if large and n >= _LONG * since.size else 0
