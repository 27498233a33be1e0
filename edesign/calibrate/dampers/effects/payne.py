"""Amplitude (Payne) softening: the filler network breaks with strain and heals again."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.drivers import envelope
from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown
from edesign.core.fading import fading


class _Payne(Form):
    name: ClassVar[str] = "payne"
    may_be_inside: ClassVar[bool] = True
    kind: ClassVar[Kind] = "damper"
    signature: ClassVar[str] = (
        "the secant stiffness falls with the amplitude of the cycle and comes back when the amplitude falls"
    )
    source: ClassVar[str] = (
        "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92"
    )
    amendment: ClassVar[bool] = True

    def _unknowns(self, amplitude: Unknown, sizes: Sizes) -> tuple[Unknown, ...]:
        u, period = sizes.displacement, sizes.period
        return (
            amplitude,
            Unknown("a0", "m", 0.01 * u, 10.0 * u, 0.3 * u, logarithmic=True),
            Unknown("m", "", 0.3, 4.0, 1.0, logarithmic=True),
            Unknown("tau_a", "s", 0.1 * period, 1e4 * period, 3.0 * period, logarithmic=True),
        )

    def _starts(self, amplitude: float, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple(
            (amplitude, a * sizes.displacement, 1.0, t * sizes.period) for a in (0.1, 0.4, 1.2) for t in (1.0, 10.0)
        )

    def _amplitude(self, p: Values, motion: Motion) -> np.ndarray:
        return envelope(motion, p["tau_a"])

    def _broken(self, p: Values, motion: Motion) -> np.ndarray:
        ratio = (self._amplitude(p, motion) / p["a0"]) ** p["m"]
        return np.asarray(ratio / (1.0 + ratio))


class Whole(_Payne):
    """All of the law's force softens: F = (1 - d g(a)) F_law, g = (a/a0)^m / (1 + (a/a0)^m)."""

    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "whole"
    title: ClassVar[str] = "softening with amplitude of the whole force"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return self._unknowns(Unknown("d", "", -1.0, 0.95, 0.5), sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return self._starts(0.1, sizes)

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return np.asarray(1.0 - p["d"] * self._broken(p, motion))


class Exponential(Whole):
    """As `whole`, with g = 1 - exp(-(a/a0)^m)."""

    form: ClassVar[str] = "exponential"
    title: ClassVar[str] = "softening of the whole force that goes exponentially with amplitude"
    source: ClassVar[str] = "Payne (1962), J. Appl. Polym. Sci. 6, 57-63; the course with amplitude: phenomenological"
    amendment: ClassVar[bool] = False

    def _broken(self, p: Values, motion: Motion) -> np.ndarray:
        return np.asarray(-np.expm1(-((self._amplitude(p, motion) / p["a0"]) ** p["m"])))


class MeanSquare(Whole):
    """As `whole`, of the fading mean square of the deformation: a^2' = (2 u^2 - a^2)/tau_a."""

    form: ClassVar[str] = "mean_square"
    title: ClassVar[str] = "softening of the whole force with the mean square of the deformation"
    source: ClassVar[str] = "Lion & Kardelky (2004), Int. J. Plasticity 20, 1313-1345, averages the deformation process"
    amendment: ClassVar[bool] = False

    def _amplitude(self, p: Values, motion: Motion) -> np.ndarray:
        decay = np.exp(-motion.steps / p["tau_a"])
        square = 2.0 * motion.displacement**2
        mean = fading(decay, (1.0 - decay) * 0.5 * (square[1:] + square[:-1]), 0.0)
        return np.asarray(np.sqrt(np.maximum(mean, 0.0)))


class Kraus(Whole):
    """Springs soften and dashpots have a hump, both by Kraus: dashpots (1 - d g) (1 + 2 h sqrt(g (1 - g)))."""

    form: ClassVar[str] = "kraus"
    title: ClassVar[str] = "softening with amplitude of the springs and a hump of the losses"
    amendment: ClassVar[bool] = False
    may_be_inside: ClassVar[bool] = False
    may_spare_loss: ClassVar[bool] = False
    spares_loss: bool = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("h", "", -0.9, 5.0, 0.5))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, 0.2) for row in super().starts(sizes))

    def dashpot_factor(self, p: Values, motion: Motion, factor: np.ndarray | float) -> np.ndarray | float:
        broken = self._broken(p, motion)
        return np.asarray(factor * (1.0 + 2.0 * p["h"] * np.sqrt(broken * (1.0 - broken))))


class Elastic(_Payne):
    """The elastic force softens, its relaxing part does not: F = F_law - k g(a) u."""

    form: ClassVar[str] = "elastic"
    title: ClassVar[str] = "softening with amplitude of the elastic force"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = sizes.stiffness
        return self._unknowns(Unknown("k", "N/m", -2.0 * k, 2.0 * k, k), sizes)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return self._starts(0.1 * sizes.stiffness, sizes)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return np.asarray(-p["k"] * self._broken(p, motion) * motion.displacement)


class Network(Form):
    """The filler network breaks along the path and heals in time: x' = (1 - x) |v|/s0 - x/tau, F = (1 - d x) F_law."""

    name: ClassVar[str] = "payne"
    may_be_inside: ClassVar[bool] = True
    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "network"
    kind: ClassVar[Kind] = "damper"
    title: ClassVar[str] = "softening by a filler network that breaks with motion and heals in rest"
    signature: ClassVar[str] = (
        "the force falls within the first cycles, more in fast and large ones, and comes back at rest within seconds"
    )
    source: ClassVar[str] = (
        "Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92; Lion (1998), Rubber Chem. Technol. 71, 410-429"
    )
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        u, each = sizes.displacement, sizes.path / sizes.tests
        return (
            Unknown("d", "", -1.0, 0.95, 0.5),
            Unknown("s0", "m", 0.1 * u, 30.0 * each, u, logarithmic=True),
            Unknown("tau", "s", 0.1 * sizes.period, 30.0 * sizes.duration, sizes.period, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        u, period = sizes.displacement, sizes.period
        return tuple((0.2, s * u, t * period) for s in (1.0, 5.0, 25.0) for t in (0.5, 5.0))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        breaking = np.abs(motion.ways) / p["s0"]
        both = breaking + motion.steps / p["tau"]
        decay = np.exp(-both)
        return np.asarray(1.0 - p["d"] * fading(decay, breaking / both * (1.0 - decay), 0.0))


class Intrinsic(Form):
    """Moduli over a fading mean of the rate: F = F_law / (1 + d q), q' = (|v|/V - q)/tau."""

    name: ClassVar[str] = "payne"
    may_be_inside: ClassVar[bool] = True
    may_spare_loss: ClassVar[bool] = True
    form: ClassVar[str] = "intrinsic"
    kind: ClassVar[Kind] = "damper"
    title: ClassVar[str] = "softening by the fading mean of the deformation's rate"
    signature: ClassVar[str] = Network.signature
    source: ClassVar[str] = (
        "Lion (1998), Rubber Chem. Technol. 71, 410-429; Hoefer & Lion (2009), J. Mech. Phys. Solids 57, 500-520"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        period = sizes.period
        longest = max(sizes.duration, 4.0 * period)  # a longer one is worn or warmed
        return (
            Unknown("d", "", -0.3, 20.0, 0.5),
            Unknown("tau", "s", 0.1 * period, longest, period, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.1, t * sizes.period) for t in (0.3, 1.0, 3.0))

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"V": sizes.velocity}

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        decay = np.exp(-motion.steps / p["tau"])
        mean = np.abs(motion.ways) / motion.steps / p["V"]
        return np.asarray(1.0 / (1.0 + p["d"] * fading(decay, (1.0 - decay) * mean, 0.0)))


FORMS = (Whole, Exponential, MeanSquare, Elastic, Network, Intrinsic, Kraus)
