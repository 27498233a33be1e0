"""Building files: what is read of them, other values, files of other kinds, files with random mistakes."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import pytest
import yaml
from building_examples import ANALYSED, DAMPED, IRREGULAR, SMALL, building
from messages import says
from spoiled_files import ODD, spoiled
from unit.project.test_other_hazards import ASCE, EACH, NTC, USER

from edesign.errors import InputError
from edesign.file_kinds.kinds import BUILDING
from edesign.file_kinds.recognise import kind_of
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_project
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.analysis.analyses import PushoverAnalysis
from edesign.project.building import Building, parse_building
from edesign.project.building.loads import Combination
from edesign.project.building.names import ColumnLine
from edesign.project.building.places import parse_column_lines
from edesign.project.dampers.dampers import BraceSection
from edesign.project.dampers.device_names import devices_by_name
from edesign.project.frame.materials import BilinearMaterial, MenegottoPintoMaterial
from edesign.project.notation.axes import PLAIN_AXES
from edesign.project.notation.frames import parse_frames
from edesign.project.notation.names import member_kind, storey_of
from edesign.space.check import check_building
from edesign.space.elastic_design import elastic_design
from edesign.space.structure.masses import gravity_factor

THESIS = Path(__file__).parents[3] / "projects" / "thesis_building"


def test_a_small_building() -> None:
    small = building(SMALL)
    assert (small.n_bays("x"), small.n_bays("y"), small.n_storeys) == (2, 2, 2)
    assert small.coordinates("x") == (0.0, 6.0, 10.0) and small.levels == (0.0, 4.0, 7.0)
    assert len(small.layout.column_at) == 18 and len(small.layout.beam_at) == 24 and len(small.layout.brace_at) == 4
    assert [run.group for run in (*small.columns, *small.beams, *small.braces)] == ["C1", "BX1", "BY2", "D1"]
    steel = small.materials["S275"]
    assert (steel.E, steel.fy, steel.nu, steel.density) == (210e9, 275e6, 0.3, 7850.0)
    assert small.design is not None and small.design.systems.y.q == "table" and small.design.damping == 0.05
    assert small.design.partial_factors.G == 1.35 and small.design.members.interaction == "annex_b"
    assert small.design_level == "DBE" and small.design.drift.limit == "ductile" and small.design.modes == "auto"
    assert small.checksum == building(SMALL).checksum


def test_a_building_with_analyses() -> None:
    found = building(ANALYSED)
    steel = found.steels["S275"]
    assert isinstance(steel, MenegottoPintoMaterial)
    assert (steel.E, steel.fy, steel.hardening, steel.R0, steel.cR1, steel.cR2) == (
        210e9,
        275e6,
        0.01,
        20.0,
        0.925,
        0.15,
    )
    assert found.fibres.half_flange == 3
    assert found.elements.integration_points == 4 and found.elements.geometry.braces == "linear"
    assert found.masses is not None and found.masses.directions == "both"
    assert [analysis.kind for analysis in found.analyses] == ["gravity", "modal", "pushover", "history"]
    push = found.analyses[2]
    assert isinstance(push, PushoverAnalysis) and push.directions == ("x+", "x-", "y+", "y-")
    assert found.largest_drift is None, "corotational columns"
    assert found.archive_path.name == "shaken.h5"
    assert list(found.hazard_levels) == ["DBE"] and found.fitted_level("far") is None
    changed = found.with_folders([Path("motions")]).with_values("materials.S275.law", "bilinear")
    assert changed.steels["S275"].law == "bilinear" and changed.suite_folders


def test_what_a_building_without_the_blocks_has() -> None:
    found = building(SMALL)
    assert found.steels["S275"] == BilinearMaterial.model_construct(law="bilinear", E=210e9, fy=275e6, hardening=0.0)
    assert found.masses is not None and found.masses.directions == "horizontal"
    assert found.loads.gravity == Combination() and not found.analyses and found.archive_path.name == "building.h5"


def test_a_building_with_dampers() -> None:
    """Dampers in place of a chevron's braces halve the beams above them, with the dampers and without."""
    found = building(DAMPED)
    dampers = found.dampers
    assert dampers is not None
    names = list(devices_by_name(found.grid, dampers))
    assert names[:4] == ["VX_2_1_1_r", "VX_2_1_1_f", "VX_2_1_2_r", "VX_2_1_2_f"]
    assert names[4:] == ["RY_A_2_1", "RY_C_2_1", "N_A1.0_B2.1"]
    brace = dampers.devices[1].brace
    assert isinstance(brace, BraceSection) and brace.section == "SHS120x8"
    halves = {"BX_2_1_1_1", "BX_2_1_1_2", "BX_2_1_2_1", "BX_2_1_2_2"}
    for one in (found, found.with_dampers(dampers), found.with_dampers(None), found.with_dampers(None).afresh()):
        assert halves <= set(one.grid.members) and one.grid.nodes["BX_2_1_2"] == (3.0, 5.0, 7.0)
    other = found.with_dampers(dampers.model_copy(update={"devices": dampers.devices[1:]}))
    assert not halves & set(other.grid.members) and "BX_2_1_1" in other.grid.members


@pytest.mark.parametrize("hazard", [NTC.replace("  behaviour_factor: 3.9\n", ""), ASCE, USER, EACH])
def test_analyses_take_the_action_of_any_code(hazard: str) -> None:
    """A design takes two of them, and psi_2 is the recommended one of EN 1990, Table A1.1: 0.3 of offices."""
    found = building(SMALL[: SMALL.index("hazard:")] + hazard)
    assert len(found.hazard_levels) >= 2 and (found.design_hazard is None) == ("ntc-2018" not in hazard)
    assert check_building(found)["masses"] == check_building(building(SMALL))["masses"]
    assert gravity_factor(found, "B") == 0.3
    with pytest.raises(InputError) as caught:
        elastic_design(found)
    assert says(str(caught.value), "design E-KEY-02")


def test_members_by_name_on_a_grid() -> None:
    grid = building(SMALL.replace("kind: cross", "kind: chevron").replace("concentric_diagonal", "concentric_v")).grid
    assert (grid.n_storeys, grid.height, grid.storey_heights) == (2, 7.0, (4.0, 3.0))
    assert grid.lines == tuple(f"{letter}{number}" for letter in "ABC" for number in (1, 2, 3))
    assert grid.nodes["B3.1"] == (6.0, 10.0, 4.0) and grid.nodes["BY_A_1_2"] == (0.0, 2.5, 7.0)
    assert grid.line_place("B3") == (6.0, 10.0) and grid.node_name("B3", 1) == "B3.1" and len(grid.nodes) == 27 + 4
    assert grid.ends["C_B3_2"] == ("B3.1", "B3.2") and grid.ends["BX_2_1_1"] == ("A2.1", "B2.1")
    assert grid.ends["BY_A_1_2_1"] == ("A1.2", "BY_A_1_2") and grid.ends["BY_A_1_2_2"] == ("BY_A_1_2", "A2.2")
    assert grid.ends["DY_A_1_2_f"] == ("A2.1", "BY_A_1_2")
    assert list(grid.members) == list(grid.ends) and "BY_A_1_2" not in grid.members
    assert grid.members["BY_A_1_2_2"].section == "IPE240" and grid.members["DY_C_1_1_r"].section == "CHS101.6x5"
    assert {storey_of(name) for name in ("C_B3_2", "BX_2_1_2", "BY_A_1_2_1", "DY_A_1_2_f")} == {2}
    assert [member_kind(name) for name in ("C_B3_2", "BX_2_1_2", "DY_A_1_2_f")] == ["column", "beam", "brace"]


def test_a_building_with_setbacks() -> None:
    layout = building(IRREGULAR).layout
    assert {floor: len(panels) for floor, panels in layout.floors.items()} == {1: 6, 2: 5, 3: 2}
    corner = ColumnLine(3, 2, PLAIN_AXES)
    assert corner in layout.floor_lines[1] and corner not in layout.floor_lines[2]
    assert sum(count == 1 for count in layout.floor_edges[3].values()) == 6  # the perimeter of one bay by two


@pytest.mark.parametrize("name", ["building.yaml", "table_5_2.yaml"])
def test_the_thesis_building(name: str) -> None:
    thesis = load_building(THESIS / name)
    assert kind_of(THESIS / name) == BUILDING
    assert len(thesis.layout.column_at) == 200 and len(thesis.layout.brace_at) == 60
    assert thesis.design is not None and thesis.design.drift.limit == "none" and thesis.design.systems.x.q == 6.5
    check_building(thesis)


def test_other_spellings_of_sections() -> None:
    text = SMALL.replace("HEB200", "HE 200 B").replace("CHS101.6x5", "chs 101.6 × 5").replace("IPE240", "ipe 240")
    found = building(text)
    assert [run.section for run in (*found.columns, *found.beams)] == ["HEB200", "IPE300", "IPE240"]
    assert found.braces[0].section == "CHS101.6x5"
    found.check_unchanged()


def test_other_values() -> None:
    other = building(SMALL).with_values({"columns[0].section": "HEB260", "design.drift": "none", "storeys[1]": "3.2 m"})
    assert other.columns[0].section == "HEB260" and other.storey_heights == (4.0, 3.2)
    assert other.design is not None and other.design.drift.limit == "none"
    with pytest.raises(InputError, match=r"columns\[0\].section.*`HEB260`.*E-NAME-01"):
        other.with_values("columns[0].section", "HEB265")
    larger = tuple(run.model_copy(update={"section": "HEB300"}) for run in other.columns)
    assert other.layout.column_at[ColumnLine(0, 0, PLAIN_AXES), 1].section == "HEB260"
    copy = other.model_copy(update={"columns": larger})
    assert copy.layout.column_at[ColumnLine(0, 0, PLAIN_AXES), 1].section == "HEB300"
    assert other.model_copy(update={"storeys": (3.0, 4.0)}).storey_heights == (3.0, 4.0)
    copied = other.model_copy(update={"title": "x"})
    with pytest.raises(InputError, match="title.*E-EDIT-01"):
        copied.check_unchanged()


@pytest.mark.parametrize(
    ("written", "lines"),
    [
        ("all", "A1 A2 B1 B2 C1 C2"),
        ("B2", "B2"),
        ("B", "B1 B2"),
        (2, "A2 B2 C2"),
        ("A-B", "A1 A2 B1 B2"),
        ("B1-C2", "B1 B2 C1 C2"),
        (["A1", "C", "B2-B2"], "A1 B2 C1 C2"),
    ],
)
def test_selections_of_column_lines(written: Any, lines: str) -> None:
    assert " ".join(map(str, parse_column_lines(written).lines(3, 2, PLAIN_AXES))) == lines


@pytest.mark.parametrize("written", ["", "A1-B", "1-A", "A1-", "-", "a1", "A-B-C", None, True, 1.5, [], [[]], {}])
def test_what_is_no_selection_of_column_lines(written: Any) -> None:
    with pytest.raises(ValueError):
        parse_column_lines(written)


def test_selections_of_frames() -> None:
    assert [item.along for item in parse_frames(["X2", 1, "A-C", "YB"]).items] == ["x", "x", "y", "y"]
    assert parse_frames("X1-X3").numbers(4, PLAIN_AXES) == (0, 1, 2)
    assert parse_frames("all").numbers(2, PLAIN_AXES) == (0, 1)
    assert parse_frames("X").items[0].along == "y"  # the 24th line across x
    for wrong in ("XA", "Y2", "A-2", "3-", {}, None, 1.5, []):
        with pytest.raises(ValueError):
            parse_frames(wrong)


def test_files_of_other_kinds(tmp_path: Path) -> None:
    path = tmp_path / "building.yaml"
    path.write_text(SMALL, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_project(path)
    assert says(str(caught.value), f"{path}:1:1: edesign_building: `edesign: 1` `edesign run` E-FILE-05")
    project = tmp_path / "project.yaml"
    project.write_text("edesign: 1\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_building(project)
    assert says(str(caught.value), f"{project}:1:1: edesign: `edesign_building: 1` E-FILE-05")


@pytest.mark.parametrize("text", ["", "# nothing\n", "[]", "edesign_building", "- edesign_building: 1", "{", "a: [b"])
def test_files_that_are_no_building(tmp_path: Path, text: str) -> None:
    path = tmp_path / "building.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=str(path)):
        load_building(path)


MORE_ODD: tuple[Any, ...] = (
    *ODD,
    *("none", "rigid", "A1", "X1", "A-B", "-5 kN/m^2", "chevron", "v", "cross", "1e30 m", "1e-30 m", "3 kN*m"),
    *(2.5, [{}], {"x": 1}, {"start": "3 kN*m"}),
)


@pytest.mark.parametrize(
    "file", [SMALL, ANALYSED, DAMPED, IRREGULAR, (THESIS / "building.yaml").read_text(encoding="utf-8")]
)
def test_no_change_of_a_file_leads_to_anything_but_a_message(file: str) -> None:
    """Buildings with keys left out, values replaced, keys renamed (seeded): a frame of numbers, or a message."""
    whole = yaml.safe_load(file)
    sections = BuildingSections()
    refused = 0
    for seed in range(150):
        one = spoiled(whole, random.Random(seed), MORE_ODD, "floors")
        text = json.dumps(one, indent=1, ensure_ascii=False)  # YAML too
        try:
            found = parse_building(text, "building.yaml", sections)
            assert isinstance(found, Building)
            reported = check_building(found)
            assert "nan" not in reported["loads"] + reported["masses"], text
        except InputError as error:
            refused += 1
            assert str(error).startswith("building.yaml:"), text
    assert 90 < refused < 150  # some keys may be left out
