"""Gauss-Lobatto integration in the force-based member: n points are exact for polynomials of degree 2n - 3, no higher.

The flexibility 1/EI of the sections follows (x/L)^d at the points; the tip of a cantilever under a tip force then
moves by P integral (L - x)^2 / EI dx: a polynomial of degree d + 2.
"""

from __future__ import annotations

from math import factorial

import numpy as np
import pytest
from numpy.polynomial import Legendre
from verification.structures import E, Structure, channel, final, i_layers

from edesign.core import Analysis, Elastic, Model

L, P, EA, EI = 3.0, 10e3, 1e9, 4e7


def lobatto(n: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights on 0..1 from the roots of P'_{n-1} (Abramowitz & Stegun 25.4.32)."""
    p = Legendre.basis(n - 1)
    x = np.concatenate([[-1.0], np.sort(p.deriv().roots().real), [1.0]]) if n > 2 else np.array([-1.0, 1.0])
    return 0.5 * (1 + x), 1.0 / (n * (n - 1) * p(x) ** 2)


def tip(n: int, degree: int) -> float:
    """Deflection of the tapered cantilever over P L^3 / EI. 1/EI = (0.1 + (x/L)^degree) / EI: positive everywhere."""
    m = Model()
    x, _ = lobatto(n)
    sections = [m.elastic_section(EA, EI / (0.1 + v**degree)) for v in x]
    i, j = m.node("i", 0, 0), m.node("j", L, 0)
    m.fix(i, True, True, True)
    e = m.beam_column("e", i, j, sections, points=n, geometry="linear")
    g = m.pattern()
    m.nodal_load(g, j, fy=P)
    return final(Structure(m, [i, j], [e], g), [channel("displacement", j, 1, "u")], tolerance=1e-12)["u"] / (
        P * L**3 / EI
    )


def exact(degree: int) -> float:
    """Integral over 0..1 of (0.1 + x^d)(1 - x)^2."""
    return 0.1 / 3 + 1 / (degree + 1) - 2 / (degree + 2) + 1 / (degree + 3)


@pytest.mark.parametrize("n", range(3, 11))
def test_exact_up_to_the_degree(n: int) -> None:
    for degree in range(1, 2 * n - 4):
        assert tip(n, degree) == pytest.approx(exact(degree), rel=1e-10)


@pytest.mark.parametrize("n", range(3, 11))
def test_error_beyond_the_degree(n: int) -> None:
    """The first polynomial that is not exact has the classical error (Abramowitz & Stegun 25.4.32), on an interval of 1

    -n (n-1)^3 [(n-2)!]^4 / ((2n-1) [(2n-2)!]^3) f^(2n-2), with f = x^d (1 - x)^2 and d + 2 = 2n - 2.
    """
    degree = 2 * n - 4
    leading = factorial(2 * n - 2)  # the derivative of x^(2n-2)
    error = n * (n - 1) ** 3 * factorial(n - 2) ** 4 / ((2 * n - 1) * factorial(2 * n - 2) ** 3) * leading
    assert tip(n, degree) - exact(degree) == pytest.approx(error, rel=1e-4, abs=1e-13)
    assert error > 0.0


def test_two_points() -> None:
    """The trapezoid: (1 - x)^2 / EI is 1 at x = 0 and 0 at x = 1."""
    assert tip(2, 1) == pytest.approx(0.5 * 0.1, rel=1e-10)


@pytest.mark.parametrize("n", range(2, 11))
def test_points_and_weights(n: int) -> None:
    """Where the sections lie, from their moments under a tip force; how they weigh, from a soft section at one of
    them."""
    x, w = lobatto(n)
    m = Model()
    section = m.elastic_section(EA, EI)
    nodes, elements, g = [], [], m.pattern()
    for k in range(n + 1):
        i, j = m.node(f"i{k}", 0, k), m.node(f"j{k}", L, k)
        m.fix(i, True, True, True)
        soft = m.elastic_section(EA, EI / 2.0)
        elements.append(
            m.beam_column(f"e{k}", i, j, [soft if p == k else section for p in range(n)], points=n, geometry="linear")
        )
        m.nodal_load(g, j, mz=P)
        nodes.append(j)
    got = final(
        Structure(m, nodes, elements, g),
        [channel("displacement", j, 2, f"r{k}") for k, j in enumerate(nodes)],
        tolerance=1e-12,
    )
    for k in range(n):  # a constant moment: rotation M L (1 + w_k) / EI
        assert got[f"r{k}"] / (P * L / EI) == pytest.approx(1.0 + w[k], rel=1e-10)
    assert got[f"r{n}"] / (P * L / EI) == pytest.approx(1.0, rel=1e-12)

    m = Model()
    section = m.fibre_section(*i_layers(4, 16), m.material(Elastic(E)))
    i, j = m.node("i", 0, 0), m.node("j", L, 0)
    m.fix(i, True, True, True)
    e = m.beam_column("e", i, j, section, points=n, geometry="linear")
    g = m.pattern()
    m.nodal_load(g, j, fy=P)
    got = final(Structure(m, [i, j], [e], g), [channel("section_force", e, 2 * p + 1, str(p)) for p in range(n)])
    for p in range(n):
        assert got[str(p)] == pytest.approx(P * L * (1 - x[p]), abs=1e-9 * P * L)


@pytest.mark.parametrize("points", range(2, 11))
def test_uniform_load_integral(points: int) -> None:
    """Rotation at the support, w L^3 / 24EI: a cubic, exact from three points on; two points see no moment at all."""
    m = Model()
    section = m.fibre_section(*i_layers(4, 16), m.material(Elastic(E)))
    i, j = m.node("i", 0, 0), m.node("j", L, 0)
    m.fix(i, True, True, False)
    m.fix(j, False, True, False)
    e = m.beam_column("e", i, j, section, points=points, geometry="linear")
    g = m.pattern()
    m.uniform_load(g, e, transverse=-P)
    got = final(Structure(m, [i, j], [e], g), [channel("displacement", i, 2, "r")])
    y, area = i_layers(4, 16)
    expected = -P * L**3 / (24 * E * float(area @ y**2))
    if points == 2:
        assert abs(got["r"]) < 1e-12 * abs(expected)
    else:
        assert got["r"] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("points", range(3, 11))
def test_one_member_is_exact_when_elastic(points: int) -> None:
    """The force-based stiffness of a prismatic member equals the closed form of the elastic one."""
    y, area = i_layers(4, 16)
    matrices = []
    for kind in range(2):
        m = Model()
        section = (
            m.fibre_section(y, area, m.material(Elastic(E)))
            if kind
            else m.elastic_section(E * float(area.sum()), E * float(area @ y**2))
        )
        i, j = m.node("i", 0, 0), m.node("j", 3.0, 1.0)
        m.fix(i, True, True, True)
        m.beam_column("e", i, j, section, points=points)
        matrices.append(Analysis(m).stiffness().toarray())
    np.testing.assert_allclose(matrices[1], matrices[0], rtol=1e-11, atol=1e-12 * matrices[0].max())
