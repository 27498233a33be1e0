"""Whether a law's softening by extremes lasts from test to test, where the campaign does not say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import PredictionError

_FAR = 10.0  # times what the declared law leaves: beyond, a refit does not make up for it
_CLEAR = 0.5  # of the sum of squares: what an effect of the library changes is less than what all extremes do


def remembered(problem: DamperProblem, noise: Sequence[float], refit: bool) -> DamperProblem:
    """The problem with a fresh specimen in each test, or with extremes that last, whichever leaves less: of the law as
    declared, or fitted again. Effects that the law may lack come later.

    Args:
        problem: with fresh specimens, at the rate of a fit.
        noise: (tests,) standard deviation of each test's noise, N.
        refit: whether the parameters of the law may be fitted.
    """
    lasting = replace(problem, lasting=True)
    fresh_left, lasting_left = (_left(one, noise, refit=False) for one in (problem, lasting))
    if lasting_left >= _FAR * fresh_left or lasting_left == fresh_left:
        return problem
    if refit:
        fresh_left, lasting_left = (
            min(left, _left(one, noise, refit=True)) for one, left in ((problem, fresh_left), (lasting, lasting_left))
        )
    return lasting if lasting_left < _CLEAR * fresh_left else problem


def _left(problem: DamperProblem, noise: Sequence[float], refit: bool) -> float:
    """Sum of squares in units of noise."""
    model = Model(problem, tuple(noise), (), held=not refit)
    try:
        return fit(model, model.coordinates()).chi2
    except PredictionError:
        return float("inf")
