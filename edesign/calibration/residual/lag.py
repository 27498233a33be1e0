"""The time by which a measured force is late against the predicted one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from edesign.calibration.residual.record import Residual
from edesign.calibration.residual.whiteness import effective_samples
from edesign.calibration.signals.noise import smooth

_STEPS, _ENOUGH = 8, 1e-4  # of Gauss-Newton; of a standard error


@dataclass(frozen=True)
class Lag:
    """A lag in time.

    Attributes:
        value: s; above zero if the measured force is late.
        error: standard error, s, for residuals as correlated as those that the lag leaves.
        share: of the squared residual that it takes away.
        of_tests: value and standard error of each test by itself, (tests, 2) s. In one frequency a lag cannot be told
            from too little or too much damping; it is a lag if tests of all frequencies agree.
        spread: root mean square of the difference between tests and `value` over the error of each; about 1 if they
            agree.
    """

    value: float
    error: float
    share: float
    of_tests: np.ndarray
    spread: float


def find_lag(tests: Sequence[Residual]) -> Lag:
    """The lag with the least squared residual: residual on slope of the prediction, repeated with the shifted one.

    Each test counts by its rms force.
    """
    shapes = [_Shape(test) for test in tests]
    value, error, share = _fit(shapes)
    of_tests = np.array([_fit([shape])[:2] for shape in shapes])
    known = of_tests[:, 1] > 0.0
    ratio = (of_tests[known, 0] - value) / of_tests[known, 1]
    return Lag(value, error, share, of_tests, float(np.sqrt(np.mean(ratio**2))) if np.any(known) else 0.0)


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


def _fit(shapes: Sequence[_Shape]) -> tuple[float, float, float]:
    """Lag, standard error and share explained."""
    lag, best = 0.0, np.inf
    first = sum(float(np.sum(shape.shifted(0.0)[0] ** 2)) for shape in shapes)
    step, error = 0.0, 0.0
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
        error = float(np.sqrt(scatter)) / normal
        step = -sum(float(r @ v) for r, v in pairs) / normal
        if abs(step) <= _ENOUGH * error:
            break
    return lag, error, (first - best) / first if first > 0.0 else 0.0
