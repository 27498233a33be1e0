"""The numerical part of a substructure test: a linear structure as matrices, and shear buildings given inline."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from edesign.errors import InputError
from edesign.frame.damping import modal_ratios, modes_needed, proportional_factors
from edesign.project.analysis.damping import ModalDamping, NoDamping, RayleighDamping

InherentDamping = NoDamping | RayleighDamping | ModalDamping

ROUNDING = 1e-9
"""Share of the largest squared frequency; one that lies no further below zero is zero with rounding errors."""


@dataclass(frozen=True, eq=False)
class LinearPart:
    """Linear numerical part: M x'' + C x' + K x + interface F = -M influence a_g over n degrees of freedom with mass.

    The deformation of the specimen is e = interface . x; its force F pulls back, F > 0 for e > 0.

    Attributes:
        mass: (n, n) kg, symmetric and positive definite.
        damping: (n, n) N s/m.
        stiffness: (n, n) N/m, without the specimen.
        influence: (n,) displacements when the ground moves by 1.
        interface: (n,) deformation of the specimen by a displacement of 1 of each degree.
        names: (n,) of the degrees.

    Raises:
        InputError: sizes differ, a number is not finite, or the mass or stiffness is impossible.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    influence: np.ndarray
    interface: np.ndarray
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        n = len(self.names)
        if n == 0:
            raise InputError("the numerical part has no degree of freedom [E-PART-02]")
        for what in ("mass", "damping", "stiffness", "influence", "interface"):
            values = getattr(self, what)
            wanted = (n,) if what in ("influence", "interface") else (n, n)
            if values.shape != wanted:
                raise InputError(
                    f"numerical part: {what} is {values.shape}, and its {n} degrees need {wanted} [E-PART-02]"
                )
            if not np.all(np.isfinite(values)):
                raise InputError(f"numerical part: {what} has a value that is not finite [E-PART-02]")
            if what in ("mass", "stiffness") and not np.allclose(values, values.T, rtol=0.0, atol=_rounding(values)):
                raise InputError(f"numerical part: {what} is not symmetric [E-PART-02]")
        if not np.any(self.interface):
            raise InputError("numerical part: no degree of freedom moves the specimen [E-PART-03]")
        for name, own in zip(self.names, np.diag(self.mass), strict=True):
            if not own > 0.0:
                raise InputError(f"numerical part: {name} has no mass; condense it or give it one [E-PART-01]")
        if np.linalg.eigvalsh(_unit_diagonal(self.mass))[0] <= ROUNDING:
            raise InputError(
                "numerical part: the mass matrix is not positive definite; a motion has no inertia [E-PART-01]"
            )

    def with_specimen(self, stiffness: float) -> np.ndarray:
        """Return the (n, n) stiffness with a spring in the place of the specimen, N/m.

        Args:
            stiffness: of the spring, N/m.
        """
        return np.asarray(self.stiffness + stiffness * np.outer(self.interface, self.interface))

    def modes(self, specimen_stiffness: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
        """Return the undamped natural modes, with a spring in the specimen's place.

        Args:
            specimen_stiffness: of the spring, N/m.

        Returns:
            Circular frequencies (n,) in rad/s, rising; shapes (n, n), a column each, of generalised mass 1.

        Raises:
            InputError: the structure is unstable.
        """
        return natural_modes(self.mass, self.with_specimen(specimen_stiffness))

    def frequencies(self, specimen_stiffness: float = 0.0) -> np.ndarray:
        """Return the natural frequencies (n,) in Hz, rising; otherwise as `modes`.

        Args:
            specimen_stiffness: of a spring in the specimen's place, N/m.
        """
        return np.asarray(self.modes(specimen_stiffness)[0] / (2.0 * math.pi))


def natural_modes(mass: np.ndarray, stiffness: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return circular frequencies (n,) in rad/s, rising, and shapes (n, n), a column each, of generalised mass 1.

    Args:
        mass: (n, n) kg, positive definite.
        stiffness: (n, n) N/m.

    Raises:
        InputError: a squared frequency is less than zero.
    """
    squared, shapes = scipy.linalg.eigh(stiffness, mass)
    if squared[0] < -ROUNDING * max(squared[-1], 0.0):
        raise InputError("the numerical part is unstable: a squared frequency is less than zero [E-PART-04]")
    return np.sqrt(np.maximum(squared, 0.0)), shapes


def damping_matrix(mass: np.ndarray, stiffness: np.ndarray, damping: InherentDamping) -> np.ndarray:
    """Return the (n, n) damping in N s/m of a structure that is given by its matrices alone.

    There is one stiffness, so the keys `stiffness` and `state` of a damping change nothing.

    Args:
        mass: (n, n) kg.
        stiffness: (n, n) N/m, without the specimen.
        damping: as a project gives it.

    Raises:
        InputError: a mode is named that the structure does not have, or frequencies are not above zero.

    Source: Chopra, Dynamics of Structures, Eqs. (11.4.10), Rayleigh, and (11.4.5), modal.
    """
    if isinstance(damping, NoDamping):
        return np.zeros_like(mass)
    omega, shapes = natural_modes(mass, stiffness)
    wanted = modes_needed(damping, omega.size)
    if wanted > omega.size:
        count = "1 mode" if omega.size == 1 else f"{omega.size} modes"
        hint = "; give it modal damping of 1 mode" if omega.size == 1 else ""
        raise InputError(f"damping: mode {wanted} is asked for, and the numerical part has {count}{hint} [E-PART-03]")
    if isinstance(damping, RayleighDamping):
        a0, a1 = proportional_factors(damping, omega)
        return a0 * mass + a1 * stiffness
    return modal_damping_matrix(mass, omega[:wanted], shapes[:, :wanted], modal_ratios(damping, omega[:wanted]))


def modal_damping_matrix(
    mass: np.ndarray, omega: np.ndarray, shapes: np.ndarray, ratio: float | np.ndarray
) -> np.ndarray:
    """Return C = M (sum 2 zeta omega phi phi') M in N s/m.

    Args:
        mass: (n, n) kg.
        omega: (m,) rad/s of the damped modes.
        shapes: (n, m), a column each, of generalised mass 1.
        ratio: of critical damping, dimensionless; one, or (m,).

    Returns:
        (n, n) N s/m.

    Source: Chopra, Dynamics of Structures, Eq. (11.4.5).
    """
    inertia = mass @ shapes
    return np.asarray((inertia * (2.0 * ratio * omega)) @ inertia.T)


def shear_building(
    masses: Sequence[float] | np.ndarray,
    stiffnesses: Sequence[float] | np.ndarray,
    damping: InherentDamping,
    storey: int,
) -> LinearPart:
    """Return a shear building whose specimen deforms with the drift of a storey.

    Args:
        masses: (n,) kg of the floors from the first.
        stiffnesses: (n,) N/m of the storeys from the first, without the specimen.
        damping: inherent damping, of the building without its specimen.
        storey: of the specimen, from 1.

    Raises:
        InputError: numbers of masses and stiffnesses differ, one is not positive, or the storey does not exist.
    """
    m, k = np.asarray(masses, dtype=float), np.asarray(stiffnesses, dtype=float)
    n = m.size
    if m.ndim != 1 or m.shape != k.shape or n == 0:
        raise InputError(
            f"structure: {m.size} masses and {k.size} stiffnesses; each storey needs one of both [E-PART-02]"
        )
    for what, values in (("masses", m), ("stiffnesses", k)):
        for i, value in enumerate(values):
            if not 0.0 < value < math.inf:
                raise InputError(f"structure: {what}[{i}] must be greater than zero, not {value:g} [E-VALUE-02]")
    if not 1 <= storey <= n:
        raise InputError(f"structure: there is no storey {storey}; the building has {n} [E-PART-03]")
    drifts = np.eye(n) - np.eye(n, k=-1)  # of the storeys, by displacements of the floors
    mass, stiffness = np.diag(m), drifts.T @ (k[:, None] * drifts)
    names = tuple(f"floor {i + 1}" for i in range(n))
    c = damping_matrix(mass, stiffness, damping)
    return LinearPart(mass, c, stiffness, np.ones(n), drifts[storey - 1], names)


def _rounding(matrix: np.ndarray) -> float:
    return ROUNDING * float(np.abs(matrix).max())


def _unit_diagonal(mass: np.ndarray) -> np.ndarray:
    scale = 1.0 / np.sqrt(np.diag(mass))
    return np.asarray(mass * np.outer(scale, scale))
