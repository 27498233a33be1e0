"""Dampers in the elevations of a building's frames, by their names."""

from __future__ import annotations

import pytest
from building_examples import DAMPED, ISOLATED, building

from edesign.report.drawing.building_drawing import BuildingElevation, damper_bay
from edesign.report.drawing.style import new_figure


@pytest.mark.parametrize(
    ("name", "lines"),
    [
        ("VX_2_1_1", [((0, 0), (3, 4)), ((6, 0), (3, 4))]),
        ("VX_2_1_1_2", [((0, 0), (3, 4)), ((6, 0), (3, 4))]),  # a second one at the place
        ("VX_2_2_2_r", [((6, 4), (8, 7))]),
        ("VX_2_2_2_f_2", [((8, 7), (10, 4))]),
        ("RX_2_2_1", [((6, 0), (10, 4))]),
        ("FX_2_2_1", [((6, 4), (10, 0))]),
        ("SX_2_1_2", [((3, 4), (3, 7))]),
        ("VX_2_3_1", []),  # there are two bays
        ("VX_1_1_1", []),  # of another frame
        ("N_A1.0_B2.1", []),
    ],
)
def test_dampers_are_drawn_where_they_stand(name: str, lines: list[tuple[tuple[float, float], ...]]) -> None:
    """Bays of 6 and 4 m, storeys of 4 and 3 m."""
    elevation = BuildingElevation(building(DAMPED), "X2")
    _, [[axes]] = new_figure(1, 1, 2.0, 2.0)
    elevation.draw(axes, ())
    bare = len(axes.lines)
    _, [[axes]] = new_figure(1, 1, 2.0, 2.0)
    elevation.draw(axes, (name,))
    added = [line for line in axes.lines if line.get_linewidth() == 1.4]
    assert len(axes.lines) == bare + len(lines)
    assert [tuple(zip(*line.get_data(), strict=True)) for line in added] == [tuple(line) for line in lines]


def test_names_of_dampers_in_bays() -> None:
    assert damper_bay("RY_A_2_1") == ("R", "Y", "A", 2, 1, "")
    assert damper_bay("N_A1.0_B2.1") is None


@pytest.mark.parametrize(("frame", "isolators", "beside"), [("X1", 3, 1), ("X2", 3, 0), ("YB", 3, 0)])
def test_isolators_stand_in_place_of_supports(frame: str, isolators: int, beside: int) -> None:
    """Nine isolators, and dashpots along x at A1 and C3; the same building on its supports is fixed."""
    elevation = BuildingElevation(building(ISOLATED), frame)
    signs = []
    for isolated in (True, False):
        _, [[axes]] = new_figure(1, 1, 2.0, 2.0)
        elevation.draw(axes, (), isolated)
        signs.append([str(line.get_marker()) for line in axes.lines])
    assert [signs[0].count(sign) for sign in "sD_"] == [isolators, beside, isolators]
    assert [signs[1].count(sign) for sign in "sD_"] == [3, 0, 0]
