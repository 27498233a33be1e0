"""What the loop found at the rate of a fit, fitted once more to all samples."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, fit
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
    shares = (0.0,) if problem.certain is problem else _DOUBTS
    problems = [problem.doubting(share) for share in shares]
    known = (*problems, *found.final.fitted.model.given)
    fits = side_by_side(lambda each: _fitted(found.final.fitted, each), problems, workers, known)
    predicted = [fitted for fitted in fits if fitted is not None]
    if not predicted:
        return found
    final = _likeliest(predicted)
    same = next(each for each in problems if each is final.model.problem)
    refit = _fitted(found.refit.fitted, same) or found.refit.fitted
    adopted = tuple(replace(one, values=values) for one, (_, values) in zip(found.adopted, final.parts, strict=True))
    return replace(found, refit=Judged(refit), final=Judged(final), adopted=adopted)


def _fitted(begun: Fitted, problem: DamperProblem) -> Fitted | None:
    """The model fitted to another problem; None: it cannot predict that."""
    model = replace(begun.model, problem=problem)
    try:
        return fit(model, begun.x, enough=_ENOUGH)
    except PredictionError:
        return None


def _likeliest(fits: list[Fitted]) -> Fitted:
    """With conditions of the tests as far in doubt as the tests show: what is in doubt beyond that is no excuse.

    The likelihood of residuals r in doubt by d is that of a normal distribution of covariance I + d d^T, whose
    determinant is 1 + |d|^2 (empirical Bayes: Efron & Morris 1973, JASA 68, 117-130); what is left counts as noise.
    """
    misfit = fits[-1].misfit

    def unlikely(fitted: Fitted) -> float:
        problem, noise = fitted.model.problem, fitted.model.noise
        fitting = [i for i, use in enumerate(problem.uses) if use == "fit"]
        doubts = [(doubt, noise[i]) for i in fitting if (doubt := problem.doubt(fitted.parts, i)) is not None]
        return fitted.chi2 / misfit**2 + sum(float(np.log1p(d @ d / s**2)) for d, s in doubts)

    return min(fits, key=unlikely)
