"""Lengths of rigid ends, and those that cannot be."""

from __future__ import annotations

import pytest
from unit.frame.recording_model import project

from edesign.errors import InputError
from edesign.frame.rigid_ends import rigid_ends


def asked(ends: str, *changes: tuple[str, str]) -> dict[str, tuple[float, float]]:
    """Of the small frame: HEB260 columns, IPE360 beams."""
    return rigid_ends(project(("masses:", f"elements: {{rigid_ends: {ends}}}\nmasses:"), *changes))


def test_shares_are_of_half_depths() -> None:
    found = asked("{beams: 1, columns: 50 %}")
    assert found["B_1_1"] == pytest.approx((0.13, 0.13))
    assert found["C_A_1"] == pytest.approx((0.0, 0.09))
    assert found["C_B_2"] == pytest.approx((0.09, 0.09))


def test_lengths_are_taken_as_they_are() -> None:
    found = asked("{beams: 200 mm}")
    assert found["B_2_2"] == (0.2, 0.2) and "C_A_1" not in found


def test_a_column_about_its_weak_axis_is_as_deep_as_its_flanges_are_wide() -> None:
    weak = ("section: HEB260, material: S275", "section: IPE360, axis: weak, material: S275")
    assert asked("{beams: 1}", weak)["B_1_1"] == pytest.approx((0.085, 0.085))


def test_the_middle_of_a_beam_that_braces_meet_is_free() -> None:
    braces = (
        "  beams: [{floors",
        "  braces: [{bays: 1, storeys: 1, kind: chevron, section: rod, material: S275}]\n  beams: [{floors",
    )
    found = asked("{beams: 1}", braces)
    assert found["B_1_1_1"] == pytest.approx((0.13, 0.0)) and found["B_1_1_2"] == pytest.approx((0.0, 0.13))


def test_what_cannot_be_is_refused_with_its_place() -> None:
    stiff = ("section: IPE360", "section: stiff")
    with pytest.raises(InputError, match=r":\d+:\d+: elements.rigid_ends: .*`stiff` .*E-HINGE-05"):
        asked("{columns: 1}", stiff)
    assert asked("{columns: 0.2 m}", stiff)["C_A_1"] == (0.0, 0.2)
    with pytest.raises(InputError, match=r"2 m and 2 m .* C_A_2, .* 3 m .*E-HINGE-05"):
        asked("{columns: 2 m}")
    with pytest.raises(InputError, match=r"3 m and 3 m .* B_1_1, .* 6 m .*E-HINGE-05"):
        asked("{beams: 3 m}")
