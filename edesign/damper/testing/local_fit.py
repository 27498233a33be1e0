"""Values of noisy periodic histories at a point: extremes, zeros, and the value at a reversal.

Near the point the history is fitted with 1, cos and sin of the phase, which is exact for a sine at any sampling. The
wider the window, the less noise, but the more error from other shapes. So windows are widened as long as the result
stays within two standard errors of those from all narrower ones (Lepski's rule; Goldenshluger & Nemirovski, 1997).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError

WIDTHS = np.pi / np.array([256, 128, 64, 32, 16, 8, 4])  # half width of the window, rad: up to 1/8 cycle
FEWEST, FEWEST_AT_REVERSAL = 3, 5  # samples on each side
CONFIDENCE = 2.0  # standard errors
CORNER = 5.0  # residual of the narrowest window, in standard deviations of the noise, that shows a corner
_ROUNDING = 1e-12  # relative: no noise is smaller


@dataclass(frozen=True)
class Estimate:
    """A value with its place (s) and standard error."""

    time: float
    value: float
    spread: float
    misfit: float = 0.0


def noise(values: np.ndarray) -> float:
    """Return the standard deviation of white noise on a smooth history, from its third differences.

    The median is taken, so that corners count little.

    Args:
        values: (n,) samples at an even step.

    Returns:
        Standard deviation in the unit of the values.
    """
    if values.size < 4:
        return 0.0
    return float(np.median(np.abs(np.diff(values, 3)))) / 0.6745 / np.sqrt(20.0)


def peak(
    time: np.ndarray, values: np.ndarray, near: float, omega: float, within: tuple[float, float], spread: float
) -> Estimate:
    """Find the maximum of a history by a fit around its largest sample.

    Args:
        time: (n,) s.
        values: (n,) of the history.
        near: time of the largest sample, s.
        omega: circular frequency of the history, rad/s.
        within: times between which samples are used, s.
        spread: standard deviation of the noise.

    Returns:
        Time and value; where the history has a corner or jump, which no fit can follow, the largest sample.
    """
    largest = float(values[int(np.argmin(np.abs(time - near)))])
    spread = max(spread, _ROUNDING * float(np.max(np.abs(values))))

    def estimates() -> Iterable[Estimate]:
        centre = near
        for width in WIDTHS:
            found = _extreme(time, values, centre, omega, width, within, spread)
            centre = found.time
            yield found
            if not within[0] <= centre <= within[1]:  # a half cycle of a few samples, which no fit can follow
                return

    found = _widest(estimates())
    if found is None or found.misfit > CORNER * spread:
        return Estimate(near, largest, spread)
    return found


def zero(time: np.ndarray, values: np.ndarray, before: int, after: int, spread: float) -> float:
    """Find the time at which a history passes zero between two samples of opposite sign.

    A straight line is fitted through the samples between them, the widest line that the noise warrants.

    Args:
        time: (n,) s.
        values: (n,) of the history.
        spread: standard deviation of the noise.

    Returns:
        Time, s.
    """
    middle = 0.5 * (before + after)
    spread = max(spread, _ROUNDING * float(np.max(np.abs(values))))

    def estimates() -> Iterable[Estimate]:
        for half in sorted({0.5 * (after - before) * factor for factor in (0.25, 0.5, 1.0)}):
            first, last = int(np.floor(middle - half)), int(np.ceil(middle + half)) + 1
            t, y = time[max(first, 0) : last], values[max(first, 0) : last]
            if t.size < 2 or y[0] * y[-1] > 0.0 and half < 0.5 * (after - before):
                continue
            mean = float(np.mean(t))
            slope, level = np.polyfit(t - mean, y, 1)
            if slope == 0.0:
                continue
            at = float(np.clip(mean - level / slope, time[before], time[after]))
            yield Estimate(at, at, spread / abs(float(slope)) / np.sqrt(t.size))

    found = _widest(estimates())
    if found is not None:
        return found.value
    return float(np.interp(0.0, sorted((values[before], values[after])), (time[before], time[after])))


def value_at_reversal(time: np.ndarray, values: np.ndarray, at: float, omega: float, spread: float) -> Estimate:
    """Find the value of a force at a reversal of the deformation.

    Forces that change sign with the velocity jump there, or pass with any slope: the fit has an odd jump and odd
    roots beside 1, cos and sin, and gives the even part, which is half way. Where such a force relaxes, as in series
    with a spring, the even part has a cusp: so the sine is there with either sign on the two sides.

    Args:
        time: (n,) s.
        values: (n,) of the force.
        at: time of the reversal, s.
        omega: circular frequency, rad/s.
        spread: standard deviation of the noise.

    Returns:
        Time, s, and value.

    Raises:
        InputError: there are too few samples.
    """
    spread = max(spread, _ROUNDING * float(np.max(np.abs(values))))
    found = _widest(_value(time, values, at, omega, width, spread) for width in WIDTHS)
    if found is None:
        raise InputError(f"too few samples about {at:g} s [E-TEST-04]")
    return found


def value_at(time: np.ndarray, values: np.ndarray, at: float, omega: float, spread: float) -> Estimate:
    """Find the value of a smooth history at a time by a fit around it.

    Args:
        time: (n,) s.
        values: (n,) of the history.
        at: s.
        omega: circular frequency, rad/s.
        spread: standard deviation of the noise.

    Raises:
        InputError: there are too few samples.
    """
    spread = max(spread, _ROUNDING * float(np.max(np.abs(values))))
    found = _widest(_smooth_value(time, values, at, omega, width, spread) for width in WIDTHS)
    if found is None:
        raise InputError(f"too few samples about {at:g} s [E-TEST-04]")
    return found


def _widest(estimates: Iterable[Estimate]) -> Estimate | None:
    """The last estimate that agrees with all before it."""
    low, high, chosen = -np.inf, np.inf, None
    for estimate in estimates:
        low = max(low, estimate.value - CONFIDENCE * estimate.spread)
        high = min(high, estimate.value + CONFIDENCE * estimate.spread)
        if low > high:
            break
        misfit = estimate.misfit if chosen is None else chosen.misfit  # that of the narrowest shows a corner
        chosen = Estimate(estimate.time, estimate.value, estimate.spread, misfit)
    return chosen


def _window(time: np.ndarray, centre: float, half: float, within: tuple[float, float], fewest: int) -> slice:
    """Samples within `half` of the centre, and at least the nearest few on each side."""
    middle = min(max(int(np.searchsorted(time, centre)), 1), time.size - 1)
    half = max(half, fewest * float(time[middle] - time[middle - 1])) * (1.0 + 1e-9)  # as many before as after
    first, last = np.searchsorted(time, (max(centre - half, within[0]), min(centre + half, within[1])))
    return slice(int(first), int(last))


def _extreme(
    time: np.ndarray,
    values: np.ndarray,
    centre: float,
    omega: float,
    width: float,
    within: tuple[float, float],
    spread: float,
) -> Estimate:
    part = _window(time, centre, width / omega, within, FEWEST)
    phase = omega * (time[part] - centre)
    rows = np.column_stack((np.ones_like(phase), np.cos(phase) - 1.0, np.sin(phase)))
    (level, even, odd), covariance, misfit = _regress(rows, values[part])
    turn = float(np.clip(np.arctan2(odd, even), phase[0], phase[-1])) if even > 0.0 else 0.0
    row = np.array([1.0, np.cos(turn) - 1.0, np.sin(turn)])
    deviation = spread * float(np.sqrt(row @ covariance @ row))
    return Estimate(centre + turn / omega, float(row @ (level, even, odd)), deviation, misfit)


def _value(time: np.ndarray, values: np.ndarray, at: float, omega: float, width: float, spread: float) -> Estimate:
    part = _window(time, at, width / omega, (-np.inf, np.inf), FEWEST_AT_REVERSAL)
    phase = omega * (time[part] - at)
    sine, jump = np.sin(phase), np.sign(phase)
    odd = (sine, jump, jump * np.abs(phase) ** 0.25, jump * np.abs(phase) ** 0.5)
    rows = np.column_stack((np.ones_like(phase), np.cos(phase) - 1.0, jump * sine, *odd))
    coefficients, covariance, misfit = _regress(rows, values[part])
    return Estimate(at, float(coefficients[0]), spread * float(np.sqrt(covariance[0, 0])), misfit)


def _smooth_value(
    time: np.ndarray, values: np.ndarray, at: float, omega: float, width: float, spread: float
) -> Estimate:
    part = _window(time, at, width / omega, (-np.inf, np.inf), FEWEST)
    phase = omega * (time[part] - at)
    rows = np.column_stack((np.ones_like(phase), np.cos(phase) - 1.0, np.sin(phase)))
    coefficients, covariance, misfit = _regress(rows, values[part])
    return Estimate(at, float(coefficients[0]), spread * float(np.sqrt(covariance[0, 0])), misfit)


def _regress(rows: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray, float]:
    """Coefficients of least squares, their covariance for noise of unit variance, and the rms residual."""
    scale = np.max(np.abs(rows), axis=0)
    scale[scale == 0.0] = 1.0
    scaled = rows / scale
    inverse = np.linalg.pinv(scaled.T @ scaled) / np.outer(scale, scale)
    coefficients = np.linalg.lstsq(scaled, values, rcond=None)[0] / scale
    residual = values - rows @ coefficients
    free = max(values.size - rows.shape[1], 1)
    return coefficients, inverse, float(np.sqrt(residual @ residual / free))
