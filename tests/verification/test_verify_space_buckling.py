"""Critical load factors of frames in space: Euler's columns, sway, springs, shear, strings; what a coarse mesh errs."""

from __future__ import annotations

from math import inf, pi

import numpy as np
import pytest
from scipy.optimize import brentq
from verification.space_frames import HINGES, RIGID, SECTION, E, Frame, G, building

from edesign.core import CoreError

H = 4.0
EI = E * SECTION["I_z"]  # the weaker plane


def column(foot: str, head: str, parts: int, ends: tuple[float, ...] = RIGID, **section: float) -> float:
    """Critical force of a column of `parts` members; springs at its ends."""
    f = Frame()
    a, b = f.node(0, 0, 0, fixed=foot), f.node(0, 0, H, fixed=head)
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
    """Critical forces from above, with an error of the fourth order in the length of n parts.

    The cubic shape of a part misses (k l)^4 / 720 of the energy of a wave sin(k x), k^2 = P / EI, to the leading order.
    """
    foot, head, factor = EULER[name]
    exact = factor * EI / H**2
    errors = np.array([column(foot, head, parts) / exact - 1.0 for parts in (4, 8, 16)])
    assert np.all(errors > 0.0)
    assert np.all(errors <= factor**2 / 720 / np.array([4, 8, 16]) ** 4 * 1.2)
    np.testing.assert_allclose(errors[:2] / errors[1:], 16.0, rtol=0.1)


def test_coarse_columns() -> None:
    """One member between hinges: 12 / pi^2, by 21.6 % too much; two: 0.75 %; one cantilever: 0.75 %."""
    foot, head, factor = EULER["hinges"]
    exact = factor * EI / H**2
    assert column(foot, head, 1) / exact == pytest.approx(12 / pi**2, rel=1e-9)
    assert column(foot, head, 2) / exact == pytest.approx(1.0075, abs=1e-4)
    assert column("all", "", 1) / (exact / 4) == pytest.approx(1.0075, abs=1e-4)


@pytest.mark.parametrize("k", [0.3, 3.0, 30.0])
def test_cantilever_on_a_spring(k: float) -> None:
    """u tan u = k h / EI. A spring between node and member does what one below the node does."""
    u = brentq(lambda u: u * np.sin(u) - k * np.cos(u), 1e-6, pi / 2)
    exact = u**2 * EI / H**2
    spring = k * EI / H
    assert column("all", "", 8, ends=(1e3 * spring, spring, inf, inf)) == pytest.approx(
        exact, rel=1e-5
    )  # 8 parts: 1e-6


def test_hinges_of_the_member() -> None:
    """Hinges of the member between held nodes do what nodes that may turn do."""
    exact = pi**2 * EI / H**2
    assert column("all", "ux uy rx ry rz", 8, ends=HINGES) == pytest.approx(
        exact, rel=1e-4
    )  # 8 parts: pi^4 / 720 / 8^4


def test_shear_flexible_column() -> None:
    """Engesser: P_E / (1 + P_E / (G A_s)), from above; the axial force acts along the slope of the axis.

    Shear is constant along a member: an error of the second order, at most (pi / n)^2 / 12 of a half wave in n steps.
    """
    A_s = 2e-5  # G A_s is a ninth of P_E, so that shear decides
    euler = pi**2 * EI / H**2
    foot, head, _ = EULER["hinges"]
    exact = euler / (1 + euler / (G * A_s))
    errors = np.array([column(foot, head, parts, A_y=A_s, A_z=A_s, I_y=1.0) / exact - 1.0 for parts in (8, 16, 32)])
    assert np.all(errors > 0.0)
    assert np.all(errors <= (pi / np.array([8, 16, 32])) ** 2 / 12)
    np.testing.assert_allclose(errors[:2] / errors[1:], 4.0, rtol=0.05)


@pytest.mark.parametrize(("fixed", "ratio"), [(True, 1.0), (True, 5.0), (False, 1.0), (False, 0.2)])
def test_sway_portal(fixed: bool, ratio: float) -> None:
    """Fixed feet: u cot u = -6 k; hinged: u tan u = 6 k; k = I_b h / (I_c L).

    One member a column errs most where no end turns: 10 for pi^2, 1.32 %; six at most (u / 6)^4 / 720.
    """
    span = 6.0
    k = ratio * H / span
    if fixed:
        u = brentq(lambda u: u * np.cos(u) + 6 * k * np.sin(u), pi / 2, pi - 1e-9)
    else:
        u = brentq(lambda u: u * np.sin(u) - 6 * k * np.cos(u), 1e-6, pi / 2)
    exact = u**2 * E * SECTION["I_y"] / H**2
    for parts, tolerance in ((1, 1.33e-2), (6, (u / 6) ** 4 / 720)):
        f = Frame()
        feet = [f.node(x, 0, 0, fixed="all" if fixed else "ux uy uz rx rz") for x in (0.0, span)]
        tops = [f.node(x, 0, H, fixed="uy rx rz") for x in (0.0, span)]
        for a, b in zip(feet, tops, strict=True):
            f.line(a, b, parts, fixed="uy rx rz", A=10.0)
        f.member(*tops, I_y=ratio * SECTION["I_y"], A=10.0)
        axial = -np.ones(len(f.rows))
        axial[-1] = 0.0
        found = f.model().critical_factor(axial)
        assert 0.0 <= found / exact - 1.0 + 1e-5 <= tolerance + 1e-5  # 1e-5: lengths give a little


def test_bar_is_a_string() -> None:
    """A rigid bar on a hinge, held aside by a spring at its top: P = k h."""
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
    # the column as one member, its consistent K_G over u and r by hand, and the strings' 3 P / h; nothing turns in plan
    K = EI / H**3 * np.array([[12, -6 * H], [-6 * H, 4 * H**2]])
    K_G = -2e4 / (30 * H) * np.array([[36 + 90, -3 * H], [-3 * H, 4 * H**2]])
    eigenvalues = np.linalg.eigvals(np.linalg.solve(K, -K_G))
    assert together == pytest.approx(1.0 / np.max(eigenvalues.real), rel=1e-7)


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
