"""Small structures and sections that the verification tests share. Units: m, N, kg, s."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.core import Analysis, Bilinear, Channel, Elastic, Model, MultilinearSpring, Response, SpringLaw, Steel

E = 2.1e11
FY = 275e6
# Three plates close to an IPE 450: depth, width, flange, web
I_SHAPE = (0.45, 0.19, 0.0146, 0.0094)


def channel(kind: str, item: int, component: int = 0, name: str = "") -> Channel:
    """One quantity of one node or element."""
    return Channel(name or f"{kind}_{item}_{component}", ((1.0, kind, item, component),))


def rectangle_layers(width: float, depth: float, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Depths and areas of n equal layers of a rectangle, each lumped at its mid-depth."""
    y = (np.arange(n) + 0.5) / n * depth - 0.5 * depth
    return y, np.full(n, width * depth / n)


def i_layers(flange: int, web: int, shape: tuple[float, ...] = I_SHAPE) -> tuple[np.ndarray, np.ndarray]:
    """Depths and areas of the layers of an I of three plates: `flange` layers in each flange and `web` in the web."""
    h, b, tf, tw = shape
    yf, af = rectangle_layers(b, tf, flange)
    yw, aw = rectangle_layers(tw, h - 2.0 * tf, web)
    arm = 0.5 * (h - tf)
    return np.concatenate([yf - arm, yw, yf + arm]), np.concatenate([af, aw, af])


def plastic_moment(y: np.ndarray, area: np.ndarray, axial: float = 0.0, fy: float = FY) -> float:
    """Largest moment of a fully yielded layered section with an axial force, by filling layers from one side.

    The layer in which the neutral axis lies carries the part of the stress that balances the axial force.
    """
    order = np.argsort(y)
    left = (float(np.sum(area)) * fy - abs(axial)) / 2.0  # force of the layers below the neutral axis
    moment = 0.0
    for k in order:
        force = area[k] * fy
        low = min(force, left)
        left -= low
        moment += y[k] * ((force - low) - low)
    return float(moment)


@dataclass
class Structure:
    """A model with what a test needs to know of it."""

    model: Model
    nodes: list[int] = field(default_factory=list)
    elements: list[int] = field(default_factory=list)
    pattern: int = -1

    def analysis(self, **settings: float) -> Analysis:
        return Analysis(self.model, **settings)


def line(
    m: Model,
    start: tuple[float, float],
    end: tuple[float, float],
    n: int,
    section: int,
    geometry: str = "linear",
    points: int = 5,
    name: str = "L",
    first: int | None = None,
    last: int | None = None,
) -> tuple[list[int], list[int]]:
    """A straight line of n beam-columns; `first` and `last` are end nodes that exist already."""
    nodes, elements = [], []
    for k in range(n + 1):
        x, y = (a + (b - a) * k / n for a, b in zip(start, end, strict=True))
        given = first if k == 0 else last if k == n else None
        nodes.append(m.node(f"{name}{k}", x, y) if given is None else given)
    for k in range(n):
        elements.append(
            m.beam_column(f"{name}_{k + 1}", nodes[k], nodes[k + 1], section, points=points, geometry=geometry)
        )
    return nodes, elements


def cantilever(
    length: float,
    EA: float,
    EI: float,
    n: int = 1,
    geometry: str = "linear",
    vertical: bool = True,
) -> Structure:
    """An elastic cantilever of n members, fixed at its first node, without loads."""
    m = Model()
    section = m.elastic_section(EA, EI)
    end = (0.0, length) if vertical else (length, 0.0)
    nodes, elements = line(m, (0.0, 0.0), end, n, section, geometry)
    m.fix(nodes[0], True, True, True)
    return Structure(m, nodes, elements, m.pattern())


def steel_cantilever(
    length: float, layers: tuple[np.ndarray, np.ndarray], law: Steel, geometry: str = "linear", points: int = 5
) -> Structure:
    """A fibre cantilever of one upright member."""
    m = Model()
    section = m.fibre_section(*layers, m.material(law))
    nodes, elements = line(m, (0.0, 0.0), (0.0, length), 1, section, geometry, points)
    m.fix(nodes[0], True, True, True)
    return Structure(m, nodes, elements, m.pattern())


def steel_portal(
    geometry: str = "p_delta",
    law: Steel | None = None,
    order: Sequence[int] = (0, 1, 2, 3),
    masses: bool = True,
    points: int = 5,
) -> Structure:
    """A fixed-base portal (6 m x 3.5 m) of I members with 24 layers; `order` is the order in which nodes are made.

    Nodes in the result: base left, base right, top left, top right. Elements: left column, right column, beam.
    """
    m = Model()
    section = m.fibre_section(*i_layers(4, 16), m.material(law or Bilinear(E, FY, 0.01)))
    place = [("A0", 0.0, 0.0), ("B0", 6.0, 0.0), ("A1", 0.0, 3.5), ("B1", 6.0, 3.5)]
    ids = {k: m.node(*place[k]) for k in order}
    nodes = [ids[k] for k in range(4)]
    elements = [
        m.beam_column("C_A_1", nodes[0], nodes[2], section, points, geometry),
        m.beam_column("C_B_1", nodes[1], nodes[3], section, points, geometry),
        m.beam_column("B_1_1", nodes[2], nodes[3], section, points, "linear" if geometry == "p_delta" else geometry),
    ]
    for node in nodes[:2]:
        m.fix(node, True, True, True)
    for node in nodes[2:]:
        if masses:
            m.mass(node, 20e3, 20e3)
    return Structure(m, nodes, elements, m.pattern())


def oscillator(stiffness: float, mass: float, law: Steel | None = None, parallel: float = 0.0) -> Structure:
    """A mass on a bar of 1 m and 1 m2 along x, free along x only; E (or the law) gives the stiffness.

    Args:
        law: of the bar; its E is the stiffness then.
        parallel: stiffness of an elastic bar beside it.
    """
    m = Model()
    steel = m.material(law or Elastic(stiffness))
    a, b = m.node("ground", 0.0, 0.0), m.node("mass", 1.0, 0.0)
    m.fix(a, True, True, True)
    m.fix(b, False, True, True)
    elements = [m.truss("bar", a, b, steel, 1.0)]
    if parallel > 0.0:
        elements.append(m.link("spring", a, b, (parallel, 0.0, 0.0)))
    if mass > 0.0:
        m.mass(b, mass)
    return Structure(m, [a, b], elements, m.pattern())


def final(structure: Structure, channels: Sequence[Channel], steps: int = 1, **settings: float) -> dict[str, float]:
    """Values of channels after the structure's loads were applied; the run must complete."""
    response: Response = structure.analysis(**settings).static(structure.pattern, steps=steps, channels=channels)
    assert response.status == "completed", response.reason
    return response.final


TURN = (0.0, 0.0, -1.0, 0.0, 0.0, 1.0)
"""Of a spring that turns with the difference of two rotations."""


def turned_spring(law: SpringLaw, turns: Sequence[float], steps: int = 50) -> tuple[np.ndarray, np.ndarray, Analysis]:
    """Turn a rotational spring through turning points, in so many steps from each to the next.

    Returns:
        Its rotations and moments from rest on, and the analysis.
    """
    m = Model()
    ground, node = m.node("ground", 0.0, 0.0), m.node("node", 0.0, 0.0)
    m.fix(ground, True, True, True)
    m.fix(node, True, True, False)
    spring = m.spring("S", ground, node, TURN, law)
    m.spring("soft", ground, node, TURN, MultilinearSpring(1.0))  # holds the node where the law has no stiffness
    push = m.pattern()
    m.nodal_load(push, node, mz=1.0)
    analysis = Analysis(m)
    path, moments = [0.0], [0.0]
    for turn in turns:
        response = analysis.pushover(push, node, "rz", float(turn), steps, [channel("axial_force", spring)])
        assert response.status == "completed", response.reason
        path += list(response.time[1:])
        moments += list(response.values[f"axial_force_{spring}_0"][1:])
    return np.array(path), np.array(moments), analysis
