"""Points and weights of integration along members."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np


def gauss_lobatto(points: int) -> tuple[np.ndarray, np.ndarray]:
    """Return places and weights of Gauss-Lobatto on 0..1, (points,) each.

    Source: Abramowitz & Stegun, 25.4.32: the ends and the roots of the derivative of the Legendre polynomial.
    """
    polynomial = np.polynomial.legendre.Legendre.basis(points - 1)
    places = np.concatenate(([-1.0], np.sort(polynomial.deriv().roots().real), [1.0]))
    weights = 2.0 / (points * (points - 1) * polynomial(places) ** 2)
    return 0.5 * (places + 1.0), 0.5 * weights


def piecewise_lobatto(points: int, breaks: Sequence[float]) -> tuple[list[float], list[float]]:
    """Return places and weights of Gauss-Lobatto in each part between breaks, as shares of the whole.

    Two parts share the point between them, where both have the same forces.

    Args:
        breaks: rising, between 0 and 1.
    """
    places, weights = [0.0], [0.0]
    own_places, own_weights = gauss_lobatto(points)
    for begin, end in pairwise((0.0, *breaks, 1.0)):
        weights[-1] += float(own_weights[0]) * (end - begin)
        places += [float(begin + place * (end - begin)) for place in own_places[1:-1]] + [end]
        weights += [float(weight) * (end - begin) for weight in own_weights[1:]]
    return places, weights
