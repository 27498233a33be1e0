"""Roots of the loop in the plane of s, followed from those of the structure itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from edesign.substructure.stability.loop import Loop
from edesign.substructure.stability.pencil import follow

LEANS = (0.03, 0.1, 0.3, 1.0)
"""Growth over frequency of the starts in the right half plane."""
STARTS = 60
LOWEST_START = 1e-4
"""Over the highest frequency."""
DISTINCT = 1e-6
"""Distance over |s| below which two roots are one."""


def loop_roots(loop: Loop) -> np.ndarray:
    """Return the root of each mode in the loop as it is, (n,), 1/s; nan: lost on the way.

    The root is followed while G C goes from 1 to itself.

    Args:
        loop: with rig and compensator.
    """
    whole, found = loop.whole, np.full(len(loop.whole.modes), complex(np.nan, np.nan))

    def late(s: np.ndarray, share: np.ndarray) -> np.ndarray:
        return np.asarray(whole.specimen_at(s) * (1.0 + share * (loop.actuation(s) - 1.0)))

    roots = np.array([mode.root for mode in whole.modes])
    oscillates = np.isfinite(roots)
    shapes = np.array([mode.shape for mode in whole.modes])
    found[oscillates] = follow(whole.pencil(late), roots[oscillates], shapes[oscillates])[0]
    return found


def further_roots(
    loop: Loop, dips: np.ndarray, highest: float, known: np.ndarray, unstable: int
) -> tuple[complex, ...]:
    """Return the roots of the loop that are not the structure's modes: the rig's, the compensator's, the delay's.

    Those near the imaginary axis are sought from it; unstable ones that are still missing, from a net of starts.

    Args:
        dips: frequencies at which |R| is least, (m,), rad/s.
        highest: frequency up to which unstable roots were counted, rad/s.
        known: roots of the modes, (n,), 1/s; nan: lost.
        unstable: number of roots in the right half plane, a pair counted twice.
    """
    pencil = loop.whole.pencil(lambda s, _: np.asarray(loop.whole.specimen_at(s) * loop.actuation(s)))
    roots = known[np.isfinite(known)].tolist()
    others: list[complex] = []

    def look_at(starts: np.ndarray) -> Iterator[complex]:
        found = pencil.roots_near(starts, np.ones(starts.size))[0]
        return (one for one in found[np.isfinite(found)].tolist() if _is_new(one, (*roots, *others)))

    for one in look_at(1j * dips):
        others.append(one)
    missing = unstable - 2 * sum(one.real > 0.0 for one in (*roots, *others))
    for one in look_at(_net(dips, highest)) if missing > 0 else ():
        others.append(one)
        missing -= 2 if one.real > 0.0 else 0
        if missing <= 0:
            break
    return tuple(others)


def _is_new(root: complex, known: Sequence[complex]) -> bool:
    return all(abs(root - one) > DISTINCT * abs(root) for one in known)


def _net(dips: np.ndarray, highest: float) -> np.ndarray:
    """Starts in the right half plane: about the dips first, then at every frequency."""
    omega = np.concatenate([dips, np.geomspace(highest * LOWEST_START, highest, STARTS)])
    return np.multiply.outer(omega, 1j + np.array(LEANS)).ravel()
