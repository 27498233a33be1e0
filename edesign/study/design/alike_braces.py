"""Sections of braces as a fabricator likes them: one nominal depth in all storeys, or few different sections."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from edesign.space.selection.wishes import nominal_depth


def alike(names: Sequence[str], mass: np.ndarray, same_depth: bool, most_sections: int | None) -> list[str] | None:
    """Return the sections of the storeys with least mass that are alike as asked for; None: there are none.

    Storeys that share a section are neighbours in the order of the mass that each needs by itself.

    Args:
        mass: of the braces of each storey with each section, (s, n) kg; infinite where it must not be taken.
        same_depth: whether all storeys have one nominal depth.
        most_sections: largest number of different sections; None: any.
    """
    depths = np.array([nominal_depth(name) for name in names])
    of_depth = [depths == depth for depth in np.unique(depths)] if same_depth else [np.ones(depths.size, dtype=bool)]
    order = np.argsort(mass.min(axis=1), kind="stable")
    best, chosen = np.inf, None
    for allowed in of_depth:
        found = _shared(np.where(allowed, mass, np.inf)[order], most_sections or order.size)
        if found is not None and found[0] < best:
            best, chosen = found
    if chosen is None:
        return None
    return [names[chosen[place]] for place in np.argsort(order, kind="stable")]


def _shared(mass: np.ndarray, most: int) -> tuple[float, list[int]] | None:
    """The least mass of storeys in at most so many runs, each with one section, and the section of each storey."""
    storeys = len(mass)
    sums = {(a, b): mass[a:b].sum(axis=0) for b in range(1, storeys + 1) for a in range(b)}
    known: list[list[tuple[float, list[int]]]] = [[(0.0, [])] + [(np.inf, list[int]())] * storeys]
    for _ in range(min(most, storeys)):
        before, row = known[-1], [(0.0, list[int]())]
        for b in range(1, storeys + 1):
            ways = ((before[a][0] + float(sums[a, b].min()), a) for a in range(b))
            cost, a = min(ways)
            row.append((cost, [*before[a][1], *[int(sums[a, b].argmin())] * (b - a)]))
        known.append(row)
    cost, found = min((row[storeys] for row in known[1:]), key=lambda way: way[0])
    return (cost, found) if np.isfinite(cost) else None
