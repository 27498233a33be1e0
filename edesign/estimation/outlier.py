"""The test that agrees least with the others: what it leaves, left out, beside what these leave of each other.

The excess of a test is what it leaves, left out, beyond the noise of its channels, as a share of the size of what was
measured. Each pair of tests i and j is left out of the fit, so that both are predicted by as many:

    e = (q - 1) w/P        t_i^2 = min over j of e_i|-ij / (A_i + B_i)        B_i = mean over j of max(e_j|-ij, 0)

q is the mean square in units of the noise, freed of what the others do not determine; w and P are the variance of the
noise and the mean square of the measured values. A_i is how far the noise is known, with ten degrees of freedom, and
B_i the scatter from test to test, with T - 2. Those of their sum are Satterthwaite's. The largest of T ratios has
Bonferroni's bound. Where a model has a fault in test i, B_i is the mean of e_j|-j beside it: test i without its fault
says of the law what few other tests do not.

Sources: Cook and Weisberg (1982), Residuals and influence in regression, section 2.2 (the largest of all externally
studentized residuals); Chow (1960), Econometrica 28, 591-605 (tests predicted by a fit without them); Satterthwaite
(1946), Biometrics Bulletin 2, 110-114.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.estimation.least_squares import Fit
from edesign.estimation.left_out import PRIOR_FREEDOM, Linear, without
from edesign.estimation.noise import Noise

_CHANCE = 0.01  # with which one of all tests may seem not to agree with the others
_FEWEST = 3  # tests: of two that differ either one may be wrong


@dataclass(frozen=True)
class Outlier:
    """The test that agrees least with the others.

    Attributes:
        test: index of it.
        ratio: Student's t of what it leaves, left out, beside the noise and what the others leave of each other.
        chance: of such a ratio in one of all tests, at most.
        evaluations: sets of parameters for which tests were predicted.
    """

    test: int
    ratio: float
    chance: float
    evaluations: int = 0

    @property
    def sure(self) -> bool:
        """Whether chance makes one like it in less than one of a hundred campaigns."""
        return self.chance < _CHANCE


def outlier(fitted: Fit, noise: Noise, explained: tuple[int, Fit] | None = None) -> Outlier | None:
    """Return the test that agrees least with the others; None: there are less than three.

    Args:
        noise: of the channels alone.
        explained: the one test that is asked about, and a fit with a fault in it, beside which the others are compared.
    """
    from scipy.special import stdtr  # scipy takes time at the start of every command

    tests, here = len(fitted.predicted), Linear.of(fitted, noise, None)
    if tests < _FEWEST:
        return None
    share = [1.0 / (noise.weight(i) ** 2 * float(np.mean(y**2))) for i, y in enumerate(fitted.model.measured)]
    found, evaluations = list[Outlier](), 0

    def excess(at: Linear, test: int, *others: int) -> float:
        """Return what a test leaves of a fit to all but it and others; nan: these do not determine it."""
        step = at.step(test, *others)
        if step is None:
            return math.nan
        square = at.predicted(test, step, *others)[0] / noise.independent(test, fitted.predicted[test].size)
        return (square - 1.0) * share[test]

    for i in range(tests) if explained is None else explained[:1]:
        at, _, spent = without(here, fitted, noise, None, i)
        evaluations += spent
        rest = [j for j in range(tests) if j != i]
        own = min(excess(at, i, j) for j in rest)
        if explained is None:
            others = [max(excess(at, j, i), 0.0) for j in rest]
        else:
            there = Linear.of(explained[1], noise, None)
            apart = [without(there, explained[1], noise, None, j) for j in rest]
            evaluations += sum(one[2] for one in apart)
            others = [max(excess(one[0], j), 0.0) for one, j in zip(apart, rest, strict=True)]
        known = math.sqrt(2.0 / PRIOR_FREEDOM) * share[i]
        scatter = sum(others) / len(others)
        freedom = (known + scatter) ** 2 / (known**2 / PRIOR_FREEDOM + scatter**2 / (len(others) - 1.0))
        ratio = math.sqrt(max(own, 0.0) / (known + scatter))
        if math.isfinite(ratio):
            found.append(Outlier(i, ratio, min(1.0, 2.0 * tests * float(stdtr(freedom, -ratio)))))
    least = min(found, key=lambda one: one.chance, default=None)
    return None if least is None else Outlier(least.test, least.ratio, least.chance, evaluations)
