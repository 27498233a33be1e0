"""A linear frame reduced exactly to its masses, floors and damper places, for any stiffness of the dampers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from edesign.core.modes import UNSTABLE
from edesign.errors import AnalysisError
from edesign.study.analysis.structure import Structure


@dataclass(frozen=True)
class LinearModes:
    """Natural modes with dampers, in rising order of frequency.

    Attributes:
        omega: (n,) rad/s.
        masses: (n, m) displacements of the masses, generalised mass 1.
        floors: (n, floors) horizontal displacement of each floor.
        dampers: (n, devices) deformation of each damper with its brace.
        participation: (n,) for ground motion in the direction of the frame, sqrt(kg).
    """

    omega: np.ndarray
    masses: np.ndarray
    floors: np.ndarray
    dampers: np.ndarray
    participation: np.ndarray

    @property
    def first_frequency(self) -> float:
        """Frequency of the first mode, Hz."""
        return float(self.omega[0]) / (2.0 * np.pi)


@dataclass(frozen=True)
class CondensedFrame:
    """Flexibilities of the frame without dampers between masses (m), floors (f) and dampers (d).

    With dampers of (complex) stiffness k the flexibility between the masses is A - B' (1 + k C)^-1 k B, which is
    Woodbury's identity for (K + D' k D)^-1: nothing is approximated.

    Attributes:
        mass: (m,) kg.
        influence: (m,) 1 where a mass moves in the direction of the frame.
        floor_of: (m,) index of the floor of each mass, -1: none.
        A: (m, m), B: (d, m), C: (d, d), m/N.
        floor_A: (f, m), floor_B: (f, d), m/N.
    """

    mass: np.ndarray
    influence: np.ndarray
    floor_of: np.ndarray
    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    floor_A: np.ndarray
    floor_B: np.ndarray

    @property
    def n_devices(self) -> int:
        """The number of dampers."""
        return self.C.shape[0]

    def at_floors(self, forces: np.ndarray) -> np.ndarray:
        """Return the horizontal forces of the floors, (..., f) N, from those on the masses.

        Args:
            forces: forces on the masses in the direction of the frame, (..., m) N.
        """
        here = (self.influence > 0.0) & (self.floor_of >= 0)
        rows = [np.bincount(self.floor_of[here], row[here], self.floor_A.shape[0]) for row in np.atleast_2d(forces)]
        return np.reshape(rows, (*forces.shape[:-1], self.floor_A.shape[0]))

    def modes(self, stiffness: np.ndarray | None = None) -> LinearModes:
        """Return all natural modes of the frame with dampers of a storage stiffness.

        Args:
            stiffness: storage stiffness of the dampers, (d,) N/m; None: without dampers.

        Raises:
            AnalysisError: a squared frequency is not positive.
        """
        flexibility, floors, dampers = self._with(np.zeros(self.n_devices) if stiffness is None else stiffness)
        root = np.sqrt(self.mass)
        inverse, vectors = scipy.linalg.eigh(root[:, None] * flexibility * root)
        if inverse[0] <= 0.0:
            raise AnalysisError(f"modes: {UNSTABLE}")
        omega = 1.0 / np.sqrt(inverse[::-1])
        shapes = vectors[:, ::-1].T / root
        shapes *= np.where(shapes @ (self.mass * self.influence) < 0.0, -1.0, 1.0)[:, None]
        loads = omega[:, None] ** 2 * self.mass * shapes
        participation = shapes @ (self.mass * self.influence)
        return LinearModes(omega, shapes, loads @ floors.T, loads @ dampers.T, participation)

    def complex_modes(self, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return frequencies and damping ratios of free vibrations with dampers of a complex stiffness.

        Free vibrations exp(i omega t) of M u'' + (K + D' (k' + i k'') D) u = 0, with k' and k'' whatever the frequency;
        the ratio is Im(omega) / |omega|. In rising order of frequency.

        Args:
            stiffness: complex stiffness of the dampers, (d,) N/m.

        Returns:
            |omega| in rad/s, ascending, and the damping ratios, (m,) each.

        Raises:
            AnalysisError: an eigenvalue is not finite.

        Source: structural damping, e.g. Clough and Penzien (1993), Dynamics of Structures, 3-7 and 12-4.
        """
        flexibility, _, _ = self._with(np.asarray(stiffness, dtype=complex))
        root = np.sqrt(self.mass)
        inverse = scipy.linalg.eigvals(root[:, None] * flexibility * root)
        if not np.all(np.isfinite(inverse)) or np.any(np.abs(inverse) == 0.0):
            raise AnalysisError(f"complex modes: {UNSTABLE} [E-DESIGN-02]")
        omega = np.sqrt(1.0 / inverse)
        order = np.argsort(np.abs(omega))
        return np.abs(omega)[order], (omega.imag / np.abs(omega))[order]

    def static(self, loads: np.ndarray, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return displacements of the floors and deformations of the dampers under static loads.

        Args:
            loads: loads on the masses, (m,) N.
            stiffness: stiffness of the dampers, (d,) N/m.

        Returns:
            Displacements of the floors (f,) m, and deformations of the dampers with their braces (d,) m.
        """
        _, floors, dampers = self._with(stiffness)
        return floors @ loads, dampers @ loads

    def _with(self, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Flexibilities with dampers: masses by masses, floors by masses, dampers by masses."""
        k = np.asarray(stiffness)
        dampers = np.linalg.solve(np.eye(k.size) + self.C * k, self.B)  # deformation by loads on the masses
        forces = k[:, None] * dampers
        flexibility = self.A - self.B.T @ forces
        return 0.5 * (flexibility + flexibility.T), self.floor_A - self.floor_B @ forces, dampers


def condense(structure: Structure, direction: int = 0) -> CondensedFrame:
    """Reduce a structure in its present state, with its dampers' places but without their stiffness.

    Args:
        structure: the frame and its analysis, under gravity or not.
        direction: index of that of the ground motion and of the floors; masses of all directions are in the result.

    Returns:
        The flexibilities between masses, floors and dampers.

    Raises:
        AnalysisError: nothing has a mass, or the stiffness is singular.
    """
    analysis, frame = structure.analysis, structure.frame
    mass = analysis.masses()
    heavy = np.flatnonzero(mass > 0.0)
    if heavy.size == 0:
        raise AnalysisError("the frame has no masses [E-MODAL-02]")
    n = mass.size
    across = analysis.equations[:, frame.directions[direction].degree]
    floor_rows = np.zeros((len(frame.floors), n))
    floor_at = np.full(n, -1)
    for row, floor in enumerate(frame.floors):
        movers = analysis.along(floor.movers[direction]).toarray()
        moving = movers[movers.any(axis=1)]
        for mover in moving:
            floor_rows[row] += mover / len(moving)
            floor_at[mover != 0.0] = row
    influence = np.zeros(n)
    influence[across[across >= 0]] = 1.0
    directions = analysis.damper_directions().toarray()[[device.number for device in frame.devices]]
    unit = np.zeros((n, heavy.size))
    unit[heavy, np.arange(heavy.size)] = 1.0
    try:
        solver = scipy.sparse.linalg.splu(analysis.stiffness())
    except RuntimeError as error:
        raise AnalysisError(f"the stiffness of the frame is singular: {error} [E-GRAV-01]") from error
    by_masses, by_dampers = solver.solve(unit), solver.solve(np.ascontiguousarray(directions.T))
    return CondensedFrame(
        mass[heavy],
        influence[heavy],
        floor_at[heavy],
        by_masses[heavy],
        directions @ by_masses,
        directions @ by_dampers,
        floor_rows @ by_masses,
        floor_rows @ by_dampers,
    )
