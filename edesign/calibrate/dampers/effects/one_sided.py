"""Unequal sides: the damper answers differently to the two directions."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.effects.hardening import CURVED_BODIES, contact_force, contact_unknowns
from edesign.calibrate.dampers.trial import REFINED, Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown


class _OneSided(Form):
    name: ClassVar[str] = "one_sided"
    may_be_inside: ClassVar[bool] = True
    kind: ClassVar[Kind] = "damper"
    amendment: ClassVar[bool] = True
    side: ClassVar[float]
    amendment_form: ClassVar[str]
    """The form in a law file, which names the side as a parameter of its own."""

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"side": self.side}


class _Spring(_OneSided):
    elastic: ClassVar[bool] = True
    signature: ClassVar[str] = (
        "too little force at the tips of one side of the loops alone: even multiples of the frequency"
    )
    source: ClassVar[str] = (
        "contact by a one-sided spring: Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (linear case)"
    )
    amendment_form: ClassVar[str] = "spring"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k, u = sizes.stiffness, sizes.displacement
        return Unknown("k", "N/m", -5.0 * k, 20.0 * k, k), Unknown("u0", "m", 0.0, 0.98 * u, 0.3 * u)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k / (1.0 - share), share * u) for share in (0.0, 0.3, 0.6, 0.8))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        side = p["side"]
        return np.asarray(side * p["k"] * np.maximum(side * motion.displacement - p["u0"], 0.0))


class SpringPositive(_Spring):
    """A spring that begins at a positive deformation: k max(u - u0, 0)."""

    form: ClassVar[str] = "spring_positive"
    title: ClassVar[str] = "contact or hardening on the positive side"
    side: ClassVar[float] = 1.0


class SpringNegative(_Spring):
    """A spring that begins at a negative deformation: -k max(-u - u0, 0)."""

    form: ClassVar[str] = "spring_negative"
    title: ClassVar[str] = "contact or hardening on the negative side"
    side: ClassVar[float] = -1.0


class _Contact(_Spring):
    amendment_form: ClassVar[str] = "contact"
    source: ClassVar[str] = CURVED_BODIES

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return contact_unknowns(sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k / (1.0 - share) ** 2, share * u, 2.0) for share in (0.0, 0.4))

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"side": self.side, "r": sizes.displacement}

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        beyond = np.maximum(p["side"] * motion.displacement - p["u0"], 0.0)
        return p["side"] * contact_force(p, beyond)


class ContactPositive(_Contact):
    """A contact that stiffens at positive deformations: k x (x/r)^(n - 1), x = max(u - u0, 0)."""

    form: ClassVar[str] = "contact_positive"
    title: ClassVar[str] = "contact that stiffens on the positive side"
    side: ClassVar[float] = 1.0


class ContactNegative(_Contact):
    """A contact that stiffens at negative deformations: -k x (x/r)^(n - 1), x = max(-u - u0, 0)."""

    form: ClassVar[str] = "contact_negative"
    title: ClassVar[str] = "contact that stiffens on the negative side"
    side: ClassVar[float] = -1.0


class _Factor(_OneSided):
    refined: int = 4  # it changes at once, within a step
    signature: ClassVar[str] = "loops larger on one side than on the other by a share of the force, at all amplitudes"
    source: ClassVar[str] = (
        "phenomenological: a law with a stiffness for each side, as for cracked or partly debonded layers"
    )
    amendment_form: ClassVar[str] = "factor"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("b", "", -0.9, 3.0, 0.5),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1,),)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.where(p["side"] * motion.displacement > 0.0, 1.0 + p["b"], 1.0)


class FactorPositive(_Factor):
    """The force is larger by a share at positive deformations: F = (1 + b) F_law where u > 0."""

    form: ClassVar[str] = "factor_positive"
    title: ClassVar[str] = "larger or smaller force on the positive side"
    side: ClassVar[float] = 1.0


class FactorNegative(_Factor):
    """The force is larger by a share at negative deformations: F = (1 + b) F_law where u < 0."""

    form: ClassVar[str] = "factor_negative"
    title: ClassVar[str] = "larger or smaller force on the negative side"
    side: ClassVar[float] = -1.0


class _Soft(_Factor):
    refined: int = REFINED
    may_be_inside: ClassVar[bool] = False  # with springs and dashpots apart it is inside
    may_spare_loss: ClassVar[bool] = True
    amendment: ClassVar[bool] = False

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (*super().unknowns(sizes), Unknown("w", "m", 1e-3 * u, u, 0.1 * u, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1, 0.05 * sizes.displacement),)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 + 0.5 * p["b"] * (1.0 + np.tanh(p["side"] * motion.displacement / p["w"])))


class SoftPositive(_Soft):
    """As `factor_positive`, one side going over into the other: F = (1 + b (1 + tanh(u/w))/2) F_law."""

    form: ClassVar[str] = "soft_factor_positive"
    title: ClassVar[str] = "larger or smaller force towards the positive side"
    side: ClassVar[float] = 1.0


class SoftNegative(_Soft):
    """As `factor_negative`, one side going over into the other: F = (1 + b (1 - tanh(u/w))/2) F_law."""

    form: ClassVar[str] = "soft_factor_negative"
    title: ClassVar[str] = "larger or smaller force towards the negative side"
    side: ClassVar[float] = -1.0


class Even(_OneSided):
    """A force to one side whatever the side of the deformation, which stiffens one and softens the other:
    k |u| (|u|/r)^(n - 1)."""

    form: ClassVar[str] = "even"
    amendment_form: ClassVar[str] = "even"
    elastic: ClassVar[bool] = True
    title: ClassVar[str] = "stiffer with deformation to one side, softer to the other"
    signature: ClassVar[str] = (
        "a force to the same side at both tips of the loops: even multiples of the frequency alone"
    )
    source: ClassVar[str] = (
        "Kovacic & Brennan (2011), The Duffing Equation, Wiley, section 2.5 (Helmholtz-Duffing: n = 2)"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = 20.0 * sizes.stiffness
        return Unknown("k", "N/m", -k, k, sizes.stiffness), Unknown("n", "", 1.0, 5.0, 1.0)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1 * sizes.stiffness, 2.0),)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"r": sizes.displacement}

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        size = np.abs(motion.displacement)
        return np.asarray(p["k"] * size * (size / p["r"]) ** (p["n"] - 1.0))


class EvenSprings(_OneSided):
    """The law's springs stiffen to one side and soften to the other: k (1 + b u/r) u, dashpots as they are."""

    form: ClassVar[str] = "even_springs"
    of_mgmm: bool = True
    amendment: ClassVar[bool] = False
    spares_loss: bool = True
    title: ClassVar[str] = "springs stiffer with deformation to one side, softer to the other"
    signature: ClassVar[str] = (
        "a force to the same side at both tips of the loops, less of it per deformation where the law softens"
    )
    source: ClassVar[str] = Even.source

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (Unknown("b", "", -0.95, 0.95, 0.3),)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return ((0.1,),)

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"r": sizes.displacement}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 + p["b"] * motion.displacement / p["r"])

    def dashpot_factor(self, p: Values, motion: Motion, factor: np.ndarray | float) -> float:
        return 1.0


FORMS = (
    ContactPositive,
    ContactNegative,
    SpringPositive,
    SpringNegative,
    FactorPositive,
    FactorNegative,
    SoftPositive,
    SoftNegative,
    Even,
    EvenSprings,
)
