"""Roots of a structure that is coupled to something at one place, followed while the coupling changes."""

from __future__ import annotations

from collections.abc import Callable, Iterator
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
ENTRIES = 2**18
"""Of the matrices that are solved at once; bounds the memory, not the result."""


@dataclass(frozen=True)
class Pencil:
    """Matrix pencil s^2 + s d C + K + coupling(s, share) b b^T, which changes with the share of a way.

    It is singular at its roots.

    Attributes:
        damping: C, (n, n), 1/s, symmetric.
        squares: K, its diagonal, (n,), 1/s2.
        interface: b, (n,).
        coupling: stiffness at the interface, complex of complex s (3, m) and of the share (m,).
        damps: whether d is 1 all the way; False: it is the share.
    """

    damping: np.ndarray
    squares: np.ndarray
    interface: np.ndarray
    coupling: Callable[[np.ndarray, np.ndarray], np.ndarray]
    damps: bool = True

    def roots_near(
        self, starts: np.ndarray, share: np.ndarray, shapes: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Find roots and shapes near starts in the upper half plane.

        The matrix is linear in the next correction of s; an inverse iteration finds that correction, and the shape.

        Args:
            starts: of s, (m,), 1/s.
            share: of the way, (m,).
            shapes: of the modes, (m, n); None: as the interface is pushed at the start.

        Returns:
            (m,) 1/s, nan: none found; and (m, n).

        Source: Ruhe 1973, successive linear problems; Rayleigh quotient of symmetric matrices, Lancaster 1961.
        """
        s, found = starts.astype(complex), np.full(starts.shape, complex(np.nan, np.nan))
        forms = np.zeros((s.size, self.squares.size), dtype=complex) if shapes is None else shapes.astype(complex)
        sought = np.arange(s.size)
        for i in range(ITERATIONS):
            sought, linearised = self._finite(sought, s, share)
            if not sought.size:
                break
            try:
                if shapes is None and i == 0:
                    pushes = np.broadcast_to(self.interface, (sought.size, self.interface.size))
                    forms[sought] = _normed(self._solved(s[sought], share[sought], linearised[0], pushes))
                turned = self._turned(s[sought], share[sought], linearised[1], forms[sought])
                pushed = self._solved(s[sought], share[sought], linearised[0], turned)
            except np.linalg.LinAlgError:  # one is singular to the last digit: beside its root it is not
                s[sought] *= 1.0 + ROOT_TOLERANCE
                continue
            with np.errstate(divide="ignore", invalid="ignore"):
                correction = -np.sum(forms[sought] * turned, axis=1) / np.sum(pushed * turned, axis=1)
            s[sought] += correction
            forms[sought] = _normed(pushed)
            there = np.abs(correction) <= ROOT_TOLERANCE * np.abs(s[sought])
            oscillates = s[sought].imag > 0.0  # of nan it is not
            found[sought[there & oscillates]] = s[sought[there & oscillates]]
            sought = sought[~there & oscillates]
        return found, forms

    def _finite(
        self, sought: np.ndarray, s: np.ndarray, share: np.ndarray
    ) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
        """Those of the roots sought where the coupling is finite; it, and its derivative to s, there."""
        h = DIFFERENCE * np.abs(s[sought])
        here, ahead, behind = self.coupling(s[sought] + np.array([[0.0], [1.0], [-1.0]]) * h, share[sought])
        with np.errstate(divide="ignore", invalid="ignore"):
            slope = (ahead - behind) / (2.0 * h)
        finite = np.isfinite(here) & np.isfinite(slope)
        return sought[finite], (here[finite], slope[finite])

    def _solved(self, s: np.ndarray, share: np.ndarray, coupling: np.ndarray, loads: np.ndarray) -> np.ndarray:
        """The matrices at s, inverted, times loads, (m, n) of (m, n)."""
        n = self.squares.size
        coupled, diagonal, solved = (
            np.outer(self.interface, self.interface),
            np.arange(n),
            np.empty(loads.shape, complex),
        )
        for some in _blocks(s.size, max(ENTRIES // n**2, 1)):
            at = s[some, None]
            damped = at if self.damps else at * share[some, None]
            matrices = damped[..., None] * self.damping + coupling[some, None, None] * coupled
            matrices[:, diagonal, diagonal] += at**2 + self.squares
            solved[some] = np.linalg.solve(matrices, loads[some, :, None])[..., 0]
        return solved

    def _turned(self, s: np.ndarray, share: np.ndarray, slope: np.ndarray, forms: np.ndarray) -> np.ndarray:
        """Derivatives of the matrices to s, times shapes, (m, n) of (m, n)."""
        damped = forms @ self.damping
        if not self.damps:
            damped = share[:, None] * damped
        return np.asarray(
            damped + 2.0 * s[:, None] * forms + np.outer(slope * (forms @ self.interface), self.interface)
        )


def _blocks(size: int, most: int) -> Iterator[slice]:
    return (slice(i, i + most) for i in range(0, size, most))


def _normed(forms: np.ndarray) -> np.ndarray:
    return np.asarray(forms / np.linalg.norm(forms, axis=1)[:, None])


def follow(pencil: Pencil, starts: np.ndarray, shapes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Find roots and shapes at the end of the way along which a pencil changes.

    Args:
        starts: roots at its beginning, (m,), 1/s.
        shapes: of them, (m, n).

    Returns:
        (m,) 1/s, nan: the root is lost, as it meets another or ceases to oscillate; and (m, n).
    """
    roots, shapes = starts.astype(complex), shapes.astype(complex)
    share, step, drift = np.zeros(roots.size), np.full(roots.size, FIRST_STEP), np.zeros(roots.size, dtype=complex)
    under_way = np.arange(roots.size)
    while under_way.size:
        step[under_way] = np.minimum(step[under_way], 1.0 - share[under_way])
        on, before, forms = step[under_way], roots[under_way], shapes[under_way]
        predicted = before + drift[under_way] * on
        found, found_forms = pencil.roots_near(predicted, share[under_way] + on, forms)
        same = _continue(found, predicted, before, found_forms, forms)
        reached = under_way[same]
        drift[reached] = (found[same] - before[same]) / on[same]
        roots[reached], shapes[reached] = found[same], found_forms[same]
        share[reached] += on[same]
        step[reached] *= 2.0
        step[under_way[~same]] /= 2.0
        lost = under_way[step[under_way] < LEAST_STEP]
        roots[lost] = complex(np.nan, np.nan)
        under_way = under_way[(share[under_way] < 1.0) & (step[under_way] >= LEAST_STEP)]
    return roots, shapes


def _continue(
    found: np.ndarray, predicted: np.ndarray, before: np.ndarray, found_forms: np.ndarray, forms: np.ndarray
) -> np.ndarray:
    """Say whether roots are the same modes a step on, (m,)."""
    reach = FARTHEST_MOVE * np.abs(before)
    sizes = np.linalg.norm(found_forms, axis=1) * np.linalg.norm(forms, axis=1)
    likeness = np.abs(np.sum(found_forms.conj() * forms, axis=1)) / sizes
    near = (np.abs(found - predicted) < reach) & (np.abs(found - before) < reach)
    return np.asarray(near & (likeness**2 > LEAST_LIKENESS))
