"""The structure of a substructure test as a whole: numerical part and specimen, nothing between them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
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
CONDITION = 1e5
"""Of the modes with damping that couples them, by which rounding grows to some 1e-11; beyond it they are not used."""
UNDAMPED = 1e-9
"""Damping ratio of the structure that is none but for rounding."""
AT_POLE = 1e-150
"""Instead of a denominator of 0 at a pole: its inverse, and the square of that, are still finite."""


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

    @property
    def frequency(self) -> float:
        """Frequency, Hz."""
        return self.omega / (2.0 * math.pi)

    @property
    def damping(self) -> float:
        """Damping ratio -Re s / |s|; NaN: it does not oscillate."""
        return -self.root.real / abs(self.root)


@dataclass(frozen=True, eq=False)
class WholeStructure:
    """Structure as a whole: numerical part and specimen.

    M x'' + C x' + K x + interface F = -M influence a_g, with F = k_E (interface . x).

    Attributes:
        mass: (n, n), kg.
        damping: (n, n), N s/m, symmetric.
        stiffness: (n, n), N/m, symmetric, without the specimen.
        interface: (n,); the specimen's deformation is interface . x.
        specimen: complex stiffness of the specimen.
        swept: first frequencies (m,), rad/s, of sweeps by their last one, and the specimen's share there, (m,): all
            loops with the structure have them.

    Raises:
        InputError: shapes that do not fit, values that are not finite, or a degree without mass.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    interface: np.ndarray
    specimen: ComplexStiffness
    swept: dict[float, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        """Check the arrays."""
        n = self.interface.size
        if self.interface.shape != (n,):
            raise InputError(
                f"interface: an array of shape {self.interface.shape}; it has one value a degree [E-PART-02]"
            )
        for name in ("mass", "damping", "stiffness"):
            array = getattr(self, name)
            if array.shape != (n, n):
                raise InputError(f"{name}: a matrix of shape {array.shape} beside {n} degrees of freedom [E-PART-02]")
            if not np.all(np.isfinite(array)):
                raise InputError(f"{name}: not every value is finite [E-PART-02]")
        if np.linalg.eigvalsh(self.mass)[0] <= 0.0:
            raise InputError(
                "mass: a degree of freedom of the numerical part has no mass, so the loop has no inertia [E-PART-01]"
            )

    def specimen_at(self, s: np.ndarray) -> np.ndarray:
        """Return the stiffness k_E of the specimen at s, N/m.

        Args:
            s: (m,) complex frequencies, 1/s.

        Returns:
            (m,) N/m, complex.
        """
        return np.asarray(self.specimen(-1j * s))

    def receptances(self, load: np.ndarray, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the deformation of the specimen's place in the numerical part alone, under loads of size 1.

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
            found[i : i + BLOCK] = own.deformation(s[i : i + BLOCK], loads)
        return found[:, 0], found[:, 1]

    def specimen_share(self, s: np.ndarray) -> np.ndarray:
        """Return T = k_E times the receptance of the whole structure at the interface, (m,).

        Args:
            s: (m,) complex frequencies, 1/s.
        """
        force = self.specimen_at(s) * self.receptances(self.interface, s)[0]
        return np.asarray(force / (1.0 + force))

    @cached_property
    def numerical_roots(self) -> np.ndarray:
        """Roots of the numerical part alone in the upper half plane, 1/s."""
        roots = self._own.roots
        return np.asarray(roots[roots.imag > 0.0])

    @cached_property
    def modes(self) -> tuple[StructureMode, ...]:
        """Modes of the structure, from the lowest.

        Raises:
            InputError: one does not decay; then the structure, not the test, is unstable or undamped.
        """
        own = self._own
        at_rest = max(0.0, complex(self.specimen_at(np.zeros(1, dtype=complex))[0]).real)
        squares, shapes = np.linalg.eigh(np.diag(own.squares) + at_rest * np.outer(own.interface, own.interface))

        def damper(s: np.ndarray, share: np.ndarray) -> np.ndarray:
            return np.asarray(at_rest + share * (self.specimen_at(s) - at_rest))

        omega = np.sqrt(np.maximum(squares, 0.0))
        roots, forms, oscillates = np.full(omega.size, complex(np.nan, np.nan)), shapes.T.astype(complex), omega > 0.0
        pencil = self.pencil(damper, damps=False)
        roots[oscillates], followed = follow(pencil, 1j * omega[oscillates], forms[oscillates])
        forms[oscillates] = np.where(np.isnan(roots[oscillates])[:, None], forms[oscillates], followed)
        if (undamped := np.flatnonzero(roots.real > -UNDAMPED * omega)).size:
            i = int(undamped[0])
            raise InputError(
                f"mode {i + 1} of the structure ({omega[i] / (2.0 * np.pi):.4g} Hz) has no damping; without it every "
                "delay makes the test unstable [E-PART-04]"
            )
        found = np.where(np.isnan(roots), omega, np.abs(roots)).tolist()
        modes = (StructureMode(*one) for one in zip(found, roots.tolist(), forms, strict=True))
        return tuple(sorted(modes, key=lambda mode: mode.omega))

    def pencil(self, coupling: Callable[[np.ndarray, np.ndarray], np.ndarray], damps: bool = True) -> Pencil:
        """Return the numerical part with something in the specimen's place.

        Args:
            coupling: see `Pencil`.
            damps: see `Pencil`.
        """
        own = self._own
        return Pencil(own.damping, own.squares, own.interface, coupling, damps)

    def share_of(self, mode: StructureMode) -> float:
        """Return the share of a mode's stiffness that is the specimen's; NaN: it does not oscillate."""
        if not mode.omega > 0.0:
            return math.nan
        deformation = abs(complex(self._own.interface @ mode.shape)) ** 2
        inertia = float(np.linalg.norm(mode.shape)) ** 2 * mode.omega**2
        stiffness = float(self.specimen_at(np.array([1j * mode.omega]))[0].real)
        return stiffness * deformation / inertia

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
        """True if damping leaves the modes apart, as Rayleigh's and modal damping do."""
        own = np.diagonal(self.damping)
        return bool(np.all(np.abs(self.damping - np.diag(own)) <= ROUNDING * np.max(np.abs(own), initial=0.0)))

    @cached_property
    def _states(self) -> tuple[np.ndarray, np.ndarray]:
        """A of z' = A z, z = (W q, q'), (2n, 2n), and W (n,), which makes both of one size."""
        omega = np.sqrt(np.abs(self.squares))
        scale = np.where(omega > 0.0, omega, max(float(np.max(omega, initial=0.0)), 1.0))
        n = self.squares.size
        return np.block([[np.zeros((n, n)), np.diag(scale)], [np.diag(-self.squares / scale), -self.damping]]), scale

    @cached_property
    def _poles(self) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
        """Roots (2n,), and factors of their residues (2n,), (2n, n); None: the modes are no basis, as two are alike."""
        matrix, scale = self._states
        roots, forms = np.linalg.eig(matrix)
        if not np.linalg.cond(forms) < CONDITION:
            return None
        n = scale.size
        return roots, (self.interface / scale) @ forms[:n], np.linalg.inv(forms)[:, n:]

    @cached_property
    def _schur(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Triangle (2n, 2n), and what it takes of the interface (2n,) and of loads (2n, n).

        Source: Laub 1981, Efficient multivariable frequency response computations (with Hessenberg's form).
        """
        matrix, scale = self._states
        triangle, unitary = scipy.linalg.schur(matrix, output="complex")
        n = scale.size
        return triangle, (self.interface / scale) @ unitary[:n], unitary[n:].conj().T

    @property
    def roots(self) -> np.ndarray:
        """With damping, 1/s, (2n,)."""
        if not self._apart:
            return self._poles[0] if self._poles is not None else np.diagonal(self._schur[0])
        half = 0.5 * np.diagonal(self.damping)
        root = np.sqrt(half**2 - self.squares + 0j)
        return np.concatenate([root - half, -root - half])

    def deformation(self, s: np.ndarray, loads: np.ndarray) -> np.ndarray:
        """Of the specimen's place under loads on the modes, (m, k) at s of shape (m,) and loads of (n, k)."""
        if self._apart:
            below = s[:, None] * (s[:, None] + np.diagonal(self.damping)) + self.squares
            return np.asarray(self.interface / _apart_from_poles(below) @ loads)
        if self._poles is not None:
            roots, at_interface, of_load = self._poles
            return np.asarray(at_interface / _apart_from_poles(s[:, None] - roots) @ (of_load @ loads))
        triangle, wanted, of_load = self._schur
        solved = np.empty((wanted.size, s.size), dtype=complex)
        for j in range(wanted.size):
            solved[j] = (wanted[j] + triangle[:j, j] @ solved[:j]) / _apart_from_poles(s - triangle[j, j])
        return np.asarray(solved.T @ (of_load @ loads))


def _apart_from_poles(below: np.ndarray) -> np.ndarray:
    """Denominators, none of which is 0."""
    return np.where(below == 0.0, AT_POLE, below)
