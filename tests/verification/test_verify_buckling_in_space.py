"""Euler's load of columns in both planes by P-Delta members, 1 to 8 of them.

References: closed forms; the column of strings and beams that P-Delta is, written in numpy.
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from scipy.linalg import eigh

from edesign.core import Analysis, Model

LENGTH, EA, EI_Z, EI_Y, GJ = 4.0, 1e9, 3e6, 8e6, 1e6
STIFFNESSES = (EI_Z, EI_Y)


def critical_loads(ends: str, n: int, tilt: float = 0.0, turn: float = 0.3) -> np.ndarray:
    """Critical loads in rising order, from stiffnesses without and with a compression; K changes with it linearly.

    Args:
        ends: "free" or "pinned" at the top.
        tilt: of the column from the vertical, about x.
        turn: of its web.
    """
    m = Model(3)
    section = m.elastic_section(EA, EI_Z, EI_Y, GJ)
    axis = np.array([0.0, sin(tilt), cos(tilt)])
    side, other = np.array([1.0, 0.0, 0.0]), np.array([0.0, cos(tilt), -sin(tilt)])
    web = cos(turn) * side + sin(turn) * other
    nodes = [m.node(f"n{k}", *(axis * LENGTH * k / n)) for k in range(n + 1)]
    for k in range(n):
        m.beam_column(f"c{k}", nodes[k], nodes[k + 1], section, geometry="p_delta", web=tuple(web))
    held = ends == "free"
    m.fix(nodes[0], True, True, rz=True, uz=True, rx=held, ry=held)
    if ends == "pinned":  # of an upright column: its top is held sideways
        m.fix(nodes[-1], True, True)
    pattern = m.pattern()
    unit = 1e5
    m.nodal_load(pattern, nodes[-1], *(-unit * axis[:2]), fz=-unit * axis[2])
    a = Analysis(m)
    without = a.stiffness().toarray()
    assert a.static(pattern).status == "completed"
    softening = (without - a.stiffness().toarray()) / unit
    # K v = P S v; S has no full rank, so the reciprocal is what is solved for
    reciprocal = eigh(softening, without, eigvals_only=True)
    return 1.0 / reciprocal[reciprocal > 1e-9 / unit][::-1]


def strings(ends: str, n: int, EI: float) -> float:
    """Critical load of n beams with the stiffness of a string in compression, P / l, between their ends."""
    h = LENGTH / n
    to_chord = np.array([[1 / h, 1, -1 / h, 0], [1 / h, 0, -1 / h, 1]])  # rotations of both ends from the chord
    bends = to_chord.T @ (EI / h * np.array([[4, 2], [2, 4]])) @ to_chord
    softens = 1 / h * np.array([[1, 0, -1, 0], [0, 0, 0, 0], [-1, 0, 1, 0], [0, 0, 0, 0]])
    K, S = np.zeros((2 * n + 2, 2 * n + 2)), np.zeros((2 * n + 2, 2 * n + 2))
    for k in range(n):
        K[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += bends
        S[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += softens
    held = [0, 1] if ends == "free" else [0, 2 * n]
    free = [i for i in range(2 * n + 2) if i not in held]
    return float(1.0 / eigh(S[np.ix_(free, free)], K[np.ix_(free, free)], eigvals_only=True)[-1])


@pytest.mark.parametrize("n", [1, 2, 4, 8])
@pytest.mark.parametrize(("ends", "tilt"), [("free", 0.0), ("free", 0.9), ("pinned", 0.0)])
def test_both_planes_buckle_as_strings_of_beams(ends: str, tilt: float, n: int) -> None:
    """The lowest loads of the two planes among all: 1e-8, rounding of a stiffness of 1e9 N/m beside 1e6."""
    loads = critical_loads(ends, n, tilt)
    if ends == "pinned" and n == 1:
        assert loads.size == 0  # nothing between the ends moves
        return
    for EI in STIFFNESSES:
        assert np.min(np.abs(loads / strings(ends, n, EI) - 1.0)) < 1e-8
    assert loads[0] == pytest.approx(strings(ends, n, min(STIFFNESSES)), rel=1e-8)


def test_one_member_of_a_cantilever() -> None:
    """3 EI / L^2: the string's P / L against 3 EI / L^3."""
    np.testing.assert_allclose(critical_loads("free", 1), 3 * np.array(STIFFNESSES) / LENGTH**2, rtol=1e-9)


@pytest.mark.parametrize(("ends", "factor"), [("free", 0.25), ("pinned", 1.0)])
def test_convergence_to_euler(ends: str, factor: float) -> None:
    """Quadratic: a string misses the bow between the ends of a member."""
    for EI in STIFFNESSES:
        euler = factor * pi**2 * EI / LENGTH**2
        errors = []
        for n in (2, 4, 8, 16):
            loads = critical_loads(ends, n)
            errors.append(float(np.min(np.abs(loads / euler - 1.0))))
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        np.testing.assert_allclose(orders[1:], 2.0, atol=0.1)
        assert errors[2] < 0.02


@pytest.mark.parametrize("share", [0.99, 1.01])
def test_the_weaker_plane_limits_a_load(share: float) -> None:
    """Static steps end at the critical load of the weaker plane, which is named."""
    n = 4
    limit = strings("free", n, min(STIFFNESSES))
    m = Model(3)
    section = m.elastic_section(EA, EI_Z, EI_Y, GJ)
    nodes = [m.node(f"n{k}", 0.0, 0.0, LENGTH * k / n) for k in range(n + 1)]
    for k in range(n):  # the web along x: bending about local z, the weaker, moves along y
        m.beam_column(f"c{k}", nodes[k], nodes[k + 1], section, web=(1.0, 0.0, 0.0))
    m.fix(nodes[0], True, True, True, uz=True, rx=True, ry=True)
    pattern = m.pattern()
    m.nodal_load(pattern, nodes[-1], fz=-share * limit)
    r = Analysis(m).static(pattern)
    assert (r.status == "completed") == (share < 1.0)
    if share > 1.0:
        assert "n4.uy" in r.reason
