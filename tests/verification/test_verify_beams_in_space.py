"""Loads across beams about both axes, and struts in any direction.

References: fixed-end moments of closed form; the plane core, whose struts the other tests here verify.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest

from edesign.core import Analysis, Bilinear, Channel, Elastic, Fatigue, Model, MultilinearSpring

L, UNIFORM, POINT, PLACE = 5.0, 7e3, 9e3, 0.3


@pytest.mark.parametrize("fibres", [False, True], ids=["elastic", "fibres"])
@pytest.mark.parametrize("axis", ["y", "z"])
def test_fixed_end_moments(axis: str, fibres: bool) -> None:
    """w L^2 / 12, and P a b^2 / L^2 with shears P b^2 (3 a + b) / L^3: M_z of loads along y, -M_y of those along z."""
    m = Model(3)
    if fibres:
        y, z = (c.ravel() for c in np.meshgrid([-0.1, 0.1], [-0.07, 0.07]))
        section = m.fibre_section(y, np.full(4, 0.005), m.material(Elastic(2e11)), z=z, GJ=1e6)
    else:
        section = m.elastic_section(1e9, 2e7, 6e6, 1e6)
    ends = [m.node(f"n{k}", k * 0.6 * L, 0.0, k * 0.8 * L) for k in range(2)]
    beam = m.beam_column(
        "beam", *ends, section, geometry="linear", web=(-0.8, 0.0, 0.6), breaks=(PLACE,) if fibres else ()
    )
    for end in ends:
        m.fix(end, True, True, True, uz=True, rx=True, ry=True)
    free = m.node("free", -1.0, 0.0, 0.0)  # something has to move
    m.beam_column("other", ends[0], free, section, geometry="linear", web=(0.0, 0.0, 1.0))
    uniform, point = m.pattern(), m.pattern()
    m.uniform_load(uniform, beam, **{("transverse", "transverse_z")[axis == "z"]: UNIFORM})
    m.point_load(point, beam, PLACE, **{("transverse", "transverse_z")[axis == "z"]: POINT})
    sign, moment, shear = (1.0, 5, 1) if axis == "y" else (-1.0, 4, 2)
    channels = [Channel(str(k), ((1.0, "end_force", beam, k),)) for k in range(12)]
    a = Analysis(m)
    r = a.static(uniform, channels=channels)
    full = sign * UNIFORM * L**2 / 12
    assert [r.final[str(moment + 6 * k)] for k in (0, 1)] == pytest.approx([-full, full], rel=1e-12)
    assert [r.final[str(shear + 6 * k)] for k in (0, 1)] == pytest.approx([-UNIFORM * L / 2] * 2, rel=1e-12)
    a.static(uniform, 0.0)
    r = a.static(point, channels=channels)
    p, q = PLACE, 1.0 - PLACE
    moments = [-sign * POINT * L * p * q**2, sign * POINT * L * p**2 * q]
    shears = [-POINT * q**2 * (3 * p + q), -POINT * p**2 * (p + 3 * q)]
    assert [r.final[str(moment + 6 * k)] for k in (0, 1)] == pytest.approx(moments, rel=1e-12)
    assert [r.final[str(shear + 6 * k)] for k in (0, 1)] == pytest.approx(shears, rel=1e-12)
    others = [r.final[str(k)] for k in range(12) if k % 6 not in (moment, shear)]
    assert np.abs(others).max() < 1e-9 * POINT


def strut(dimension: int, along: np.ndarray, geometry: str) -> tuple[np.ndarray, np.ndarray]:
    """Force and deflection of a pinned strut that is pushed and pulled along itself until it breaks."""
    m = Model(dimension)
    y = (np.arange(10) + 0.5) / 10 * 0.12 - 0.06
    section = m.fibre_section(y, np.full(10, 2e-4), m.material(Bilinear(2.1e11, 235e6, 0.01), Fatigue(0.08, -0.5)))
    i, j = m.node("i", 0.0, 0.0), m.node("j", *(4.0 * along))
    if dimension == 2:
        m.fix(i, True, True, True)
        m.fix(j, uy=True, rz=True)
    else:
        m.fix(i, True, True, True, uz=True, rx=True, ry=True)
        m.fix(j, rz=True, rx=True, ry=True)
        for across in np.linalg.svd(along[None, :])[2][1:]:
            terms = [*-across, 0.0, 0.0, 0.0, *across, 0.0, 0.0, 0.0]
            m.spring("held", i, j, terms, MultilinearSpring(1e9))
    brace = m.strut("brace", i, j, section, 0, 2e-3, 1 / 500, geometry=geometry)
    push = m.pattern()
    m.nodal_load(push, j, along[0], along[1], fz=along[2] if dimension == 3 else 0.0)
    a = Analysis(m)
    force, bow = [], []
    for target in (-0.03, 0.02, -0.05, 0.04, -0.06, 0.05):
        channels = [Channel("N", ((1.0, "axial_force", brace, 0),)), Channel("w", ((1.0, "deflection", brace, 0),))]
        r = a.pushover(push, j, "ux", target * along[0], 60, channels)
        assert r.status == "completed", r.reason
        force.append(r.values["N"])
        bow.append(r.values["w"])
    return np.concatenate(force), np.concatenate(bow)


@pytest.mark.parametrize("geometry", ["linear", "p_delta"])
@pytest.mark.parametrize(("turn", "rise"), [(0.4, 0.7), (2.9, -0.3)])
def test_struts_in_any_direction(turn: float, rise: float, geometry: str) -> None:
    """1e-6 of the largest force: equilibrium is iterated to 1e-7 of it, over cycles that buckle, yield and break."""
    plane = strut(2, np.array([1.0, 0.0]), geometry)
    along = np.array([cos(turn) * cos(rise), sin(turn) * cos(rise), sin(rise)])
    space = strut(3, along, geometry)
    for one, other in zip(plane, space, strict=True):
        np.testing.assert_allclose(other, one, atol=1e-6 * np.abs(one).max(), rtol=0)
    assert plane[0][-1] < 0.7 * plane[0].max()  # some of it has broken
