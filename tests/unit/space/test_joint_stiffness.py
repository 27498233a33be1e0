"""Semi-rigid ends that are none: of the wrong unit, or of joints that are as good as pinned or rigid."""

from __future__ import annotations

import pytest
from building_examples import SMALL, building

from edesign.space.check import check_building
from edesign.space.joint_stiffness import unusual_ends


@pytest.mark.parametrize(
    ("stiffness", "said"),
    [  # E I / L of an IPE300 over 6 m is 2.92 MN m, over 4 m 4.39 MN m
        ("40 N*m/rad", "1.37e-05 E I / L of BX_1_1_1 is as good as pinned"),
        ("2 MN*m/rad", "0.456 E I / L of BX_1_2_1 is as good as pinned"),
        ("2.2 MN*m/rad", ""),
        ("40 MN*m/rad", ""),
        ("40 GN*m/rad", "is as good as rigid; a semi-rigid end has 0.5 to 25 E I / L (EN 1993-1-8, 5.2.2.5)"),
    ],
)
def test_ends_as_good_as_pinned_or_rigid_are_reported(stiffness: str, said: str) -> None:
    file = building(SMALL.replace("IPE300, material: S275}", f"IPE300, material: S275, ends: {{end: {stiffness}}}}}"))
    found = unusual_ends(file)
    assert len(found) == bool(said)
    if said:
        assert found[0].startswith("building.yaml:7:61: beams[0].ends: ") and said in found[0]
        assert found[0] in check_building(file)["warnings"]
