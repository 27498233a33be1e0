"""Residuals in bins of what they may depend on: as a force, and as a share of the predicted force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.calibration.residual.drivers import DRIVERS
from edesign.calibration.residual.pool import Pool

Way = Literal["force", "factor"]


@dataclass(frozen=True)
class Dependence:
    """A residual against one driver, all tests together.

    Attributes:
        driver: name in `drivers.DRIVERS`.
        unit: of the driver.
        way: `force`: the mean of the residual over the rms force of its test, as a force beside the law leaves it.
            `factor`: the residual as a share of the predicted force (least squares), as a factor on the law leaves it.
        centre: (b,) mean of the driver in each bin.
        mean: (b,) residual in each bin, of the rms force or of the predicted force.
        deviation: (b,) standard deviation about it, of the rms force.
        count: (b,) samples.
        share: of the sum of squares that the means explain (eta squared), beyond the mean (force) or the factor
            (factor) of all bins, so that what is the same everywhere counts for no driver.
        chance: mean share that they would explain of a residual which does not depend on the driver.
        p_value: probability with which it would be as large as it is.
    """

    driver: str
    unit: str
    way: Way
    centre: np.ndarray
    mean: np.ndarray
    deviation: np.ndarray
    count: np.ndarray
    share: float
    chance: float
    p_value: float


def against(pool: Pool) -> tuple[Dependence, ...]:
    """Dependences on all drivers that change, in both ways."""
    found = []
    for driver, number in pool.number.items():
        count = np.bincount(number).astype(float)
        centre = np.bincount(number, pool.values[driver]) / count
        ways: tuple[tuple[Way, np.ndarray], ...] = (
            ("force", np.ones_like(pool.error)),
            ("factor", pool.predicted),
        )
        for way, regressor in ways:
            part = pool.explained(pool.error, regressor, number)
            deviation = np.sqrt(np.bincount(number, (pool.error - part.fitted) ** 2) / count)
            found.append(
                Dependence(
                    driver,
                    DRIVERS[driver][0],
                    way,
                    centre,
                    part.coefficient,
                    deviation,
                    count.astype(int),
                    part.share,
                    pool.chance(count.size),
                    pool.p_value(part.share, count.size),
                )
            )
    return tuple(found)
