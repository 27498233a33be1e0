"""Delay at which the measured displacement correlates best with the target, finer than a sample."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.ground_motion.transform_length import transform_length
from edesign.substructure.indicators.channels import channel, time_step
from edesign.substructure.indicators.undetermined import LEAST_EXPLAINED, Undetermined, moving


@dataclass(frozen=True)
class CorrelationDelay:
    """Delay by cross-correlation.

    Attributes:
        delay: s; above zero if the measured channel is late.
        correlation: coefficient at the nearest whole sample, 0 to 1.
    """

    delay: float
    correlation: float


def correlation_delay(target: ArrayLike, measured: ArrayLike, step: float) -> CorrelationDelay:
    """Find the delay with the largest correlation coefficient.

    The search goes over half of the record to both sides. The coefficient is that of the overlapping samples, means
    taken off. A parabola through the best lag and its neighbours gives the fraction of a sample. Of a periodic motion
    the delay nearest to zero is found. So one beyond a quarter of a period may be taken for a motion of opposite sign,
    one beyond half a period for a lead.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.
        step: s.

    Raises:
        InputError: lengths that differ, NaN, a step out of range.
        Undetermined: a constant channel; a measured channel of opposite sign or one that does not follow the target.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    time_step(step)
    moving("target", float(np.ptp(x_t)))
    moving("measured", float(np.ptp(x_m)))
    lag, best = _climb(x_t, x_m, _coarse_lag(x_t, x_m))
    if best**2 < LEAST_EXPLAINED or best < 0.0:
        raise Undetermined(f"the measured channel does not follow the target (correlation {best:.2f} at best)")
    return CorrelationDelay(step * (lag + _fraction(x_t, x_m, lag, best)), best)


def _correlation(target: np.ndarray, measured: np.ndarray, lag: int) -> float:
    """Correlation coefficient of measured(k + lag) with target(k) over the samples that both have; 0 if one rests."""
    count = target.size - abs(lag)
    a, b = target[max(-lag, 0) :][:count], measured[max(lag, 0) :][:count]
    a, b = a - np.mean(a), b - np.mean(b)
    size = float(np.sqrt(np.sum(a * a) * np.sum(b * b)))  # not a @ a: threads of BLAS fight over so small a product
    return float(np.sum(a * b)) / size if size > 0.0 else 0.0


def _coarse_lag(target: np.ndarray, measured: np.ndarray) -> int:
    """Lag of the largest sum of products, times the share of samples that overlap.

    So of a periodic motion the shortest lag wins, even where one of the channels ends early.
    """
    n = target.size
    length = transform_length(2 * n)
    spectrum = np.fft.rfft(measured - np.mean(measured), length) * np.conj(
        np.fft.rfft(target - np.mean(target), length)
    )
    half = n // 2
    lags = np.arange(-half, half + 1)
    products = np.fft.irfft(spectrum, length)[lags] * (1.0 - np.abs(lags) / n)
    largest, least = int(np.argmax(products)), int(np.argmin(products))
    if -products[least] > products[largest] and abs(lags[least]) < abs(lags[largest]):
        raise Undetermined("the measured channel follows the target with opposite sign, or half a period late")
    return int(lags[largest])


def _climb(target: np.ndarray, measured: np.ndarray, lag: int) -> tuple[int, float]:
    """Nearest largest correlation coefficient from a lag on, and the coefficient."""
    half = target.size // 2
    best = _correlation(target, measured, lag)
    for direction in (1, -1):
        while abs(lag + direction) <= half:
            there = _correlation(target, measured, lag + direction)
            if there <= best:
                break
            lag, best = lag + direction, there
    return lag, best


def _fraction(target: np.ndarray, measured: np.ndarray, lag: int, best: float) -> float:
    """From the best lag to the top of the parabola through it and its neighbours, samples."""
    if abs(lag) + 1 > target.size - 2:
        return 0.0
    before, after = _correlation(target, measured, lag - 1), _correlation(target, measured, lag + 1)
    curvature = before - 2.0 * best + after
    return 0.5 * (before - after) / curvature if curvature < 0.0 else 0.0
