"""Predicted forces of all tests of a campaign, for many sets of parameters at once."""

from __future__ import annotations

from collections import OrderedDict
from collections.abc import Callable, Hashable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from threading import Lock
from typing import Any, Generic, TypeVar

import numpy as np

from edesign.calibration.dampers.effect import REFINED
from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.law_forces import LONG, LawTest, forces
from edesign.calibration.dampers.mechanisms import (
    CoreEffect,
    ForceChannel,
    LastingExtremes,
    LawParameters,
    MotionChannel,
    Rest,
    Rig,
    RigValues,
    Thermometer,
)
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.form import FormInCampaign, Values
from edesign.core import CoreError
from edesign.damper.history import NONE
from edesign.damper.law import Law
from edesign.damper.temperature import GammaT, at
from edesign.damper.testing.start import widest
from edesign.errors import InputError
from edesign.estimation.model import PredictionError

_MOTIONS = 512  # of tests under channels, that are kept
_FORCES = 4096  # of the law in tests
_ROUGH = 0.5  # of the samples, for changes alone: their errors are a few times as large, and of what changes only

Effects = Sequence[tuple[FormInCampaign, Values]]
"""Forms of effects with their values."""

T = TypeVar("T")


class Kept(Generic[T]):
    """Results that were asked for last, by key; several threads may ask.

    Args:
        most: of them that are kept.
    """

    def __init__(self, most: int) -> None:
        self._most, self._found, self._lock = most, OrderedDict[Hashable, T](), Lock()

    def get(self, key: Hashable) -> T | None:
        """Return what is kept; None: nothing."""
        with self._lock:
            if key not in self._found:
                return None
            self._found.move_to_end(key)
            return self._found[key]

    def put(self, key: Hashable, value: T) -> T:
        """Keep a result, and return it."""
        with self._lock:
            self._found[key] = value
            if len(self._found) > self._most:
                self._found.popitem(last=False)
        return value

    def of(self, key: Hashable, make: Callable[[], T]) -> T:
        """Return what is kept, or else make it and keep it."""
        found = self.get(key)
        return self.put(key, make()) if found is None else found


@dataclass(frozen=True)
class _Asked:
    """A set of parameters in a test.

    Attributes:
        index: of the test.
        key: of the law's force, by all tests that it goes on from; the same key has the same force.
        test: the law in it.
        motion: of the specimen, with what it did before.
        actuator: motion of the actuator.
        parts: into which each step is cut.
    """

    index: int
    key: tuple[Hashable, ...]
    test: LawTest
    motion: Motion
    actuator: Motion
    parts: int


class Prediction:
    """Predicts tests of one specimen in the order in which they were made.

    What does not change is kept: motions by the parameters of the channels that change them, forces of the law by its
    parameters, effects, rig and motion. Results do not depend on what is kept, nor on the number of threads.

    Args:
        experiments: all tests of the campaign.
        gamma: temperature law of the law; None: it has none.
        lasting: whether extremes of one test soften the law in the next.
        threads: at most so many.
        length: of a deformation in which the law changes, m.
        ordered: whether the order of the tests is known; otherwise each of them has a fresh specimen.
        parts: into which each step is cut beyond what a fit needs.
    """

    def __init__(
        self,
        law: Law,
        experiments: Sequence[Experiment],
        gamma: GammaT | None = None,
        lasting: bool = False,
        threads: int = 1,
        length: float = 1e-3,
        ordered: bool = True,
        parts: int = 1,
    ) -> None:
        self._law, self._experiments, self._gamma, self._lasting = law, tuple(experiments), gamma, lasting
        self._threads, self._length, self._ordered, self._parts = threads, length, ordered, parts
        self._motions: Kept[Motion] = Kept(_MOTIONS)
        self._forces: Kept[np.ndarray | PredictionError] = Kept(_FORCES)

    @property
    def depends_on_temperature(self) -> bool:
        """Whether the law without effects has other parameters at another temperature."""
        return self._gamma is not None

    def predict(
        self, sets: Sequence[tuple[Mapping[str, float], Effects]], wanted: Sequence[int], rough: bool = False
    ) -> list[list[np.ndarray] | PredictionError]:
        """Return the recorded force (n_i,) N of tests for each set of parameters, or why there is none.

        Args:
            sets: the law's parameters by name, SI, and effects.
            wanted: indices of tests, ascending.
            rough: whether steps are as long as a fit needs, not finer: for changes between sets.
        """
        finer = _ROUGH if rough else 1.0
        asked = [self._of_set(values, effects, wanted, finer) for values, effects in sets]
        known: dict[Hashable, np.ndarray | PredictionError] = {}
        missing: dict[Hashable, list[_Asked]] = {}
        for own in asked:
            for run in [] if isinstance(own, PredictionError) else _runs(own):
                kept = [self._forces.get(one.key) for one in run]
                if any(force is None for force in kept):
                    missing[run[-1].key] = run
                else:
                    known |= {one.key: force for one, force in zip(run, kept, strict=True) if force is not None}
        with np.errstate(all="ignore"):  # a search may ask for anything; a force that is not finite is refused
            found = forces(
                [tuple((one.test, one.motion) for one in run) for run in missing.values()], self._threads, self._length
            )
            for run, of_tests in zip(missing.values(), found, strict=True):
                for i, one in enumerate(run):
                    known[one.key] = of_tests if isinstance(of_tests, PredictionError) else of_tests[i]
                    self._forces.put(one.key, known[one.key])
            return [
                own if isinstance(own, PredictionError) else self._recorded(own, effects, wanted, known)
                for (_, effects), own in zip(sets, asked, strict=True)
            ]

    def _of_set(
        self, values: Mapping[str, float], effects: Effects, wanted: Sequence[int], finer: float
    ) -> list[_Asked] | PredictionError:
        """Return what is asked of the law in each test up to the last one wanted, or why nothing can be."""
        try:
            return self._asked(values, effects, wanted, finer)
        except PredictionError as error:
            return error
        except (InputError, CoreError, OverflowError, ZeroDivisionError) as error:
            return PredictionError(str(error))

    def _asked(
        self, values: Mapping[str, float], effects: Effects, wanted: Sequence[int], finer: float
    ) -> list[_Asked]:
        refined = finer * max((of.form.refined for of, _ in effects), default=REFINED)
        core_effects = _mechanisms(effects, CoreEffect)
        rests = _mechanisms(effects, Rest)
        lasting = self._lasting or bool(_mechanisms(effects, LastingExtremes))
        rest = min((p[mechanism.duration] for mechanism, p in rests), default=LONG)
        rigs = [mechanism.values(p) for mechanism, p in _mechanisms(effects, Rig)]
        rig = RigValues.together(rigs) if rigs else None
        # behind a rig the core alone knows how far the specimen went
        keeps = lasting and rig is not None
        carries = keeps or (self._ordered and (bool(rests) or any(mechanism.carries for mechanism, _ in core_effects)))
        changes, thermometers = _mechanisms(effects, LawParameters), bool(_mechanisms(effects, Thermometer))
        at_temperature: dict[float, tuple[float, ...]] = {}
        prior, found = NONE, []
        before: tuple[Hashable, ...] = ()
        first = prior, before  # extremes and tests before the record of which a test is a part
        for i in range(wanted[-1] + 1) if carries or lasting else wanted:
            test = self._experiments[i]
            parts = test.parts(refined) * (self._parts if finer >= 1.0 else 1)
            with np.errstate(all="ignore"):
                actuator, motion, key = self._moved(i, parts, effects)
                moved, key = self._with_way(i, motion, key, refined, effects)
            if not test.continued:
                first = prior, before
            prior, before = first
            if thermometers:
                wrong = sum(p[mechanism.error] for mechanism, p in _mechanisms(effects, Thermometer, test))
                test = replace(test, temperature=test.temperature - wrong) if wrong else test
            if changes or test.temperature not in at_temperature:
                at_temperature[test.temperature] = self._law_values(values, test, changes)
            # what the force asked for was asked of a fresh specimen: where extremes last, it is what earlier tests did
            own_extremes = (
                prior if lasting and i > 0 and test.prior_extremes_unknown else widest(prior, test.prior_extremes)
            )
            law_test = LawTest(
                self._law.name,
                at_temperature[test.temperature],
                tuple(mechanism.in_test(p, test) for mechanism, p in core_effects),
                rig,
                own_extremes,
                rest,
                keeps,
            )
            own = (i, parts, key, law_test)
            before = (*before, own) if carries else (own,)
            if lasting and not keeps:
                prior = widest(own_extremes, moved.extremes if test.continued else motion.extremes)
            if carries or i in wanted:
                found.append(_Asked(i, before, law_test, moved, actuator, parts))
        return found

    def _moved(self, i: int, parts: int, effects: Effects) -> tuple[Motion, Motion, Hashable]:
        """Return the motions of the actuator and of the specimen in a test, and the key of the latter."""
        test = self._experiments[i]
        motion = test.finer(parts)
        key: tuple[Hashable, ...] = (i, parts)
        actuator = motion
        for of in ("actuator", "specimen"):
            for mechanism, p in _mechanisms(effects, MotionChannel, test):
                if mechanism.of == of:
                    key = (*key, mechanism, tuple(p.values()))
                    motion = self._motions.of(key, partial(mechanism.change, p, test, motion))
            actuator = motion if of == "actuator" else actuator
        return actuator, motion, key

    def _with_way(
        self, i: int, motion: Motion, key: Hashable, refined: float, effects: Effects
    ) -> tuple[Motion, Hashable]:
        """Return the motion of the specimen in a test after what it did before, as far as that is known or tried."""
        test = self._experiments[i]
        if test.continued:
            earlier = self._experiments[i - 1]
            _, before, own = self._moved(i - 1, earlier.parts(refined), effects)
            before, own = self._with_way(i - 1, before, own, refined, effects)
            key = (own, key)
            return self._motions.of(key, partial(motion.joined, before)), key
        if not test.way:
            return motion, key
        key = (key, test.way)
        return self._motions.of(key, partial(motion.after, test.way)), key

    def _law_values(
        self, values: Mapping[str, float], test: Experiment, changes: Sequence[tuple[LawParameters, Values]]
    ) -> tuple[float, ...]:
        """Return the parameters of the law in a test, in the order of the core."""
        own = dict(values)
        for mechanism, p in changes:
            own = mechanism.change(p, test, self._law, own)
        if self._gamma is None or any(mechanism.in_place_of_gamma for mechanism, _ in changes):
            return tuple(self._law.complete(own).values())
        return tuple(at(self._law, own, test.temperature, self._gamma)[0].values())

    def _recorded(
        self,
        asked: Sequence[_Asked],
        effects: Effects,
        wanted: Sequence[int],
        known: Mapping[Hashable, np.ndarray | PredictionError],
    ) -> list[np.ndarray] | PredictionError:
        """Return what the load cell records (n_i,) N, of the forces of the law."""
        found = []
        for one in asked:
            force, test = known[one.key], self._experiments[one.index]
            if isinstance(force, PredictionError):
                return force
            if one.index not in wanted:
                continue
            try:
                for of in ("carriage", "channel"):
                    for mechanism, p in _mechanisms(effects, ForceChannel, test):
                        if mechanism.of == of:
                            force = mechanism.change(p, test, one.actuator, force)
            except (OverflowError, ZeroDivisionError) as error:
                return PredictionError(str(error))
            if not np.all(np.isfinite(force)):
                return PredictionError("the force is not finite")
            found.append(force[:: one.parts])
        return found


def _runs(asked: Sequence[_Asked]) -> list[list[_Asked]]:
    """Return tests that go on from each other together, and all others alone."""
    by_key = {one.key: one for one in asked}
    gone_on = {key[:-1] for key in by_key}
    return [[by_key[key[: k + 1]] for k in range(len(key))] for key in by_key if key not in gone_on]


def _mechanisms(effects: Effects, kind: type[Any], test: Experiment | None = None) -> list[tuple[Any, Values]]:
    """Return the mechanisms of a kind, in one test or in any, with the values of their forms."""
    acting = [(of.form, p) for of, p in effects if test is None or of.form.acts_in(test)]
    return [(mechanism, p) for form, p in acting for mechanism in form.mechanisms if isinstance(mechanism, kind)]
