"""Hardening at large strain: the chains of the rubber come to their length."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LEAST_LENGTH = 1.01  # of the largest displacement of the tests fitted to
_NEAREST = 0.99  # a test to be predicted may go further than those


class _Hardening(Form):
    name: ClassVar[str] = "hardening"
    elastic: ClassVar[bool] = True
    may_be_inside: ClassVar[bool] = True
    kind: ClassVar[Kind] = "damper"
    signature: ClassVar[str] = (
        "too little force at the tips of large loops alone, odd in the deformation, the same at all frequencies"
    )

    def _spring(self, sizes: Sizes) -> Unknown:
        k = sizes.stiffness
        return Unknown("k", "N/m", -2.0 * k, 5.0 * k, 0.5 * k)


class _FromLargest(_Hardening):
    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"r": sizes.displacement}


class Power(_FromLargest):
    """A spring beside the law that stiffens with a power of the deformation: k u (|u|/r)^(p-1)."""

    form: ClassVar[str] = "power"
    title: ClassVar[str] = "elastic hardening at large strain"
    source: ClassVar[str] = (
        "odd power of the simple shear of Yeoh (1990), Rubber Chem. Technol. 63, 792-805, with a free exponent"
    )
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return self._spring(sizes), Unknown("p", "", 1.5, 15.0, 3.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.1 * sizes.stiffness, p) for p in (2.0, 3.0, 5.0, 9.0))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        u = motion.displacement
        return np.asarray(p["k"] * u * (np.abs(u) / p["r"]) ** (p["p"] - 1.0))


class Threshold(_Hardening):
    """A spring beside the law that begins at a deformation: k max(|u| - u0, 0) sgn u."""

    form: ClassVar[str] = "threshold"
    title: ClassVar[str] = "a second stiffness beyond a deformation"
    source: ClassVar[str] = (
        "bilinear hardening of high damping rubber: Grant, Fenves & Whittaker (2004), J. Struct. Eng. 130, 1683-1693"
    )
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k, u = sizes.stiffness, sizes.displacement
        return Unknown("k", "N/m", -5.0 * k, 20.0 * k, k), Unknown("u0", "m", 0.0, 0.98 * u, 0.3 * u)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k / (1.0 - share), share * u) for share in (0.3, 0.6, 0.8))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        u = motion.displacement
        return np.asarray(p["k"] * np.maximum(np.abs(u) - p["u0"], 0.0) * np.sign(u))


class Soft(Threshold):
    """As `threshold`, the spring begun over a width: k w ln((1 + exp((|u| - u0)/w)) / (1 + exp(-u0/w))) sgn u."""

    form: ClassVar[str] = "soft_threshold"
    title: ClassVar[str] = "a second stiffness that sets in softly about a deformation"
    amendment: ClassVar[bool] = False

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return (*super().unknowns(sizes), Unknown("w", "m", 1e-3 * u, 0.5 * u, 0.05 * u, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, 0.05 * sizes.displacement) for row in super().starts(sizes))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        size, w = np.abs(motion.displacement), p["w"]
        begun = np.logaddexp(0.0, (size - p["u0"]) / w) - np.logaddexp(0.0, -p["u0"] / w)
        return np.asarray(p["k"] * w * begun * np.sign(motion.displacement))


CURVED_BODIES = "contact of curved bodies: Jankowski (2005), Earthquake Engng Struct. Dyn. 34, 595-611 (power 3/2)"


def contact_force(p: Values, beyond: np.ndarray) -> np.ndarray:
    """Force, N, of a contact whose bodies have come nearer than their first touch by `beyond`, m: k x (x/r)^(n - 1)."""
    return np.asarray(p["k"] * beyond * (beyond / p["r"]) ** (p["n"] - 1.0))


class Contact(_FromLargest):
    """A contact that stiffens from a deformation on: k x (x/r)^(n - 1) sgn u, x = max(|u| - u0, 0)."""

    form: ClassVar[str] = "contact"
    title: ClassVar[str] = "contact that stiffens beyond a deformation"
    source: ClassVar[str] = CURVED_BODIES

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return contact_unknowns(sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k / (1.0 - share) ** 1.5, share * u, 1.5) for share in (0.3, 0.6))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        beyond = np.maximum(np.abs(motion.displacement) - p["u0"], 0.0)
        return contact_force(p, beyond) * np.sign(motion.displacement)


class Exponential(_Hardening):
    """A spring beside the law that stiffens exponentially: k u (exp((u/u0)^2) - 1)."""

    form: ClassVar[str] = "exponential"
    title: ClassVar[str] = "exponential hardening at large strain"
    source: ClassVar[str] = "Fung (1993), Biomechanics: Mechanical Properties of Living Tissues, section 7.5"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return self._spring(sizes), Unknown("u0", "m", 0.3 * u, 5.0 * u, u, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k / math.expm1(share**-2), share * u) for share in (0.5, 1.0))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        u = motion.displacement
        return np.asarray(p["k"] * u * np.expm1((u / p["u0"]) ** 2))


class Gent(_Hardening):
    """A spring beside the law whose chains come to an end: k u x^2/(1 - x^2), x = u/u_m, x^2 at most _NEAREST."""

    form: ClassVar[str] = "gent"
    title: ClassVar[str] = "hardening towards the length of the chains"
    source: ClassVar[str] = "simple shear of Gent (1996), Rubber Chem. Technol. 69, 59-61, less its initial stiffness"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        return self._spring(sizes), Unknown("u_m", "m", _LEAST_LENGTH * u, 10.0 * u, u, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        k, u = sizes.stiffness, sizes.displacement
        return tuple((0.1 * k * (length**2 - 1.0), length * u) for length in (1.1, 1.5))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        square = np.minimum((motion.displacement / p["u_m"]) ** 2, _NEAREST)
        return np.asarray(p["k"] * motion.displacement * square / (1.0 - square))


class Springs(_FromLargest):
    """The law's springs stiffen with a power of the deformation, softened ones too: k (1 + b (|u|/r)^p) u, dashpots as
    they are.
    """

    may_be_inside: ClassVar[bool] = False
    spares_loss: bool = True
    of_mgmm: bool = True
    elastic: ClassVar[bool] = False
    form: ClassVar[str] = "springs"
    title: ClassVar[str] = "hardening of the law's springs at large strain"
    signature: ClassVar[str] = (
        "too little force at the tips of large loops alone, less of it in tests in which the law has softened"
    )
    source: ClassVar[str] = "Yeoh (1990), Rubber Chem. Technol. 63, 792-805: all terms by one measure of stiffness"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Unknown("b", "", -0.9, 20.0, 0.3), Unknown("p", "", 0.5, 15.0, 2.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (0.1, 2.0), (0.1, 6.0)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 + p["b"] * (np.abs(motion.displacement) / p["r"]) ** p["p"])

    def dashpot_factor(self, p: Values, motion: Motion, factor: np.ndarray | float) -> float:
        return 1.0


class SpringsToTheEnd(Springs):
    """The law's springs stiffen towards the length of the chains: k (1 + b x^2/(1 - x^2)) u, x = u/u_m, x^2 at most
    _NEAREST.
    """

    form: ClassVar[str] = "springs_gent"
    title: ClassVar[str] = "hardening of the law's springs towards the length of the chains"
    source: ClassVar[str] = Gent.source

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u = sizes.displacement
        length = Unknown("u_m", "m", _LEAST_LENGTH * u, 10.0 * u, u, logarithmic=True)
        return Unknown("b", "", -0.9, 20.0, 0.3), length

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.1 * (length**2 - 1.0), length * sizes.displacement) for length in (1.2, 2.5))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        square = np.minimum((motion.displacement / p["u_m"]) ** 2, _NEAREST)
        return np.asarray(1.0 + p["b"] * square / (1.0 - square))


class SpringsBeyond(Springs):
    """The law's springs stiffen beyond a deformation: k (1 + b (x/r)^n) u, x = max(|u| - u0, 0)."""

    form: ClassVar[str] = "springs_beyond"
    title: ClassVar[str] = "hardening of the law's springs beyond a deformation"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        _, begins, power = contact_unknowns(sizes)
        return Unknown("b", "", -0.9, 50.0, 0.3), begins, power

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.3, share * sizes.displacement, 2.0) for share in (0.3, 0.6))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        beyond = np.maximum(np.abs(motion.displacement) - p["u0"], 0.0)
        return np.asarray(1.0 + p["b"] * (beyond / p["r"]) ** p["n"])


class Inside(_FromLargest):
    """The whole law stiffens, its relaxing forces too: it sees u (1 + b (|u|/r)^p)."""

    may_be_inside: ClassVar[bool] = False
    form: ClassVar[str] = "inside"
    title: ClassVar[str] = "hardening at large strain of all forces, quasi-linear viscoelasticity"
    signature: ClassVar[str] = (
        "too little force towards the tips of large loops, and too little damping in them, at all frequencies"
    )
    source: ClassVar[str] = "Fung (1993), Biomechanics: Mechanical Properties of Living Tissues, section 7.6"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return Unknown("b", "", -0.3, 3.0, 0.3), Unknown("p", "", 1.0, 10.0, 2.0, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return (0.1, 2.0), (0.1, 4.0), (0.1, 8.0)

    def specimen(self, p: Values, trial: Trial, motion: Motion) -> Motion:
        u, v, b, m = motion.displacement, motion.velocity, p["b"], p["p"]
        x = np.abs(u) / p["r"]
        more = b * x**m
        slope = 1.0 + (1.0 + m) * more
        bend = b * m * (1.0 + m) * x ** (m - 1.0) * np.sign(u) / p["r"]
        return Motion(motion.time, u * (1.0 + more), slope * v, slope * motion.acceleration + bend * v * v)


def contact_unknowns(sizes: Sizes) -> tuple[Unknown, ...]:
    """Stiffness, beginning and power of a contact, to both sides or one."""
    k, u = sizes.stiffness, sizes.displacement
    return (
        Unknown("k", "N/m", -20.0 * k, 100.0 * k, k),
        Unknown("u0", "m", 0.0, 0.98 * u, 0.3 * u),
        Unknown("n", "", 1.0, 5.0, 1.0),
    )


FORMS = (Power, Threshold, Soft, Contact, Exponential, Gent, Springs, SpringsToTheEnd, SpringsBeyond, Inside)
