"""How work is counted that wears or warms: of what force, and what of it that springs give back within a cycle."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypedDict

import numpy as np

from edesign.calibrate.dampers.effect import BESIDE, Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Values
from edesign.calibrate.unknown import Unknown


class Counted(TypedDict):
    """How `edesign.calibrate.dampers.drivers.worked` counts work."""

    left_by: Callable[[np.ndarray], np.ndarray]
    beside: np.ndarray | float
    sized: float
    evened: float


def how_counted(form: Form, p: Values, motion: Motion, force: np.ndarray, memory: Memory) -> Counted:
    """For a form that counts work, sized or evened or as it is, with the force (n,) N that it is given."""
    return {
        "left_by": form.left_by(p, motion, force, memory),
        "beside": memory.get(BESIDE, 0.0),
        "sized": p.get("sized", 0.0),
        "evened": p.get("tau_w", 0.0),
    }


def sized(form: Form) -> Form:
    """A form that counts work with a share `sized` of it counted by its size: 0 is the work that stays in the specimen,
    1 all that is moved in and out, 1/2 what is done on it alone, at half its worth.
    """
    unknowns, starts = form.unknowns, form.starts

    def more_unknowns(sizes: Sizes) -> tuple[Unknown, ...]:
        own = unknowns(sizes)
        return (*own, Unknown("sized", "", 0.0, 1.0, 1.0)) if own else ()

    return form.variant(
        "sized",
        "by the size of its work",
        sized=True,
        may_be_shaped=False,
        unknowns=more_unknowns,
        starts=lambda sizes: tuple((*row, 0.0) for row in starts(sizes)),
    )
