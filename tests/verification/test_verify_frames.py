"""Portal frames, trusses, links and rigid diaphragms against closed forms.

Kleinlogel (1939), fixed-base portal, members without axial deformation: EA is made so large that what remains of it is
below the tolerance of 1e-6.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import E, Structure, channel, final

from edesign.core import Analysis, Elastic, Model

H, SPAN = 4.0, 6.0
EI_COLUMN, EI_BEAM = 5e7, 8e7
RATIO = EI_BEAM / EI_COLUMN * H / SPAN  # Kleinlogel's k


def portal() -> Structure:
    m = Model()
    EA = 1e8 * EI_BEAM / H**2
    column, girder = m.elastic_section(EA, EI_COLUMN), m.elastic_section(EA, EI_BEAM)
    nodes = [m.node("A0", 0, 0), m.node("A1", 0, H), m.node("B1", SPAN, H), m.node("B0", SPAN, 0)]
    elements = [
        m.beam_column("C_A", nodes[0], nodes[1], column, geometry="linear"),
        m.beam_column("B", nodes[1], nodes[2], girder, geometry="linear"),
        m.beam_column("C_B", nodes[3], nodes[2], column, geometry="linear"),
    ]
    m.fix(nodes[0], True, True, True)
    m.fix(nodes[3], True, True, True)
    return Structure(m, nodes, elements, m.pattern())


def test_portal_under_lateral_force() -> None:
    p, force = portal(), 50e3
    p.model.nodal_load(p.pattern, p.nodes[1], fx=force / 2)
    p.model.nodal_load(p.pattern, p.nodes[2], fx=force / 2)
    a0, a1, _, b0 = p.nodes
    got = final(
        p,
        [
            channel("reaction", a0, 2, "base"),
            channel("end_force", p.elements[1], 2, "top"),
            channel("displacement", a1, 0, "drift"),
            channel("reaction", b0, 1, "pull"),
            channel("reaction", a0, 0, "ha"),
            channel("reaction", b0, 0, "hb"),
        ],
    )
    k = RATIO
    base, top = force * H / 2 * (3 * k + 1) / (6 * k + 1), force * H / 2 * 3 * k / (6 * k + 1)
    assert got["base"] == pytest.approx(base, rel=1e-6)
    assert abs(got["top"]) == pytest.approx(top, rel=1e-6)
    assert got["drift"] == pytest.approx(force * H**3 / (12 * EI_COLUMN) * (3 * k + 2) / (6 * k + 1), rel=1e-6)
    assert got["pull"] == pytest.approx(2 * top / SPAN, rel=1e-6)
    assert got["ha"] + got["hb"] == pytest.approx(
        -force, rel=1e-8
    )  # equilibrium: rounding times the ratio of stiffnesses


def test_portal_under_beam_load() -> None:
    p, w = portal(), -30e3
    p.model.uniform_load(p.pattern, p.elements[1], transverse=w)
    a0, _, _, b0 = p.nodes
    got = final(
        p,
        [
            channel("reaction", a0, 2, "base"),
            channel("end_force", p.elements[1], 2, "top"),
            channel("reaction", a0, 0, "thrust"),
            channel("reaction", b0, 0, "other"),
            channel("reaction", a0, 1, "va"),
        ],
    )
    corner = -w * SPAN**2 / (6 * (RATIO + 2))
    assert got["top"] == pytest.approx(corner, rel=1e-6)
    assert abs(got["base"]) == pytest.approx(corner / 2, rel=1e-6)
    assert got["thrust"] == pytest.approx(1.5 * corner / H, rel=1e-6)
    assert got["thrust"] + got["other"] == pytest.approx(0.0, abs=1e-11 * abs(w) * SPAN)
    assert got["va"] == pytest.approx(-w * SPAN / 2, rel=1e-9)


def test_three_bar_truss() -> None:
    """Timoshenko: bars at 0 and +-alpha; the middle one carries P / (1 + 2 cos^3 alpha). Rounding only."""
    m = Model()
    steel, area, alpha, h, load = m.material(Elastic(E)), 1e-3, 0.6, 3.0, 40e3
    bottom = m.node("bottom", 0, 0)
    g = m.pattern()
    bars = []
    for name, x in (("l", -h * np.tan(alpha)), ("m", 0.0), ("r", h * np.tan(alpha))):
        top = m.node(name, x, h)
        m.fix(top, True, True, True)
        bars.append(m.truss(name, bottom, top, steel, area))
    m.fix(bottom, rz=True)
    m.nodal_load(g, bottom, fy=-load)
    got = final(
        Structure(m, [bottom], bars, g),
        [channel("axial_force", b, 0, str(b)) for b in bars] + [channel("displacement", bottom, 1, "u")],
    )
    middle = load / (1 + 2 * np.cos(alpha) ** 3)
    assert got[str(bars[1])] == pytest.approx(middle, rel=1e-12)
    assert got[str(bars[0])] == pytest.approx(middle * np.cos(alpha) ** 2, rel=1e-12)
    assert got["u"] == pytest.approx(-middle * h / (E * area), rel=1e-12)


def test_zero_length_link_at_an_angle() -> None:
    """Stiffness R' diag(kx, ky) R for the free node, kr for its rotation. Rounding only."""
    m = Model()
    i, j = m.node("i", 1, 1), m.node("j", 1, 1)
    kx, ky, kr, angle = 3e6, 7e5, 2e4, 0.4
    m.link("k", i, j, (kx, ky, kr), angle)
    m.fix(i, True, True, True)
    stiffness = Analysis(m).stiffness().toarray()
    c, s = np.cos(angle), np.sin(angle)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    np.testing.assert_allclose(stiffness, turn.T @ np.diag([kx, ky, kr]) @ turn, rtol=1e-14, atol=1e-10 * kr)


def test_two_node_link_balances_its_shear() -> None:
    """Shear at mid-length: end moments V L / 2 each, and no force or moment in any rigid motion."""
    m = Model()
    i, j = m.node("i", 0.0, 0.0), m.node("j", 1.2, 1.6)  # length 2
    link = m.link("k", i, j, (3e6, 7e5, 2e4))
    # soft springs restrain translations, stiff ones rotations, so that the structure stands
    ground = m.node("ground", 0.0, 0.0), m.node("ground_j", 1.2, 1.6)
    for node, support in zip((i, j), ground, strict=True):
        m.fix(support, True, True, True)
        m.link("hold", support, node, (1.0, 1.0, 1e12))
    g = m.pattern()
    m.nodal_load(g, j, fx=-0.8e3, fy=0.6e3)  # across the link
    a = Analysis(m)
    free = a.equations[[i, j]].ravel()
    own = a.stiffness().toarray()[np.ix_(free, free)] - np.diag(2 * [1.0, 1.0, 1e12])
    rigid = np.array([[1, 0, 0, 1, 0, 0], [0, 1, 0, 0, 1, 0], [0, 0, 1, -1.6, 1.2, 1]], dtype=float)
    assert np.abs(own @ rigid.T).max() < 1e-3  # rounding of 1e12
    b = Structure(m, [i, j], [link], g)
    got = final(b, [channel("end_force", link, k, str(k)) for k in range(6)])
    assert got["1"] == pytest.approx(-got["4"], rel=1e-9)
    assert got["2"] + got["5"] == pytest.approx(-2.0 * got["4"], rel=1e-9)
    # the soft springs across at i and j are equal and the link, with its rotation fixed, is all but rigid: half
    # crosses it
    assert abs(got["4"]) == pytest.approx(0.5e3, rel=1e-5)


def test_rigid_diaphragm_shares_by_stiffness() -> None:
    """Tied tops move as one; forces share as 3 EI / h^3. Rounding only."""
    m = Model()
    EIs, heights = [2e7, 5e7, 9e7], [3.0, 3.5, 4.0]
    tops, bases = [], []
    for k, (EI, h) in enumerate(zip(EIs, heights, strict=True)):
        base, top = m.node(f"{k}0", 5.0 * k, 4.0 - h), m.node(f"{k}1", 5.0 * k, 4.0)
        m.beam_column(f"C{k}", base, top, m.elastic_section(1e10, EI), geometry="linear")
        m.fix(base, True, True, True)
        tops.append(top)
        bases.append(base)
    m.tie(tops[1], tops[0], ux=True)
    m.tie(tops[2], tops[1], ux=True)  # a chain of ties
    g = m.pattern()
    m.nodal_load(g, tops[2], fx=100e3)
    got = final(
        Structure(m, tops, [], g),
        [channel("displacement", n, 0, f"u{k}") for k, n in enumerate(tops)]
        + [channel("reaction", n, 0, f"h{k}") for k, n in enumerate(bases)],
    )
    stiffness = [3 * EI / h**3 for EI, h in zip(EIs, heights, strict=True)]
    u = 100e3 / sum(stiffness)
    for k in range(3):
        assert got[f"u{k}"] == pytest.approx(u, rel=1e-12)
        assert got[f"h{k}"] == pytest.approx(-stiffness[k] * u, rel=1e-12)


def test_support_at_a_tied_degree_holds_all() -> None:
    m = Model()
    nodes = [m.node("a", 0, 0), m.node("b", 0, 3), m.node("c", 5, 3)]
    m.fix(nodes[0], True, True, True)
    m.fix(nodes[2], True, True, True)
    m.beam_column("C", nodes[0], nodes[1], m.elastic_section(1e9, 1e7), geometry="linear")
    m.tie(nodes[1], nodes[2], ux=True)
    a = Analysis(m)
    assert a.equations[nodes[1], 0] == -1
    assert a.n_equations == 2
