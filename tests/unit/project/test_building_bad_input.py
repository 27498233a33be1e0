"""Building files that are wrong: every mistake has its place, what was seen, what is allowed, and the nearest name."""

from __future__ import annotations

import pytest
from building_examples import ANALYSED, DAMPED, IRREGULAR, SMALL, building, changed
from messages import says

from edesign.project.building import BuildingError


def faults(text: str) -> list[tuple[tuple[int, int], str]]:
    """Place and message of each problem of a building."""
    with pytest.raises(BuildingError) as caught:
        building(text)
    return [((p.mark.line, p.mark.column), str(p)) for p in caught.value.problems]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # `@` marks the place that is named, the rest of the line is the message
        ("edesign_building: 1", "edesign_building: @2", "edesign_building E-FILE-05"),
        ("  areas:", "  @aeras:", "loads.aeras `areas` E-KEY-01"),
        # plan
        ("count: 2, width: 5 m", "count: @0, width: 5 m", "plan.y.count E-VALUE-02"),
        ("[6 m, 4 m]", "@[]", "plan.x E-VALUE-01"),
        ("[6 m, 4 m]", "[6 m, @0 m]", "plan.x[1] E-VALUE-02"),
        ("[4 m, 3 m]", "[4 m, @3]", "storeys[1] E-UNIT-01"),
        ("columns: [", "setbacks: [{floors: @2-3, bays: all}]\ncolumns: [", "setbacks[0].floors E-NAME-01"),
        ("columns: [", "setbacks: [{floors: 2, bays: {x: @3}}]\ncolumns: [", "setbacks[0].bays.x E-NAME-01"),
        ("columns: [", "diaphragms: @3\ncolumns: [", "diaphragms E-NAME-01"),
        # supports
        ("columns: [", "supports: {@A9: pinned}\ncolumns: [", "supports.A9 C3 E-NAME-01"),
        ("columns: [", "supports: {@a1: pinned}\ncolumns: [", "supports.a1 E-VALUE-01"),
        ("columns: [", "supports: @roller\ncolumns: [", "supports `fixed` `pinned` E-VALUE-03"),
        ("columns: [", "supports: {A: {rx: @3 kN}}\ncolumns: [", "supports.A.rx `fixed` `free` E-UNIT-02"),
        # members
        ("HEB200, mat", "@HEB205, mat", "columns[0].section `HEB200` E-NAME-01"),
        ("CHS101.6x5", "@CHS101.6x60", "braces[0].section 60 mm `SHS200x10` E-NAME-01"),
        ("S275, strong", "@S355, strong", "columns[0].material `S275` E-NAME-01"),
        ("strong: x", "strong: @z", "columns[0].strong `y` E-VALUE-03"),
        (", strong: x}", ", strong: x, at: @D1}", "columns[0].at C3 E-NAME-01"),
        (", strong: x}", ", strong: x, storeys: @1-3}", "columns[0].storeys E-NAME-01"),
        ("@columns: [{section: HEB200, ", "@columns: [{storeys: 1, section: HEB200, ", "columns 9 E-NAME-01"),
        ("{along: x, section", "{along: x, frames: @A, section", "beams[0].frames E-NAME-01"),
        ("{along: x, section", "{along: x, frames: [1, @4], section", "beams[0].frames[1] 1 to 3 E-NAME-01"),
        ("{along: x, section", "{along: x, frames: @X, section", "beams[0].frames E-NAME-01"),
        ("ends: pinned", "ends: @hinged", "beams[1].ends `pinned` `rigid` E-UNIT-02"),
        ("ends: pinned", "ends: {start: @5 kN/m}", "beams[1].ends.start `rigid` E-UNIT-02"),
        ("material: S275, ends", "material: S275, group: @BX1, ends", "beams[1].group IPE240 IPE300 E-BLDG-03"),
        ("kind: cross", "kind: @corss", "braces[0].kind `cross` E-VALUE-03"),
        ("bays: 1, kind", "bays: @3, kind", "braces[0].bays E-NAME-01"),
        ("kind: cross", "kind: chevron, compression: @false", "braces[0].compression E-BLDG-01"),
        (
            "  - {along: y, frames: [A, C], bays: 1, kind: cross",
            "  - @{along: y, frames: A, bays: 1, kind: v",
            "braces[0] DY_A_1_1 BY_A_1_0 E-BLDG-02",
        ),
        (
            "  - {along: y, frames: [A, C], bays: 1, kind: cross, section: CHS101.6x5, material: S275}",
            "  - @{along: y, frames: A, bays: 1, kind: cross, section: CHS101.6x5, material: S275}\n"
            "missing: {beams: [{along: y, frames: A, bays: 1, floors: 2}]}",
            "braces[0] DY_A_1_2 BY_A_1_2 E-BLDG-02",
        ),
        ("materials: {", "missing: {@columns: [{storeys: 2}]}\nmaterials: {", "missing.columns E-BLDG-02"),
        ("S275: {fy: 275 MPa}", "@S275: {E: 210 GPa}", "materials.S275.fy E-KEY-02"),
        ("{fy: 275 MPa}", "{fy: 275 MPa, law: @steel}", "materials.S275.law `bilinear` E-VALUE-03"),
        ("{fy: 275 MPa}", "{fy: 275 MPa, @R0: 20}", "materials.S275.R0 `bilinear` E-KEY-03"),
        ("{fy: 275 MPa}", "{fy: 275 MPa, law: elastic, @hardening: 0.01}", "materials.S275.hardening E-KEY-03"),
        # loads
        ("Q: 2 kN/m^2, category: B, ", "Q: 2 kN/m^2, ", "loads.areas[0].category E-KEY-02"),
        ("category: B", "category: @I", "loads.areas[0].category `A` E-VALUE-03"),
        ("spans: x", "spans: @z", "loads.areas[0].spans `y` `two_way` E-VALUE-03"),
        ("spans: x", "spans: two_way, @secondary_beams: 2", "loads.areas[0].secondary_beams E-LOAD-02"),
        ("G: 4 kN/m^2", "G: @4 kN/m", "loads.areas[0].G force length E-UNIT-02"),
        ("[{G: 4", "[{floors: 1, bays: {x: @3}, G: 4", "loads.areas[0].bays.x E-NAME-01"),
        (
            "masses: {from",
            "missing: {beams: [{along: y, frames: B, bays: 1}]}\nmasses: {from",
            "loads.areas[0] `BY_B_1_1` `BY_B_1_2` E-BLDG-02",
        ),
        ("  areas:", "  nodes: [{at: @D1, floors: 1}]\n  areas:", "loads.nodes[0].at C3 E-NAME-01"),
        ("  areas:", "  beams: [{along: y, floors: @3, G: 1 kN/m}]\n  areas:", "loads.beams[0].floors E-NAME-01"),
        # masses
        ("from_loads: {}", "from_loads: {}, given: []", "masses E-KEY-03"),
        ("from_loads: {}", "from_loads: {Q: @{A: 0.3}}", "masses.from_loads.Q `B` E-KEY-02"),
        ("from_loads: {}", "given: [{floors: 1-2, mass: 9 t}], @phi: 0.8", "masses.phi E-KEY-03"),
        ("from_loads: {}", "from_loads: {Q: @-1}", "masses.from_loads.Q E-VALUE-02"),
        ("from_loads: {}", "given: [{floors: 1, mass: @-3 t}]", "masses.given[0].mass E-VALUE-02"),
        (
            "from_loads: {}",
            "given: [{floors: 1, mass: 3 t}, @{at: A, floors: 1, mass: 3 t}]",
            "masses.given[1] masses.given[0] E-NAME-02",
        ),
        # hazard and design
        (
            "{code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}",
            "{code: @asce7-16, S_DS: 1 g, S_D1: 0.6 g, T_L: 8 s, levels: {DBE: {earthquake: DE}}}",
            "hazard.code `ec8-2004` `asce7-16` E-HAZ-03",
        ),
        ("code: ec8-2004", "code: @ec8-2005", "hazard.code E-VALUE-03"),
        ("a_gR: 0.24 g,", "country: @annex.yaml, zone: 1,", "hazard.country E-FILE-01"),
        ("levels: {DBE", "@behaviour_factor: 4, levels: {DBE", "hazard.behaviour_factor `q` E-BLDG-01"),
        ("{DBE: {probability: 10 %}}", "{DBE: {probability: 10 %}, MCE: {gamma_I: 2}}", "design.level E-KEY-02"),
        ("ductility_class: medium", "ductility_class: medium\n  level: @DBF", "design.level `DBE` E-NAME-01"),
        ("ductility_class: medium", "ductility_class: @DCM", "design.ductility_class `low` `high` E-VALUE-03"),
        ("type: moment_frame", "type: @concentric_diagonal", "design.systems.x.type E-BLDG-01"),
        ("type: concentric_diagonal", "type: @moment_frame", "design.systems.y.type E-BLDG-01"),
        ("q: table", "q: table, @alpha_u_over_alpha_1: 1.1", "design.systems.y.alpha_u_over_alpha_1 E-BLDG-01"),
        ("q: 4", "q: @0.5", "design.systems.x.q E-VALUE-02"),
        ("ductility_class: medium", "ductility_class: medium\n  modes: @0", "design.modes 1 to 10000 E-VALUE-01"),
        (
            "ductility_class: medium",
            "ductility_class: medium\n  drift: {limit: @britle}",
            "design.drift.limit `brittle` E-VALUE-03",
        ),
        ("masses: {from_loads: {}}\n", "", "design E-MODAL-02"),
    ],
)
def test_each_mistake_is_reported_with_its_place(old: str, new: str, said: str) -> None:
    _is_reported(SMALL, old, new, said)


def _is_reported(whole: str, old: str, new: str, said: str) -> None:
    old = old.replace("@", "")
    assert whole.count(old) == 1, old
    marked = whole.replace(old, new)
    text = marked.replace("@", "")
    ((place, message),) = faults(text)
    assert says(message, said)
    if "@" in new:
        at = marked.index("@")
        assert place == (marked.count("\n", 0, at) + 1, at - marked.rfind("\n", 0, at))


PINNED = ("IPE300, material: S275}", "IPE300, material: S275, ends: pinned}")


SHAKEN = "kind: history, record: far"
FOOT = "columns: [{s"
FOOT_ON = (
    "soils: {sand: {density: 1900 kg/m^3, shear_wave_velocity: 180 m/s, poisson: 0.3, damping: 5 %}}\n"
    "supports: {default: {footing: {soil: sand, length: 2 m, width: 2 m, embedment: 0.5 m}}}\ncolumns: [{s"
)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # as above, of a building with analyses
        ("half_flange: 3", "half_flange: @1", "fibres.half_flange E-VALUE-02"),
        ("half_flange: 3", "@flange_width: 16", "fibres.flange_width E-KEY-01"),
        ("integration_points: 4", "integration_points: @1", "elements.integration_points E-VALUE-02"),
        (", periods: [1.0 s, 0.1 s]", "", "damping.modes `periods` E-KEY-02"),
        ("periods: [1.0 s, 0.1 s]", "modes: @[2, 2]", "damping.modes 2 E-VALUE-04"),
        ("damping: {kind: rayleigh, ratio: 2 %, periods: [1.0 s, 0.1 s]}\n", "", "analyses[3] `damping` E-KEY-02"),
        ("integration: {method: newmark, time_step: 0.01 s}\n", "", "analyses[3] `integration` E-KEY-02"),
        ("method: newmark", "method: @newmrak", "integration.method `newmark` E-VALUE-03"),
        ("record: farfield/1/a", "record: @far/1/a", "records.far.record E-VALUE-01"),
        (SHAKEN, "kind: history, record: @fra", "analyses[3].record `far` E-NAME-01"),
        (SHAKEN, "kind: @histroy, record: far", "analyses[3].kind `history` E-VALUE-03"),
        ("level: DBE", "level: @MCE", "analyses[3].level `DBE` E-NAME-01"),
        ("name: shaken", "name: @modes", "analyses[3].name analyses[1] E-NAME-02"),
        ("pga: 0.3 g", "pga: 0.3 g, @scale: 2", "analyses[3].scale E-KEY-03"),
        (
            "vertical: {ratio: 0.7}",
            "wave_passage: {velocity: 500 m/s, direction: @right}",
            "analyses[3].wave_passage.direction E-VALUE-03",
        ),
        ("vertical: {ratio: 0.7}", "@wave_passage: {}", "analyses[3].wave_passage `velocity` `delays` E-KEY-03"),
        ("vertical: {ratio: 0.7}", "wave_passage: {delays: {@A9: 1 s}}", "wave_passage.delays.A9 `A3` E-NAME-01"),
        ("vertical: {ratio: 0.7}", "wave_passage: {delays: {@C1-C9: 1 s}}", "wave_passage.delays.C1-C9 `A3` E-NAME-01"),
        (", directions: both", "", "analyses[3].vertical E-VERT-01"),
        ("directions: both", "directions: @all", "masses.directions `both` E-VALUE-03"),
        ("direction: all", "direction: @right", "analyses[2].direction `x+` `y-` `all` E-VALUE-03"),
        (", direction: all", "", "analyses[2].direction E-KEY-02"),
        ("direction: all", "direction: @30 deg", "analyses[2].direction `x+` E-VALUE-03"),
        ("direction: all", "direction: all, eccentricity: @+z", "analyses[2].eccentricity E-VALUE-03"),
        ("direction: all", "direction: all, eccentricity: @1", "analyses[2].eccentricity E-VALUE-03"),
        ("direction: all", "direction: all, eccentricity: @[]", "analyses[2].eccentricity E-VALUE-01"),
        ("direction: all", "direction: all, eccentricity: [0, 0]", "analyses[2].eccentricity[1] E-NAME-02"),
        ("direction: all", "direction: all, eccentricity: [0, @+x]", "analyses[2].eccentricity[1] `+x+y` E-PUSH-04"),
        ("direction: all", "direction: y, eccentricity: @+y", "analyses[2].eccentricity along y E-PUSH-04"),
        ("direction: all", "direction: x, @eccentricity_ratio: 5 %", "analyses[2].eccentricity_ratio E-KEY-03"),
        ("direction: all", "direction: x, eccentricity: -y, eccentricity_ratio: @0", "eccentricity_ratio E-VALUE-02"),
        (
            "[first_mode, {floors: [1, 2]}], direction: all",
            "@{mode: 1}, direction: all, targets: n2",
            "analyses[2].pattern `first_mode` E-PUSH-03",
        ),
        ("floors: [1, 2]", "floors: [1, 2, 3]", "analyses[2].pattern[1] 2 3 E-VALUE-04"),
        ("roof_drift: 2 %", "roof_drift: 2 %, targets: n2, levels: [@MCE]", "analyses[2].levels E-NAME-01"),
        ("archive: shaken.h5", "archive: @shaken.zip", "outputs.archive E-FILE-08"),
        ("[C_A2_1, BX_2_1_2]", "[@C_A_1, BX_2_1_2]", "outputs.members[0] `C_A3_1` BX_2_1_5 E-NAME-01"),
        (
            "{member: C_A2_1, points: [1, 4]}",
            "{member: C_A2_1, points: [1, @5]}",
            "outputs.sections[0].points[1] E-NAME-01",
        ),
        ("{member: C_A2_1, points: [1, 4]}", "{member: @DY_A_1_1_r}", "outputs.sections[0].member E-HIST-04"),
        ("layers: 1-24", "layers: @1-25", "outputs.fibres[0].layers 25 24 E-NAME-01"),
        (
            "Q: 2 kN/m^2, category: B, spans: x}]",
            "Q: 2 kN/m^2, category: B, spans: x}]\n  gravity: {Q: @{A: 0.3}}",
            "loads.gravity.Q `B` E-KEY-02",
        ),
        (FOOT, "@restrained_floors: [{floors: 2}]\ncolumns: [{s", "restrained_floors lowest E-BLDG-04"),
        (FOOT, "@restrained_floors: [{floors: 1-2}]\ncolumns: [{s", "restrained_floors lowest E-BLDG-04"),
        (
            FOOT,
            "restrained_floors: [@{floors: 1, rz: 2 kN*m/rad, ux: 3 kN/m, uy: 3 kN/m}]\ncolumns: [{s",
            "restrained_floors[0] basement E-BLDG-04",
        ),
        (FOOT, FOOT_ON.replace("sand, l", "@mud, l"), "supports.default.footing.soil `sand` E-NAME-01"),
        (
            FOOT,
            FOOT_ON.replace("0.5 m", "0.5 m, wall_contact: @1 m"),
            "supports.default.footing.wall_contact E-VALUE-04",
        ),
        (FOOT, FOOT_ON.replace("0.5 m", "0.5 m, @thick: 1 m"), "supports.default.footing.thick `thickness` E-KEY-01"),
        (FOOT, FOOT_ON.replace(", damping: 5 %", "").replace("{density", "@{density"), "soils.sand `damping` E-KEY-02"),
    ],
)
def test_mistakes_of_analyses_are_reported_with_their_place(old: str, new: str, said: str) -> None:
    _is_reported(ANALYSED, old, new, said)


UNDESIGNED = ANALYSED[: ANALYSED.index("design:")] + ANALYSED[ANALYSED.index("fibres:") :]


@pytest.mark.parametrize(
    ("new", "said"),
    [  # in place of the record's vertical motion; the file has two floors, which are rigid
        ("[{floors: @3}]", "restrained_floors[0].floors 3 E-NAME-01"),
        ("[{floors: 1}, {floors: @1}]", "restrained_floors[1].floors E-NAME-02"),
        ("[{floors: 1, @rz: free}]", "restrained_floors[0].rz `rz: fixed` E-VALUE-04"),
        ("[@{floors: 1, ux: free, uy: free, rz: free}]", "restrained_floors[0] `free` E-KEY-03"),
        ("[{floors: 1, ux: @3 kN}]", "restrained_floors[0].ux E-UNIT-02"),
    ],
)
def test_mistakes_of_held_floors_are_reported_with_their_place(new: str, said: str) -> None:
    _is_reported(UNDESIGNED, FOOT, f"restrained_floors: {new}\n{FOOT}", said)


@pytest.mark.parametrize(
    ("new", "said"),
    [  # of two floors with two bays along x and y each
        ("[{floors: @3, bays: all}]", "partial_diaphragms[0].floors 3 E-NAME-01"),
        ("[{floors: 1, bays: {x: @1-3, y: 1}}]", "partial_diaphragms[0].bays.x 3 E-NAME-01"),
        ("[{floors: 1, bays: all}, {floors: @1, bays: {x: 1, y: 1}}]", "partial_diaphragms[1].floors E-NAME-02"),
        ("[{floors: 1, @bays: [{x: 1, y: 1}, {x: 2, y: 2}]}]", "partial_diaphragms[0].bays touch E-VALUE-04"),
        (
            "[{floors: 1, bays: {x: 1, y: 1}}, {floors: @1-2, bays: {x: 2, y: 1}}]",
            "partial_diaphragms[1].floors `B1` `B2` E-NAME-02",
        ),
        ("@diaphragms: all\nsetbacks: [{floors: 2, bays: [{x: 1, y: 1}, {x: 2, y: 2}]}]", "diaphragms B2 E-VALUE-04"),
        ("[{floors: @1, bays: all}]\ndiaphragms: none", "partial_diaphragms[0].floors `diaphragms` E-NAME-01"),
        (
            "[{floors: 2, @bays: all}]\nsetbacks: [{floors: 2, bays: {x: 1, y: all}}]",
            "partial_diaphragms[0].bays cover E-NAME-01",
        ),
    ],
)
def test_mistakes_of_partial_diaphragms_are_reported_with_their_place(new: str, said: str) -> None:
    base = building_text_without_braces()
    new = new if "diaphragms: all" in new else f"partial_diaphragms: {new}"
    _is_reported(base, FOOT, f"{new}\n{FOOT}", said)


def building_text_without_braces() -> str:
    """SMALL without its design, whose braces stand on both floors."""
    whole = SMALL[: SMALL.index("hazard:")]
    start, end = whole.index("braces:"), whole.index("materials:")
    return (whole[:start] + whole[end:]).replace(", ends: pinned", "")


ASIDE = ANALYSED.replace("direction: all", "direction: all, eccentricity: -x-y")


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # as above, of a building whose loads act beside its centres of mass
        ("columns: [{s", "diaphragms: none\ncolumns: [{s", "analyses[2].eccentricity `diaphragms` E-PUSH-04"),
        ("medium", "medium\n  accidental_torsion: none", "analyses[2].eccentricity_ratio E-KEY-02"),
    ],
)
def test_mistakes_of_eccentric_pushovers_are_reported(old: str, new: str, said: str) -> None:
    _is_reported(ASIDE, old, new, said)


CHEVRONS = "along: x, frames: 2, bays: 1, storeys: all, law: oil, scale: [2, 1]"


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [  # as above, of a building with dampers
        (CHEVRONS, CHEVRONS.replace("along: x, ", ""), "dampers.devices[0].along E-KEY-02"),
        (CHEVRONS, CHEVRONS.replace("frames: 2, ", ""), "dampers.devices[0].frames E-KEY-02"),
        (CHEVRONS, CHEVRONS.replace("frames: 2", "frames: @A"), "dampers.devices[0].frames `A` 1 to 3 E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("bays: 1", "bays: @3"), "dampers.devices[0].bays 1 2 E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("all", "@1-3"), "dampers.devices[0].storeys E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("oil", "@oli"), "dampers.devices[0].law `oil` E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("[2, 1]", "@[2, 1, 1]"), "dampers.devices[0].scale 3 2 E-VALUE-04"),
        ("shs 120x8", "@shs 120x80", "dampers.devices[1].brace.section E-NAME-01"),
        ("x8, material: S275}}", "x8, material: @S235}}", "dampers.devices[1].brace.material `S275` E-NAME-01"),
        ("[A1.0, B2.1]", "[A1.0, @B21]", "dampers.devices[2].nodes[1] `B2.1` building E-NAME-01"),
        ("floor: 2", "floor: @3", "dampers.attachments[0].floor E-NAME-01"),
        (", direction: x", "", "dampers.attachments[0].direction E-KEY-02"),
        ("direction: x", "direction: @z", "dampers.attachments[0].direction `y` E-VALUE-03"),
        ("at: A1", "at: @D1", "dampers.attachments[0].at `A1` E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("s: 2", "s: [1, @X4]"), "dampers.devices[0].frames `X4` 1 to 3 E-NAME-01"),
        (CHEVRONS, CHEVRONS.replace("along: x", "along: y"), "dampers.devices[0].frames `2` A to C E-NAME-01"),
        ("[A1.0, B2.1]", "[A1.0, @D2.1]", "dampers.devices[2].nodes[1] `D2.1` building E-NAME-01"),
        ("[A1.0, B2.1]", "@[C1.2, B2.2]", "dampers.devices[2].nodes `C1.2` `B2.2` floor 2 rigid E-DAMPER-05"),
        ("[A1.0, B2.1]", "@[A1.0, B1.0]", "dampers.devices[2].nodes `A1.0` `B1.0` ground E-DAMPER-05"),
        ("[A1.0, B2.1]", "@[BX_2_1_2, B2.2]", "dampers.devices[2].nodes `BX_2_1_2` floor 2 rigid E-DAMPER-05"),
        (", at: A1}", "}\ndiaphragms: 1", "dampers.attachments[0].at `A1` floor 2 E-KEY-02"),
        (
            "dampers:",
            "missing: {beams: [{along: x, frames: 2, bays: 1, floors: 2}]}\ndampers:",
            "dampers.devices[0].kind BX_2_1_2 E-DAMPER-05",
        ),
    ],
)
def test_mistakes_of_dampers_are_reported_with_their_place(old: str, new: str, said: str) -> None:
    _is_reported(DAMPED, old, new, said)


def test_a_chevron_needs_the_beam_above_or_a_floor_that_ties_its_ends() -> None:
    missing = ("dampers:", "missing: {beams: [{along: x, frames: 2, bays: 1, floors: 2}]}\ndampers:")
    pushing = changed(DAMPED, ("kind: chevron_braces", "kind: chevron"), missing)
    assert building(pushing).dampers is not None
    messages = [said for _, said in faults(changed(pushing, ("dampers:", "diaphragms: 1\ndampers:")))]
    assert says(messages[0], "dampers.devices[0].kind `BX_2_1_2` E-DAMPER-05")


def test_dampers_have_nodes_at_the_corners_of_their_bays() -> None:
    text = changed(
        DAMPED,
        ("columns: [{s", "setbacks: [{floors: 2, bays: {x: all, y: 1}}]\ncolumns: [{s"),
        ("bays: 2, storeys: 1, law: oil,", "bays: 2, storeys: all, law: oil,"),
    )
    ((place, message),) = faults(text)
    assert place == (24, 7) and says(message, "dampers.devices[1] `A3.2`, `C3.2` E-NAME-01")


def test_what_analyses_do_not_have_stands_in_a_file_for_the_design_alone() -> None:
    stiff = building(IRREGULAR)
    assert stiff.beams[0].ends.start == 40e6 and not stiff.analyses


def test_a_direction_without_resistance() -> None:
    ((_, message), *more) = faults(SMALL.replace(*PINNED))
    assert says(message, "beams[0].ends x storey 2 X1 X3 E-BLDG-02")
    assert not more
    lower = SMALL.replace("bays: 1, kind", "bays: 1, storeys: 1, kind")  # the columns of storey 2 are cantilevers
    assert any(says(message, "along y in storey 2 E-BLDG-02") for _, message in faults(lower))
    building(lower.replace("ends: pinned", "ends: {start: 20 MN*m/rad, end: pinned}"))


def test_a_hall_of_cantilever_columns_stands() -> None:
    hall = SMALL[: SMALL.index("hazard:")].replace("storeys: [4 m, 3 m]", "storeys: [4 m]").replace(*PINNED)
    assert building(hall).n_storeys == 1
    on_pins = faults(hall.replace("columns: [", "supports: pinned\ncolumns: ["))
    assert any(says(message, "beams[0].ends x storey 1 E-BLDG-02") for _, message in on_pins)


def test_a_column_that_stands_on_nothing() -> None:
    """A tower beside the floor below it: its far columns have neither column nor beam under them."""
    setback = "setbacks: [{floors: 1, bays: {x: 1, y: all}}]\ncolumns: ["
    messages = [message for _, message in faults(SMALL.replace("columns: [", setback))]
    assert any(says(m, "setbacks `C_C1_2` `C_C2_2` `C_C3_2` E-BLDG-02") for m in messages)


def test_a_floor_in_parts_has_no_diaphragm() -> None:
    setback = "setbacks: [{floors: 2, bays: [{x: 1, y: 1}, {x: 2, y: 2}]}]\ncolumns: ["
    text = SMALL.replace("columns: [", setback).replace("ends: pinned", "ends: rigid")
    text = text.replace("bays: 1, kind", "bays: 1, storeys: 1, kind")
    ((place, message),) = faults(text)
    assert place == (5, 1)
    assert says(message, "setbacks floor 2 `diaphragms` E-VALUE-04")
    assert building(text.replace("setbacks:", "diaphragms: 1\nsetbacks:")).diaphragms.ranges == ((1, 1),)


def test_loads_on_bays_that_a_floor_does_not_cover() -> None:
    """What is named one by one must be there; `all` takes what is."""
    text = SMALL.replace("columns: [", "setbacks: [{floors: 2, bays: [{x: 1, y: all}, {x: 2, y: 1}]}]\ncolumns: [")
    area = "[{{floors: 2, bays: {}, G: 4"
    for bays in ("{x: 2, y: 2}", "{x: 1-2, y: 1-2}"):
        ((_, message),) = faults(text.replace("[{G: 4", area.format(bays)))
        assert says(message, "loads.areas[0].bays floor 2 E-BLDG-02") and "bay 2 along x, 2 along y" in message
    for bays in ("{x: 2, y: all}", "all"):
        building(text.replace("[{G: 4", area.format(bays)))
    narrow = SMALL.replace("columns: [", "setbacks: [{floors: 2, bays: {x: 1, y: all}}]\ncolumns: [").replace(
        "C], b", "B], b"
    )
    ((_, message),) = faults(narrow.replace("[{G: 4", area.format("{x: 2, y: all}")))
    assert says(message, "loads.areas[0].bays floor 2 E-BLDG-02") and "bay 2 along x [" in message
    building(narrow.replace("[{G: 4", area.format("{x: all, y: 2}")))


def test_the_perimeter_needs_its_beams() -> None:
    hole = "perimeter: [{G: 1 kN/m}]\nmissing: {beams: [{along: x, frames: 1, bays: 2, floors: 2}]}\nmasses"
    text = SMALL.replace("masses", hole, 1).replace("perimeter", "  perimeter")
    ((_, message),) = faults(text)
    assert says(message, "loads.perimeter[0] `BX_1_2_2` E-BLDG-02")


def test_all_mistakes_are_reported_at_once() -> None:
    text = SMALL.replace("HEB200", "HEB201").replace("IPE240", "IPE241").replace("bays: 1, kind", "bays: 9, kind")
    assert len(faults(text)) == 3


def test_a_plan_beyond_the_limit_is_refused_before_it_is_laid_out() -> None:
    big = SMALL.replace("x: [6 m, 4 m]", "x: {count: 100, width: 6 m}").replace("count: 2", "count: 100")
    ((place, message),) = faults(big.replace("[4 m, 3 m]", "{count: 200, height: 3 m}"))
    assert place == (3, 1)
    assert says(message, "plan 2040200 50000 E-VALUE-02")


def test_own_sections_are_named_where_a_file_can_have_them() -> None:
    """A building has no own sections, and `none` of them would read as if it could."""
    ((_, message),) = faults(SMALL.replace("HEB200, mat", "HEB205, mat"))
    assert says(message, "columns[0].section `HEB200` E-NAME-01") and "own sections" not in message
