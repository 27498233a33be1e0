"""The structure of a substructure test as a whole: numerical part and specimen, nothing between them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg

from edesign.errors import InputError
from edesign.substructure.stability.pencil import Pencil, follow

ComplexStiffness = Callable[[np.ndarray], np.ndarray]
"""k_E of omega, rad/s; N/m. Omega is complex off the imaginary axis: omega = s / i, with a real part of at least 0."""

BLOCK = 4096
"""Frequencies that are solved at once; bounds the memory, not the result."""
ROUNDING = 1e-12
"""Damping between two modes over the largest damping of one: less is rounding of the modes, some 1e4 of a double's."""
UNDAMPED = 1e-9
"""Damping ratio of the structure that is none but for rounding."""
AT_POLE = 1e-150
"""Instead of s^2 + s c + w^2 = 0: its inverse, and the square of that, are still finite."""


@dataclass(frozen=True)
class StructureMode:
    """Mode of the structure with its specimen.

    Attributes:
        omega: undamped, with the specimen's stiffness in phase, rad/s.
        root: s, 1/s, in the upper half plane; nan: overdamped or at rest.
        shape: (n,) of the modes of the numerical part in it, complex; undamped where the root is nan.
    """

    omega: float
    root: complex
    shape: np.ndarray


@dataclass(frozen=True, eq=False)
class WholeStructure:
    """Numerical part and specimen.

    M x'' + C x' + K x + interface F = -M influence a_g, with F = k_E (interface . x).

    Attributes:
        mass: (n, n), kg.
        damping: (n, n), N s/m, symmetric.
        stiffness: (n, n), N/m, symmetric, without the specimen.
        interface: (n,); the specimen's deformation is interface . x.
        specimen: complex stiffness of the specimen.

    Raises:
        InputError: shapes that do not fit, values that are not finite, or a degree without mass.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    interface: np.ndarray
    specimen: ComplexStiffness

    def __post_init__(self) -> None:
        """Check the arrays."""
        n = self.interface.size
        if self.interface.shape != (n,):
            raise InputError(f"interface: an array of shape {self.interface.shape}; it has one value a degree")
        for name in ("mass", "damping", "stiffness"):
            array = getattr(self, name)
            if array.shape != (n, n):
                raise InputError(f"{name}: a matrix of shape {array.shape} beside {n} degrees of freedom")
            if not np.all(np.isfinite(array)):
                raise InputError(f"{name}: not every value is finite")
        if np.linalg.eigvalsh(self.mass)[0] <= 0.0:
            raise InputError("mass: a degree of freedom of the numerical part has no mass, so the loop has no inertia")

    def specimen_at(self, s: np.ndarray) -> np.ndarray:
        """k_E at s, N/m."""
        return np.asarray(self.specimen(-1j * s))

    def receptances(self, load: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Deformation of the specimen's place in the numerical part alone, under loads of size 1.

        Args:
            load: (n,), N.
            s: (m,), 1/s.

        Returns:
            Under a pair of forces at the interface, and under the load; (m,) each, m/N.
        """
        own = self._own
        loads = np.column_stack([own.interface, own.shapes.T @ load])
        found = np.empty((s.size, 2), dtype=complex)
        for i in range(0, s.size, BLOCK):
            found[i : i + BLOCK] = own.deformation(s[i : i + BLOCK]) @ loads
        return found[:, 0], found[:, 1]

    def specimen_share(self, s: np.ndarray) -> np.ndarray:
        """T = k_E times the receptance of the whole structure at the interface, (m,) at s of shape (m,)."""
        force = self.specimen_at(s) * self.receptances(self.interface, s)[0]
        return np.asarray(force / (1.0 + force))

    @cached_property
    def numerical_roots(self) -> np.ndarray:
        """Roots of the numerical part alone in the upper half plane, 1/s."""
        roots = self._own.roots
        return np.asarray(roots[roots.imag > 0.0])

    @cached_property
    def modes(self) -> tuple[StructureMode, ...]:
        """Every mode, from the lowest.

        Raises:
            InputError: one does not decay; then the structure, not the test, is unstable or undamped.
        """
        own = self._own
        at_rest = max(0.0, complex(self.specimen_at(np.zeros(1, dtype=complex))[0]).real)
        squares, shapes = np.linalg.eigh(np.diag(own.squares) + at_rest * np.outer(own.interface, own.interface))

        def damper(s: np.ndarray, share: np.ndarray) -> np.ndarray:
            return np.asarray(at_rest + share * (self.specimen_at(s) - at_rest))

        omega = np.sqrt(np.maximum(squares, 0.0))
        roots, forms, swing = np.full(omega.size, complex(np.nan, np.nan)), shapes.T.astype(complex), omega > 0.0
        roots[swing], followed = follow(self.pencil(damper, damps=False), 1j * omega[swing], forms[swing])
        forms[swing] = np.where(np.isnan(roots[swing])[:, None], forms[swing], followed)
        if (undamped := np.flatnonzero(roots.real > -UNDAMPED * omega)).size:
            i = int(undamped[0])
            raise InputError(
                f"mode {i + 1} of the structure ({omega[i] / (2.0 * np.pi):.4g} Hz) has no damping; without it every "
                "delay makes the test unstable"
            )
        found = np.where(np.isnan(roots), omega, np.abs(roots)).tolist()
        modes = (StructureMode(*one) for one in zip(found, roots.tolist(), forms, strict=True))
        return tuple(sorted(modes, key=lambda mode: mode.omega))

    def pencil(self, coupling: Callable[[np.ndarray, np.ndarray], np.ndarray], damps: bool = True) -> Pencil:
        """Numerical part with something in the specimen's place; arguments as of `Pencil`."""
        own = self._own
        return Pencil(own.damping, own.squares, own.interface, coupling, damps)

    def deformation_of(self, shape: np.ndarray) -> complex:
        """Of the specimen in a shape of generalised mass |shape|^2, m."""
        return complex(self._own.interface @ shape)

    @cached_property
    def _own(self) -> _NumericalModes:
        squares, shapes = scipy.linalg.eigh(self.stiffness, self.mass)
        return _NumericalModes(squares, shapes, shapes.T @ self.damping @ shapes, shapes.T @ self.interface)


@dataclass(frozen=True)
class _NumericalModes:
    """The numerical part alone in its undamped modes.

    Attributes:
        squares: (n,) of their frequencies, rad2/s2; less than zero where only the specimen holds it.
        shapes: (n, n), a column each, of generalised mass 1.
        damping: (n, n), 1/s.
        interface: (n,).
    """

    squares: np.ndarray
    shapes: np.ndarray
    damping: np.ndarray
    interface: np.ndarray

    @cached_property
    def _apart(self) -> bool:
        """Whether damping leaves the modes apart, as Rayleigh's and modal damping do."""
        own = np.diagonal(self.damping)
        return bool(np.all(np.abs(self.damping - np.diag(own)) <= ROUNDING * np.max(np.abs(own), initial=0.0)))

    @cached_property
    def _states(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Schur form of z' = A z, z = (W q, q'): triangle, unitary matrix, and W (n,) that makes both of one size.

        Source: Laub 1981, Efficient multivariable frequency response computations (with Hessenberg's form).
        """
        omega = np.sqrt(np.abs(self.squares))
        scale = np.where(omega > 0.0, omega, max(float(np.max(omega, initial=0.0)), 1.0))
        n = self.squares.size
        matrix = np.block([[np.zeros((n, n)), np.diag(scale)], [np.diag(-self.squares / scale), -self.damping]])
        triangle, unitary = scipy.linalg.schur(matrix, output="complex")
        return triangle, unitary, scale

    @property
    def roots(self) -> np.ndarray:
        """With damping, 1/s, (2n,)."""
        if not self._apart:
            return np.diagonal(self._states[0])
        half = 0.5 * np.diagonal(self.damping)
        swing = np.sqrt(half**2 - self.squares + 0j)
        return np.concatenate([swing - half, -swing - half])

    def deformation(self, s: np.ndarray) -> np.ndarray:
        """Of the specimen's place under a unit force on each mode, (m, n) at s of shape (m,)."""
        if self._apart:
            below = s[:, None] * (s[:, None] + np.diagonal(self.damping)) + self.squares
            return np.asarray(self.interface / np.where(below == 0.0, AT_POLE, below))
        triangle, unitary, scale = self._states
        n = self.squares.size
        wanted = (self.interface / scale) @ unitary[:n]
        solved = np.empty((2 * n, s.size), dtype=complex)
        for j in range(2 * n):
            below = s - triangle[j, j]
            solved[j] = (wanted[j] + triangle[:j, j] @ solved[:j]) / np.where(below == 0.0, AT_POLE, below)
        return np.asarray(solved.T @ unitary[n:].conj().T)
