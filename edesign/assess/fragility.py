"""Lognormal fragility functions, P(limit passed | im) = Phi(ln(im / theta) / beta), from counts or from capacities.

Source: Baker (2015), "Efficient analytical fragility function fitting using dynamic structural analysis", Earthquake
Spectra 31(1), 579-599.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy  # its stats are loaded when they are asked for: that takes half a second
from numpy.typing import ArrayLike

from edesign.assess.probit import NOT_RISING, check_overlap, log_likelihood, probit
from edesign.errors import AnalysisError


@dataclass(frozen=True)
class Fragility:
    """A fitted lognormal fragility function.

    Attributes:
        theta: median, in the unit of the intensities.
        beta: standard deviation of the natural logarithm.
        theta_se, beta_se: their standard errors.
        count: observations that it is fitted to: analyses of all intensities, or capacities.
        censored: capacities that are only known to lie beyond the last intensity of their record.
        largest_difference: between observed fractions and the function.
        deviance: twice the lack of log-likelihood against the observed fractions themselves; None for capacities.
        p_value: probability of a larger deviance if the function were true; None for capacities and below three
            intensities.
    """

    theta: float
    beta: float
    theta_se: float
    beta_se: float
    count: int
    censored: int
    largest_difference: float
    deviance: float | None = None
    p_value: float | None = None

    def probability(self, intensity: ArrayLike) -> np.ndarray:
        """Return the probability that the limit is passed; 0 at intensity 0.

        Args:
            intensity: in the unit of theta, of any shape.

        Returns:
            The probability, in the shape of `intensity`.
        """
        im = np.asarray(intensity, dtype=float)
        with np.errstate(divide="ignore"):
            return np.asarray(scipy.special.ndtr(np.log(im / self.theta) / self.beta))


def fit_counts(intensity: ArrayLike, analyses: ArrayLike, passed: ArrayLike) -> Fragility:
    """Fit a fragility to the number of analyses at each intensity that pass a limit, by maximum likelihood.

    It is a probit regression on ln(im). Standard errors take the analyses as independent.

    Args:
        intensity: (n,) ascending, greater than zero; those without analyses do not count.
        analyses: (n,) number of analyses at each.
        passed: (n,) how many of them pass the limit.

    Raises:
        AnalysisError: the likelihood has no maximum: none or all pass, intensities at which some pass and at which some
            do not do not overlap, or the fraction does not rise with the intensity.

    Source: Baker (2015), Eqs. 9-11.
    """
    im, n, k = (np.asarray(values, dtype=float) for values in (intensity, analyses, passed))
    if im.shape != n.shape or im.shape != k.shape or im.ndim != 1:
        raise ValueError("intensity, analyses and passed need one value each for every intensity")
    if np.any(k > n) or np.any(k < 0.0) or np.any(np.diff(im, prepend=0.0) <= 0.0):
        raise ValueError("intensities are greater than zero and ascend, and of n analyses from 0 to n pass")
    check_overlap(n, k)
    im, n, k = im[n > 0.0], n[n > 0.0], k[n > 0.0]
    x = np.log(im)
    centre, spread = float(np.average(x, weights=n)), float(np.std(x))
    intercept, slope = probit((x - centre) / spread, n, k)
    if slope <= 0.0:
        raise AnalysisError(NOT_RISING)
    beta = spread / slope
    mu = centre - intercept * beta
    z = (x - mu) / beta
    p = scipy.special.ndtr(z)
    weight = (
        n * np.exp(2.0 * scipy.stats.norm.logpdf(z) - scipy.special.log_ndtr(z) - scipy.special.log_ndtr(-z)) / beta**2
    )
    information = np.array([[weight.sum(), (weight * z).sum()], [(weight * z).sum(), (weight * z**2).sum()]])
    variance = np.linalg.inv(information)
    deviance = 2.0 * (_saturated(n, k) - log_likelihood(z, n, k))
    freedom = im.size - 2
    theta = math.exp(mu)
    return Fragility(
        theta=theta,
        beta=beta,
        theta_se=theta * math.sqrt(variance[0, 0]),
        beta_se=math.sqrt(variance[1, 1]),
        count=int(n.sum()),
        censored=0,
        largest_difference=float(np.max(np.abs(k / n - p))),
        deviance=max(deviance, 0.0),
        p_value=float(scipy.stats.chi2.sf(deviance, freedom)) if freedom > 0 else None,
    )


def fit_capacities(capacity: ArrayLike, last: ArrayLike = math.inf) -> Fragility:
    """Fit a fragility to the intensity at which each record passes a limit.

    Without censored capacities theta and beta are the moments of their logarithms (sample standard deviation); with
    some they have the largest likelihood.

    Args:
        capacity: (n,) greater than zero; infinite where a record does not pass up to its intensity `last`.
        last: intensity up to which each record has results, (n,) or one for all; finite where the capacity is not.

    Raises:
        AnalysisError: fewer than two records pass, or all at the same intensity.

    Source: Baker (2015), Eqs. 2-3 (moments) and 6-7 (truncated incremental dynamic analysis), with a truncation of each
        record's own; the observed fractions are those of Kaplan and Meier (1958).
    """
    capacities = np.asarray(capacity, dtype=float)
    there = np.isfinite(capacities)
    x, missing = np.log(capacities[there]), int(np.sum(~there))
    if x.size < 2:
        raise AnalysisError(
            f"no fragility: {x.size} of {capacities.size} records pass the limit; two are needed [E-FRAG-01]"
        )
    if np.ptp(x) <= 1e-12 * max(1.0, float(np.max(np.abs(x)))):
        raise AnalysisError(
            "no fragility: all records pass the limit at the same intensity, which leaves beta undetermined [E-FRAG-01]"
        )
    beyond = np.log(np.broadcast_to(np.asarray(last, dtype=float), capacities.shape)[~there])
    if not np.all(np.isfinite(beyond)):
        raise ValueError("a record that does not pass needs the intensity up to which it has results")
    data = scipy.stats.CensoredData(uncensored=x, right=beyond)
    if missing == 0:
        mu, beta = float(np.mean(x)), float(np.std(x, ddof=1))
        mu_se, beta_se = beta / math.sqrt(x.size), beta / math.sqrt(2.0 * (x.size - 1))
    else:
        mu, beta = (float(value) for value in scipy.stats.norm.fit(data))
        mu_se, beta_se = _censored_errors(x, beyond, mu, beta)
    passing = np.unique(x)
    steps, p = scipy.stats.ecdf(data).cdf.evaluate(passing), scipy.special.ndtr((passing - mu) / beta)
    difference = max(np.max(np.abs(steps - p)), np.max(np.abs(np.append(0.0, steps[:-1]) - p)))
    theta = math.exp(mu)
    return Fragility(theta, beta, theta * mu_se, beta_se, capacities.size, missing, float(difference))


def collapse_margin_ratio(theta: float, level_intensity: float) -> float:
    """Return the median intensity of collapse divided by that of a hazard level.

    Args:
        level_intensity: intensity of the hazard level, in the same unit.

    Returns:
        The collapse margin ratio, dimensionless.

    Source: FEMA P-695 (2009), Eq. 1-1, there of the maximum considered earthquake.
    """
    return theta / level_intensity


def _saturated(n: np.ndarray, k: np.ndarray) -> float:
    """Log-likelihood of the observed fractions themselves, without the binomial coefficients."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.nansum(k * np.log(k / n)) + np.nansum((n - k) * np.log1p(-k / n)))


def _censored_errors(x: np.ndarray, beyond: np.ndarray, mu: float, beta: float) -> tuple[float, float]:
    """Standard errors of mean and standard deviation from the observed information of censored normal data."""
    z, c = (x - mu) / beta, (beyond - mu) / beta
    hazard = np.exp(scipy.stats.norm.logpdf(c) - scipy.special.log_ndtr(-c))
    slope = hazard * (hazard - c)
    information = (
        np.array(
            [
                [x.size + slope.sum(), 2.0 * z.sum() + (hazard + c * slope).sum()],
                [0.0, 3.0 * (z**2).sum() - x.size + (2.0 * c * hazard + c**2 * slope).sum()],
            ]
        )
        / beta**2
    )
    information[1, 0] = information[0, 1]
    variance = np.linalg.inv(information)
    return math.sqrt(variance[0, 0]), math.sqrt(variance[1, 1])
