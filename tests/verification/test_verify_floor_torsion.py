"""Rigid floors that turn: a torsion pendulum, and an eccentric storey on four columns.

Reference: closed forms; the 3 x 3 eigenproblem about the centre of mass is written here (Chopra 2012, 9.5).
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.linalg import eigh

from edesign.core import Analysis, Channel, LawValues, Model, Newmark

HEIGHT = 3.5
EA, EI_Z, EI_Y, GJ = 1e9, 4e6, 9e6, 2e6


def floor(model: Model, x: float, y: float) -> int:
    master = model.node("floor", x, y, HEIGHT)
    model.fix(master, uz=True, rx=True, ry=True)
    return master


def column(model: Model, name: str, x: float, y: float, turn: float, section: int, geometry: str = "linear") -> int:
    """A column that is held against turning about horizontal axes at both ends; the node at its top."""
    foot, top = model.node(f"{name}0", x, y, 0.0), model.node(f"{name}1", x, y, HEIGHT)
    model.fix(foot, True, True, True, uz=True, rx=True, ry=True)
    model.fix(top, rx=True, ry=True)
    model.beam_column(name, foot, top, section, geometry=geometry, web=(cos(turn), sin(turn), 0.0))
    return top


@pytest.mark.parametrize("spread", [0.0, 1.3])
def test_torsion_pendulum(spread: float) -> None:
    """omega^2 = (GJ / L) / I, with I of the master, or with that of masses at their distances besides."""
    m = Model(3)
    top = column(m, "shaft", 2.0, -1.0, 0.3, m.elastic_section(EA, EI_Z, EI_Y, GJ))
    master = floor(m, 2.0, -1.0)
    inertia = 700.0
    m.mass(master, 0.0, 0.0, inertia)
    around = []
    for k in range(4 if spread else 0):
        around.append(m.node(f"m{k}", 2.0 + spread * cos(k * pi / 2), -1.0 + spread * sin(k * pi / 2), HEIGHT))
        m.fix(around[-1], uz=True, rx=True, ry=True)
        m.mass(around[-1], 50.0, 50.0)
        inertia += 50.0 * spread**2
    m.diaphragm(master, [top, *around])
    omega = sqrt(GJ / HEIGHT / inertia)
    modes = Analysis(m).modes(3 if spread else 1)
    turning = int(np.argmax(np.abs(modes.shapes[:, master, 5])))
    assert modes.omega[turning] == pytest.approx(omega, rel=1e-12)
    assert np.all(np.abs(modes.shapes[turning, master, :2]) < 1e-9)


CORNERS = ((0.0, 0.0, 0.0), (6.0, 0.0, pi / 2), (6.0, 5.0, 0.4), (0.0, 5.0, 0.0))
"""x, y and turn of the web of each column."""
MASSES = (4e3, 9e3, 6e3, 5e3)


def matrices() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Stiffness and masses over u_x, u_y, turn of the centre of mass, and that centre."""
    centre = np.average([c[:2] for c in CORNERS], axis=0, weights=MASSES)
    stiffness, mass = np.zeros((3, 3)), np.zeros((3, 3))
    for (x, y, turn), m in zip(CORNERS, MASSES, strict=True):
        dx, dy = x - centre[0], y - centre[1]
        along_web, across = 12 * EI_Y / HEIGHT**3, 12 * EI_Z / HEIGHT**3
        w = np.array([cos(turn), sin(turn)])
        k = along_web * np.outer(w, w) + across * (np.eye(2) - np.outer(w, w))
        to = np.array([[1.0, 0.0, -dy], [0.0, 1.0, dx]])
        stiffness += to.T @ k @ to
        stiffness[2, 2] += GJ / HEIGHT
        mass += m * to.T @ to
    return stiffness, mass, centre


def storey(geometry: str = "linear", damped: float = 0.0) -> tuple[Model, list[int], int]:
    m = Model(3)
    section = m.elastic_section(EA, EI_Z, EI_Y, GJ)
    centre = matrices()[2]
    tops = [column(m, f"C{k}", *corner, section, geometry) for k, corner in enumerate(CORNERS)]
    master = floor(m, *centre)
    m.diaphragm(master, tops)
    for top, mass in zip(tops, MASSES, strict=True):
        m.mass(top, mass, mass)
    if damped:  # on the ground, along x at the second corner
        m.damper("D", LawValues("viscous", (damped,)), [(1.0, tops[1], 0)])
    return m, tops, master


def test_three_frequencies_of_a_storey() -> None:
    """Exact but for rounding: the columns are held against rotation, so that 12 EI / L^3 is all there is."""
    stiffness, mass, _ = matrices()
    assert abs(mass - np.diag(np.diag(mass))).max() < 1e-9 * mass[2, 2]  # uncoupled about the centre
    squares, vectors = eigh(stiffness, mass)
    m, tops, master = storey()
    modes = Analysis(m).modes(3)
    np.testing.assert_allclose(modes.omega, np.sqrt(squares), rtol=1e-12)
    centre = matrices()[2]
    for shape, vector in zip(modes.shapes, vectors.T, strict=True):
        at_master = shape[master, [0, 1, 5]]
        vector = vector * np.sign(vector @ mass @ at_master)
        np.testing.assert_allclose(at_master, vector, rtol=0, atol=1e-10 * abs(vector).max())
        for top, (x, y, _turn) in zip(tops, CORNERS, strict=True):
            turned = vector[:2] + vector[2] * np.array([-(y - centre[1]), x - centre[0]])
            np.testing.assert_allclose(shape[top, :2], turned, rtol=0, atol=1e-10 * abs(vector).max())
    for axis, influence in enumerate(np.eye(3)[:2]):
        participation = vectors.T @ mass @ influence
        np.testing.assert_allclose(
            modes.effective_mass_ratio[:, axis], participation**2 / sum(MASSES), rtol=0, atol=1e-12
        )


def test_history_of_an_eccentric_storey() -> None:
    """Corner displacements and the damper there against the same recursion over three unknowns, in numpy.

    1e-9 of the peak: both are Newmark's method; equilibrium is iterated to 1e-12.
    """
    c, dt = 6e4, 0.01
    stiffness, mass, centre = matrices()
    m, tops, master = storey(damped=c)
    a = Analysis(m, tolerance=1e-12)
    a.install_dampers()
    t = np.arange(300) * dt
    gx, gy = 3.0 * np.sin(11.0 * t), 2.0 * np.sin(17.0 * t + 0.5)
    recorded = [
        Channel(f"{node}.{d}", ((1.0, "displacement", node, d),)) for node in (tops[1], master) for d in (0, 1, 5)
    ]
    recorded += [Channel("force", ((1.0, "damper_force", 0, 0),))]
    recorded += [Channel("total", ((1.0, "total_acceleration", tops[1], 1),))]
    r = a.history(gx, dt, Newmark(), recorded, along_y=gy)
    along = np.array([1.0, 0.0, -(CORNERS[1][1] - centre[1])])
    across = np.array([0.0, 1.0, CORNERS[1][0] - centre[0]])
    damping = c * np.outer(along, along)
    u, v = np.zeros(3), np.zeros(3)
    ground = np.array([gx, gy, 0 * gx])
    acceleration = np.linalg.solve(mass, -mass @ ground[:, 0])
    effective = stiffness + 4 / dt**2 * mass + 2 / dt * damping
    scale = abs(r.values[f"{tops[1]}.0"]).max()
    for k in range(1, t.size):
        load = -mass @ ground[:, k] + mass @ (4 / dt**2 * u + 4 / dt * v + acceleration) + damping @ (2 / dt * u + v)
        new = np.linalg.solve(effective, load)
        rate = 2 / dt * (new - u) - v
        acceleration = 4 / dt**2 * (new - u) - 4 / dt * v - acceleration
        u, v = new, rate
        for component, value in zip((0, 1, 5), u, strict=True):
            assert r.values[f"{master}.{component}"][k] == pytest.approx(value, abs=1e-9 * scale)
        assert r.values[f"{tops[1]}.0"][k] == pytest.approx(along @ u, abs=1e-9 * scale)
        assert r.values["force"][k] == pytest.approx(c * along @ v, abs=1e-8 * c * scale * 20)
        assert r.values["total"][k] == pytest.approx(across @ acceleration + gy[k], abs=1e-7)


def test_p_delta_softens_a_storey() -> None:
    """Weights P on columns take P / L off their lateral stiffness, in both directions and as the floor turns."""
    stiffness, mass, centre = matrices()
    m, tops, _ = storey("p_delta")
    weights = (2e5, 5e5, 3e5, 1e5)
    pattern = m.pattern()
    for top, weight, (x, y, _turn) in zip(tops, weights, CORNERS, strict=True):
        m.nodal_load(pattern, top, fz=-weight)
        to = np.array([[1.0, 0.0, -(y - centre[1])], [0.0, 1.0, x - centre[0]]])
        stiffness -= weight / HEIGHT * to.T @ to
    a = Analysis(m)
    a.static(pattern)
    np.testing.assert_allclose(a.modes(3).omega, np.sqrt(eigh(stiffness, mass, eigvals_only=True)), rtol=1e-11)
