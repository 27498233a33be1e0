"""Viscous force with another power of the velocity than the law has."""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LEAST, _MOST = 0.1, 3.0  # below it is friction; above it there is no damper
_EXPONENTS = 0.01, 2.0  # of the MGMM


class _Velocity(Form):
    name: ClassVar[str] = "velocity_exponent"
    may_be_inside: ClassVar[bool] = True
    kind: ClassVar[Kind] = "damper"
    signature: ClassVar[str] = (
        "in phase with the velocity, largest where the deformation passes zero, with a power of amplitude times "
        "frequency; nothing at the tips"
    )


class Dashpot(_Velocity):
    """A dashpot with a power of the velocity beside the law: c |v|^alpha sgn v."""

    refined: int = 4  # its force may jump where the velocity changes its sign
    form: ClassVar[str] = "dashpot"
    title: ClassVar[str] = "viscous force with a power of the velocity that the law lacks"
    source: ClassVar[str] = "Constantinou & Symans (1993), Struct. Des. Tall Build. 2, 93-132; thesis Eq. 2.24"
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        largest = 2.0 * sizes.force / min(sizes.velocity**_LEAST, sizes.velocity**_MOST)
        size = 0.3 * sizes.force / sizes.velocity
        return (
            Unknown("c", "N*(s/m)^alpha", -largest, largest, size),
            Unknown("alpha", "", _LEAST, _MOST, 1.0, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.08 * sizes.force / sizes.velocity**alpha, alpha) for alpha in (0.2, 0.5, 1.0, 2.0))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        v = motion.velocity
        return np.asarray(p["c"] * np.abs(v) ** p["alpha"] * np.sign(v))


class Flow(_Velocity):
    """Activated flow beside the law, linear when slow and logarithmic when fast: f asinh(v/v0)."""

    form: ClassVar[str] = "flow"
    title: ClassVar[str] = "viscous force that saturates with the velocity"
    source: ClassVar[str] = "Eyring (1936), J. Chem. Phys. 4, 283-291"
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        force, v = sizes.force, sizes.velocity
        return Unknown("f", "N", -force, force, 0.1 * force), Unknown(
            "v0", "m/s", 1e-4 * v, v, 0.1 * v, logarithmic=True
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.06 * sizes.force / math.asinh(1.0 / x), x * sizes.velocity) for x in (0.01, 0.1, 0.5))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return np.asarray(p["f"] * np.arcsinh(motion.velocity / p["v0"]))


class Carreau(_Velocity):
    """A dashpot beside the law, linear when slow and of another power when fast: c v (1 + (v/v0)^2)^((alpha - 1)/2)."""

    form: ClassVar[str] = "carreau"
    title: ClassVar[str] = "viscous force whose power changes above a velocity"
    source: ClassVar[str] = "Carreau (1972), Trans. Soc. Rheol. 16, 99-127"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        c, v = sizes.force / sizes.velocity, sizes.velocity
        return (
            Unknown("c", "N*s/m", -10.0 * c, 10.0 * c, 0.3 * c),
            Unknown("v0", "m/s", 0.01 * v, 2.0 * v, 0.2 * v, logarithmic=True),
            Unknown("alpha", "", _LEAST, _MOST, 1.0, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        c, v = sizes.force / sizes.velocity, sizes.velocity
        return (0.2 * c, 0.1 * v, 0.3), (0.1 * c, 0.3 * v, 0.3), (0.05 * c, 0.3 * v, 2.0)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        v = motion.velocity
        return np.asarray(p["c"] * v * (1.0 + (v / p["v0"]) ** 2) ** (0.5 * (p["alpha"] - 1.0)))


class Exponent(_Velocity):
    """The law's own dashpots take another exponent above a velocity: dashpots (1 + (v/v0)^2)^(n/2)."""

    may_be_inside: ClassVar[bool] = False
    may_be_of_power: ClassVar[bool] = True
    spares_loss: bool = True
    spares_springs: bool = True
    form: ClassVar[str] = "exponent"
    title: ClassVar[str] = "another exponent of the law's dashpots above a velocity"
    source: ClassVar[str] = "Carreau (1972), Trans. Soc. Rheol. 16, 99-127, as a factor"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        v = sizes.velocity
        return Unknown("n", "", -2.0, 2.0, 0.5), Unknown("v0", "m/s", 1e-3 * v, v, 0.2 * v, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.2, share * sizes.velocity) for share in (0.02, 0.1, 0.4))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray((1.0 + (motion.velocity / p["v0"]) ** 2) ** (0.5 * p["n"]))


class Bend(Exponent):
    """The same, the bend as sharp or as gentle as it is: dashpots (1 + |v/v0|^a)^(n/a)."""

    form: ClassVar[str] = "bend"
    title: ClassVar[str] = "another exponent of the law's dashpots above a velocity, the bend of any sharpness"
    source: ClassVar[str] = "Yasuda, Armstrong & Cohen (1981), Rheol. Acta 20, 163-178, as a factor"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("a", "", 0.5, 100.0, 2.0, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*start, a) for start in super().starts(sizes) for a in (1.0, 6.0))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        with np.errstate(divide="ignore"):
            over = p["a"] * np.log(np.abs(motion.velocity) / p["v0"])
        return np.exp(p["n"] / p["a"] * np.logaddexp(0.0, over))


class OwnExponent(_Velocity):
    """The MGMM's own exponent is another one: alpha + n, with the same force of that dashpot at a velocity v0. It does
    nothing to other laws.
    """

    may_be_inside: ClassVar[bool] = False
    of_mgmm: bool = True
    form: ClassVar[str] = "own_exponent"
    title: ClassVar[str] = "another exponent of the law's dashpot of a power of the velocity"
    source: ClassVar[str] = "thesis Eq. 4.29: alpha and c_NL of another compound"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        v = sizes.velocity
        return Unknown("n", "", -1.5, 1.5, 0.2), Unknown("v0", "m/s", 1e-4 * v, 1e2 * v, 0.2 * v, logarithmic=True)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.1, share * sizes.velocity) for share in (0.01, 0.1, 0.5))

    def law(self, p: Values, trial: Trial, values: dict[str, float]) -> dict[str, float]:
        if not {"alpha", "c_NL"} <= values.keys():
            return values
        low, high = _EXPONENTS
        n = min(max(p["n"], low - values["alpha"]), high - values["alpha"])
        return {**values, "alpha": values["alpha"] + n, "c_NL": values["c_NL"] * p["v0"] ** -n}


FORMS = (Dashpot, Flow, Carreau, Exponent, Bend, OwnExponent)
