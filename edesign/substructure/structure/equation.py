"""What every method of integration shares: the equation of motion at a step, and what is known at its start."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from edesign.substructure.structure.numerical import LinearPart

ForceBetween = Literal["held", "extrapolated"]


@dataclass(frozen=True)
class Known:
    """Quantities that are known at the start of a step.

    Attributes:
        force, force_before: of the specimen at the start of this step and of the last, N.
        ground, ground_ahead: acceleration of the ground at the start and at the end, m/s2.
    """

    force: float
    force_before: float
    ground: float
    ground_ahead: float

    def force_at(self, share: float, force: ForceBetween) -> float:
        """Return the assumed force after a share of the step, N.

        Args:
            share: 0 to 1.
            force: how the force goes on in the step.
        """
        return self.force + (share * (self.force - self.force_before) if force == "extrapolated" else 0.0)

    def ground_at(self, share: float) -> float:
        """Return the ground acceleration after a share of the step, m/s2; it is linear over the step.

        Args:
            share: 0 to 1.
        """
        return self.ground + share * (self.ground_ahead - self.ground)


@dataclass(frozen=True)
class Motion:
    """Motion of all degrees at an instant: (n,) m, m/s, m/s2 relative to the ground."""

    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


Instant = Callable[[np.ndarray, float, float], tuple[np.ndarray, Motion]]
"""(state at instant k, F_k in N, a_g,k in m/s2) -> (state at instant k + 1, motion at instant k)."""

Advance = Callable[[np.ndarray, Known], np.ndarray]
"""(displacements and velocities at the start of the step, what is known) -> those at its end."""


@dataclass(frozen=True)
class Equation:
    """Equation of motion of a numerical part at a step.

    Attributes:
        part: the numerical part.
        step: dt, s.
        specimen_stiffness: estimate that the parameters of a method are made with, N/m.
        rho: spectral radius at infinite frequency that is asked for.
    """

    part: LinearPart
    step: float
    specimen_stiffness: float
    rho: float

    @cached_property
    def whole_stiffness(self) -> np.ndarray:
        """Stiffness (n, n) in N/m with the estimate of the specimen's."""
        return self.part.with_specimen(self.specimen_stiffness)

    @cached_property
    def inverse_mass(self) -> np.ndarray:
        """Accelerations (n, n) by forces, 1/kg."""
        return np.linalg.inv(self.part.mass)

    @cached_property
    def inertia(self) -> np.ndarray:
        """Load (n,) in kg against a ground acceleration of 1."""
        return np.asarray(self.part.mass @ self.part.influence)

    def load(self, force: float, ground: float) -> np.ndarray:
        """Return -M influence a_g - interface F, (n,) N.

        Args:
            force: of the specimen, N.
            ground: acceleration a_g, m/s2.
        """
        return np.asarray(-self.inertia * ground - self.part.interface * force)

    def unbalance(self, displacement: np.ndarray, velocity: np.ndarray, force: float, ground: float) -> np.ndarray:
        """Return the force that accelerates the masses, (n,) N.

        Args:
            displacement: (n,) m.
            velocity: (n,) m/s.
            force: of the specimen, N.
            ground: acceleration a_g, m/s2.
        """
        part = self.part
        return np.asarray(self.load(force, ground) - part.damping @ velocity - part.stiffness @ displacement)

    def balanced(self, displacement: np.ndarray, velocity: np.ndarray, force: float, ground: float) -> Motion:
        """Return the motion with the acceleration that balances it.

        Args:
            displacement: (n,) m.
            velocity: (n,) m/s.
            force: of the specimen, N.
            ground: acceleration a_g, m/s2.
        """
        p = self.unbalance(displacement, velocity, force, ground)
        return Motion(displacement, velocity, self.inverse_mass @ p)
