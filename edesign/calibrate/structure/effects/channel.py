"""Faults of the instruments: floors recorded later than the base, or with another gain."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import numpy as np
from scipy.interpolate import CubicSpline

from edesign.calibrate.problem import USUAL_GAIN, Kind
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.record import Channel, Measure
from edesign.calibrate.unknown import Unknown


class Lag(StructuralEffect):
    """All floor channels are late by a time, or early."""

    name: ClassVar[str] = "lag"
    form = "delay"
    kind: ClassVar[Kind] = "instrument"
    title = "lag between the channels of floors and base"
    signature: ClassVar[str] = "proportional to the rate of each channel, at all amplitudes, in proportion to frequency"
    source: ClassVar[str] = "Ljung (1999), System Identification, 14.1"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        longest = max(0.1 * setting.period, 3.0 * setting.step)
        return (Unknown("lag", "s", -longest, longest, 0.1 * longest),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((setting.step,),)

    def channels(self, p: Values, step: float, channels: Sequence[Channel], values: np.ndarray) -> np.ndarray:
        time = step * np.arange(values.shape[0])
        return np.asarray(CubicSpline(time, values)(np.clip(time - p["lag"], 0.0, time[-1])))


class Gain(StructuralEffect):
    """All floor channels of one measure have one factor."""

    name: ClassVar[str] = "gain"
    usual: ClassVar[float] = USUAL_GAIN
    kind: ClassVar[Kind] = "instrument"
    signature: ClassVar[str] = (
        "proportional to the channel itself, from the static share to the highest mode; relative to the base, whose "
        "own gain looks the same"
    )
    source: ClassVar[str] = "Ljung (1999), System Identification, 14.1"

    def __init__(self, measure: Measure) -> None:
        self.measure = measure
        self.form = measure
        self.title = f"gain of the channels of {measure}"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        return (Unknown("gain", "", 0.5, 2.0, 1.0, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((1.02,),) if self.measure in setting.measures else ()

    def channels(self, p: Values, step: float, channels: Sequence[Channel], values: np.ndarray) -> np.ndarray:
        return values * np.array([p["gain"] if channel.measure == self.measure else 1.0 for channel in channels])


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    return (Lag(), Gain("acceleration"), Gain("displacement"))
