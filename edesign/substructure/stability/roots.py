"""Roots of the loop in the plane of s, followed from those of the structure itself."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from edesign.errors import InputError
from edesign.substructure.stability.loop import Loop

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
UNDAMPED = 1e-9
"""Damping ratio of the structure that is none but for rounding."""
LEANS = (0.03, 0.1, 0.3, 1.0)
"""Growth over frequency of the starts in the right half plane."""
STARTS = 60
LOWEST_START = 1e-4
"""Over the highest frequency."""
DISTINCT = 1e-6
"""Distance over |s| below which two roots are one."""


@dataclass(frozen=True)
class Pencil:
    """s^2 M + s C + K + coupling(s) b b^T, singular at its roots.

    Attributes:
        mass, damping, stiffness: (n, n).
        interface: b, (n,).
        coupling: stiffness at the interface, N/m, complex of complex s.
    """

    mass: np.ndarray
    damping: np.ndarray
    stiffness: np.ndarray
    interface: np.ndarray
    coupling: Callable[[complex], complex]

    def matrix(self, s: complex) -> np.ndarray:
        """The matrix at s, (n, n)."""
        coupled = np.outer(self.interface, self.interface)
        value: np.ndarray = s**2 * self.mass + s * self.damping + self.stiffness + self.coupling(s) * coupled
        return value

    def slope(self, s: complex) -> np.ndarray:
        """Its derivative to s, (n, n)."""
        h = DIFFERENCE * abs(s)
        change = (self.coupling(s + h) - self.coupling(s - h)) / (2.0 * h)
        value: np.ndarray = 2.0 * s * self.mass + self.damping + change * np.outer(self.interface, self.interface)
        return value

    def root_near(self, start: complex) -> tuple[complex, np.ndarray] | None:
        """Root and shape (n,) near a start in the upper half plane; None: none found.

        Source: Ruhe 1973, successive linear problems: the matrix is linear in the next correction of s.
        """
        s = start
        for _ in range(ITERATIONS):
            matrix, slope = self.matrix(s), self.slope(s)
            if not (np.all(np.isfinite(matrix)) and np.all(np.isfinite(slope))):
                return None
            corrections, shapes = scipy.linalg.eig(matrix, slope)
            nearest = int(np.argmin(np.abs(corrections)))
            s -= complex(corrections[nearest])
            if not (np.isfinite(s) and s.imag > 0.0):
                return None
            if abs(corrections[nearest]) <= ROOT_TOLERANCE * abs(s):
                return s, shapes[:, nearest]
        return None


@dataclass(frozen=True)
class StructureMode:
    """Mode of the structure with its specimen, the loop ideal.

    Attributes:
        omega: undamped, with the specimen's stiffness in phase, rad/s.
        root: s, 1/s, in the upper half plane; nan: overdamped or at rest.
        shape: (n,), complex; undamped where the root is nan.
    """

    omega: float
    root: complex
    shape: np.ndarray


def structure_modes(loop: Loop) -> tuple[StructureMode, ...]:
    """Every mode of the structure itself, from the lowest.

    Raises:
        InputError: one does not decay; then the structure, not the test, is unstable or undamped.
    """
    at_rest = max(0.0, _value(loop.specimen_at, 0j).real)
    coupled = np.outer(loop.interface, loop.interface)
    squares, shapes = scipy.linalg.eigh(loop.stiffness + at_rest * coupled, loop.mass)

    def part_way(share: float) -> Pencil:
        def coupling(s: complex) -> complex:
            return at_rest + share * (_value(loop.specimen_at, s) - at_rest)

        return Pencil(loop.mass, share * loop.damping, loop.stiffness, loop.interface, coupling)

    modes = []
    for i, square in enumerate(squares.tolist()):
        omega, shape = max(square, 0.0) ** 0.5, shapes[:, i].astype(complex)
        found = follow(part_way, 1j * omega, shape) if omega > 0.0 else None
        root, shape = found or (complex(np.nan, np.nan), shape)
        if root.real > -UNDAMPED * omega:
            raise InputError(
                f"mode {i + 1} of the structure ({omega / (2.0 * np.pi):.4g} Hz) has no damping; without it every "
                "delay makes the test unstable"
            )
        modes.append(StructureMode(abs(root) if np.isfinite(root) else omega, root, shape))
    return tuple(sorted(modes, key=lambda mode: mode.omega))


def loop_roots(loop: Loop, modes: Sequence[StructureMode]) -> tuple[complex, ...]:
    """Root of each mode in the loop as it is, 1/s, while G C goes from 1 to itself; nan: lost on the way."""

    def part_way(share: float) -> Pencil:
        def coupling(s: complex) -> complex:
            return _value(loop.specimen_at, s) * (1.0 + share * (_value(loop.actuation, s) - 1.0))

        return Pencil(loop.mass, loop.damping, loop.stiffness, loop.interface, coupling)

    lost = complex(np.nan, np.nan)
    found = (follow(part_way, mode.root, mode.shape) if np.isfinite(mode.root) else None for mode in modes)
    return tuple(one[0] if one else lost for one in found)


def further_roots(
    loop: Loop, dips: np.ndarray, highest: float, known: Sequence[complex], unstable: int
) -> tuple[complex, ...]:
    """Roots of the loop that are not the structure's modes: the rig's, the compensator's, the delay's.

    Those near the imaginary axis are sought from it; unstable ones that are still missing, from a net of starts.

    Args:
        loop: with rig and compensator.
        dips: frequencies at which |R| is least, (m,), rad/s.
        highest: frequency up to which unstable roots were counted, rad/s.
        known: roots of the modes, 1/s; nan: lost.
        unstable: number of roots in the right half plane, a pair counted twice.
    """

    def coupling(s: complex) -> complex:
        return _value(loop.specimen_at, s) * _value(loop.actuation, s)

    pencil = Pencil(loop.mass, loop.damping, loop.stiffness, loop.interface, coupling)
    roots = [one for one in known if np.isfinite(one)]
    others: list[complex] = []

    def look_at(start: complex) -> None:
        found = pencil.root_near(start)
        if found and all(abs(found[0] - one) > DISTINCT * abs(found[0]) for one in (*roots, *others)):
            others.append(found[0])

    for start in dips.tolist():
        look_at(1j * start)
    for start in _net(dips, highest):
        if 2 * sum(one.real > 0.0 for one in (*roots, *others)) >= unstable:
            break
        look_at(start)
    return tuple(others)


def _net(dips: np.ndarray, highest: float) -> list[complex]:
    """Starts in the right half plane: about the dips first, then at every frequency."""
    every = np.geomspace(highest * LOWEST_START, highest, STARTS)
    return [omega * (1j + lean) for omega in (*dips.tolist(), *every.tolist()) for lean in LEANS]


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
        found = part_way(share + step).root_near(predicted)
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


def _value(function: Callable[[np.ndarray], np.ndarray], s: complex) -> complex:
    """A function of arrays at one s."""
    return complex(np.asarray(function(np.array([s], dtype=complex)))[0])
