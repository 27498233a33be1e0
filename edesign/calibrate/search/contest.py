"""Many models fitted side by side, the hopeless ones not to the end."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, fit, refine
from edesign.calibrate.problem import PredictionError, Problem
from edesign.calibrate.search.screening import Signature
from edesign.calibrate.side_by_side import side_by_side

FITTED = 20
"""Forms fitted in the first round."""
_LATER, _SLOW = 7, 5  # in the second, which takes longer and has less to tell apart; in later ones, beside slow effects
_PER_EFFECT = 2  # forms of one effect among them
_WELL_FITTED = 6  # forms or pairs of those that are fitted to the end
_ROUGH_STEPS, _MORE_STEPS = 5, 3  # with slopes known before, and with new ones
_HOPELESS = 6.0  # times the best chi2 beyond which a model is not fitted further
BEHIND = 3.0
"""Times the best chi2 beyond which a model is not fitted to the end, nor other forms of its last effect."""
_NEARLY = 0.9  # of the gain of the best form
_ROUGH, _WELL = 1e-2, 1e-3  # changes of chi2 that end a search

T = TypeVar("T")
S = TypeVar("S")


def fit_best(signatures: Sequence[Signature], most: float = math.inf) -> list[Judged]:
    """Models fitted from their starts: all of them roughly, and predicted so, then the best of them well.

    Args:
        signatures: forms of effects with their starts.
        most: chi2 beyond which a model is not fitted to the end.
    """
    workers = max((s.model.workers for s in signatures), default=1)
    problems = {id(s.model.problem.rough): s.model.problem for s in signatures}
    known = [thing for s in signatures for thing in (*s.model.given, s.model.problem.rough, *s.frozen)]

    def side(function: Callable[[T], S | None], items: Iterable[T]) -> list[S]:
        return [found for found in side_by_side(function, items, workers, known) if found is not None]

    best: dict[tuple[str, ...], Fitted] = {}
    for found in side(_roughly, sorted(signatures, key=_quick)):
        key = tuple(effect.label for effect in found.model.effects)
        best[key] = min(best.get(key, found), found, key=lambda f: f.chi2)
    promising = [fitted for fitted in _promising(best.values(), _HOPELESS) if fitted.chi2 <= most]
    if len(promising) <= _WELL_FITTED:
        return side(lambda found: _well(found, problems[id(found.model.problem)]), sorted(promising, key=_quick))
    nearer = _promising(side(_nearer, sorted(promising, key=_quick)), BEHIND)[:_WELL_FITTED]
    return side(lambda found: _on(found, problems[id(found.model.problem)]), sorted(nearer, key=_quick))


def _quick(one: Signature | Fitted) -> tuple[int, int]:
    """Key by which what takes longest goes first, lest all wait for it in the end."""
    return -sum(effect.slow for effect in one.model.effects), -len(one.model.unknowns)


def _roughly(signature: Signature) -> Fitted | None:
    model = replace(signature.model, problem=signature.model.problem.rough)
    try:
        return fit(model, signature.start, _ROUGH_STEPS, _ROUGH, signature.frozen)
    except PredictionError:
        return None


def _nearer(found: Fitted) -> Fitted | None:
    try:
        return fit(found.model, found.x, _MORE_STEPS, _ROUGH)
    except PredictionError:
        return None


def _on(found: Fitted, problem: Problem) -> Judged | None:
    """Of a problem that is not predicted roughly; the slopes are good enough."""
    if problem is found.model.problem:
        return judged_of(lambda: refine(found, _WELL))
    model = replace(found.model, problem=problem)
    return judged_of(lambda: refine(replace(found, model=model, residuals=tuple(model.residuals(found.x))), _WELL))


def _well(found: Fitted, problem: Problem) -> Judged | None:
    return judged_of(lambda: fit(replace(found.model, problem=problem), found.x, enough=_WELL))


def judged_of(search: Callable[[], Fitted]) -> Judged | None:
    """What a search finds, with its errors on tests left out; None: it cannot be predicted."""
    try:
        judged = Judged(search())
        _ = judged.held_out
    except PredictionError:
        return None
    return judged


def _promising(found: Iterable[Fitted], behind: float) -> list[Fitted]:
    """Those that leave no more than so many times what the best leaves, the best first."""
    ordered = sorted(found, key=lambda fitted: fitted.chi2)
    return [fitted for fitted in ordered if fitted.chi2 <= behind * ordered[0].chi2]


def shortlist(signatures: Sequence[Signature]) -> list[Signature]:
    """The best forms, not too many of one effect."""
    known = signatures[0].model.effects[:-1] if signatures else ()
    slow = len(known) > 1 or any(effect.slow for effect in known)
    most = _SLOW if slow else _LATER if known else FITTED
    best: dict[str, list[Signature]] = {}
    for signature in signatures:
        if signature.gain > 0.0:
            best.setdefault(signature.candidate.name, []).append(signature)
    found = [signature for forms in best.values() for signature in likely_forms(forms, _PER_EFFECT)]
    return sorted(found, key=lambda signature: -signature.gain)[:most]


def likely_forms(forms: Sequence[Signature], most: int) -> list[Signature]:
    """Some of the forms of an effect, the best first in: half of them those that explain most, half the simplest of
    those that explain nearly as much.
    """
    ordered = sorted(forms, key=lambda signature: -signature.gain)
    chosen = ordered[: (most + 1) // 2]
    near = [s for s in ordered[len(chosen) :] if s.gain >= _NEARLY * ordered[0].gain]
    chosen += sorted(near, key=lambda signature: signature.freedom)[: most - len(chosen)]
    return chosen + [s for s in ordered if not any(s is other for other in chosen)][: most - len(chosen)]


def both(first: Signature, second: Signature) -> Signature:
    """Both effects, each from its own start."""
    own = second.start[-len(second.candidate.unknowns) :] if second.candidate.unknowns else np.empty(0)
    return replace(
        first,
        model=replace(first.model, effects=(*first.model.effects, second.candidate)),
        start=np.concatenate((first.start, own)),
    )
