"""Probit regression of counts on one variable, by maximum likelihood."""

from __future__ import annotations

import numpy as np
import scipy  # its stats are loaded when they are asked for: that takes half a second

from edesign.errors import AnalysisError

MOST_ITERATIONS = 100
NOT_RISING = "no fragility: the fraction that passes the limit does not rise with the intensity [E-FRAG-02]"
_TOLERANCE = 1e-6  # of a step in standard errors; the one after it would be its square


def probit(x: np.ndarray, n: np.ndarray, k: np.ndarray) -> tuple[float, float]:
    """Return intercept and slope of P = Phi(intercept + slope x) with the largest likelihood.

    Newton's method; the likelihood is concave.

    Args:
        x: (m,) in any unit, best with mean 0 and deviation 1.
        n: (m,) observations at each.
        k: (m,) how many of them count.

    Returns:
        Intercept and slope.

    Raises:
        AnalysisError: the maximum was not reached; `check_overlap` says before whether there is one.
    """
    design = np.column_stack((np.ones_like(x), x))
    found = np.array([scipy.stats.norm.ppf((k.sum() + 0.5) / (n.sum() + 1.0)), 1.0])
    likelihood = log_likelihood(design @ found, n, k)
    for _ in range(MOST_ITERATIONS):
        eta = design @ found
        density = scipy.stats.norm.logpdf(eta)
        yes, no = np.exp(density - scipy.special.log_ndtr(eta)), np.exp(density - scipy.special.log_ndtr(-eta))
        curvature = k * yes * (yes + eta) + (n - k) * no * (no - eta)
        information = (design.T * curvature) @ design
        step = np.linalg.solve(information, design.T @ (k * yes - (n - k) * no))
        if float(step @ information @ step) <= _TOLERANCE**2:
            return float(found[0] + step[0]), float(found[1] + step[1])
        share = 1.0
        while (trial := log_likelihood(design @ (found + share * step), n, k)) < likelihood and share > 1e-6:
            share *= 0.5
        found, likelihood = found + share * step, trial
    raise AnalysisError(
        f"no fragility: the likelihood has not reached its maximum in {MOST_ITERATIONS} iterations [E-FRAG-02]"
    )


def check_overlap(n: np.ndarray, k: np.ndarray) -> None:
    """Check that intensities with and without passing overlap: the likelihood has a maximum only then.

    Places count from 1.

    Args:
        n: (m,) number of records at each intensity.
        k: (m,) how many of them pass the limit.

    Raises:
        AnalysisError: they do not overlap, or there are none.
    """
    yes, no, count = np.flatnonzero(k > 0.0) + 1, np.flatnonzero(k < n) + 1, n.size
    if not n.any():
        raise AnalysisError("no fragility: there are no analyses [E-FRAG-01]")
    if yes.size == 0:
        raise AnalysisError("no fragility: no analysis passes the limit; go to higher intensities [E-FRAG-01]")
    if no.size == 0:
        raise AnalysisError("no fragility: all analyses pass the limit; begin at lower intensities [E-FRAG-01]")
    first, last = yes.min(), no.max()
    if last <= first:
        where = f"none passes the limit up to intensity {last} of {count}, all from {first} on; theta lies between"
        if last == first:
            where = f"only at intensity {first} of {count} do some pass the limit and some not"
        raise AnalysisError(
            f"no fragility: {where}; beta cannot be determined without more intensities there [E-FRAG-01]"
        )
    if yes.max() <= no.min():
        raise AnalysisError(NOT_RISING)


def log_likelihood(eta: np.ndarray, n: np.ndarray, k: np.ndarray) -> float:
    """Return the binomial log-likelihood of the probit eta (m,), without the coefficients.

    Args:
        eta: (m,) probit.
        n: (m,) number of records at each intensity.
        k: (m,) how many of them pass the limit.
    """
    return float(np.sum(k * scipy.special.log_ndtr(eta) + (n - k) * scipy.special.log_ndtr(-eta)))
