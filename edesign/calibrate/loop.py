"""The loop: find what a model lacks, add it; stop when noise is left, or when nothing known explains what is left."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.contest import BEHIND, FITTED, both, fit_best, judged_of, likely_forms, shortlist
from edesign.calibrate.evidence import CLEAR, SHARE, Judged, compare, simplest
from edesign.calibrate.fit import Fitted, Model, fit
from edesign.calibrate.forms import begin_alike, begun_at, begun_from, may_join
from edesign.calibrate.outcome import errors_of, predict
from edesign.calibrate.pairs import likely_pairs
from edesign.calibrate.problem import Candidate, Part, PredictionError, Problem
from edesign.calibrate.screening import Signature, ordered, screen, screen_again
from edesign.calibrate.selection import Adopted, Refused, Selection
from edesign.calibrate.side_by_side import side_by_side
from edesign.errors import InputError

_SMALL, _MISSED = 0.01, 5e-4
"""Shares of all that the refitted law leaves over noise, and of what the effects found before do to the force: below
the larger stands what the equations of these effects miss.
"""
_NEARLY_ALL = 0.85  # of what is left over noise
_PAIRS = 4  # pairs fitted in a round
_FORMS, _FORMS_HELD, _FORMS_SLOW = 5, 10, 3
"""Forms of an effect that are compared once it is a likely one: usually, with the law held, and beside slow or several
effects.
"""
_LIKELY = 2  # effects of which forms are compared, or models with which the law is fitted again
_ELSEWHERE = 8  # forms fitted from the law as declared
_RIVALS = 5  # forms that are tried in the place of one
_SECOND = 3  # models in which other effects are tried again in finer forms
_WELL_ABOVE = 2.0  # times noise: a model that leaves less is not held against others begun elsewhere
_BEGINNINGS = 2  # effects to which others are added, of those that were not the best alone
_MOST = 4  # effects
_FEW = 2  # effects up to which pairs are sought, and each is held against others and in other forms
_FAR = 0.5  # coordinates: factors of e
_ABOUT, _PERHAPS = 1.5, 6.0
"""Times what the refit leaves: an effect beside the declared law that leaves no more does about as much, and perhaps as
much together with another one.
"""
_FAR_BEHIND, _HOPELESS = 60.0, 20.0
"""Times what a model leaves, beyond which others after a rough fit are no rivals, and smaller ones never suffice."""
_ALIKE = 0.8  # an effect that removes less than this share of what another removes is no look-alike of it
_LONG = 40  # steps of a search along the valleys between a shape and the rest, or of a law far from its tests

Progress = Callable[[str], None]
_Key = tuple[frozenset[str], bool, float]


class Loop:
    """The search for what a model lacks.

    Args:
        problem: tests, model, and effects it may lack.
        noise: (tests,) standard deviation of each test's noise.
        refit: whether the parameters of the model may be fitted.
        workers: processes.
        progress: told what is done.
    """

    def __init__(
        self,
        problem: Problem,
        noise: Sequence[float],
        refit: bool = True,
        workers: int = 2,
        progress: Progress = lambda _: None,
    ) -> None:
        self.problem = problem
        self.noise = tuple(noise)
        self.may_refit = refit
        self.workers = workers
        self.tell = progress
        self.standing: Judged | None = None  # the best model with effects so far
        self.interrupted = False
        self.left: tuple[np.ndarray, ...] = ()  # residuals of the model without effects that is the rival of all
        self.beside_declared: list[Signature] = []  # effects beside the law as declared
        self.rivals: dict[tuple[frozenset[str], bool], list[Judged]] = {}
        """Models with one effect more, by the effects they share, and whether these stand beside the declared law."""
        self.known: dict[_Key, Judged] = {}  # since the model was last fitted again
        self.begun: set[str] = set()  # effects to which others were added
        self.beginnings = _BEGINNINGS
        self.compared: set[tuple[str, _Key]] = set()  # effects whose forms were, beside which model

    def run(self) -> Selection:
        """Find the effects. A Ctrl-C ends the search with those found so far, a second one leaves it.

        Raises:
            KeyboardInterrupt: there are none so far, or it was the second one.
            InputError: the model as declared has no prediction of the tests.
        """
        held = Model(self.problem, self.noise, held=True, workers=self.workers)
        try:
            declared = Judged(fit(held, held.coordinates()))
        except PredictionError as error:
            raise InputError(f"the declared model cannot predict the tests: {error}") from error
        refit = declared
        if self.may_refit:
            self.tell("refitting the declared law")
            free = replace(held, held=False)
            refit = _refitted(Judged(fit(free, free.coordinates(), _LONG)))
        if declared.at_floor:
            return Selection(declared, refit, declared, ())
        try:
            final, near = self._search(declared, refit)
        except KeyboardInterrupt:
            if self.standing is None:
                raise
            self._stop()
            final, near = self.standing, ()
        final = self._placed(final)
        adopted_labels = _labels(final.fitted.model.effects)
        refused = tuple(item for item in near if item[0].label not in adopted_labels)
        adopted = self._explain(final, refit)
        return Selection(declared, refit, final, adopted, refused, self.interrupted)

    def _stop(self) -> None:
        self.interrupted = True
        self.tell("interrupted: going on with the effects found so far; interrupt again to leave them")

    def _search(self, declared: Judged, refit: Judged) -> tuple[Judged, Refused]:
        """The final model, and what came near it in the last round."""
        rival = refit if compare(refit, declared).beyond_chance else declared
        held = self._beside_declared(declared) if self.may_refit else []
        if refit.at_floor:
            return simplest([refit, *(judged for judged in held if compare(judged, declared).adopts)]), ()
        self.left = rival.fitted.residuals
        refused: Refused = ()
        current = None
        best = min(held, key=_of_left_out, default=None)
        beside = best is not None and best.fitted.chi2 <= _PERHAPS * refit.fitted.chi2  # the declared law, two effects
        if best is not None and best.fitted.chi2 <= _ABOUT * refit.fitted.chi2:
            held, beside = [*held, *self._other_forms(best, best.fitted.model.effects[0])], False
            best = min(held, key=_of_left_out)
            freed = self._freed(best)
            alone = self._finer(freed)
            if alone.fitted.model.held and alone.at_floor and compare(alone, rival).adopts:
                current = simplest([alone, *held])  # nothing is left for others
            elif alone.at_floor:
                held = [*held, alone]
            else:
                current = self._two_beside_declared(held, refit, freed)
                if current is not None and not self._more_than_misses(alone):
                    current = self._freed(current)
                    removed = alone.fitted.chi2 - current.fitted.chi2
                    current = current if removed >= self._nearly_all(alone) else None
                if current is None:
                    held = [*held, alone]
                elif not current.at_floor:  # or one beside the law fitted again
                    one, refused = self._round(refit, rival, held)
                    current = current if one is None else simplest([current, one])
        if current is None:
            current, refused = self._round(refit, rival, held)
        if current is None:
            return rival, refused
        been: set[frozenset[str]] = set()  # what was added may have been needless in the end: not again
        while True:
            self.standing = current
            if _last_is_new(current):
                current = self._reformed(self._reconsider(self._last_alone(current)))
            current = self._finer(_refitted(self._freed(self._prune(current))))
            self.standing = current
            self.known.clear()  # of another belief in the declared parameters: not asked for again
            labels = _labels(current.fitted.model.effects)
            if current.at_floor or len(labels) >= _MOST or labels in been:
                break
            been.add(labels)
            found = self._second_look(current) if len(labels) == _FEW else None  # a third one is seldom there
            if found is None and beside:
                freed, beside = self._freed(min(held, key=_of_left_out)), False
                found = None if freed.at_floor else self._two_beside_declared(held, current, freed)
            if found is None:
                found, refused = self._round(current, current)
            if found is None:
                found = self._in_pairs(current)
            if found is None and len(labels) < _FEW:
                found = self._second_look(current)
            if found is None:
                break
            current = found
        return self._against_others(self._prune(self._held_again(current))), refused

    def _placed(self, final: Judged) -> Judged:
        """Each effect in the form that does least wrong to tests that are not fitted to, of those that do the same to
        the fitted ones, as a gain does that changed in between: what it does to a test is then that test's own.
        """
        for i, part in enumerate(final.fitted.parts):
            models = [final]
            for other in self.problem.elsewhere(part):
                effects = (*final.fitted.model.effects[:i], other, *final.fitted.model.effects[i + 1 :])
                model = replace(final.fitted.model, effects=effects)
                models.append(Judged(fit(model, final.fitted.x, most_steps=0)))
            if len(models) > 1:
                final = min(models, key=lambda one: errors_of(self.problem, predict(self.problem, one)).validate)
        return final

    def _against_others(self, current: Judged) -> Judged:
        """A single effect against others beside the law fitted again, where none were: it was found beside others."""
        effects, held = current.fitted.model.effects, current.fitted.model.held
        if held or len(effects) > 1 or (_labels(()), False) in self.rivals:
            return current
        others = self._alternatives(current, effects[0])
        self.rivals[_labels(()), False] = [*others, current]
        return simplest([current, *others])

    def _in_pairs(self, current: Judged) -> Judged | None:
        """A model in which two effects stand in the place of one that was a compromise between them; None: there is
        none, the search takes too long, or there are several effects.
        """
        effects = current.fitted.model.effects
        if len(effects) > 1 or effects[0].slow or not self._more_than_misses(current):
            return None
        without = self._without(current, effects[0])
        self.tell(f"two effects in the place of {effects[0].name}")
        signatures = screen(without.fitted, self._candidates(without))
        pair = self._pair(without, shortlist(signatures), signatures)
        if pair is None or not self._matters(pair, current):
            return None
        evidence = compare(pair, current)
        return pair if evidence.beyond_chance and evidence.share >= CLEAR else None

    def _second_look(self, current: Judged) -> Judged | None:
        """A model that came near it, with other effects or one more, and is better in finer forms or with the law
        fitted again; None: there is none.
        """
        labels = _labels(current.fitted.model.effects)
        if current.fitted.reduced <= _WELL_ABOVE:
            return None
        beside = [frozenset[str](), *(labels - {label} for label in sorted(labels))]
        best: dict[tuple[str, ...], Judged] = {}
        for others in beside if len(labels) >= _FEW else [*beside, labels]:
            for judged in [*self.rivals.get((others, False), ()), *self.rivals.get((others, True), ())]:
                names = _names(judged)
                if names != _names(current):
                    best[names] = min(best.get(names, judged), judged, key=lambda one: one.fitted.chi2)
        near = sorted(best.values(), key=lambda judged: judged.fitted.chi2)[:_SECOND]
        found = []
        for judged in near:
            if judged.fitted.chi2 <= BEHIND * current.fitted.chi2:
                begun = self._certain(self._freed_if_half(judged))
                found.append(self._in_doubt(self._as_fine_as_needed(begun, -1)))
        best_of_all = simplest([current, *found])
        return self._begun_with_another(current) if best_of_all is current else best_of_all

    def _begun_with_another(self, current: Judged) -> Judged | None:
        """A model that is better, of two effects of which the first did much alone but was not the best then; None:
        there is none.
        """
        alone: dict[str, Judged] = {}
        for judged in [*self.rivals.get((frozenset(), False), ()), *self.rivals.get((frozenset(), True), ())]:
            name = judged.fitted.model.effects[0].name
            alone[name] = min(alone.get(name, judged), judged, key=lambda one: one.fitted.chi2)
        self.begun.update(_names(current))
        others = [judged for name, judged in alone.items() if name not in self.begun]
        for judged in sorted(others, key=lambda one: one.fitted.chi2)[: self.beginnings]:
            first = judged.fitted.model.effects[0].name
            self.begun.add(first)
            self.beginnings -= 1
            self.tell(f"two effects, {first} one of them")
            found, _ = self._round(judged, judged)
            if found is None or found.fitted.chi2 > BEHIND * current.fitted.chi2:
                continue
            found = self._finer(self._reformed(found))
            if simplest([current, found]) is found:
                self.beginnings = 0
                return found
        return None

    def _round(self, current: Judged, rival: Judged, further: Sequence[Judged] = ()) -> tuple[Judged | None, Refused]:
        """The best model with one effect more, or two, and what came near; None: chance may have made it.

        Args:
            current: the model to which effects are added.
            rival: the model to beat.
            further: models with one effect more that were fitted before.
        """
        known = current.fitted.model.effects
        number = len(known) + 1
        more = not known or self._more_than_misses(current)
        names = {effect.name for effect in known}
        # finer forms of these were tried: a second form has nothing to add
        shaped = {part[0].name for part in current.fitted.parts if part[0].finer or self.problem.finer(part)}
        nearly_all = self._nearly_all(current)
        others = more or nearly_all < math.inf
        pool = [
            c
            for c in self._candidates(current)
            if may_join(c, known) and (others or c.name in names) and c.name not in shaped
        ]
        self.tell(f"effect {number}: screening {len(pool)} forms of effects")
        signatures = screen(current.fitted, pool)
        short = shortlist([s for s in signatures if more or s.candidate.name in names or s.gain >= nearly_all])
        if short:
            self.tell(f"effect {number}: fitting {', '.join(dict.fromkeys(s.candidate.name for s in short))}")
        elsewhere = []
        unfitted = current.fitted.model.coordinates()
        if not known and unfitted.size and float(np.max(np.abs(current.fitted.x - unfitted))) > _FAR:
            # the refit has gone far to make up for what is missing, and searches from there may not find back
            elsewhere = shortlist(screen_again(self._unfitted(current), self.beside_declared))[:_ELSEWHERE]
        tried = [*self._fit_best([*short, *elsewhere]), *further]
        tried = [*dict.fromkeys((*tried, *self._other_forms_of_likely(tried)))]  # some forms are likely twice
        tried += self._simpler_to_the_end(tried)
        self.rivals[_labels(known), current.fitted.model.held] = tried
        if not tried:
            return None, ()
        near = sorted(tried, key=_of_left_out)[:3]
        refused = tuple((judged.fitted.model.effects[-1], compare(judged, rival)) for judged in near)
        best = simplest([judged for judged in tried if compare(judged, rival).adopts] or tried)
        evidence = compare(best, rival)
        if more and not (evidence.adopts and evidence.share >= CLEAR) and len(known) < _FEW:
            pair = self._pair(current, short, signatures)
            if pair is not None:
                together = compare(pair, rival)
                alone = max(evidence.share, 0.0)
                needed = together.share - alone > SHARE * (1.0 - alone) and together.share > 2.0 * SHARE
                if together.beyond_chance and needed and self._matters(pair, rival):
                    return pair, refused
        if evidence.adopts and self._matters(best, rival):
            return best, refused
        return None, refused

    def _more_than_misses(self, current: Judged) -> bool:
        """Whether more is left than what the equations of the known effects may miss."""
        return current.fitted.chi2 - current.fitted.samples >= self._may_miss(current)

    def _may_miss(self, current: Judged) -> float:
        """Sum of squares that the equations of the known effects may miss: what is each test's own, as a tone is, has
        none that others could make up for.
        """
        fitted = current.fitted
        bare = replace(fitted.model, effects=())
        shared = fitted.shared(self.left)
        material = _SMALL * (sum(float(r @ r) for r in shared) - fitted.samples)
        try:
            without = fitted.shared(bare.residuals(fitted.x[: len(bare.base)]))
        except PredictionError:
            return material
        done = sum(float((w - r) @ (w - r)) for w, r in zip(without, fitted.residuals, strict=True))
        return max(material, _MISSED * done)

    def _other_forms_of_likely(self, tried: Sequence[Judged]) -> list[Judged]:
        """Models with further forms of the effects that the best models have last: best on tests left out, or on those
        fitted to, as a wrong form of the right effect may extrapolate badly.
        """
        likely: dict[str, Judged] = {}
        for order in (_of_left_out, lambda j: j.fitted.chi2):
            best: dict[str, Judged] = {}
            for judged in sorted(tried, key=order):
                best.setdefault(judged.fitted.model.effects[-1].name, judged)
            for name in [*best][:_LIKELY]:
                likely.setdefault(name, best[name])
        found: list[Judged] = []
        least = min((judged.fitted.chi2 for judged in tried), default=0.0)
        for judged in likely.values():
            if judged.fitted.chi2 <= BEHIND * least and not judged.at_floor:
                found += self._other_forms(judged, judged.fitted.model.effects[-1])
        return found

    def _simpler_to_the_end(self, tried: Sequence[Judged]) -> list[Judged]:
        """Where the best model leaves noise alone, simpler ones fitted on with as little belief in the declared
        parameters: what is left by the model to which they were added made that more.
        """
        best = min(tried, key=lambda judged: judged.fitted.chi2, default=None)
        if best is None or not best.at_floor:
            return []
        near = [
            judged
            for judged in tried
            if judged.fitted.freedom < best.fitted.freedom
            and judged.fitted.model.misfit > best.fitted.misfit
            and judged.fitted.chi2 <= _HOPELESS * best.fitted.chi2
        ]
        near.sort(key=lambda judged: judged.fitted.chi2)
        misfit = best.fitted.misfit
        return self._fitted([(replace(j.fitted.model, misfit=misfit), j.fitted.x) for j in near[:_RIVALS]])

    def _matters(self, judged: Judged, current: Judged) -> bool:
        """Whether what new effects remove is more than the equations of the known ones may miss, or nearly all that is
        left, as no other effect does with the errors of an equation; further forms of the known ones may do less.
        """
        known = {effect.name for effect in current.fitted.model.effects}
        new = any(effect.name not in known for effect in judged.fitted.model.effects)
        removed = current.fitted.chi2 - judged.fitted.chi2
        return not new or removed >= min(self._may_miss(current), self._nearly_all(current))

    def _nearly_all(self, current: Judged) -> float:
        """Sum of squares that is nearly all that is left; none is where that is less than noise."""
        excess = current.fitted.chi2 - current.fitted.samples
        return _NEARLY_ALL * excess if excess > current.fitted.samples else math.inf

    def _pair(self, current: Judged, tried: Sequence[Signature], all_: Sequence[Signature]) -> Judged | None:
        """The best pair of effects that a linear estimate makes look good together."""
        pool = list({id(s): s for s in (*tried, *all_[:FITTED])}.values())
        pairs = likely_pairs(current.fitted, pool, _PAIRS)
        self.tell("fitting pairs: " + ", ".join(f"{a.candidate.name} + {b.candidate.name}" for a, b in pairs))
        found = self._fit_best([both(*pair) for pair in pairs])
        return min(found, key=_of_left_out, default=None)

    def _last_alone(self, current: Judged) -> Judged:
        """The last effect beside the law fitted again, if that leaves noise alone: the first one has made up for a law
        that is not as declared.
        """
        model = current.fitted.model
        if not model.held or current.at_floor or len(model.effects) < 2:
            return current
        alone = self._freed(self._without(current, model.effects[0]))
        return alone if alone.at_floor else current

    def _reconsider(self, current: Judged) -> Judged:
        """Each effect against what could stand in its place, now that the others are there."""
        effects = current.fitted.model.effects
        if len(effects) > _FEW:
            return current
        for effect in effects[:-1]:
            self.tell(f"reconsidering {effect.name}")
            current = simplest([current, *self._alternatives(current, effect)])
        return current

    def _reformed(self, current: Judged) -> Judged:
        """Each effect in the form that suits best, now that the others are there."""
        effects = current.fitted.model.effects
        for effect in effects if 1 < len(effects) <= _FEW else ():  # forms of a single one have just been compared
            if current.at_floor:
                break
            current = simplest([current, *self._other_forms(current, effect)])
        return current

    def _finer(self, current: Judged) -> Judged:
        """Each effect in a finer form, where more than noise is left and that form is better: with nothing in doubt, as
        what is in doubt may have made up for the coarser one.
        """
        best = first = self._certain(current)
        if first is not current and not best.at_floor and _last_is_new(best):
            best = self._in_other_forms(best)
        for i in range(len(current.fitted.model.effects)):
            best = self._as_fine_as_needed(best, i)
        for other in self._near_forms(current) if _last_is_new(current) else ():
            if not best.at_floor:  # a coarser form behind this one may have finer ones before it
                near = other if current.fitted.model.held else self._freed(other)
                best = simplest([best, self._as_fine_as_needed(self._certain(near), -1)])
        if best is first:
            return current
        return self._in_doubt(best)

    def _certain(self, current: Judged) -> Judged:
        """With nothing in doubt."""
        problem = self.problem.certain
        if problem is self.problem:
            return current
        return Judged(fit(replace(current.fitted.model, problem=problem), current.fitted.x, _LONG))

    def _in_doubt(self, current: Judged) -> Judged:
        """With what is in doubt."""
        if current.fitted.model.problem is self.problem:
            return current
        return Judged(fit(replace(current.fitted.model, problem=self.problem), current.fitted.x))

    def _as_fine_as_needed(self, best: Judged, i: int) -> Judged:
        """With the effect i in finer forms as long as they are better and more than noise is left; not twice in one
        form, as a coarser one that does as well may have it before it again.
        """
        been: set[str] = set()
        while not best.at_floor and (label := best.fitted.model.effects[i].label) not in been:
            been.add(label)
            best = self._in_finer_form(best, i)
        return best

    def _near_forms(self, current: Judged) -> list[Judged]:
        """The other form of the last effect that was nearly as good."""
        *known, last = current.fitted.model.effects
        forms = [
            judged
            for held in (False, True)
            for judged in self.rivals.get((_labels(known), held), [])
            if judged.fitted.model.effects[-1].name == last.name
            and judged.fitted.model.effects[-1].label != last.label
            and judged.fitted.chi2 <= BEHIND * current.fitted.chi2
        ]
        return sorted(forms, key=lambda judged: judged.fitted.chi2)[:1]

    def _in_other_forms(self, current: Judged) -> Judged:
        """The last effect in the form that suits best with nothing in doubt; what was compared in doubt is no
        answer.
        """
        known, compared = self.known, self.compared
        self.known, self.compared = {}, set()
        found = simplest([current, *self._other_forms(current, current.fitted.model.effects[-1])])
        self.known, self.compared = known, compared
        return found

    def _in_finer_form(self, current: Judged, i: int) -> Judged:
        parts = current.fitted.parts
        i %= len(parts)
        self.tell(f"finer forms of {parts[i][0].name}")
        finer = self.problem.finer(parts[i])
        if not finer:
            return current
        best = simplest([current, *self._with_parts(current, i, finer)])
        if best is current:
            return current
        # where the finer form has led, a coarser one may do as well
        known = best.fitted.parts[i]
        coarser = [part for effect, _ in (parts[i], *finer) if (part := begun_at(effect, known)) is not None]
        return simplest([best, *self._with_parts(best, i, coarser)])

    def _with_parts(self, current: Judged, i: int, others: Sequence[Part]) -> list[Judged]:
        """Models with each of some effects in the place of the effect i, fitted from its values."""
        model, parts = current.fitted.model, current.fitted.parts
        begun = []
        for part in others:
            own = [*parts[:i], part, *parts[i + 1 :]]
            other = replace(model, effects=tuple(effect for effect, _ in own))
            begun.append((other, other.coordinates(current.fitted.base, own)))
        return self._fitted(begun)

    def _other_forms(self, current: Judged, effect: Candidate, most: float = math.inf) -> list[Judged]:
        """Models with another form of an effect; which are likely is seen beside the law as the model has it.

        Those that leave more than `most` or far more than the model (chi2) after a rough fit are not fitted on.
        """
        fitted = current.fitted
        smaller = replace(fitted.model, effects=tuple(e for e in fitted.model.effects if e is not effect))
        if (effect.name, _key(smaller)) in self.compared:
            return []
        self.compared.add((effect.name, _key(smaller)))
        self.tell(f"comparing forms of {effect.name}")
        kept = [part for part in fitted.parts if part[0] is not effect]
        without = fit(smaller, smaller.coordinates(fitted.base, kept), most_steps=0)
        here = _labels(fitted.model.effects)
        pool = [c for c in self._candidates(current) if c.name == effect.name and c.label not in here]
        slow = len(smaller.effects) > 1 or any(other.slow for other in smaller.effects)
        number = _FORMS_SLOW if slow else _FORMS_HELD if fitted.model.held else _FORMS
        signatures = self._screened(without, pool)
        wider = [found for s in signatures if (found := begun_from(fitted, effect, s))][:number]
        return self._fit_best([*likely_forms(signatures, number), *wider], min(most, _FAR_BEHIND * fitted.chi2))

    def _alternatives(self, current: Judged, effect: Candidate) -> list[Judged]:
        """Models in which another effect, or another form, stands in the place of one."""
        others = [e for e in current.fitted.model.effects if e is not effect]
        held = current.fitted.model.held
        fitted = self.rivals.get((_labels(others), held), self.rivals.get((_labels(others), False)))
        if fitted is not None:
            return fitted
        if any(other.name == effect.name for other in others):
            return []  # what stands beside another form of the same effect is no rival of it
        without = self._without(current, effect)
        known = [part for part in self._stood_beside(others) if part[0].label != effect.label] if others else []
        if known:
            found = self._fit_all(without, known)
        else:
            pool = [c for c in self._candidates(without) if may_join(c, others) and c.label != effect.label]
            roughly = any(e.slow for e in others)
            likely = shortlist(self._screened(without.fitted, pool, roughly))[:_RIVALS]
            found = self._fit_best(likely, _FAR_BEHIND * current.fitted.chi2)
        self.rivals[_labels(others), held] = found
        return found

    def _alternatives_unless_stopped(self, current: Judged, effect: Candidate) -> list[Judged]:
        if self.interrupted:
            return []
        try:
            return self._alternatives(current, effect)
        except KeyboardInterrupt:
            self._stop()
            return []

    def _stood_beside(self, others: Sequence[Candidate]) -> list[Part]:
        """The best form of each effect, the best first, that was fitted beside other forms of these effects."""
        names = sorted(other.name for other in others)
        tried = [
            judged
            for judged in (model for models in self.rivals.values() for model in models)
            if sorted(effect.name for effect in judged.fitted.model.effects[:-1]) == names
        ]
        best: dict[str, Part] = {}
        for judged in sorted(tried, key=_of_left_out):
            part = judged.fitted.parts[-1]
            if may_join(part[0], others):
                best.setdefault(part[0].name, part)
        return [*best.values()][:_RIVALS]

    def _fit_all(self, current: Judged, parts: Sequence[Part]) -> list[Judged]:
        """Models with each of some effects added, those that can be predicted."""
        model, base, here = current.fitted.model, current.fitted.base, current.fitted.parts
        models = [replace(model, effects=(*model.effects, part[0])) for part in parts]
        starts = [one.coordinates(base, (*here, part)) for one, part in zip(models, parts, strict=True)]
        return self._fitted([*zip(models, starts, strict=True)])

    def _fitted(self, begun: Sequence[tuple[Model, np.ndarray]]) -> list[Judged]:
        """Models fitted from coordinates, those that can be predicted."""
        given = [thing for model, _ in begun for thing in model.given]
        found = side_by_side(lambda one: judged_of(lambda: fit(*one, _LONG)), begun, self.workers, given)
        return [judged for judged in found if judged is not None]

    def _without(self, current: Judged, effect: Candidate) -> Judged:
        model = current.fitted.model
        effects = tuple(e for e in model.effects if e is not effect)
        smaller = replace(model, effects=effects)
        return Judged(fit(smaller, smaller.coordinates(current.fitted.base, current.fitted.parts)))

    def _prune(self, current: Judged) -> Judged:
        """Without the effects that others make needless, or the law fitted again; another one in the form that suits
        best then, as an effect found before may be a part of what another form does.
        """
        for label in [effect.label for effect in current.fitted.model.effects]:
            effect = next((e for e in current.fitted.model.effects if e.label == label), None)
            if effect is None or len(current.fitted.model.effects) < 2:
                continue
            without = self._without(current, effect)
            few, most = len(current.fitted.model.effects) <= _FEW, _HOPELESS * current.fitted.chi2
            forms = self._other_forms(without, without.fitted.model.effects[-1], most) if few else []
            smaller = [without, self._freed(without), *forms]
            enough = [judged for judged in smaller if not compare(current, judged).needed]
            if enough:
                current = simplest(enough)
        return current

    def _beside_declared(self, declared: Judged) -> list[Judged]:
        """Models with one effect beside the law as declared: a gain, say, is all moduli changed alike, one number
        against nine.
        """
        self.tell("screening effects beside the law as declared")
        self.beside_declared = screen(declared.fitted, self._candidates(declared))
        found = self._fit_best(shortlist(self.beside_declared))
        self.rivals[_labels(()), True] = found
        return found

    def _two_beside_declared(self, held: Sequence[Judged], free: Judged, freed: Judged) -> Judged | None:
        """Two effects beside the law as declared, where one does nearly as much as all of the law's parameters fitted
        again: what is beside that refit may be its symptoms. They must beat a model whose law is fitted.

        Args:
            held: models with one effect beside the law as declared.
            free: the best model with the law fitted.
            freed: the best of `held`, with the law fitted.
        """
        best = min(held, key=_of_left_out)
        known = best.fitted.model.effects
        self.tell(f"screening effects beside {known[0].name} and the law as declared")
        pool = [c for c in self._candidates(best) if may_join(c, known)]
        found = self._fit_best(shortlist(screen(best.fitted, pool)))
        rivals = (free, best, freed)
        least = min(rival.fitted.chi2 for rival in rivals)
        if any(judged.fitted.chi2 <= CLEAR * least for judged in found):
            found += self._other_forms_of_likely(found)
        clear = [judged for judged in found if all(compare(judged, rival).clear for rival in rivals)]
        if not clear:  # the declared law may be off
            likely = [self._freed(judged) for judged in sorted(found, key=_of_left_out)[:_LIKELY]]
            clear = [judged for judged in likely if all(compare(judged, rival).clear for rival in rivals)]
        return simplest(clear) if clear else None

    def _freed(self, current: Judged) -> Judged:
        """With the parameters of the law fitted, if that is better by more than chance."""
        model = current.fitted.model
        if not model.held or not self.may_refit:
            return current
        free = replace(model, held=False)
        found = Judged(fit(free, free.coordinates(None, current.fitted.parts)))
        return found if compare(found, current).beyond_chance else current

    def _freed_if_half(self, current: Judged) -> Judged:
        """With the parameters of the law fitted, if that leaves half at most: what else is missing may make it no
        better on tests left out.
        """
        model = current.fitted.model
        if not model.held or not self.may_refit:
            return current
        free = replace(model, held=False)
        found = Judged(fit(free, free.coordinates(None, current.fitted.parts), _LONG))
        return found if found.fitted.chi2 <= 0.5 * current.fitted.chi2 else current

    def _held_again(self, current: Judged) -> Judged:
        """With the law as declared, if that explains the tests as well once the effects are there."""
        model = current.fitted.model
        if model.held or not model.effects or not self.may_refit:
            return current
        held = replace(model, held=True)
        start = held.coordinates(None, current.fitted.parts)
        found = Judged(fit(held, start))
        return current if _worse(found, current) else found

    def _explain(self, final: Judged, refit: Judged) -> tuple[Adopted, ...]:
        """The evidence for each effect of the final model, and what cannot be told from it."""
        found: list[Adopted] = []
        for effect, values in final.fitted.parts:
            self.tell(f"telling {effect.name} apart from others")
            without = self._without(final, effect)
            evidence = compare(final, without)
            alike: dict[str, Judged] = {}
            for other in sorted(self._alternatives_unless_stopped(final, effect), key=_of_left_out):
                if _labels(other.fitted.model.effects) == _labels(final.fitted.model.effects):
                    continue
                near = compare(other, without).share > _ALIKE * evidence.share
                if near and not compare(final, other).beyond_chance and _replacement(other, final).name != effect.name:
                    alike.setdefault(_replacement(other, final).name, other)
            if final.fitted.model.held and len(final.fitted.parts) == 1 and not _worse(refit, final):
                alike["refit"] = refit
            found.append(Adopted(effect, values, evidence, without, alike))
        return tuple(found)

    def _fit_best(self, signatures: Sequence[Signature], most: float = math.inf) -> list[Judged]:
        """Models fitted from their starts; those that have been fitted before are not fitted again."""
        known = {_key(s.model): self.known[_key(s.model)] for s in signatures if _key(s.model) in self.known}
        found = fit_best([s for s in signatures if _key(s.model) not in known], most)
        self.known |= {_key(judged.fitted.model): judged for judged in found}
        return [*known.values(), *found]

    def _screened(self, fitted: Fitted, pool: Sequence[Candidate], roughly: bool = False) -> list[Signature]:
        """Signatures of effects beside a model, those that explain most first. What was screened beside the declared
        law is not screened again, nor, roughly, beside that law with effects: all do about the same there.
        """
        model, known = fitted.model, {}
        if model.held and model.problem is self.problem and (roughly or not model.effects):
            known = {signature.candidate.label: signature for signature in self.beside_declared}
        again = [known[c.label] for c in pool if c.label in known and begin_alike(known[c.label].candidate, c)]
        labels = {signature.candidate.label for signature in again}
        new = [candidate for candidate in pool if candidate.label not in labels]
        return ordered([*screen_again(fitted, again), *screen(fitted, new)])

    def _unfitted(self, refit: Judged) -> Fitted:
        """The model of a refit with the parameters as declared."""
        model = refit.fitted.model
        return fit(model, model.coordinates(), most_steps=0)

    def _candidates(self, judged: Judged) -> tuple[Candidate, ...]:
        """Effects that may be missing in a model."""
        noise = [s for s, use in zip(self.noise, self.problem.uses, strict=True) if use == "fit"]
        return self.problem.candidates([s * r for s, r in zip(noise, judged.fitted.residuals, strict=True)])


def _of_left_out(judged: Judged) -> float:
    return judged.held_out.score


def _refitted(judged: Judged) -> Judged:
    """With the belief in the declared parameters that suits what is left."""
    fitted = judged.fitted
    return Judged(fit(replace(fitted.model, misfit=fitted.misfit), fitted.x))


def _key(model: Model) -> _Key:
    return _labels(model.effects), model.held, model.misfit


def _labels(effects: Sequence[Candidate]) -> frozenset[str]:
    return frozenset(effect.label for effect in effects)


def _names(judged: Judged) -> tuple[str, ...]:
    return tuple(sorted(effect.name for effect in judged.fitted.model.effects))


def _last_is_new(judged: Judged) -> bool:
    """Whether the last effect is another one, not a further form of one that was there."""
    *before, last = judged.fitted.model.effects
    return all(effect.name != last.name for effect in before)


def _worse(model: Judged, rival: Judged) -> bool:
    """Whether a simpler model leaves more than a rival by more than chance."""
    return compare(rival, model).bic > 0.0


def _replacement(judged: Judged, of: Judged) -> Candidate:
    known = {effect.label for effect in of.fitted.model.effects}
    return next(effect for effect in judged.fitted.model.effects if effect.label not in known)
