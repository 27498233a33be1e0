"""Ageing: from test to test the specimen gets stiffer or softer, whatever is done to it."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LARGEST = 0.9  # change of the force up to the last test
_BENT = 3  # tests fitted to that show a line: with no more of them a curve is no better told
_COURSE = 6  # that show three lines, two in each


class _Ageing(Form):
    name: ClassVar[str] = "ageing"
    kind: ClassVar[Kind] = "damper"
    by_order: ClassVar[bool] = True
    signature: ClassVar[str] = "a factor of the force, constant within a test, that goes with the order of the tests"

    def _age(self, tests: int) -> float:
        """What the rate is multiplied by after a number of tests."""
        raise NotImplementedError

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        if not self.starts(sizes):
            return ()
        last = self._age(sizes.tests - 1)
        return (Unknown("rate", "", -_LARGEST / last, 10.0 * _LARGEST / last, 0.3 / last),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1 / self._age(sizes.tests - 1),),) if sizes.tests > 1 else ()

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> float:
        return 1.0 + p["rate"] * self._age(trial.order)


class Linear(_Ageing):
    """The force changes by as much from test to test: F = (1 + rate n) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "linear"
    title: ClassVar[str] = "ageing by as much from test to test"
    source: ClassVar[str] = "phenomenological: first order in the number of tests; ISO 22762-1:2018, 6.6 (ageing)"
    amendment: ClassVar[bool] = True

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"n": sizes.tests - 1.0}  # for a law file: the state of the last test

    def _age(self, tests: int) -> float:
        return float(tests)


class Logarithmic(_Ageing):
    """The force changes quickly at first and ever more slowly: F = (1 + rate ln(1 + n)) F_law."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "logarithmic"
    title: ClassVar[str] = "ageing that slows down from test to test"
    source: ClassVar[str] = (
        "physical ageing in proportion to the logarithm of time: Struik (1978), Physical Aging in Amorphous Polymers"
    )
    amendment: ClassVar[bool] = True

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"n": sizes.tests - 1.0}  # for a law file: the state of the last test

    def _age(self, tests: int) -> float:
        return math.log1p(tests)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return super().starts(sizes) if sum(sizes.fitted) > _BENT else ()


class Power(_Ageing):
    """The force changes with a power of the number of tests: F = (1 + rate (n / N)^p) F_law, N of the last test."""

    form: ClassVar[str] = "power"
    title: ClassVar[str] = "ageing that slows down or speeds up from test to test"
    source: ClassVar[str] = "power law of time in physical ageing: Struik (1978), Physical Aging in Amorphous Polymers"
    may_spare_loss: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        if not self.starts(sizes):
            return ()
        return Unknown("rate", "", -_LARGEST, 10.0, 0.3), Unknown("p", "", 0.1, 6.0, 1.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1, 0.4), (0.1, 2.0)) if sum(sizes.fitted) > _BENT else ()

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"N": sizes.tests - 1.0}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> float:
        return float(1.0 + p["rate"] * (trial.order / p["N"]) ** p["p"])


class Course(_Ageing):
    """The force changes along three straight lines over the order of the tests, F = (1 + a(n)) F_law: they bend where
    the tests fitted to are in thirds, and the last one goes on beyond them.
    """

    form: ClassVar[str] = "course"
    title: ClassVar[str] = "ageing by a course of its own from test to test"
    source: ClassVar[str] = "phenomenological: tests are not made at equal intervals, and their hours are not recorded"
    may_spare_loss: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return tuple(Unknown(f"a{i}", "", -_LARGEST, 10.0, 0.3) for i in (1, 2, 3)) if self.starts(sizes) else ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.03, 0.06, 0.1), (0.07, 0.09, 0.1)) if sum(sizes.fitted) >= _COURSE else ()

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        if not self.starts(sizes):
            return {}
        fitted = np.flatnonzero(sizes.fitted)
        thirds = np.interp(np.arange(1, 4) * (fitted.size - 1) / 3.0, np.arange(fitted.size), fitted)
        return {f"n{i}": float(n) for i, n in zip((1, 2, 3), thirds, strict=True)}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> float:
        knots, values = (0.0, p["n1"], p["n2"], p["n3"]), (0.0, p["a1"], p["a2"], p["a3"])
        beyond = max(trial.order - p["n3"], 0.0) * (p["a3"] - p["a2"]) / (p["n3"] - p["n2"])
        return float(max(1.0 + np.interp(trial.order, knots, values) + beyond, 1.0 - _LARGEST))


FORMS = (Linear, Logarithmic, Power, Course)
