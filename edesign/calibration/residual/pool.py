"""Samples of all tests together, each test over its rms force, and what parts of them a driver explains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import fdtrc

from edesign.calibration.residual.drivers import DRIVERS
from edesign.calibration.residual.motion import Motion
from edesign.calibration.residual.record import Residual

_FEWEST_BINS, _MOST_BINS, _PER_BIN = 6, 16, 8.0  # the last: effective samples


@dataclass(frozen=True)
class Part:
    """What coefficients of one regressor, one in each bin, explain of a residual.

    Attributes:
        coefficient: (b,).
        fitted: (n,).
        share: of the sum of squares, beyond one coefficient for all bins.
        whole: share with that one coefficient.
    """

    coefficient: np.ndarray
    fitted: np.ndarray
    share: float
    whole: float


class Pool:
    """Samples of all tests.

    Args:
        tests: residuals.
        motions: of each.
        effective_samples: of each; residuals are correlated, so chance explains more than their samples let one think.
        lag: of the measured force, s; what it changes is one of the things that are tried.
    """

    def __init__(
        self, tests: Sequence[Residual], motions: Sequence[Motion], effective_samples: Sequence[float], lag: float = 0.0
    ) -> None:
        self.error = np.concatenate([test.residual / test.rms_force for test in tests])
        self.predicted = np.concatenate([test.predicted / test.rms_force for test in tests])
        self.late = np.concatenate(
            [
                (np.interp(test.time - lag, test.time, test.predicted) - test.predicted) / test.rms_force
                for test in tests
            ]
        )
        self.lag = lag
        self.independent = max(float(np.sum(effective_samples)), 2.0)
        most = int(np.clip(self.independent / _PER_BIN, _FEWEST_BINS, _MOST_BINS))
        self.values, self.number = {}, {}
        for name, (_, driver) in DRIVERS.items():
            values = np.concatenate([driver(test, motion) for test, motion in zip(tests, motions, strict=True)])
            number = bins(values, most)
            if number.max() > 0:
                self.values[name], self.number[name] = values, number

    def chance(self, bins: int) -> float:
        """Share that so many bins explain of a residual which does not depend on them."""
        return min((bins - 1) / self.independent, 1.0)

    def p_value(self, share: float, bins: int) -> float:
        """Probability with which chance explains a share (F test)."""
        free = self.independent - bins
        if free < 1.0:
            return 1.0
        return float(fdtrc(bins - 1, free, share / max(1.0 - share, 1e-15) * free / (bins - 1)))

    def explained(self, error: np.ndarray, regressor: np.ndarray, number: np.ndarray) -> Part:
        """Least squares with a coefficient in each bin."""
        power = np.bincount(number, regressor**2)
        product = np.bincount(number, regressor * error)
        coefficient = np.divide(product, power, out=np.zeros_like(product), where=power > 0.0)
        common = float(np.sum(product)) / max(float(np.sum(power)), np.finfo(float).tiny)
        beyond = float(np.sum(power * (coefficient - common) ** 2))
        total = float(error @ error)
        share, whole = (
            min(part / total, 1.0) if total > 0.0 else 0.0 for part in (beyond, float(coefficient @ product))
        )
        return Part(coefficient, coefficient[number] * regressor, share, whole)


def bins(values: np.ndarray, most: int) -> np.ndarray:
    """Bin (n,) of each sample, from 0 without gaps: one for each value if there are few, else quantiles."""
    spread = float(np.ptp(values))
    if spread <= 1e-9 * float(np.max(np.abs(values))):
        return np.zeros(values.size, dtype=int)
    rounded = np.round(values / spread, 9)
    distinct = np.unique(rounded)
    edges = distinct[1:] if distinct.size <= most else np.unique(np.quantile(rounded, np.arange(1, most) / most))
    number = np.searchsorted(edges, rounded, side="right")
    seen = np.flatnonzero(np.bincount(number))
    return np.asarray(np.searchsorted(seen, number), dtype=int)
