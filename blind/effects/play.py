"""Play in the pins: the actuator moves before the damper does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator

from blind.effects.base import Effect, Histories, TrueParameters, log_uniform
from blind.programme import Trial
from blind.series import Joint


class Gap(Effect):
    """No force while the pin is between its two contacts, `size` mm apart; stiff contacts. The pin starts half-way."""

    name, kind, form = "play", "rig", "gap"
    first, most = 0.1, 3.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.contact, self.start = log_uniform(rng, 500.0, 3000.0), 0.5

    def joint(self) -> Joint:
        left, right, stiffness = -self.start * self.size, (1.0 - self.start) * self.size, self.contact

        def force(w: float) -> tuple[float, float]:
            if w > right:
                return stiffness * (w - right), stiffness
            if w < left:
                return stiffness * (w - left), stiffness
            return 0.0, 0.0

        return force

    def true_parameters(self) -> TrueParameters:
        return {"gap": (self.size, "mm"), "contact": (self.contact, "kN/mm")}


class OneSide(Gap):
    """The pin starts at one contact."""

    form = "gap_from_one_side"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        super().shape(rng, tests)
        self.start = float(rng.choice([0.0, 1.0]))


class Backlash(Effect):
    """The damper stays where it is until the gap is closed (a stiff guide holds it)."""

    name, kind, form = "play", "rig", "backlash"
    first, most = 0.1, 3.0

    def deformation(self, tests: Sequence[Trial], u: Histories) -> Histories:
        out, half = [], 0.5 * self.size
        for x in u:
            y, course = 0.0, []
            for value in x.tolist():
                if value > y + half:
                    y = value - half
                elif value < y - half:
                    y = value + half
                course.append(y)
            out.append(np.array(course))
        return out

    def true_parameters(self) -> TrueParameters:
        return {"gap": (self.size, "mm")}


FORMS = (Gap, OneSide, Backlash)
