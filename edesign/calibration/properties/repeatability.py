"""How well the rows of a property table repeat: from how smoothly they go over frequency and strain."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from edesign.calibration.properties.campaign import groups_of
from edesign.damper.testing.property_table import PropertyTable

QUANTITIES = ("G_storage", "G_eq", "loss_factor")
_MEDIAN = 0.6745  # of the absolute value of a standard normal number
_LEAST = 1e-4  # relative: no table is printed with more digits than that
_EFFICIENCY = 0.37  # of the median absolute value beside the root mean square, of normal numbers
_ALIKE = 1.6  # ratio of two estimates that chance may make
_FEW = 6  # differences below which a direction says nothing


def repeatability(table: PropertyTable) -> dict[str, float]:
    """Standard deviation of the relative error of each quantity that does not repeat from row to row.

    A row is compared with the straight line, in the logarithms, through its neighbours over frequency, and over strain.
    The median of what is left counts, so that single slips do not; of two directions that differ the smoother one, as
    true curvature only adds to it.
    """
    return {name: max(_of_both(_over(table, name)), _LEAST) for name in QUANTITIES}


def noise_of(table: PropertyTable) -> float:
    """One standard deviation for all quantities, relative: the root of their mean square.

    It is the upper end of its interval: noise that is taken for too small looks like something that is missing.
    """
    mean = float(np.sqrt(np.mean([value**2 for value in repeatability(table).values()])))
    independent = _EFFICIENCY * len(QUANTITIES) * len(table)
    return mean * (1.0 + 2.0 / math.sqrt(2.0 * independent))


def _of_both(found: list[float]) -> float:
    if not found:
        return _LEAST
    return float(np.sqrt(np.mean(np.square([value for value in found if value <= _ALIKE * min(found)]))))


def _over(table: PropertyTable, name: str) -> list[float]:
    none = np.zeros(len(table), dtype=bool)
    series = [group.rows for group in groups_of(table, none)]
    by_frequency = _scatter(np.log(table.frequency), np.log(getattr(table, name)), series)
    temperatures, _, frequencies = table.levels
    across = []
    for T in temperatures:
        for f in frequencies:
            rows = np.flatnonzero(
                (np.abs(table.temperature_C - T) <= 1.0) & (np.abs(table.frequency / f - 1.0) <= 0.03)
            )
            across.append(rows[np.argsort(table.strain[rows], kind="stable")])
    by_strain = _scatter(np.log(table.strain), np.log(getattr(table, name)), across)
    return [value for value in (by_frequency, by_strain) if value is not None]


def _scatter(x: np.ndarray, y: np.ndarray, series: Sequence[np.ndarray]) -> float | None:
    """Robust standard deviation of y of which each series (rows in order) has its own smooth course over x."""
    found: list[float] = []
    for rows in series:
        a, b, c = x[rows[:-2]], x[rows[1:-1]], x[rows[2:]]
        apart = (b > a) & (c > b)
        w = ((c - b) / np.where(apart, c - a, 1.0))[apart]
        values = y[rows[1:-1]][apart] - w * y[rows[:-2]][apart] - (1.0 - w) * y[rows[2:]][apart]
        found.extend((values / np.sqrt(1.0 + w**2 + (1.0 - w) ** 2)).tolist())
    return float(np.median(np.abs(found)) / _MEDIAN) if len(found) >= _FEW else None
