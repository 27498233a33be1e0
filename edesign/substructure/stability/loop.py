"""The loop of a substructure test as transfer functions: numerical part, specimen, rig and compensator."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError

Transfer = Callable[[np.ndarray], np.ndarray]
"""Of s, 1/s, complex of any shape; the value has the same shape."""
ComplexStiffness = Callable[[np.ndarray], np.ndarray]
"""k_E of omega, rad/s; N/m. Omega is complex off the imaginary axis: omega = s / i, with a real part of at least 0."""

BLOCK = 4096
"""Frequencies that are solved at once; bounds the memory, not the result."""


def ideal(s: np.ndarray) -> np.ndarray:
    """Rig without error, or no compensator: 1."""
    return np.ones_like(s, dtype=complex)


def nothing(s: np.ndarray) -> np.ndarray:
    """Rig that stands still: 0."""
    return np.zeros_like(s, dtype=complex)


def pure_delay(delay: float) -> Transfer:
    """exp(-s tau) of a delay tau in s."""

    def transfer(s: np.ndarray) -> np.ndarray:
        value: np.ndarray = np.exp(-np.asarray(s) * delay)
        return value

    return transfer


@dataclass(frozen=True)
class Loop:
    """Numerical part, specimen, rig and compensator of a substructure test.

    M x'' + C x' + K x + interface F = -M influence a_g, with F = k_E G C (interface . x).

    Attributes:
        mass: (n, n), kg.
        damping: (n, n), N s/m.
        stiffness: (n, n), N/m, without the specimen.
        interface: (n,); the specimen's target is interface . x.
        specimen: complex stiffness of the specimen.
        rig: G, measured displacement over command, delay included; stable by itself.
        compensator: C, command over target; stable by itself.

    Raises:
        InputError: shapes that do not fit, values that are not finite, or a degree without mass.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    interface: np.ndarray
    specimen: ComplexStiffness
    rig: Transfer = ideal
    compensator: Transfer = ideal

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

    def actuation(self, s: np.ndarray) -> np.ndarray:
        """G C at s: measured displacement over target."""
        value: np.ndarray = self.rig(s) * self.compensator(s)
        return value

    def specimen_at(self, s: np.ndarray) -> np.ndarray:
        """k_E at s, N/m."""
        return np.asarray(self.specimen(-1j * s))

    def dynamic_stiffness(self, s: np.ndarray) -> np.ndarray:
        """s^2 M + s C + K with the specimen in place, the loop ideal: (m, n, n) at s of shape (m,)."""
        return self._dynamic_stiffness(s, self.specimen_at(s))

    def specimen_share(self, s: np.ndarray) -> np.ndarray:
        """T = k_E times the receptance of the whole structure at the interface, (m,) at s of shape (m,)."""
        share, specimen = np.empty(s.shape, dtype=complex), self.specimen_at(s)
        for i in range(0, s.size, BLOCK):
            part, of_part = s[i : i + BLOCK], specimen[i : i + BLOCK]
            force = np.broadcast_to(self.interface[:, None], (part.size, self.interface.size, 1))
            matrix = self._dynamic_stiffness(part, of_part)
            share[i : i + BLOCK] = np.linalg.solve(matrix, force)[..., 0] @ self.interface
        return np.asarray(share * specimen)

    def _dynamic_stiffness(self, s: np.ndarray, specimen: np.ndarray) -> np.ndarray:
        coupled = np.outer(self.interface, self.interface)
        column = s[:, None, None]
        matrix: np.ndarray = (
            column**2 * self.mass + column * self.damping + self.stiffness + specimen[:, None, None] * coupled
        )
        return matrix

    def transfer(self, s: np.ndarray) -> np.ndarray:
        """L = k_E H G C, with H the receptance of the numerical part at the interface; (m,) at s of shape (m,)."""
        return self.open_loop(self.actuation(s), self.specimen_share(s), s)

    def open_loop(self, actuation: np.ndarray, share: np.ndarray, s: np.ndarray) -> np.ndarray:
        """L by its parts: `actuation` and `specimen_share` at s, (m,) each."""
        return np.asarray(actuation * share / (1.0 - share))

    def ratio(self, s: np.ndarray) -> np.ndarray:
        """R = (1 + L)/(1 + L of the ideal loop) = 1 + (G C - 1) T: its zeros are the roots of the loop; (m,)."""
        value: np.ndarray = 1.0 + (self.actuation(s) - 1.0) * self.specimen_share(s)
        return value


@dataclass(frozen=True)
class RigDelayLoop(Loop):
    """A loop that is opened at the rig: a further delay d of the rig multiplies its L by exp(-s d), and nothing else.

    Then R is 0 where L exp(-s d) is -1. That L is not k_E H G C if a compensator corrects the measured force, which
    comes in time however late the rig is; or if it feeds back what is measured, and so has the delay in its command.
    In both cases R, times what the command is without the rig over what it is with it, is A + B G with A and B that
    do not know the rig; L is B G / A.

    Attributes:
        still: what the numerical part gets of the force while the rig stands still, over the force of the target.
        opened: command while the rig stands still, over the command as it is.
    """

    still: Transfer = nothing
    opened: Transfer = ideal

    def open_loop(self, actuation: np.ndarray, share: np.ndarray, s: np.ndarray) -> np.ndarray:
        """L by its parts: `actuation` and `specimen_share` at s, (m,) each."""
        moving, standing = (1.0 + (one - 1.0) * share for one in (actuation, self.still(s)))
        return np.asarray(moving * self.opened(s) / standing - 1.0)
