"""Moment-curvature of an I of three plates in elastic-perfectly plastic steel against the exact curve.

A member under an end moment is bent uniformly, so that its sections' curvature is rotation / length.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, I_SHAPE, E, channel, i_layers, steel_cantilever

from edesign.core import Bilinear

L = 2.0
H, B, TF, TW = I_SHAPE
YIELD = FY / E / (H / 2)  # curvature at first yield


def exact_moment(kappa: float) -> float:
    """Integral of the stress over rectangles b1 <= y <= b2 on either side; elastic within |y| < eps_y / kappa."""
    depth = FY / E / kappa

    def part(width: float, low: float, high: float) -> float:
        middle = min(max(depth, low), high)
        return 2 * width * (E * kappa * (middle**3 - low**3) / 3 + FY * (high**2 - middle**2) / 2)

    web = H / 2 - TF
    return part(TW, 0.0, web) + part(B, web, H / 2)


def curve(layers: tuple[np.ndarray, np.ndarray], target: float, steps: int = 40) -> tuple[np.ndarray, np.ndarray]:
    """Curvature and moment in the core."""
    s = steel_cantilever(L, layers, Bilinear(E, FY))
    s.model.nodal_load(s.pattern, s.nodes[1], mz=1.0)
    element = s.elements[0]
    channels = [
        channel("section_deformation", element, 2 * 2 + 1, "k"),
        channel("section_force", element, 5, "m"),
        channel("load_factor", s.pattern, 0, "f"),
    ]
    response = s.analysis(tolerance=1e-10).pushover(s.pattern, s.nodes[1], "rz", target * L, steps, channels)
    assert response.status == "completed", response.reason
    v = response.values
    np.testing.assert_allclose(v["k"], response.time / L, rtol=1e-7, atol=1e-9 * target)
    np.testing.assert_allclose(v["f"], v["m"], rtol=1e-8, atol=1e-8 * v["m"].max())
    return v["k"], v["m"]


def test_equals_the_layers_sum() -> None:
    """Pure bending of a doubly symmetric section: N = 0 and e0 = 0, so M = sum A y min(E kappa y, fy). 1e-9: the
    tolerance."""
    y, area = i_layers(4, 16)
    kappa, moment = curve((y, area), 20 * YIELD)
    expected = np.array([np.sum(area * np.abs(y) * np.minimum(E * k * np.abs(y), FY)) for k in kappa])
    np.testing.assert_allclose(moment, expected, rtol=1e-8)


def test_layers_converge_to_the_exact_curve() -> None:
    """Midpoint layers: the error over the curve falls as 1/n^2, within a factor for where the yield front lies in
    a layer."""
    errors = []
    for n in (1, 2, 4, 8):
        kappa, moment = curve(i_layers(2 * n, 8 * n), 5 * YIELD, 50)
        exact = np.array([exact_moment(k) for k in kappa[1:]])
        errors.append(float(np.max(np.abs(moment[1:] / exact - 1))))
    order = np.log2(np.array(errors[:-1]) / np.array(errors[1:]))
    assert errors[-1] < 1e-4
    assert np.log2(errors[0] / errors[-1]) / 3 == pytest.approx(2.0, abs=0.3), (errors, order)


def test_thesis_layers() -> None:
    """Four layers a flange and sixteen in the web: within 0.5 % of the exact curve everywhere."""
    kappa, moment = curve(i_layers(4, 16), 10 * YIELD, 80)
    exact = np.array([exact_moment(k) for k in kappa[1:]])
    np.testing.assert_allclose(moment[1:], exact, rtol=5e-3)


def test_unloading_is_elastic() -> None:
    """The residual curvature after M returns to 0 is kappa - M / EI of the layers."""
    y, area = i_layers(4, 16)
    s = steel_cantilever(L, (y, area), Bilinear(E, FY))
    s.model.nodal_load(s.pattern, s.nodes[1], mz=1.0)
    a = s.analysis(tolerance=1e-10)
    pushed = a.pushover(s.pattern, s.nodes[1], "rz", 4 * YIELD * L, 20, [channel("load_factor", s.pattern, 0, "f")])
    moment = pushed.final["f"]
    back = a.static(s.pattern, 0.0, 5, [channel("displacement", s.nodes[1], 2, "r")])
    assert back.status == "completed"
    EI = E * float(area @ y**2)
    assert back.final["r"] / L == pytest.approx(4 * YIELD - moment / EI, rel=1e-7)
