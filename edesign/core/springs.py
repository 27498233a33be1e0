"""Laws of springs without length: of force and deformation, or of moment and rotation."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Self

from edesign.core._edcore import lib


@dataclass(frozen=True)
class MultilinearSpring:
    """A symmetric line with corners, kinematic hardening and Masing's rule; without corners the spring is linear.

    Attributes:
        corners: (deformation, force) of each, 0 to 4, rising and less and less steep.
        slope: stiffness after the last corner.
    """

    slope: float
    corners: tuple[tuple[float, float], ...] = ()

    @classmethod
    def bilinear(cls, stiffness: float, resistance: float | None, hardening: float = 0.0) -> Self:
        """Return a spring that yields at its resistance, and then has `hardening` times its stiffness.

        Args:
            stiffness: at the start.
            resistance: force or moment; None: it stays linear.
            hardening: ratio, at least 0 and less than 1.
        """
        if resistance is None:
            return cls(stiffness)
        return cls(hardening * stiffness, ((resistance / stiffness, resistance),))

    @property
    def stiffness(self) -> float:
        """Stiffness at the start."""
        return self.corners[0][1] / self.corners[0][0] if self.corners else self.slope

    def parameters(self) -> tuple[int, list[float]]:
        """Return the core's number of the law and its parameters."""
        return lib.ED_SPRING_MULTILINEAR, [*(value for corner in self.corners for value in corner), self.slope]


@dataclass(frozen=True)
class ContactSpring:
    """A spring that pushes (negative force) and does not pull; at its capacity it gives way for good."""

    stiffness: float
    capacity: float = inf

    def parameters(self) -> tuple[int, list[float]]:
        """Return the core's number of the law and its parameters."""
        return lib.ED_SPRING_CONTACT, [self.stiffness, self.capacity]


@dataclass(frozen=True)
class DeterioratingSide:
    """One side of a deteriorating spring; all positive.

    Attributes:
        plastic: deformation from yield to capping (theta_p).
        capping: deformation from capping to no force (theta_pc).
        ultimate: deformation at which all is lost (theta_u).
        yield_force: effective yield strength (M_y).
        capped: strength at capping over that at yield (M_c / M_y).
        residual: residual strength over that at yield (kappa).
        rate: D, from 0 to 1: 1 deteriorates at the full rate.
    """

    plastic: float
    capping: float
    ultimate: float
    yield_force: float
    capped: float
    residual: float = 0.0
    rate: float = 1.0


@dataclass(frozen=True)
class DeterioratingSpring:
    """The modified Ibarra-Medina-Krawinkler law with bilinear hysteresis.

    Sources: Ibarra, Medina & Krawinkler 2005, Earthquake Engineering and Structural Dynamics 34, 1489-1511; Lignos &
    Krawinkler 2011, Journal of Structural Engineering 137, 1291-1302.

    Attributes:
        stiffness: elastic stiffness.
        positive, negative: the sides.
        strength, after_capping, unloading: energies E_t = Lambda M_y that may be dissipated until nothing is left of
            the strength, the line after capping, the unloading stiffness; inf: no deterioration.
        exponents: c of the three.
    """

    stiffness: float
    positive: DeterioratingSide
    negative: DeterioratingSide
    strength: float = inf
    after_capping: float = inf
    unloading: float = inf
    exponents: tuple[float, float, float] = (1.0, 1.0, 1.0)

    def parameters(self) -> tuple[int, list[float]]:
        """Return the core's number of the law and its parameters."""
        values = [self.stiffness]
        for side in (self.positive, self.negative):
            values += [side.plastic, side.capping, side.ultimate, side.yield_force]
            values += [side.capped, side.residual, side.rate]
        values += [self.strength, self.after_capping, self.unloading, *self.exponents]
        return lib.ED_SPRING_DETERIORATING, values


SpringLaw = MultilinearSpring | ContactSpring | DeterioratingSpring
