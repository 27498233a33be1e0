"""Springs without length: closed forms, laws along paths, hinged members, damping beside stiff springs, energy."""

from __future__ import annotations

from math import inf, pi, sqrt

import numpy as np
import pytest
from verification.structures import TURN, channel, turned_spring

from edesign.core import (
    Analysis,
    Channel,
    ContactSpring,
    DeterioratingSide,
    DeterioratingSpring,
    Model,
    MultilinearSpring,
)

L, EA, EI = 3.0, 2.0e9, 2.0e7


def steel_hinge(stiffness: float = 1.0e7, Lambda: float = 0.8) -> DeterioratingSpring:
    side = DeterioratingSide(plastic=0.025, capping=0.15, ultimate=0.4, yield_force=1e5, capped=1.1, residual=0.4)
    return DeterioratingSpring(stiffness, side, side, *(Lambda * 1e5,) * 3)


def base_spring_cantilever(k: float, mass: float = 0.0, n: float = 0.0) -> tuple[Model, int, int, int]:
    """An upright cantilever on a rotational spring; n > 0: that is (n + 1) 6EI/L, and the member leaves it out."""
    m = Model()
    ground, base, top = m.node("ground", 0.0, 0.0), m.node("base", 0.0, 0.0), m.node("top", 0.0, L)
    m.fix(ground, True, True, True)
    m.tie(base, ground, ux=True, uy=True)
    column = m.beam_column("C", base, top, m.elastic_section(EA, EI), geometry="linear")
    law = MultilinearSpring(k)
    if n:
        k = (n + 1.0) * 6.0 * EI / L
        law = MultilinearSpring(0.0, ((1e5 / k, 1e5),))
    spring = m.spring("S", ground, base, TURN, law)
    if n:
        m.without_flexibility(column, 1.0 / k, 0.0)
        m.damping_factor(column, (n + 1.0) / n)
        m.damping_factor(spring, 0.0)
    if mass:
        m.mass(top, mass)
    push = m.pattern()
    m.nodal_load(push, top, fx=1.0)
    return m, top, spring, push


def test_cantilever_on_a_base_spring() -> None:
    """Tip deflection P L^3 / 3EI + P L^2 / k, and the period from it: exact to rounding."""
    k, mass = 1.5e7, 2.0e4
    m, top, _, push = base_spring_cantilever(k, mass)
    flexibility = L**3 / (3.0 * EI) + L**2 / k
    analysis = Analysis(m)
    assert analysis.modes(1).period[0] == pytest.approx(2.0 * pi * sqrt(mass * flexibility), rel=1e-12)
    response = analysis.static(push, 5e3, 1, [channel("displacement", top)])
    assert response.final[f"displacement_{top}_0"] == pytest.approx(5e3 * flexibility, rel=1e-12)


def test_member_that_leaves_out_its_springs_is_the_plain_member() -> None:
    """Stiffness condensed to the outer nodes, and end moments under load in the span: as without springs, to rounding.

    So it is for every shape of bending, not for double curvature alone, for which n was derived.
    """
    k = 11.0 * 6.0 * EI / L

    def build(hinged: bool) -> tuple[Model, list[int], int, int]:
        m = Model()
        outer = [m.node("a", 0.0, 0.0), m.node("b", L, 0.0)]
        ends = outer
        if hinged:
            ends = [m.node("a_in", 0.0, 0.0), m.node("b_in", L, 0.0)]
            for inner, node in zip(ends, outer, strict=True):
                m.tie(inner, node, ux=True, uy=True)
                m.spring("S", node, inner, TURN, MultilinearSpring(k))
        beam = m.beam_column("B", *ends, m.elastic_section(EA, EI), geometry="linear")
        if hinged:
            m.without_flexibility(beam, 1.0 / k, 1.0 / k)
        m.fix(outer[0], True, True, False)
        m.fix(outer[1], False, True, False)
        load = m.pattern()
        m.uniform_load(load, beam, transverse=-2e4)
        m.nodal_load(load, outer[1], mz=3e4)
        return m, outer, beam, load

    found = []
    for hinged in (False, True):
        m, outer, beam, load = build(hinged)
        analysis = Analysis(m)
        K = analysis.dense_stiffness()
        kept = [int(e) for e in analysis.equations[outer].ravel() if e >= 0]
        gone = [e for e in range(K.shape[0]) if e not in kept]
        condensed = K[np.ix_(kept, kept)]
        if gone:
            condensed = condensed - K[np.ix_(kept, gone)] @ np.linalg.solve(
                K[np.ix_(gone, gone)], K[np.ix_(gone, kept)]
            )
        response = analysis.static(load, 1.0, 1, [channel("end_force", beam, at) for at in range(6)])
        found.append((condensed, list(response.final.values()), analysis.energy_error))
    np.testing.assert_allclose(found[1][0], found[0][0], rtol=1e-9, atol=1e-9 * EI)
    np.testing.assert_allclose(found[1][1], found[0][1], rtol=1e-9, atol=1e-4)
    assert found[1][2] < 1e-12


def test_corners_and_masing() -> None:
    """A line of three slopes: the virgin curve through its corners; after a reversal all is twice as long."""
    corners = ((0.002, 100.0), (0.008, 160.0))
    law = MultilinearSpring(2000.0, corners)
    turns = np.array([0.008, 0.012, -0.004, -0.012, 0.012])
    _, forces, _ = turned_spring(law, turns)
    ends = forces[50::50]
    assert ends[0] == pytest.approx(160.0)
    assert ends[1] == pytest.approx(168.0)  # 0.004 x 2000 beyond the last corner
    assert ends[2] == pytest.approx(168.0 - 320.0)  # 2 x 0.008 back: twice the second corner
    assert ends[3] == pytest.approx(-168.0)
    assert ends[4] == pytest.approx(168.0)


def test_contact_pushes_only_and_gives_way_at_its_capacity() -> None:
    """Pressed by 3 mm at 1000 N/m with a capacity of 2 N: 1 mm is lost, and the contact opens there."""
    law = ContactSpring(1000.0, 2.0)
    m = Model()
    ground, node = m.node("ground", 0.0, 0.0), m.node("node", 0.0, 0.0)
    m.fix(ground, True, True, True)
    m.fix(node, True, False, True)
    spring = m.spring("S", ground, node, (0.0, -1.0, 0.0, 0.0, 1.0, 0.0), law)
    m.link("soft", ground, node, (0.0, 1.0, 0.0))  # holds the node where the contact is open
    push = m.pattern()
    m.nodal_load(push, node, fy=1.0)
    analysis = Analysis(m)
    forces = []
    for target in (-0.0015, -0.003, -0.0015, 0.002, -0.002):
        response = analysis.pushover(push, node, "uy", target, 20, [channel("axial_force", spring)])
        assert response.status == "completed", response.reason
        forces.append(response.final[f"axial_force_{spring}_0"])
    np.testing.assert_allclose(forces, [-1.5, -2.0, -0.5, 0.0, -1.0], atol=1e-9)
    assert analysis.energy_error < 2e-3  # of the trapezoidal rule over steps with a corner: (1/20)^2 of a leg


def test_backbone_of_a_deteriorating_spring() -> None:
    """Pushed once: yield, capping, residual strength and loss at the ultimate rotation lie where they were given."""
    law = steel_hinge()
    at_yield, K = 0.01, 1e7
    capping = at_yield + 0.025
    slope = 1.1e5 / 0.15
    residual = capping + (1.1e5 - 0.4e5) / slope
    turns = np.array([at_yield, capping, 0.5 * (capping + residual), residual, 0.35, 0.41])
    _, forces, _ = turned_spring(law, turns)
    ends = forces[50::50]
    expected = [1e5, 1.1e5, 0.75e5, 0.4e5, 0.4e5, 0.0]
    np.testing.assert_allclose(ends, expected, rtol=1e-9, atol=1e-6)
    assert forces[25] == pytest.approx(0.5 * K * at_yield)


def test_strength_deteriorates_by_the_energy_of_each_excursion() -> None:
    """Ibarra et al. 2005, Eqs. 3 to 5, by hand for two excursions: beta = E_i / (E_t - sum of E).

    Elastic-plastic (M_c = M_y), capping far away: the energy of an excursion is M_y times its plastic rotation.
    """
    side = DeterioratingSide(plastic=1.0, capping=1.0, ultimate=inf, yield_force=1e5, capped=1.0)
    law = DeterioratingSpring(1e7, side, side, strength=0.5e5)
    _, forces, _ = turned_spring(law, np.array([0.03, -0.03, 0.03]))
    E_t = 0.5e5
    first = 1e5 * 0.02
    negative = 1e5 * (1.0 - first / (E_t - first))
    second = negative * (0.06 - (1e5 + negative) / 1e7)
    positive = 1e5 * (1.0 - second / (E_t - first - second))
    assert forces[100] == pytest.approx(-negative, rel=1e-9)
    assert forces[150] == pytest.approx(positive, rel=1e-9)


def test_steps_do_not_change_a_deteriorating_path() -> None:
    """From turn to turn in one step or in fifty: the same forces, because a step is followed corner by corner."""
    turns = np.array([0.02, -0.03, 0.04, -0.05, 0.06, -0.01, 0.08])
    _, fine, _ = turned_spring(steel_hinge(), turns)
    m = Model()
    ground, node = m.node("ground", 0.0, 0.0), m.node("node", 0.0, 0.0)
    m.fix(ground, True, True, True)
    m.fix(node, True, True, False)
    spring = m.spring("S", ground, node, TURN, steel_hinge())
    push = m.pattern()
    m.nodal_load(push, node, mz=1.0)
    analysis = Analysis(m)
    for i, target in enumerate(turns):
        response = analysis.pushover(push, node, "rz", float(target), 1, [channel("axial_force", spring)])
        assert response.status == "completed", response.reason
        assert response.final[f"axial_force_{spring}_0"] == pytest.approx(fine[50 * (i + 1)], rel=1e-9)


def shaken(m: Model, top: int, spring: int, peak: float) -> tuple[Analysis, dict[str, np.ndarray]]:
    analysis = Analysis(m)
    rng = np.random.default_rng(4)
    ground = np.convolve(rng.normal(size=1200), np.hanning(25), mode="same") * np.sin(pi * np.arange(1200) / 1200)
    ground *= peak / np.max(np.abs(ground))
    wanted = [
        channel("axial_force", spring, name="moment"),
        channel("deformation", spring, name="rotation"),
        channel("strength_left", spring, name="left"),
        channel("displacement", top, name="u"),
    ]
    response = analysis.history(ground, 0.01, channels=wanted)
    assert response.status == "completed", response.reason
    return analysis, response.values


def test_energy_of_a_deteriorating_hinge_under_ground_motion() -> None:
    """Input = kinetic + stored + dissipated over a history in which half of the strength is lost."""
    m, top, _, _ = base_spring_cantilever(1.0, 5e4)
    ground, base = 0, 1
    spring = m.spring("hinge", ground, base, TURN, steel_hinge(Lambda=0.4))
    analysis, found = shaken(m, top, spring, 2.0)
    assert found["left"][-1] < 0.8
    assert np.max(np.abs(found["rotation"])) > 0.025
    # of the trapezoidal rule over steps in which the path has corners
    assert analysis.energy_error < 5e-3
    fine = np.cumsum(0.5 * (found["moment"][1:] + found["moment"][:-1]) * np.diff(found["rotation"]))
    assert fine[-1] > 0.0


def test_damping_of_a_hinged_member() -> None:
    """Decay of a cantilever with stiffness-proportional damping, by the closed form of one degree of freedom.

    In the first mode the moment falls linearly, and the spring with n = 10 takes L/(6EI (n+1)) of L/3EI: the member
    keeps (2n + 1) / (2n + 2) of the energy and has (n + 1) / n times the damping of its stiffness.
    """
    mass, n, ratio = 2.0e4, 10.0, 0.05
    m, top, _, _ = base_spring_cantilever(0.0, mass, n)
    analysis = Analysis(m)
    omega = analysis.modes(1).omega[0]
    assert omega == pytest.approx(sqrt(3.0 * EI / L**3 / mass), rel=1e-12)
    for kind in ("initial", "committed", "current"):
        analysis = Analysis(m)
        analysis.rayleigh(0.0, 2.0 * ratio / omega, kind)
        speed = np.zeros(analysis.n_equations)
        speed[analysis.equations[top, 0]] = 1e-3
        analysis.initial_velocity(speed)
        expected = ratio * (n + 1.0) / n * (2.0 * n + 1.0) / (2.0 * n + 2.0)
        damped = omega * sqrt(1.0 - expected**2)
        period = 2.0 * pi / damped
        steps = 400
        response = analysis.history(np.zeros(3 * steps + 1), period / steps, channels=[channel("displacement", top)])
        u = response.values[f"displacement_{top}_0"]
        peaks = [np.max(u[i * steps : (i + 1) * steps]) for i in range(3)]
        decay = np.log(peaks[0] / peaks[2]) / 2.0
        assert decay == pytest.approx(2.0 * pi * expected / sqrt(1.0 - expected**2), rel=2e-3), kind


@pytest.mark.parametrize("kind", ["initial", "current"])
def test_no_spurious_moment_beside_a_yielding_hinge(kind: str) -> None:
    """Zareian & Medina 2010: with the springs left out of the damping, inertia balances what the hinge can carry.

    The hinge is elastic-plastic: the moment of the mass at the column base, m (a + a_g) L, never exceeds M_y by more
    than the damping of the elastic member's own small motion, some per cent; with the stiff spring damped it is far
    more.
    """
    largest = {}
    for excluded in (True, False):
        m, top, spring, _ = base_spring_cantilever(0.0, 2.0e4, 10.0)
        if not excluded:
            m.damping_factor(spring, 1.0)
        analysis = Analysis(m)
        omega = analysis.modes(1).omega[0]
        analysis.rayleigh(0.0, 2.0 * 0.05 / omega, kind)
        t = np.arange(0.0, 4.0, 0.005)
        force = Channel("moment", ((2.0e4 * L, "total_acceleration", top, 0),))
        response = analysis.history(4.0 * np.sin(2.0 * pi * t / 0.9), 0.005, channels=[force])
        assert response.status == "completed", response.reason
        largest[excluded] = response.peak("moment") / 1e5
    assert 0.95 < largest[True] < 1.10
    if kind == "initial":
        assert largest[False] > 1.3
