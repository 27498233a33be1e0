"""How sure the parameters of a fitted model are: by the scatter within tests, and by that from test to test."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import chdtri, fdtri

from edesign.calibrate.fit import Fitted

_LEVEL = 0.95  # of the intervals
_PARTS = 4  # clusters of a single test
_DECADE = 0.5 * math.log(10.0)
"""Half the width of an interval of a logarithm beyond which it spans more than a decade."""
_AT_BOUND = 1e-9  # of the span: nearer a coordinate stands at its bound

Bound = Literal["", "lower", "upper"]


@dataclass(frozen=True, eq=False)
class Uncertainty:
    """Of the coordinates of a fitted model.

    Two scatters tell it. Within tests the residual is noise with a correlation. From test to test the estimate moves by
    what each test pulls at it, which also holds what the model lacks in some tests. The larger one counts: a parameter
    that one test alone tells has no scatter between tests, and a misfit that differs from test to test is no noise.

    Attributes:
        bounds: (p,) at which bound each coordinate stands.
        within: (p, p) covariance of the scatter within tests; zero for coordinates at a bound.
        pulls: (clusters, p) by how much each test moves the coordinates, about their mean.

    Sources: Liang & Zeger (1986), Biometrika 73, 13-22 (covariance A^-1 (sum g_i g_i') A^-1 by clusters); Bester,
    Conley & Hansen (2011), J. Econometrics 165, 137-151 (with the factor T/(T - 1), Student's t with T - 1 degrees of
    freedom holds for few clusters too).
    """

    bounds: tuple[Bound, ...]
    within: np.ndarray
    pulls: np.ndarray

    @staticmethod
    def of(fitted: Fitted, free: int | None = None) -> Uncertainty:
        """Of a fitted model.

        Args:
            fitted: the model.
            free: a coordinate that is not taken as held where it stands at a bound.
        """
        bounds = bounds_of(fitted)
        index = np.array([i for i, bound in enumerate(bounds) if not bound or i == free], dtype=int)
        size = len(bounds)
        within = np.zeros((size, size))
        inverse = np.linalg.pinv(fitted.hessian[np.ix_(index, index)]) if index.size else np.zeros((0, 0))
        within[np.ix_(index, index)] = inverse * fitted.misfit**2
        pulls = np.array([inverse @ (j[:, index].T @ r) for r, j in _clusters(fitted)])
        whole = np.zeros((len(pulls), size))
        whole[:, index] = pulls - pulls.mean(axis=0)
        return Uncertainty(bounds, within, whole)

    def standard_error(self, weights: np.ndarray) -> float:
        """Standard error of the sum of the coordinates times weights (p,)."""
        return max(self._within(weights), self._between(weights))

    def half_width(self, weights: np.ndarray, joint: int = 1) -> float:
        """Half the width of the 95 % interval of that sum.

        Args:
            weights: (p,).
            joint: how many coordinates the weights were chosen for, so that the sum is the one told best (Scheffe's
                interval).
        """
        few = float(fdtri(joint, max(len(self.pulls) - 1, 1), _LEVEL))
        many = float(chdtri(joint, 1.0 - _LEVEL)) / joint
        return math.sqrt(joint) * max(math.sqrt(many) * self._within(weights), math.sqrt(few) * self._between(weights))

    def _within(self, weights: np.ndarray) -> float:
        return math.sqrt(max(float(weights @ self.within @ weights), 0.0))

    def _between(self, weights: np.ndarray) -> float:
        own = self.pulls @ weights
        return math.sqrt(float(own @ own) * len(own) / max(len(own) - 1, 1))


def bounds_of(fitted: Fitted) -> tuple[Bound, ...]:
    """At which bound each coordinate of a model stands."""
    found: list[Bound] = []
    for unknown, x in zip(fitted.model.unknowns, fitted.x, strict=True):
        low, high = unknown.span
        near = _AT_BOUND * (high - low)
        found.append("lower" if x <= low + near else "upper" if x >= high - near else "")
    return tuple(found)


def wide(half_width: float, logarithmic: bool) -> bool:
    """Whether the interval of a coordinate spans more than a decade of its parameter."""
    return logarithmic and half_width > _DECADE


def _clusters(fitted: Fitted) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Residuals (n_i,) and slopes (n_i, p) of each test, or of the quarters of a single one."""
    if len(fitted.residuals) > 1:
        yield from zip(fitted.residuals, fitted.slopes, strict=True)
        return
    for r, j in zip(fitted.residuals, fitted.slopes, strict=True):
        yield from zip(np.array_split(r, _PARTS), np.array_split(j, _PARTS), strict=True)
