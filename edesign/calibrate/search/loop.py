"""The loop: find what a model lacks, add it; stop when noise is left, or when nothing known explains what is left."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeVar

import numpy as np

from edesign.calibrate.allowance import Allowance, OutOfTime, taken
from edesign.calibrate.evidence import Judged, compare, simplest
from edesign.calibrate.fit import Model, fit, with_differences
from edesign.calibrate.problem import Candidate, PredictionError, Problem
from edesign.calibrate.result import Ending
from edesign.calibrate.search.alternatives import Alternatives
from edesign.calibrate.search.beside_declared import BesideDeclared
from edesign.calibrate.search.contest import BEHIND
from edesign.calibrate.search.effect_forms import LIKELY, EffectForms
from edesign.calibrate.search.look_ahead import LookAhead
from edesign.calibrate.search.measurement import Measurement
from edesign.calibrate.search.misses import more_than_misses, nearly_all
from edesign.calibrate.search.rounds import Rounds
from edesign.calibrate.search.second_look import SecondLook
from edesign.calibrate.search.selection import Adopted, Refused, Selection
from edesign.calibrate.search.tenable import Tenable
from edesign.calibrate.search.workbench import (
    FEW,
    HOPELESS,
    LONG,
    Progress,
    Workbench,
    of_left_out,
    refitted,
    worse,
)
from edesign.errors import InputError

T = TypeVar("T")

_MOST = 4  # effects
_ABOUT, _PERHAPS = 1.5, 6.0
"""Times what the refit leaves: an effect beside the declared law that leaves no more does about as much, and perhaps as
much together with another one.
"""
_LITTLE = 20.0  # times noise: what an effect beside the declared law leaves where that law may be right
_TELLING = 0.15  # of the time once more, in which effects are told apart from others
_ALIKE = 0.8  # an effect that removes less than this share of what another removes is no look-alike of it


class Loop:
    """The search for what a model lacks.

    Args:
        problem: tests, model, and effects it may lack.
        noise: (tests,) standard deviation of each test's noise.
        refit: whether the parameters of the model may be fitted.
        workers: processes.
        progress: told what is done.
        seconds: processor time after which it goes on with what it has found.
    """

    def __init__(
        self,
        problem: Problem,
        noise: Sequence[float],
        refit: bool = True,
        workers: int = 2,
        progress: Progress = lambda _: None,
        seconds: float = math.inf,
    ) -> None:
        self.seconds = seconds
        self.telling = _TELLING * seconds
        self.allowance = Allowance(workers=workers)
        self.bench = Workbench(problem, noise, refit, workers, progress)
        self.forms = EffectForms(self.bench)
        self.alternatives = Alternatives(self.bench, self.forms)
        self.declared = BesideDeclared(self.bench, self.forms)
        self.rounds = Rounds(self.bench, self.forms)
        self.ahead = LookAhead(self.bench)
        self.second = SecondLook(self.bench, self.forms, self.rounds)
        self.measurement = Measurement(self.bench)
        self.tenable = Tenable(self.bench, self.forms)
        self.standing: Judged | None = None  # the best model with effects so far
        self.ending: Ending = "complete"

    def run(self, refitted_about: np.ndarray | None = None) -> Selection:
        """Find the effects. A Ctrl-C ends the search with those found so far, as the end of its time does; a second one
        leaves it.

        Args:
            refitted_about: (p,) coordinates from which the refit begins; None: as declared.

        Raises:
            KeyboardInterrupt: there are none so far, or it was the second one.
            InputError: the model as declared has no prediction of the tests.
        """
        bench = self.bench
        held = Model(bench.problem, bench.noise, (), True, workers=bench.workers, allowance=self.allowance)
        try:
            declared = Judged(fit(held, held.coordinates()))
        except PredictionError as error:
            raise InputError(f"the declared model cannot predict the tests: {error}") from error
        refit = declared
        if bench.may_refit:
            bench.tell("refitting the declared law")
            free = replace(held, held=False)
            begin = free.coordinates() if refitted_about is None else refitted_about
            refit = refitted(Judged(fit(free, begin, LONG)))
        if declared.at_floor:
            return Selection(declared, refit, declared, ())
        rival = refit if compare(refit, declared).beyond_chance else declared
        self.allowance.renew(self.seconds)
        try:
            final, near = self._search(declared, refit, rival)
        except KeyboardInterrupt:
            if (so_far := self._so_far(rival)) is rival:
                raise
            self._interrupted()
            final, near = so_far, ()
        except OutOfTime:
            self._out_of_time()
            final, near = self._so_far(rival), ()
        self.allowance.renew()
        final, hypotheses = self.tenable.part(self.forms.placed(final), rival)
        found = {*final.labels, *(one.adopted.candidate.label for one in hypotheses)}
        refused = tuple(item for item in near if item[0].label not in found)
        adopted = self._explain(final, refit)
        hypotheses = (*hypotheses, *self._unless_stopped(partial(self.tenable.between_tests, final)))
        coverage = bench.coverage(final)
        return Selection(declared, refit, final, adopted, refused, self.ending, hypotheses, coverage)

    def _interrupted(self) -> None:
        self.ending = "interrupted"
        self.bench.tell("interrupted: going on with the effects found so far; interrupt again to leave them")

    def _out_of_time(self) -> None:
        self.ending = "out_of_time"
        self.bench.tell("out of time: going on with the effects found so far")

    def _so_far(self, rival: Judged) -> Judged:
        """The best model with effects so far, of a round that was not finished too; the rival: there is none."""
        self.allowance.renew()
        best = self.standing or self.measurement.found or rival
        tried = [*self.bench.known.values(), *(one for models in self.bench.rivals.values() for one in models)]
        if self.forms.finest is not None:
            tried.append(self.bench.in_doubt(self.forms.finest))
        return simplest([judged for judged in tried if compare(judged, best).adopts] or [best])

    def _search(self, declared: Judged, refit: Judged, rival: Judged) -> tuple[Judged, Refused]:
        """The final model, and what came near it in the last round; `rival` is the model to beat."""
        if not refit.at_floor:
            self.measurement.look(declared, refit, rival)
        held = self.declared.one(declared) if self.bench.may_refit else []
        if refit.at_floor:
            # what does as much with the law as declared
            fair = [judged for judged in held if compare(judged, declared).adopts and not worse(judged, refit)]
            return simplest([refit, *fair]), ()
        self.bench.left = rival.fitted.residuals
        current, refused, beside = self._first(refit, rival, held)
        if current is None:
            return rival, refused
        been: set[frozenset[str]] = set()  # what was added may have been needless in the end: not again
        while True:
            self.standing = current
            if current.last_is_new:
                current = self.forms.reformed(self.alternatives.reconsider(self._last_alone(current)))
            current = self.forms.finer(refitted(self.bench.freed(self._prune(self.forms.plainer(current)))))
            current = self.bench.freed(current)  # in another form it may be the law that is off
            self.standing = current
            self.bench.known.clear()  # of another belief in the declared parameters: not asked for again
            labels = current.labels
            if current.at_floor or len(labels) >= _MOST or labels in been:
                break
            been.add(labels)
            ahead, found = self.ahead.two(current), None
            if ahead is not None and ahead.at_floor:
                found = ahead
            elif len(labels) == FEW:
                found = self.second.look(current)  # a third one is seldom there
            if found is None and beside is not None:
                freed = self.bench.freed(beside)
                found = None if freed.at_floor else self.declared.two(beside, current, freed)
                beside = None
            if found is None:
                found, refused = self.rounds.one_more(current, current)
                if ahead is not None:
                    found = ahead if found is None else simplest([found, ahead])
            if found is None:
                found = self.rounds.in_pairs(current)
            if found is None and len(labels) < FEW:
                found = self.second.look(current)
            if found is None:
                break
            current = found
        final = self.forms.plainer(self._prune(self.bench.held_again(current)))
        final = self.bench.freed(self.alternatives.settled(self.alternatives.against_others(final)))
        return self.declared.instead_of_refit(final), refused

    def _first(
        self, refit: Judged, rival: Judged, held: Sequence[Judged]
    ) -> tuple[Judged | None, Refused, Judged | None]:
        """The first effect, or the first two, with what came near; and an effect beside the law as declared that may do
        as much as the law fitted again together with another one, if that has not been tried.

        Args:
            refit: the law fitted again.
            rival: the model to beat.
            held: models with one effect beside the law as declared.
        """
        best = min(held, key=of_left_out, default=None)
        if best is None or best.fitted.chi2 > _ABOUT * refit.fitted.chi2:
            perhaps = best is not None and best.fitted.chi2 <= _PERHAPS * refit.fitted.chi2
            return *self.rounds.one_more(refit, rival, held), best if perhaps else None
        held = [*held, *self.forms.other_forms(best, best.fitted.model.effects[0])]
        best, freed = self._freed_best(held)
        early = None
        if not freed.at_floor:
            pair = self.ahead.beside_declared(best, held, freed)
            if pair is not None:
                return pair, (), None
            if not freed.fitted.model.held:  # the law is not as declared: another effect may be the one
                early = one, refused = self.rounds.one_more(refit, rival, held)
                if one is not None and BEHIND * one.fitted.chi2 <= freed.fitted.chi2:
                    return one, refused, None
        alone = self.forms.finer(freed)
        if alone.at_floor:
            if alone.fitted.model.held and compare(alone, rival).adopts:
                return simplest([alone, *held]), (), None  # nothing is left for others
            if best.fitted.reduced <= _LITTLE:  # a second effect for which the law was fitted again, say
                two = self.declared.two(best, refit, freed)
                if two is not None and two.at_floor and two.fitted.model.held:
                    return two, (), None
            return *self._beside_refit(refit, rival, [*held, alone], early), None
        two = self.declared.two(best, refit, freed)
        if two is not None and not more_than_misses(alone, self.bench.left):
            two = self.bench.freed(two)
            two = two if alone.fitted.chi2 - two.fitted.chi2 >= nearly_all(alone) else None
        if two is not None and two.at_floor:
            return two, (), None
        if two is None or not two.fitted.model.held:  # beside a law fitted again all effects are to be tried
            return *self._beside_refit(refit, rival, [*held, alone], early), None
        one, refused = self._beside_refit(refit, rival, held, early)  # or one beside the law fitted again
        return two if one is None else simplest([two, one]), refused, None

    def _beside_refit(
        self, refit: Judged, rival: Judged, further: Sequence[Judged], early: tuple[Judged | None, Refused] | None
    ) -> tuple[Judged | None, Refused]:
        """One effect more beside the law fitted again, or what was found so before, and models fitted since."""
        if early is None:
            return self.rounds.one_more(refit, rival, further)
        found, refused = early
        models = [judged for judged in (found, *further) if judged is not None and compare(judged, rival).adopts]
        return simplest(models) if models else None, refused

    def _freed_best(self, held: Sequence[Judged]) -> tuple[Judged, Judged]:
        """The best model with one effect beside the law as declared, and that with the law fitted; another one that
        came near, if it leaves noise alone then and the best does not: as declared, the law may favour what is wrong.
        """
        ordered = sorted(held, key=of_left_out)
        best: dict[str, Judged] = {}
        for judged in ordered:
            best.setdefault(judged.fitted.model.effects[0].name, judged)
        first, *others = best.values()
        freed = self.bench.freed(first)
        if freed.at_floor:
            return first, freed
        near = [judged for judged in others if judged.fitted.chi2 <= BEHIND * first.fitted.chi2][:LIKELY]
        pairs = zip(near, self.bench.freed_all(near), strict=True)
        return next(((one, free) for one, free in pairs if free.at_floor), (first, freed))

    def _last_alone(self, current: Judged) -> Judged:
        """The last effect beside the law fitted again, if that leaves noise alone: the first one has made up for a law
        that is not as declared.
        """
        model = current.fitted.model
        if not model.held or current.at_floor or len(model.effects) < 2:
            return current
        alone = self.bench.freed(self.bench.without(current, model.effects[0]))
        return alone if alone.at_floor else current

    def _unless_stopped(self, find: Callable[[], list[T]]) -> list[T]:
        """What is found in the time in which effects are told apart; nothing where that is over."""
        if self.ending == "interrupted":
            return []
        self.allowance.renew(self.telling)
        before = taken()
        try:
            return find()
        except KeyboardInterrupt:
            self._interrupted()
        except OutOfTime:
            self._out_of_time()
        finally:
            self.telling = max(self.telling - (taken() - before), 0.0)
            self.allowance.renew()
        return []

    def _prune(self, current: Judged) -> Judged:
        """Without the effects that others make needless, or the law fitted again; another one in the form that suits
        best then, as an effect found before may be a part of what another form does.
        """
        if len(current.fitted.model.effects) < 2:
            return current
        first = current
        smaller_than_first = {effect.label: without for effect, without in self.bench.each_without(first)}
        for label in [effect.label for effect in current.fitted.model.effects]:
            effect = next((e for e in current.fitted.model.effects if e.label == label), None)
            if effect is None or len(current.fitted.model.effects) < 2:
                continue
            without = smaller_than_first[label] if current is first else self.bench.without(current, effect)
            few, most = len(current.fitted.model.effects) <= FEW, HOPELESS * current.fitted.chi2
            forms = self.forms.other_forms(without, without.fitted.model.effects[-1], most) if few else []
            smaller = [without, self.bench.freed(without), *forms]
            enough = [judged for judged in smaller if not compare(current, judged).needed]
            if enough:
                known = Judged(with_differences(current.fitted))
                enough = [judged for judged in enough if not compare(known, judged).needed]
            if enough:
                current = simplest(enough)
        return current

    def _explain(self, final: Judged, refit: Judged) -> tuple[Adopted, ...]:
        """The evidence for each effect of the final model, and what cannot be told from it."""
        found: list[Adopted] = []
        alone = self.bench.each_without(final)
        for (effect, values), (_, without) in zip(final.fitted.parts, alone, strict=True):
            self.bench.tell(f"telling {effect.name} apart from others")
            evidence = compare(final, without)
            alike: dict[str, Judged] = {}
            others = self._unless_stopped(partial(self.alternatives.others, final, effect))
            for other in sorted(others, key=of_left_out):
                instead = _replacement(other, final)
                if instead is None or instead.name == effect.name:
                    continue
                near = compare(other, without).share > _ALIKE * evidence.share
                if near and not compare(final, other).beyond_chance:
                    alike.setdefault(instead.name, other)
            if final.fitted.model.held and len(final.fitted.parts) == 1 and not worse(refit, final):
                alike["refit"] = refit
            found.append(Adopted(effect, values, evidence, without, alike))
        return tuple(found)


def _replacement(judged: Judged, of: Judged) -> Candidate | None:
    """The effect that another model has not; None: it has them all."""
    return next((effect for effect in judged.fitted.model.effects if effect.label not in of.labels), None)
