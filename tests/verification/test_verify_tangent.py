"""The tangent stiffness against finite differences of equilibrium states: K du = dF.

A state in equilibrium under loads F is moved by small loads dF; the mean of the tangents before and after predicts the
motion to third order. Left out of the P-Delta tangent, by its design, is the change of the axial force times the
drift that is there: it would make the matrix unsymmetric. That term is added here from the recorded axial forces.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, Structure, i_layers

from edesign.core import Analysis, Bilinear, Channel, MenegottoPinto, Model, Response, Steel

PLACES = [(0.0, 0.0), (0.3, 3.5), (5.0, 4.0), (5.5, 0.0)]


def frame(geometry: str, law: Steel, release: bool, member_loads: bool) -> Structure:
    """A leaning two-member frame with an inclined brace and a link, loaded in every direction."""
    m = Model()
    steel = m.material(law)
    section = m.fibre_section(*i_layers(2, 8), steel)
    a, b, c, d = (m.node(name, *place) for name, place in zip("abcd", PLACES, strict=True))
    m.fix(a, True, True, True)
    m.fix(d, True, True, True)
    elements = [
        m.beam_column("col", a, b, section, geometry=geometry),
        m.beam_column("beam", b, c, section, points=4, geometry=geometry, release=(False, release)),
        m.truss("brace", c, d, steel, 2e-3, geometry=geometry),
    ]
    m.link("spring", d, c, (1e6, 2e6, 3e5))
    g = m.pattern()
    for node, fx, fy, mz in ((b, 150e3, -400e3, 40e3), (c, 60e3, -200e3, -30e3)):
        m.nodal_load(g, node, fx, fy, mz)
    if member_loads:
        m.uniform_load(g, elements[0], axial=-4e3, transverse=-6e3)
        m.uniform_load(g, elements[1], transverse=-20e3)
    return Structure(m, [a, b, c, d], elements, g)


def channels(s: Structure) -> list[Channel]:
    moved = [Channel(f"u{n}{d}", ((1.0, "displacement", n, d),)) for n in s.nodes for d in range(3)]
    return moved + [Channel(f"n{e}", ((1.0, "axial_force", e, 0),)) for e in s.elements]


def unsymmetric(a: Analysis, s: Structure, r: Response) -> np.ndarray:
    """dN times mean drift / L, across each member."""
    force = np.zeros(a.n_equations)
    for e, (i, j) in zip(s.elements, ((0, 1), (1, 2), (2, 3)), strict=True):
        (xi, yi), (xj, yj) = PLACES[i], PLACES[j]
        length = float(np.hypot(xj - xi, yj - yi))
        across = np.array([-(yj - yi), xj - xi]) / length
        drift = np.zeros(2)
        for d in range(2):
            drift += across[d] * (r.values[f"u{s.nodes[j]}{d}"][[0, -1]] - r.values[f"u{s.nodes[i]}{d}"][[0, -1]])
        change = r.values[f"n{e}"][-1] - r.values[f"n{e}"][0]
        for node, sign in ((i, -1.0), (j, 1.0)):
            for d in range(2):
                equation = a.equations[s.nodes[node], d]
                if equation >= 0:
                    force[equation] += sign * across[d] * change * drift.mean() / length
    return force


def mismatch(a: Analysis, s: Structure, geometry: str, pattern: int, factor: float, load: np.ndarray) -> float:
    """Largest |K du - dF| / |dF| for one more load."""
    before = a.stiffness().toarray()
    r = a.static(pattern, factor, 1, channels(s))
    assert r.status == "completed", r.reason
    after = a.stiffness().toarray()
    np.testing.assert_allclose(after, after.T, atol=1e-9 * np.abs(after).max())
    du = np.empty(a.n_equations)
    for n in s.nodes:
        for d in range(3):
            if a.equations[n, d] >= 0:
                du[a.equations[n, d]] = r.values[f"u{n}{d}"][-1] - r.values[f"u{n}{d}"][0]
    error = 0.5 * (before + after) @ du - load
    if geometry == "p_delta":
        error += unsymmetric(a, s, r)
    return float(np.abs(error).max() / np.abs(load).max())


@pytest.mark.parametrize("release", [False, True], ids=["rigid", "hinged"])
@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
def test_elastic(geometry: str, release: bool) -> None:
    """At every degree: dF is 1e-3 of F, so that the third order is 1e-6; rounding of the equilibrium is 1e-12 F /
    dF = 1e-9."""
    s = frame(geometry, Bilinear(E, 1e3 * FY), release, True)
    degrees = [(n, d) for n in s.nodes[1:3] for d in range(3)]
    patterns = []
    for node, d in degrees:
        patterns.append(s.model.pattern())
        s.model.nodal_load(patterns[-1], node, *[400.0 * (k == d) for k in range(3)])
    a = s.analysis(tolerance=1e-12, element_tolerance=1e-28)
    assert a.static(s.pattern, 1.0, 4).status == "completed"
    state = a.state()
    for (node, d), p in zip(degrees, patterns, strict=True):
        a.restore(state)
        load = np.zeros(a.n_equations)
        load[a.equations[node, d]] = 400.0
        assert mismatch(a, s, geometry, p, 1.0, load) < 2e-6


LAWS = {"hardening": Bilinear(E, FY, 0.1), "curved": MenegottoPinto(E, FY, 0.1, 5.0)}


@pytest.mark.parametrize("release", [False, True], ids=["rigid", "hinged"])
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
def test_yielded(geometry: str, law: Steel, release: bool) -> None:
    """On along the path of loading (elsewhere fibres unload, and the tangent of loading does not apply): 1e-4 of
    the loads more, after a first such step. Equilibrium to 1e-12 / 1e-4, curvature of the path 1e-8; 1e-5 leaves
    room for a fibre that turns."""
    s = frame(geometry, law, release, False)
    a = s.analysis(tolerance=1e-12, element_tolerance=1e-28, fast_elastic=0)
    assert a.static(s.pattern, 1.0, 5).status == "completed"
    assert a.static(s.pattern, 1.0001).status == "completed"
    load = np.zeros(a.n_equations)
    for node, forces in ((s.nodes[1], (150e3, -400e3, 40e3)), (s.nodes[2], (60e3, -200e3, -30e3))):
        load[a.equations[node]] = np.array(forces) * 1e-4
    elastic = s.analysis().stiffness().toarray()
    assert np.abs(a.stiffness().toarray() - elastic).max() > 0.01 * np.abs(elastic).max()  # it has yielded
    assert mismatch(a, s, geometry, s.pattern, 1.0002, load) < 1e-5
