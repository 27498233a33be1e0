"""Tests that do not agree with the others, fitted or not, and the fault of an instrument that explains each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.calibration.dampers.effects.places import one_test
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import APART
from edesign.calibration.results.fit import effect_estimates, estimates, unbounded
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.result import Fault, OutlyingTest
from edesign.calibration.search.adoption import STEPS
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.settings import SearchSettings
from edesign.estimation.left_out import LEAST, Outlier
from edesign.estimation.noise import Noise

_BEYOND = 1.1  # times the largest of the other tests, from which on a law is extrapolated


def outlying_tests(
    problem: DamperProblem, effects: Sequence[Effect], values: np.ndarray, settings: SearchSettings
) -> tuple[OutlyingTest, ...]:
    """Return tests that do not agree with the others beside a model: those in which it has a fault, and one more.

    All tests of the campaign are fitted here, so that one which validates is told as one that was fitted to. Nothing is
    chosen by that.

    Args:
        problem: at the sampling of a fit.
        effects: of the model, some of them faults in one test.
        values: (p,) of its parameters, SI.
    """
    every = replace(
        problem,
        experiments=tuple(replace(one, use="fit") for one in problem.experiments),
        typical=replace(problem.typical, fitted=(True,) * len(problem.experiments)),
    )
    asked = _Asked(
        unbounded(every, settings), problem, [form.effect(every.typical) for form in one_test(every.typical)]
    )
    model = asked.fitted(effects, values)
    if model is None:
        return ()
    found = list[OutlyingTest]()
    for index, effect in enumerate(effects):
        without = asked.fitted(*model.without(index)) if len(effect.tests) == 1 else None
        if without is not None:
            (test,) = next(one.tests for one in asked.faults if one.label == effect.label)
            found += asked.told(without, lambda one, test=test: one.test == test)  # type: ignore[misc]
    return (*found, *asked.told(model, lambda one: one.sure))


@dataclass(frozen=True)
class _Asked:
    """What is asked of the tests.

    Attributes:
        fitter: of all tests.
        problem: with their uses.
        faults: of one test, each.
    """

    fitter: Fitter
    problem: DamperProblem
    faults: Sequence[Effect]

    @property
    def noise(self) -> Noise:
        """That of the channels."""
        return Noise.white(self.fitter.problem.deviations)

    def fitted(self, effects: Sequence[Effect], values: np.ndarray) -> FittedModel | None:
        return self.fitter.fit(effects, values, self.noise, STEPS)

    def told(self, model: FittedModel, wanted: Callable[[Outlier], bool]) -> list[OutlyingTest]:
        """Return what is to be said of the test that agrees least with the others beside a model, if that is wanted."""
        found = self.fitter.outlier(model)
        if found is None or not wanted(found):
            return []
        one, row = self.problem.experiments[found.test], self.fitter.score(model, self.noise).squares[found.test]
        samples = np.array([f.size for f in model.fit.predicted])
        others = np.delete(np.arange(samples.size), found.test)
        parts = [Part(self.problem.experiments[i].name, float(row[i]), 1.0, int(samples[i])) for i in others]
        power = float((samples * np.square(self.fitter.problem.sizes))[others].sum())
        left = (row * samples * np.square(self.fitter.problem.deviations))[others]
        return [
            OutlyingTest(
                name=one.name,
                use=one.use,
                ratio=found.ratio,
                chance=found.chance,
                others_with=sum(float(model.left[i] @ model.left[i]) for i in others) / power,
                others_without=float(left.sum()) / power,
                only_noise=worst_of(parts) is None,
                faults=self._faults(model, found.test),
                beyond=self._beyond(found.test),
            )
        ]

    def _faults(self, model: FittedModel, test: int) -> tuple[Fault, ...]:
        """Return the faults each of which makes a test agree with the others, the likeliest first."""
        by_others = self.fitter.fit(model.effects, model.fit, self.noise.without(test), STEPS) or model
        tried = list[FittedModel]()
        for fault in self.faults:
            starts = fault.starts if fault.tests == (test,) else ()
            grown = [self.fitted((*model.effects, fault), np.append(by_others.fit.values, one)) for one in starts]
            if some := [one for one in grown if one is not None]:
                tried.append(min(some, key=lambda one: one.nrms))
        if not tried:
            return ()
        noise = min(tried, key=lambda one: one.nrms).noise
        totals = [self.fitter.score(one, noise).total for one in tried]
        likely = sorted(zip(totals, tried, strict=True), key=lambda one: -one[0])
        return tuple(
            Fault(of.name, of.form, of.data.title, effect_estimates(one, estimates(one), len(model.effects)))
            for total, one in likely
            for of in [one.effects[-1]]
            if total > max(totals) - LEAST and self._agrees(one, test)
        )

    def _agrees(self, model: FittedModel, test: int) -> bool:
        found = self.fitter.outlier(model)
        return found is None or not found.sure or found.test != test

    def _beyond(self, test: int) -> tuple[str, ...]:
        """Return in what a test goes beyond all others."""
        one, *others = (
            self.problem.experiments[i] for i in [test, *(i for i in range(len(self.problem.experiments)) if i != test)]
        )
        sizes: dict[str, Callable[[Experiment], float]] = {
            "displacement": lambda of: float(np.max(np.abs(of.motion.displacement))),
            "velocity": lambda of: float(np.max(np.abs(of.motion.velocity))),
        }
        found = [name for name, of in sizes.items() if of(one) > _BEYOND * max(map(of, others))]
        if all(abs(one.temperature - other.temperature) >= APART for other in others):
            found.append("temperature")
        return tuple(found)
