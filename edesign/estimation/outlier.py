"""The test that agrees least with the others: what it leaves, left out, beside what these leave of each other.

Each pair of tests i and j is left out of the fit, so that both are predicted by as many. What a test then leaves beyond
the noise of its channels, as a share of the size of what was measured, is asked twice. One is all of it, the other the
part q_s along its m slopes, in which it says something else of the parameters than the others do:

    e   = (q/n - 1) w/P        A   = sqrt(2/10) w/P                    t^2 = min over j of e_i|-ij / A_i
    e_s = (q_s - m) w/(n P)    A_s = sqrt(2 m + 2 m^2/10) w/(n P)      t_s^2 = min over j of e_s,i|-ij / (A_s,i + B_i)
                                                                     B_i = mean over j of max(e_s,j|-ij, 0)

q is the square of n samples in units of the noise, freed of what the others do not determine; w and P are the variance
of the noise and the mean square of the measured values. A is how far the noise is known, with ten degrees of freedom.
B_i is the scatter from test to test, and has T - 2: of three tests, two agree by chance one time in a hundred to
1/190 of what the third is off by. The less sure one of both counts. The largest of T ratios has Bonferroni's bound.
Where a model has a fault in test i, B_i is the mean of e_s,j|-j beside it: test i without its fault says of the law
what few other tests do not.

Sources: Cook and Weisberg (1982), Residuals and influence in regression, section 2.2 (the largest of all externally
studentized residuals); Chow (1960), Econometrica 28, 591-605 (tests predicted by a fit without them).
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
_SEEN = 1e-10  # eigenvalue of normal matrices with ones on the diagonal: a direction in which a test has slopes


@dataclass(frozen=True)
class Outlier:
    """The test that agrees least with the others.

    Attributes:
        test: index of it.
        ratio: Student's t of what it leaves along its slopes, beside noise and what the others leave of each other.
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
    samples = np.array([f.size for f in fitted.predicted])
    share = np.array([noise.variance[i] / float(y @ y) for i, y in enumerate(fitted.model.measured)])
    found, evaluations = list[Outlier](), 0

    def excess(at: Linear, test: int, *others: int) -> np.ndarray:
        """Return what a test leaves of a fit to all but it and others, and of that the part along its slopes.

        It is nan where these do not determine it.
        """
        step = at.step(test, *others)
        if step is None:
            return np.full(2, math.nan)
        square, along, seen = at.predicted(test, step, *others)[0], *_along(at, test, step)
        return np.array([square - samples[test], square - at.power(step)[test] + along - seen]) * share[test]

    for i in range(tests) if explained is None else explained[:1]:
        at, _, spent = without(here, fitted, noise, None, i)
        evaluations += spent
        rest = [j for j in range(tests) if j != i]
        whole, part = np.min([excess(at, i, j) for j in rest], axis=0)
        if explained is None:
            others = [excess(at, j, i)[1] for j in rest]
        else:
            there = Linear.of(explained[1], noise, None)
            apart = [without(there, explained[1], noise, None, j) for j in rest]
            evaluations += sum(one[2] for one in apart)
            others = [excess(one[0], j)[1] for one, j in zip(apart, rest, strict=True)]
        scatter = float(np.mean(np.maximum(others, 0.0)))
        free = np.array([samples[i], _along(at, i, at.start)[1]])
        known = np.sqrt(2.0 * free**2 / PRIOR_FREEDOM + [0.0, 2.0 * free[1]]) * share[i]
        ratios = np.sqrt(np.maximum([whole, part], 0.0) / np.maximum(known + [0.0, scatter], 1e-300))
        if np.isfinite(ratios).all():
            chance = 2.0 * tests * float(np.max(stdtr([PRIOR_FREEDOM, tests - 2.0], -ratios)))
            found.append(Outlier(i, float(ratios[1]), min(1.0, chance)))
    least = min(found, key=lambda one: one.chance, default=None)
    return None if least is None else Outlier(least.test, least.ratio, least.chance, evaluations)


def _along(at: Linear, test: int, step: np.ndarray) -> tuple[float, int]:
    """Return the square of what a test leaves along its slopes after a step, and how many directions these have."""
    length = np.sqrt(np.maximum(np.diag(at.normals[test]), 1e-300))
    values, vectors = np.linalg.eigh(at.normals[test] / np.outer(length, length))
    seen = values > _SEEN * max(float(values.max(initial=0.0)), 1e-300)
    pull = ((at.pulls[test] + at.normals[test] @ step) / length) @ vectors[:, seen]
    return float(np.sum(pull**2 / values[seen])), int(seen.sum())
