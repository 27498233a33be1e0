"""P-Delta over the chord of a member against the closed forms of the linearised theory.

One P-Delta member adds -P/L (P compressive) to its lateral stiffness: with chord rotations only ("P-big-delta")
the closed form is exact, and only rounding and the tolerance of the equilibrium (set to 1e-12) remain: 1e-9.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import Structure, cantilever, channel, final

from edesign.core import Analysis, CoreError, Elastic, Model

L, EA, EI = 4.0, 2e9, 3e7
H = 20e3
CRITICAL = np.pi**2 * EI / (4 * L**2)


@pytest.mark.parametrize("share", [0.0, 0.3, 0.7, -0.5])
def test_one_member_cantilever(share: float) -> None:
    """delta = H / (3EI/L^3 - P/L); base moment H L + P delta; tension stiffens."""
    P = share * CRITICAL
    s = cantilever(L, EA, EI, geometry="p_delta")
    s.model.nodal_load(s.pattern, s.nodes[1], fx=H, fy=-P)
    got = final(
        s,
        [
            channel("displacement", s.nodes[1], 0, "u"),
            channel("reaction", s.nodes[0], 2, "m"),
            channel("reaction", s.nodes[0], 0, "h"),
            channel("global_force", s.elements[0], 3, "f"),
        ],
        tolerance=1e-12,
    )
    delta = H / (3 * EI / L**3 - P / L)
    assert got["u"] == pytest.approx(delta, rel=1e-9)
    assert got["m"] == pytest.approx(H * L + P * delta, rel=1e-9)
    assert got["h"] == pytest.approx(-H, rel=1e-9)
    assert got["f"] == pytest.approx(H, rel=1e-9)  # what the member receives at its top: P-Delta included


def test_portal_with_stiff_beam() -> None:
    """Sway stiffness sum of 12EI/h^3 - P/h."""
    m = Model()
    column, girder = m.elastic_section(EA, EI), m.elastic_section(1e3 * EA, 1e7 * EI)
    a0, b0, a1, b1 = m.node("A0", 0, 0), m.node("B0", 6, 0), m.node("A1", 0, L), m.node("B1", 6, L)
    for base in (a0, b0):
        m.fix(base, True, True, True)
    m.beam_column("A", a0, a1, column)
    m.beam_column("B", b0, b1, column)
    m.beam_column("G", a1, b1, girder, geometry="linear")
    for top in (a1, b1):  # equal shortening would still be exact; hold it, so that no moment comes from it
        m.fix(top, uy=True)
    leaning = m.node("P0", 12, 0), m.node("P1", 12, L)  # a leaning column takes gravity, but no moment
    m.fix(leaning[0], True, True, True)
    m.beam_column("P", *leaning, column, release=(True, True))
    m.fix(leaning[1], rz=True)
    m.tie(leaning[1], a1, ux=True)
    m.tie(b1, a1, ux=True)
    g = m.pattern()
    P = 0.8 * 2 * 12 * EI / L**3 * L
    m.nodal_load(g, a1, fx=H)
    m.nodal_load(g, leaning[1], fy=-P)
    got = final(Structure(m, [], [], g), [channel("displacement", a1, 0, "u")], tolerance=1e-9)
    assert got["u"] == pytest.approx(
        H / (2 * 12 * EI / L**3 - P / L), rel=1e-5
    )  # the beam's flexibility, magnified by 5


def exact_cantilever(P: float) -> tuple[float, float]:
    """Tip deflection and base moment of the beam-column equation EI v'' + P v = ..., Timoshenko & Gere (1961), 1.4."""
    k = np.sqrt(P / EI)
    return H / (P * k) * (np.tan(k * L) - k * L), H * np.tan(k * L) / k


def test_subdivision_converges_to_the_exact_beam_column() -> None:
    """The chords of n members leave out P-small-delta inside them: an error of second order in 1/n."""
    P = 0.5 * CRITICAL
    deflection, moment = exact_cantilever(P)
    errors = []
    for n in (2, 4, 8, 16):
        s = cantilever(L, EA, EI, n, "p_delta")
        s.model.nodal_load(s.pattern, s.nodes[-1], fx=H, fy=-P)
        got = final(
            s, [channel("displacement", s.nodes[-1], 0, "u"), channel("reaction", s.nodes[0], 2, "m")], tolerance=1e-12
        )
        errors.append([got["u"] / deflection - 1, got["m"] / moment - 1])
    order = np.log2(np.abs(np.array(errors[:-1]) / np.array(errors[1:])))
    np.testing.assert_allclose(order, 2.0, atol=0.15)
    assert np.abs(errors[-1]).max() < 1e-3


def test_initial_and_loaded_stiffness() -> None:
    """The tangent under gravity is the unloaded one less P/L at the sway degree, and no other term changes."""
    P = 0.4 * CRITICAL
    s = cantilever(L, EA, EI, geometry="p_delta")
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-P)
    a = s.analysis()
    before = a.stiffness().toarray()
    assert a.static(s.pattern).status == "completed"
    change = a.stiffness().toarray() - before
    expected = np.zeros((3, 3))
    sway = a.equations[s.nodes[1], 0]
    expected[sway, sway] = -P / L
    np.testing.assert_allclose(change, expected, atol=1e-9 * before.max())


def test_beyond_the_critical_load() -> None:
    """Above 3EI/L^2 the one-member cantilever is unstable: equilibrium exists on the straight path, but no
    structure stays in it. The run fails and says why, and the state is that below the critical load."""
    s = cantilever(L, EA, EI, geometry="p_delta")
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-3 * EI / L**2)
    a = s.analysis()
    assert a.static(s.pattern, 0.95).status == "completed"
    before = a.state()
    r = a.static(s.pattern, 1.05)
    assert r.status == "failed"
    assert "critical load" in r.reason or "stability" in r.reason
    np.testing.assert_array_equal(a.state(), before)
    assert np.linalg.eigvalsh(a.stiffness().toarray()).min() > 0.0


@pytest.mark.parametrize("count", [1, 2])
def test_modes_of_an_unstable_structure_are_refused(count: int) -> None:
    """Shortened beyond the critical load in displacement control. Also when fewer modes are asked for than there
    are: the negative squared frequency is not among the lowest positive ones."""
    s = cantilever(L, EA, EI, geometry="p_delta")
    s.model.mass(s.nodes[1], 1e3, 1e3)
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-1.0)
    a = s.analysis()
    critical = 3 * EI / L**2
    assert a.pushover(s.pattern, s.nodes[1], "uy", -0.95 * critical * L / EA, 2).status == "completed"
    assert a.modes(count).omega[0] > 0.0
    assert a.pushover(s.pattern, s.nodes[1], "uy", -1.05 * critical * L / EA, 1).status == "completed"
    assert np.linalg.eigvalsh(a.stiffness().toarray()).min() < 0.0
    with pytest.raises(CoreError, match="unstable"):
        a.modes(count)


def test_p_delta_of_a_truss() -> None:
    """A hanging mass point on a bar: lateral stiffness T / L."""
    m = Model()
    top, bottom = m.node("top", 0, 2), m.node("bottom", 0, 0)
    bar = m.truss("bar", top, bottom, m.material(Elastic(2e11)), 1e-3, geometry="p_delta")
    m.fix(top, True, True, True)
    m.fix(bottom, rz=True)
    m.link("guide", m.node("wall", 0, 0), bottom, (1e3, 0.0, 0.0))
    m.fix(2, True, True, True)
    g = m.pattern()
    m.nodal_load(g, bottom, fx=10.0, fy=-5e3)
    a = Analysis(m, tolerance=1e-12)
    got = a.static(g, channels=[channel("displacement", bottom, 0, "u"), channel("axial_force", bar, 0, "t")])
    assert got.status == "completed", got.reason
    assert got.final["t"] == pytest.approx(5e3, rel=1e-9)
    assert got.final["u"] == pytest.approx(10.0 / (1e3 + 5e3 / 2.0), rel=1e-9)
