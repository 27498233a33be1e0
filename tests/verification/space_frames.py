"""Space frames of the tests: nodes and members one by one, then the arrays of a SpaceModel."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf
from typing import Any

import numpy as np

from edesign.core.space import SpaceMembers, SpaceModel

E, G = 210e9, 81e9
SECTION = {"A": 1.2e-2, "A_y": 0.0, "A_z": 0.0, "I_t": 8e-7, "I_y": 2.3e-4, "I_z": 1.1e-4}
RIGID = (inf, inf, inf, inf)
HINGES = (0.0, 0.0, 0.0, 0.0)


@dataclass
class Frame:
    """A frame that is put together step by step; values of SECTION unless a member has its own."""

    nodes: list[tuple[float, float, float]] = field(default_factory=list)
    floors: list[int] = field(default_factory=list)
    masters: list[tuple[float, float]] = field(default_factory=list)
    fixed: list[tuple[int, ...]] = field(default_factory=list)
    springs: list[tuple[float, ...]] = field(default_factory=list)
    rows: list[dict[str, Any]] = field(default_factory=list)

    def node(
        self,
        x: float,
        y: float,
        z: float,
        fixed: str = "",
        floor: int = -1,
        springs: tuple[float, ...] = (0.0,) * 6,
    ) -> int:
        """Add a node, fixed in the directions of a text such as "ux uy rz" or "all"."""
        names = ("ux", "uy", "uz", "rx", "ry", "rz")
        self.nodes.append((x, y, z))
        self.floors.append(floor)
        self.fixed.append(tuple(int(fixed == "all" or name in fixed.split()) for name in names))
        self.springs.append(springs)
        return len(self.nodes) - 1

    def member(
        self,
        start: int,
        end: int,
        web: tuple[float, float, float] | None = None,
        ends: tuple[float, ...] = RIGID,
        axial_only: bool = False,
        **section: float,
    ) -> int:
        """Add a member; its web is in the vertical plane, of a column along x, unless it is given."""
        if web is None:
            x = np.subtract(self.nodes[end], self.nodes[start])
            up = np.array([1.0, 0.0, 0.0] if not x[:2].any() else [0.0, 0.0, 1.0])
            z = up - x * (up @ x) / (x @ x)
            web = tuple(z / np.linalg.norm(z))
        values = {"E": E, "G": G} | SECTION | section
        self.rows.append({"start": start, "end": end, "web": web, "ends": ends, "axial_only": axial_only} | values)
        return len(self.rows) - 1

    def post(self) -> None:
        """Add a column apart from all else, so that a frame with nothing but fixed nodes has something free."""
        self.member(self.node(-50.0, 0, 0, fixed="all"), self.node(-50.0, 0, 1.0))

    def line(self, start: int, end: int, parts: int, fixed: str = "", **options: Any) -> list[int]:
        """Add members one after the other between two nodes, with `fixed` nodes in between."""
        a, b = np.array(self.nodes[start]), np.array(self.nodes[end])
        inner = [self.node(*(a + (b - a) * k / parts), fixed=fixed) for k in range(1, parts)]
        chain = [start, *inner, end]
        return [self.member(i, j, **options) for i, j in zip(chain, chain[1:], strict=False)]  # type: ignore[arg-type]

    def members(self) -> SpaceMembers:
        """The members as arrays."""
        return SpaceMembers(**{name: np.array([row[name] for row in self.rows]) for name in self.rows[0]})

    def model(self) -> SpaceModel:
        """The model of what is there so far."""
        return SpaceModel(
            np.array(self.nodes),
            np.array(self.floors),
            np.array(self.masters, dtype=float).reshape(-1, 2),
            np.array(self.fixed, dtype=bool),
            np.array(self.springs, dtype=float),
            self.members(),
            [f"N{i}" for i in range(len(self.nodes))],
            [f"M{i}" for i in range(len(self.rows))],
        )

    def force(self, node: int, **components: float) -> np.ndarray:
        """One case (1, n, 6) of a force on a node, by names such as ux=1e3."""
        nodal = np.zeros((1, len(self.nodes), 6))
        for name, value in components.items():
            nodal[0, node, ("ux", "uy", "uz", "rx", "ry", "rz").index(name)] = value
        return nodal

    def uniform(self, member: int, load: tuple[float, float, float]) -> np.ndarray:
        """One case (1, m, 3) of a force a length on a member."""
        loads = np.zeros((1, len(self.rows), 3))
        loads[0, member] = load
        return loads


def building(seed: int = 0, bays: tuple[int, int] = (2, 1), storeys: int = 2, diaphragms: bool = True) -> Frame:
    """A small building of uneven spans with braces, hinges, semi-rigid joints and sections that are all different."""
    rng = np.random.default_rng(seed)
    f = Frame()
    x, y = np.cumsum([0.0, *rng.uniform(4, 7, bays[0])]), np.cumsum([0.0, *rng.uniform(4, 7, bays[1])])
    z = np.cumsum([0.0, *rng.uniform(3, 4, storeys)])
    grid = np.zeros((storeys + 1, len(y), len(x)), dtype=int)
    for k in range(storeys + 1):
        for j in range(len(y)):
            for i in range(len(x)):
                floor = k - 1 if diaphragms else -1
                grid[k, j, i] = f.node(x[i], y[j], z[k], fixed="all" if k == 0 else "", floor=floor)
        if k and diaphragms:
            f.masters.append((0.4 * x[-1], 0.6 * y[-1]))

    def section() -> dict[str, float]:
        values = {name: value * rng.uniform(0.5, 2.0) for name, value in SECTION.items()}
        return values | {"A_y": rng.uniform(2e-3, 6e-3), "A_z": rng.uniform(2e-3, 6e-3)}

    for k in range(1, storeys + 1):
        for j in range(len(y)):
            for i in range(len(x)):
                f.member(grid[k - 1, j, i], grid[k, j, i], **section())
                if i:
                    semi = (inf, inf, rng.uniform(1e7, 1e8), inf) if (i + j) % 2 else RIGID
                    f.member(grid[k, j, i - 1], grid[k, j, i], ends=semi, **section())
                if j:
                    f.member(grid[k, j - 1, i], grid[k, j, i], ends=HINGES if i % 2 else RIGID, **section())
        f.member(grid[k - 1, 0, 0], grid[k, 1, 0], axial_only=True, A=3e-3)
    return f
