"""Natural modes of space frames and the combination of modal values: closed forms, and other ways to the same."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
from verification.space_frames import SECTION, E, Frame, building

from edesign.core import CoreError
from edesign.core.space import combine, combine_internal


def cqc(omega: np.ndarray, damping: float = 0.05) -> np.ndarray:
    """Coefficients of modes of equal damping (Wilson, Der Kiureghian & Bayo 1981, Eq. 13)."""
    r = omega[:, None] / omega
    return np.asarray(8 * damping**2 * (1 + r) * r**1.5 / ((1 - r**2) ** 2 + 4 * damping**2 * r * (1 + r) ** 2))


def test_tip_mass() -> None:
    """A mass on a column, no diaphragm: omega^2 = 3 EI / (m h^3) along x and along y."""
    h, mass = 3.0, 5e3
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(0, 0, h))
    modes = f.model().modes([0.0, mass])
    stiffness = 3 * E / h**3 * np.array([SECTION["I_z"], SECTION["I_y"]])  # its web is along x: I_y bends along x
    np.testing.assert_allclose(modes.omega, np.sqrt(stiffness / mass), rtol=1e-11)
    np.testing.assert_allclose(modes.effective_mass_ratio[:, :2], [[0, 1], [1, 0]], atol=1e-11)
    np.testing.assert_allclose(np.abs(modes.participation[[1, 0], [0, 1]]), np.sqrt(mass), rtol=1e-11)
    np.testing.assert_allclose(
        modes.end_forces[1, 0, [1, 2, 4, 5]].max(), modes.displacements[1, 1, 0] * stiffness[1] * h, rtol=1e-9
    )


def eccentric_storey(e: float, om: float, radius: float) -> tuple[Frame, np.ndarray, float]:
    """One storey of stiffness k along y and k om^2 radius^2 in torsion, with its mass e off its centre."""
    k = 4e7
    f = Frame(masters=[(0.0, 0.0)])
    base = f.node(0, 0, 0, fixed="all")
    f.node(0, 0, 3.0, fixed="uz rx ry", floor=0, springs=(1e12, k, 0, 0, 0, k * om**2 * radius**2))
    f.member(base, 1, axial_only=True)
    mass = 2e5
    # two masses that have the radius of gyration about their centre
    f.node(e - radius, 0, 3.0, floor=0)
    f.node(e + radius, 0, 3.0, floor=0)
    return f, np.array([0.0, 0.0, mass / 2, mass / 2]), np.sqrt(k / mass)


@pytest.mark.parametrize(("ratio", "om"), [(0.2, 1.3), (0.05, 1.0), (0.5, 0.7)])
def test_eccentric_storey(ratio: float, om: float) -> None:
    """omega^2 / omega_y^2 = 1/2 [1 + W^2 -+ sqrt((1 - W^2)^2 + 4 (e/rho)^2)], W^2 = Om^2 + (e/rho)^2.

    Om is torsional stiffness about the centre of stiffness, W about that of mass.
    """
    radius = 6.0
    f, mass, omega_y = eccentric_storey(ratio * radius, om, radius)
    modes = f.model().modes(mass)
    W2 = om**2 + ratio**2
    root = np.sqrt((1 - W2) ** 2 + 4 * ratio**2)
    expected = np.array([1 + W2 - root, 1 + W2 + root]) / 2
    # the spring along x, 25 000 times as stiff, takes no part: no eccentricity across it
    np.testing.assert_allclose((modes.omega[:2] / omega_y) ** 2, expected, rtol=1e-9)
    np.testing.assert_allclose(modes.effective_mass_ratio.sum(axis=0), 1.0, atol=1e-9)


def test_eccentric_storey_printed() -> None:
    """Radius of the torsional stiffness about the centre of mass 1.3: 0.946221 and 1.743779."""
    f, mass, omega_y = eccentric_storey(0.2 * 6.0, np.sqrt(1.3**2 - 0.2**2), 6.0)
    modes = f.model().modes(mass, 2)
    np.testing.assert_allclose((modes.omega / omega_y) ** 2, [0.946221, 1.743779], atol=0.5e-6)


def test_modes_against_a_dense_problem() -> None:
    """K phi = omega^2 M phi of the masters: K is their flexibility inverted, M the sum of masses at the nodes."""
    f = building(11, bays=(2, 1), storeys=3)
    model = f.model()
    rng = np.random.default_rng(5)
    mass = rng.uniform(1e4, 3e4, len(f.nodes))
    # forces on single nodes, turned into forces on masters, give the flexibility of the masters
    n_floors = len(f.masters)
    first = [f.floors.index(k) for k in range(n_floors)]
    nodal = np.zeros((3 * n_floors, len(f.nodes), 6))
    F = np.zeros((3 * n_floors, 3 * n_floors))
    to_node = []
    for k in range(n_floors):
        x, y = np.array(f.nodes[first[k]])[:2] - f.masters[k]
        nodal[3 * k, first[k], [0, 5]] = 1.0, y
        nodal[3 * k + 1, first[k], [1, 5]] = 1.0, -x
        nodal[3 * k + 2, first[k], 5] = 1.0
        to_node.append(np.array([[1, 0, y], [0, 1, -x], [0, 0, 1]]))  # displacements of the master from the node's
    u = model.static(nodal).displacements
    for k in range(n_floors):
        F[3 * k : 3 * k + 3] = to_node[k] @ u[:, first[k]][:, [0, 1, 5]].T
    M = np.zeros_like(F)
    for node, floor in enumerate(f.floors):
        if floor >= 0:
            x, y = np.array(f.nodes[node])[:2] - f.masters[floor]
            g = np.array([[1, 0, -y], [0, 1, x]])
            M[3 * floor : 3 * floor + 3, 3 * floor : 3 * floor + 3] += mass[node] * g.T @ g
    squared, shapes = scipy.linalg.eigh(np.linalg.inv(F), M)
    modes = model.modes(mass)
    np.testing.assert_allclose(modes.omega**2, squared, rtol=1e-8)
    found = modes.floor_shapes.reshape(len(squared), -1)
    np.testing.assert_allclose(found @ M @ found.T, np.eye(len(squared)), atol=1e-9)
    np.testing.assert_allclose(np.abs(found @ M @ shapes), np.eye(len(squared)), atol=1e-7)
    np.testing.assert_allclose(modes.effective_mass_ratio.sum(axis=0), 1.0, atol=1e-10)


def test_masters_may_lie_anywhere() -> None:
    """Periods, forces, effective masses do not depend on where the masters are."""
    f = building(12)
    mass = np.random.default_rng(6).uniform(1e4, 3e4, len(f.nodes))
    here = f.model().modes(mass, 4)
    f.masters = [(x + 3.0, y - 7.0) for x, y in f.masters]
    there = f.model().modes(mass, 4)
    np.testing.assert_allclose(there.period, here.period, rtol=1e-10)
    np.testing.assert_allclose(there.effective_mass_ratio, here.effective_mass_ratio, atol=1e-9)
    scale = np.max(np.abs(here.end_forces), axis=(1, 2))[:, None, None]
    np.testing.assert_allclose(np.abs(there.end_forces) / scale, np.abs(here.end_forces) / scale, atol=1e-8)


def test_modal_forces_are_in_equilibrium_with_inertia() -> None:
    """Forces omega^2 m phi at the nodes give the displacements and end forces of the mode."""
    f = building(13, diaphragms=False)
    f.floors = [-1 if k < 9 else 0 for k in range(len(f.nodes))]
    f.masters = [(2.0, 1.0)]
    mass = np.random.default_rng(7).uniform(1e4, 3e4, len(f.nodes))
    model = f.model()
    modes = model.modes(mass)
    assert modes.omega.size == 2 * sum(1 for k, row in enumerate(f.fixed) if not row[0] and f.floors[k] < 0) + 3
    nodal = np.zeros((modes.omega.size, len(f.nodes), 6))
    nodal[:, :, :2] = modes.omega[:, None, None] ** 2 * mass[:, None] * modes.displacements[:, :, :2]
    static = model.static(nodal)
    for found, expected in ((static.displacements, modes.displacements), (static.end_forces, modes.end_forces)):
        scale = np.max(np.abs(expected), axis=(1, 2))[:, None, None]
        np.testing.assert_allclose(found / scale, expected / scale, atol=1e-8)


def test_what_modes_cannot_be() -> None:
    """Too many modes, negative masses, no mass that moves."""
    f = building(14)
    model = f.model()
    mass = np.zeros(len(f.nodes))
    with pytest.raises(ValueError, match="no mass can move"):
        model.modes(mass)
    mass[8] = 1e4  # one place in a floor has no moment of inertia
    with pytest.raises(ValueError, match="3 modes are asked for; the frame has 2"):
        model.modes(mass, 3)
    mass[9] = -1.0
    with pytest.raises(ValueError, match="the mass of node 9 is -1 kg; it must be a finite number of at least 0"):
        model.modes(mass)


def test_cqc_coefficients() -> None:
    """Wilson, Three-dimensional static and dynamic analysis of structures, chapter 15: damping 5 %, printed digits."""
    rho = cqc(np.array([13.87, 13.93, 43.99, 44.19, 54.42]))
    printed = {(0, 1): 0.998, (0, 2): 0.006, (0, 4): 0.004, (2, 3): 0.998, (2, 4): 0.180, (3, 4): 0.186}
    for (i, j), value in printed.items():
        assert rho[i, j] == pytest.approx(value, abs=1e-3)  # frequencies have four digits: 0.1794 for 0.180


def test_combination() -> None:
    """Quadratic forms by numpy; opposite modes of one frequency cancel; SRSS is the root of the sum of squares."""
    rng = np.random.default_rng(8)
    values = rng.normal(size=(101, 7))
    rho = cqc(np.sort(rng.uniform(5, 50, 7)))
    np.testing.assert_allclose(combine(values, rho), np.sqrt(np.einsum("qi,ij,qj->q", values, rho, values)), rtol=1e-12)
    np.testing.assert_allclose(combine(values, np.eye(7)), np.linalg.norm(values, axis=1), rtol=1e-12)
    assert combine(np.array([[1.0, -1.0]]), np.ones((2, 2)))[0] == 0.0
    with pytest.raises(CoreError, match="rho .*E-CORE-02"):
        combine(values, np.triu(rho))
    with pytest.raises(CoreError, match="E-CORE-10"):
        combine(np.full((1, 7), np.inf), rho)


def test_combination_at_stations() -> None:
    """Forms of internal forces that are found at each station of each mode first; 19 members are no whole group."""
    rng = np.random.default_rng(9)
    f = building(15)
    model = f.model()
    modes = model.modes(rng.uniform(1e4, 3e4, len(f.nodes)))
    rho = cqc(modes.omega)
    stations = [0.0, 0.2, 0.5, 0.77, 1.0]
    inner = model.internal(modes.end_forces, stations)
    expected = combine(inner.reshape(len(rho), -1).T, rho).reshape(inner.shape[1:])
    found = combine_internal(modes.end_forces, rho, stations)
    scale = np.max(expected, axis=(0, 1))
    np.testing.assert_allclose(
        found / scale, expected / scale, atol=1e-7
    )  # square roots of what cancels: 1e-8 of the ends
    with pytest.raises(CoreError, match="a station is not from 0 to 1"):
        combine_internal(modes.end_forces, rho, [1.1])
