"""Faults of the instruments: floors recorded later than the base, or with another gain."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from edesign.calibration.form import Values, size
from edesign.calibration.structures.effect import ChangedChannels, StructureForm
from edesign.calibration.structures.record import Channel, Measure
from edesign.calibration.structures.sizes import StructureSizes

_CLASS = 0.05  # standard deviation of a gain
_LONGEST = 0.1  # of the first period, or
_SAMPLES = 3.0  # steps: the longest lag
_HALF = 3  # samples on either side of a time, through which channels are interpolated


def _late(p: Values, step: float, channels: Sequence[Channel], values: np.ndarray) -> np.ndarray:
    """Return the values of a lag before, by the polynomial through the six samples about each; the ends go on."""
    whole = math.floor(p["lag"] / step)
    part, length = p["lag"] / step - whole, len(values)
    nodes = np.arange(-_HALF, _HALF) + 1.0  # steps before the sample that is `whole` steps earlier
    shares = [float(np.prod((part - np.delete(nodes, k)) / (nodes[k] - np.delete(nodes, k)))) for k in range(2 * _HALF)]
    at = np.arange(-_HALF, length + _HALF) - whole
    reach = values[np.clip(at, 0, length - 1)]
    found = [share * reach[_HALF - int(k) : _HALF - int(k) + length] for share, k in zip(shares, nodes, strict=True)]
    return np.asarray(np.sum(found, axis=0))


def _amplified(measure: Measure) -> Callable[[Values, float, Sequence[Channel], np.ndarray], np.ndarray]:
    def change(p: Values, step: float, channels: Sequence[Channel], values: np.ndarray) -> np.ndarray:
        return values * np.array([1.0 + p["g"] if channel.measure == measure else 1.0 for channel in channels])

    return change


def _longest(s: StructureSizes) -> float:
    return max(_LONGEST * s.period, _SAMPLES * s.step)


_LAG = StructureForm(
    "lag",
    "delay",
    "instrument",
    "lag between the channels of floors and base",
    "proportional to the rate of each channel, at all amplitudes, in proportion to frequency",
    "Ljung (1999), System Identification, 14.1",
    (ChangedChannels(_late, over_time=True),),
    lambda s: (size("lag", "s", 0.3 * _longest(s), -_longest(s), _longest(s)),),
    lambda s: ((s.step,),),
    meanings={"lag": "by which the floors are recorded later than the base; negative: earlier"},
)


def _gain(measure: Measure) -> StructureForm:
    return StructureForm(
        "gain",
        measure,
        "instrument",
        f"gain of the channels of {measure}",
        "proportional to the channel itself, from the static share to the highest mode; relative to the base, whose "
        "own gain looks the same",
        "Ljung (1999), System Identification, 14.1",
        (ChangedChannels(_amplified(measure)),),
        lambda _: (size("g", "", _CLASS, -0.5, 1.0),),
        lambda _: ((_CLASS,),),
        shown=lambda s: measure in s.measures,
        meanings={"g": "share by which the channels read too much; negative: too little"},
    )


FORMS = (_LAG, _gain("acceleration"), _gain("displacement"))
