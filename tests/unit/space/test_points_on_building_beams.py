"""Forces at places along the beams of a building: they are what secondary beams bring, and are checked."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.space.structure.geometry import space_frame

TEXT = """\
edesign_building: 1
title: One storey
plan: {{x: [6 m, 4 m], y: [5 m]}}
storeys: [4 m]
columns: [{{section: HEB240, material: S275, strong: x}}]
beams: [{{along: x, section: IPE300, material: S275}}, {{along: y, section: IPE270, material: S275}}]
braces: [{{along: x, frames: 1, bays: 1, kind: chevron, section: SHS120x8, material: S275}}]
materials: {{S275: {{fy: 275 MPa}}}}
loads: {{self_weight: false, {loads}}}
masses: {{from_loads: {{G: 1.0, Q: {{B: 0.3}}}}}}
"""
AREAS = "areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 2}]"
# a third of the bay goes to the beams along y; 4 kN/m2 x 2 m x 5 m / 2 = 20 kN, 4 x 4/3 x 5/2 = 13.33 kN in bay 2
POINTS = """beams: [
  {along: x, bays: 1, points: [{at: [1/3, 2/3], G: 20 kN, Q: 10 kN}], category: B},
  {along: x, bays: 2, points: [{at: [1.3333333333333333 m, 2.6666666666666667 m], G: 13.333333333333334 kN,
    Q: 6.666666666666667 kN}], category: B},
  {along: y, frames: A, G: 4 kN/m, Q: 2 kN/m, category: B},
  {along: y, frames: B, G: 6.666666666666667 kN/m, Q: 3.3333333333333335 kN/m, category: B},
  {along: y, frames: C, G: 2.6666666666666665 kN/m, Q: 1.3333333333333333 kN/m, category: B}]"""


def test_points_are_what_secondary_beams_bring(tmp_path: Path) -> None:
    """In a beam that braces meet in the middle too; within rounding of the thirds."""
    frames = []
    for loads in (AREAS, POINTS):
        (tmp_path / "b.yaml").write_text(TEXT.format(loads=loads))
        frames.append(space_frame(load_building(tmp_path / "b.yaml")))
    np.testing.assert_allclose(frames[1].node_mass, frames[0].node_mass, rtol=1e-12)
    for name in ("G", "Q_B"):
        first, second = (frame.cases[name] for frame in frames)
        np.testing.assert_allclose(second.uniform, first.uniform, rtol=1e-12)
        order = [np.lexsort((case.point_position, case.point_member)) for case in (first, second)]
        for key in ("point_member", "point_position", "point_force"):
            values = (getattr(case, key)[rows] for case, rows in zip((first, second), order, strict=True))
            np.testing.assert_allclose(*values, rtol=1e-12)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        ("along: x, points: [{at: 4.5 m, G: 1 kN}]", "loads.beams[0].points[0].at: 4.5 m is not inside a beam of 4 m"),
        ("along: x, points: [{at: [0.5, 1], G: 1 kN}]", "loads.beams[0].points[0].at[1]: 100 % is not inside"),
        ("along: x, points: [{at: 0.5, Q: 1 kN}]", "loads.beams[0].category: this key is missing"),
        ("along: x, points: [{at: 0.5, Q: -1 kN}], category: B", "loads.beams[0].points[0].Q: a variable load acts"),
        ("along: x, points: [{at: 0.5, G: 1 kPa}]", "loads.beams[0].points[0].G:"),
        ("along: x, points: [{at: 0.5, G: 1e9 kN}]", "loads.beams[0].points[0].G:"),
    ],
)
def test_wrong_points_are_refused_with_their_place(load: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "b.yaml").write_text(TEXT.format(loads=f"beams: [{{{load}}}]"))
    with pytest.raises(InputError) as caught:
        load_building(tmp_path / "b.yaml")
    assert words in str(caught.value)
