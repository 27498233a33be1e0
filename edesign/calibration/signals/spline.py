"""Cubic splines of many histories on one grid of times: what depends on the times alone is done once."""

from __future__ import annotations

import numpy as np
from scipy.linalg.lapack import dgttrf, dgttrs

_LEAST = 4  # samples


class Spline:
    """Cubic splines through histories on one grid of times, not-a-knot at their ends.

    Three samples are interpolated by a parabola, two by a line.

    Source: de Boor, A Practical Guide to Splines, chapter IV.

    Args:
        time: (n,) s, rising.
    """

    def __init__(self, time: np.ndarray) -> None:
        self.time = time
        self._h = h = np.diff(time)
        if time.size < _LEAST:
            return
        self._left, self._right = h[:-1].copy(), h[1:].copy()
        main = np.concatenate(([h[1]], 2.0 * (h[:-1] + h[1:]), [h[-2]]))
        above = np.concatenate(([h[0] + h[1]], h[:-1]))
        below = np.concatenate((h[1:], [h[-2] + h[-1]]))
        self._factors = dgttrf(below, main, above)[:5]

    def slopes(self, values: np.ndarray) -> np.ndarray:
        """Return the derivatives (n,) of the spline through values.

        Args:
            values: (n,).
        """
        n = values.size
        if n < _LEAST:
            return np.asarray(np.gradient(values, self.time, edge_order=2 if n == 3 else 1) if n > 1 else np.zeros(n))
        h, chord = self._h, np.diff(values) / self._h
        right = np.empty(n)
        right[1:-1] = 3.0 * (self._right * chord[:-1] + self._left * chord[1:])
        for end, (a, b) in ((0, (0, 1)), (-1, (-1, -2))):
            both = h[a] + h[b]
            right[end] = ((h[a] + 2.0 * both) * h[b] * chord[a] + h[a] ** 2 * chord[b]) / both
        return np.asarray(dgttrs(*self._factors, right, overwrite_b=1)[0])

    def at(self, values: np.ndarray, times: np.ndarray) -> np.ndarray:
        """Return the spline through values at other times; beyond the ends the cubics go on.

        Args:
            values: (n,).
            times: (m,) s.
        """
        i = np.clip(np.searchsorted(self.time, times, side="right") - 1, 0, self.time.size - 2)
        h, slope, change = self._h[i], self.slopes(values), np.diff(values)[i]
        x, begin, end = (times - self.time[i]) / h, h * slope[i], h * slope[i + 1]
        return np.asarray(
            values[i] + x * (begin + x * (3.0 * change - 2.0 * begin - end + x * (begin + end - 2.0 * change)))
        )
