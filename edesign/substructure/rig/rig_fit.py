"""Rigs of order 0, 1 and 2 fitted to a measured command and displacement by least squares on their response."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from edesign.calibration.residual.whiteness import effective_samples
from edesign.one_thread import one_thread
from edesign.project.substructure.quantities import MOST_DELAY
from edesign.substructure.judgement.measured import MeasuredRecord
from edesign.substructure.rig import rigs
from edesign.substructure.rig.rig_response import rig_response
from edesign.substructure.rig.rigs import RigTransfer

ORDERS = (0, 1, 2)
STIFFEST = 0.45
"""Highest own frequency over the sampling rate: just below half of it."""


@dataclass(frozen=True)
class Search:
    """Start, range and end of the search for a rig.

    Attributes:
        shares: of the whole delay that are not pure. One from each half, as the search goes from the better one.
        dampings: of second order, likewise: 0.4 overshoots by a quarter, 0.9 not at all.
        slowest: own frequency, Hz: with 20 s a period no rig follows an earthquake.
        lightest: damping: 0.02 of a bare steel frame; a controlled actuator has more.
        heaviest: damping: its two poles are 400 times apart, so that it is one of first order.
        settled: a step that lowers the sum of squares by less, in units of the noise, is the last one. A standard error
            of a parameter is worth 1, so that no parameter would move by more than a third of its own.
        longest: steps; a bound for searches along a valley, which other searches never come near.
    """

    shares: tuple[float, float] = (0.3, 0.8)
    dampings: tuple[float, float] = (0.4, 0.9)
    slowest: float = 0.05
    lightest: float = 0.02
    heaviest: float = 10.0
    settled: float = 0.1
    longest: int = 40


SEARCH = Search()


@dataclass(frozen=True)
class RigParameter:
    """A parameter of a rig with its standard error, both in `unit` (SI)."""

    value: float
    standard_error: float
    unit: str


@dataclass(frozen=True)
class RigFit:
    """A rig of one order, fitted to a record.

    Attributes:
        order: of the denominator.
        transfer: displacement over command.
        parameters: `delay`, `gain`, and `time_constant`, or `frequency` and `damping`.
        covariance: of the parameters (p, p), in their order, SI.
        low_frequency_delay: of slow motions, s.
        offset: of the displacement channel, m.
        noise: standard deviation of what is left, m.
        left: root of what is left over the displacement, sums of squares.
        independent: share of independent samples in what is left; 1 if it is white noise.
    """

    order: int
    transfer: RigTransfer
    parameters: dict[str, RigParameter]
    covariance: np.ndarray
    low_frequency_delay: RigParameter
    offset: float
    noise: float
    left: float
    independent: float


@dataclass(frozen=True)
class _Shape:
    """A rig of one order by the numbers that a search moves: delay over `late`, and logarithms of the others.

    Attributes:
        names: of the numbers, in their order.
        units: of them, SI.
        starts: rows to begin from.
        lower, upper: bounds.
        transfer: with gain 1, of the values in SI.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    starts: tuple[tuple[float, ...], ...]
    lower: tuple[float, ...]
    upper: tuple[float, ...]
    transfer: Callable[[Sequence[float]], RigTransfer]

    def values(self, x: np.ndarray, late: float) -> list[float]:
        """In SI, of the numbers of a search."""
        return [late * float(x[0]), *(math.exp(one) for one in x[1:])]


def _shape(order: int, late: float, step: float) -> _Shape:
    """The rig of an order whose delay in all is about `late`, s: a share of it pure, the rest of the order."""
    most = MOST_DELAY / late
    if order == 0:
        return _Shape(("delay",), ("s",), ((1.0,),), (0.0,), (most,), lambda v: rigs.pure_delay(v[0]))
    if order == 1:
        begun = tuple((1.0 - share, math.log(share * late)) for share in SEARCH.shares)
        names, bounds = ("delay", "time_constant"), (math.log(1e-2 * step), math.log(MOST_DELAY))
        return _Shape(
            names, ("s", "s"), begun, (0.0, bounds[0]), (most, bounds[1]), lambda v: rigs.first_order(v[1], v[0])
        )
    highest = math.log(STIFFEST / step)
    # share of the delay is zeta / (pi f)
    rows = [(share, zeta) for share in SEARCH.shares for zeta in SEARCH.dampings]
    starts: tuple[tuple[float, ...], ...] = tuple(
        (1.0 - share, min(math.log(zeta / (math.pi * share * late)), highest - 0.1), math.log(zeta))
        for share, zeta in rows
    )
    return _Shape(
        ("delay", "frequency", "damping"),
        ("s", "Hz", ""),
        starts,
        (0.0, math.log(SEARCH.slowest), math.log(SEARCH.lightest)),
        (most, highest, math.log(SEARCH.heaviest)),
        lambda v: rigs.second_order(v[1], v[2], v[0]),
    )


def fit_rig(record: MeasuredRecord, order: int, correlated: float) -> RigFit:
    """Find the rig of an order with the least squared error of its response; gain and offset follow linearly.

    Args:
        record: has command and displacement.
        order: one of `ORDERS`.
        correlated: delay by correlation, s, from which the search goes.
    """
    u, x, step = record["command"], record["displacement"], record.step
    late = max(correlated, step)
    shape = _shape(order, late, step)
    size = float(np.std(x))

    def response(values: Sequence[float]) -> np.ndarray:
        return rig_response(shape.transfer(values), u, step)

    def left(numbers: np.ndarray) -> np.ndarray:
        made = response(shape.values(numbers, late))
        gain, offset = _gain_and_offset(made, x)
        return np.asarray((x - gain * made - offset) / size)

    bounds = (np.array(shape.lower), np.array(shape.upper))
    starts = [np.clip(start, *bounds) for start in shape.starts]
    begin = min(starts, key=lambda start: float(np.sum(left(start) ** 2)))
    with one_thread():  # several get into each other's way with so small matrices
        best = scipy.optimize.least_squares(
            left, begin, bounds=bounds, x_scale="jac", ftol=SEARCH.settled / x.size, max_nfev=SEARCH.longest
        )
    values = shape.values(best.x, late)
    made = response(values)
    gain, offset = _gain_and_offset(made, x)
    residual = x - gain * made - offset
    independent = effective_samples(residual) / x.size
    errors, covariance = _errors(response, values, made, gain, residual, independent)
    known = [*zip(shape.names, values, errors, shape.units, strict=False), ("gain", gain, errors[-2], "")]
    unscaled = shape.transfer(values)
    return RigFit(
        order=order,
        transfer=RigTransfer((gain * unscaled.numerator[0],), unscaled.denominator, unscaled.delay),
        parameters={name: RigParameter(float(value), float(error), unit) for name, value, error, unit in known},
        covariance=covariance,
        low_frequency_delay=RigParameter(unscaled.low_frequency_delay, float(errors[-1]), "s"),
        offset=float(offset),
        noise=float(np.std(residual)),
        left=float(np.std(residual)) / size,
        independent=independent,
    )


def _gain_and_offset(made: np.ndarray, x: np.ndarray) -> np.ndarray:
    """(2,) of x = gain made + offset by least squares."""
    centred = made - np.mean(made)
    size = float(np.sum(centred**2))
    gain = float(np.sum(centred * x)) / size if size > 0.0 else 0.0
    return np.array([gain, float(np.mean(x)) - gain * float(np.mean(made))])


def _errors(
    response: Callable[[Sequence[float]], np.ndarray],
    values: Sequence[float],
    made: np.ndarray,
    gain: float,
    residual: np.ndarray,
    independent: float,
) -> tuple[list[float], np.ndarray]:
    """Standard errors of values, gain and low-frequency delay, and the covariance of values and gain.

    Noise counts by independent samples.

    The low-frequency delay is that of the values: delay + time constant, or delay + damping / (pi frequency).
    """
    columns = []
    for i, value in enumerate(values):
        step = 1e-4 * max(abs(value), 1e-4)  # of differences; delays of zero are those of a tenth of a millisecond
        other = list(values)
        other[i] = value + step
        columns.append(gain * (response(other) - made) / step)
    jacobian = np.column_stack([*columns, made, np.ones_like(made)])
    scale = np.sqrt(np.sum(jacobian**2, axis=0))
    scale[scale == 0.0] = 1.0
    variance = float(np.mean(residual**2)) / independent
    inverse = np.linalg.pinv((jacobian / scale).T @ (jacobian / scale)) * variance
    covariance = inverse / np.outer(scale, scale)
    slow = np.zeros(jacobian.shape[1])
    slow[0] = 1.0
    if len(values) == 2:
        slow[1] = 1.0
    elif len(values) == 3:
        slow[1], slow[2] = -values[2] / (math.pi * values[1] ** 2), 1.0 / (math.pi * values[1])
    own = [math.sqrt(max(float(covariance[i, i]), 0.0)) for i in range(len(values) + 1)]
    count = len(values) + 1  # without the offset
    return [*own, math.sqrt(max(float(slow @ covariance @ slow), 0.0))], covariance[:count, :count]
