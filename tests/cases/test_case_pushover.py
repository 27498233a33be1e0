"""Target displacements of the case `pushover_targets`, worked out from its archived curves in the way of the codes.

Here the idealisations are iterated from the largest base shear, as Annex B of EN 1998-1 has it, with trapezoids; the
program brackets the target that fits itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
CASE = "pushover_targets"
PUSHES = [f"push.{pattern}.{way}" for pattern in ("first_mode", "uniform") for way in ("right", "left")]
PLATEAU, T_C = 0.3 * 9.80665 * 1.6 * 1.15 * 2.5, 0.6  # of the level MCE on ground C, type 1
FLOOR = 13.0 * (24e3 + 0.3 * 10e3) / 9.80665  # kg


def curve(group: Group) -> tuple[np.ndarray, np.ndarray]:
    return group.variables["control_displacement"].values, np.abs(group.variables["base_shear"].values)


def spectrum(T: float) -> float:
    return PLATEAU * min(1.0, T_C / T)


def area(d: np.ndarray, v: np.ndarray, end: float) -> float:
    x = np.append(d[d < end], end)
    return float(np.trapezoid(np.interp(x, d, v), x))


@pytest.mark.parametrize("push", PUSHES)
def test_n2(results_of: Results, push: str) -> None:
    group, found = results_of(CASE, push), results_of(CASE, f"{push}.n2.MCE")
    nodes = group.coords["loaded_node"].values.tolist()
    shares = group.variables["lateral_load_share"].values
    forces = np.array([sum(share for node, share in zip(nodes, shares, strict=True) if node[1:] == f) for f in "123"])
    m_star, Gamma = FLOOR * forces.sum() / forces[-1], forces.sum() * forces[-1] / np.sum(forces**2)
    d, v = curve(group)
    d_t = d[-1]
    for _ in range(60):
        d_m = min(d_t, d[np.argmax(v)])
        F_y = np.interp(d_m, d, v)
        d_y = 2.0 * (d_m - area(d, v, d_m) / F_y)
        T = 2.0 * math.pi * math.sqrt(m_star * d_y / F_y)
        q_u, d_et = spectrum(T) * m_star * Gamma / F_y, spectrum(T) * (T / (2.0 * math.pi)) ** 2
        d_t = Gamma * (d_et if T >= T_C or q_u <= 1.0 else d_et / q_u * (1.0 + (q_u - 1.0) * T_C / T))
    assert {name: float(found.variables[f"n2_{name}"].values) for name in ("m", "Gamma", "T", "q_u", "d_t")} == {
        "m": pytest.approx(m_star, rel=1e-9),
        "Gamma": pytest.approx(Gamma, rel=1e-9),
        "T": pytest.approx(T, rel=1e-6),
        "q_u": pytest.approx(q_u, rel=1e-6),
        "d_t": pytest.approx(d_t, rel=1e-6),
    }


@pytest.mark.parametrize("push", PUSHES)
def test_asce_41(results_of: Results, push: str) -> None:
    """V_y is searched on a grid of 1e-4 of it, which moves d_t by less."""
    group, found = results_of(CASE, push), results_of(CASE, f"{push}.asce41.MCE")
    modes = results_of(CASE, "modes")
    T_i = float(modes.variables["period"].values[0])
    C_0 = float(modes.variables["participation_factor_x"].values[0])
    d, v = curve(group)
    d_t = d[-1]
    for _ in range(30):
        D_d = min(d_t, d[np.argmax(v)])
        V_d, energy = np.interp(D_d, d, v), area(d, v, D_d)
        V_y = np.linspace(0.3, 1.0, 7001) * V_d
        K_e = 0.6 * V_y / np.interp(0.6 * V_y, v, d)
        best = int(np.argmin(np.abs(0.5 * V_y * D_d + 0.5 * V_d * (D_d - V_y / K_e) - energy)))
        T_e = T_i * math.sqrt(v[1] / d[1] / K_e[best])
        mu = spectrum(T_e) * 3 * FLOOR * 0.9 / V_y[best]
        C_1 = 1.0 + (mu - 1.0) / (60.0 * T_e**2)
        d_t = C_0 * C_1 * spectrum(T_e) * (T_e / (2.0 * math.pi)) ** 2
    assert found.variables["asce41_C_2"].values == 1.0 and T_e > 0.7
    assert found.variables["asce41_C_0"].values == pytest.approx(C_0, rel=2e-3)  # of one node, not of the roof's mean
    assert found.variables["asce41_mu_strength"].values == pytest.approx(mu, rel=1e-3)
    assert found.variables["asce41_d_t"].values == pytest.approx(d_t, rel=3e-3)


@pytest.mark.parametrize("push", PUSHES)
@pytest.mark.parametrize("method", ["n2", "fema356", "asce41"])
def test_the_frame_stands_on_its_curve_at_the_target(results_of: Results, push: str, method: str) -> None:
    """Monotonic paths with other steps meet: 5e-4 of the base shear, by straight lines between sixty points."""
    state = results_of(CASE, f"{push}.{method}.MCE")
    d, v = curve(results_of(CASE, push))
    d_t = float(state.variables[f"{method}_d_t"].values)
    assert state.variables["control_displacement"].values[-1] == pytest.approx(d_t, rel=1e-9)
    assert abs(state.variables["base_shear"].values[-1]) == pytest.approx(np.interp(d_t, d, v), rel=5e-4)
    assert abs(state.variables["lateral_load"].values[-1]) == pytest.approx(
        abs(state.variables["base_shear"].values[-1])
    )


def test_a_push_goes_to_150_per_cent_of_the_largest_target(results_of: Results) -> None:
    for push in PUSHES:
        targets = [
            float(results_of(CASE, f"{push}.{method}.MCE").variables[f"{method}_d_t"].values)
            for method in ("n2", "fema356", "asce41")
        ]
        reached = results_of(CASE, push).variables["control_displacement"].values[-1]
        assert reached >= 1.5 * max(targets) * (1 - 1e-9)
        assert reached < 1.6 * max(targets)
