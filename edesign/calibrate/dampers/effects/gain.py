"""Gain of a channel: a wrong calibration factor."""

from __future__ import annotations

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import USUAL_GAIN, Kind
from edesign.calibrate.unknown import Unknown


class _Gain(Form):
    name: ClassVar[str] = "gain"
    kind: ClassVar[Kind] = "instrument"
    usual: ClassVar[float] = USUAL_GAIN
    source: ClassVar[str] = "ISO 376:2011 (calibration of load cells); Doebelin, Measurement Systems, chapter 2"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("g", "", -0.5, 1.0, 0.1),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05,),)


class Force(_Gain):
    """The force channel shows (1 + g) of the force, in all tests."""

    form: ClassVar[str] = "force"
    title: ClassVar[str] = "gain of the force channel"
    signature: ClassVar[str] = "proportional to the force itself, by the same share in all tests"

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return np.asarray((1.0 + p["g"]) * force)


class Displacement(_Gain):
    """The displacement channel shows (1 + g) of the displacement: the specimen moves by u / (1 + g)."""

    form: ClassVar[str] = "displacement"
    title: ClassVar[str] = "gain of the displacement channel"
    signature: ClassVar[str] = "that of a gain of the force where the law is linear; by its tangent where it is not"

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return motion.times(1.0 / (1.0 + p["g"]))


class _FromTest(Form):
    """A gain that changed between two tests: one form for each place, which is no number that a search could move.

    Tests that are not fitted to may stand between those two: what they record tells in which of them it changed.

    Args:
        first: the test from which it is changed; 2 is the second of the campaign.
    """

    channel_name: ClassVar[str]
    by_order: ClassVar[bool] = True

    def __init__(self, first: int) -> None:
        vars(self).update(
            form=f"{self.channel_name}_from_test_{first}",
            title=f"gain of the {self.channel_name} channel that changed before test {first}",
        )
        self.first = first

    def fixed(self, sizes: Sizes) -> Mapping[str, float]:
        return {"first_test": float(self.first)}

    def elsewhere(self, sizes: Sizes) -> tuple[Form, ...]:
        last = 1 + max(i for i in range(self.first - 1) if sizes.fitted[i])
        after = 1 + min(i for i in range(self.first - 1, sizes.tests) if sizes.fitted[i])
        return tuple(type(self)(first) for first in range(last + 1, after + 1) if first != self.first)

    def _changed(self, trial: Trial) -> bool:
        return trial.order + 1 >= self.first


class ForceFromTest(_FromTest, Force):
    """The force channel shows (1 + g) of the force from a test on."""

    channel_name: ClassVar[str] = "force"
    signature: ClassVar[str] = "proportional to the force itself, by one share in all tests from one on"

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return super().channel(p, trial, force) if self._changed(trial) else force


class DisplacementFromTest(_FromTest, Displacement):
    """The displacement channel shows (1 + g) of the displacement from a test on."""

    channel_name: ClassVar[str] = "displacement"
    signature: ClassVar[str] = (
        "that of a gain of the force from one test on; by the law's tangent where it is not linear"
    )

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return super().actuator(p, trial, motion) if self._changed(trial) else motion


def forms_of(sizes: Sizes) -> tuple[Form, ...]:
    """A form of each channel for each place between two tests that are fitted to."""
    places = [order + 1 for order, fitted in enumerate(sizes.fitted) if fitted][1:]
    return (*(ForceFromTest(first) for first in places), *(DisplacementFromTest(first) for first in places))


FORMS = (Force, Displacement)
