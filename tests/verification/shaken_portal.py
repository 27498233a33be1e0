"""One yielding portal under gravity and a short ground motion, in any units and order, for tests of invariance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from verification.structures import FY, E, channel, i_layers

from edesign.core import Analysis, Bilinear, MenegottoPinto, Model, Newmark, Response

DT = 0.01


@dataclass(frozen=True)
class Units:
    """How many of the units of the run make 1 m, 1 N and 1 s."""

    length: float = 1.0
    force: float = 1.0
    time: float = 1.0

    @property
    def mass(self) -> float:
        return self.force * self.time**2 / self.length


SI = Units()


def ground(n: int = 300, amplitude: float = 8.0, frequency: float = 1.9) -> np.ndarray:
    t = np.arange(n + 1) * DT
    w = 2 * np.pi * frequency
    return amplitude * np.sin(np.pi * t / t[-1]) * (np.sin(w * t) + 0.4 * np.sin(2.7 * w * t + 1.0))


def portal(
    units: Units = SI,
    nodes: Sequence[int] = (0, 1, 2, 3),
    members: Sequence[int] = (0, 1, 2, 3),
    fibres: np.random.Generator | None = None,
    curved: bool = False,
) -> tuple[Model, list[int], list[int], int]:
    """Two P-Delta columns, a loaded beam and a brace; `nodes` and `members` are the orders in which they are made."""
    u = units
    stress = u.force / u.length**2
    m = Model()
    law = MenegottoPinto(E * stress, FY * stress, 0.01) if curved else Bilinear(E * stress, FY * stress, 0.01)
    steel = m.material(law)
    y, area = i_layers(4, 16)
    if fibres is not None:
        y, area = np.repeat(y, 3), np.repeat(area / 3, 3)
        order = fibres.permutation(y.size)
        y, area = y[order], area[order]
    section = m.fibre_section(y * u.length, area * u.length**2, steel)
    places = [("A0", 0.0, 0.0), ("B0", 6.0, 0.0), ("A1", 0.0, 3.5), ("B1", 6.0, 3.5)]
    ids = dict(
        zip(nodes, (m.node(places[k][0], places[k][1] * u.length, places[k][2] * u.length) for k in nodes), strict=True)
    )
    made: dict[int, int] = {}
    for k in members:
        if k == 3:
            made[k] = m.truss("D", ids[0], ids[3], steel, 4e-5 * u.length**2)
        else:
            i, j = ((0, 2), (1, 3), (2, 3))[k]
            made[k] = m.beam_column(f"M{k}", ids[i], ids[j], section, geometry="linear" if k == 2 else "p_delta")
    for k in (0, 1):
        m.fix(ids[k], True, True, True)
    g = m.pattern()
    for k in (2, 3):
        m.mass(ids[k], 20e3 * u.mass, 20e3 * u.mass)
        m.nodal_load(g, ids[k], fy=-200e3 * u.force)
    m.uniform_load(g, made[2], transverse=-15e3 * u.force / u.length)
    return m, [ids[k] for k in range(4)], [made[k] for k in range(4)], g


def prepare(m: Model, g: int, units: Units = SI, damping: str = "current", **settings: float) -> Analysis:
    """Gravity on, Rayleigh damping set."""
    a = Analysis(m, **settings)
    assert a.static(g, steps=2).status == "completed"
    a.rayleigh(0.3 / units.time, 1e-3 * units.time, damping)
    return a


def shake(
    units: Units = SI,
    nodes: Sequence[int] = (0, 1, 2, 3),
    members: Sequence[int] = (0, 1, 2, 3),
    fibres: np.random.Generator | None = None,
    motion: np.ndarray | None = None,
    curved: bool = False,
    **settings: float,
) -> tuple[Response, np.ndarray]:
    """Gravity, then the motion; the response and the state at its end."""
    m, n, e, g = portal(units, nodes, members, fibres, curved)
    a = prepare(m, g, units, "current", **settings)
    channels = [
        channel("displacement", n[2], 0, "u"),
        channel("displacement", n[3], 2, "r"),
        channel("reaction", n[0], 0, "h"),
        channel("reaction", n[1], 2, "m"),
        channel("end_force", e[2], 2, "beam"),
        channel("axial_force", e[3], 0, "brace"),
    ]
    acceleration = (ground() if motion is None else motion) * units.length / units.time**2
    r = a.history(acceleration, DT * units.time, Newmark(), channels)
    assert r.status == "completed", r.reason
    return r, a.state()
