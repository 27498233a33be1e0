"""Frames of the verification manual of SAP2000, as programs print their results.

Problem 1-022: seven storeys, two bays in a plane; input and results (SAP2000, SeismoStruct) in PortalFrame2d.tcl of the
examples of OpenSees. Problem 1-024 (Peterson 1981): two storeys of nine columns below rigid diaphragms, the mass off
their centre; input and results in example 4 of the verification of MIDAS/Gen, its place in Frame24 of OpenBrIM.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.space_frames import Frame

from edesign.core.space import SpaceModel, combine

COLUMNS = {"W14X176": (51.7, 2150.0), "W14X211": (62.1, 2670.0), "W14X246": (72.3, 3230.0), "W14X287": (84.4, 3910.0)}
BEAMS = {"W24X110": (32.5, 3330.0), "W24X130": (38.3, 4020.0), "W24X160": (47.1, 5120.0)}
OUTER = ("W14X246",) * 3 + ("W14X211",) * 2 + ("W14X176",) * 2
INNER = ("W14X287",) * 3 + ("W14X246",) * 2 + ("W14X211",) * 2
BEAM = ("W24X160",) * 2 + ("W24X130",) * 2 + ("W24X110",) * 3
STOREY = (162.0, 162.0, 156.0, 156.0, 156.0, 156.0, 156.0)
E_1 = 29500.0  # ksi


def plane(A: float, inertia: float) -> dict[str, float]:
    """A member that bends in its plane alone: all else is restrained or counts for nothing."""
    return {"E": E_1, "G": E_1, "A": A, "I_y": inertia, "I_z": inertia, "I_t": inertia}


def seven_storeys() -> tuple[Frame, np.ndarray]:
    """The frame and its nodes (storeys + 1, 3). A floor moves along x as one: a diaphragm restrained in uy and rz."""
    f = Frame(masters=[(360.0, 0.0)] * 7)
    grid = np.zeros((8, 3), dtype=int)
    z = np.cumsum([0.0, *STOREY])
    for k in range(8):
        for i in range(3):
            fixed = "all" if k == 0 else "uy rx rz"
            grid[k, i] = f.node(360.0 * i, 0, z[k], fixed=fixed, floor=k - 1)
    for k in range(1, 8):
        for i in range(3):
            f.member(grid[k - 1, i], grid[k, i], **plane(*COLUMNS[(OUTER, INNER, OUTER)[i][k - 1]]))
        for i in range(2):
            f.member(grid[k, i], grid[k, i + 1], **plane(*BEAMS[BEAM[k - 1]]))
    return f, grid


def test_problem_1_022_periods() -> None:
    """All printed digits of SAP2000 and SeismoStruct."""
    f, grid = seven_storeys()
    mass = np.zeros(len(f.nodes))
    mass[grid[1:, 1]] = 0.49
    modes = f.model().modes(mass)
    np.testing.assert_allclose(modes.period, [1.2732, 0.4313, 0.2420, 0.1602, 0.1190, 0.0951, 0.0795], atol=0.5e-4)
    assert modes.effective_mass_ratio[:, 0].sum() == pytest.approx(1.0, abs=1e-12)  # all modes


def test_problem_1_022_lateral_loads() -> None:
    """Top displacement 1.45076 in, axial force 69.99 kip and moment 2324.68 kip in at the base of the first column."""
    f, grid = seven_storeys()
    nodal = np.zeros((1, len(f.nodes), 6))
    nodal[0, grid[1:, 0], 0] = (2.5, 5.0, 7.5, 10.0, 12.5, 15.0, 20.0)
    result = f.model().static(nodal)
    # a unit of the last digit: OpenSees prints 1.451 as SeismoStruct does, the prototype of this core 1.450757
    assert result.displacements[0, grid[7, 0], 0] == pytest.approx(1.45076, abs=1e-5)
    base = result.end_forces[0, 0]
    assert abs(base[0]) == pytest.approx(69.99, abs=5e-3)
    assert abs(base[4]) == pytest.approx(2324.68, abs=5e-3)


def two_storeys() -> SpaceModel:
    """Nine columns on a grid of 35 by 25 ft, storeys of 13 ft; masters at the centre of mass (38, 27) ft."""
    f = Frame(masters=[(38.0, 27.0)] * 2)
    column = {"E": 3.5e5, "G": 1.4e5, "A": 4.0, "I_y": 1.25, "I_z": 1.25, "I_t": 1e-9}
    beam = {"E": 5.0e5, "G": 2.0e5, "A": 5.0, "I_y": 2.61, "I_z": 1.67, "I_t": 1e-9}
    grid = np.zeros((3, 3, 3), dtype=int)
    for k in range(3):
        for j in range(3):
            for i in range(3):
                fixed = "all" if k == 0 else ""
                grid[k, j, i] = f.node(35.0 * i, 25.0 * j, 13.0 * k, fixed=fixed, floor=k - 1)
    for k in (1, 2):
        for j in range(3):
            for i in range(3):
                f.member(grid[k - 1, j, i], grid[k, j, i], **column)
                if i:
                    f.member(grid[k, j, i - 1], grid[k, j, i], **beam)
                if j:
                    f.member(grid[k, j - 1, i], grid[k, j, i], **beam)
        f.node(38.0, 27.0, 13.0 * k, floor=k - 1)
    return f.model()


def test_problem_1_024() -> None:
    """Four modes without rotational mass, all printed digits; roof 0.0201 ft under 0.4 g along x, damping 4 %."""
    model = two_storeys()
    mass = np.zeros(model.n_nodes)
    mass[-2:] = 6.21118
    modes = model.modes(mass)
    np.testing.assert_allclose(modes.period, [0.2271, 0.2156, 0.0733, 0.0720], atol=0.5e-4)
    r = modes.omega[:, None] / modes.omega
    rho = 8 * 0.04**2 * (1 + r) * r**1.5 / ((1 - r**2) ** 2 + 4 * 0.04**2 * r * (1 + r) ** 2)
    ordinate = modes.participation[:, 0] * 0.4 * 32.2 / modes.omega**2
    roof = (modes.floor_shapes[:, 1, 0] * ordinate)[None]
    assert combine(roof, np.eye(4))[0] == pytest.approx(0.0201, abs=0.5e-4)
    assert combine(roof, rho)[0] == pytest.approx(0.0201, abs=0.5e-4)
    assert np.sum(np.abs(roof)) == pytest.approx(0.0205, abs=0.5e-4)
    np.testing.assert_allclose(modes.effective_mass_ratio[:, :2].sum(axis=0), 1.0, atol=1e-12)
