"""Evaluation criteria J1 to J9 of the virtual real-time hybrid simulation benchmark problem."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError
from edesign.substructure.indicators.channels import channel, table, time_step
from edesign.substructure.indicators.correlation_delay import correlation
from edesign.substructure.indicators.untold import Untold, moving

FLOORS = 3
LARGEST_LAG = 49
"""Samples to which the benchmark looks for J1: its own at 4096 Hz, 12.0 ms."""


@dataclass(frozen=True)
class BenchmarkCriteria:
    """Evaluation criteria of the benchmark problem; NaN with a reason where one cannot be told.

    x_m is the measured displacement, x_n and x_r are those of the floors in the numerical part and in the reference.
    `norm(a, b)` is the standard deviation of a - b over that of b, `peak(a, b)` the largest |a - b| over largest |b|.

    Attributes:
        j1: delay of x_m against x_n1, ms: the lag, in whole samples from 0 on, of largest correlation coefficient.
        j2: norm(x_m, x_n1), %: tracking.
        j3: peak(x_m, x_n1), %: tracking.
        j4: norm(x_m, x_r1), %: floor 1 against the reference.
        j5: peak(x_m, x_r1), %: floor 1 against the reference.
        j6: norm(x_n2, x_r2), %: floor 2.
        j7: norm(x_n3, x_r3), %: floor 3.
        j8: peak(x_n2, x_r2), %: floor 2.
        j9: peak(x_n3, x_r3), %: floor 3.
        untold: why a criterion is NaN, by its name.

    Source: Silva, Gomez, Maghareh, Dyke & Spencer (2020), Benchmark control problem for real-time hybrid simulation,
    MSSP 135; definitions as in the released evaluation file, which rounds J1 to 0.1 ms and the others to 0.01 %.
    """

    j1: float
    j2: float
    j3: float
    j4: float
    j5: float
    j6: float
    j7: float
    j8: float
    j9: float
    untold: dict[str, str] = field(default_factory=dict)


def benchmark_criteria(
    measured: ArrayLike, floors: ArrayLike, reference: ArrayLike, step: float, largest_lag: int = LARGEST_LAG
) -> BenchmarkCriteria:
    """Evaluate a run of the benchmark problem.

    Args:
        measured: x_m (n,) of the specimen at floor 1, m.
        floors: (n, 3) displacements of the numerical part, m; the first is the target.
        reference: (n, 3) displacements of the structure in one piece, m.
        step: s.
        largest_lag: of J1, samples.

    Raises:
        InputError: shapes that differ, NaN, a step or lag out of range.
    """
    x_m = channel("measured", measured)
    x_n = table("floors", floors, FLOORS, x_m.size)
    x_r = table("reference", reference, FLOORS, x_m.size)
    if not 1 <= largest_lag <= x_m.size - 3:
        raise InputError(
            f"largest_lag = {largest_lag} samples is out of range: 1 to {x_m.size - 3} is allowed, three samples less "
            f"than the record has"
        )
    time_step(step)
    criteria: dict[str, Callable[[], float]] = {
        "j1": lambda: 1000.0 * step * _lag(x_n[:, 0], x_m, largest_lag),
        "j2": lambda: _norm(x_m, x_n[:, 0]),
        "j3": lambda: _peak(x_m, x_n[:, 0]),
        "j4": lambda: _norm(x_m, x_r[:, 0]),
        "j5": lambda: _peak(x_m, x_r[:, 0]),
        "j6": lambda: _norm(x_n[:, 1], x_r[:, 1]),
        "j7": lambda: _norm(x_n[:, 2], x_r[:, 2]),
        "j8": lambda: _peak(x_n[:, 1], x_r[:, 1]),
        "j9": lambda: _peak(x_n[:, 2], x_r[:, 2]),
    }
    values, untold = {}, {}
    for name, criterion in criteria.items():
        try:
            values[name] = criterion()
        except Untold as reason:
            values[name], untold[name] = math.nan, str(reason)
    return BenchmarkCriteria(**values, untold=untold)


def _lag(target: np.ndarray, measured: np.ndarray, largest: int) -> int:
    """Samples of the largest correlation coefficient from 0 to `largest`."""
    moving("target", float(np.ptp(target)))
    moving("measured", float(np.ptp(measured)))
    coefficients = [correlation(target, measured, lag) for lag in range(largest + 1)]
    best = int(np.argmax(coefficients))
    if best == largest:
        raise Untold(f"the correlation still grows at the largest lag of {largest} samples")
    return best


def _norm(value: np.ndarray, basis: np.ndarray) -> float:
    moving("reference", float(np.ptp(basis)))
    return 100.0 * float(np.std(value - basis) / np.std(basis))


def _peak(value: np.ndarray, basis: np.ndarray) -> float:
    largest = float(np.max(np.abs(basis)))
    if largest == 0.0:
        raise Untold("the channel to compare with is zero throughout")
    return 100.0 * float(np.max(np.abs(value - basis))) / largest
