"""A channel's scale is wrong, in all tests or from one on. The size is the error."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters, either
from blind.programme import Trial


class Gain(Effect):
    name, kind = "gain", "instrument"
    most = 0.5
    all_tests = False

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.sense, self.since = either(rng), 0
        if not self.all_tests:
            self.since = int(rng.choice(turns(tests)))

    def scaled(self, tests: Sequence[Trial], channel: Histories) -> Histories:
        factor = 1.0 + self.sense * self.size
        return [y * factor if test.index >= self.since else y for test, y in zip(tests, channel, strict=True)]

    def true_parameters(self) -> TrueParameters:
        return {
            "error": (self.sense * self.size, "1"),
            "gain": (1.0 + self.sense * self.size, "1"),
            "since": (self.since, "1"),
        }


class ForceFrom(Gain):
    form = "force_from_one_test"

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return self.scaled(tests, force)


class ForceAll(ForceFrom):
    """Beside a law that is known to be true; else nobody could separate it from the law's moduli."""

    form, all_tests, needs = "force_all", True, "trusted"


class DisplacementFrom(Gain):
    form = "displacement_from_one_test"

    def displacement_channel(self, tests: Sequence[Trial], x: Histories) -> Histories:
        return self.scaled(tests, x)


class DisplacementAll(DisplacementFrom):
    form, all_tests, needs = "displacement_all", True, "trusted"


FORMS = (ForceFrom, DisplacementFrom, ForceAll, DisplacementAll)


def turns(tests: Sequence[Trial]) -> list[int]:
    """Tests at which something may change: two to fit or more on both sides, and much of the validation after."""
    uses = [test.use for test in tests]
    motion = np.array([np.mean(test.x**2) * (test.use == "validate") for test in tests])
    after = np.cumsum(motion[::-1])[::-1] / motion.sum()
    good = [
        i for i in range(1, len(tests)) if uses[:i].count("fit") >= 2 and uses[i:].count("fit") >= 2 and after[i] > 0.3
    ]
    return good or [int(np.flatnonzero(after > 0.3)[-1])]
