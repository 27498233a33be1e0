"""The ten-storey building of the thesis, section 5.2, as designed by Eurocodes 3 and 8.

Source: Seismic design and evaluation of moment resisting frames using elastomeric dampers, Tables 5.1 to 5.3. The plan
is reconstructed from Table 5.3, see projects/thesis_building/building.yaml.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.frame.building_file import load_building
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import elastic_design

PROJECT = Path(__file__).resolve().parents[2] / "projects" / "thesis_building"
PERIODS = (2.651286, 0.973412, 0.923146, 0.747592, 0.51529, 0.32702, 0.320467, 0.248166, 0.232642)


@pytest.fixture(scope="module")
def light() -> ElasticDesign:
    """The beams that give Table 5.3."""
    return elastic_design(load_building(PROJECT / "building.yaml"))


@pytest.fixture(scope="module")
def printed() -> ElasticDesign:
    """The sections of Table 5.2, one bay of each frame along x pinned."""
    return elastic_design(load_building(PROJECT / "table_5_2.yaml"))


def test_periods_of_table_5_3(light: ElasticDesign, printed: ElasticDesign) -> None:
    """Within 1.2 % with the sections of Table 5.2 and one bay of each frame pinned: the largest difference is 0.73 %.

    With light beams and all bays rigid within 1.5 %: the weight of the diagonals, 0.8 % of a floor, makes 0.4 % of the
    largest, 1.41 %.
    """
    np.testing.assert_allclose(printed.modes.period[:9], PERIODS, rtol=0.012)
    np.testing.assert_allclose(light.modes.period[:9], PERIODS, rtol=0.015)


@pytest.mark.parametrize("beams", ["light", "printed"])
def test_mass_ratios_of_table_5_3(beams: str, request: pytest.FixtureRequest) -> None:
    ratio = request.getfixturevalue(beams).modes.effective_mass_ratio
    along_x = [0.74817, 0.12323, 0.04826, 0.02625, 0.01844]
    np.testing.assert_allclose(ratio[[0, 2, 4, 5, 8], 0], along_x, atol=0.015)
    np.testing.assert_allclose(ratio[[1, 6], 1], [0.79867, 0.13171], atol=0.015)
    np.testing.assert_allclose(ratio[:9, :2].sum(axis=0), [0.96435999, 0.930387679], atol=0.015)


def test_the_ten_combinations_of_the_thesis(printed: ElasticDesign) -> None:
    """Section 5.2: 1.35 G + 1.5 Q, G + Q, and G + 0.3 Q with +-E_x +-0.3 E_y and +-E_y +-0.3 E_x.

    Those with sway imperfections, which the thesis does not mention, come beside them.
    """
    acting = [row for row in printed.combinations if row.static.keys() <= {"G", "Q"}]
    plain = [row for row in acting if max(map(abs, row.seismic)) <= 1.0]
    assert [row.name for row in plain] == [
        "1.35 G + 1.5 Q",
        *(f"G + 0.3 Q {a} E_x {b} 0.3 E_y" for a in "+-" for b in "+-"),
        *(f"G + 0.3 Q {a} E_y {b} 0.3 E_x" for a in "+-" for b in "+-"),
        "G + Q",
    ]


def test_base_shear_and_second_order_effects(printed: ElasticDesign) -> None:
    """An independent numpy model of the building found 1985 and 4692 kN, theta 0.53 and 0.22 with the elastic cap.

    Its floors are 0.4 % lighter; the figures are given to their last digit.
    """
    x, y = printed.response["x"], printed.response["y"]
    assert x.base_shear == pytest.approx(1985e3, rel=0.01) and y.base_shear == pytest.approx(4692e3, rel=0.01)
    assert x.base_shear_without_beta == pytest.approx(940e3, rel=0.01)
    assert printed.storeys["x"].theta_q.max() == pytest.approx(0.53, abs=0.015)
    assert printed.storeys["x"].theta.max() == pytest.approx(0.22, abs=0.005)
    assert any("beta = 0.2 governs" in note for note in printed.notes)


def test_storey_forces_are_in_equilibrium_with_the_base(printed: ElasticDesign) -> None:
    """Columns and diagonals of the lowest storey carry the storey shear of each mode; 1e-9 of it."""
    frame, modes = printed.frame, printed.modes
    lowest = [n for n, member in enumerate(frame.members) if member.storey == 1 and member.kind != "beam"]
    for mode in range(6):
        total = np.zeros(2)
        for n in lowest:
            member = frame.members[n]
            x = (frame.coordinates[member.end] - frame.coordinates[member.start]) / frame.length[n]
            z = np.array(member.web)
            ends = modes.end_forces[mode, n, 6:9]
            total += (ends[0] * x + ends[1] * np.cross(z, x) + ends[2] * z)[:2]
        inertia = (modes.omega[mode] ** 2 * frame.node_mass[:, None] * modes.displacements[mode, :, :2]).sum(axis=0)
        np.testing.assert_allclose(total, inertia, atol=1e-9 * np.abs(inertia).max())


def test_what_the_design_of_the_thesis_does_not_meet(printed: ElasticDesign) -> None:
    """Rules of EN 1998-1 that the thesis does not mention: theta, homogeneous diagonals, columns at 1.1
    gamma_ov Omega; web panels at the roof, 44 % over with a doubler plate; and its three single diagonals, two of them
    one way, are not alike in both senses: 1/3 > 0.05."""
    broken = {rule.clause for rule in printed.criteria if rule.passed is False}
    assert broken == {"4.4.2.2(3)", "6.6.3(6)", "6.7.1(3)", "6.7.3(8)"}
    assert not printed.passed
    by_name = {member.name: n for n, member in enumerate(printed.frame.members)}
    assert np.nanmax(printed.members.utilisation[by_name["C_A4_1"]]) > 1.0
