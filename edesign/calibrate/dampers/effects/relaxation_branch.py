"""A relaxation that the law lacks: forces that fade in a time outside the law's own."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.drivers import fractional_rate, relaxed
from edesign.calibrate.dampers.effect import Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_BRANCHES = 4


class _Branch(Form):
    name: ClassVar[str] = "relaxation_branch"
    kind: ClassVar[Kind] = "damper"
    signature: ClassVar[str] = (
        "linear in the amplitude; stiffness and damping off by what changes with frequency, and a residual that fades "
        "after a change of the mean"
    )


class Maxwell(_Branch):
    """One more Maxwell branch beside the law: Q' + Q/tau = k v."""

    form: ClassVar[str] = "maxwell"
    title: ClassVar[str] = "a relaxation time that the law lacks"
    source: ClassVar[str] = "Christensen (1982), Theory of Viscoelasticity, section 1.6; thesis Eq. 4.4"
    amendment: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k, period = sizes.stiffness, sizes.period
        longest = 10.0 * max(sizes.duration, period)  # beyond: a spring
        return (
            Unknown("k", "N/m", -2.0 * k, 50.0 * k, 0.3 * k),
            Unknown("tau", "s", 1e-3 * period, longest, 0.1 * period, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        omega = 2.0 * np.pi / sizes.period
        times = sorted({s * sizes.period for s in (0.01, 0.05, 0.2, 1.0, 5.0)} | {0.3 * sizes.duration})
        # a force of a twentieth in the slowest motion; of less where the branch is fast
        return tuple((0.05 * sizes.stiffness * min(1.0 + 1.0 / (omega * t), 10.0), t) for t in times)

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return np.asarray(p["k"] * relaxed(motion, p["tau"]))


class Prony(_Branch):
    """Four Maxwell branches beside the law, i from 0: stiffness k r^(-p i), relaxation time tau r^i."""

    form: ClassVar[str] = "prony"
    title: ClassVar[str] = "a row of relaxation times that the law lacks"
    source: ClassVar[str] = (
        "Prony series with a power law of its weights: Baumgaertel & Winter (1992), J. Non-Newtonian Fluid Mech. 44, "
        "15-36; Schapery & Park (1999), Int. J. Solids Struct. 36, 1653-1675"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        own = Maxwell().unknowns(sizes)
        return (*own, Unknown("r", "", 2.0, 30.0, 8.0, logarithmic=True), Unknown("p", "", -1.0, 1.5, 0.5))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.05 * sizes.stiffness, s * sizes.period, 8.0, 0.3) for s in (0.01, 0.05))

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        rows = ((p["k"] * p["r"] ** (-p["p"] * i), p["tau"] * p["r"] ** i) for i in range(_BRANCHES))
        return np.asarray(sum(k * relaxed(motion, tau) for k, tau in rows))


class Springpot(_Branch):
    """A continuous spectrum of relaxation beside the law: Q = k T^alpha D^alpha u."""

    form: ClassVar[str] = "springpot"
    title: ClassVar[str] = "relaxation over many decades of time that the law lacks"
    source: ClassVar[str] = "Koeller (1984), J. Appl. Mech. 51, 299-307; Bagley & Torvik (1983), J. Rheol. 27, 201-210"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        k = sizes.stiffness
        return Unknown("k", "N/m", -2.0 * k, 5.0 * k, 0.3 * k), Unknown("alpha", "", 0.05, 0.95, 0.5)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.05 * sizes.stiffness, alpha) for alpha in (0.2, 0.5, 0.8))

    def fixed(self, sizes: Sizes) -> dict[str, float]:
        return {"T": sizes.period / (2.0 * np.pi)}

    def parallel(self, p: Values, trial: Trial, motion: Motion, memory: Memory) -> np.ndarray:
        return np.asarray(p["k"] * p["T"] ** p["alpha"] * fractional_rate(motion, p["alpha"]))


FORMS = (Maxwell, Springpot, Prony)
