"""State determination of the force-based member: equilibrium and compatibility in every yielded state, however
large the step.

M_p = (x_p - 1) M_i + x_p M_j + M_load(x_p), N_p = N      sum_p w_p b_p' e_p = v
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, channel, i_layers, plastic_moment
from verification.test_verify_quadrature import lobatto

from edesign.core import Analysis, Bilinear, MenegottoPinto, Model, Steel

L, W, POINTS = 4.0, -20e3, 5
MP = plastic_moment(*i_layers(4, 16))
LAWS = {"perfect": Bilinear(E, FY), "hardening": Bilinear(E, FY, 0.02), "curved": MenegottoPinto(E, FY, 0.02)}


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("target, steps", [(0.05, 1), (0.05, 30), (1.0, 1), (1.0, 30), (-0.3, 3)])
def test_equilibrium_and_compatibility(law: Steel, target: float, steps: int) -> None:
    """A cantilever with a load along it, pushed at its tip. Equilibrium to the root of the element's energy
    tolerance (1e-8), compatibility to rounding: the iteration keeps it."""
    m = Model()
    section = m.fibre_section(*i_layers(4, 16), m.material(law))
    i, j = m.node("i", 0, 0), m.node("j", L, 0)
    m.fix(i, True, True, True)
    e = m.beam_column("e", i, j, section, POINTS, "linear")
    g, push = m.pattern(), m.pattern()
    m.uniform_load(g, e, axial=5e3, transverse=W)
    m.nodal_load(push, j, fy=1.0)
    a = Analysis(m, tolerance=1e-9)
    assert a.static(g).status == "completed"
    channels = [channel("section_force", e, k, f"s{k}") for k in range(2 * POINTS)]
    channels += [channel("section_deformation", e, k, f"e{k}") for k in range(2 * POINTS)]
    channels += [channel("deformation", e, k, f"v{k}") for k in range(3)]
    channels += [channel("end_force", e, k, f"q{k}") for k in range(6)]
    r = a.pushover(push, j, "uy", target, steps, channels)
    assert r.status == "completed", r.reason
    x, w = lobatto(POINTS)
    s = np.array([r.values[f"s{k}"] for k in range(2 * POINTS)])
    d = np.array([r.values[f"e{k}"] for k in range(2 * POINTS)])
    moment_i, moment_j, axial = r.values["q2"], r.values["q5"], r.values["q3"]
    for p in range(POINTS):
        M = (x[p] - 1) * moment_i + x[p] * moment_j + 0.5 * W * L**2 * x[p] * (x[p] - 1)
        np.testing.assert_allclose(s[2 * p + 1], M, atol=1e-7 * MP)
        np.testing.assert_allclose(s[2 * p], axial + 5e3 * L * (1 - x[p]), atol=1e-7 * MP / 0.2)
    elongation = L * sum(w[p] * d[2 * p] for p in range(POINTS))
    rotations = [L * sum(w[p] * (x[p] - 1 + end) * d[2 * p + 1] for p in range(POINTS)) for end in (0, 1)]
    scale = abs(target) / L
    np.testing.assert_allclose(rotations[0], r.values["v1"], atol=1e-10 * scale)
    np.testing.assert_allclose(rotations[1], r.values["v2"], atol=1e-10 * scale)
    np.testing.assert_allclose(elongation, r.values["v0"], atol=1e-10 * abs(target))
    # the hinge: what a fully plastic base leaves is all rotation of the first point
    if isinstance(law, Bilinear) and law.b == 0.0:
        assert np.abs(s[1::2]).max() <= MP * (1 + 1e-9)
