"""The vertical component on long beams, by hand (EN 1998-1, 4.3.3.5.2)."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import braced_frames, changed, design_of, number_of
from scipy.constants import g

from edesign.frame.sections.steel_section import steel_section

HALL = changed(
    braced_frames(y="24 m", storeys="5 m, 4 m", braces="kind: cross, section: SHS200x10"),
    ("y, section: IPE400", "y, section: HEA800"),
    ("G: 5 kN/m^2, Q: 2 kN/m^2", "G: 3 kN/m^2, Q: 0.2 kN/m^2"),
    ("spans: y", "spans: x"),
    ("a_gR: 2.5", "a_gR: 3.5"),
)


def test_a_long_beam_by_hand() -> None:
    """a_vg = 0.9 x 3.5 m/s2; S_vd = 2.5 a_vg / 1.5 on the plateau, and E_z = S_vd / g of G + 0.3 Q = 3.06 kN/m2.

    The beam on hinges has q L2 / 8, and 1 + S_vd / g of it with E_z; the columns half of its load, from both floors
    in the lowest storey.
    """
    found = design_of(HALL)
    share = 2.5 * 0.9 * 3.5 / 1.5 / g
    w = (3.0 + 0.3 * 0.2) * 1e3 * 3.0
    beam = number_of(found.frame, "BY_A_1_2")
    rows = {row.name: row for row in found.combinations if "E_z" in row.name}
    row = rows["G + 0.3 Q + E_z + 0.3 E_x + 0.3 E_y"]
    assert abs(found.effects.of_static(row)[beam, 3, 4]) == pytest.approx((1.0 + share) * w * 24.0**2 / 8.0, rel=1e-6)
    E_z = found.effects.static[found.effects.cases.index("E_z")]
    for storey, floors in ((2, 1), (1, 2)):
        column = number_of(found.frame, f"C_A1_{storey}")
        np.testing.assert_allclose(E_z[column, :, 0], -floors * share * w * 12.0, rtol=1e-6)
    assert not E_z[number_of(found.frame, "BX_1_1_2")].any()
    M_pl = steel_section("HEA800").W_pl_y * 275e6
    bending = list(found.members.checks).index("M_Y")
    expected = (1.0 + share) * w * 24.0**2 / 8.0 / M_pl
    assert found.members.utilisation[beam, bending] >= expected * (1.0 - 1e-6)
    governing = found.members.rows[int(found.members.combination[beam, bending]) - 1]
    assert "E_z" in governing.name
    assert any("BY_A_1_2 (24 m)" in note and "a_vg = 0.32 g" in note for note in found.notes)


def test_upwards_counts_with_its_sign() -> None:
    """Among the rows are -E_z and -0.3 E_z: columns may be lifted by it."""
    found = design_of(HALL)
    factors = {row.static["E_z"] for row in found.combinations if "E_z" in row.static}
    assert factors == {1.0, -1.0, 0.3, -0.3}


@pytest.mark.parametrize("change", [("a_gR: 3.5", "a_gR: 2.7"), ("y: [24 m]", "y: [19.9 m]")])
def test_where_it_does_not_count(change: tuple[str, str]) -> None:
    """0.9 x 2.7 is below 2.5 m/s2, the limit in the text of the code for 0.25 g; spans count from 20 m."""
    found = design_of(HALL, change)
    assert "E_z" not in found.effects.cases and not any("E_z" in row.name for row in found.combinations)


def test_beams_over_a_missing_column_are_one_span() -> None:
    """Two bays of 12 m over a line without a column are a beam of 24 m."""
    braces = HALL[HALL.index("braces:") : HALL.index("materials:")]
    found = design_of(
        HALL,
        ("y: [24 m]", "y: [12 m, 12 m]"),
        ("ends: pinned, group: BY", "ends: rigid, group: BY"),
        (braces, "missing: {columns: [{at: [A2, B2]}]}\n"),
        ("y: {type: concentric_diagonal, q: 4}", "y: {type: moment_frame, q: 4}"),
    )
    assert any("BY_A_1_1 (24 m)" in note for note in found.notes)
