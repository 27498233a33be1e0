"""Zero of the force channel."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.shares import shares_of
from edesign.calibrate.dampers.trial import Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


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

    form: ClassVar[str] = "per_test"
    title: ClassVar[str] = "zero of the force channel, set anew for each test"
    signature: ClassVar[str] = "a constant force in each test, another one from test to test"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((),)

    def columns(self, p: Values, trial: Trial) -> np.ndarray:
        return np.ones((trial.force.size, 1))

    def shares(self, p: Values, trial: Trial, residual: np.ndarray) -> dict[str, float]:
        """The test's own share of a residual (n,) N."""
        return {"offset_N": float(shares_of(self.columns(p, trial), residual)[0])}


FORMS = (Constant, PerTest)
