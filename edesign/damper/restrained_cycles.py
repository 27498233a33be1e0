"""Buckling-restrained braces in steady cycles: tension omega P_ysc, compression beta omega P_ysc at the amplitude."""

from __future__ import annotations

import numpy as np

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace


class RestrainedCycles:
    """Cycles of a brace that has hardened to the manufacturer's omega and beta at their amplitude.

    Between the strains given both forces are linear in the strain, and so in the deformation of the brace; beyond the
    last, kinematic hardening alone goes on. Isotropic hardening has come to rest: the loop is a parallelogram of the
    stiffnesses K and alpha K between both forces.

    Args:
        brace: of the law.

    Source: AISC 341-16, F4.2a and K3.4 (omega and beta are those of the second cycle at a strain).
    """

    hardening = np.nan  # omega keeps changing

    def __init__(self, brace: RestrainedBrace) -> None:
        self.brace = brace
        self.yield_force, self.stiffness = brace.yield_force, brace.stiffness
        first = (brace.yield_stress / brace.modulus, 1.0, 1.0)
        strain, omega, beta = np.array((first, *brace.points)).T
        self._sides = tuple(self._side(strain, brace.yield_force * of) for of in (omega, omega * beta))

    def _side(self, strain: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Deformations (n,) m and forces (n,) N of the corners of one side, from the origin."""
        by_force, by_deformation = self.brace.strain_of_core
        return np.append(0.0, (strain - by_force * force) / by_deformation), np.append(0.0, force)

    def _peak(self, amplitude: np.ndarray, side: int) -> np.ndarray:
        corners, forces = self._sides[side]
        beyond = np.maximum(amplitude - corners[-1], 0.0)
        return np.asarray(np.interp(amplitude, corners, forces) + self.brace.post_yield_ratio * self.stiffness * beyond)

    def _slope(self, amplitude: np.ndarray, side: int) -> np.ndarray:
        corners, forces = self._sides[side]
        slopes = np.append(np.diff(forces) / np.diff(corners), self.brace.post_yield_ratio * self.stiffness)
        return np.asarray(slopes[np.searchsorted(corners[1:], amplitude, side="right")])

    def tension(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the largest tension in cycles, N.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N, in the shape of `amplitude`.
        """
        return self._peak(np.asarray(amplitude), _TENSION)

    def compression(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the largest compression in cycles, N.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N, in the shape of `amplitude`.
        """
        return self._peak(np.asarray(amplitude), _COMPRESSION)

    def core_strain(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the largest strain of the core, dimensionless.

        It is that in tension, where the smaller force leaves more of the deformation to the core.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            In the shape of `amplitude`.
        """
        by_force, by_deformation = self.brace.strain_of_core
        return np.asarray(by_force * self.tension(amplitude) + by_deformation * np.asarray(amplitude))

    def force(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the mean of the largest tension and compression in cycles, N: that of the secant.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N, in the shape of `amplitude`.
        """
        return np.asarray(0.5 * (self.tension(amplitude) + self.compression(amplitude)))

    def tangent(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the derivative of the force by the amplitude, N/m.

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            N/m, in the shape of `amplitude`.
        """
        u = np.asarray(amplitude)
        return np.asarray(0.5 * (self._slope(u, _TENSION) + self._slope(u, _COMPRESSION)))

    def energy(self, amplitude: np.ndarray) -> np.ndarray:
        """Return the energy that a cycle dissipates, J: half the elastic range by the plastic path.

        With the elastic range 2 Y, T + C = 2 Y + 2 alpha K (u - Y / K), and the area is 4 (1 - alpha) Y (u - Y / K).

        Args:
            amplitude: largest deformation (...), m.

        Returns:
            J, in the shape of `amplitude`.
        """
        u, alpha = np.asarray(amplitude), self.brace.post_yield_ratio
        half_range = (self.force(u) - alpha * self.stiffness * u) / (1.0 - alpha)
        found = 4.0 * (1.0 - alpha) * half_range * np.maximum(u - half_range / self.stiffness, 0.0)
        return np.where(u > self.yield_force / self.stiffness, found, 0.0)  # before it is rounding


_TENSION, _COMPRESSION = 0, 1
