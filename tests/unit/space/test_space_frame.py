"""Space frames of buildings: equilibrium of every load case, mirrored plans, members and supports."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import IRREGULAR, SMALL, building

from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.project.building import Building
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.check import check_building, floor_loads
from edesign.space.structure.frame import NO_DIAPHRAGM, RIGID, Member, SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.load_cases import on_members, on_nodes

THESIS = Path(__file__).parents[3] / "projects" / "thesis_building"
ROUNDING = 1e-11  # relative, of sums over some hundred loads


def member(frame: SpaceFrame, name: str) -> Member:
    return next(item for item in frame.members if item.name == name)


def whole(frame: SpaceFrame, case: str) -> float:
    """The resultant of a case, N downwards: nodes and members, before anything is lumped."""
    loads = frame.cases[case]
    assert not loads.nodal[:, [0, 1, 3, 4, 5]].any() and not loads.uniform[:, :2].any()
    return -float(loads.nodal[:, 2].sum() + on_members(frame, loads)[:, 2].sum())


def test_every_case_of_a_building_with_setbacks_carries_its_areas_and_lines() -> None:
    """Areas by hand: floor 1 18 x 12 m, floor 2 13 x 12 + 5 x 4 m, floor 3 6 x 12 m; both perimeters are 60 m long."""
    frame = space_frame(building(IRREGULAR))
    assert whole(frame, "G") == pytest.approx(1e3 * (216 * 5 + 176 * 4 + 72 * 3 + 2 * 60 * 1.5 + 3 * 20), rel=ROUNDING)
    assert whole(frame, "Q_B") == pytest.approx(1e3 * 176 * 3, rel=ROUNDING)
    assert whole(frame, "Q_C") == pytest.approx(1e3 * (216 * 5 + 8 * 7), rel=ROUNDING)
    assert whole(frame, "Q_snow") == pytest.approx(1e3 * 72 * 0.8, rel=ROUNDING)
    assert {name: case.category for name, case in frame.cases.items()} == {
        **{"G": "permanent", "self_weight": "permanent"},
        **{"Q_B": "B", "Q_C": "C", "Q_snow": "snow"},
    }


def test_floors_carry_their_own_loads() -> None:
    loads = floor_loads(space_frame(building(IRREGULAR)))
    assert loads["G"] / 1e3 == pytest.approx([0.0, 1230.0, 794.0, 216.0], rel=ROUNDING, abs=1e-9)
    assert loads["Q_C"] / 1e3 == pytest.approx([0.0, 1136.0, 0.0, 0.0], rel=ROUNDING, abs=1e-9)


@pytest.mark.parametrize("spans", ["x", "y", "two_way", "x, secondary_beams: 2", "y, secondary_beams: 3"])
def test_loads_of_each_span_have_the_total_and_the_centre_of_their_area(spans: str) -> None:
    """A uniform load on one bay of 4 x 5 m acts at its middle (8, 2.5) m."""
    areas = f"areas: [{{floors: 2, bays: {{x: 2, y: 1}}, Q: 2 kN/m^2, category: B, spans: {spans}}}]"
    changed = building(SMALL, ("areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]", areas))
    frame = space_frame(changed)
    forces = -on_nodes(frame, frame.cases["Q_B"])[:, 2]
    assert forces.sum() == pytest.approx(2e3 * 20.0, rel=ROUNDING)
    centre = forces @ frame.coordinates / forces.sum()
    assert centre == pytest.approx([8.0, 2.5, 7.0], rel=ROUNDING)


def test_self_weight_is_that_of_the_sections() -> None:
    """Columns HEB200 78.1 cm2, IPE300 53.8, IPE240 39.1 cm2 (EN 10365); tubes pi (D - t) t; 7850 kg/m3."""
    frame = space_frame(building(SMALL))
    tube = np.pi * 0.0966 * 0.005
    braces = tube * 4 * (np.hypot(5.0, 4.0) + np.hypot(5.0, 3.0))
    volume = 78.1e-4 * 9 * 7.0 + 53.8e-4 * 2 * 3 * 10.0 + 39.1e-4 * 2 * 3 * 10.0 + braces
    # areas of tables have three digits
    assert whole(frame, "self_weight") == pytest.approx(volume * 7850.0 * STANDARD_GRAVITY, rel=1e-3)
    without = space_frame(building(SMALL, ("spans: x}]\n", "spans: x}]\n  self_weight: false\n")))
    assert set(without.cases) == {"G", "Q_B"}


def mirrored(frame: SpaceFrame, length: float) -> dict[tuple[float, ...], tuple[float, ...]]:
    """What the nodes carry of each case and their mass, by their place in the mirrored plan."""
    loads = np.column_stack([on_nodes(frame, frame.cases[name])[:, 2] for name in sorted(frame.cases)])
    values = np.column_stack([loads, frame.node_mass])
    places = frame.coordinates * (-1.0, 1.0, 1.0) + (length, 0.0, 0.0)
    return {tuple(np.round(p, 6)): tuple(v) for p, v in zip(places, values, strict=True)}


def test_a_mirrored_plan_has_mirrored_loads_and_masses() -> None:
    small = ("plan: {x: [6 m, 4 m]", "plan: {x: [4 m, 6 m]")
    left = "areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x}]"
    setback = "areas: [{floors: 1, bays: {x: %d, y: all}, G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: two_way}]"
    here = mirrored(space_frame(building(SMALL, (left, setback % 1))), 10.0)
    there = space_frame(building(SMALL, small, (left, setback % 2)))
    loads = np.column_stack([on_nodes(there, there.cases[name])[:, 2] for name in sorted(there.cases)])
    for place, values in zip(there.coordinates, np.column_stack([loads, there.node_mass]), strict=True):
        assert here[tuple(np.round(place, 6))] == pytest.approx(values, rel=ROUNDING, abs=1e-9)


def test_members_of_a_small_building() -> None:
    frame = space_frame(building(SMALL))
    column, beam, brace = (member(frame, name) for name in ("C_B2_1", "BY_C_2_2", "DY_A_1_2_r"))
    assert (frame.node_names[column.start], frame.node_names[column.end]) == ("B2.0", "B2.1")
    assert column.frame == ("X2", "YB") and column.web == (1.0, 0.0, 0.0) and column.ends == (RIGID,) * 4
    assert (frame.node_names[beam.start], frame.node_names[beam.end]) == ("C2.2", "C3.2")
    assert (beam.frame, beam.bay, beam.storey, beam.web) == (("YC",), 2, 2, (0.0, 0.0, 1.0))
    assert beam.ends == (0.0,) * 4 and beam.group == "BY2"
    assert (frame.node_names[brace.start], frame.node_names[brace.end]) == ("A1.1", "A2.2")
    assert brace.axial_only and not brace.compression
    assert frame.fixed[:9].all() and not frame.fixed[9:].any() and not frame.springs.any()
    assert list(frame.node_diaphragm) == [NO_DIAPHRAGM] * 9 + [0] * 9 + [1] * 9
    assert frame.node_mass[:9].sum() == 0.0


def test_webs_are_at_right_angles_to_the_members() -> None:
    frame = space_frame(building(IRREGULAR))
    for item in frame.members:
        axis = frame.coordinates[item.end] - frame.coordinates[item.start]
        assert np.dot(axis, item.web) == pytest.approx(0.0, abs=1e-12 * np.linalg.norm(axis))
        assert np.linalg.norm(item.web) == pytest.approx(1.0, rel=1e-12)


def test_members_of_a_building_with_chevrons_and_springs() -> None:
    frame = space_frame(building(IRREGULAR))
    first, second = member(frame, "BY_A_2_2_1"), member(frame, "BY_A_2_2_2")
    rising, falling = member(frame, "DY_A_2_2_r"), member(frame, "DY_A_2_2_f")
    middle = frame.node_names.index("BY_A_2_2")
    assert first.end == second.start == rising.end == falling.end == middle
    assert list(frame.coordinates[middle]) == [0.0, 8.0, 8.5] and frame.node_diaphragm[middle] == 1
    assert first.ends == (0.0, 0.0, RIGID, RIGID) and second.ends == (RIGID, RIGID, 0.0, 0.0)
    v = member(frame, "DY_A_2_3_r")
    assert (v.start, frame.node_names[v.end]) == (middle, "A3.3") and v.compression
    assert member(frame, "BX_2_1_1").ends == (40e6, RIGID, RIGID, RIGID)
    assert member(frame, "DY_C_1_1_r").compression and member(frame, "DY_C_1_2_f").compression
    assert "DY_C_1_1_f" not in {item.name for item in frame.members}
    spring = frame.node_names.index("D1.0")
    assert list(frame.fixed[spring]) == [True, True, False, False, False, True]
    assert list(frame.springs[spring]) == [0.0, 0.0, 400e6, 30e6, 0.0, 0.0]
    assert list(frame.fixed[frame.node_names.index("C2.0")]) == [True, True, True, False, False, True]
    assert "B2.0" not in frame.node_names  # its column is missing
    assert member(frame, "C_C3_1").group == "tubes" and member(frame, "C_C3_1").web == (0.0, 1.0, 0.0)
    assert {item.name for item in frame.members if item.name.startswith("C_") and item.storey == 3} == {
        f"C_{x}{y}_3" for x in "AB" for y in (1, 2, 3)
    }


def test_points_on_halves_of_a_beam_keep_their_moments() -> None:
    """The halves carry what the whole beam carries: the same force and the same moment about its start."""
    plain = IRREGULAR.replace("bays: 2, storeys: 1-2, kind: chevron", "bays: 2, storeys: 1-2, kind: cross")
    plain = plain.replace("bays: 2, storeys: 3, kind: v", "bays: 2, storeys: 3, kind: cross")
    split, one = space_frame(building(IRREGULAR)), space_frame(building(plain))
    for case in ("G", "Q_C"):
        moments = []
        for frame in (split, one):
            loads = frame.cases[case]
            y = frame.coordinates[:, 1]
            names = [item.name for item in frame.members]
            ends = np.array([[y[item.start], y[item.end]] for item in frame.members])
            chosen = np.array([name.startswith("BY_A_2_1") for name in names])
            total = (loads.uniform[:, 2] * frame.length * ends.mean(axis=1))[chosen].sum()
            place = (
                ends[loads.point_member] @ (1.0, 0.0) + loads.point_position * np.diff(ends[loads.point_member])[:, 0]
            )
            total += (loads.point_force[:, 2] * place)[chosen[loads.point_member]].sum()
            middle = [i for i, name in enumerate(frame.node_names) if name == "BY_A_2_1"]
            moments.append(total + (loads.nodal[middle, 2] * y[middle]).sum())
        assert moments[0] == pytest.approx(moments[1], rel=ROUNDING)


def test_masses_are_those_of_the_loads() -> None:
    """EN 1998-1, 3.2.4: G + phi psi_2 Q; phi 0.8; psi_2 0.3 for B, 0.6 for C, 0 for snow."""
    frame = space_frame(building(IRREGULAR))
    loads = floor_loads(frame)
    wanted = loads["G"] + loads["self_weight"] + 0.8 * (0.3 * loads["Q_B"] + 0.6 * loads["Q_C"])
    mass = [frame.node_mass[np.isclose(frame.coordinates[:, 2], level)].sum() for level in frame.levels]
    assert mass == pytest.approx([0.0, *wanted[1:] / STANDARD_GRAVITY], rel=ROUNDING)


def test_given_masses_and_none() -> None:
    given = "masses: {given: [{floors: 1, mass: 5 t}, {at: A1-B2, floors: 2, mass: 3 t}]}"
    frame = space_frame(building(SMALL, ("masses: {from_loads: {}}", given)))
    assert frame.node_mass.sum() == pytest.approx(9 * 5e3 + 4 * 3e3)
    assert frame.node_mass[frame.node_names.index("B2.2")] == 3e3


def test_loads_upwards_give_no_negative_mass() -> None:
    up = ("spans: x}]\n", "spans: x}]\n  nodes: [{at: A1, floors: 2, G: -500 kN}]\n")
    with pytest.raises(InputError, match=r"building.yaml:15:22: masses.from_loads: node A1.2 .*E-MASS-01"):
        space_frame(building(SMALL, up))


def test_floors_without_a_diaphragm() -> None:
    frame = space_frame(building(SMALL, ("columns: [", "diaphragms: 2\ncolumns: [")))
    assert set(frame.node_diaphragm[:18]) == {NO_DIAPHRAGM} and set(frame.node_diaphragm[18:]) == {0}


@pytest.fixture(scope="module")
def thesis() -> Building:
    return load_building(THESIS / "table_5_2.yaml")


def test_the_thesis_building_has_the_masses_of_table_5_1(thesis: Building) -> None:
    """622.08 m2 x (4.5 + 0.3 x 2) + 100.8 m x 1.2 kN/m, columns 171.1 kg/m, beams 77.6 and 57.1 kg/m, braces 58.8 kg/m
    (EN 10365, EN 10210-2; masses with three digits); a prototype of its own has 362.9 t without the braces."""
    frame = space_frame(thesis)
    floor = 1e3 * (622.08 * 5.1 + 100.8 * 1.2) / STANDARD_GRAVITY
    steel = 20 * 3.5 * 171.1 + 16 * 7.2 * 77.6 + 15 * 7.2 * 57.1
    braces = 6 * np.hypot(7.2, 3.5) * 58.8
    mass = frame.node_mass[np.isclose(frame.coordinates[:, 2], 3.5)].sum()
    assert mass == pytest.approx(floor + steel + braces, rel=5e-4)
    assert mass - braces == pytest.approx(362.9e3, rel=5e-4)
    assert whole(frame, "G") == pytest.approx(10e3 * (622.08 * 4.5 + 100.8 * 1.2), rel=ROUNDING)
    assert whole(frame, "Q_B") == pytest.approx(10e3 * 622.08 * 2.0, rel=ROUNDING)


def test_check_reports_floors_and_groups(thesis: Building) -> None:
    found = check_building(thesis)
    assert found["plan"] == "4 bays along x, 28.8 m, 3 bays along y, 21.6 m"
    assert found["members"].splitlines()[0] == "C1: 80 columns HEB450 S275"
    assert found["loads"].splitlines()[0] == "floors 1-3: G 2920.3 kN, self_weight 293.3 kN, Q_B 1244.2 kN"
    assert "warnings" not in found
    larger = thesis.with_values("columns[2].section", "HEB400")
    assert check_building(larger)["warnings"].startswith("columns are larger than those below them: `C_A1_8`, ")
