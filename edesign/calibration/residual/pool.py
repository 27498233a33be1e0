"""Samples of all tests together, each over its rms force, in bins of what a residual may depend on."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.special import fdtrc

from edesign.calibration.residual.cycles import Cycles
from edesign.calibration.residual.series import Residual

Driver = Callable[[Residual, Cycles], np.ndarray]
Action = Literal["force", "factor"]
_STILL = 0.01  # of the largest speed: no sign of the velocity below it
_FEWEST_BINS, _MOST_BINS, _PER_BIN = 6, 16, 8.0  # the last: effective samples


def _sign(test: Residual, motion: Cycles) -> np.ndarray:
    speed = np.abs(test.velocity)
    return np.where(speed > _STILL * np.max(speed), np.sign(test.velocity), 0.0)


def _energy(test: Residual, motion: Cycles) -> np.ndarray:
    work = 0.5 * (test.measured[1:] + test.measured[:-1]) * np.diff(test.displacement)
    return np.concatenate(([0.0], np.cumsum(work)))


def _path(test: Residual, motion: Cycles) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(np.abs(np.diff(test.displacement)))))


DRIVERS: dict[str, tuple[str, Driver]] = {
    "displacement": ("m", lambda test, motion: test.displacement),
    "velocity": ("m/s", lambda test, motion: test.velocity),
    "sign of velocity": ("", _sign),
    "cycle": ("", lambda test, motion: motion.half_cycles.number // 2 + 1.0),
    "amplitude": ("m", lambda test, motion: motion.half_cycles.amplitude),
    "frequency": ("Hz", lambda test, motion: motion.half_cycles.frequency),
    "temperature": ("degC", lambda test, motion: test.temperature),
    "dissipated energy": ("J", _energy),
    "path": ("m", _path),
    "time": ("s", lambda test, motion: test.time - test.time[0]),
    "test order": ("", lambda test, motion: np.full(test.time.size, float(test.order))),
}
"""Unit and values (n,) by name. Cycles, energy, path and time count from the beginning of each test."""


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
        effective_samples: of each; residuals are correlated, so chance explains more than their samples let one think.
        lag: of the measured force, s; what it changes is one of the things that are tried.
    """

    def __init__(
        self, tests: Sequence[Residual], motions: Sequence[Cycles], effective_samples: Sequence[float], lag: float = 0.0
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


@dataclass(frozen=True)
class Dependence:
    """A residual against one driver, all tests together.

    Attributes:
        driver: name in `drivers.DRIVERS`.
        unit: of the driver.
        action: `force`: the mean of the residual over the rms force of its test, as a force beside the law leaves it.
            `factor`: the residual as a share of the predicted force (least squares), as a factor on the law leaves it.
        centre: (b,) mean of the driver in each bin.
        mean: (b,) residual in each bin, of the rms force or of the predicted force.
        share: of the sum of squares that the means explain (eta squared), beyond the mean (force) or the factor
            (factor) of all bins, so that what is the same everywhere counts for no driver.
        chance: mean share that they would explain of a residual which does not depend on the driver.
    """

    driver: str
    unit: str
    action: Action
    centre: np.ndarray
    mean: np.ndarray
    share: float
    chance: float


def against(pool: Pool) -> tuple[Dependence, ...]:
    """Dependences on all drivers that change, as a force and as a factor."""
    found = []
    for driver, number in pool.number.items():
        count = np.bincount(number).astype(float)
        centre = np.bincount(number, pool.values[driver]) / count
        actions: tuple[tuple[Action, np.ndarray], ...] = (
            ("force", np.ones_like(pool.error)),
            ("factor", pool.predicted),
        )
        for action, regressor in actions:
            part = pool.explained(pool.error, regressor, number)
            chance = pool.chance(count.size)
            found.append(Dependence(driver, DRIVERS[driver][0], action, centre, part.coefficient, part.share, chance))
    return tuple(found)
