"""A campaign of damper tests as a problem of the search."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import forms
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.law_forces import accepted, length_of
from edesign.calibration.dampers.mechanisms import LastingExtremes, NuisanceAmplitudes
from edesign.calibration.dampers.nuisance import Nuisance, Told, joined
from edesign.calibration.dampers.prediction import Kept, Prediction
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.dampers.uncertain_inputs import UncertainInput, uncertain_inputs
from edesign.calibration.form import FormInCampaign, Values
from edesign.calibration.problems import EffectModel, Predicted, TestedProblem, changed
from edesign.calibration.search.problem import Effect
from edesign.damper.fitting.identifiable import FIXED, LIMITED_BY, beside, held
from edesign.damper.fitting.scales import Scales
from edesign.damper.law import Law
from edesign.damper.law import Parameter as LawParameter
from edesign.damper.temperature import GammaOf, GammaT
from edesign.damper.testing.measured_histories import Use
from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import Parameter

_CHANGES = 64  # sets of parameters of which changes by uncertain inputs are kept
_COLUMNS = 64  # sets of columns of all tests that are kept
_FARTHEST = 1e3  # times a declared value, or a part of it: laws without a scale are none that anybody declares
_NOTHING = 1e-2  # of the noise of a test, below which a nuisance changes nothing
_INSIDE = 1e-9  # share of a size that is kept from a bound which is not allowed itself


@dataclass(frozen=True, eq=False)
class DamperProblem(TestedProblem):
    """Tests of one specimen in the order in which they were made, and the law thought to describe it.

    Attributes:
        law: declared.
        declared: its parameters, all of them in the order of the core, SI.
        experiments: all tests, at one sampling.
        typical: sizes in the campaign.
        refit: whether the declared parameters are only a first guess.
        lasting: whether extremes of one test soften the law in the next; otherwise each test has a fresh specimen.
        gamma_of: what gamma_T of an MGMM multiplies.
        threads: at most so many; None: as many as there are processors.
        within: standard deviation of the logarithm of a declared parameter, or of a zero one in its size, at least.
        alone: parameters of the law alone by the tests alone, SI; {}: not fitted.
        belongs_to: what effects of the rig or the damper belong to, by name, as far as the campaign says it.
        near: parameters of the law near which nuisances are looked at, SI; {}: those of the law alone.
        parts: into which each step of a prediction is cut beyond what a fit needs.
    """

    law: Law
    declared: Mapping[str, float]
    experiments: tuple[Experiment, ...]
    typical: Sizes
    refit: bool = True
    lasting: bool = False
    gamma_of: GammaOf = "parameters"
    threads: int | None = None
    within: float = 0.3
    alone: Mapping[str, float] = field(default_factory=dict)
    belongs_to: Mapping[str, str] = field(default_factory=dict)
    near: Mapping[str, float] = field(default_factory=dict)
    parts: int = 1

    @cached_property
    def fitted(self) -> tuple[int, ...]:
        """Indices of the tests that are fitted."""
        return self.used_for("fit")

    @property
    def uses(self) -> tuple[Use, ...]:
        """Use of each test."""
        return tuple(one.use for one in self.experiments)

    @cached_property
    def deviations(self) -> tuple[float, ...]:
        """Standard deviation of the noise of weighted residuals of each test that is fitted, N."""
        return tuple(self.experiments[i].weighted_noise for i in self.fitted)

    @cached_property
    def sizes(self) -> tuple[float, ...]:
        """Root mean square of the weighted force of each test that is fitted, N."""
        return tuple(float(np.sqrt(np.mean(y**2))) for y in self.model(()).measured)

    @cached_property
    def input_noise(self) -> float:
        """Share of the power of the force that the law makes of noise of the displacement, and of its interpolation."""
        fitted = [self.experiments[i] for i in self.fitted]
        noise = sum(one.force.size * max(one.weighted_noise**2 - one.channel_noise**2, 0.0) for one in fitted)
        return noise / sum(one.force.size * size**2 for one, size in zip(fitted, self.sizes, strict=True))

    @cached_property
    def base(self) -> tuple[Parameter, ...]:
        """Parameters of the law with priors about what is declared; those that others make needless are fixed.

        A declared value may be as far off as the tests alone put it: that is the likeliest spread of a prior of which
        one value is known (MacKay 1994, ASHRAE Transactions 100, 1053-1062: automatic relevance determination).
        """
        if not self.refit:
            return ()
        scales = Scales(self.typical.force, self.typical.displacement, self.typical.velocity)
        return tuple(
            _about_declared(
                *(beside(self.law, one, self.declared), self.declared, scales, self.within, self.alone.get(one.name))
            )
            for one in self.law.all_parameters(self.declared)
            if one.fitted and one.name not in self._fixed
        )

    @cached_property
    def _fixed(self) -> frozenset[str]:
        limiting = LIMITED_BY.get(self.law.name, {}).values()
        every = FIXED.get(self.law.name, {})
        return frozenset(name for name in every if name not in limiting or not self.declared[name])

    @property
    def start(self) -> tuple[float, ...]:
        """Values, SI, from which the law is fitted."""
        return tuple(self.alone.get(one.name, one.centre) for one in self.base)

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """Effects that the campaign can show and the core takes with this law."""
        values = self.law.all_parameters(self.declared)
        varied = [one.name for one in values if one.fitted and self.declared[one.name] and one.name not in self._fixed]
        every = (form.read(self.law.name, self.belongs_to.get(form.name)) for form in forms(self.typical, varied))
        return tuple(form.effect(self.typical) for form in every if self._suits(form))

    def _suits(self, form: EffectForm) -> bool:
        if form.laws and self.law.name not in form.laws:
            return False
        if self.lasting and any(isinstance(mechanism, LastingExtremes) for mechanism in form.mechanisms):
            return False
        if not form.core_effects:
            return True
        p = form.of(self.typical).values(form.starts(self.typical)[0])
        try:
            effects = [mechanism.in_test(p, self.experiments[0]) for mechanism in form.core_effects]
        except PredictionError:
            return False
        return accepted(self.law, self.declared, effects)

    @cached_property
    def prediction(self) -> Prediction:
        """Predicts the tests."""
        gamma = GammaT(of=self.gamma_of)
        own = gamma if self.law.name in gamma.laws else None
        threads = self.threads or os.cpu_count() or 1
        length = length_of(self.law, self.declared, self.typical.force, self.typical.displacement)
        ordered, tests = self.typical.ordered, self.experiments
        return Prediction(self.law, tests, own, self.lasting, threads, length, ordered, self.parts)

    @cached_property
    def uncertain_inputs(self) -> tuple[tuple[UncertainInput, DamperProblem, DamperProblem], ...]:
        """What is not known of the tests, each with the problem as it would be otherwise, and as it is thought of."""
        every = uncertain_inputs(self.experiments, self.law.name, self.prediction.depends_on_temperature)
        problems = {one.thought: self.with_experiments(one.thought) for one in every}
        return tuple((one, self.with_experiments(one.experiments), problems[one.thought]) for one in every)

    @cached_property
    def changes(self) -> Kept[list[np.ndarray]]:
        """What uncertain inputs change (n_i,) N, by tests and effects through which they act."""
        return Kept(_CHANGES)

    @cached_property
    def columns(self) -> Kept[tuple[np.ndarray | None, ...]]:
        """Weighted nuisance columns (n_i, k) N of each test, by tests and effects that make them."""
        return Kept(_COLUMNS)

    def law_values(self, numbers: Iterable[float]) -> dict[str, float]:
        """Return all parameters of the law by name, SI, with those that others hold.

        Args:
            numbers: those of the base and more, SI.
        """
        fitted = {one.name: float(number) for one, number in zip(self.base, numbers, strict=False)}
        return held(self.law, {**self.declared, **fitted}) if fitted else dict(self.declared)

    def model(self, effects: Sequence[Effect], uses: Sequence[Use] = ("fit",)) -> DamperModel:
        """Return the law with effects; its parameters are those of the law, and of the effects in their order."""
        return DamperModel(self, tuple(effects), self.used_for(*uses))

    def with_experiments(self, experiments: Sequence[Experiment]) -> DamperProblem:
        """Return the problem with the same tests at another sampling, or otherwise known.

        Args:
            experiments: all tests in their order.
        """
        return replace(self, experiments=tuple(experiments))

    def share_of(self, left: Sequence[np.ndarray]) -> float:
        """Return the share of the power of the force that a model leaves beside noise.

        Args:
            left: weighted residuals (n_i,) N of each test that is fitted.
        """
        sizes = np.array([one.size for one in left])
        noise, power = (sizes @ np.square(each) for each in (self.deviations, self.sizes))
        return max(float(sum(one @ one for one in left) - noise), 0.0) / max(float(power), 1e-300)

    def weighed(self, share: float) -> DamperProblem:
        """Return the problem with residuals weighted by noise, and by what a model leaves beside it.

        Args:
            share: of the power of the force, in all tests.
        """
        return self.with_experiments([one.weighed(math.sqrt(share) * one.rms_force) for one in self.experiments])

    @cached_property
    def full_rate(self) -> DamperProblem:
        """The problem with tests at full rate."""
        return self.with_experiments([one if one.full is None else one.full for one in self.experiments])


@dataclass(frozen=True, eq=False)
class DamperModel(EffectModel[DamperProblem]):
    """A law with effects, of some tests."""

    @cached_property
    def weights(self) -> tuple[np.ndarray, ...]:
        """Factors (n_i,) of the residuals of each test that make its noise as strong at all times."""
        return tuple(self.problem.experiments[i].weights for i in self.tests)

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Weighted force (n_i,) N of each test."""
        return tuple(w * self.problem.experiments[i].force for i, w in zip(self.tests, self.weights, strict=True))

    def predict(self, values: np.ndarray) -> list[Predicted]:
        """Return the weighted force (n_i,) N of each test for each set of parameters, or why there is none.

        Args:
            values: (m, p) SI.
        """
        return self._weighted(self.forces(values))

    def near(self, values: np.ndarray, around: np.ndarray, predicted: Sequence[np.ndarray]) -> list[Predicted]:
        """Return predictions as `predict` does, with changes from a set of parameters near by in longer steps.

        Args:
            values: (m, p) SI.
            around: (p,) SI, near them.
            predicted: (n_i,) of each test with that set.
        """
        here, *there = self._weighted(self.forces(np.vstack((around, values)), rough=True))
        if isinstance(here, PredictionError):
            return self.predict(values)
        return changed(predicted, here, there)

    def forces(self, values: np.ndarray, rough: bool = False) -> list[Predicted]:
        """Return the force (n_i,) N of each test for each set of parameters, or why there is none.

        Args:
            values: (m, p) SI.
            rough: whether they are for changes alone.
        """
        return self.problem.prediction.predict([self._of(one) for one in np.atleast_2d(values)], self.tests, rough)

    def _weighted(self, forces: Sequence[list[np.ndarray] | PredictionError]) -> list[Predicted]:
        return [
            of_set
            if isinstance(of_set, PredictionError)
            else [w * f for w, f in zip(self.weights, of_set, strict=True)]
            for of_set in forces
        ]

    def nuisance_columns(self, values: np.ndarray) -> list[np.ndarray | None]:
        """Return weighted columns (n_i, k) N of the nuisance amplitudes, N(0, 1), of each test; None: there are none.

        Args:
            values: (p,) SI.
        """
        return self.columns_near(values, values)

    def columns_near(self, values: np.ndarray, around: np.ndarray) -> list[np.ndarray | None]:
        """Return columns as `nuisance_columns` does, with what uncertain inputs make of the force near by.

        Args:
            values: (p,) SI.
            around: (p,) SI, near them.
        """
        inputs = [one for one, *_ in self.problem.uncertain_inputs]
        makers = [(of.form.label, *p.values()) for of, p in self._of(values)[1] if of.form.nuisance]
        for of, p in self._of(around)[1]:
            if any(one.acts_through(of.form) for one in inputs):
                makers.append(("through", of.form.label, *p.values()))
        # a fit asks for them at each step, and mostly moves other parameters
        return list(self.problem.columns.of((self.tests, *makers), lambda: self._weighted_columns(values, around)))

    def _weighted_columns(self, values: np.ndarray, around: np.ndarray) -> tuple[np.ndarray | None, ...]:
        every = map(joined, self.nuisances(values, around))
        return tuple(
            None if one is None else w[:, np.newaxis] * one for w, one in zip(self.weights, every, strict=True)
        )

    def nuisances(self, values: np.ndarray, around: np.ndarray | None = None) -> list[list[Nuisance]]:
        """Return the nuisances of each test: those of the effects, and what uncertain inputs make of the force.

        Args:
            values: (p,) SI.
            around: (p,) SI, near them, with which uncertain inputs are asked for; None: the values.
        """
        around = values if around is None else around
        experiments = [self.problem.experiments[i] for i in self.tests]
        found: list[list[Nuisance]] = [
            [
                Nuisance(of.form.label, mechanism.columns(p, one), mechanism.told(p, one), True)
                for of, p in self._of(values)[1]
                for mechanism in of.form.mechanisms
                if isinstance(mechanism, NuisanceAmplitudes)
            ]
            for one in experiments
        ]
        changes = [
            (uncertain, change, self._through(uncertain, around))
            for number, (uncertain, *_) in enumerate(self.problem.uncertain_inputs)
            if (change := self._change(number, around)) is not None
        ]
        for k, one in enumerate(experiments):
            ways = []
            for uncertain, change, through in changes:
                column = change[k][:, np.newaxis]
                # at all values of a model there are as many columns: what effects make may be nothing at some
                if not through and float(np.max(np.abs(column))) <= _NOTHING * one.noise:
                    continue
                if not uncertain.state:
                    told = Told(uncertain.name, uncertain.unit, np.array([uncertain.size]))
                    found[k].append(Nuisance(uncertain.name, column, (told,), uncertain.before))
                elif self.tests[k] in self._after_motion(through):
                    ways.append(column)
            if ways:
                columns = np.hstack(ways)
                found[k].append(Nuisance("start", columns, (Told("force", "N", columns[0]),), True))
        return found

    def _through(self, uncertain: UncertainInput, values: np.ndarray) -> list[tuple[FormInCampaign, Values]]:
        """Return the effects through which an uncertain input acts, with their parameters."""
        return [(of, p) for of, p in self._of(values)[1] if uncertain.acts_through(of.form)]

    def _after_motion(self, through: Sequence[tuple[FormInCampaign, Values]]) -> tuple[int, ...]:
        """Return the tests of which no record shows all that the specimen did before: those that begin in motion.

        Where effects remember it from test to test, they are all tests after the first of these.
        """
        unknown = [i for i, one in enumerate(self.problem.experiments) if one.prior_extremes_unknown]
        carried = self.problem.typical.ordered and any(of.form.carries for of, _ in through)
        return tuple(i for i in self.tests if i in unknown or (carried and unknown and i > unknown[0]))

    def _change(self, number: int, values: np.ndarray) -> list[np.ndarray] | None:
        """Return what an uncertain input changes (n_i,) N in each test; None: nothing.

        The law is one near by, with the effects through which it acts alone, so that few sets of parameters are asked
        for.
        """
        uncertain, other, thought = self.problem.uncertain_inputs[number]
        through = self._through(uncertain, values)
        tests = self._after_motion(through) if uncertain.state else self.tests
        if not tests or not (through or uncertain.through_law):
            return None

        def change() -> list[np.ndarray]:
            nothing = [np.zeros_like(self.problem.experiments[i].force) for i in self.tests]
            asked = [({**self.problem.declared, **(self.problem.near or self.problem.alone)}, through)]
            (there,), (here,) = (one.prediction.predict(asked, tests, uncertain.state) for one in (other, thought))
            if isinstance(there, PredictionError) or isinstance(here, PredictionError):
                return nothing
            of = dict(zip(tests, (a - b for a, b in zip(there, here, strict=True)), strict=True))
            return [of.get(i, zero) for i, zero in zip(self.tests, nothing, strict=True)]

        key = (number, self.tests, *((of.form.label, *p.values()) for of, p in through))
        return self.problem.changes.of(key, change)

    def _of(self, values: np.ndarray) -> tuple[dict[str, float], list[tuple[FormInCampaign, Values]]]:
        """Return the law's parameters, and the effects with theirs."""
        return self.problem.law_values(values), self.effect_values(values)


def _about_declared(
    one: LawParameter, declared: Mapping[str, float], scales: Scales, within: float, alone: float | None
) -> Parameter:
    """Return a parameter of a law with its prior: of a positive one of the logarithm, else of the value."""
    value = declared[one.name]
    size = abs(value) if value else scales.of(one.unit, declared)
    lower = one.lower + (0.0 if one.lower_allowed or math.isinf(one.lower) else _INSIDE * size)
    upper = one.upper - (0.0 if one.upper_allowed or math.isinf(one.upper) else _INSIDE * size)
    if value > 0.0 and lower >= 0.0:
        bounds = max(lower, value / _FARTHEST), min(upper, value * _FARTHEST)
        spread = within if alone is None else max(within, abs(math.log(alone / value)))
        return Parameter(one.name, one.unit, *bounds, value, spread, True)
    spread = within * size if alone is None else max(within * size, abs(alone - value))
    return Parameter(one.name, one.unit, lower, upper, value, spread)
