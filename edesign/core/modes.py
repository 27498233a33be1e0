"""Natural modes of a structure from its stiffness and lumped masses."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy  # its sparse solvers are loaded for large structures only: they take 10 MB and a third of a second

DENSE = 600
"""Unknowns up to which dense matrices are used: they then take 3 MB, and LAPACK a fraction of a second."""

_MOST_ROUNDS = 50
_AGREEMENT = 1e-9  # of two eigenvalues that follow each other; the next would agree to rounding

UNSTABLE = "the structure is unstable in its present state: a squared frequency is not positive"


@dataclass(frozen=True)
class Modes:
    """Natural modes in rising order of frequency.

    Attributes:
        omega: (n,) rad/s.
        period: (n,) s.
        equations: (n, n_equations) shapes over the equations, generalised mass 1.
        shapes: (n, n_nodes, 3 or 6) shapes over the nodes, zero where fixed.
        participation: (n, 2 or 3) participation factor for ground motion along x, y, z, sqrt(kg).
        effective_mass_ratio: (n, 2 or 3) effective modal mass over the total mass that moves along x, y, z.
    """

    omega: np.ndarray
    period: np.ndarray
    equations: np.ndarray
    shapes: np.ndarray
    participation: np.ndarray
    effective_mass_ratio: np.ndarray

    @property
    def effective_mass_ratio_x(self) -> np.ndarray:
        """Effective modal masses over the total mass that moves along x, (n,)."""
        return self.effective_mass_ratio[:, 0]

    def moved(self, displacement: Sequence[tuple[float, int, int]]) -> np.ndarray:
        """Return a sum of degrees in each mode, (n,).

        Args:
            displacement: (coefficient, node, degree) of what is added up.
        """
        terms = [coefficient * self.shapes[:, node, degree] for coefficient, node, degree in displacement]
        return np.asarray(np.add.reduce(terms, axis=0))


def natural_modes(
    stiffness: np.ndarray | scipy.sparse.csc_matrix,
    mass: np.ndarray,
    equations: np.ndarray,
    influence: np.ndarray,
    count: int,
) -> Modes:
    """Return the lowest modes of K phi = omega^2 M phi with lumped, partly zero masses.

    Degrees without mass are condensed statically (exact for a lumped mass matrix; Chopra 2012, 9.3); few remain, so the
    condensed problem is solved densely. Larger problems go to ARPACK. Small structures are condensed densely as well.

    Args:
        stiffness: (n, n) N/m.
        mass: (n,) kg.
        equations: (n_nodes, 3 or 6) equation of each degree, -1 where fixed.
        influence: (2 or 3, n) 1 where the equation moves along x, y, z.
        count: how many modes; at most as many as degrees with mass.

    Raises:
        ValueError: there are fewer degrees with mass than modes asked for, or a squared frequency is not positive.
    """
    heavy = np.flatnonzero(mass > 0.0)
    if not 0 < count <= heavy.size:
        raise ValueError(f"{count} modes asked for, but the structure has {heavy.size} degrees with mass")
    n = mass.size
    solve = _solution(stiffness)
    root = np.sqrt(mass[heavy])
    if heavy.size <= DENSE or count == heavy.size:
        unit = np.zeros((n, heavy.size))
        unit[heavy, np.arange(heavy.size)] = root
        flexibility = solve(unit)[heavy] * root[:, None]
        inverse, vectors = np.linalg.eigh(0.5 * (flexibility + flexibility.T))
        if inverse[0] < -1e-9 * inverse[-1]:
            raise ValueError(UNSTABLE)
        inverse, vectors = inverse[::-1][:count], vectors[:, ::-1][:, :count]
    else:

        def apply(x: np.ndarray) -> np.ndarray:
            full = np.zeros(n)
            full[heavy] = root * x.ravel()
            return np.asarray(root * solve(full)[heavy])

        operator = scipy.sparse.linalg.LinearOperator((heavy.size, heavy.size), matvec=apply, dtype=float)
        start = np.ones(heavy.size)  # a fixed start: the same answer every time
        inverse, vectors = scipy.sparse.linalg.eigsh(operator, k=count, which="LA", v0=start, tol=1e-12)
        inverse, vectors = inverse[::-1], vectors[:, ::-1]
    if np.any(inverse <= 0.0):
        raise ValueError(UNSTABLE)
    omega = 1.0 / np.sqrt(inverse)
    load = np.zeros((n, count))
    load[heavy] = root[:, None] * vectors
    shapes = (solve(load) * omega**2).T
    shapes /= np.sqrt(np.einsum("ki,i,ki->k", shapes, mass, shapes))[:, None]
    largest = np.take_along_axis(shapes, np.argmax(np.abs(shapes), axis=1)[:, None], axis=1)
    shapes = shapes * np.sign(largest)
    participation = [shapes @ (mass * along) for along in influence]
    padded = np.concatenate([shapes, np.zeros((count, 1))], axis=1)
    total = [float(np.sum(mass * along)) for along in influence]
    ratios = [p**2 / m if m > 0.0 else np.zeros(count) for p, m in zip(participation, total, strict=True)]
    return Modes(
        omega=omega,
        period=2.0 * np.pi / omega,
        equations=shapes,
        shapes=padded[:, equations],
        participation=np.transpose(participation),
        effective_mass_ratio=np.transpose(ratios),
    )


def damped_eigenvalue(
    stiffness: scipy.sparse.csc_matrix,
    mass: np.ndarray,
    damping: scipy.sparse.csc_matrix,
    omega: float,
    shape: np.ndarray,
) -> complex:
    """Return the eigenvalue of (lambda^2 M + lambda C + K) phi = 0 that a natural mode becomes with damping, rad/s.

    Newton's method on the pair of value and vector from the natural mode on converges quadratically.

    Args:
        stiffness: K, (n, n) N/m.
        mass: (n,) kg.
        damping: C, (n, n) N s/m.
        omega: circular frequency of the mode, rad/s.
        shape: (n,) of the mode.

    Returns:
        lambda, rad/s, complex.

    Raises:
        ValueError: it does not converge: damping is near critical or above.

    Source: Ruhe 1973, SIAM Journal on Numerical Analysis 10, 674-689.
    """
    value, vector = 1j * omega, shape.astype(complex)
    masses = scipy.sparse.diags(mass)
    normal = np.conj(vector) / np.vdot(vector, vector)
    for _ in range(_MOST_ROUNDS):
        pencil = (value**2 * masses + value * damping + stiffness).tocsc()
        slope = 2.0 * value * (mass * vector) + damping @ vector
        change = scipy.sparse.linalg.splu(pencil).solve(slope)
        step = (normal @ vector) / (normal @ change)
        value -= step
        vector = change / (normal @ change)
        if abs(step) <= _AGREEMENT * abs(value):
            return complex(value)
    raise ValueError("no damped eigenvalue was found beside the natural mode")


def _solution(stiffness: np.ndarray | scipy.sparse.csc_matrix) -> Callable[[np.ndarray], np.ndarray]:
    """Displacements by forces, each (n,) or (n, any).

    Raises:
        ValueError, RuntimeError: the stiffness is singular.
    """
    if stiffness.shape[0] > DENSE:
        return scipy.sparse.linalg.splu(stiffness).solve
    dense = stiffness if isinstance(stiffness, np.ndarray) else stiffness.toarray()
    return lambda forces: np.linalg.solve(dense, forces)
