"""What moves in a drawing of a frame or building: nodes, members between them, and dampers that hang on nodes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

SAME = 1e-6  # m, within which a point is a node
SIGN = 0.03  # of a support or a tuned mass, of the larger side of the frame
BELOW = 0.05  # from an isolated base to the ground, likewise

Place = tuple[float, ...]
"""Coordinates, m: two of a plane frame, three of a building; the last one is the level."""


@dataclass(frozen=True)
class Hung:
    """A point that moves with two nodes, or one of the ground.

    Attributes:
        at: where it is, m.
        nodes: their positions among `Geometry.nodes`; `GROUND`: it stays.
        share: 0: it moves with the first, 1: with the second, between: with both.
    """

    at: Place
    nodes: tuple[int, int]
    share: float


GROUND = (-1, -1)


@dataclass(frozen=True)
class MovingDamper:
    """A damper or an isolator.

    Attributes:
        name: of it.
        braces: lines that hold it.
        body: the line that it stands on; its color shows the force.
        span: the shares of this line between which the damper itself is.
        wide: width of an isolator, whose top moves over its bottom, m; 0: it is a damper.
    """

    name: str
    braces: tuple[tuple[Hung, Hung], ...]
    body: tuple[Hung, Hung]
    span: tuple[float, float]
    wide: float = 0.0


@dataclass(frozen=True)
class Support:
    """The support of a column base: `fixed`, `pinned`, `roller`, `springs`, `footing`, and the position of its node."""

    kind: str
    node: int


@dataclass(frozen=True)
class MovingMass:
    """A tuned mass by its name, the point of its floor that it stands over at rest, and its direction: 0 x, 1 y."""

    name: str
    at: Hung
    direction: int = 0


@dataclass(frozen=True)
class Geometry:
    """A frame or building whose nodes move.

    Attributes:
        nodes: places by name, m.
        members: first and second node of each column, beam and brace by its name.
        dampers: those whose place the frame has.
        levels: of the floors from the base, m.
        supports: of a frame that is not isolated.
        base: column bases along an isolated base; () of a frame on supports.
        masses: tuned masses and tanks.
        hinged: ends of members, 0 start and 1 end, that do not turn with their nodes; of buildings alone.
        slabs: of a building, floor by floor from the lowest, the four nodes around each bay that it covers.
        grid: of a building the labels of the grid lines, and two places on each of them, m.
    """

    nodes: dict[str, Place]
    members: dict[str, tuple[int, int]]
    dampers: tuple[MovingDamper, ...]
    levels: tuple[float, ...]
    supports: tuple[Support, ...] = ()
    base: tuple[int, ...] = ()
    masses: tuple[MovingMass, ...] = ()
    hinged: frozenset[tuple[str, int]] = frozenset()
    slabs: tuple[tuple[tuple[int, int, int, int], ...], ...] = ()
    grid: tuple[tuple[str, Place, Place], ...] = ()

    @property
    def in_space(self) -> bool:
        """Whether it is a building."""
        return len(next(iter(self.nodes.values()))) == 3

    @property
    def size(self) -> float:
        """The larger side, m."""
        return float(np.ptp(np.array(list(self.nodes.values())), axis=0).max())

    @property
    def ground(self) -> float:
        """Level of the ground, m."""
        return min(y for *_, y in self.nodes.values()) - (BELOW * self.size if self.base else 0.0)


def floor_shares(levels: tuple[float, ...], places: Sequence[Place]) -> list[tuple[int, float]]:
    """Return for each node the floor below, from 0 for the base, and its share of the way to the next.

    Args:
        levels: of the floors from the base, m.
        places: of the nodes, m.
    """
    found = []
    for *_, y in places:
        below = min(max(int(np.searchsorted(levels, y + SAME, side="right")) - 1, 0), len(levels) - 2)
        share = (y - levels[below]) / (levels[below + 1] - levels[below])
        found.append((below, min(max(share, 0.0), 1.0)))
    return found
