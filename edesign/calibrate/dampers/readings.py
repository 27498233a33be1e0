"""How the MGMM is read where a campaign does not say: whether extremes last between tests, what gamma_T multiplies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import product
from typing import NamedTuple

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.fit import Fitted, Model, fit
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.search.screening import Signature, screen, screen_again
from edesign.calibrate.side_by_side import side_by_side
from edesign.damper.temperature import REFERENCE_C, GammaOf, GammaT
from edesign.damper.testing.campaign_blocks import Extremes, LawChoice

_EXTREMES: tuple[Extremes, ...] = ("fresh", "lasting")
_GAMMAS: tuple[GammaOf, ...] = ("parameters", "force", "by_the_letter")
_FAR = 10.0  # times what the best reading of the declared law leaves: beyond, a refit does not make up for it
_SURE, _CLEAR, _PERHAPS = 0.25, 0.5, 0.9
"""Of the sum of squares that the usual reading leaves: another one that leaves less is the only one, the first, or the
second to be searched, as an effect that the law lacks may go with another reading in part.
"""


class Reading(NamedTuple):
    """A way to read the law: the problem with it, and coordinates (p,) of the law fitted so; None: not fitted."""

    problem: DamperProblem
    refitted: np.ndarray | None = None


def read(problem: DamperProblem, choice: LawChoice) -> DamperProblem:
    """The problem with the law read as the campaign says, and else as usual."""
    return replace(problem, lasting=choice.extremes == "lasting", gamma_of=choice.gamma_T_of or "parameters")


def likely_readings(
    problem: DamperProblem, choice: LawChoice, noise: Sequence[float], workers: int = 1
) -> tuple[Reading, ...]:
    """The problem with the law read as the campaign says, and what it does not say as the tests do: one reading, or
    two, the likelier one first. Another one than the usual is likely if it leaves less of the law as declared and of
    the law fitted again (geometric mean): a law that is not as declared says little by the first, one that lacks an
    effect, for which a refit makes up, by the second. It must leave less beside the effect that explains most, too, to
    come first: an effect may do to the usual reading what makes it another one, as a mass takes stiffness away.

    Args:
        problem: at the rate of a fit.
        choice: the law as the campaign names it.
        noise: (tests,) standard deviation of each test's noise, N.
        workers: processes.
    """
    usual = read(problem, choice)
    if problem.law.name not in GammaT().laws:
        return (Reading(usual),)
    extremes = _EXTREMES if choice.extremes is None else (choice.extremes,)
    warm = any(trial.mean_temperature != REFERENCE_C for trial in problem.trials)
    gammas = (usual.gamma_of,) if choice.gamma_T_of or not warm else _GAMMAS
    readings = [replace(usual, lasting=e == "lasting", gamma_of=g) for e, g in product(extremes, gammas)]
    left = side_by_side(lambda one: _left(one, noise), readings, workers)
    near = [i for i in range(len(left)) if i == 0 or left[i] < _FAR * min(left)]
    found = [Reading(one) for one in readings]
    if choice.refit and len(near) > 1:
        again = side_by_side(lambda i: _refitted(readings[i], noise), near, workers)
        for i, (refitted, x) in zip(near, again, strict=True):
            left[i] = math.sqrt(left[i] * refitted)
            found[i] = Reading(readings[i], x)
    best = min(near, key=lambda i: left[i])
    first, other, share = found[0], found[best], _share(left[best], left[0])
    if share >= _PERHAPS:
        return (first,)
    if share < _CLEAR:
        beside = (_left_beside_one(one.problem, noise, choice.refit) for one in (other, first))
        share = max(share, _share(*beside))
    if share < _SURE:
        return (other,)
    return (other, first) if share < _CLEAR else (first, other)


def _share(left: float, usual: float) -> float:
    """Of what the usual reading leaves."""
    return left / usual if usual > 0.0 else 1.0


def _left(problem: DamperProblem, noise: Sequence[float]) -> float:
    """Sum of squares of the law as declared, in units of noise."""
    try:
        return _fitted(problem, noise, refit=False).chi2
    except PredictionError:
        return float("inf")


def _refitted(problem: DamperProblem, noise: Sequence[float]) -> tuple[float, np.ndarray | None]:
    """Sum of squares of the law fitted again, in units of noise, and its coordinates (p,)."""
    try:
        fitted = _fitted(problem, noise, refit=True)
    except PredictionError:
        return float("inf"), None
    return fitted.chi2, fitted.x


def _left_beside_one(problem: DamperProblem, noise: Sequence[float], refit: bool) -> float:
    """The same beside the effect that explains most by a linear estimate, the law as declared or fitted again."""
    try:
        declared = _fitted(problem, noise, refit=False)
        fitted = [s for s, use in zip(noise, problem.uses, strict=True) if use == "fit"]
        left = [size * r for size, r in zip(fitted, declared.residuals, strict=True)]
        signatures = screen(declared, problem.candidates(left))
        found = [declared.chi2 - _most(signatures)]
        if refit:
            free = _fitted(problem, noise, refit=True)
            found.append(free.chi2 - _most(screen_again(free, signatures)))
    except PredictionError:
        return float("inf")
    return max(min(found), float(declared.samples))


def _most(signatures: Sequence[Signature]) -> float:
    return max((signature.gain for signature in signatures), default=0.0)


def _fitted(problem: DamperProblem, noise: Sequence[float], refit: bool) -> Fitted:
    model = Model(problem, tuple(noise), (), held=not refit)
    return fit(model, model.coordinates())
