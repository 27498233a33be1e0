"""Models near a model: with its law fitted or held, with effects more, less or others; and what was fitted before."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from edesign.calibrate.cross_validation import FEWEST
from edesign.calibrate.evidence import Judged, compare
from edesign.calibrate.fit import Fitted, Model, fit
from edesign.calibrate.problem import Candidate, Part, Problem
from edesign.calibrate.result import Coverage
from edesign.calibrate.search.begun import begin_alike, may_join, others_than
from edesign.calibrate.search.contest import fit_best, judged_of
from edesign.calibrate.search.screening import Signature, ordered, screen, screen_again
from edesign.calibrate.side_by_side import side_by_side

FEW = 2
"""Effects up to which pairs are sought, and each is held against others and in other forms."""
LONG = 40
"""Steps of a search along the valleys between a shape and the rest, or of a law far from its tests."""
RIVALS = 5
"""Forms that are tried in the place of one."""
_SCREENED = 24
"""Forms that are screened beside a model with effects, of those that were beside the declared law."""
FAR_BEHIND, HOPELESS = 60.0, 20.0
"""Times what a model leaves, beyond which others after a rough fit are no rivals, and smaller ones never suffice."""
_BARE_MENTION = 2.0
"""BIC up to which evidence is "not worth more than a bare mention" (Kass & Raftery 1995, JASA 90, 773-795)."""
NONE: frozenset[str] = frozenset()
"""Labels of no effects."""

Progress = Callable[[str], None]
Key = tuple[frozenset[str], bool, float]


class Workbench:
    """What all parts of the search share.

    Args:
        problem: tests, model, and effects it may lack.
        noise: (tests,) standard deviation of each test's noise.
        refit: whether the parameters of the model may be fitted.
        workers: processes.
        progress: told what is done.

    Attributes:
        left: residuals of the model without effects that is the rival of all.
        beside_declared, beside_refit: effects beside the law as declared, and beside the law alone as it stands.
        rivals: models with one effect more, by the effects they share, and whether these stand beside the declared law.
        known: models fitted since the model was last fitted again.
        looked_at, fitted: labels of forms of effects that were screened and fitted, by those beside which they were.
    """

    def __init__(self, problem: Problem, noise: Sequence[float], refit: bool, workers: int, progress: Progress) -> None:
        self.problem = problem
        self.noise = tuple(noise)
        self.may_refit = refit
        self.workers = workers
        self.tell = progress
        self.left: tuple[np.ndarray, ...] = ()
        self.beside_declared: list[Signature] = []
        self.beside_refit: list[Signature] = []
        self.rivals: dict[tuple[frozenset[str], bool], list[Judged]] = {}
        self.known: dict[Key, Judged] = {}
        self.looked_at: dict[frozenset[str], set[str]] = {}
        self.fitted: dict[frozenset[str], set[str]] = {}

    def coverage(self, final: Judged) -> Coverage:
        """What was looked at beside a model, the law held or not."""
        model = final.fitted.model
        labels = labels_of(model.effects)
        forms = tuple(c.label for c in self.candidates(final) if may_join(c, model.effects))
        return Coverage(forms, frozenset(self.looked_at.get(labels, ())), frozenset(self.fitted.get(labels, ())))

    def certain(self, current: Judged) -> Judged:
        """With nothing in doubt."""
        problem = self.problem.certain
        if problem is self.problem:
            return current
        return Judged(fit(replace(current.fitted.model, problem=problem), current.fitted.x, LONG))

    def in_doubt(self, current: Judged) -> Judged:
        """With what is in doubt."""
        if current.fitted.model.problem is self.problem:
            return current
        return Judged(fit(replace(current.fitted.model, problem=self.problem), current.fitted.x))

    def with_parts(self, current: Judged, i: int, others: Sequence[Part]) -> list[Judged]:
        """Models with each of some effects in the place of the effect i, fitted from its values."""
        model, parts = current.fitted.model, current.fitted.parts
        begun = []
        for part in others:
            own = [*parts[:i], part, *parts[i + 1 :]]
            other = replace(model, effects=tuple(effect for effect, _ in own))
            begun.append((other, other.coordinates(current.fitted.base, own)))
        return self.fit_from(begun)

    def fit_all(self, current: Judged, parts: Sequence[Part]) -> list[Judged]:
        """Models with each of some effects added, those that can be predicted."""
        model, base, here = current.fitted.model, current.fitted.base, current.fitted.parts
        models = [replace(model, effects=(*model.effects, part[0])) for part in parts]
        starts = [one.coordinates(base, (*here, part)) for one, part in zip(models, parts, strict=True)]
        return self.fit_from([*zip(models, starts, strict=True)])

    def fit_from(self, begun: Sequence[tuple[Model, np.ndarray]]) -> list[Judged]:
        """Models fitted from coordinates, those that can be predicted."""
        given = [thing for model, _ in begun for thing in model.given]
        found = side_by_side(lambda one: judged_of(lambda: fit(*one, LONG)), begun, self.workers, given)
        return [judged for judged in found if judged is not None]

    def without(self, current: Judged, effect: Candidate) -> Judged:
        model = current.fitted.model
        smaller = replace(model, effects=others_than(model.effects, effect))
        return Judged(fit(smaller, smaller.coordinates(current.fitted.base, current.fitted.parts)))

    def each_without(self, current: Judged) -> list[tuple[Candidate, Judged]]:
        """Each effect, and the model without it."""
        model = current.fitted.model
        given = [*model.given, current]
        found = side_by_side(lambda effect: self.without(current, effect), model.effects, self.workers, given)
        return [*zip(model.effects, found, strict=True)]

    def freed(self, current: Judged) -> Judged:
        """With the parameters of the law fitted, if that is better by more than chance."""
        return self.freed_all([current])[0]

    def freed_all(self, models: Sequence[Judged]) -> list[Judged]:
        """The same of each of some models."""
        given = [thing for one in models for thing in (*one.fitted.model.given, one)]
        found = side_by_side(self._freed, models, self.workers, given)
        new = [judged for judged, begun in zip(found, models, strict=True) if judged is not begun]
        self.known |= {key_of(judged.fitted.model): judged for judged in new}
        return found

    def _freed(self, current: Judged) -> Judged:
        model = current.fitted.model
        if not model.held or not self.may_refit:
            return current
        free = replace(model, held=False)
        found = Judged(fit(free, free.coordinates(None, current.fitted.parts)))
        return found if compare(found, current).beyond_chance else current

    def freed_if_half(self, current: Judged) -> Judged:
        """With the parameters of the law fitted, if that leaves half at most: what else is missing may make it no
        better on tests left out.
        """
        model = current.fitted.model
        if not model.held or not self.may_refit:
            return current
        free = replace(model, held=False)
        found = Judged(fit(free, free.coordinates(None, current.fitted.parts), LONG))
        return found if found.fitted.chi2 <= 0.5 * current.fitted.chi2 else current

    def held_again(self, current: Judged) -> Judged:
        """With the law as declared, if that explains the tests as well once the effects are there."""
        model = current.fitted.model
        if model.held or not model.effects or not self.may_refit:
            return current
        held = replace(model, held=True)
        start = held.coordinates(None, current.fitted.parts)
        found = Judged(fit(held, start))
        return current if worse(found, current) else found

    def fit_best(self, signatures: Sequence[Signature], most: float = math.inf) -> list[Judged]:
        """Models fitted from their starts; those that have been fitted before are not fitted again."""
        known = {key_of(s.model): self.known[key_of(s.model)] for s in signatures if key_of(s.model) in self.known}
        found = fit_best([s for s in signatures if key_of(s.model) not in known], most)
        self.known |= {key_of(judged.fitted.model): judged for judged in found}
        for judged in found:
            *beside, last = judged.fitted.model.effects
            self.fitted.setdefault(labels_of(beside), set()).add(last.label)
        return [*known.values(), *found]

    def screened(self, fitted: Fitted, pool: Sequence[Candidate], roughly: bool = False) -> list[Signature]:
        """Signatures of effects beside a model, those that explain most first. What was screened beside the declared
        law is not screened again, nor, roughly, beside that law with effects: all do about the same there. Beside
        other models with effects those that do little if they do the same there are not screened again either.
        """
        model = fitted.model
        known = {signature.candidate.label: signature for signature in self.beside_declared}
        again = [known[c.label] for c in pool if c.label in known and begin_alike(known[c.label].candidate, c)]
        if model.held and model.problem is self.problem and (roughly or not model.effects):
            same = screen_again(fitted, again)
        elif model.effects and len(pool) > _SCREENED:
            same = screen_again(fitted, again)[_SCREENED:]
        else:
            same = []
        labels = {signature.candidate.label for signature in same}
        looked_at = self.looked_at.setdefault(labels_of(model.effects), set())
        looked_at |= labels

        def seen(candidates: Sequence[Candidate]) -> None:
            looked_at.update(candidate.label for candidate in candidates)

        return ordered([*same, *screen(fitted, [c for c in pool if c.label not in labels], seen)])

    @staticmethod
    def unfitted(refit: Judged) -> Fitted:
        """The model of a refit with the parameters as declared."""
        model = refit.fitted.model
        return fit(model, model.coordinates(), most_steps=0)

    def candidates(self, judged: Judged) -> tuple[Candidate, ...]:
        """Effects that may be missing in a model, and that so many tests can bear out."""
        return tuple(c for c in self._all_candidates(judged) if not (self.few and c.between_tests))

    def beyond_few(self, judged: Judged) -> tuple[Candidate, ...]:
        """Effects that act between tests, where these are too few to bear them out."""
        return tuple(c for c in self._all_candidates(judged) if self.few and c.between_tests)

    @property
    def few(self) -> bool:
        """Whether the tests are too few for each to be left out as a whole."""
        return self.problem.uses.count("fit") < FEWEST

    def _all_candidates(self, judged: Judged) -> tuple[Candidate, ...]:
        noise = [s for s, use in zip(self.noise, self.problem.uses, strict=True) if use == "fit"]
        return self.problem.candidates([s * r for s, r in zip(noise, judged.fitted.residuals, strict=True)])


def of_left_out(judged: Judged) -> float:
    """Error on tests left out."""
    return judged.held_out.score


def refitted(judged: Judged) -> Judged:
    """With the belief in the declared parameters that suits what is left."""
    fitted = judged.fitted
    return Judged(fit(replace(fitted.model, misfit=fitted.misfit), fitted.x))


def key_of(model: Model) -> Key:
    """What makes a model the same as another, but for where its search began."""
    return labels_of(model.effects), model.held, model.misfit


def labels_of(effects: Sequence[Candidate]) -> frozenset[str]:
    """Labels of forms."""
    return frozenset(effect.label for effect in effects)


def worse(model: Judged, rival: Judged) -> bool:
    """Whether a simpler model leaves more than a rival by more than chance, so that it is worth a mention."""
    return compare(rival, model).bic > _BARE_MENTION
