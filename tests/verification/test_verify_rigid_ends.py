"""Rigid ends against members a million times as stiff in their place, and the energy balance of a shaken portal."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, Structure, channel, final, i_layers

from edesign.core import Bilinear, Model, Newmark

H, B, D_COLUMN, D_BEAM = 3.5, 6.0, 0.15, 0.225  # m; half depths
STIFF = 1e6
AXIAL, LATERAL, W = -900e3, 60e3, -20e3  # N, N, N/m


def portal(geometry: str, rigid: bool, law: str = "elastic") -> tuple[Structure, dict[str, int]]:
    """A portal, pinned at the left, whose columns end under and whose beam ends beside the joint.

    With `rigid` as members with rigid ends, else with stiff members between node and face.
    """
    m = Model()
    y, area = i_layers(4, 16)
    EA, EI = E * float(area.sum()), E * float(area @ y**2)
    steel = m.material(Bilinear(E, FY, 0.01)) if law == "fibres" else -1
    section = m.fibre_section(y, area, steel) if law == "fibres" else m.elastic_section(EA, EI)
    stiff = m.elastic_section(STIFF * EA, STIFF * EI) if not rigid else -1
    at = {"A0": (0.0, 0.0), "B0": (B, 0.0), "A1": (0.0, H), "B1": (B, H)}
    nodes = {name: m.node(name, *place) for name, place in at.items()}
    g = m.pattern()
    found = {}

    def member(name: str, start: str, end: str, arms: tuple[float, float], load: float) -> None:
        kind = geometry if name.startswith("C") or geometry == "corotational" else "linear"
        if rigid:
            found[name] = m.beam_column(name, nodes[start], nodes[end], section, geometry=kind)
            m.rigid_ends(found[name], *arms)
            if load:
                m.uniform_load(g, found[name], transverse=load)
            return
        (x0, y0), (x1, y1) = at[start], at[end]
        length = np.hypot(x1 - x0, y1 - y0)
        chain = [nodes[start]]
        for share in (arms[0] / length, 1.0 - arms[1] / length):
            if 0.0 < share < 1.0:
                chain.append(m.node(f"{name}{share:.2f}", x0 + share * (x1 - x0), y0 + share * (y1 - y0)))
        chain.append(nodes[end])
        kinds = [stiff] * bool(arms[0]) + [section] + [stiff] * bool(arms[1])
        for k, one in enumerate(kinds):
            element = m.beam_column(f"{name}{k}", chain[k], chain[k + 1], one, geometry=kind)
            if load:
                m.uniform_load(g, element, transverse=load)
            if one == section:
                found[name] = element

    member("C_A", "A0", "A1", (0.0, D_BEAM), 0.0)
    member("C_B", "B0", "B1", (0.0, D_BEAM), 0.0)
    member("B_1", "A1", "B1", (D_COLUMN, D_COLUMN), W)
    m.fix(nodes["A0"], True, True, False)
    m.fix(nodes["B0"], True, True, True)
    m.nodal_load(g, nodes["A1"], LATERAL, AXIAL)
    m.nodal_load(g, nodes["B1"], 0.0, AXIAL)
    for name in ("A1", "B1"):
        m.mass(nodes[name], 60e3)
    return Structure(m, list(nodes.values()), list(found.values()), g), found


@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
@pytest.mark.parametrize("law", ["elastic", "fibres"])
def test_rigid_ends_are_very_stiff_members(geometry: str, law: str) -> None:
    """Displacements, moments at the faces, and global forces; what a million times the stiffness leaves is 1e-6."""
    results = []
    for rigid in (True, False):
        s, found = portal(geometry, rigid, law)
        wanted = [channel("displacement", s.nodes[k], d, f"u{k}{d}") for k in (2, 3) for d in range(3)]
        wanted += [channel("end_force", e, c, f"{name}{c}") for name, e in found.items() for c in range(6)]
        wanted += [channel("reaction", s.nodes[k], d, f"r{k}{d}") for k in (0, 1) for d in range(3)]
        results.append(final(s, wanted))
    ours, stiff = results
    for kind, scale in (("u", 1e-2), ("C", 1e6), ("B", 1e5), ("r", 1e6)):
        for key in ours:
            if key.startswith(kind):
                assert ours[key] == pytest.approx(stiff[key], abs=1e-5 * scale), key


def energy_error(geometry: str, rigid: bool, law: str, dt: float) -> float:
    """Of a portal shaken for 2 s, after its gravity."""
    s, _ = portal(geometry, rigid, law)
    analysis = s.analysis(tolerance=1e-10)
    assert analysis.static(s.pattern, 1.0, 10).status == "completed"
    t = np.arange(0.0, 2.0, dt)
    response = analysis.history(4.0 * np.sin(2 * np.pi * t / 0.6), dt, method=Newmark())
    assert response.status == "completed"
    return float(response.statistics["energy_error"])


def test_the_energy_balance_counts_the_second_order_of_rigid_ends() -> None:
    """The trapezoidal rule is exact for a linear member with P-Delta: what is left is the tolerance of equilibrium."""
    assert energy_error("p_delta", True, "elastic", 0.01) < 1e-10


@pytest.mark.parametrize("geometry", ["p_delta", "corotational"])
def test_the_energy_balance_is_that_of_stiff_members(geometry: str) -> None:
    """Yielding leaves an error of the second order of the step, the same to a thousandth for both."""
    errors = {
        (rigid, dt): energy_error(geometry, rigid, "fibres", dt) for rigid in (True, False) for dt in (0.01, 0.0025)
    }
    for dt in (0.01, 0.0025):
        assert errors[True, dt] == pytest.approx(errors[False, dt], rel=1e-3)
    assert errors[True, 0.0025] < 0.1 * errors[True, 0.01]
