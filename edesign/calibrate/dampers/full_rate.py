"""What the loop found at the rate of a fit, fitted once more to all samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, belief, fit
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.selection import Selection
from edesign.calibrate.side_by_side import side_by_side

_ENOUGH = 1e-6  # of the sum of squares of some ten thousand samples: a tenth of what chance makes
_DOUBTS = (0.0, 0.1, 0.3, 1.0)  # shares of the doubt about conditions of the tests


def at_full_rate(found: Selection, problem: DamperProblem, workers: int) -> Selection:
    """The final model and its rival fitted to all samples: larger steps have errors of their own, with a rig in series
    above all, for which parameters have made up.

    Args:
        found: by the loop.
        problem: of the same tests at full rate.
        workers: processes.
    """
    whole = problem.doubting(likeliest_doubt(found.final.fitted))
    both, known = (found.final.fitted, found.refit.fitted), (whole, *found.final.fitted.model.given)
    final, refit = side_by_side(lambda fitted: _fitted(fitted, whole), both, workers, known)
    if final is None:
        return found
    adopted = tuple(replace(one, values=values) for one, (_, values) in zip(found.adopted, final.parts, strict=True))
    return replace(found, refit=Judged(refit or found.refit.fitted), final=Judged(final), adopted=adopted)


def likeliest_doubt(final: Fitted) -> float:
    """Share of the doubt about conditions of the tests that they show: what is in doubt beyond that is no excuse.

    The likelihood of residuals r in doubt by d is that of a normal distribution of covariance I + d d^T, whose
    determinant is 1 + |d|^2 (empirical Bayes: Efron & Morris 1973, JASA 68, 117-130); what is left counts as noise. The
    parameters follow from the slopes.
    """
    model, x = final.model, final.x
    if model.problem.certain is model.problem:
        return 0.0
    known = fit(replace(model, problem=model.problem.certain), x, most_steps=0)
    doubts = model.doubts(x)

    def unlikely(share: float) -> float:
        hessian, gradient, cost, spread = np.diag(belief(model) ** 2), model.pull(x), 0.0, 0.0
        for r, j, doubt in zip(known.residuals, known.slopes, doubts, strict=True):
            size = 0.0 if doubt is None else share * float(np.sqrt(doubt @ doubt))
            if doubt is not None and size > 0.0:
                along = share * doubt / size
                less = 1.0 - 1.0 / np.hypot(1.0, size)
                r, j = r - along * (less * (along @ r)), j - np.outer(along, less * (along @ j))
                spread += float(np.log1p(size**2))
            hessian, gradient, cost = hessian + j.T @ j, gradient + j.T @ r, cost + float(r @ r)
        best = cost - float(gradient @ np.linalg.lstsq(hessian, gradient, rcond=1e-12)[0]) if x.size else cost
        return best / final.misfit**2 + spread

    return min(_DOUBTS, key=unlikely)


def _fitted(begun: Fitted, problem: DamperProblem) -> Fitted | None:
    """The model fitted to another problem; None: it cannot predict that."""
    model = replace(begun.model, problem=problem)
    try:
        return fit(model, begun.x, enough=_ENOUGH)
    except PredictionError:
        return None
