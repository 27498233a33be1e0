"""Critical load factors of frames in space: Euler's columns, sway, springs, shear, strings, leaning columns."""

from __future__ import annotations

from math import inf, pi

import numpy as np
import pytest
from scipy.optimize import brentq
from verification.space_frames import HINGES, RIGID, SECTION, E, Frame, G, building

from edesign.core import CoreError

H = 4.0
EI = E * SECTION["I_z"]  # the weaker plane


def column(base: str, head: str, parts: int, ends: tuple[float, ...] = RIGID, **section: float) -> float:
    """Critical force of a column of `parts` members; springs at its ends."""
    f = Frame()
    a, b = f.node(0, 0, 0, fixed=base), f.node(0, 0, H, fixed=head)
    chain = f.line(a, b, parts, **section)
    f.rows[chain[0]]["ends"] = (*ends[:2], *((inf, inf) if parts > 1 else ends[2:]))
    if parts > 1:
        f.rows[chain[-1]]["ends"] = (inf, inf, *ends[2:])
    return f.model().critical_factor(-np.ones(len(f.rows)))


EULER = {
    "cantilever": ("all", "", pi**2 / 4),
    "hinges": ("ux uy uz rz", "ux uy rz", pi**2),
    "fixed, hinge": ("all", "ux uy rz", 4.493409457909064**2),
    "fixed, fixed": ("all", "ux uy rx ry rz", 4 * pi**2),
    "fixed, guided": ("all", "rx ry rz", pi**2),
}


@pytest.mark.parametrize("name", EULER)
def test_euler(name: str) -> None:
    """Critical forces from above, of one member each; two are better by some orders.

    The bows of a member have polynomials to the sixth degree in the slope. Fixed ends ask most of them: Rayleigh's
    quotient of the best polynomial is 5.9e-4 too large there, 1.1e-5 with one hinge, below 5e-7 elsewhere.
    """
    base, head, factor = EULER[name]
    exact = factor * EI / H**2
    most = {"fixed, fixed": 6e-4, "fixed, hinge": 1.1e-5}.get(name, 5e-7)
    assert 0.0 <= column(base, head, 1) / exact - 1.0 <= most
    assert abs(column(base, head, 2) / exact - 1.0) <= 5e-9


@pytest.mark.parametrize("k", [0.3, 3.0, 30.0])
def test_cantilever_on_a_spring(k: float) -> None:
    """u tan u = k h / EI. A spring between node and member does what one below the node does."""
    u = brentq(lambda u: u * np.sin(u) - k * np.cos(u), 1e-6, pi / 2)
    exact = u**2 * EI / H**2
    spring = k * EI / H
    found = column("all", "", 1, ends=(1e3 * spring, spring, inf, inf))
    assert found == pytest.approx(exact, rel=1e-9)  # a quarter wave in polynomials of the sixth degree


def test_hinges_of_the_member() -> None:
    """Hinges of the member between fixed nodes do what nodes that may turn do."""
    exact = pi**2 * EI / H**2
    assert column("all", "ux uy rx ry rz", 1, ends=HINGES) == pytest.approx(exact, rel=5e-7)  # as in test_euler


@pytest.mark.parametrize(("name", "share"), [("hinges", 9.0), ("hinges", 0.05), ("cantilever", 0.5)])
def test_shear_flexible_column(name: str, share: float) -> None:
    """Engesser: P_E / (1 + P_E / (G A_s)), of one member; the axial force acts along the slope of the axis.

    `share`: P_E / (G A_s). Polynomials as in test_euler: 3e-6 is the largest error over all shares from 0 to 10.
    """
    base, head, factor = EULER[name]
    euler = factor * EI / H**2
    A_s = euler / share / G
    assert column(base, head, 1, A_y=A_s, A_z=A_s, I_y=1.0) == pytest.approx(euler / (1.0 + share), rel=3e-6)


@pytest.mark.parametrize(("fixed", "ratio"), [(True, 1.0), (True, 5.0), (False, 1.0), (False, 0.2)])
def test_sway_portal(fixed: bool, ratio: float) -> None:
    """Fixed bases: u cot u = -6 k; hinged: u tan u = 6 k; k = I_b h / (I_c L).

    Polynomials as in test_euler; lengths give by 1e-5.
    """
    span = 6.0
    k = ratio * H / span
    if fixed:
        u = brentq(lambda u: u * np.cos(u) + 6 * k * np.sin(u), pi / 2, pi - 1e-9)
    else:
        u = brentq(lambda u: u * np.sin(u) - 6 * k * np.cos(u), 1e-6, pi / 2)
    exact = u**2 * E * SECTION["I_y"] / H**2
    f = Frame()
    bases = [f.node(x, 0, 0, fixed="all" if fixed else "ux uy uz rx rz") for x in (0.0, span)]
    tops = [f.node(x, 0, H, fixed="uy rx rz") for x in (0.0, span)]
    for a, b in zip(bases, tops, strict=True):
        f.member(a, b, A=10.0, I_z=100.0 * SECTION["I_z"])  # the plane of the portal decides
    f.member(*tops, I_y=ratio * SECTION["I_y"], A=10.0)
    assert f.model().critical_factor([-1.0, -1.0, 0.0]) == pytest.approx(exact, rel=1.1e-5)


def test_bar_is_a_string() -> None:
    """A rigid bar on a hinge, restrained by a spring at its top: P = k h."""
    k = 3e5
    f = Frame()
    f.member(f.node(0, 0, 0, fixed="all"), f.node(0, 0, H, springs=(k, 2 * k, 0, 0, 0, 0)), axial_only=True)
    assert f.model().critical_factor([-1.0]) == pytest.approx(k * H, rel=1e-10)


def test_leaning_columns() -> None:
    """Bars below a diaphragm lean on one cantilever: the sum of forces counts; 20 kN on it, 60 kN on three bars."""
    f = Frame(masters=[(0.0, 0.0)])
    f.member(f.node(0, 0, 0, fixed="all"), f.node(0, 0, H, floor=0), I_t=1e4)
    for x, y in ((5.0, 0.0), (0.0, 5.0), (5.0, 5.0)):
        f.member(f.node(x, y, 0, fixed="all"), f.node(x, y, H, floor=0), axial_only=True)
    together = f.model().critical_factor(-2e4 * np.ones(4))
    # P = 2e4 on the cantilever, Q = 6e4 on the bars: tan u / u = 1 + P / Q (LeMessurier 1977); nothing turns in plan
    u = brentq(lambda u: np.tan(u) - u * (1.0 + 2.0 / 6.0), 1e-6, pi / 2 - 1e-9)
    assert together == pytest.approx(u**2 * EI / H**2 / 2e4, rel=1e-7)


@pytest.mark.parametrize(("bases", "K"), [("all", 1.16), ("ux uy uz rx rz", 2.33)])
def test_published_buckling_lengths(bases: str, K: float) -> None:
    """Square portals with members of one section that sway: K = 1.16 on fixed bases, 2.33 on hinges, as printed.

    Source: Chen & Lui, Structural Stability (1987), chapter 4: P_cr = 7.38 EI / h^2 and 1.82 EI / h^2.
    """
    f = Frame()
    tops = [f.node(x, 0, H, fixed="uy rx rz") for x in (0.0, H)]
    for x, top in zip((0.0, H), tops, strict=True):
        f.member(f.node(x, 0, 0, fixed=bases), top, A=10.0, I_z=100.0 * SECTION["I_z"])
    f.member(*tops, A=10.0)
    found = pi * np.sqrt(E * SECTION["I_y"] / f.model().critical_factor([-1.0, -1.0, 0.0])) / H
    assert found == pytest.approx(K, abs=0.005)  # the digits printed


def test_tension_does_not_buckle() -> None:
    """Tension alone gives no factor; where tension outweighs, only positive factors count."""
    f = building(21)
    model = f.model()
    axial = np.random.default_rng(3).uniform(1e3, 1e5, len(f.rows))
    assert model.critical_factor(axial) == inf
    assert model.critical_factor(np.zeros(len(f.rows))) == inf
    axial[0] = -1e6
    assert 0.0 < model.critical_factor(axial) < inf
    with pytest.raises(CoreError, match="member M2: its axial force is not a finite number"):
        axial[2] = np.nan
        model.critical_factor(axial)


def test_factor_scales_and_leaves_the_model_as_it_was() -> None:
    """Twice the forces, half the factor; static results afterwards are those before."""
    f = building(22, storeys=3)
    model = f.model()
    axial = np.random.default_rng(4).normal(-1e5, 5e4, len(f.rows))
    nodal = np.random.default_rng(5).normal(0, 1e4, (1, len(f.nodes), 6))
    before = model.static(nodal).displacements
    assert model.critical_factor(2 * axial) == pytest.approx(0.5 * model.critical_factor(axial), rel=1e-9)
    np.testing.assert_allclose(model.static(nodal).displacements, before, rtol=1e-12, atol=1e-15)
