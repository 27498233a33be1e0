"""The score of a model: log predictive density of each test, left out of the fit.

With H = sum J_i' J_i + P the normal matrix of the fit (P: precision of the prior, 1 of each coordinate that has one), g
its gradient and H_-i = H - J_i' J_i, one Gauss-Newton step leads to the parameters by the other tests, and gives the
residual of test i and its covariance:

    s = -H_-i^-1 (g - J_i' r_i)        r_i|-i = r_i + J_i s        V_i = I + J_i H_-i^-1 J_i'

The scale s^2 of all residuals is not known: it has an inverse gamma prior about 1, and the other tests; the noise is a
floor of it. The predictive density is Student's t; its quadratic form and determinant need p x p matrices only.

Source: Gelman, Carlin, Stern, Dunson, Vehtari and Rubin (2013), Bayesian Data Analysis, 14.2 and 14.6; Vehtari,
Gelman and Gabry (2017), Statistics and Computing 27, 1413-1432.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.estimation.least_squares import Fit, Settings, fit, weighted
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import priors_of

PRIOR_FREEDOM = 10.0
"""Degrees of freedom of the prior of the scale: the noise of a channel is known to a quarter or so."""
_NEAR = 1.0  # change of a coordinate, in prior standard deviations, up to which one Gauss-Newton step is near enough
_REFIT_STEPS = 3
_ROUGH = Settings(rough=True)
_SINGULAR = 1e-13  # pivot of a normal matrix with ones on its diagonal


@dataclass(frozen=True)
class Score:
    """Log densities of tests, up to a constant that all models of the same tests and noise share.

    Attributes:
        left_out: (tests,) log predictive density of each test, left out; -inf where the others do not determine all
            flat parameters.
        within: (tests,) that of each test, in the fit.
        log_prior: of the model, of which several differ in a place alone.
        evaluations: sets of parameters for which tests were predicted.
    """

    left_out: np.ndarray
    within: np.ndarray
    evaluations: int = 0
    log_prior: float = 0.0

    @property
    def total(self) -> float:
        """Sum over the tests left out, and the log prior."""
        return float(self.left_out.sum()) + self.log_prior


def score(fitted: Fit, noise: Noise, wrong: Sequence[np.ndarray] | None = None, refits: bool = False) -> Score:
    """Return the score of a fit under a noise that all models compared share.

    Parameters at a bound count as known.

    Args:
        noise: of the tests.
        wrong: columns (n_i, k) of each test by which the equations of the model may be wrong: their shares, the same in
            all tests, have the prior N(0, 1). None: there are none.
        refits: whether the model is fitted again without a test that moves it far.
    """
    here = Linear.of(fitted, noise, wrong)
    freedom = np.array([noise.independent(i, f.size) for i, f in enumerate(fitted.predicted)])
    whole = here.step()
    left_out, within, evaluations = [], [], 0
    for i, n in enumerate(freedom):
        others = PRIOR_FREEDOM + float(np.delete(freedom, i).sum())
        at, step, spent = without(here, fitted, noise, wrong, i) if refits else (here, here.step(i), 0)
        evaluations += spent
        if step is None or whole is None:
            left_out.append(-math.inf)
            within.append(-math.inf)
            continue
        power = here.power(whole)
        within.append(_student(power[i], _scale(power, i, others), others, n) - 0.5 * here.determinants[i])
        quadratic, determinant = at.predicted(i, step)
        density = _student(quadratic, _scale(at.power(step), i, others), others, n)
        left_out.append(density - 0.5 * (at.determinants[i] + determinant))
    return Score(np.array(left_out), np.array(within), evaluations)


def without(
    here: Linear, fitted: Fit, noise: Noise, wrong: Sequence[np.ndarray] | None, test: int
) -> tuple[Linear, np.ndarray | None, int]:
    """Return a model about its fit to the other tests, the step to that, and for how many sets they were predicted.

    Args:
        test: that is left out. Where it moves the model far, that is fitted again under its own noise, once.
    """
    step, whole, evaluations = here.step(test), here.step(), 0
    if step is None or whole is None or np.max(np.abs(step - whole), initial=0.0) <= _NEAR:
        return here, step, 0
    if test not in fitted.without:
        try:
            fitted.without[test] = fit(fitted.model, fitted.noise.without(test), fitted, _REFIT_STEPS, _ROUGH)
            evaluations = fitted.without[test].evaluations
        except PredictionError:
            fitted.without[test] = fitted
    there = Linear.of(fitted.without[test], noise, wrong)
    found = there.step(test)
    return (here, step, evaluations) if found is None else (there, found, evaluations)


def _scale(power: np.ndarray, test: int, others: float) -> float:
    """Return the scale that the other tests show, of which the noise is a floor."""
    return max((PRIOR_FREEDOM + float(np.delete(power, test).sum())) / others, 1.0)


@dataclass(frozen=True)
class Linear:
    """A model about its fit, linear in its q free parameters and in what its equations may be wrong by.

    Attributes:
        start: (q,) coordinates of the fit, and nothing of what may be wrong.
        prior: (q,) precision.
        squares: (tests,) of residuals in units of the noise.
        pulls: (tests, q) J_i' r_i.
        normals: (tests, q, q) J_i' J_i.
        determinants: log, of each test, that integrating out its nuisance amplitudes adds.
    """

    start: np.ndarray
    prior: np.ndarray
    squares: np.ndarray
    pulls: np.ndarray
    normals: np.ndarray
    determinants: tuple[float, ...]

    @staticmethod
    def of(fitted: Fit, noise: Noise, wrong: Sequence[np.ndarray] | None) -> Linear:
        """Return a fitted model, with columns by which its equations may be wrong."""
        beside = wrong or [np.zeros((f.size, 0)) for f in fitted.predicted]
        slopes = [np.hstack((j[:, fitted.free], c)) for j, c in zip(fitted.slopes, beside, strict=True)]
        here, k = weighted(fitted.model, noise, fitted.values, fitted.predicted, slopes), beside[0].shape[1]
        return Linear(
            np.append(fitted.z[fitted.free], np.zeros(k)),
            np.append(priors_of(fitted.model.parameters)[fitted.free], np.ones(k)),
            np.array([float(r @ r) for r in here.residuals]),
            np.array([j.T @ r for j, r in zip(here.slopes, here.residuals, strict=True)]),
            np.array([j.T @ j for j in here.slopes]),
            here.determinants,
        )

    def step(self, *without: int) -> np.ndarray | None:
        """Return the step (q,) to the best of all tests but some; None if they do not determine it."""
        root, _ = self._root(without)
        rest = self._rest(without)
        return None if root is None else -root.T @ (root @ (self.prior * self.start + self.pulls[rest].sum(axis=0)))

    def power(self, step: np.ndarray) -> np.ndarray:
        """Return the squares (tests,) of residuals after a step."""
        return np.maximum(self.squares + self.pulls @ step * 2.0 + self.normals @ step @ step, 0.0)

    def predicted(self, test: int, step: np.ndarray, *without: int) -> tuple[float, float]:
        """Return quadratic form and log determinant of the prediction of a test after the step by the others.

        Args:
            without: tests that are none of the others.
        """
        (root, whole), (_, others) = self._root(without), self._root((*without, test))
        along = root @ (self.pulls[test] + self.normals[test] @ step) if root is not None else step
        return max(float(self.power(step)[test] - along @ along), 0.0), whole - others

    def _rest(self, without: Sequence[int]) -> np.ndarray:
        return np.isin(np.arange(len(self.pulls)), np.array(without, dtype=int), invert=True)

    def _root(self, without: Sequence[int]) -> tuple[np.ndarray | None, float]:
        """Return S, S'S the inverse of the normal matrix of all tests but some, or None, and its log determinant."""
        matrix = np.diag(self.prior) + self.normals[self._rest(without)].sum(axis=0)
        length = np.sqrt(np.maximum(np.diag(matrix), 1e-300))
        try:
            root = np.linalg.cholesky(matrix / np.outer(length, length))
        except np.linalg.LinAlgError:
            return None, -math.inf
        if np.any(np.diag(root) ** 2 < _SINGULAR):
            return None, -math.inf
        return np.linalg.inv(root) / length, 2.0 * float(np.sum(np.log(np.diag(root) * length)))


def _student(quadratic: float, scale: float, nu: float, n: float) -> float:
    """Return the log of Student's t density of n values, but for what does not depend on the model."""
    shape = math.lgamma(0.5 * (nu + n)) - math.lgamma(0.5 * nu)
    return shape - 0.5 * n * math.log(0.5 * nu * scale) - 0.5 * (nu + n) * math.log1p(quadratic / (nu * scale))


LEAST = 4.0
"""Difference of log densities below which it is small whatever its error (Sivula, Magnusson and Vehtari 2020)."""


@dataclass(frozen=True)
class Difference:
    """By how much one model predicts tests better than another.

    Attributes:
        total: difference of their scores.
        error: its standard error: how far the tests left out are from what the fit promises of each.
    """

    total: float
    error: float

    @property
    def sure(self) -> bool:
        """Whether one model is significantly better than the other: the rule of adoption."""
        return self.total > max(LEAST, 2.0 * self.error)


def difference(better: Score, worse: Score) -> Difference:
    """Return by how much one model predicts better than another."""
    each = better.left_out - worse.left_out
    promised = better.within - worse.within
    total = float(each.sum()) + better.log_prior - worse.log_prior
    return Difference(total, float(np.sqrt(np.sum((each - promised) ** 2))))
