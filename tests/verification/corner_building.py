"""A small irregular building of two storeys, anywhere: turned about z, tilted, or mirrored across the plane x = 0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import cos, sin
from typing import Any

import numpy as np

from edesign.core import Analysis, Bilinear, Channel, Integrator, LawValues, Model, MultilinearSpring, Response, Steel
from edesign.core.analysis import AVERAGE_ACCELERATION

E = 2.1e11
FY = 235e6
CORNERS = ((0.0, 0.0), (5.0, 0.0), (5.5, 4.0), (-0.5, 3.5))
HEIGHTS = (0.0, 3.2, 6.2)
MASSES = (9e3, 14e3, 11e3, 7e3)
FORCE, MOMENT = (4e3, 2e3, -90e3), (3e3, -2e3, 1e3)  # N, N m on each corner
SHARP = {"tolerance": 1e-12, "element_tolerance": 1e-24}


@dataclass(frozen=True)
class Placing:
    """A rotation about z, after the mirror if there is one, then about x; `web_turn` is of the local axes alone."""

    angle: float = 0.0
    mirrored: bool = False
    tilt: float = 0.0
    web_turn: float = 0.0

    @property
    def hand(self) -> float:
        return -1.0 if self.mirrored else 1.0

    def vector(self, v: Sequence[float]) -> tuple[float, float, float]:
        """Where a place, a displacement or a force goes."""
        x, c, s = self.hand * v[0], cos(self.angle), sin(self.angle)
        y, c_x, s_x = s * x + c * v[1], cos(self.tilt), sin(self.tilt)
        return c * x - s * v[1], c_x * y - s_x * v[2], s_x * y + c_x * v[2]

    def turn(self, v: Sequence[float]) -> tuple[float, float, float]:
        """Where a rotation or a moment goes: the mirror takes the axial vectors' other sign."""
        x, y, z = self.vector(v)
        return self.hand * x, self.hand * y, self.hand * z


@dataclass
class Built:
    model: Model
    corners: list[list[int]]
    masters: list[int] = field(default_factory=list)
    members: list[int] = field(default_factory=list)
    columns: list[int] = field(default_factory=list)
    dampers: list[int] = field(default_factory=list)
    pattern: int = -1

    @property
    def nodes(self) -> list[int]:
        return [node for floor in self.corners for node in floor] + self.masters


def turned(placing: Placing, y: Any, z: Any) -> tuple[Any, Any]:
    """Places of fibres, or components of loads, in local axes that are turned; a mirror swaps the sides of y."""
    c, s = cos(placing.web_turn), sin(placing.web_turn)
    return placing.hand * (c * y + s * z), c * z - s * y


def angle_fibres() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places y, z and areas of the fibres of a box with a thick corner: N, M_z and M_y are coupled."""
    s = (np.arange(6) + 0.5) / 6 * 0.28 - 0.14
    flat = np.full(6, 0.14)
    y, z = np.concatenate([s, s, flat, -flat]), np.concatenate([flat, -flat, s, s])
    area = np.full(24, 0.28 * 0.01 / 6) * np.where((y > 0.0) & (z > 0.0), 1.6, 1.0)
    return y, z, area


def building(
    placing: Placing,
    law: Steel | None = None,
    geometry: str = "p_delta",
    diaphragms: bool = True,
    spring: bool = True,
    dampers: bool = True,
    inside: bool = True,
) -> Built:
    """Columns and beams of fibres, a bar, a spring, three dampers; loads on nodes and, if asked, inside beams."""
    m = Model(3)
    steel = m.material(law or Bilinear(E, FY, 0.01))
    y, z, area = angle_fibres()
    y, z = turned(placing, y, z)
    section = m.fibre_section(y, area, steel, z=z, GJ=4e6)
    nodes = [
        [m.node(f"{name}{level}", *placing.vector((*at, height))) for name, at in zip("abcd", CORNERS, strict=True)]
        for level, height in enumerate(HEIGHTS)
    ]
    built = Built(m, nodes, pattern=m.pattern())
    for node in nodes[0]:
        m.fix(node, True, True, True, uz=True, rx=True, ry=True)
    centre = np.average(CORNERS, axis=0, weights=MASSES)
    for height, floor in zip(HEIGHTS[1:], nodes[1:], strict=True):
        for node, mass in zip(floor, MASSES, strict=True):
            m.mass(node, mass, mass, mz=mass)
        if diaphragms:
            master = m.node(f"floor {height}", *placing.vector((*centre, height)))
            m.fix(master, uz=True, rx=True, ry=True)
            m.diaphragm(master, floor)
            built.masters.append(master)
    for level in (1, 2):
        for k in range(4):
            web = placing.vector((cos(0.5 * k + placing.web_turn), sin(0.5 * k + placing.web_turn), 0.0))
            low, high = nodes[level - 1][k], nodes[level][k]
            built.columns.append(m.beam_column(f"C{k}{level}", low, high, section, 5, geometry, web=web))
    built.members += built.columns
    c, s = cos(placing.web_turn), sin(placing.web_turn)
    for level in (1, 2):
        for k in range(4):
            at, to = np.array(CORNERS[k]), np.array(CORNERS[(k + 1) % 4])
            x, y = (to - at) / np.hypot(*(to - at))
            free = k == 2  # of both moments at its end
            beam = m.beam_column(
                f"B{k}{level}",
                nodes[level][k],
                nodes[level][(k + 1) % 4],
                section,
                4,
                "linear",
                (False, False, free, free),
                web=placing.vector((s * y, -s * x, c)),
            )
            if inside:
                m.uniform_load(built.pattern, beam, 1e3, *turned(placing, 2e3, -12e3))
                m.point_load(built.pattern, beam, 0.4, -2e3, *turned(placing, 3e3, -9e3))
            built.members.append(beam)
    built.members.append(m.truss("bar", nodes[0][0], nodes[1][1], steel, 8e-4, geometry))
    for floor in nodes[1:]:
        for node in floor:
            fx, fy, fz = placing.vector(FORCE)
            mx, my, mz = placing.turn(MOMENT)
            m.nodal_load(built.pattern, node, fx, fy, mz, fz=fz, mx=mx, my=my)
    along = placing.vector((0.8, 0.6, 0.0))
    if spring:  # along a direction in plan, between two levels and two corners
        terms = [-c for c in along] + [0.0] * 3 + list(along) + [0.0] * 3
        law_of_spring = MultilinearSpring.bilinear(3e6, 3e4, 0.05)
        built.members.append(m.spring("spring", nodes[0][2], nodes[2][3], terms, law_of_spring))
    if dampers:
        for corner, direction in ((0, (1.0, 0.0, 0.0)), (2, (0.0, 1.0, 0.0)), (1, (0.6, 0.0, 0.8))):
            to = placing.vector(direction)
            over = [(c, nodes[2][corner], d) for d, c in enumerate(to)]
            under = [(-c, nodes[1][corner], d) for d, c in enumerate(to)]
            built.dampers.append(m.damper(f"D{corner}", LawValues("viscous_power", (6e4, 0.6)), over + under))
    return built


def motions(dt: float, seconds: float, size: float) -> np.ndarray:
    """Three components of a ground motion that begins and ends softly, (3, nt) m/s2."""
    t = np.arange(round(seconds / dt) + 1) * dt
    shape = np.sin(np.pi * t / seconds) ** 2
    x = np.sin(9.0 * t) + 0.5 * np.sin(23.0 * t)
    y = 0.8 * np.sin(7.5 * t + 0.4) + 0.4 * np.sin(31.0 * t)
    z = 0.5 * np.sin(27.0 * t + 1.0)
    return size * shape * np.array([x, y, z])


def node_channels(built: Built) -> list[Channel]:
    """Displacements of all nodes."""
    return [Channel(f"u{node}.{d}", ((1.0, "displacement", node, d),)) for node in built.nodes for d in range(6)]


def shaken(
    built: Built,
    ground: np.ndarray,
    dt: float,
    channels: Sequence[Channel] = (),
    damping: str = "current",
    method: Integrator = AVERAGE_ACCELERATION,
    shortcuts: bool = True,
) -> Response:
    """Gravity, then a history of three components with Rayleigh damping and dampers."""
    a = Analysis(built.model, fast_elastic=float(shortcuts), **SHARP)
    r = a.static(built.pattern, steps=2)
    assert r.status == "completed", r.reason
    a.rayleigh(0.3, 1e-3, damping)
    a.install_dampers()
    r = a.history(ground[0], dt, method, channels, vertical=ground[2], along_y=ground[1])
    assert r.status == "completed", r.reason
    return r
