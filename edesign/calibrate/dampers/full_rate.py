"""What the loop found at the rate of a fit, fitted once more to all samples."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, belief, fit, whitened
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.search.selection import Selection

_ENOUGH = 1e-5  # of the sum of squares of some ten thousand samples: less than chance makes
_DOUBTS = (0.0, 0.1, 0.3, 1.0)  # shares of the doubt about conditions of the tests


def at_full_rate(found: Selection, problem: DamperProblem, noise: tuple[float, ...]) -> Selection:
    """The final model and its rival fitted to all samples: larger steps have errors of their own, with a rig in series
    above all, for which parameters have made up.

    Args:
        found: by the loop.
        problem: of the same tests at full rate.
        noise: (tests,) standard deviation of each test's noise there.
    """
    whole = problem.doubting(likeliest_doubt(found.final.fitted))
    final, refit = (_fitted(judged.fitted, whole, noise) for judged in (found.final, found.refit))
    if final is None:
        return found
    adopted = tuple(replace(one, values=values) for one, (_, values) in zip(found.adopted, final.parts, strict=True))
    return replace(found, refit=Judged(refit or found.refit.fitted), final=Judged(final), adopted=adopted)


def likeliest_doubt(final: Fitted) -> float:
    """Share of the doubt about conditions of the tests that they show: what is in doubt beyond that is no excuse.

    The likelihood of residuals r in doubt by d is that of a normal distribution of covariance I + d d^T, whose
    determinant is 1 + |d|^2 (empirical Bayes: Efron & Morris 1973, JASA 68, 117-130); what is left counts as noise. The
    parameters follow from the slopes; what is beyond the farthest that a condition may be off counts in full.
    """
    model, x = final.model, final.x
    if model.problem.certain is model.problem:
        return 0.0
    known = fit(replace(model, problem=model.problem.certain), x, most_steps=0)
    doubts = model.doubts(x)

    def unlikely(share: float) -> float:
        hessian, gradient, spread = np.diag(belief(model) ** 2), model.pull(x), 0.0
        own = [None if doubt is None else share * doubt for doubt in doubts]
        for r, j, doubt in zip(known.residuals, known.slopes, own, strict=True):
            hessian, gradient = hessian + j.T @ j, gradient + j.T @ r
            if doubt is not None:
                power = float(doubt @ doubt)
                along = doubt @ j
                hessian = hessian - np.outer(along, along) / (1.0 + power)
                gradient = gradient - along * (doubt @ r) / (1.0 + power)
                spread += math.log1p(power)
        move = np.linalg.lstsq(hessian, -gradient, rcond=1e-12)[0]
        cost = 0.0
        for r, j, doubt in zip(known.residuals, known.slopes, own, strict=True):
            left = r + j @ move
            cost += float(np.sum((left if doubt is None else whitened(left, doubt)) ** 2))
        return cost / final.misfit**2 + spread

    return min(_DOUBTS, key=unlikely)


def _fitted(begun: Fitted, problem: DamperProblem, noise: tuple[float, ...]) -> Fitted | None:
    """The model fitted to another problem with noise (tests,); None: it cannot predict that."""
    model = replace(begun.model, problem=problem, noise=noise)
    try:
        return fit(model, begun.x, enough=_ENOUGH)
    except PredictionError:
        return None
