"""Which further test would separate the models that the tests made so far leave probable.

Each model predicts each test that the rig can make, as the tests have shown: no larger, no faster and no warmer than
they were. The test with the largest expected difference is proposed: sum over pairs w_i w_j |f_i - f_j|^2 over the
noise, with w the probabilities of the models.

Source: Box and Hill (1967), Discrimination among mechanistic models, Technometrics 9, 57-71.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.results.models import Posterior
from edesign.calibration.results.result import NextTest
from edesign.calibration.search.models import FittedModel
from edesign.damper.history import spline_velocity
from edesign.damper.testing.measured_histories import USES
from edesign.estimation.model import PredictionError

_RATE, _PER_CYCLE = 60.0, (40, 600)  # samples of the tests thought of, per second; least and most per cycle
_FREQUENCIES = 5  # from the lowest to the highest of the tests
_SHARES = (0.1, 0.25, 0.5, 1.0)  # of the largest displacement
_CYCLES = 12
_HOLD, _RAMP = 60.0, 0.2  # s
_MOST_MODELS = 6
_GAIN = 1.2  # times the largest difference so far: less is no reason for a further test


@dataclass(frozen=True)
class Reach:
    """What the tests have shown that the rig can make.

    Attributes:
        displacement, velocity, acceleration: largest, m, m/s, m/s2.
        frequencies: lowest and highest, Hz.
        temperatures: lowest and highest, degC.
    """

    displacement: float
    velocity: float
    acceleration: float
    frequencies: tuple[float, float]
    temperatures: tuple[float, float]

    @staticmethod
    def of(tests: Sequence[Experiment]) -> Reach:
        """Return the reach of tests."""
        motions = [one.motion for one in tests]
        degrees, own = [one.temperature for one in tests], [_frequency(one) for one in motions]
        u, v, a = (max(float(np.max(np.abs(one.samples[k]))) for one in motions) for k in (1, 2, 3))
        return Reach(u, v, a, (min(own), max(own)), (min(degrees), max(degrees)))

    def makes(self, motion: Motion) -> bool:
        """Say whether a motion is no larger and no faster."""
        largest = [float(np.max(np.abs(values))) for values in motion.samples[1:]]
        reach = self.displacement, self.velocity, self.acceleration
        return all(one <= most * (1.0 + 1e-9) for one, most in zip(largest, reach, strict=True))


def next_test(problem: DamperProblem, posterior: Posterior) -> NextTest | None:
    """Return the test, of those the rig can make, in which the models that are left differ most.

    Args:
        problem: the tests made, at the sampling of a fit.
        posterior: over the models of the search.

    Returns:
        None: one model alone is left, or no test would separate them better than those that were made, and from
            what the best one leaves.
    """
    chosen = posterior.rivals()[:_MOST_MODELS]
    weights, models = posterior.probabilities[list(chosen)], [posterior.models[i] for i in chosen]
    if len(models) < 2:
        return None
    share = posterior.best.nrms
    candidates: list[tuple[float, str, tuple[int, int], float, float]] = []
    for text, test in _tests(problem):
        forces = _forces(replace(problem, experiments=(*problem.experiments, test)), models)
        if forces is None:
            continue
        noise = problem.experiments[0].channel_noise ** 2 + share * float(np.mean(forces[0] ** 2))
        apart = {
            (i, k): float(weights[i] * weights[k] * np.mean((forces[i] - forces[k]) ** 2)) / max(noise, 1e-300)
            for i, k in combinations(range(len(models)), 2)
        }
        pair = max(apart, key=lambda pair: apart[pair])
        most = _nrms(forces[pair[0]], forces[pair[1]])
        candidates.append((sum(apart.values()), text, pair, most, noise / max(float(np.mean(forces[0] ** 2)), 1e-300)))
    if not candidates:
        return None
    _, text, (i, k), most, noise = max(candidates, key=lambda one: one[0])
    so_far = _so_far(problem, models[i], models[k])
    if most < max(_GAIN * so_far, noise):
        return None
    names = models[i].label, models[k].label
    return NextTest(text, names, most, so_far)


def _forces(problem: DamperProblem, models: Sequence[FittedModel]) -> list[np.ndarray] | None:
    """Return the force (n,) N of each model in the last test; None: one cannot predict it."""
    found = []
    for model in models:
        one = replace(problem.model(model.effects, USES), tests=(len(problem.experiments) - 1,))
        (forces,) = one.forces(model.fit.values)
        if isinstance(forces, PredictionError):
            return None
        found.append(forces[0])
    return found


def _so_far(problem: DamperProblem, one: FittedModel, other: FittedModel) -> float:
    """Return the largest NRMS between the predictions of two models in the tests made."""
    both = [problem.model(model.effects, USES).forces(model.fit.values)[0] for model in (one, other)]
    if any(isinstance(forces, PredictionError) for forces in both):
        return 0.0
    return max(_nrms(a, b) for a, b in zip(*both, strict=True))


def _nrms(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.sum((one - other) ** 2)) / max(float(one @ one), 1e-300)


def _tests(problem: DamperProblem) -> Iterator[tuple[str, Experiment]]:
    """Tests within the reach of the rig: cycles, and a step that is held."""
    reach = Reach.of(problem.experiments)
    low, high = reach.temperatures
    for degrees in dict.fromkeys((problem.experiments[-1].temperature, low, high)):
        for text, motion in _motions(reach):
            if reach.makes(motion):
                last = problem.experiments[-1]
                elapsed = last.elapsed + float(last.motion.since[-1])
                order = len(problem.experiments)
                zero = np.zeros(motion.time.size)
                yield (
                    f"{text}, {degrees:.3g} degC",
                    Experiment("next", "validate", order, elapsed, motion, zero, degrees, conditions=last.conditions),
                )


def _motions(reach: Reach) -> Iterator[tuple[str, Motion]]:
    for frequency in np.unique(np.geomspace(*reach.frequencies, _FREQUENCIES)):
        for share in _SHARES:
            amplitude = share * reach.displacement
            # growing cycles are a little faster and sharper than steady ones
            most = reach.velocity / (2.0 * np.pi * frequency), reach.acceleration / (2.0 * np.pi * frequency) ** 2
            amplitude = min(amplitude, *(0.8 * one for one in most))
            yield (
                f"{_CYCLES} cycles of {1e3 * amplitude:.3g} mm at {frequency:.3g} Hz",
                _sine(amplitude, float(frequency)),
            )
    half = 0.5 * reach.displacement
    ramp = max(_RAMP, 0.5 * np.pi * half / reach.velocity, np.pi * np.sqrt(0.5 * half / reach.acceleration))
    for side, sign in (("stretch", 1.0), ("push back", -1.0)):
        yield f"{side} by {1e3 * half:.3g} mm in {ramp:.2g} s, hold for {_HOLD:g} s", _hold(sign * half, float(ramp))


def _sine(amplitude: float, frequency: float) -> Motion:
    """Cycles that grow over the first two."""
    least, most = _PER_CYCLE
    time = np.arange(0.0, _CYCLES / frequency, 1.0 / min(max(_RATE, least * frequency), most * frequency))
    grow = 0.5 * (1.0 - np.cos(np.pi * np.clip(0.5 * frequency * time, 0.0, 1.0)))
    return _motion(time, amplitude * grow * np.sin(2.0 * np.pi * frequency * time))


def _hold(displacement: float, ramp: float) -> Motion:
    time = np.arange(0.0, ramp + _HOLD, ramp / 20.0)
    return _motion(time, displacement * 0.5 * (1.0 - np.cos(np.pi * np.clip(time / ramp, 0.0, 1.0))))


def _motion(time: np.ndarray, displacement: np.ndarray) -> Motion:
    velocity = spline_velocity(time, displacement)
    return Motion(time, displacement, velocity, spline_velocity(time, velocity))


def _frequency(motion: Motion) -> float:
    """Return the frequency of a sine with the root mean squares of displacement and velocity, Hz."""
    ratio = np.mean(motion.velocity**2) / max(float(np.var(motion.displacement)), 1e-300)
    return max(float(np.sqrt(ratio)) / (2.0 * np.pi), 1e-4)
