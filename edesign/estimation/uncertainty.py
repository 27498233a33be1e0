"""How sure estimated parameters are: by the scatter within tests and that from test to test; what is not determined."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.estimation.least_squares import Fit, triangle, weighted
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter, priors_of, ranges_of

LOOSE = 1e3
"""Ratio of singular values of slopes of unit length; beyond it a direction is undetermined: 1e6 in normal matrices."""
_LEVEL = 0.95  # of intervals
_CLUSTERS = 4  # fewest: of fewer tests, parts are taken
_DECADE = 0.5 * math.log(10.0)
_SMALLEST = 1e-9  # singular value, of the largest: what is below comes from errors of differences
_AMPLITUDES = np.geomspace(1e-4, 1.0, 60)
"""Of what equations may be wrong by, over which it is integrated: from nothing to all of what they stand for."""


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """Uncertainty of the coordinates of a fitted model; those at a bound count as known.

    Two scatters determine it. Within tests, residuals are noise. From test to test, the estimate moves by what each
    test pulls at it, which also holds what the model lacks in some tests. The larger one counts. Where the equations of
    the model may be wrong, the estimate is off by as much as that moves it: by what the residual leaves possible.

    Attributes:
        parameters: (p,) of the model.
        z: (p,) coordinates.
        within: (p, p) covariance by the scatter within tests, each with its own variance.
        freedom: degrees of freedom of that scatter.
        pulls: (clusters, p) by how much each test, or block, moves the coordinates, about their mean.
        loose: (p,) share of each coordinate's variance that lies in directions which the tests do not determine.
        condition: ratio of the singular values of the slopes, with columns of unit length.
        moved: (p, p) mean square of what errors of the equations move the coordinates by.

    Sources: Liang and Zeger (1986), Biometrika 73, 13-22 (covariance A^-1 (sum g_i g_i') A^-1 by clusters); Bester,
    Conley and Hansen (2011), J. Econometrics 165, 137-151 (with the factor T/(T - 1), Student's t with T - 1 degrees of
    freedom holds for few clusters too); Kennedy and O'Hagan (2001), J. R. Statist. Soc. B 63, 425-464 (equations that
    may be wrong); Gelman (2006), Bayesian Analysis 1, 515-533 (half-Cauchy prior of an amplitude).
    """

    parameters: tuple[Parameter, ...]
    z: np.ndarray
    within: np.ndarray
    freedom: float
    pulls: np.ndarray
    loose: np.ndarray
    condition: float
    moved: np.ndarray

    @property
    def between(self) -> np.ndarray:
        """Covariance (p, p) by the scatter from test to test."""
        return self.pulls.T @ self.pulls * len(self.pulls) / max(len(self.pulls) - 1, 1)

    def standard_error(self, weights: np.ndarray) -> float:
        """Return the standard error of the sum of the coordinates times weights (p,)."""
        return math.sqrt(max(0.0, *(float(weights @ (c + self.moved) @ weights) for c in (self.within, self.between))))

    def half_width(self, weights: np.ndarray, joint: int = 1) -> float:
        """Return half the width of the 95 % interval of that sum.

        Args:
            weights: (p,).
            joint: how many coordinates the weights were chosen for, so that the sum is the surest one (Scheffe).
        """
        from scipy.special import chdtri, fdtri  # scipy takes time at the start of every command

        of = (self.within, self.freedom), (self.between, max(len(self.pulls) - 1.0, 1.0))
        squares = [joint * float(weights @ c @ weights * fdtri(joint, nu, _LEVEL)) for c, nu in of]
        return math.sqrt(max(0.0, *squares) + float(weights @ self.moved @ weights * chdtri(joint, 1.0 - _LEVEL)))

    def interval(self, index: int) -> tuple[float, float]:
        """Return the 95 % interval of a parameter, SI, inside its bounds; one at a bound has that alone."""
        width, one = self.half_width(np.eye(self.z.size)[index]), self.parameters[index]
        return one.value(self.z[index] - width), one.value(self.z[index] + width)

    def determined(self, index: int) -> bool:
        """Return whether the tests determine a parameter: it is not loose, and a logarithm is known to a decade."""
        one, width = self.parameters[index], self.half_width(np.eye(self.z.size)[index])
        return bool(self.loose[index] < 0.5 and not (one.logarithmic and width * one.spread > _DECADE))


def uncertainty(
    fitted: Fit,
    noise: Noise | None = None,
    blocks: Sequence[int] | None = None,
    size_of: range = range(0),
    wrong: Sequence[np.ndarray] | None = None,
    share: float = 1.0,
) -> Uncertainty:
    """Return the uncertainty of a fit.

    Args:
        fitted: model with its parameters.
        noise: of the tests; None: that of the fit.
        blocks: of each test, whose scatter then stands for that from test to test; None: whole tests, of less than four
            halves, thirds or quarters.
        size_of: indices of the parameters of an effect whose size, the first one, is asked for: how much there is, not
            of what shape. The others are then taken as known, and the size is not, even at a bound.
        wrong: columns (n_i, k) of each test by which the equations of the model may be wrong: what they stand for, in
            all. Their shares, the same in all tests, have the prior N(0, amplitude^2). None: none.
        share: median of the amplitude by its prior, which is half-Cauchy, up to 1.
    """
    noise = noise or fitted.noise
    beside = wrong or [np.zeros((f.size, 0)) for f in fitted.predicted]
    p = fitted.z.size
    both = [np.hstack(each) for each in zip(fitted.slopes, beside, strict=True)]
    here = weighted(fitted.model, noise, fitted.values, fitted.predicted, both)
    asked = fitted.free.copy()
    asked[size_of] = np.arange(len(size_of)) == 0
    index = np.flatnonzero(asked)
    slopes, residuals = [j[:, index] for j in here.slopes], here.residuals
    prior = priors_of(fitted.model.parameters)[index]
    data = triangle(*slopes, np.zeros((index.size, index.size)))
    whole = triangle(*slopes, np.diag(np.sqrt(prior)))
    spread, _ = _inverse(whole)
    inverse, ratios = _inverse(data)
    samples = np.array([noise.independent(i, r.size) for i, r in enumerate(residuals)])
    freedom = max(float(samples.sum() - np.sum((data @ spread) ** 2)), 1.0)
    sizes = [np.sqrt(float(r @ r) / n * samples.sum() / freedom) for r, n in zip(residuals, samples, strict=True)]
    parts = blocks or [math.ceil(_CLUSTERS / len(slopes))] * len(slopes)
    cut = [
        part_j.T @ part_r
        for r, j, n in zip(residuals, slopes, parts, strict=True)
        for part_r, part_j in zip(np.array_split(r, n), np.array_split(j, n), strict=True)
    ]
    pulls, within, moved = np.zeros((len(cut), p)), np.zeros((p, p)), np.zeros((p, p))
    loose, lost = np.zeros(p), ratios * LOOSE < 1.0
    each = np.array(cut) @ spread @ spread.T
    pulls[:, index] = each - each.mean(axis=0)
    scatter = triangle(*(size * j for size, j in zip(sizes, slopes, strict=True)), np.diag(np.sqrt(prior))) @ spread
    undetermined = np.diag(np.maximum(1.0 - np.sum((whole @ spread) ** 2, axis=0), 0.0)) * np.mean(np.square(sizes))
    within[np.ix_(index, index)] = spread @ (scatter.T @ scatter + undetermined) @ spread.T
    loose[index] = np.sum(inverse[:, lost] ** 2, axis=1) / np.maximum(np.sum(inverse**2, axis=1), 1e-300)
    condition = 1.0 / max(float(ratios.min(initial=1.0)), 1e-300)
    if beside[0].shape[1]:
        j, c, r = np.vstack(slopes), np.vstack([one[:, p:] for one in here.slopes]), np.concatenate(residuals)
        shift = -spread @ (spread.T @ (j.T @ c))
        pull = j.T @ r + prior * fitted.z[index]
        shares = _shares(c.T @ (c + j @ shift), -(c.T @ r + shift.T @ pull), share)
        moved[np.ix_(index, index)] = shift @ shares @ shift.T
    return Uncertainty(fitted.model.parameters, fitted.z, within, freedom, pulls, loose, condition, moved)


def _shares(precision: np.ndarray, pull: np.ndarray, share: float) -> np.ndarray:
    """Return the mean squares and products (k, k) of shares b of columns, whose amplitude a the tests show.

    Args:
        precision: (k, k) of b by the tests, parameters fitted beside.
        pull: (k,) precision times the best b.
        share: scale of the half-Cauchy prior of a, its median.
    """
    squares, vectors = np.linalg.eigh(precision)
    seen, found = np.maximum(squares, 0.0), pull @ vectors
    a2 = _AMPLITUDES[:, np.newaxis] ** 2
    variance = a2 / (1.0 + a2 * seen)
    log = 0.5 * np.sum(variance * found**2 - np.log1p(a2 * seen), axis=1)
    log += np.log(_AMPLITUDES) - np.log1p((_AMPLITUDES / share) ** 2)  # their steps are logarithmic
    odds = np.exp(log - log.max())
    means = variance * found
    squared = np.einsum("a,aj,ak->jk", odds, means, means) + np.diag(odds @ variance)
    return np.asarray(vectors @ squared @ vectors.T / odds.sum())


def at_bounds(fitted: Fit) -> tuple[str, ...]:
    """Return "lower", "upper" or "" of each parameter: the bound at which it stands."""
    low, high = ranges_of(fitted.model.parameters)
    nearer, inside = fitted.z - low < high - fitted.z, fitted.free | (np.arange(fitted.z.size) < fitted.held)
    return tuple("" if off else "lower" if one else "upper" for off, one in zip(inside, nearer, strict=True))


def _inverse(root: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return S (p, p) with (R'R)^-1 = S S', and singular values of R with columns of unit length.

    Directions that R does not determine have a large variance instead of none.
    """
    length = np.linalg.norm(root, axis=0)
    length[length == 0.0] = 1.0
    _, singular, vectors = np.linalg.svd(root / length, full_matrices=False)
    largest = max(float(singular.max(initial=0.0)), 1e-150)
    spread = vectors.T / length[:, np.newaxis] / np.maximum(singular, _SMALLEST * largest)
    return spread, singular / largest
