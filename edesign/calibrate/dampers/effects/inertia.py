"""Inertia of moving mass between load cell and specimen."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.inside import swung_force
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_MOST = 10.0  # times force over acceleration: the mass may carry what the elastomer holds back


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
        return (Unknown("mass", "kg", -_MOST * mass, _MOST * mass, 0.1 * mass),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.02 * sizes.force / sizes.acceleration,),)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray(p["mass"] * motion.acceleration)


class Sprung(Mass):
    """The mass is held by a fixture that gives: F = F_true + m b, b'' + 2 zeta w b' + w^2 b = w^2 a, w = 2 pi f."""

    refined: int = 4  # it swings between samples of a fit
    form: ClassVar[str] = "sprung"
    title: ClassVar[str] = "inertia of moving mass on a fixture that gives, in the force channel"
    source: ClassVar[str] = "Chopra, Dynamics of Structures, section 1.7 (motion of the support)"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        f = sizes.frequency
        return (
            *super().unknowns(sizes),
            Unknown("f", "Hz", f, 100.0 * f, 10.0 * f, logarithmic=True),
            Unknown("zeta", "", 0.01, 0.5, 0.1, logarithmic=True),  # more is a filter
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        ((mass,),) = super().starts(sizes)
        return ((mass, 10.0 * sizes.frequency, 0.2),)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray(p["mass"] * swung_force(motion, motion.acceleration, p["f"], p["zeta"]))


class OneSided(Mass):
    """Parts lift off a stop and rest on it on the other side: F = F_true + m (1 + s tanh(u/w)) a."""

    form: ClassVar[str] = "one_sided"
    title: ClassVar[str] = "inertia of moving mass, more of it on one side, in the force channel"
    signature: ClassVar[str] = (
        "proportional to the acceleration, more on one side: a negative stiffness that grows with the square of the "
        "frequency, and a mean force with it"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        width = Unknown("w", "m", 1e-3 * u, u, 0.05 * u, logarithmic=True)
        return (*super().unknowns(sizes), Unknown("s", "", -1.0, 1.0, 0.3), width)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        ((mass,),) = super().starts(sizes)
        width = 0.03 * sizes.displacement
        return (mass, -0.2, width), (mass, 0.2, width)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray(p["mass"] * (1.0 + p["s"] * np.tanh(motion.displacement / p["w"])) * motion.acceleration)


FORMS = (Mass, Sprung, OneSided)
