"""Collapse loads by plastic theory (Baker, Horne & Heyman 1956), reached in displacement control.

A layered section is fully plastic at exactly sum A |y| fy when no layer lies on the neutral axis, and the first
and last Gauss-Lobatto points lie in the ends of a member, where hinges form. Yielding spreads along a member, so
that the load approaches the theoretical one from below: at the end of each push, elastic layers near the axis and
hinges still forming leave 0.1 % (portals: and axial forces another 0.1 %); the load never exceeds the theoretical
one (1e-6: the tolerance of the equilibrium).
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import (
    FY,
    E,
    Structure,
    channel,
    i_layers,
    line,
    plastic_moment,
    steel_cantilever,
)

from edesign.core import Bilinear, Model

LAYERS = i_layers(4, 16)
MP = plastic_moment(*LAYERS)
STEEL = Bilinear(E, FY)


def push(s: Structure, node: int, degree: str, target: float, steps: int = 60) -> np.ndarray:
    response = s.analysis().pushover(
        s.pattern, node, degree, target, steps, [channel("load_factor", s.pattern, 0, "f")]
    )
    assert response.status == "completed", response.reason
    return response.values["f"]


def check(load: np.ndarray, collapse: float, tolerance: float = 1e-3) -> None:
    assert load.max() <= collapse * (1 + 1e-6)
    assert load[-1] == pytest.approx(collapse, rel=tolerance)


def test_plastic_moment_of_three_plates() -> None:
    """Layers of equal depth have the first moment of the plates exactly: Wpl fy."""
    h, b, tf, tw = 0.45, 0.19, 0.0146, 0.0094
    assert MP == pytest.approx(FY * (b * tf * (h - tf) + tw * (h - 2 * tf) ** 2 / 4), rel=1e-12)


@pytest.mark.parametrize("points", [3, 5, 10])
def test_cantilever(points: int) -> None:
    s = steel_cantilever(4.0, LAYERS, STEEL, points=points)
    s.model.nodal_load(s.pattern, s.nodes[1], fx=1.0)
    check(push(s, s.nodes[1], "ux", 0.4), MP / 4.0)


def beam(left: bool, right: bool, span: float = 8.0) -> Structure:
    m = Model()
    section = m.fibre_section(*LAYERS, m.material(STEEL))
    nodes, elements = line(m, (0, 0), (span, 0), 2, section)
    m.fix(nodes[0], True, True, left)
    m.fix(nodes[2], False, True, right)
    g = m.pattern()
    m.nodal_load(g, nodes[1], fy=-1.0)
    return Structure(m, nodes, elements, g)


@pytest.mark.parametrize(
    "left, right, factor", [(False, False, 4), (True, False, 6), (True, True, 8)], ids=["simple", "propped", "fixed"]
)
def test_beams_with_a_central_force(left: bool, right: bool, factor: int) -> None:
    """4, 6 and 8 Mp / L."""
    s = beam(left, right)
    check(push(s, s.nodes[1], "uy", -0.6), factor * MP / 8.0)


def portal(height: float = 20.0, span: float = 32.0) -> Structure:
    """All members of one section; very slender, so that axial forces (N / Ny = 1 %) take less than 0.1 % off Mp."""
    m = Model()
    section = m.fibre_section(*LAYERS, m.material(STEEL))
    a0, a1 = m.node("A0", 0, 0), m.node("A1", 0, height)
    c, b1, b0 = m.node("C", span / 2, height), m.node("B1", span, height), m.node("B0", span, 0)
    pairs = [(a0, a1), (a1, c), (c, b1), (b0, b1)]
    elements = [m.beam_column(f"M{k}", i, j, section, geometry="linear") for k, (i, j) in enumerate(pairs)]
    for base in (a0, b0):
        m.fix(base, True, True, True)
    return Structure(m, [a0, a1, c, b1, b0], elements, m.pattern())


def test_portal_sway() -> None:
    """H h = 4 Mp."""
    s = portal()
    s.model.nodal_load(s.pattern, s.nodes[1], fx=1.0)
    check(push(s, s.nodes[1], "ux", 8.0), 4 * MP / 20.0, 2e-3)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 4.0])
def test_portal_combined(ratio: float) -> None:
    """H at the beam's level and V = ratio H in mid-span: the least of sway H h = 4 Mp, beam V l/2 = 4 Mp... and
    both together.

    With theta of the sway and l/2 = b: sway 4 Mp theta, beam V b theta = 4 Mp theta, combined (H h + V b) theta =
    6 Mp theta.
    """
    s, h, b = portal(), 20.0, 16.0
    s.model.nodal_load(s.pattern, s.nodes[1], fx=1.0)
    s.model.nodal_load(s.pattern, s.nodes[2], fy=-ratio)
    collapse = min(4 * MP / h, 4 * MP / (ratio * b), 6 * MP / (h + ratio * b))
    mechanism = int(np.argmin([4 * MP / h, 4 * MP / (ratio * b), 6 * MP / (h + ratio * b)]))
    assert mechanism == {0.3: 0, 1.0: 2, 4.0: 1}[ratio]
    node, degree, target = (s.nodes[2], "uy", -10.0) if mechanism == 1 else (s.nodes[1], "ux", 10.0)
    check(push(s, node, degree, target), collapse, 2e-3)


@pytest.mark.parametrize("geometry", ["p_delta", "corotational"])
def test_softening_past_the_peak(geometry: str) -> None:
    """A cantilever column under gravity: H L + P delta = Mp(N) after yield, a slope of -P/L.

    Mp with axial force from the layers themselves. Corotational: the height above the base is L + uy, and N = P
    cos + H sin of the chord's slope moves Mp by some 0.2 %.
    """
    L, P = 4.0, 600e3
    s = steel_cantilever(L, LAYERS, STEEL, geometry)
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-P)
    g = s.model.pattern()
    s.model.nodal_load(g, s.nodes[1], fx=1.0)
    a = s.analysis(tolerance=1e-9)
    assert a.static(s.pattern, steps=2).status == "completed"
    top = s.nodes[1]
    channels = [
        channel("load_factor", g, 0, "f"),
        channel("displacement", top, 0, "u"),
        channel("displacement", top, 1, "v"),
        channel("reaction", s.nodes[0], 2, "m"),
    ]
    response = a.pushover(g, top, "ux", 0.8, 120, channels)
    assert response.status == "completed", response.reason
    load, delta = response.values["f"], response.values["u"]
    height = L + (response.values["v"] if geometry == "corotational" else 0.0)
    capacity = load * height + P * delta
    np.testing.assert_allclose(capacity, response.values["m"], atol=1e-6 * MP)
    mp = plastic_moment(*LAYERS, axial=P)
    assert mp < 0.97 * MP  # the axial force matters
    tolerance = 1e-4 if geometry == "p_delta" else 3e-3
    assert capacity[-1] == pytest.approx(mp, rel=tolerance)
    assert capacity.max() <= mp * (1 + (1e-7 if geometry == "p_delta" else 3e-3))
    assert 3 < int(np.argmax(load)) < 60
    assert load[-1] < 0.0  # far past the peak: only displacement control gets here
    if geometry == "p_delta":
        slope = np.polyfit(delta[60:], load[60:], 1)[0]
        assert slope == pytest.approx(-P / L, rel=1e-3)  # the moment still grows by 1e-4 of itself
