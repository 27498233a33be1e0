"""Non-linear links of a storey, beside its linear stiffness: what a time step asks of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from edesign.core import CoreError
from edesign.damper.damper import Damper


class Link:
    """A force between the two floors of a storey.

    Attributes:
        storey: it stands in; 0 is the lowest storey or the isolation layer.
        stiffest: bound of its tangent stiffness, N/m, by which steps are divided.
    """

    def __init__(self, storey: int, stiffest: float) -> None:
        self.storey = storey
        self.stiffest = stiffest

    def begin(self, step: float) -> None:
        """A test begins at rest, in steps of so many seconds; what the link remembers of earlier tests stays."""

    def force(self, u: float, v: float) -> float:
        """Force (N) if the step that goes on ends at the deformation u (m) and velocity v (m/s)."""
        raise NotImplementedError

    def commit(self, u: float, v: float) -> None:
        """The step ended there, where `force` was asked last."""


class Together(Link):
    """Links of one storey as one."""

    def __init__(self, links: Sequence[Link]) -> None:
        super().__init__(links[0].storey, sum(abs(link.stiffest) for link in links))
        self.links = tuple(links)

    def begin(self, step: float) -> None:
        """All of them at rest."""
        for link in self.links:
            link.begin(step)

    def force(self, u: float, v: float) -> float:
        """Sum of their forces, N."""
        return sum([link.force(u, v) for link in self.links])

    def commit(self, u: float, v: float) -> None:
        """All of them remember the step."""
        for link in self.links:
            link.commit(u, v)


def by_storey(links: Sequence[Link]) -> list[Link]:
    """The same links, those of each storey as one."""
    storeys: dict[int, list[Link]] = {}
    for link in links:
        storeys.setdefault(link.storey, []).append(link)
    return [own[0] if len(own) == 1 else Together(own) for own in storeys.values()]


class Hysteresis(Link):
    """Bouc-Wen force of zero stiffness after yielding, beta = gamma = 0.5, A = n = 1: exact in each step.

    Source: Wen (1976); dz/du = (1 - |z|) / Y in loading, 1 / Y in unloading.
    """

    def __init__(self, storey: int, strength: float, yielding: float) -> None:
        super().__init__(storey, strength / yielding)
        self.strength, self.yielding = strength, yielding
        self.u = self.z = self.trial = 0.0

    def begin(self, step: float) -> None:
        """At rest."""
        self.u = self.z = self.trial = 0.0

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        x, z, sign = (u - self.u) / self.yielding, self.z, 1.0
        if x < 0.0:
            x, z, sign = -x, -z, -1.0
        if z < 0.0 and x <= -z:
            self.trial = sign * (z + x)
        elif z < 0.0:
            self.trial = sign * (1.0 - math.exp(-x - z))
        else:
            self.trial = sign * (1.0 - (1.0 - z) * math.exp(-x))
        return self.strength * self.trial

    def commit(self, u: float, v: float) -> None:
        """Remember the end of the step, which was tried last."""
        self.z, self.u = self.trial, u


class Slider(Link):
    """Coulomb friction behind a spring: elastic and ideally plastic."""

    def __init__(self, storey: int, friction: float, stiffness: float) -> None:
        super().__init__(storey, stiffness)
        self.friction, self.stiffness = friction, stiffness
        self.slip = 0.0

    def begin(self, step: float) -> None:
        """At rest."""
        self.slip = 0.0

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        return min(max(self.stiffness * (u - self.slip), -self.friction), self.friction)

    def commit(self, u: float, v: float) -> None:
        """Remember the slip."""
        self.slip = u - self.force(u, v) / self.stiffness


class PowerSpring(Link):
    """k u (|u| / r)^(p - 1)."""

    def __init__(self, storey: int, k: float, p: float, r: float) -> None:
        super().__init__(storey, 3.0 * k * p)  # at deformations up to about twice r
        self.k, self.p, self.r = k, p, r

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        return self.k * u * (abs(u) / self.r) ** (self.p - 1.0) if u else 0.0


class ThresholdSpring(Link):
    """k (|u| - u0) sgn u beyond u0."""

    def __init__(self, storey: int, k: float, u0: float) -> None:
        super().__init__(storey, k)
        self.k, self.u0 = k, u0

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        return self.k * math.copysign(max(abs(u) - self.u0, 0.0), u)


class FadingSpring(Link):
    """Stiffness that a fading envelope a of the deformation takes away: -k g(a) u, g = (a/a0)^m / (1 + (a/a0)^m)."""

    def __init__(self, storey: int, k: float, a0: float, m: float, tau: float) -> None:
        super().__init__(storey, k)
        self.k, self.a0, self.m, self.tau = k, a0, m, tau
        self.a, self.fade = 0.0, 1.0

    def begin(self, step: float) -> None:
        """At rest."""
        self.a, self.fade = 0.0, math.exp(-step / self.tau)

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        ratio = (max(abs(u), self.a * self.fade) / self.a0) ** self.m
        return -self.k * ratio / (1.0 + ratio) * u

    def commit(self, u: float, v: float) -> None:
        """Remember the envelope."""
        self.a = max(abs(u), self.a * self.fade)


class BreakingSpring(Link):
    """k exp(-(M/d)^2) u with M the largest deformation ever, also in earlier tests."""

    def __init__(self, storey: int, k: float, d: float) -> None:
        super().__init__(storey, k)
        self.k, self.d, self.largest = k, d, 0.0

    def force(self, u: float, v: float) -> float:
        """Force, N."""
        return self.k * math.exp(-((max(abs(u), self.largest) / self.d) ** 2)) * u

    def commit(self, u: float, v: float) -> None:
        """Remember the largest deformation."""
        self.largest = max(abs(u), self.largest)


class LawLink(Link):
    """Any damper law of the core."""

    def __init__(self, storey: int, damper: Damper, stiffest: float) -> None:
        super().__init__(storey, stiffest)
        self.core = damper.core
        self.step, self.before = 0.0, (0.0, 0.0)
        self.state = self.trial = self.core.start()

    def begin(self, step: float) -> None:
        """At rest."""
        self.step, self.before, self.state = step, (0.0, 0.0), self.core.start()

    def force(self, u: float, v: float) -> float:
        """Force, N; not finite where the law does not converge, so that there is no response."""
        try:
            self.trial, force, _ = self.core.step(self.state, self.step, self.before, (u, v))
        except CoreError:
            return math.nan
        return force

    def commit(self, u: float, v: float) -> None:
        """Remember the state of the law."""
        self.state, self.before = self.trial, (u, v)
