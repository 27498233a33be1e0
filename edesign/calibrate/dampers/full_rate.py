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


def at_full_rate(found: Selection, problem: DamperProblem, workers: int) -> Selection:
    """The final model and its rival fitted to all samples: larger steps have errors of their own, with a rig in series
    above all, for which parameters have made up.

    Args:
        found: by the loop.
        problem: of the same tests at full rate.
        workers: processes.
    """
    begun = [judged.fitted for judged in (found.refit, found.final)]
    problems = [problem] if problem.certain is problem else [problem, problem.certain]
    jobs = [(fitted, each) for fitted in begun for each in problems]
    known = (*problems, *begun[1].model.given)
    fits = side_by_side(lambda job: _fitted(*job), jobs, workers, known)
    refit, final = (_likelier(fits[i : i + len(problems)]) for i in (0, len(problems)))
    adopted = tuple(replace(one, values=values) for one, (_, values) in zip(found.adopted, final.parts, strict=True))
    return replace(found, refit=Judged(refit), final=Judged(final), adopted=adopted)


def _fitted(begun: Fitted, problem: DamperProblem) -> Fitted:
    try:
        return fit(replace(begun.model, problem=problem), begun.x, enough=_ENOUGH)
    except PredictionError:
        return begun


def _likelier(fits: list[Fitted]) -> Fitted:
    """With conditions of the tests in doubt, or without if that is as likely: what is in doubt then is no excuse.

    The likelihood of residuals r in doubt by d is that of a normal distribution of covariance I + d d^T, whose
    determinant is 1 + |d|^2; what is left counts as noise.
    """
    if len(fits) == 1:
        return fits[0]
    doubting, certain = fits
    problem, noise = doubting.model.problem, doubting.model.noise
    doubts = [problem.doubt(i) for i, use in enumerate(problem.uses) if use == "fit"]
    sizes = [s for s, use in zip(noise, problem.uses, strict=True) if use == "fit"]
    room = sum(np.log1p(float(d @ d) / s**2) for d, s in zip(doubts, sizes, strict=True) if d is not None)
    return certain if certain.chi2 - doubting.chi2 <= room * doubting.misfit**2 else doubting
