"""The time by which a measured force is late against the predicted one."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.interpolate import CubicSpline

from edesign.calibration.residual.record import Residual
from edesign.calibration.residual.whiteness import effective_samples
from edesign.calibration.signals.noise import smooth

_STEPS, _ENOUGH = 8, 1e-4  # of Gauss-Newton; of a standard error


def find_lag(tests: Sequence[Residual]) -> float:
    """Return the lag with the least squared residual, s; above zero if the measured force is late.

    The residual is taken on the slope of the prediction, again and again with the shifted one. Each test counts by its
    rms force.
    """
    shapes = [_Shape(test) for test in tests]
    lag, best, step = 0.0, np.inf, 0.0
    for _ in range(_STEPS):
        pairs = [shape.shifted(lag + step) for shape in shapes]
        squares = sum(float(r @ r) for r, _ in pairs)
        if squares > best:
            step *= 0.5
            continue
        lag, best = lag + step, squares
        normal = sum(float(v @ v) for _, v in pairs)
        if normal <= 0.0 or squares <= 0.0:
            break
        scatter = sum(float(r @ r) * float(v @ v) / effective_samples(r) for r, v in pairs)
        step = -sum(float(r @ v) for r, v in pairs) / normal
        if abs(step) <= _ENOUGH * float(np.sqrt(scatter)) / normal:
            break
    return lag


class _Shape:
    """A test with its prediction as a spline without noise, over its rms force."""

    def __init__(self, test: Residual) -> None:
        self.time, self.measured = test.time, test.measured / test.rms_force
        predicted = test.predicted / test.rms_force
        clean = smooth(test.time, predicted)[0]
        self.rest = predicted - clean  # stays where it is
        self.spline = CubicSpline(test.time, clean)

    def shifted(self, lag: float) -> tuple[np.ndarray, np.ndarray]:
        """Residual and slope of the prediction at a lag."""
        at = np.clip(self.time - lag, self.time[0], self.time[-1])
        return self.measured - self.rest - self.spline(at), self.spline(at, 1)
