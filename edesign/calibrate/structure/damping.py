"""Damping of a shear building: a level, and how it is spread over modes."""

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
    """

    kind: DampingKind = "modal"
    ratio: float = 0.02
    modes: tuple[int, int] = (1, 2)

    def matrix(self, masses: np.ndarray, stiffness: np.ndarray) -> np.ndarray:
        """Damping matrix (n, n) N s/m of masses (n,) kg and a stiffness matrix (n, n) N/m.

        Source: Chopra, Dynamics of Structures, 11.4.
        """
        mass = np.diag(masses)
        squares, shapes = eigh(stiffness, mass)
        omega = np.sqrt(np.maximum(squares, 0.0))
        if self.kind == "modal":
            carried = mass @ shapes
            return np.asarray(carried @ np.diag(2.0 * self.ratio * omega) @ carried.T)
        first = omega[min(self.modes[0], omega.size) - 1]
        second = omega[min(self.modes[1], omega.size) - 1]
        if self.kind == "stiffness" or (self.kind == "rayleigh" and first == second):
            return np.asarray(2.0 * self.ratio / omega[0] * stiffness)
        if self.kind == "mass":
            return np.asarray(2.0 * self.ratio * omega[0] * mass)
        return np.asarray(2.0 * self.ratio / (first + second) * (first * second * mass + stiffness))
