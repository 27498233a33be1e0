"""Steel frames in space up to their limit loads: in the core of histories, and by limit analysis as a linear program.

The program knows equilibrium and the yield stress of fibres, nothing of stiffness or of steps. Static theorem: the
limit load is the largest one that is in equilibrium with stresses which yield allows. Moments are linear between the
ends of a member, and the domain of N, M_y, M_z is convex, so that sections at the ends suffice.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_array

from edesign.core import Analysis, Bilinear, Channel, Model, Response
from edesign.frame.sections.space_section import SpaceSection, space_section

G = 8.1e10
FACTOR = "factor"
PLAN = ((0.0, 0.0), (5.0, 0.0), (5.0, 4.0), (0.0, 4.0))
SKEW = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)
ALL = ("ux", "uy", "uz", "rx", "ry", "rz")


@dataclass
class LimitFrame:
    """Nodes, supports, members, and loads that grow together.

    Attributes:
        E: Pa.
        fy: Pa.
        hardening: E_t / E of the fibres in the core.
        nodes: places, m.
        held: degrees of nodes that are supported.
        members: start, end, section, web.
        loads: force on nodes, N.
    """

    E: float = 2.1e11
    fy: float = 235e6
    hardening: float = 0.0
    nodes: list[tuple[float, ...]] = field(default_factory=list)
    held: dict[int, Sequence[str]] = field(default_factory=dict)
    members: list[tuple[int, int, str, tuple[float, ...]]] = field(default_factory=list)
    loads: dict[int, np.ndarray] = field(default_factory=dict)

    def node(self, x: float, y: float, z: float, held: Sequence[str] = ()) -> int:
        """Add a node."""
        self.nodes.append((x, y, z))
        if held:
            self.held[len(self.nodes) - 1] = held
        return len(self.nodes) - 1

    def member(
        self, start: int, end: int, section: str, web: tuple[float, ...], parts: int = 1, held: Sequence[str] = ()
    ) -> list[int]:
        """Add a member in equal parts, and return the nodes between them."""
        a, b = np.array(self.nodes[start]), np.array(self.nodes[end])
        places = [(a + (b - a) * k / parts).tolist() for k in range(1, parts)]
        inner = [self.node(x, y, z, held) for x, y, z in places]
        chain = [start, *inner, end]
        self.members += [(i, j, section, web) for i, j in zip(chain[:-1], chain[1:], strict=True)]
        return inner

    def load(self, node: int, fx: float = 0.0, fy: float = 0.0, fz: float = 0.0) -> None:
        """Add a force on a node."""
        self.loads[node] = self.loads.get(node, np.zeros(3)) + (fx, fy, fz)

    @property
    def sections(self) -> dict[str, SpaceSection]:
        """Fibres by name of the section."""
        return {name: space_section(name) for name in dict.fromkeys(member[2] for member in self.members)}

    def in_core(self, geometry: str, points: int = 5, torsion: float = 1.0) -> tuple[Model, int]:
        """The model and its pattern; `torsion` is the share of the torsional stiffness."""
        model = Model(3)
        steel = model.material(Bilinear(self.E, self.fy, self.hardening))
        for k, place in enumerate(self.nodes):
            model.node(f"n{k}", *place)
        for node, held in self.held.items():
            model.fix(node, **{degree: True for degree in held})
        sections = {
            name: model.fibre_section(s.y, s.area, steel, z=s.z, GJ=torsion * G * s.I_t)
            for name, s in self.sections.items()
        }
        for k, (start, end, name, web) in enumerate(self.members):
            model.beam_column(f"m{k}", start, end, sections[name], points, geometry, web=web)
        pattern = model.pattern()
        for node, (fx, fy, fz) in self.loads.items():
            model.nodal_load(pattern, node, fx, fy, fz=fz)
        return model, pattern

    def push(
        self, geometry: str, node: int, degree: str, target: float, steps: int, points: int = 5, torsion: float = 1.0
    ) -> Response:
        """Move a degree under the loads, whose factor and displacements "u{node}.{degree}" are recorded."""
        model, pattern = self.in_core(geometry, points, torsion)
        channels = [Channel(FACTOR, ((1.0, "load_factor", pattern, 0),))]
        places = [(n, d) for n in range(len(self.nodes)) for d in range(3)]
        channels += [Channel(f"u{n}.{d}", ((1.0, "displacement", n, d),)) for n, d in places]
        response = Analysis(model, tolerance=1e-9).pushover(pattern, node, degree, target, steps, channels)
        assert response.status == "completed", response.reason
        return response

    def moved(self, response: Response, row: int) -> LimitFrame:
        """The frame with its nodes where they were in a row; webs stay at right angles to the chords."""
        nodes = [
            tuple(float(at + response.values[f"u{n}.{d}"][row]) for d, at in enumerate(place))
            for n, place in enumerate(self.nodes)
        ]
        members = []
        for start, end, name, web in self.members:
            x = np.subtract(nodes[end], nodes[start])
            across = np.array(web) - x * (x @ np.array(web)) / (x @ x)
            members.append((start, end, name, tuple((across / np.linalg.norm(across)).tolist())))
        return replace(self, nodes=nodes, members=members)

    def limit_load(self) -> float:
        """Factor of the loads by the static theorem, without torsion.

        Unknowns are the factor and the stress over yield of each fibre at both ends of each member.
        """
        sections, n = self.sections, 6 * len(self.nodes)
        parts: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []  # equations, unknowns, coefficients
        unknowns, equations = 1, n

        def add(equation: int, unknown: np.ndarray, value: np.ndarray) -> None:
            parts.append((np.full(unknown.size, equation), unknown, value))

        for start, end, name, web in self.members:
            s, z = sections[name], np.array(web)
            x = np.subtract(self.nodes[end], self.nodes[start])
            length = np.linalg.norm(x)
            x = x / length
            force = self.fy * s.area
            moment = force * (np.outer(np.cross(z, x), s.z) - np.outer(z, s.y))  # M_y y + M_z z of each fibre, global
            at_i = unknowns + np.arange(s.area.size)
            at_j = at_i + s.area.size
            unknowns += 2 * s.area.size
            for own, node, side in ((at_i, start, -1.0), (at_j, end, 1.0)):
                shear = np.cross(x, side * moment, axisb=0, axisc=0) / length  # with the couple in equilibrium
                for c in range(3):
                    add(6 * node + 3 + c, own, side * moment[c])
                    add(6 * start + c, own, -shear[c])
                    add(6 * end + c, own, shear[c])
            for c in range(3):
                add(6 * start + c, at_i, -force * x[c])
                add(6 * end + c, at_i, force * x[c])
            add(equations, np.concatenate([at_i, at_j]), np.concatenate([force, -force]))  # N is the same at both ends
            equations += 1
        for node, load in self.loads.items():
            for c in range(3):
                add(6 * node + c, np.zeros(1, dtype=int), -load[c : c + 1])
        row, column, value = (np.concatenate(part) for part in zip(*parts, strict=True))
        supports = [6 * node + ALL.index(degree) for node, held in self.held.items() for degree in held]
        free = ~np.isin(row, supports)
        matrix = 1e-3 * coo_array((value[free], (row[free], column[free])), shape=(equations, unknowns)).tocsr()
        bounds = [(0.0, None), *[(-1.0, 1.0)] * (unknowns - 1)]
        found = linprog(
            -np.eye(1, unknowns)[0], A_eq=matrix, b_eq=np.zeros(equations), bounds=bounds, method="highs-ipm"
        )
        assert found.status == 0, found.message
        return float(found.x[0])


def two_storeys(parts: int = 1) -> tuple[LimitFrame, int]:
    """One bay by one, columns turned, beams loaded at midspan, forces beside the centre; and a node of the roof."""
    frame = LimitFrame()
    floors = [[frame.node(*at, h, ALL if h == 0.0 else ()) for at in PLAN] for h in (0.0, 3.5, 7.0)]
    for k in (1, 2):
        for c in range(4):
            frame.member(floors[k - 1][c], floors[k][c], "HEB160", SKEW[c % 2], parts)
            inner = frame.member(floors[k][c], floors[k][(c + 1) % 4], "IPE240", UP, 2 * parts)
            frame.load(inner[parts - 1], fz=-60e3)
        frame.load(floors[k][0], fx=30e3 * k, fy=12e3 * k)
        frame.load(floors[k][3], fx=10e3 * k)
    return frame, floors[2][0]


def setback() -> tuple[LimitFrame, int]:
    """Six storeys of two bays by two, the upper three of one by two: wind along y, vertical forces on all joints."""
    frame, grid = LimitFrame(), {}
    for k in range(7):
        for i in range(3 if k <= 3 else 2):
            for j in range(3):
                grid[i, j, k] = frame.node(6.0 * i, 5.0 * j, 3.4 * k, ALL if k == 0 else ())
    for (i, j, k), node in grid.items():
        if k == 0:
            continue
        frame.member(grid[i, j, k - 1], node, "HEB200" if k <= 3 else "HEB160", SKEW[(i + j) % 2])
        for other, section in (((i + 1, j, k), "IPE300"), ((i, j + 1, k), "IPE270")):
            if other in grid:
                frame.member(node, grid[other], section, UP)
        frame.load(node, fz=-90e3)
        if j == 0:
            frame.load(node, fx=4e3, fy=20e3)
    return frame, grid[0, 0, 6]


def sway(columns: str) -> tuple[LimitFrame, int]:
    """One storey on four equal columns under stiff beams, pushed askew under vertical forces; and a node above."""
    frame = LimitFrame()
    feet, heads = ([frame.node(*at, h, ALL if h == 0.0 else ()) for at in PLAN] for h in (0.0, 3.5))
    for c in range(4):
        frame.member(feet[c], heads[c], columns, SKEW[1])
        frame.member(heads[c], heads[(c + 1) % 4], "HEB400", UP)
        frame.load(heads[c], 10e3, 7e3, -400e3)
    return frame, heads[0]
