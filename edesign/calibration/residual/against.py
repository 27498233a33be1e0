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
        share: of the sum of squares that the means explain (eta squared), beyond the mean (force) or the factor
            (factor) of all bins, so that what is the same everywhere counts for no driver.
        chance: mean share that they would explain of a residual which does not depend on the driver.
    """

    driver: str
    unit: str
    way: Way
    centre: np.ndarray
    mean: np.ndarray
    share: float
    chance: float


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
            chance = pool.chance(count.size)
            found.append(Dependence(driver, DRIVERS[driver][0], way, centre, part.coefficient, part.share, chance))
    return tuple(found)
