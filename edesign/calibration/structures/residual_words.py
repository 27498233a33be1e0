"""What a model of a structure leaves unexplained, in a few plain sentences."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.calibration.residual.series import Series

_STEPS = 41


def describe_residual(series: Sequence[Series], mode: float) -> str:
    """Where the residual of the corrected model is: in which test and channel, at which frequencies, how it grows.

    Args:
        mode: first frequency of the corrected building, Hz.
    """
    squared = np.array([float(np.sum(_left(one) ** 2)) / _power(one) for one in series])
    whole = float(np.mean(squared))
    if whole == 0.0:
        return "Nothing is left."
    worst = series[int(np.argmax(squared))]
    channel = f" ({worst.channel})" if worst.channel else ""
    texts = [
        f"On average {_percent(whole)} of the squared response of a channel is left, at most {_percent(max(squared))} "
        f"in {worst.of_test}{channel}."
    ]
    low = np.mean([_share_below(one, 1.5 * mode) for one in series])
    texts.append(f"Of it {100.0 * low:.0f} % is below {1.5 * mode:.3g} Hz, about the first mode.")
    factor, size = _factor(series)
    if size > 0.1:
        texts.append(
            f"It is like a factor on the whole response, {100.0 * factor:+.2g} % ({100.0 * size:.0f} % of it)."
        )
    trend = _trend(series)
    if trend:
        texts.append(trend)
    return " ".join(texts)


def _left(one: Series) -> np.ndarray:
    return np.asarray(one.measured - one.predicted["corrected"])


def _power(one: Series) -> float:
    return max(float(one.measured @ one.measured), 1e-300)


def _percent(ratio: float) -> str:
    return f"{100.0 * ratio:.2g} %"


def _share_below(one: Series, frequency: float) -> float:
    power = np.abs(np.fft.rfft(_left(one))) ** 2
    at = np.fft.rfftfreq(one.time.size, float(one.time[1] - one.time[0]))
    return float(power[at <= frequency].sum() / max(power.sum(), 1e-300))


def _factor(series: Sequence[Series]) -> tuple[float, float]:
    """Factor that would explain most, less one, and the share of the residual that it explains."""
    both = [(_left(one) / np.sqrt(_power(one)), one.predicted["corrected"] / np.sqrt(_power(one))) for one in series]
    cross = sum(float(r @ p) for r, p in both)
    power = max(sum(float(p @ p) for _, p in both), 1e-300)
    left = max(sum(float(r @ r) for r, _ in both), 1e-300)
    return cross / power, cross**2 / power / left


def _trend(series: Sequence[Series]) -> str:
    """Whether small motions are followed worse than large ones, or the other way."""
    ratios = []
    for one in series:
        strong = np.abs(one.displacement) > 0.5 * float(np.max(np.abs(one.displacement)))
        reach = np.convolve(strong, np.ones(_STEPS), "same") > 0.0
        if reach.all() or not reach.any():
            continue
        errors = [float(np.sum(_left(one)[at] ** 2) / np.sum(one.measured[at] ** 2)) for at in (reach, ~reach)]
        ratios.append(errors[1] / max(errors[0], 1e-300))
    if not ratios:
        return ""
    ratio = float(np.median(ratios))
    if 0.5 < ratio < 2.0:
        return ""
    small, large = ("more", ratio) if ratio > 1.0 else ("less", 1.0 / ratio)
    return f"Small motions have {large:.2g} times {small} relative error than those about the largest."
