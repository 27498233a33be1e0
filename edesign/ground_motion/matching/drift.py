"""No drift: the motion that matching adds ends at rest, where it began."""

from __future__ import annotations

import numpy as np
from numpy.polynomial import legendre

from edesign.ground_motion.intensity import displacement, velocity

_WAVELENGTHS = 2.5  # what is removed is longer than this many longest matching periods
_FEWEST, _MOST = 4, 12  # terms: two are spent on the end conditions; twelve stay well conditioned
_FIT_SAMPLES = 500  # enough for polynomials of degree 15


class DriftCorrection:
    """Correction of an added motion: no slow wandering, and no velocity and displacement at the end of the sum.

    The correction is a polynomial acceleration, zero at both ends. For the added motion it is, of all with as many
    terms, the one that leaves the displacement smallest in the mean square while it ends with zero velocity and zero
    displacement. What the original ends with is taken out by the two lowest terms alone, so that it keeps the
    displacement it was recorded with as far as it can. Nothing leaks out of the duration as with a filter, and the
    shortest wave in the correction is long against the periods to be matched, if the motion lasts at least five of the
    longest; four terms are the fewest, whose waves in a shorter motion are shorter.

    Source: least squares with constraints; for polynomial baselines of accelerograms see Chiu (1997), Bulletin of the
    Seismological Society of America 87(4), 932-944.
    """

    def __init__(self, samples: int, time_step: float, longest_period: float) -> None:
        """Prepare the correction of motions of one length.

        Args:
            time_step: s.
            longest_period: that must not be changed, s.
        """
        duration = (samples - 1) * time_step
        terms = int(np.clip(2.0 * duration / (_WAVELENGTHS * longest_period), _FEWEST, _MOST))
        x = np.linspace(0.0, 1.0, samples)
        window = x * (1.0 - x)
        self._time_step = time_step
        self._basis = np.array([window * legendre.legval(2.0 * x - 1.0, unit) for unit in np.eye(terms)])
        moved = np.array([displacement(term, time_step) for term in self._basis])
        ends = np.array([[velocity(term, time_step)[-1] for term in self._basis], moved[:, -1]])
        self._stride = max(1, samples // _FIT_SAMPLES)
        moved = moved[:, :: self._stride]
        self._size = np.linalg.norm(moved, axis=1)  # brings terms and conditions to order one
        self._moved = moved / self._size[:, None]
        ends = ends / self._size
        self._end_size = np.linalg.norm(ends, axis=1)
        self._ends = ends / self._end_size[:, None]
        self._system = np.block([[self._moved @ self._moved.T, self._ends.T], [self._ends, np.zeros((2, 2))]])

    def __call__(self, added: np.ndarray, original: np.ndarray) -> np.ndarray:
        """Return the added acceleration without drift.

        Args:
            added: shape (samples,), m/s2.
            original: what it is added to, shape (samples,), m/s2.
        """
        moved = displacement(added, self._time_step)
        fit = self._moved @ moved[:: self._stride]
        solution = np.linalg.solve(self._system, np.concatenate((fit, self._at_end(added, moved[-1]))))[:-2]
        left = self._at_end(original, displacement(original, self._time_step)[-1])
        solution[:2] += np.linalg.solve(self._ends[:, :2], left)
        return added - np.einsum("j,ji->i", solution / self._size, self._basis)

    def _at_end(self, motion: np.ndarray, moved: float) -> np.ndarray:
        """End velocity and displacement in the units of the conditions, shape (2,)."""
        return np.array([velocity(motion, self._time_step)[-1], moved]) / self._end_size
