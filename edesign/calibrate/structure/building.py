"""A shear building on a fixed, flexible or isolated base, and its matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.calibrate.structure.damping import Damping


@dataclass(frozen=True)
class System:
    """Equations M q'' + C q' + K q = -M 1 a_g - L^T f of the floors' displacements q relative to the ground.

    Attributes:
        masses: (n,) kg.
        stiffness, damping: (n, n) N/m and N s/m.
        drifts: (n, n), row i gives the deformation of storey i (the isolation layer or the lowest storey is 0).
    """

    masses: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    drifts: np.ndarray


@dataclass(frozen=True)
class Building:
    """A shear building of n floors; storey 0 is the isolation layer if it is isolated.

    Attributes:
        masses: (n,) kg, from below.
        stiffness: (n,) N/m, from below; of an isolated building the first is the linear part of its isolation layer.
        damping: of the building on a fixed base; of an isolated one that of the superstructure.
        dashpots: (n,) N s/m beside the storeys, in addition; an isolation layer has its own here.
        isolated: whether storey 0 is an isolation layer.
        heights: (n,) m of the floors above the foundation; None: not known.
        sway: flexibility of the ground under a building without isolation, m/N.
        rocking: the same of rotation, rad/(N m); the foundation itself has neither mass nor inertia.
    """

    masses: np.ndarray
    stiffness: np.ndarray
    damping: Damping
    dashpots: np.ndarray
    isolated: bool = False
    heights: np.ndarray | None = None
    sway: float = 0.0
    rocking: float = 0.0

    @property
    def floors(self) -> int:
        """Number of floors, n."""
        return int(self.masses.size)

    def system(self) -> System:
        """The matrices.

        A massless flexible base is condensed exactly: its flexibility is added to that of the building, and storeys
        deform by their share of the static deflection under the same forces.
        """
        n = self.floors
        drifts: np.ndarray = np.eye(n) - np.eye(n, k=-1)
        stiffness: np.ndarray = drifts.T @ (self.stiffness[:, None] * drifts)
        if self.sway or self.rocking:
            own = np.linalg.inv(stiffness)
            heights = self.heights if self.heights is not None else np.zeros(n)
            total = own + self.sway * np.ones((n, n)) + self.rocking * np.outer(heights, heights)
            stiffness = np.linalg.inv(total)
            stiffness = 0.5 * (stiffness + stiffness.T)
            drifts = drifts @ own @ stiffness
        damping: np.ndarray = drifts.T @ (self.dashpots[:, None] * drifts)
        if not self.isolated:
            damping = damping + self.damping.matrix(self.masses, stiffness)
        elif n > 1:
            upper = np.eye(n - 1) - np.eye(n - 1, k=-1)
            above = self.damping.matrix(self.masses[1:], upper.T @ (self.stiffness[1:, None] * upper))
            relative = np.hstack((-np.ones((n - 1, 1)), np.eye(n - 1)))
            damping = damping + relative.T @ above @ relative
        return System(self.masses, stiffness, damping, drifts)
