"""Inertia of moving mass between load cell and specimen."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class Mass(Form):
    """The load cell also accelerates the clevis and the moving plate: F = F_true + m a."""

    name: ClassVar[str] = "inertia"
    form: ClassVar[str] = "mass"
    kind: ClassVar[Kind] = "instrument"
    title: ClassVar[str] = "inertia of moving mass in the force channel"
    signature: ClassVar[str] = (
        "proportional to the acceleration: a negative stiffness that grows with the square of the frequency"
    )
    source: ClassVar[str] = "ISO 22762-1:2018, 6.2.1 (correction for inertia); Newton's second law"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        mass = sizes.force / sizes.acceleration
        return (Unknown("mass", "kg", -mass, mass, 0.1 * mass),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.02 * sizes.force / sizes.acceleration,),)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray(p["mass"] * motion.acceleration)


FORMS = (Mass,)
