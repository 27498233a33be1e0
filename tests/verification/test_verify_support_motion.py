"""Supports that move: pseudo-static and dynamic response in closed form, energy, halved steps, ties, rigid motion."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from scipy.linalg import expm
from verification.structures import channel

from edesign.core import Analysis, Channel, CoreError, LawValues, Model, MultilinearSpring, SupportMotion
from edesign.ground_motion.delayed import delayed_by, motion_at

H, L, EA, EI_C, EI_B, MASS, DT = 4.0, 8.0, 2.5e9, 4.0e7, 6.0e7, 30e3, 0.005


def pulse(n: int = 1200) -> np.ndarray:
    """A ground acceleration that begins and ends at rest, without displacement left: two derivatives of a bump."""
    t = DT * np.arange(n)
    T = t[-1] * 0.6
    w = 2.0 * pi * 3.0 / T
    x = np.where(t < T, 1.0, 0.0)
    s, c = np.sin(pi * t / T), np.cos(pi * t / T)
    p = pi / T
    bump = [s**4, 4.0 * p * s**3 * c, 12.0 * p * p * s * s * c * c - 4.0 * p * p * s**4]
    wave = [np.sin(w * t), w * np.cos(w * t), -w * w * np.sin(w * t)]
    return np.asarray(0.05 * x * (bump[2] * wave[0] + 2.0 * bump[1] * wave[1] + bump[0] * wave[2]))


def portal(dashpot: float = 0.0, tied: bool = False) -> tuple[Model, dict[str, int]]:
    m = Model()
    nodes = {"A0": m.node("A0", 0.0, 0.0), "B0": m.node("B0", L, 0.0), "A1": m.node("A1", 0.0, H)}
    nodes["B1"] = m.node("B1", L, H)
    for base in ("A0", "B0"):
        m.fix(nodes[base], True, True, True)
    post, girder = m.elastic_section(EA, EI_C), m.elastic_section(EA, EI_B)
    base = nodes["B0"]
    if tied:
        base = m.node("B0.tied", L, 0.0)
        m.tie(base, nodes["B0"], ux=True, uy=True, rz=True)
    m.beam_column("CA", nodes["A0"], nodes["A1"], post, geometry="linear")
    m.beam_column("CB", base, nodes["B1"], post, geometry="linear")
    m.beam_column("B", nodes["A1"], nodes["B1"], girder, geometry="linear")
    for top in ("A1", "B1"):
        m.mass(nodes[top], MASS, MASS, 0.02 * MASS)
    if dashpot:
        terms = ((0.8, nodes["A1"], 0), (0.6, nodes["A1"], 1), (-0.8, nodes["B0"], 0), (-0.6, nodes["B0"], 1))
        m.damper("D", LawValues("viscous", (dashpot,)), terms)
    return m, nodes


def matrices(dashpot: float) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """K_ff, K_fs for a sway of B0, M, and C_ff, C_fs of the damper, put together here; degrees A1 and B1."""

    def beam(length: float, EI: float, upright: bool) -> np.ndarray:
        k = EA / length
        b, c, d = 12.0 * EI / length**3, 6.0 * EI / length**2, EI / length
        local = np.array(
            [
                [k, 0, 0, -k, 0, 0],
                [0, b, c, 0, -b, c],
                [0, c, 4 * d, 0, -c, 2 * d],
                [-k, 0, 0, k, 0, 0],
                [0, -b, -c, 0, b, -c],
                [0, c, 2 * d, 0, -c, 4 * d],
            ]
        )
        if not upright:
            return local
        turn = np.kron(np.eye(2), [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        return np.asarray(turn.T @ local @ turn)

    # degrees: A0 0-2, B0 3-5, A1 6-8, B1 9-11
    K = np.zeros((12, 12))
    for first, second, k in ((0, 6, beam(H, EI_C, True)), (3, 9, beam(H, EI_C, True)), (6, 9, beam(L, EI_B, False))):
        at = [*range(first, first + 3), *range(second, second + 3)]
        K[np.ix_(at, at)] += k
    along = np.zeros(12)
    along[[6, 7, 3, 4]] = 0.8, 0.6, -0.8, -0.6
    C = dashpot * np.outer(along, along)
    free = slice(6, 12)
    M = MASS * np.diag([1.0, 1.0, 0.02, 1.0, 1.0, 0.02])
    return K[free, free], K[free, 3], M, C[free, free], C[free, 3]


def exact(ground: np.ndarray, base: np.ndarray, a0: float, a1: float, dashpot: float) -> np.ndarray:
    """Displacements relative to the ground by matrix exponentials, with loads that are linear within a step.

    M u'' + C (u' - r d') + K u + K_fs d + dampers = -M i a_g, r = -K^-1 K_fs: the pseudo-static motion is part of u.
    """
    K, K_s, M, C_d, C_s = matrices(dashpot)
    C = a0 * M + a1 * K
    r = -np.linalg.solve(K, K_s)
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros((6, 6)), np.eye(6)], [-inverse @ K, -inverse @ (C + C_d)]])
    influence = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    load = -np.outer(ground, influence) - (np.outer(base[0], K_s) - np.outer(base[1], C @ r - C_s)) @ inverse.T
    big = np.zeros((36, 36))
    big[:12, :12] = A
    big[:12, 12:24] = np.eye(12)
    big[12:24, 24:] = np.eye(12)
    step = expm(big * DT)
    state, found = np.zeros(12), [np.zeros(6)]
    for i in range(ground.size - 1):
        p = np.concatenate([np.zeros(6), load[i]])
        q = np.concatenate([np.zeros(6), (load[i + 1] - load[i]) / DT])
        state = step[:12, :12] @ state + step[:12, 12:24] @ p + step[:12, 24:] @ q
        found.append(state[:6])
    return np.array(found)


def test_delayed_motion_is_the_exact_integral() -> None:
    """Of a linear acceleration, at times between samples; before the start there is none."""
    a, h = np.array([0.0, 2.0, 2.0, -1.0]), 0.1
    times = np.array([-0.05, 0.0, 0.05, 0.15, 0.3, 0.5])
    u, v, acceleration = motion_at(a, h, times)
    # by hand: v(0.1) = 0.1, v(0.2) = 0.3, v(0.3) = 0.35; u(0.1) = 1/300, u(0.2) = u(0.1) + 0.01 + 0.01
    end = 1.0 / 300.0 + 0.02 + 0.1 * 0.3 + 0.01 * (2.0 * 2.0 - 1.0) / 6.0
    assert u == pytest.approx([0, 0, 20 * 0.05**3 / 6, 1 / 300 + 0.05 * 0.1 + 0.0025, end, end + 0.2 * 0.35], rel=1e-12)
    assert v == pytest.approx([0, 0, 10 * 0.05**2, 0.1 + 0.1, 0.35, 0.35], rel=1e-12)
    assert acceleration == pytest.approx([0, 0, 1.0, 2.0, -1.0, 0.0], rel=1e-12)


@pytest.mark.parametrize(("a0", "a1", "dashpot"), [(0.0, 0.0, 0.0), (0.4, 2e-3, 0.0), (0.0, 1e-3, 4e5)])
@pytest.mark.parametrize("tied", [False, True])
def test_portal_with_a_late_support(a0: float, a1: float, dashpot: float, tied: bool) -> None:
    """Sway of the tops against the exact solution. Both take loads as linear in a step; average acceleration lengthens
    the first period by (omega dt)^2 / 12, 6e-4, and shifts peaks after some cycles by ten times that."""
    ground, delay = pulse(), 0.0317
    base = delayed_by(ground, DT, delay)
    model, nodes = portal(dashpot, tied)
    analysis = Analysis(model, tolerance=1e-10)
    analysis.rayleigh(a0, a1, "initial")
    analysis.install_dampers()
    wanted = [channel("displacement", nodes[name], name=name) for name in ("A1", "B1", "B0")]
    wanted += [channel("velocity", nodes["B0"], name="v"), channel("acceleration", nodes["B0"], name="a")]
    motion = SupportMotion(nodes["B0"], "ux", tuple(base))
    response = analysis.history(ground, DT, channels=wanted, supports=[motion])
    assert response.status == "completed", response.reason
    for name, part in zip(("B0", "v", "a"), base, strict=True):
        assert response.values[name] == pytest.approx(part, abs=1e-12)
    solution = exact(ground, base, a0, a1, dashpot)
    for name, column in (("A1", 0), ("B1", 3)):
        error = np.abs(response.values[name] - solution[:, column]).max() / np.abs(solution[:, column]).max()
        assert error < 1e-2, name
    assert response.statistics["energy_error"] < 1e-4
    assert min(np.diff(response.energy["damping"])) >= -1e-9 * response.energy["input"].max()


def test_halving_the_step_quarters_the_error() -> None:
    ground, errors = pulse(), []
    reference = exact(ground, delayed_by(ground, DT, 0.02), 0.0, 2e-3, 0.0)[:, 0]
    for fine in (1, 2, 4):
        h = DT / fine
        t = np.arange((ground.size - 1) * fine + 1) * h
        a = np.interp(t, DT * np.arange(ground.size), ground)
        base = delayed_by(a, h, 0.02)
        model, nodes = portal()
        analysis = Analysis(model, tolerance=1e-11)
        analysis.rayleigh(0.0, 2e-3, "initial")
        motion = SupportMotion(nodes["B0"], "ux", tuple(base))
        response = analysis.history(a, h, channels=[channel("displacement", nodes["A1"], name="u")], supports=[motion])
        errors.append(np.abs(response.values["u"][::fine] - reference).max())
    print(errors)
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.15)


def test_supports_that_move_together_move_the_frame_as_the_ground_does() -> None:
    """All supports by d(t) and no ground motion: drift, and with d added the displacement, of the ground motion d''.
    The displacement of supports is a cubic in a step and average acceleration sees two parabolas: second order in the
        step."""
    ground = pulse()
    motion = motion_at(ground, DT, DT * np.arange(ground.size))
    drifts = []
    for by_supports in (False, True):
        model, nodes = portal()
        analysis = Analysis(model, tolerance=1e-11)
        analysis.rayleigh(0.0, 2e-3, "initial")
        terms = ((1.0, "displacement", nodes["A1"], 0), (-1.0, "displacement", nodes["A0"], 0))
        supports = [SupportMotion(nodes[base], "ux", tuple(motion)) for base in ("A0", "B0")] if by_supports else []
        response = analysis.history(
            np.zeros_like(ground) if by_supports else ground, DT, channels=[Channel("drift", terms)], supports=supports
        )
        drifts.append(response.values["drift"])
    assert np.abs(drifts[0] - drifts[1]).max() < 1e-3 * np.abs(drifts[0]).max()


def test_ground_of_a_spring_moves() -> None:
    """A mass on a spring and dashpot whose far end moves: the oscillator under base motion, relative to nothing."""
    k, c, mass = 4e6, 4e4, 20e3
    ground = pulse()
    motion = motion_at(ground, DT, DT * np.arange(ground.size))
    m = Model()
    far, node = m.node("ground", 0.0, 0.0), m.node("node", 0.0, 0.0)
    m.fix(far, True, True, True)
    m.fix(node, False, True, True)
    m.spring("S", far, node, (-1.0, 0.0, 0.0, 1.0, 0.0, 0.0), MultilinearSpring(k))
    m.damper("D", LawValues("viscous", (c,)), ((1.0, node, 0), (-1.0, far, 0)))
    m.mass(node, mass)
    still, moved = [], []
    for by_support, into in ((False, still), (True, moved)):
        analysis = Analysis(m, tolerance=1e-11)
        analysis.install_dampers()
        wanted = [channel("axial_force", 0, name="spring"), channel("reaction", far, name="reaction")]
        supports = [SupportMotion(far, "ux", tuple(motion))] if by_support else []
        response = analysis.history(0.0 * ground if by_support else ground, DT, channels=wanted, supports=supports)
        into += [response.values["spring"], response.values["reaction"]]
        assert response.statistics["energy_error"] < 1e-4
    for a, b in zip(still, moved, strict=True):
        assert np.abs(a - b).max() < 2e-3 * np.abs(a).max()


def test_refusals_name_the_support() -> None:
    model, nodes = portal()
    analysis = Analysis(model)
    ground = pulse(100)
    zero = np.zeros_like(ground)
    with pytest.raises(CoreError, match="degree 0 of node A1 has no support"):
        analysis.history(ground, DT, supports=[SupportMotion(nodes["A1"], "ux", (zero, zero, zero))])
    with pytest.raises(CoreError, match="the motion of B0 does not begin at rest"):
        analysis.history(ground, DT, supports=[SupportMotion(nodes["B0"], "ux", (zero + 1.0, zero, zero))])
    with pytest.raises(ValueError, match="as many samples"):
        analysis.history(ground, DT, supports=[SupportMotion(nodes["B0"], "ux", (zero[1:], zero, zero))])
    assert analysis.history(ground, DT).status == "completed"
