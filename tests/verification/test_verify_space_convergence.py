"""Orders of convergence in space: of histories with the time step, of members with points and with their number."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from verification.corner_building import FY, E, Placing, building, motions, node_channels, shaken

from edesign.core import Analysis, Bilinear, Channel, Elastic, MenegottoPinto, Model, Steel
from edesign.frame.sections.space_section import SpaceSection, space_section

LAWS: dict[str, Steel] = {
    "elastic": Elastic(E),
    "hardening": Bilinear(E, FY, 0.01),
    "curved": MenegottoPinto(E, FY, 0.01),
}
FINEST = 32


@pytest.mark.parametrize("law", list(LAWS))
def test_order_in_time(law: str) -> None:
    """Average acceleration is of second order under three components, with dampers, diaphragms and yielding.

    Root mean square of the roof's displacements against a step 32 times finer than 0.01 s. 0.2 about 2: fibres yield
    somewhere within their steps. The balance of the energies is below 1e-4 of the input from 2.5 ms on.
    """
    found = {}
    for parts in (1, 2, 4, FINEST):
        dt = 0.01 / parts
        built = building(Placing(0.4), LAWS[law], inside=False)
        r = shaken(built, motions(dt, 1.6, 9.0), dt, node_channels(built), "initial")
        found[parts] = np.array([r.values[f"u{node}.{d}"][::parts] for node in built.corners[2] for d in (0, 1)])
        if parts >= 4:
            assert np.abs(r.energy["residual"]).max() < 1e-4 * np.abs(r.energy["input"]).max()
            assert law == "elastic" or r.energy["hysteretic"][-1] > 0.02 * r.energy["input"][-1]
    errors = [np.sqrt(np.mean((found[parts] - found[FINEST]) ** 2)) for parts in (1, 2, 4)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 2.0, rtol=0, atol=0.2)


L = 3.0
HARDENING = 0.02
CURVE = 4.0  # R of Menegotto & Pinto, without the change that reversals make


def bilinear(strain: np.ndarray) -> np.ndarray:
    """Stress of a fibre that has not unloaded, Pa."""
    yielded = np.sign(strain) * (FY + HARDENING * (E * np.abs(strain) - FY))
    return np.where(np.abs(strain) * E <= FY, E * strain, yielded)


def curved(strain: np.ndarray) -> np.ndarray:
    """Menegotto & Pinto (1973): the first loading, Pa."""
    x = strain * E / FY
    return FY * (HARDENING * x + (1.0 - HARDENING) * x / (1.0 + np.abs(x) ** CURVE) ** (1.0 / CURVE))


CASES: dict[str, tuple[str, Callable[[np.ndarray], np.ndarray], Steel, float, tuple[float, float]]] = {
    "bilinear": ("HEB160", bilinear, Bilinear(E, FY, HARDENING), 0.2, (0.75, 0.5)),
    "curved": ("SHS140x10", curved, MenegottoPinto(E, FY, HARDENING, CURVE, 0.0), 0.0, (0.6, 0.6)),
}


def strains(section: SpaceSection, law: Callable[[np.ndarray], np.ndarray], forces: np.ndarray) -> np.ndarray:
    """e0, kappa_z, kappa_y under N, M_z, M_y, by Newton's method with tangents by differences."""
    across = np.stack([np.ones_like(section.y), -section.y, section.z])
    scale = FY * section.area.sum() * np.array([1.0, 0.1, 0.1])

    def missing(e: np.ndarray) -> np.ndarray:
        return forces - across @ (section.area * law(e @ across))

    found = np.array([forces[0] / (E * section.area.sum()), 0.0, 0.0])
    for _ in range(100):
        rest = missing(found)
        if (np.abs(rest) < 1e-10 * scale).all():
            return found
        fibres = found @ across
        tangent = (law(fibres + 1e-9) - law(fibres - 1e-9)) / 2e-9
        step, share = np.linalg.solve((across * (section.area * tangent)) @ across.T, rest), 1.0
        while share > 1e-3 and np.linalg.norm(missing(found + share * step) / scale) > np.linalg.norm(rest / scale):
            share *= 0.5
        found = found + share * step
    raise AssertionError(rest)


def tip(case: str) -> tuple[np.ndarray, Callable[[int, int], np.ndarray]]:
    """Displacements x and y of a cantilever under N and a skew force: by quadrature of 900 curvatures, and by members.

    The web is along x, so that local z is x and local y is -y.
    """
    name, law, steel, axial, shares = CASES[case]
    section = space_section(name)
    N = -axial * FY * float(section.area.sum())
    plastic = FY / L * np.array([section.area @ np.abs(section.z), section.area @ np.abs(section.y)])
    fx, fy = (shares * plastic).tolist()
    gauss, weights = np.polynomial.legendre.leggauss(3)
    pieces = (np.arange(300)[:, None] + 0.5 * (gauss + 1.0)) * L / 300
    exact = np.zeros(2)
    for x, weight in zip(pieces.ravel(), np.tile(0.5 * weights * L / 300, 300), strict=True):
        _, kappa_z, kappa_y = strains(section, law, np.array([N, -fy * (L - x), -fx * (L - x)]))
        exact += weight * (L - x) * np.array([-kappa_y, -kappa_z])

    def members(points: int, count: int) -> np.ndarray:
        model = Model(3)
        number = model.fibre_section(section.y, section.area, model.material(steel), z=section.z, GJ=1e5)
        nodes = [model.node(f"n{k}", 0.0, 0.0, L * k / count) for k in range(count + 1)]
        model.fix(nodes[0], True, True, True, uz=True, rx=True, ry=True)
        for k in range(count):
            model.beam_column(f"m{k}", nodes[k], nodes[k + 1], number, points, "linear", web=(1.0, 0.0, 0.0))
        vertical, skew = model.pattern(), model.pattern()
        model.nodal_load(vertical, nodes[-1], fz=N)
        model.nodal_load(skew, nodes[-1], fx, fy)
        analysis = Analysis(model, tolerance=1e-11, element_tolerance=1e-24)
        analysis.static(vertical)
        channels = [Channel(f"u{d}", ((1.0, "displacement", nodes[-1], d),)) for d in (0, 1)]
        r = analysis.static(skew, 1.0, 40, channels)
        assert r.status == "completed", r.reason
        return np.array([r.final["u0"], r.final["u1"]])

    return exact, members


def test_points_where_curvatures_are_smooth() -> None:
    """Steel that yields gradually: each further point of Gauss & Lobatto leaves a quarter of the error or less.

    The integrand has all derivatives; 3 to 8 points go from 9 % to 6e-6.
    """
    exact, members = tip("curved")
    errors = [np.abs(members(points, 1) / exact - 1.0).max() for points in range(3, 9)]
    assert (np.divide(errors[1:], errors[:-1]) < 0.25).all()
    assert errors[-1] < 1e-5


@pytest.mark.parametrize(("points", "order"), [(3, 4.0), (4, 6.0)])
def test_members_where_curvatures_are_smooth(points: int, order: float) -> None:
    """n points are exact up to degree 2 n - 3: an order of 2 n - 2 in the length of members.

    A tenth of it about the order of the last halving: it is that of short members.
    """
    exact, members = tip("curved")
    long, short = (np.abs(members(points, count) / exact - 1.0).max() for count in (8, 16))
    assert np.log2(long / short) == pytest.approx(order, rel=0.1)


def test_points_where_fibres_begin_to_yield() -> None:
    """Bilinear steel under N and a skew force: 2 % with 5 points, as by default, and 4e-4 with 10.

    Kinks of the curvature stand anywhere between points, so that the error has no steady order: bounds are half as much
    again as was seen. 16 members of 5 points come to 2.4e-4, 1e-5 of which is left by the quadrature.
    """
    exact, members = tip("bilinear")
    for points, count, bound in ((5, 1, 0.03), (8, 1, 4e-3), (10, 1, 6e-4), (5, 16, 4e-4)):
        assert np.abs(members(points, count) / exact - 1.0).max() < bound
