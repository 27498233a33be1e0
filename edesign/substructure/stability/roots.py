"""Roots of the loop in the plane of s, followed from those of the structure itself."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.substructure.stability.loop import Loop
from edesign.substructure.stability.pencil import Pencil, follow

LEANS = (0.03, 0.1, 0.3, 1.0)
"""Growth over frequency of the starts in the right half plane."""
STARTS = 60
LOWEST_START = 1e-4
"""Over the highest frequency."""
DISTINCT = 1e-6
"""Distance over |s| below which two roots are one."""


def loop_roots(loop: Loop) -> tuple[complex, ...]:
    """Root of each mode in the loop as it is, 1/s, while G C goes from 1 to itself; nan: lost on the way."""
    whole = loop.whole

    def part_way(share: float) -> Pencil:
        return whole.pencil(lambda s: whole.specimen_at(s) * (1.0 + share * (loop.actuation(s) - 1.0)))

    lost = complex(np.nan, np.nan)
    found = (follow(part_way, mode.root, mode.shape) if np.isfinite(mode.root) else None for mode in whole.modes)
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
    pencil = loop.whole.pencil(lambda s: loop.whole.specimen_at(s) * loop.actuation(s))
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
