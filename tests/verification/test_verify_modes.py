"""Natural modes: shear building in closed form, effective masses, massless degrees, state dependence."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import Structure, cantilever, steel_portal

from edesign.core import Analysis, Model

N, MASS, K = 8, 25e3, 4e7


def shear_building(n: int = N, every: int = 1) -> Structure:
    """Equal masses on equal springs, a mass at every so many; storeys are two-node links of 3 m that shear."""
    m = Model()
    nodes = [m.node(f"A{k}", 0.0, 3.0 * k) for k in range(n + 1)]
    m.fix(nodes[0], True, True, True)
    for k in range(1, n + 1):
        m.fix(nodes[k], False, True, True)
        if k % every == 0:
            m.mass(nodes[k], MASS)
    elements = [m.link(f"S{k + 1}", nodes[k], nodes[k + 1], (0.0, K, 0.0)) for k in range(n)]
    return Structure(m, nodes, elements, m.pattern())


def test_shear_building() -> None:
    """omega_j = 2 sqrt(k/m) sin((2j-1) pi / (2 (2n+1))), shape sin((2j-1) pi i / (2n+1)) at storey i. Rounding only."""
    s = shear_building()
    modes = s.analysis().modes(N)
    j = np.arange(1, N + 1)
    angle = (2 * j - 1) * np.pi / (2 * N + 1)
    np.testing.assert_allclose(modes.omega, 2 * np.sqrt(K / MASS) * np.sin(angle / 2), rtol=1e-10)
    np.testing.assert_allclose(modes.period, 2 * np.pi / modes.omega, rtol=1e-14)
    shapes = np.sin(np.outer(angle, np.arange(N + 1)))
    for k in range(N):
        found = modes.shapes[k, :, 0]
        np.testing.assert_allclose(found / found[1], shapes[k] / shapes[k, 1], atol=1e-8)
        assert not modes.shapes[k, :, 1:].any()
    effective = np.array([(MASS * v.sum()) ** 2 / (MASS * (v**2).sum()) for v in shapes[:, 1:]]) / (N * MASS)
    np.testing.assert_allclose(modes.effective_mass_ratio_x, effective, rtol=1e-8)
    assert modes.effective_mass_ratio_x.sum() == pytest.approx(1.0, abs=1e-12)


def test_sparse_condensation() -> None:
    """Above 600 equations massless degrees are condensed by sparse factors: springs in series, closed form as above.

    The flexibility of 640 springs loses three digits of 16.
    """
    every = 80
    omega = shear_building(N * every, every).analysis().modes(N).omega
    angle = (2 * np.arange(1, N + 1) - 1) * np.pi / (2 * N + 1)
    np.testing.assert_allclose(omega, 2 * np.sqrt(K / every / MASS) * np.sin(angle / 2), rtol=1e-9)


def test_orthogonality() -> None:
    """phi' M phi = 1, phi' K phi = omega^2, all else zero to rounding, also with masses in all directions."""
    s = steel_portal(geometry="linear")
    s.model.mass(s.nodes[2], 0.0, 0.0, 300.0)
    a = s.analysis()
    modes = a.modes(5)
    phi = modes.equations
    K_, M_ = a.stiffness(), np.diag(a.masses())
    assert np.array_equal(a.dense_stiffness(), K_.toarray())
    np.testing.assert_allclose(phi @ (M_ @ phi.T), np.eye(5), atol=1e-9)
    np.testing.assert_allclose(phi @ (K_ @ phi.T), np.diag(modes.omega**2), atol=1e-9 * modes.omega[-1] ** 2)
    assert modes.effective_mass_ratio_x.sum() == pytest.approx(1.0, abs=1e-10)  # five degrees have mass: all modes
    np.testing.assert_allclose(modes.participation[:, 0] ** 2 / 40e3, modes.effective_mass_ratio_x, rtol=1e-12)


def test_massless_degrees() -> None:
    """A tip mass along x on an elastic cantilever: omega^2 = 3 EI / (m L^3); rotation and height follow without
    mass."""
    s = cantilever(4.0, 1e9, 3e7)
    s.model.mass(s.nodes[1], 2e4)
    modes = s.analysis().modes(1)
    assert modes.omega[0] ** 2 == pytest.approx(3 * 3e7 / (2e4 * 64.0), rel=1e-12)
    assert modes.shapes[0, 1, 2] / modes.shapes[0, 1, 0] == pytest.approx(-3 / (2 * 4.0), rel=1e-12)


def test_gravity_lengthens_periods() -> None:
    """P-Delta: omega^2 = (3EI/L^3 - P/L) / m for one member."""
    s = cantilever(4.0, 1e9, 3e7, geometry="p_delta")
    s.model.mass(s.nodes[1], 2e4)
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-2e6)
    a = s.analysis()
    assert a.static(s.pattern).status == "completed"
    assert a.modes(1).omega[0] ** 2 == pytest.approx((3 * 3e7 / 64.0 - 2e6 / 4.0) / 2e4, rel=1e-9)


@pytest.mark.parametrize("members", [4, 8])
def test_cantilever_converges_to_the_continuous_one(members: int) -> None:
    """Clough & Penzien (1993), 18.2: omega = (1.8751)^2 sqrt(EI / (m L^4)); lumped masses err by about 1/n^2 of 0.5."""
    EI, mass, L = 3e7, 800.0, 6.0
    s = cantilever(L, 1e10, EI, members)
    for k, node in enumerate(s.nodes[1:], 1):
        s.model.mass(node, mass * L / members * (0.5 if k == members else 1.0))
    omega = s.analysis().modes(1).omega[0]
    assert omega == pytest.approx(1.875104**2 * np.sqrt(EI / (mass * L**4)), rel=0.5 / members**2)


def test_more_modes_than_masses() -> None:
    with pytest.raises(ValueError, match="degrees with mass"):
        shear_building().analysis().modes(N + 1)


def test_large_models_take_the_sparse_way_to_the_same_modes() -> None:
    """More than 600 degrees with mass go to ARPACK; the closed form holds there too (its tolerance is 1e-12)."""
    n = 640
    modes = shear_building(n).analysis().modes(3)
    j = np.arange(1, 4)
    np.testing.assert_allclose(
        modes.omega, 2 * np.sqrt(K / MASS) * np.sin((2 * j - 1) * np.pi / (2 * (2 * n + 1))), rtol=1e-8
    )


def test_masses_that_share_a_degree_add_up() -> None:
    m = Model()
    a, b = m.node("a", 0, 3), m.node("b", 5, 3)
    for k, node in enumerate((a, b)):
        base = m.node(f"base{k}", 5.0 * k, 0)
        m.fix(base, True, True, True)
        m.beam_column(f"C{k}", base, node, m.elastic_section(1e10, 2e7), geometry="linear")
        m.mass(node, 1e4)
    m.tie(b, a, ux=True)
    analysis = Analysis(m)
    assert analysis.masses()[analysis.equations[a, 0]] == 2e4
    assert analysis.modes(1).omega[0] ** 2 == pytest.approx(2 * 3 * 2e7 / 27 / 2e4, rel=1e-10)
    assert analysis.modes(1).effective_mass_ratio_x[0] == pytest.approx(1.0, rel=1e-12)
