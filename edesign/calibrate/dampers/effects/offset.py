"""Zero of the force channel."""

from __future__ import annotations

from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LEAST = 1e-3  # of the largest displacement: what is less is noise of the first sample


class _Offset(Form):
    name: ClassVar[str] = "offset"
    kind: ClassVar[Kind] = "instrument"
    source: ClassVar[str] = "ISO 376:2011 (zero error); Doebelin, Measurement Systems, chapter 2 (zero drift)"


class Constant(_Offset):
    """The same zero in all tests: F + offset."""

    form: ClassVar[str] = "constant"
    title: ClassVar[str] = "zero of the force channel, the same in all tests"
    signature: ClassVar[str] = "a constant force, the same in all tests, there before anything moves"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("offset", "N", -sizes.force, sizes.force, 0.1 * sizes.force),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.force,),)

    def channel(self, p: Values, trial: Trial, force: np.ndarray) -> np.ndarray:
        return np.asarray(force + p["offset"])


class PerTest(_Offset):
    """Each test has a zero of its own."""

    has_columns: bool = True
    form: ClassVar[str] = "per_test"
    title: ClassVar[str] = "zero of the force channel, set anew for each test"
    signature: ClassVar[str] = "a constant force in each test, another one from test to test"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((),)

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        return np.ones((trial.force.size, 1))


class Displacement(_Offset):
    """The displacement channel does not show zero where the specimen is unsheared: u_true = u - zero.

    Only campaigns whose records all begin at about the same displacement can show it; a pre-shear is recorded as zero.
    """

    form: ClassVar[str] = "displacement"
    title: ClassVar[str] = "zero of the displacement channel, the same in all tests"
    signature: ClassVar[str] = (
        "no force where the record begins, though not at zero displacement; loops shifted along the displacement"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (Unknown("zero", "m", -u, u, 0.1 * u),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * sizes.displacement,),)

    def starts_from_residuals(self, sizes: Sizes, left: Left) -> tuple[tuple[float, ...], ...]:
        """Where the records begin; none if that is at zero, or here and there."""
        first = np.array([trial.motion.displacement[0] for trial in left.trials])
        middle = float(np.median(first)) if first.size else 0.0
        spread = float(np.median(np.abs(first - middle))) if first.size else 0.0
        alike = abs(middle) > _LEAST * sizes.displacement and spread < 0.2 * abs(middle)
        return ((middle,),) if alike else ()

    def actuator(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        return replace(motion, displacement=motion.displacement - p["zero"])


FORMS = (Constant, PerTest, Displacement)
