"""Building files that are wrong: every mistake has its place, what was seen, what is allowed, and the nearest name."""

from __future__ import annotations

import pytest
from building_examples import SMALL, building

from edesign.project.building import BuildingError


def faults(text: str) -> list[tuple[tuple[int, int], str]]:
    """Place and message of each problem of a building."""
    with pytest.raises(BuildingError) as caught:
        building(text)
    return [((p.mark.line, p.mark.column), str(p)) for p in caught.value.problems]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named, the rest of the line is the message
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
        (
            "columns: [",
            "supports: @roller\ncolumns: [",
            "supports: `roller` is unknown (allowed: `fixed`, `pinned`, or a mapping",
        ),
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
        ("CHS101.6x5", "@CHS101.6x60", "walls of 60 mm do not fit into 101.6 mm; sizes are `SHS200x10`"),
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
            "beams[1].ends: `hinged` is unknown; did you mean `pinned`? (an end is `rigid`, `pinned`, or has",
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
        ("from_loads: {}", "given: [{floors: 1-2, mass: 9 t}], @phi: 0.8", "phi reduces variable loads, which given"),
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
        ("code: ec8-2004", "code: @ntc-2018", "belong to the action of `ec8-2004`, not of `ntc-2018`"),
        ("code: ec8-2004", "code: @ec8-2005", "`ec8-2005` is unknown"),
        ("a_gR: 0.24 g,", "country: @annex.yaml, zone: 1,", "hazard.country: there is no file `annex.yaml`"),
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
        ("q: table", "q: table, @alpha_u_over_alpha_1: 1.1", "Table 6.2 has alpha_u / alpha_1 for moment frames alone"),
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
def test_each_mistake_is_reported_with_its_place(old: str, new: str, said: str) -> None:
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


def test_all_mistakes_are_reported_at_once() -> None:
    text = SMALL.replace("HEB200", "HEB201").replace("IPE240", "IPE241").replace("bays: 1, kind", "bays: 9, kind")
    assert len(faults(text)) == 3


def test_a_plan_beyond_the_limit_is_refused_before_it_is_laid_out() -> None:
    big = SMALL.replace("x: [6 m, 4 m]", "x: {count: 100, width: 6 m}").replace("count: 2", "count: 100")
    ((place, message),) = faults(big.replace("[4 m, 3 m]", "{count: 200, height: 3 m}"))
    assert place == (3, 1)
    assert message == "plan: plan and storeys have 2040200 places of columns; at most 50000 are read"


def test_own_sections_are_named_where_a_file_can_have_them() -> None:
    """A building has no own sections, and `none` of them would read as if it could."""
    ((_, message),) = faults(SMALL.replace("HEB200, mat", "HEB205, mat"))
    assert message.endswith("(`edesign sections` lists the catalogue)") and "own sections" not in message
