"""Self-heating: dissipated work warms the elastomer within a test, and warm it is softer."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.counted_work import how_counted, sized
from edesign.calibrate.dampers.drivers import worked
from edesign.calibrate.dampers.effect import BEGUN, Form, Memory
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown

_LONGEST = 100.0  # tests: heat that stays longer does not change within one
_NODES = np.array([0.0, 0.2, 0.4, 0.7, 1.0])  # of q, at which the law is predicted


Factor = Callable[[np.ndarray], np.ndarray]


def _softened(q: np.ndarray) -> np.ndarray:
    return np.asarray(np.exp(np.clip(-q, -50.0, 50.0)))  # a search may ask for more heat than a float can follow


class Rate(Form):
    """Heat by work, lost in time, none at the beginning of a test: F = exp(-q) F_law, q' = beta F v - q/tau_h."""

    name: ClassVar[str] = "self_heating"
    counts_work: ClassVar[bool] = True
    may_spare_loss: ClassVar[bool] = True
    loss_start: ClassVar[float] = 2.0  # what is warm loses damping before stiffness
    form: ClassVar[str] = "rate"
    kind: ClassVar[Kind] = "damper"
    title: ClassVar[str] = "softening by self-heating within a test"
    signature: ClassVar[str] = (
        "the force falls with the work done within a test, fastest in large and fast tests, comes back in pauses, and "
        "is whole again in the next test"
    )
    source: ClassVar[str] = (
        "Kasai, Munshi, Lai & Maison (1993), ATC-17-1; lumped heat balance, Incropera & DeWitt, Fundamentals of Heat "
        "and Mass Transfer, section 5.1"
    )
    amendment: ClassVar[bool] = True
    evened = False
    sized = False

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        each = sizes.tests / sizes.work  # q = 1 by the work of one test
        return (
            Unknown("beta", "1/J", 0.0, 20.0 * each, each),
            Unknown("tau_h", "s", 0.3 * sizes.period, _LONGEST * sizes.duration, sizes.duration, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        each = sizes.tests / sizes.work
        quick = max(0.2 * sizes.duration, sizes.period)
        return (0.2 * each, quick), *((0.1 * each, t * sizes.duration) for t in (1.0, 3.0, _LONGEST))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return self._warmed(p, motion, force, _softened, memory)[0]

    def _warmed(
        self,
        p: Values,
        motion: Motion,
        force: np.ndarray,
        soft: Factor,
        memory: Memory,
        before: float = 0.0,
        quick: tuple[float, float] = (0.0, math.inf),
    ) -> tuple[np.ndarray, float]:
        """Factor (n,) of the force (n,) N, and q at the end; `before` is what is left of earlier tests."""
        return worked(
            motion,
            factor=soft,
            before=before + memory.get(BEGUN, 0.0),
            gain=p["beta"],
            forgets=p["tau_h"],
            quick=quick,
            **how_counted(self, p, motion, force, memory),
        )

    def finer(self) -> tuple[Form, ...]:
        """Heat left from before a test, another one in each, as pauses between tests are not recorded: q(0) = q_i.
        Without the work that springs give back within a cycle, which is no heat: the power behind by a time tau_w, and
        never below zero. Or with a share of it counted as if it were done.
        """
        begun = () if self.begins else (self._begun_warm(),)
        return (*begun, *(() if self.evened or self.sized else (self._evened(), sized(self))))

    def _begun_warm(self) -> Form:
        return self.variant("begun_warm", "each test begun as warm as it shows", begins=True, may_be_shaped=False)

    def _evened(self) -> Form:
        unknowns, starts = self.unknowns, self.starts

        def more_unknowns(sizes: Sizes) -> tuple[Unknown, ...]:
            own, t = unknowns(sizes), sizes.period
            return (*own, Unknown("tau_w", "s", 0.02 * t, 5.0 * t, 0.3 * t, logarithmic=True)) if own else ()

        return self.variant(
            "evened",
            "less the work that springs give back",
            evened=True,
            may_be_shaped=False,
            unknowns=more_unknowns,
            starts=lambda sizes: tuple((*row, 0.2 * sizes.period) for row in starts(sizes)),
        )


class Core(Rate):
    """A core that hands its heat on within seconds, beside `rate`: q is the sum of two, of two times and gains."""

    form: ClassVar[str] = "core"
    title: ClassVar[str] = "softening by self-heating of a core and of the whole damper"
    signature: ClassVar[str] = "as self_heating.rate, and a part of the force comes back within seconds of rest"
    source: ClassVar[str] = (
        "two nodes of a heat balance: Incropera & DeWitt, Fundamentals of Heat and Mass Transfer, sections 5.1 and 5.3"
    )
    amendment: ClassVar[bool] = False

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        each = sizes.tests / sizes.work
        quick = Unknown("tau_c", "s", 0.1 * sizes.period, 3.0 * sizes.duration, 0.3 * sizes.duration, logarithmic=True)
        return (*super().unknowns(sizes), Unknown("beta_c", "1/J", 0.0, 20.0 * each, each), quick)

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        each, t = sizes.tests / sizes.work, sizes.duration
        return tuple(
            (0.1 * each, slow * t, 0.1 * each, quick * t)
            for slow, quick in ((3.0, 0.3), (_LONGEST, 0.5), (_LONGEST, 0.1))
        )

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return self._warmed(p, motion, force, _softened, memory, quick=(p["beta_c"], p["tau_c"]))[0]


class Carried(Rate):
    """As `rate`, but a share of the heat is still there when the next test begins."""

    form: ClassVar[str] = "carried"
    title: ClassVar[str] = "softening by self-heating, part of which lasts into the next test"
    signature: ClassVar[str] = "as self_heating.rate, and a test that follows a heavy one begins with too little force"
    amendment: ClassVar[bool] = False
    remembers: ClassVar[bool] = True

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("kept", "", 0.0, 1.0, 1.0)) if sizes.tests > 1 else ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        if sizes.tests < 2:
            return ()
        return tuple((*row, 0.5) for row in super().starts(sizes))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        return self._kept_warm(p, motion, force, _softened, memory)

    def _kept_warm(self, p: Values, motion: Motion, force: np.ndarray, soft: Factor, memory: Memory) -> np.ndarray:
        """Factor (n,) of the force (n,) N, with what is left of the heat of earlier tests."""
        phi, memory["heat"] = self._warmed(p, motion, force, soft, memory, p["kept"] * memory.get("heat", 0.0))
        return phi


class Levelling(Carried):
    """As `carried`, but the softening levels off: F = (1 + q/m)^-m F_law, as a modulus does beyond its transition."""

    form: ClassVar[str] = "levelling"
    may_spare_loss: ClassVar[bool] = False
    title: ClassVar[str] = "softening by self-heating that levels off"
    signature: ClassVar[str] = "as self_heating.carried, and ever less of it the warmer the damper is"
    source: ClassVar[str] = (
        "heat balance as of rate; the fall of the modulus over a transition: Ferry (1980), Viscoelastic Properties of "
        "Polymers, chapter 11"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        own = super().unknowns(sizes)
        return (*own, Unknown("m", "", 0.05, 20.0, 1.0, logarithmic=True)) if own else ()

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, 0.5) for row in super().starts(sizes))

    def factor(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory) -> np.ndarray:
        m = p["m"]

        def left(q: np.ndarray) -> np.ndarray:
            return np.asarray((1.0 + np.maximum(q, 0.0) / m) ** -m)

        return self._kept_warm(p, motion, force, left, memory)


class Gamma(Carried):
    """As `carried`, but heat acts as the temperature of the tests does in the MGMM: gamma_T falls with exp(-q), and all
    of the law's parameters with it. q is as good as still within the relaxation time of the law.
    """

    form: ClassVar[str] = "gamma"
    of_mgmm: bool = True
    may_spare_loss: ClassVar[bool] = False
    may_be_shaped: bool = False
    title: ClassVar[str] = "self-heating that acts as the law's own gamma_T does"
    signature: ClassVar[str] = "as self_heating.carried, and warm the damper softens sooner with amplitude"
    source: ClassVar[str] = "heat balance as of rate; gamma_T of all parameters: thesis section 4.5, Eqs. 4.34-4.36"

    def factor(  # type: ignore[override]
        self, p: Values, trial: Trial, motion: Motion, force: np.ndarray, memory: Memory
    ) -> None:
        return None

    def heated(
        self, p: Values, motion: Motion, at_rate: Callable[[float], np.ndarray], memory: Memory
    ) -> np.ndarray | None:
        family = np.stack([at_rate(float(np.exp(-q))) for q in _NODES])
        ones = np.ones_like(motion.time)
        return self._kept_warm(p, motion, ones, _between_nodes(family), memory) - family[0]


def _between_nodes(family: np.ndarray) -> Factor:
    """Values (n,) at q (n,) of the polynomials through a family (nodes, n) of histories (Newton's)."""
    differences = family.copy()
    for order in range(1, len(_NODES)):
        spans = (_NODES[order:] - _NODES[:-order])[:, np.newaxis]
        differences[order:] = (differences[order:] - differences[order - 1 : -1]) / spans

    def between(q: np.ndarray) -> np.ndarray:
        q = np.clip(q, -_NODES[1], _NODES[-1])
        found = differences[-1]
        for node, difference in zip(_NODES[-2::-1], differences[-2::-1], strict=True):
            found = difference + (q - node) * found
        return np.asarray(found)

    return between


FORMS = (Rate, Carried, Levelling, Core, Gamma)
