"""The amplitudes of the wavelets: damped least squares, reweighted, with the peaks changing places."""

from __future__ import annotations

import numpy as np
import scipy

_ROUNDS, _CUTS = 2, 4
_ENOUGH = 0.99
_FRACTIONS = (1.0, 0.6, 0.3, 0.1)  # of a change of amplitudes, the best is taken
_HEAVIEST = 4.0  # weight of an ordinate that stays behind
POWER = 4.0  # of the mean that is brought down: higher than 2, so that no ordinate stays far behind


def badness(error: np.ndarray) -> float:
    """Return the power mean of the errors of all ordinates.

    Args:
        error: (m,) of any sign.
    """
    return float(np.mean(np.abs(error) ** POWER) ** (1.0 / POWER))


def amplitudes(matrix: np.ndarray, missing: np.ndarray, first: np.ndarray, damping: float) -> np.ndarray:
    """Return amplitudes b that make the errors of the ordinates small, as far as responses are linear.

    The error of an ordinate is that of its largest peak, matrix b - missing. In each round least squares act on the
    largest peaks and on all that exceed their target, with weights that grow with the error, and with damping^2 |b|^2
    (Levenberg): of all changes that mend the spectrum equally well, the smallest. Then it is looked which peaks are now
    the largest.

    Args:
        matrix: change of the peaks over their targets per unit amplitude, shape (m, n).
        missing: of each peak, 1 - |peak|/target, shape (m,).
        first: index of the first peak of each ordinate; those of one ordinate stand together, shape (n_o,).
        damping: dimensionless.

    Returns:
        shape (n,).
    """
    gram = matrix @ matrix.T
    count = np.diff(np.append(first, missing.size))
    force = np.zeros(missing.size)  # b = matrix.T force
    error = -missing
    exceeding = error > 0.0
    worth = badness(np.maximum.reduceat(error, first))
    for _ in range(_ROUNDS):
        largest = np.maximum.reduceat(error, first)
        scale = np.sqrt(np.mean(largest**2))
        leading = error == np.repeat(largest, count)
        for _ in range(_CUTS):
            at = np.flatnonzero(leading | exceeding)
            weight = np.minimum(1.0 + (0.5 * error[at] / scale) ** 2, _HEAVIEST)
            system = gram[np.ix_(at, at)]
            system[np.diag_indices_from(system)] += (damping / weight) ** 2
            change = -force
            change[at] += scipy.linalg.solve(system, missing[at], assume_a="pos", overwrite_a=True, check_finite=False)
            moved = gram @ change
            known = int(np.count_nonzero(exceeding))
            exceeding |= error + moved > 0.0
            if np.count_nonzero(exceeding) == known:
                break
        tried = [badness(np.maximum.reduceat(error + f * moved, first)) for f in _FRACTIONS]
        best = int(np.argmin(tried))
        if tried[best] > _ENOUGH * worth:
            break
        force += _FRACTIONS[best] * change
        error += _FRACTIONS[best] * moved
        worth = tried[best]
    return np.asarray(matrix.T @ force)
