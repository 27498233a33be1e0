"""A portal with rigid joints against slope deflection between the faces, worked out here."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from edesign.archive.dataset import Group

Results = Callable[[str, str], Group]
E, H, L, W = 210e9, 4.0, 6.0, 30e3  # Pa, m, m, N/m
A_COLUMN, A_BEAM = 0.5 * 0.400, 0.5 * 0.300  # m: half depths of the beam and of the column
# three rectangles without fillets, as the model has them
I_COLUMN = (0.3 * 0.3**3 - (0.3 - 0.011) * 0.262**3) / 12.0
I_BEAM = (0.18 * 0.4**3 - (0.18 - 0.0086) * 0.373**3) / 12.0
H_CLEAR, L_CLEAR = H - A_COLUMN, L - 2.0 * A_BEAM


def test_the_faces_stand_at_half_depths(results_of: Results) -> None:
    group = results_of("rigid_ends", "gravity")
    assert list(group.coords["member"].values) == ["C_A_1", "C_B_1", "B_1_1"]
    np.testing.assert_allclose(group.variables["rigid_end"].values, [(0.0, A_COLUMN)] * 2 + [(A_BEAM, A_BEAM)])


def test_moments_under_gravity(results_of: Results) -> None:
    """Symmetric: the joints turn against each other, and both faces of the beam rise alike: 2 E I / l of its turn.

    The columns shorten alike. A turn of a joint bends a column by k (4 + 12 c + 12 c^2), c = a / l.
    """
    group = results_of("rigid_ends", "gravity")
    of_beam, of_column, c = 2.0 * E * I_BEAM / L_CLEAR, E * I_COLUMN / H_CLEAR, A_COLUMN / H_CLEAR
    of_column *= 4.0 + 12.0 * c + 12.0 * c**2
    # about the node: the moment of the face, the shear times the arm, the load on the arm
    fixed = W * (L_CLEAR**2 / 12.0 + 0.5 * L_CLEAR * A_BEAM + 0.5 * A_BEAM**2)
    face = W * L_CLEAR**2 / 12.0 - of_beam * fixed / (of_beam + of_column)
    ends = dict(zip(group.coords["member"].values, _largest(group, "member_bending_moment"), strict=True))
    assert ends["B_1_1"] == pytest.approx([face, face], rel=1e-6)


def _largest(group: Group, name: str) -> np.ndarray:
    return np.maximum(np.abs(group.variables[f"{name}_max"].values), np.abs(group.variables[f"{name}_min"].values))


def test_lateral_stiffness(results_of: Results) -> None:
    """Without second order, as the case is linear."""
    group = results_of("rigid_ends", "push")
    u = group.variables["roof_displacement"].values
    lateral = group.variables["lateral_load"].values
    found = (lateral[-1] - lateral[0]) / (u[-1] - u[0])
    assert found == pytest.approx(_portal_stiffness(), rel=1e-6)


def _portal_stiffness() -> float:
    """Sway stiffness from 6 x 6 member matrices with arms, all degrees of both joints, condensed to the sway."""
    k = np.zeros((6, 6))
    area_column = 2 * 0.3 * 0.019 + 0.262 * 0.011
    area_beam = 2 * 0.18 * 0.0135 + 0.373 * 0.0086
    for joint in (0, 1):
        upper = _member(area_column, I_COLUMN, H_CLEAR, (0.0, A_COLUMN), (0.0, 1.0))[3:, 3:]
        k[3 * joint : 3 * joint + 3, 3 * joint : 3 * joint + 3] += upper
    k += _member(area_beam, I_BEAM, L_CLEAR, (A_BEAM, A_BEAM), (1.0, 0.0))
    shared = np.zeros((6, 5))  # one sway for both joints
    shared[0, 0] = shared[3, 0] = 1.0
    for column, row in enumerate((1, 2, 4, 5), start=1):
        shared[row, column] = 1.0
    return float(1.0 / np.linalg.inv(shared.T @ k @ shared)[0, 0])


def _member(
    area: float, inertia: float, length: float, arms: tuple[float, float], axis: tuple[float, float]
) -> np.ndarray:
    a, b = E * area / length, E * inertia / length
    c, d = 6.0 * b / length, 12.0 * b / length**2
    local = np.array(
        [
            [a, 0, 0, -a, 0, 0],
            [0, d, c, 0, -d, c],
            [0, c, 4 * b, 0, -c, 2 * b],
            [-a, 0, 0, a, 0, 0],
            [0, -d, -c, 0, d, -c],
            [0, c, 2 * b, 0, -c, 4 * b],
        ]
    )
    arm = np.eye(6)
    arm[1, 2], arm[4, 5] = arms[0], -arms[1]
    turn = np.zeros((6, 6))
    for at in (0, 3):
        turn[at : at + 3, at : at + 3] = [[axis[0], axis[1], 0], [-axis[1], axis[0], 0], [0, 0, 1]]
    whole = arm @ turn
    return whole.T @ local @ whole
