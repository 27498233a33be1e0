"""A shear building on a fixed, flexible or isolated base, and its equations of motion."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.linalg import eigh

DampingKind = Literal["rayleigh", "modal", "stiffness", "mass"]
KINDS: tuple[DampingKind, ...] = ("rayleigh", "modal", "stiffness", "mass")


@dataclass(frozen=True)
class Damping:
    """A damping ratio and its kind.

    Attributes:
        kind: rayleigh: the ratio in two modes; modal: in all modes; stiffness, mass: in the first mode, proportional.
        ratio: of critical damping.
        modes: the two modes of Rayleigh damping, from 1; those the building does not have become its last.
        other: a second kind, which has a share of the damping; None: there is none.
        share: of the second kind, 0 to 1.
    """

    kind: DampingKind = "modal"
    ratio: float = 0.02
    modes: tuple[int, int] = (1, 2)
    other: DampingKind | None = None
    share: float = 0.0

    def matrix(self, masses: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
        """Return the damping matrix (n, n), N s/m.

        Args:
            masses: (n,) kg.
            stiffness: (n, n) N/m.

        Source: Chopra, Dynamics of Structures, 11.4.
        """
        squares, shapes = eigh(stiffness, np.diag(masses))
        omega = np.sqrt(np.maximum(squares, 0.0))
        found = self.ratio * self._of_unit_ratio(self.kind, np.diag(masses), stiffness, omega, shapes)
        if self.other is None:
            return found
        other = self.ratio * self._of_unit_ratio(self.other, np.diag(masses), stiffness, omega, shapes)
        return (1.0 - self.share) * found + self.share * other

    def _of_unit_ratio(
        self, kind: DampingKind, mass: np.ndarray, stiffness: np.ndarray, omega: np.ndarray, shapes: np.ndarray
    ) -> np.ndarray:
        if kind == "modal":
            carried = mass @ shapes
            return np.asarray(carried @ np.diag(2.0 * omega) @ carried.T)
        first, second = (omega[min(mode, omega.size) - 1] for mode in self.modes)
        if kind == "stiffness" or (kind == "rayleigh" and first == second):
            return np.asarray(2.0 / omega[0] * stiffness)
        if kind == "mass":
            return np.asarray(2.0 * omega[0] * mass)
        return np.asarray(2.0 / (first + second) * (first * second * mass + stiffness))


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

    @property
    def first_frequency(self) -> float:
        """Frequency of the first mode without damping, Hz."""
        square = eigh(self.stiffness, np.diag(self.masses), eigvals_only=True)[0]
        return float(np.sqrt(max(square, 0.0)) / (2.0 * np.pi))


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

    @property
    def storeys(self) -> range:
        """Storeys above the isolation layer, or all of them."""
        return range(int(self.isolated), self.floors)

    def system(self) -> System:
        """Return the equations of motion.

        A massless flexible base is condensed exactly: its flexibility is added to that of the building, and storeys
        deform by their share of the static deflection under the same forces.
        """
        n = self.floors
        drifts: np.ndarray = np.eye(n) - np.eye(n, k=-1)
        stiffness: np.ndarray = drifts.T @ (self.stiffness[:, np.newaxis] * drifts)
        if self.sway or self.rocking:
            own = np.linalg.inv(stiffness)
            heights = self.heights if self.heights is not None else np.zeros(n)
            stiffness = np.linalg.inv(own + self.sway + self.rocking * np.outer(heights, heights))
            stiffness = 0.5 * (stiffness + stiffness.T)
            drifts = drifts @ own @ stiffness
        damping: np.ndarray = drifts.T @ (self.dashpots[:, np.newaxis] * drifts)
        if not self.isolated:
            damping = damping + self.damping.matrix(self.masses, stiffness)
        elif n > 1:
            upper = np.eye(n - 1) - np.eye(n - 1, k=-1)
            own = upper.T @ (self.stiffness[1:, np.newaxis] * upper)
            relative = np.hstack((-np.ones((n - 1, 1)), np.eye(n - 1)))
            damping = damping + relative.T @ self.damping.matrix(self.masses[1:], own) @ relative
        return System(self.masses, stiffness, damping, drifts)
