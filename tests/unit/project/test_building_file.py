"""Building files: what is read, and that every mistake has its place, what was seen, what is allowed."""

from __future__ import annotations

import copy
import json
import random
from pathlib import Path
from typing import Any

import pytest
import yaml
from building_examples import IRREGULAR, SMALL, building
from unit.project.test_study_file import ODD, _places

from edesign.building.building_file import load_building
from edesign.building.hollow import BuildingSections
from edesign.building.project_file import load_project
from edesign.errors import InputError
from edesign.project.building import Building, BuildingError, parse_building
from edesign.project.building.names import ColumnLine
from edesign.project.building.places import parse_column_lines, parse_frames
from edesign.project.yaml_file import file_kind
from edesign.space.check import check_building

THESIS = Path(__file__).parents[3] / "projects" / "thesis_building"


def faults(text: str) -> list[tuple[tuple[int, int], str]]:
    """Place and message of each problem of a building."""
    with pytest.raises(BuildingError) as caught:
        building(text)
    return [((p.mark.line, p.mark.column), str(p)) for p in caught.value.problems]


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


def test_a_building_with_setbacks() -> None:
    layout = building(IRREGULAR).layout
    assert {floor: len(panels) for floor, panels in layout.floors.items()} == {1: 6, 2: 5, 3: 2}
    assert ColumnLine(3, 2) in layout.floor_lines[1] and ColumnLine(3, 2) not in layout.floor_lines[2]
    assert sum(count == 1 for count in layout.floor_edges[3].values()) == 6  # the perimeter of one bay by two


@pytest.mark.parametrize("name", ["building.yaml", "table_5_2.yaml"])
def test_the_thesis_building(name: str) -> None:
    thesis = load_building(THESIS / name)
    assert file_kind(THESIS / name) == "building"
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
    assert other.columns[0].section == "HEB260" and other.heights == (4.0, 3.2)
    assert other.design is not None and other.design.drift.limit == "none"
    with pytest.raises(InputError, match="columns.0..section: there is no section `HEB265`"):
        other.with_values("columns[0].section", "HEB265")
    larger = tuple(run.model_copy(update={"section": "HEB300"}) for run in other.columns)
    assert other.layout.column_at[ColumnLine(0, 0), 1].section == "HEB260"
    assert other.model_copy(update={"columns": larger}).layout.column_at[ColumnLine(0, 0), 1].section == "HEB300"
    copied = other.model_copy(update={"title": "x"})
    with pytest.raises(InputError, match="title: this copy of the building has `x`"):
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
    assert " ".join(map(str, parse_column_lines(written).lines(3, 2))) == lines


@pytest.mark.parametrize(
    "written", ["", "A1-B", "1-A", "C-A", "B2-A3", "A0", "a1", "A-B-C", None, True, 1.5, [], [[]], {}]
)
def test_what_is_no_selection_of_column_lines(written: Any) -> None:
    with pytest.raises(ValueError):
        parse_column_lines(written)


def test_selections_of_frames() -> None:
    assert [item.along for item in parse_frames(["X2", 1, "A-C", "YB"]).items] == ["x", "x", "y", "y"]
    assert parse_frames("X1-X3").numbers(4) == (0, 1, 2) and parse_frames("all").numbers(2) == (0, 1)
    assert parse_frames("X").items[0].along == "y"  # the 24th line across x
    for wrong in ("XA", "Y2", "A-2", "3-1", {}, None, 1.5, []):
        with pytest.raises(ValueError):
            parse_frames(wrong)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is told, the rest of the line is the message
        (
            "edesign_building: 1",
            "edesign_building: @2",
            "format `2` is unknown to this version of edesign, which reads 1",
        ),
        ("  areas:", "  @aeras:", "loads.aeras: unknown key; did you mean `areas`?"),
        # plan
        ("count: 2, width: 5 m", "count: @0, width: 5 m", "plan.y.count: `0` is out of range: it must be at least 1"),
        ("[6 m, 4 m]", "@[]", "plan.x: the list is empty"),
        ("[6 m, 4 m]", "[6 m, @0 m]", "plan.x[1]: `0 m` must be greater than zero"),
        ("[4 m, 3 m]", "[4 m, @3]", "storeys[1]: the bare number `3` needs a unit"),
        (
            "columns: [",
            "setbacks: [{floors: @2-3, bays: all}]\ncolumns: [",
            "there is no floor 3; floors are numbered 1",
        ),
        ("columns: [", "setbacks: [{floors: 2, bays: {x: @3}}]\ncolumns: [", "there is no bay 3 along x; bays are num"),
        ("columns: [", "diaphragms: @3\ncolumns: [", "diaphragms: there is no floor 3"),
        # supports
        ("columns: [", "supports: {@A9: pinned}\ncolumns: [", "supports.A9: `A9`: column lines go from A1 to C3"),
        (
            "columns: [",
            "supports: {@a1: pinned}\ncolumns: [",
            "`a1` is no selection of column lines; write `all`, `A2`",
        ),
        ("columns: [", "supports: @roller\ncolumns: [", "supports: `roller` is unknown (allowed: `fixed`, `pinned`)"),
        (
            "columns: [",
            "supports: {A: {rx: @3 kN}}\ncolumns: [",
            "rx: a direction is `fixed`, `free`, or has a stiffness",
        ),
        # members
        (
            "HEB200, mat",
            "@HEB205, mat",
            "columns[0].section: there is no section `HEB205`; of HEB the catalogue has near",
        ),
        ("CHS101.6x5", "@CHS101.6x60", "hollow sections are written `SHS200x10`"),
        ("S275, strong", "@S355, strong", "columns[0].material: there is no material `S355` (materials here: `S275`)"),
        ("strong: x", "strong: @z", "columns[0].strong: `z` is unknown (allowed: `x`, `y`)"),
        (", strong: x}", ", strong: x, at: @D1}", "columns[0].at: `D1`: column lines go from A1 to C3"),
        (", strong: x}", ", strong: x, storeys: @1-3}", "columns[0].storeys: there is no storey 3"),
        (
            "@columns: [{section: HEB200, ",
            "@columns: [{storeys: 1, section: HEB200, ",
            "9 columns are without a section: `C",
        ),
        (
            "{along: x, section",
            "{along: x, frames: @A, section",
            "beams[0].frames: there is no frame `A` along x; they are",
        ),
        ("{along: x, section", "{along: x, frames: [1, @4], section", "there is no frame `4` along x; they are 1 to 3"),
        ("{along: x, section", "{along: x, frames: @X, section", "beams[0].frames: there is no frame `X` along x"),
        (
            "ends: pinned",
            "ends: @hinged",
            "beams[1].ends: an end is `rigid`, `pinned`, or has a stiffness: `hinged` is no r",
        ),
        (
            "ends: pinned",
            "ends: {start: @5 kN/m}",
            "ends.start: an end is `rigid`, `pinned`, or has a stiffness: `5 kN/m`",
        ),
        (
            "material: S275, ends",
            "material: S275, group: @BX1, ends",
            "the group `BX1` has IPE240 of S275 here, and IPE300",
        ),
        ("kind: cross", "kind: @corss", "braces[0].kind: `corss` is unknown; did you mean `cross`?"),
        ("bays: 1, kind", "bays: @3, kind", "braces[0].bays: there is no bay 3 along y"),
        (
            "kind: cross",
            "kind: chevron, compression: @false",
            "both braces of a chevron count, in tension and compression",
        ),
        (
            "  - {along: y, frames: [A, C], bays: 1, kind: cross",
            "  - @{along: y, frames: A, bays: 1, kind: v",
            "DY_A_1_1 needs the beam BY_A_1_0, at the base, where there is none",
        ),
        (
            "  - {along: y, frames: [A, C], bays: 1, kind: cross, section: CHS101.6x5, material: S275}",
            "  - @{along: y, frames: A, bays: 1, kind: cross, section: CHS101.6x5, material: S275}\n"
            "missing: {beams: [{along: y, frames: A, bays: 1, floors: 2}]}",
            "braces[0]: DY_A_1_2 needs the beam BY_A_1_2, which is missing",
        ),
        (
            "materials: {",
            "missing: {@columns: [{storeys: 2}]}\nmaterials: {",
            "storey 2 has no column: nothing carries flo",
        ),
        ("S275: {fy: 275 MPa}", "@S275: {E: 210 GPa}", "materials.S275.fy: this key is missing"),
        ("{fy: 275 MPa}", "{fy: 275 MPa, @law: elastic}", "materials.S275.law: unknown key"),
        # loads
        (
            "Q: 2 kN/m^2, category: B, ",
            "Q: 2 kN/m^2, ",
            "loads.areas[0].category: this key is missing; a variable load",
        ),
        ("category: B", "category: @I", "loads.areas[0].category: `I` is unknown (allowed: `A`, `B`"),
        ("spans: x", "spans: @z", "loads.areas[0].spans: `z` is unknown (allowed: `x`, `y`, `two_way`)"),
        ("spans: x", "spans: two_way, @secondary_beams: 2", "a floor on secondary beams spans one way"),
        ("G: 4 kN/m^2", "G: @4 kN/m", "is a force per length"),
        ("[{G: 4", "[{floors: 1, bays: {x: @3}, G: 4", "there is no bay 3 along x"),
        (
            "masses: {from",
            "missing: {beams: [{along: y, frames: B, bays: 1}]}\nmasses: {from",
            "loads.areas[0]: the floor rests on beams that are missing: `BY_B_1_1`, `BY_B_1_2`",
        ),
        ("  areas:", "  nodes: [{at: @D1, floors: 1}]\n  areas:", "`D1`: column lines go from A1 to C3"),
        ("  areas:", "  beams: [{along: y, floors: @3, G: 1 kN/m}]\n  areas:", "there is no floor 3"),
        # masses
        ("from_loads: {}", "from_loads: {}, given: []", "masses: give either `from_loads` or `given`, one of them"),
        (
            "from_loads: {}",
            "from_loads: {Q: @{A: 0.3}}",
            "masses.from_loads.Q: no factor for the category `B` of the loads",
        ),
        ("from_loads: {}", "from_loads: {Q: @-1}", "masses.from_loads.Q: `-1` is out of range"),
        (
            "from_loads: {}",
            "given: [{floors: 1, mass: @-3 t}]",
            "masses.given[0].mass: `-3 t` must be greater than zero",
        ),
        (
            "from_loads: {}",
            "given: [{floors: 1, mass: 3 t}, @{at: A, floors: 1, mass: 3 t}]",
            "got a mass in masses.given[0]",
        ),
        # hazard and design
        ("levels: {DBE", "@behaviour_factor: 4, levels: {DBE", "give `q` under design.systems"),
        (
            "{DBE: {probability: 10 %}}",
            "{DBE: {probability: 10 %}, MCE: {gamma_I: 2}}",
            "design.level: this key is missing; the hazard has the levels",
        ),
        (
            "ductility_class: medium",
            "ductility_class: medium\n  level: @DBF",
            "there is no level `DBF`; did you mean `DBE`?",
        ),
        ("ductility_class: medium", "ductility_class: @DCM", "`DCM` is unknown (allowed: `low`, `medium`, `high`)"),
        ("type: moment_frame", "type: @concentric_diagonal", "`concentric_diagonal`: along x no bay is braced"),
        ("type: concentric_diagonal", "type: @moment_frame", "`moment_frame`: along y there are braces"),
        ("q: 4", "q: @0.5", "design.systems.x.q: `0.5` is out of range: a ratio at least 1 is allowed"),
        (
            "ductility_class: medium",
            "ductility_class: medium\n  modes: @0",
            "a number of modes from 1 to 10000 is needed",
        ),
        ("ductility_class: medium", "ductility_class: medium\n  drift: {limit: @britle}", "did you mean `brittle`?"),
        ("masses: {from_loads: {}}\n", "", "design: a design needs `masses`, and the file has none"),
    ],
)
def test_each_mistake_is_told_with_its_place(old: str, new: str, said: str) -> None:
    old = old.replace("@", "")
    assert SMALL.count(old) == 1, old
    marked = SMALL.replace(old, new)
    text = marked.replace("@", "")
    ((place, message),) = faults(text)
    assert said in message
    if "@" in new:
        at = marked.index("@")
        assert place == (marked.count("\n", 0, at) + 1, at - marked.rfind("\n", 0, at))


PINNED = ("IPE300, material: S275}", "IPE300, material: S275, ends: pinned}")


def test_a_direction_without_resistance() -> None:
    ((_, message), *more) = faults(SMALL.replace(*PINNED))
    assert message == (
        "beams[0].ends: nothing resists along x in storey 2: all beams above and below are pinned and no bay of X1 to "
        "X3 is braced"
    )
    assert not more
    lower = SMALL.replace("bays: 1, kind", "bays: 1, storeys: 1, kind")  # the columns of storey 2 are cantilevers
    assert any("nothing resists along y in storey 2" in message for _, message in faults(lower))
    building(lower.replace("ends: pinned", "ends: {start: 20 MN*m/rad, end: pinned}"))


def test_a_hall_of_cantilever_columns_stands() -> None:
    hall = SMALL[: SMALL.index("hazard:")].replace("storeys: [4 m, 3 m]", "storeys: [4 m]").replace(*PINNED)
    assert building(hall).n_storeys == 1
    on_pins = faults(hall.replace("columns: [", "supports: pinned\ncolumns: ["))
    assert any("nothing resists along x in storey 1" in message for _, message in on_pins)


def test_a_column_that_stands_on_nothing() -> None:
    """A tower beside the floor below it: its far columns have neither column nor beam under them."""
    setback = "setbacks: [{floors: 1, bays: {x: 1, y: all}}]\ncolumns: ["
    messages = [message for _, message in faults(SMALL.replace("columns: [", setback))]
    assert any("nothing is below `C_C1_2`, `C_C2_2`, `C_C3_2`: no column and no beam" in m for m in messages)


def test_a_floor_in_parts_has_no_diaphragm() -> None:
    setback = "setbacks: [{floors: 2, bays: [{x: 1, y: 1}, {x: 2, y: 2}]}]\ncolumns: ["
    text = SMALL.replace("columns: [", setback).replace("ends: pinned", "ends: rigid")
    text = text.replace("bays: 1, kind", "bays: 1, storeys: 1, kind")
    ((place, message),) = faults(text)
    assert place == (5, 1)
    assert message == (
        "setbacks: floor 2 is in parts that do not touch, which one diaphragm would tie; leave it out of `diaphragms`"
    )
    assert building(text.replace("setbacks:", "diaphragms: 1\nsetbacks:")).diaphragms.ranges == ((1, 1),)


def test_loads_on_bays_that_a_floor_does_not_cover() -> None:
    """What is named one by one must be there; `all` takes what is."""
    text = SMALL.replace("columns: [", "setbacks: [{floors: 2, bays: [{x: 1, y: all}, {x: 2, y: 1}]}]\ncolumns: [")
    for bays, said in (
        ("{x: 2, y: 2}", "bay 2 along x, 2 along y"),
        ("{x: 1-2, y: 1-2}", "bay 2 along x, 2 along y"),
        ("{x: 2, y: all}", ""),
        ("all", ""),
    ):
        changed = text.replace("[{G: 4", f"[{{floors: 2, bays: {bays}, G: 4")
        if said:
            assert [m for _, m in faults(changed)] == [f"loads.areas[0].bays: floor 2 does not cover {said}"]
        else:
            building(changed)
    narrow = SMALL.replace("columns: [", "setbacks: [{floors: 2, bays: {x: 1, y: all}}]\ncolumns: [").replace(
        "C], b", "B], b"
    )
    for bays, said in (("{x: 2, y: all}", "bay 2 along x"), ("{x: all, y: 2}", "")):
        changed = narrow.replace("[{G: 4", f"[{{floors: 2, bays: {bays}, G: 4")
        assert (
            [m for _, m in faults(changed)] == [f"loads.areas[0].bays: floor 2 does not cover {said}"]
            if said
            else building(changed)
        )


def test_the_perimeter_needs_its_beams() -> None:
    hole = "perimeter: [{G: 1 kN/m}]\nmissing: {beams: [{along: x, frames: 1, bays: 2, floors: 2}]}\nmasses"
    text = SMALL.replace("masses", hole, 1).replace("perimeter", "  perimeter")
    ((_, message),) = faults(text)
    assert message == "loads.perimeter[0]: at the perimeter beams are missing: `BX_1_2_2`; give the others by `beams`"


def test_all_mistakes_are_told_at_once() -> None:
    text = SMALL.replace("HEB200", "HEB201").replace("IPE240", "IPE241").replace("bays: 1, kind", "bays: 9, kind")
    assert len(faults(text)) == 3


def test_a_plan_beyond_the_limit_is_refused_before_it_is_laid_out() -> None:
    big = SMALL.replace("x: [6 m, 4 m]", "x: {count: 100, width: 6 m}").replace("count: 2", "count: 100")
    ((place, message),) = faults(big.replace("[4 m, 3 m]", "{count: 200, height: 3 m}"))
    assert place == (3, 1)
    assert message == "plan: plan and storeys have 2040200 places of columns; at most 50000 are read"


def test_files_of_other_kinds(tmp_path: Path) -> None:
    path = tmp_path / "building.yaml"
    path.write_text(SMALL, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_project(path)
    expected = f"{path}:1:1: edesign_building: this is a building file; a project file begins with `edesign: 1`"
    assert str(caught.value) == expected
    project = tmp_path / "project.yaml"
    project.write_text("edesign: 1\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_building(project)
    assert str(caught.value).startswith(f"{project}:1:1: edesign: this is a project file; a building file begins with")


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


@pytest.mark.parametrize("text", [SMALL, IRREGULAR, (THESIS / "building.yaml").read_text(encoding="utf-8")])
def test_no_change_of_a_file_leads_to_anything_but_a_message(text: str) -> None:
    """Buildings with keys left out, values replaced, keys renamed (seeded): a frame of numbers, or a message."""
    whole = yaml.safe_load(text)
    sections = BuildingSections()
    refused = 0
    for seed in range(150):
        spoiled = json.dumps(_spoiled(whole, random.Random(seed)), indent=1, ensure_ascii=False)  # YAML too
        try:
            found = parse_building(spoiled, "building.yaml", sections)
            assert isinstance(found, Building)
            told = check_building(found)
            assert "nan" not in told["loads"] + told["masses"], spoiled
        except InputError as error:
            refused += 1
            assert str(error).startswith("building.yaml:"), spoiled
    assert 90 < refused < 150  # some keys may be left out


def _spoiled(whole: Any, rng: random.Random) -> Any:
    """One or two places changed."""
    spoiled = copy.deepcopy(whole)
    for _ in range(rng.choice((1, 1, 2))):
        places = list(_places(spoiled))
        if not places:
            break
        parent, key = rng.choice(places)
        how = rng.randrange(3)
        if how == 0:
            del parent[key]
        elif how == 1 or isinstance(parent, list):
            parent[key] = copy.deepcopy(rng.choice(MORE_ODD))
        else:
            parent[rng.choice(("x", "floors", str(key)[:-1]))] = parent.pop(key)
    return spoiled
