"""Tests that do not agree with the others, fitted or not, and the fault of an instrument that explains each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.calibration.dampers.effects.places import one_test
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import APART
from edesign.calibration.results.fit import STEPS, effect_estimates, estimates, unbounded
from edesign.calibration.results.floor import Part, worst_of
from edesign.calibration.results.result import Fault, OutlyingTest
from edesign.calibration.search.models import FittedModel, Fitter
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.settings import SearchSettings
from edesign.estimation.left_out import LEAST
from edesign.estimation.noise import Noise
from edesign.estimation.outlier import Outlier

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
        # what is told of tests that validate may be more than a fault of the one test which is fitted
        (test,) = next((one.tests for one in asked.faults if one.label == effect.label), (None,))
        without = None if test is None else asked.fitted(*model.without(index))
        if without is not None:
            found += asked.told(without, lambda one, test=test: one.test == test)  # type: ignore[misc]
    told = {one.name for one in found}
    return (*found, *(one for one in asked.told(model, lambda one: one.sure) if one.name not in told))


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
        one, test = self.problem.experiments[found.test], found.test
        by_others = self.fitter.fit(model.effects, model.fit, self.noise.without(test), STEPS) or model
        deviations, sizes = np.square(self.fitter.problem.deviations), np.square(self.fitter.problem.sizes)
        others = [i for i in range(deviations.size) if i != test]
        samples = np.array([f.size for f in model.fit.predicted])
        power = float((samples * sizes)[others].sum())
        squares = {of: np.array([float(r @ r) for r in of.left]) for of in (model, by_others)}
        names = [each.name for each in self.problem.experiments]
        ratios = squares[by_others] / samples / deviations
        return [
            OutlyingTest(
                name=one.name,
                use=one.use,
                ratio=found.ratio,
                chance=found.chance,
                others_with=float(squares[model][others].sum()) / power,
                others_without=float(squares[by_others][others].sum()) / power,
                only_noise=worst_of([Part(names[i], float(ratios[i]), 1.0, int(samples[i])) for i in others]) is None,
                faults=self._faults(by_others, test),
                beyond=self._beyond(test),
            )
        ]

    def _faults(self, by_others: FittedModel, test: int) -> tuple[Fault, ...]:
        """Return the faults each of which makes a test agree with the others, the likeliest first."""
        effects = by_others.effects
        tried = list[FittedModel]()
        for fault in self.faults:
            starts = fault.starts if fault.tests == (test,) else ()
            grown = [self.fitted((*effects, fault), np.append(by_others.fit.values, one)) for one in starts]
            if some := [one for one in grown if one is not None]:
                tried.append(min(some, key=lambda one: one.nrms))
        if not tried:
            return ()
        noise = min(tried, key=lambda one: one.nrms).noise
        totals = [self.fitter.score(one, noise).total for one in tried]
        likely = sorted(zip(totals, tried, strict=True), key=lambda one: -one[0])
        return tuple(
            Fault(of.name, of.form, of.data.words(own).title, effect_estimates(one, estimates(one), len(effects)))
            for total, one in likely
            for of, own in [(one.effects[-1], one.fit.values[one.places(len(effects))])]
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
