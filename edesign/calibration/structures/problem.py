"""Records of a structure as a problem of the search."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibration.form import Values
from edesign.calibration.problems import EffectModel, Predicted, TestedProblem, changed
from edesign.calibration.search.problem import Effect
from edesign.calibration.signals.noise import white_noise
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.campaign import Isolation
from edesign.calibration.structures.effect import ChangedBuilding, ChangedChannels, Links, Mechanism
from edesign.calibration.structures.effects import forms
from edesign.calibration.structures.isolation import IsolationLaw
from edesign.calibration.structures.record import Channel, Measure, StructureTest
from edesign.calibration.structures.response import Link, Response, respond
from edesign.calibration.structures.sizes import StructureSizes
from edesign.damper.fitting.identifiable import FIXED
from edesign.damper.law import Parameter as LawParameter
from edesign.damper.laws import law as law_of
from edesign.damper.testing.measured_histories import Use
from edesign.errors import InputError
from edesign.estimation.model import PredictionError
from edesign.estimation.parameters import Parameter

STIFFNESS, DAMPING = "storey_stiffness", "storey_damping"
"""Factors of what is declared."""
_STIFFNESS_KNOWN = 0.3  # standard deviation of the logarithm of a declared stiffness or force
_DAMPING_KNOWN = 0.7
"""The same of damping: that of measured ratios about what codes say (Cruz and Miranda 2017, Earthquake Spectra 33)."""
LEAST_NOISE = 2e-3  # of a test's rms: steps of records, and forces of links linear in them, leave so much
_PER_CYCLE = 8  # samples of a channel that are compared, in a cycle of a sine with its root mean squares
_FEWEST = 16  # of a test
_WORTHWHILE = 3  # sets of parameters, from which on one more is cheaper than fine steps of links
_FARTHEST = 1e3  # times a declared value, or a part of it
_INSIDE = 1e-6  # of a size, from a bound that is not allowed


@dataclass(frozen=True, eq=False)
class StructureProblem(TestedProblem):
    """Tests of one structure in the order in which they were made.

    Values of a test are its channels one after the other, each over the root mean square of its measure.

    Attributes:
        declared: stiffness, damping and masses; without its isolation layer.
        isolation: law of that layer; None: fixed base.
        refit: whether stiffness and damping of the storeys are only a first guess.
        tests: in their order.
        threads: of predictions, at most so many; None: as many as there are processors.
        every: one of so many samples is compared; the motion of the base counts in all of them.
    """

    declared: Building
    isolation: Isolation | None
    refit: bool
    tests: tuple[StructureTest, ...]
    threads: int | None = None
    every: int = 1

    @property
    def uses(self) -> tuple[Use, ...]:
        """Use of each test."""
        return tuple(test.use for test in self.tests)

    @cached_property
    def base(self) -> tuple[Parameter, ...]:
        """Factors of storey stiffness and damping, and the parameters that the file gives for the isolation layer."""
        found: list[Parameter] = []
        if self.refit:
            found.append(Parameter(STIFFNESS, "", 0.05, 20.0, 1.0, _STIFFNESS_KNOWN, True))
            found.append(Parameter(DAMPING, "", 0.02, 50.0, 1.0, _DAMPING_KNOWN, True))
        if self.isolation is not None and self.isolation.refit:
            law = law_of(self.isolation.law)
            for one in law.all_parameters(self.isolation.values):
                value = self.isolation.values[one.name]
                if (
                    one.name in self.isolation.named
                    and one.fitted
                    and value
                    and one.name not in FIXED.get(law.name, {})
                ):
                    found.append(_about_declared(one, value))
        return tuple(found)

    @cached_property
    def scale(self) -> Mapping[Measure, float]:
        """Root mean square of each measure over the tests that are fitted."""
        powers: dict[Measure, list[np.ndarray]] = {}
        for i in self.used_for("fit"):
            for channel, values in zip(self.tests[i].channels, self.tests[i].values.T, strict=True):
                powers.setdefault(channel.measure, []).append(values**2)
        return {measure: float(np.sqrt(np.mean(np.concatenate(p)))) for measure, p in powers.items()}

    @cached_property
    def deviations(self) -> tuple[float, ...]:
        """Standard deviation of the noise of each test that is fitted: that of its scaled channels together."""
        found = []
        for i, size in zip(self.used_for("fit"), self.sizes, strict=True):
            noise = self.channel_noise(i) / self._scales(self.tests[i].channels)
            found.append(max(float(np.sqrt(np.mean(noise**2))), LEAST_NOISE * size))
        return tuple(found)

    @cached_property
    def sizes(self) -> tuple[float, ...]:
        """Root mean square of the scaled channels of each test that is fitted."""
        return tuple(float(np.sqrt(np.mean(y**2))) for y in self.model(()).measured)

    def channel_noise(self, test: int) -> np.ndarray:
        """Return the standard deviation of broadband noise of each channel (channels,), SI."""
        return np.array([white_noise(values, self.tests[test].time) for values in self.tests[test].values.T])

    @cached_property
    def typical(self) -> StructureSizes:
        """Sizes by which effects bound their parameters."""
        return StructureSizes.of(
            self.declared, self.isolation, [self.tests[i] for i in self.used_for("fit")], self.refit
        )

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """Effects that the structure and its channels can show."""
        return tuple(form.effect(self.typical) for form in forms(self.typical))

    def model(self, effects: Sequence[Effect], uses: Sequence[Use] = ("fit",)) -> StructureModel:
        """Return the building with effects; its parameters are those of the base, and of the effects in their order."""
        return StructureModel(self, tuple(effects), self.used_for(*uses))

    def building(self, values: Values) -> tuple[Building, tuple[Link, ...]]:
        """Return the building, and the links of its isolation layer.

        Args:
            values: parameters of the base by name, SI.

        Raises:
            PredictionError: there is no such isolation layer.
        """
        links: tuple[Link, ...] = ()
        declared = self.declared
        stiffness = values.get(STIFFNESS, 1.0) * declared.stiffness
        dashpots = values.get(DAMPING, 1.0) * declared.dashpots
        ratio = values.get(DAMPING, 1.0) * declared.damping.ratio
        if self.isolation is not None:
            try:
                law = IsolationLaw.of(
                    self.isolation.law, {k: values.get(k, v) for k, v in self.isolation.values.items()}
                )
            except InputError as error:
                raise PredictionError(str(error)) from error
            stiffness[0], dashpots[0], links = law.stiffness, law.dashpot, law.links
        damping = replace(declared.damping, ratio=ratio)
        return replace(declared, stiffness=stiffness, dashpots=dashpots, damping=damping), links

    def thinned(self) -> StructureProblem:
        """Return the problem with no more samples compared than a fit needs."""
        fastest = max(_cycles(values) for i in self.used_for("fit") for values in self.tests[i].values.T)
        shortest = min(test.base.size for test in self.tests)
        return replace(self, every=_in_steps(min(int(1.0 / (_PER_CYCLE * fastest)), shortest // _FEWEST)))

    @property
    def full_rate(self) -> StructureProblem:
        """The problem with all samples compared."""
        return replace(self, every=1)

    def flat(self, test: int, values: np.ndarray) -> np.ndarray:
        """Return channels (t, channels), SI, as the search takes them (n_i,), one after the other.

        Args:
            test: its index.
            values: of the channels, at the samples that are compared.
        """
        return np.ascontiguousarray((values / self._scales(self.tests[test].channels)).T).ravel()

    def _scales(self, channels: Sequence[Channel]) -> np.ndarray:
        return np.array([self.scale[channel.measure] for channel in channels])


@dataclass(frozen=True, eq=False)
class StructureModel(EffectModel[StructureProblem]):
    """A building with effects, in some tests."""

    @cached_property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Scaled channels (n_i,) of each test."""
        return tuple(self.problem.flat(i, self.problem.tests[i].values[:: self.problem.every]) for i in self.tests)

    def predict(self, values: np.ndarray) -> list[Predicted]:
        """Return the scaled channels (n_i,) of each test for each set of parameters, or why there are none."""
        return self._each(np.atleast_2d(values), False)

    def near(self, values: np.ndarray, around: np.ndarray, predicted: Sequence[np.ndarray]) -> list[Predicted]:
        """Return predictions as `predict` does, with changes from a set near by found by longer steps of links."""
        linked = any(isinstance(mechanism, Links) for mechanism, _ in self._mechanisms(around))
        if self.problem.every == 1 or len(values) < _WORTHWHILE or not linked:
            return self.predict(values)
        here, *there = self._each(np.vstack((around, values)), True)
        if isinstance(here, PredictionError):
            return self.predict(values)
        return changed(predicted, here, there)

    def _each(self, values: np.ndarray, rough: bool) -> list[Predicted]:
        rows = list(values)
        workers = min(len(rows), self.problem.threads or os.cpu_count() or 1)
        if workers <= 1:
            return [self._predicted(one, rough) for one in rows]
        with ThreadPoolExecutor(workers) as pool:
            return list(pool.map(self._predicted, rows, [rough] * len(rows)))

    def _predicted(self, values: np.ndarray, rough: bool) -> Predicted:
        try:
            with np.errstate(all="ignore"):  # a search may ask for anything; what is not finite is refused
                histories = self.histories(values, rough)
        except PredictionError as error:
            return error
        return [self.problem.flat(i, found) for i, found in zip(self.tests, histories, strict=True)]

    def histories(self, values: np.ndarray, rough: bool = False) -> list[np.ndarray]:
        """Return the channels (t, channels), SI, of each test, at the samples that are compared.

        Args:
            values: (p,) SI.
            rough: whether steps of links may be longer, for differences.

        Raises:
            PredictionError: there is no response with these values.
        """
        changes = [
            (mechanism, p) for mechanism, p in self._mechanisms(values) if isinstance(mechanism, ChangedChannels)
        ]
        every = self.problem.every
        within = every if not rough and any(mechanism.over_time for mechanism, _ in changes) else 1
        found = []
        for i, response in zip(self.tests, self._responses(values, every // within, rough), strict=True):
            test = self.problem.tests[i]
            motion = np.column_stack([getattr(response, c.measure)[:, c.floor] for c in test.channels])
            for mechanism, p in changes:
                motion = mechanism.change(p, test.step * (every // within), test.channels, motion)
            if not np.all(np.isfinite(motion)):
                raise PredictionError("the response is not finite")
            found.append(motion[::within])
        return found

    def responses(self, values: np.ndarray) -> list[Response]:
        """Return the response of each test at the samples that are compared, as it is before instruments.

        Earlier tests are run through where an effect remembers them.

        Args:
            values: (p,) SI.

        Raises:
            PredictionError: there is no response with these values.
        """
        return self._responses(values, self.problem.every, False)

    def _responses(self, values: np.ndarray, every: int, rough: bool) -> list[Response]:
        building, links = self.problem.building(self.base_values(values))
        mechanisms = self._mechanisms(values)
        for mechanism, p in mechanisms:
            if isinstance(mechanism, ChangedBuilding):
                building = mechanism.change(p, building)
        for mechanism, p in mechanisms:
            if isinstance(mechanism, Links):
                links = (*links, *mechanism.of(p, building))
        last = max(self.tests, default=-1)
        run = range(last + 1) if any(link.remembers for link in links) else self.tests
        try:
            motions = [(self.problem.tests[i].base, self.problem.tests[i].step) for i in run]
            found = respond(building.system(), motions, links, every, rough)
        except (np.linalg.LinAlgError, OverflowError, ValueError) as error:
            raise PredictionError(str(error)) from error
        return [response for i, response in zip(run, found, strict=True) if i in self.tests]

    def _mechanisms(self, values: np.ndarray) -> list[tuple[Mechanism, Values]]:
        """Return the mechanisms of each effect, with its values."""
        return [(mechanism, p) for of, p in self.effect_values(values) for mechanism in of.form.mechanisms]


def _about_declared(one: LawParameter, value: float) -> Parameter:
    """Return a parameter of the isolation law with its prior: of a positive one of the logarithm, else of the value."""
    size = abs(value)
    lower = one.lower + (0.0 if one.lower_allowed else _INSIDE * size)
    upper = one.upper - (0.0 if one.upper_allowed else _INSIDE * size)
    known = _DAMPING_KNOWN if "s" in one.unit else _STIFFNESS_KNOWN
    if value > 0.0 and one.lower >= 0.0:
        bounds = max(lower, size / _FARTHEST), min(upper, size * _FARTHEST)
        return Parameter(one.name, one.unit, *bounds, value, known, True)
    bounds = max(lower, -_FARTHEST * size), min(upper, _FARTHEST * size)
    return Parameter(one.name, one.unit, *bounds, value, known * size)


def _cycles(values: np.ndarray) -> float:
    """Cycles from sample to sample of a sine with the root mean squares of a channel (t,) and its rate."""
    return float(np.sqrt(np.mean(np.diff(values) ** 2) / max(np.mean(values**2), 1e-300)) / (2.0 * np.pi))


def _in_steps(most: int) -> int:
    """Return the largest number up to one, at least 1, that halves and thirds divide, so that rough steps fit in it."""
    return max((2**i * 3**j for i in range(10) for j in range(6) if 2**i * 3**j <= most), default=1)
