"""Footings: rigid punches, plane waves, one mass on springs and dashpots in closed form."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from verification.footing_mast import mast
from verification.structures import channel

from edesign.frame.footing_impedance import (
    LARGEST_PSI,
    WAYS,
    Block,
    dynamic_modifiers,
    embedment_gazetas,
    radiation_damping,
    static_stiffness,
)
from edesign.frame.footings import footing_springs
from edesign.study.analysis.footings import interaction
from edesign.study.analysis.structure import make_structure

G, NU = 30e6, 0.3


def block(length: float, width: float, embedment: float = 0.0, poisson: float = NU) -> Block:
    return Block(0.5 * length, 0.5 * width, embedment, embedment, G, poisson)


def punch(r: float, n: int) -> np.ndarray:
    """Stiffness z, xx, yy of a smooth rigid punch with half sides r and 1: n cells across, Boussinesq's solution."""
    x, y = (
        side.ravel()
        for side in np.meshgrid(
            (np.arange(round(r * n)) + 0.5) * 2.0 / n - r, (np.arange(n) + 0.5) * 2.0 / n - 1.0, indexing="ij"
        )
    )

    def corner(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return a * np.arcsinh(b / np.abs(a)) + b * np.arcsinh(a / np.abs(b))

    dx, dy, h = x[:, None] - x, y[:, None] - y, 1.0 / n
    potential = (
        corner(dx + h, dy + h) - corner(dx - h, dy + h) - corner(dx + h, dy - h) + corner(dx - h, dy - h)
    )  # integral of 1 / distance over a cell
    pressure = np.linalg.solve((1.0 - NU) / (2.0 * pi * G) * potential, np.stack([np.ones_like(x), y, x], axis=1))
    area = 4.0 * h * h
    return area * np.array([pressure[:, 0].sum(), pressure[:, 1] @ y, pressure[:, 2] @ x])


@pytest.mark.parametrize("r", [1.0, 2.0, 4.0])
def test_static_stiffness_is_that_of_a_rigid_punch(r: float) -> None:
    """Vertical and rocking stiffness of Boussinesq's half-space, extrapolated from two grids: the singular pressure at
    the edge makes the error linear in the size of cells. The formulas are fits, to some per cent; those of Gazetas in
    rocking are 8 to 14 % softer."""
    exact = 2.0 * punch(r, 16) - punch(r, 8)
    if r == 1.0:
        # the charge of a square plate at unit potential is 0.36679 of its side (Hwang & Mascagni 2004)
        assert exact[0] == pytest.approx(2.0 * pi * G / (1.0 - NU) * 0.36679 * 2.0, rel=2e-3)
    for formula, tolerances in {"pais_kausel": (0.025, 0.04, 0.04), "gazetas": (0.015, 0.14, 0.11)}.items():
        found = static_stiffness(block(2.0 * r, 2.0), formula)
        for way, value, tolerance in zip(("z", "xx", "yy"), exact, tolerances, strict=True):
            assert found[way] == pytest.approx(value, rel=tolerance), (formula, way)


def twisted(n: int) -> float:
    """Torsional stiffness of a rigid square of half side 1 on a half-space: n cells across, Cerruti's solution.

    Each cell carries a uniform shear in both directions; a cell moves its own middle by integrals in closed form, and
    others as if its force stood in its middle.
    """
    x, y = (side.ravel() for side in np.meshgrid(*[(np.arange(n) + 0.5) * 2.0 / n - 1.0] * 2, indexing="ij"))
    dx, dy, area = x[:, None] - x, y[:, None] - y, 4.0 / n**2
    r = np.hypot(dx, dy) + np.eye(n * n)
    own = 4.0 / n * np.arcsinh(1.0) * 2.0  # integral of 1 / r over a square of side 2 / n about its middle
    over_r, along, across, mixed = area / r, area * dx**2 / r**3, area * dy**2 / r**3, area * dx * dy / r**3
    np.fill_diagonal(over_r, own)
    np.fill_diagonal(along, 0.5 * own)
    np.fill_diagonal(across, 0.5 * own)
    flexibility = np.block(
        [[(1.0 - NU) * over_r + NU * along, NU * mixed], [NU * mixed, (1.0 - NU) * over_r + NU * across]]
    ) / (2.0 * pi * G)
    shear = np.linalg.solve(flexibility, np.concatenate([-y, x]))
    return area * float(np.concatenate([-y, x]) @ shear)


def test_torsional_stiffness_is_that_of_a_rigid_square() -> None:
    """Square, extrapolated from two grids as above; the fits are within 4 %. Discs, 16/3 G R^3
    (Reissner & Sagoci 1944), inside and outside of it are softer and stiffer."""
    exact = 2.0 * twisted(24) - twisted(12)
    for formula in ("pais_kausel", "gazetas"):
        assert static_stiffness(block(2.0, 2.0), formula)["zz"] == pytest.approx(exact, rel=0.04)
    assert 16.0 / 3.0 * G < exact < 16.0 / 3.0 * G * 2.0**1.5


def test_pais_and_kausel_with_whole_sides() -> None:
    """ASCE/SEI 41-17, Figure 8-2, at the surface: the same with other constants, rounded to two digits."""
    L, B = 3.6, 2.2
    surface = {
        "x": G * B / (2.0 - NU) * (3.4 * (L / B) ** 0.65 + 1.2),
        "y": G * B / (2.0 - NU) * (3.4 * (L / B) ** 0.65 + 0.4 * L / B + 0.8),
        "z": G * B / (1.0 - NU) * (1.55 * (L / B) ** 0.75 + 0.8),
        "xx": G * B**3 / (1.0 - NU) * (0.4 * L / B + 0.1),
        "yy": G * B**3 / (1.0 - NU) * (0.47 * (L / B) ** 2.4 + 0.034),
        "zz": G * B**3 * (0.53 * (L / B) ** 2.45 + 0.51),
    }
    assert static_stiffness(block(L, B), "pais_kausel") == pytest.approx(surface, rel=0.01)


def test_embedment_by_gazetas_with_whole_sides() -> None:
    """Gazetas' factors as programs with whole sides print them: constants with powers of two in them, rounded."""
    L, B, D, d = 3.6, 2.2, 1.5, 0.8
    h = D - 0.5 * d
    across = (1.0 + 0.21 * sqrt(D / B)) * (1.0 + 1.6 * (h * d * (B + L) / (B * L**2)) ** 0.4)
    factors = {
        "x": across,
        "y": across,
        "z": (1.0 + 2.0 / 21.0 * D / B * (1.0 + 1.3 * B / L)) * (1.0 + 0.32 * (d * (B + L) / (B * L)) ** (2.0 / 3.0)),
        "xx": 1.0 + 2.5 * d / B * (1.0 + 2.0 * d / B * (d / D) ** -0.2 * sqrt(B / L)),
        "yy": 1.0 + 1.4 * (d / L) ** 0.6 * (1.5 + 3.7 * (d / L) ** 1.9 * (d / D) ** -0.6),
        "zz": 1.0 + 2.6 * (1.0 + B / L) * (d / B) ** 0.9,
    }
    assert embedment_gazetas(Block(0.5 * L, 0.5 * B, D, d, G, NU)) == pytest.approx(factors, rel=0.01)


@pytest.mark.parametrize("embedment", [0.0, 1.4])
@pytest.mark.parametrize("poisson", [0.3, 0.5])
def test_high_frequencies_radiate_plane_waves(embedment: float, poisson: float) -> None:
    """Each face sends rho V_p or rho V_s times its velocity: the limit of dashpots, from areas and their moments."""
    L, B, D, rho = 1.8, 1.1, embedment, 1900.0
    of = Block(L, B, D, D, G, poisson)
    V_s = sqrt(G / rho)
    V_p = V_s * (LARGEST_PSI if poisson == 0.5 else sqrt(2.0 * (1.0 - poisson) / (1.0 - 2.0 * poisson)))
    omega = 1e6
    stiffness, a_0 = static_stiffness(of, "pais_kausel"), omega * B / V_s
    beta, alpha = radiation_damping(of, stiffness, a_0), dynamic_modifiers(of.slenderness, a_0)
    base, ends, sides = 4.0 * L * B, 4.0 * B * D, 4.0 * L * D  # pairs of walls across x, and across y
    exact = {
        "x": rho * (V_s * (base + sides) + V_p * ends),
        "y": rho * (V_s * (base + ends) + V_p * sides),
        "z": rho * (V_p * base + V_s * (ends + sides)),
        # sides: pressed horizontally over their height, sheared vertically at the arm B; ends: sheared about x
        "xx": rho * (V_p * (base * B**2 + sides * D**2) / 3.0 + V_s * (sides * B**2 + ends * (B**2 + D**2) / 3.0)),
        "yy": rho * (V_p * (base * L**2 + ends * D**2) / 3.0 + V_s * (ends * L**2 + sides * (L**2 + D**2) / 3.0)),
        # each wall is sheared at its distance from the axis, and pressed at places along it
        "zz": rho * V_s * (base * (L**2 + B**2) / 3.0 + ends * L**2 + sides * B**2)
        + rho * V_p * (ends * B**2 + sides * L**2) / 3.0,
    }
    for way in WAYS:
        dashpot = 2.0 * alpha[way] * stiffness[way] * beta[way] / omega
        assert dashpot == pytest.approx(exact[way], rel=1e-6), way


def test_a_square_footing_has_no_long_side() -> None:
    found = static_stiffness(block(2.0, 2.0, 0.7), "pais_kausel")
    ratios = radiation_damping(block(2.0, 2.0, 0.7), found, 0.8)
    assert found["x"] == pytest.approx(found["y"], rel=1e-12) and found["xx"] == pytest.approx(found["yy"], rel=1e-12)
    assert ratios["x"] == pytest.approx(ratios["y"], rel=1e-12)
    assert ratios["xx"] == pytest.approx(ratios["yy"], rel=1e-12)


@pytest.mark.parametrize("turned", [False, True])
def test_one_mass_on_a_footing(turned: bool) -> None:
    """Period and damping of a mass m on a cantilever h on a footing, along and across its longer side.

    1 / k_total = 1 / k + 1 / K_x + h^2 / K_rr (Veletsos & Meek 1974). With dashpots lambda solves m lambda^2 = -k_total
    of the complex K + lambda c. The period that the footing is taken at is its own.
    """
    project, m, h, k = mast(6.0, 2.4, 4.0, 0.3, embedment=0.9, damping=0.04, turned=turned)
    structure = make_structure(project)
    modes = structure.modes(1)
    found = interaction(project, structure, modes, gravity=False)
    of = structure.frame.footings["A0"].springs
    assert of.period == pytest.approx(found.flexible, rel=1e-9)
    (K_x, _, K_r), (c_x, _, c_r) = of.stiffness, of.dashpot
    ratio = sqrt(1.0 + k / K_x + k * h**2 / K_r)
    assert found.flexible / found.fixed == pytest.approx(ratio, rel=1e-9)
    assert found.closed_period_ratio == pytest.approx(ratio, rel=1e-9)
    value = 2j * pi / found.flexible
    for _ in range(200):  # fixed point: damping is light
        value = 1j * np.sqrt(1.0 / m / (1.0 / k + 1.0 / (K_x + value * c_x) + h**2 / (K_r + value * c_r)))
    assert found.damping == pytest.approx(-value.real / abs(value), rel=1e-8)
    shares = ((of.damping[0], m / K_x), (of.damping[2], m * h**2 / K_r))
    nist = sum(beta * 4.0 * pi**2 * flexibility / found.flexible**2 for beta, flexibility in shares)
    assert found.closed_damping == pytest.approx(nist, rel=1e-8)
    assert found.damping == pytest.approx(nist, rel=0.15)  # second order in ratios of 0.1 to 0.2


def test_free_vibration_decays_as_the_complex_eigenvalue_says() -> None:
    """Peaks of the mass after a push, over 20 periods; the period is divided so finely that Newmark's own is exact to
    (2 pi / 400)^2 / 12."""
    project, _, _, _ = mast(6.0, 2.4, 4.0, 0.3, damping=0.04)
    structure = make_structure(project)
    found = interaction(project, structure, structure.modes(1), gravity=False)
    analysis, frame = structure.analysis, structure.frame
    structure.install_dampers()
    dt, n = found.flexible / 400.0, 6000
    pulse = np.zeros(n)
    pulse[:100] = 1.0
    response = analysis.history(pulse, dt, channels=[channel("displacement", frame.nodes["A1"], name="u")])
    assert response.status == "completed", response.reason
    u = np.abs(response.values["u"][200:])
    peaks = [u[i] for i in range(1, u.size - 1) if u[i] > u[i - 1] and u[i] >= u[i + 1]]
    decrement = -np.polyfit(np.arange(len(peaks)), np.log(peaks), 1)[0] / pi
    assert decrement / sqrt(1.0 + decrement**2) == pytest.approx(found.damping, rel=2e-3)
    assert response.statistics["energy_error"] < 1e-4  # the trapezoidal work of dashpots, (omega dt)^2 / 12


def test_soil_without_damping_and_radiation_leaves_springs_alone() -> None:
    project, _, _, _ = mast(6.0, 2.4, 4.0, 0.3, damping=0.0, radiation=False)
    structure = make_structure(project)
    assert structure.frame.footings["A0"].dashpots == (None, None, None)
    assert interaction(project, structure, structure.modes(1), gravity=False).damping == 0.0


def test_static_stiffness_without_a_period() -> None:
    project, _, _, _ = mast(6.0, 2.4, 4.0, 0.3)
    found = footing_springs(project.frame.footings["A"], project.soils["soil"], float("inf"))
    assert found.stiffness == found.static and found.dashpot == (0.0, 0.0, 0.0)
