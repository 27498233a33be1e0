"""Roots of a structure that is coupled to something at one place, followed while the coupling changes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

ITERATIONS = 30
ROOT_TOLERANCE = 1e-10
"""Last correction over the root; the matrices of stiff frames lose some six of a double's sixteen digits."""
DIFFERENCE = 1e-5
"""Step over |s| of the central difference of the coupling: its error and rounding are some 1e-10."""
FIRST_STEP = 0.125
LEAST_STEP = 1e-4
"""Share of the way below which a root counts as lost: it meets another, or the real axis."""
FARTHEST_MOVE = 0.1
"""Share of |s| by which a root, and its prediction, may miss in one step."""
LEAST_LIKENESS = 0.5
"""Of the shapes before and after a step (modal assurance criterion); below it, it is another mode."""


@dataclass(frozen=True)
class Pencil:
    """s^2 + s C + K + coupling(s) b b^T, singular at its roots.

    Attributes:
        damping: C, (n, n), 1/s, symmetric.
        squares: K, its diagonal, (n,), 1/s2.
        interface: b, (n,).
        coupling: stiffness at the interface, complex of complex s, (m,) of (m,).
    """

    damping: np.ndarray
    squares: np.ndarray
    interface: np.ndarray
    coupling: Callable[[np.ndarray], np.ndarray]

    def linearised(self, s: complex) -> tuple[np.ndarray, np.ndarray]:
        """The matrix at s and its derivative to s, (n, n) each."""
        h = DIFFERENCE * abs(s)
        here, ahead, behind = np.asarray(self.coupling(np.array([s, s + h, s - h], dtype=complex))).tolist()
        coupled = np.outer(self.interface, self.interface)
        matrix, slope = s * self.damping + here * coupled, self.damping + (ahead - behind) / (2.0 * h) * coupled
        diagonal = np.arange(self.squares.size)
        matrix[diagonal, diagonal] += s**2 + self.squares
        slope[diagonal, diagonal] += 2.0 * s
        return matrix, slope

    def root_near(self, start: complex, shape: np.ndarray | None = None) -> tuple[complex, np.ndarray] | None:
        """Root and shape (n,) near a start in the upper half plane; None: none found.

        The matrix is linear in the next correction of s; an inverse iteration finds that correction, and the shape.

        Args:
            start: of s, 1/s.
            shape: of the mode, (n,); None: as the interface is pushed at the start.

        Source: Ruhe 1973, successive linear problems; Rayleigh quotient of symmetric matrices, Lancaster 1961.
        """
        s = start
        for _ in range(ITERATIONS):
            matrix, slope = self.linearised(s)
            if not (np.all(np.isfinite(matrix)) and np.all(np.isfinite(slope))):
                return None
            try:
                if shape is None:
                    shape = _normed(np.linalg.solve(matrix, self.interface))
                turned = slope @ shape
                pushed = np.linalg.solve(matrix, turned)
            except np.linalg.LinAlgError:  # it is singular to the last digit: beside its root it is not
                s *= 1.0 + ROOT_TOLERANCE
                continue
            with np.errstate(divide="ignore", invalid="ignore"):
                correction = complex(-(shape @ turned) / (pushed @ turned))
            s += correction
            if not (np.isfinite(s) and s.imag > 0.0):
                return None
            shape = _normed(pushed)
            if abs(correction) <= ROOT_TOLERANCE * abs(s):
                return s, shape
        return None


def _normed(shape: np.ndarray) -> np.ndarray:
    return np.asarray(shape / np.linalg.norm(shape))


def follow(part_way: Callable[[float], Pencil], start: complex, shape: np.ndarray) -> tuple[complex, np.ndarray] | None:
    """Root and shape at the end of a way from 0 to 1 along which the pencil changes.

    Args:
        part_way: the pencil at a share of the way.
        start: root at 0, 1/s.
        shape: of it, (n,).

    Returns:
        None: the root is lost, as it meets another or ceases to swing.
    """
    share, step = 0.0, FIRST_STEP
    root, drift = start, 0j
    while share < 1.0:
        step = min(step, 1.0 - share)
        predicted = root + drift * step
        found = part_way(share + step).root_near(predicted, shape)
        if found is None or not _continues(found, predicted, root, shape):
            step /= 2.0
            if step < LEAST_STEP:
                return None
            continue
        drift = (found[0] - root) / step
        share, step = share + step, 2.0 * step
        root, shape = found
    return root, shape


def _continues(found: tuple[complex, np.ndarray], predicted: complex, root: complex, shape: np.ndarray) -> bool:
    """Whether a root is the same mode a step on."""
    reach = FARTHEST_MOVE * abs(root)
    likeness = abs(np.vdot(found[1], shape)) ** 2 / (np.linalg.norm(found[1]) * np.linalg.norm(shape)) ** 2
    return abs(found[0] - predicted) < reach and abs(found[0] - root) < reach and float(likeness) > LEAST_LIKENESS
