"""Whatever is wrong with dampers is reported with its place, key and value, what is allowed, and the nearest name.

Both `edesign check` and `edesign run` refuse it before anything runs. `«` marks the place that must be named.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from cases.small_frame import RECORD, TEXT
from messages import says

from edesign.cli.main import main
from edesign.frame.project_file import load_project
from edesign.study.analysis.dampers import law_warnings
from edesign.study.analysis.structure import make_frame

Capture = pytest.CaptureFixture[str]

DAMPERS = """\
dampers:
  laws:
    tested:
      type: mgmm
      parameters: thesis_table_4_2
      temperature: 25 degC
      temperature_law: {gamma_T: {20 degC: 1, 35 degC: 0.82}}
      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
    oil:
      type: viscous_power
      parameters: {c: 300 kN*(s/m)^0.35, alpha: 0.35}
  devices:
    - {kind: chevron, bays: 1, storeys: 1-2, law: tested, layer_area: [0.2 m^2, 0.1 m^2],
       brace: {stiffness: [90 kN/mm, 60 kN/mm]}}
    - {kind: rising, bays: 1, storeys: 2, law: oil, number: 2, brace: {section: HEB100, material: S275}}
    - {kind: nodes, nodes: [A0, B1], law: oil}
    - {kind: storey, bays: 1, storeys: 1, law: oil}
  attachments:
    - {kind: tuned_mass, floor: 2, mass: 2 t, frequency: 1.5 Hz, damping: 8 %}
    - {kind: tuned_liquid, floor: 1, length: 2 m, width: 1 m, depth: 0.3 m, damping: 3 %}
"""
WHOLE = TEXT.replace("damping: {kind", DAMPERS + "damping: {kind").replace(
    "modes: 2}", "modes: 2, damper_deformation: 5 mm}"
)
OIL = "parameters: {c: 300 kN*(s/m)^0.35, alpha: 0.35}"
SHIFT = "temperature_law: {gamma_T: {20 degC: 1, 35 degC: 0.82}}"
AREAS, STIFFNESSES = "[0.2 m^2, 0.1 m^2]", "stiffness: [90 kN/mm, 60 kN/mm]"
BRACE = "brace: {section: HEB100, material: S275}"

# old text, new text, key, parts of the message: value seen, what is allowed, nearest name
WRONG = {
    # laws
    "unknown law type": ("type: mgmm", "type: «mgm", "laws.tested.type", "`mgmm` bouc_wen E-LAW-01"),
    "unknown parameter": (
        OIL,
        "parameters: {c: 300 kN*(s/m)^0.35, alpha: 0.35, alfa: «0.3}",
        "laws.oil.parameters.alfa",
        "`alpha` c, alpha E-LAW-02",
    ),
    "wrong unit": (OIL, "parameters: {c: «300 kN/mm, alpha: 0.35}", "laws.oil.parameters.c", "force length E-UNIT-02"),
    "exponent of the unit is not that of the law": (
        OIL,
        "parameters: {c: «300 kN*(s/m)^0.4, alpha: 0.35}",
        "laws.oil.parameters.c",
        "E-UNIT-02",
    ),
    "bare number": (OIL, "parameters: {c: «300, alpha: 0.35}", "laws.oil.parameters.c", "E-UNIT-01"),
    "alpha out of bounds": (
        OIL,
        "parameters: {c: 300 kN*(s/m)^0.35, alpha: «2.5}",
        "laws.oil.parameters.alpha",
        "E-VALUE-02",
    ),
    "negative coefficient": (
        OIL,
        "parameters: {c: «-300 kN*(s/m)^0.35, alpha: 0.35}",
        "laws.oil.parameters.c",
        "-300000 E-LAW-03",
    ),
    "missing parameter": (OIL, "parameters: «{alpha: 0.35}", "laws.oil.parameters.c", "damping coefficient E-LAW-02"),
    "unknown set": (
        "parameters: thesis_table_4_2",
        "parameters: «thesis_table_4_3",
        "laws.tested.parameters",
        "`thesis_table_4_2` E-LAW-01",
    ),
    "set of another law": (OIL, "parameters: «thesis_table_4_2", "laws.oil.parameters", "mgmm E-LAW-01"),
    "temperature without unit": (
        "temperature: 25 degC",
        "temperature: «25",
        "laws.tested.temperature",
        "`20 degC` `293.15 K` E-VALUE-01",
    ),
    "temperature in another unit": (
        "temperature: 25 degC",
        "temperature: «25 F",
        "laws.tested.temperature",
        "E-VALUE-01",
    ),
    "two temperature laws": (
        SHIFT,
        "temperature_law: «{gamma_T: {20 degC: 1, 35 degC: 0.82}, ferry: {p1: 1, p2: 50 K, reference: 20 degC}}",
        "laws.tested.temperature_law",
        "E-LAW-05",
    ),
    "unknown temperature law": (
        SHIFT,
        "temperature_law: {«gama_T: {20 degC: 1, 35 degC: 0.82}}",
        "laws.tested.temperature_law.gama_T",
        "`gamma_T` `ferry` E-KEY-01",
    ),
    "gamma_T without unit": (
        SHIFT,
        "temperature_law: {gamma_T: {20: «1, 35 degC: 0.82}}",
        "laws.tested.temperature_law.gamma_T.20",
        "E-VALUE-01",
    ),
    "negative gamma_T": (
        SHIFT,
        "temperature_law: {gamma_T: {20 degC: 1, 35 degC: «-0.82}}",
        "laws.tested.temperature_law.gamma_T.35 degC",
        "E-VALUE-02",
    ),
    "temperature law of other laws": (
        SHIFT,
        "temperature_law: «{ferry: {p1: 1, p2: 50 K, reference: 20 degC}}",
        "laws.tested.temperature_law",
        "mgmm zener E-LAW-05",
    ),
    "temperature law without temperature": (
        "      temperature: 25 degC\n      temperature_law:",
        "      «temperature_law:",
        "laws.tested.temperature_law",
        "E-KEY-02",
    ),
    "temperature out of reach": (
        "temperature: 25 degC",
        "temperature: «120 degC",
        "laws.tested.temperature",
        "E-LAW-04",
    ),
    # devices
    "unknown kind": ("kind: rising", "kind: «risng", "devices[1].kind", "`rising` `nodes` E-VALUE-03"),
    "unknown device law": (
        "storeys: 2, law: oil",
        "storeys: 2, law: «oils",
        "devices[1].law",
        "`oil` `tested` E-NAME-01",
    ),
    "storey outside": ("storeys: 1-2, law", "storeys: «1-3, law", "devices[0].storeys", "1 to 2 E-NAME-01"),
    "bay outside": ("rising, bays: 1", "rising, bays: [1, «2]", "devices[1].bays[1]", "1 to 1 E-NAME-01"),
    "too many areas": (AREAS, "«[0.2 m^2, 0.1 m^2, 0.1 m^2]", "devices[0].layer_area", "E-VALUE-04"),
    "too few brace stiffnesses": (STIFFNESSES, "stiffness: «[90 kN/mm]", "devices[0].brace.stiffness", "E-VALUE-04"),
    "list at one place": (
        "[A0, B1], law: oil",
        "[A0, B1], law: oil, brace: {stiffness: «[1 kN/mm, 2 kN/mm]}",
        "devices[2].brace.stiffness",
        "E-VALUE-04",
    ),
    "one wrong unit in a list": (
        STIFFNESSES,
        "stiffness: [90 kN/mm, «60 kN]",
        "devices[0].brace.stiffness[1]",
        "force `120 kN/mm` E-UNIT-02",
    ),
    "size without prototype": (
        "law: oil, number: 2",
        "law: oil, number: 2, «layers: 4",
        "devices[1].layers",
        "`prototype` E-DAMPER-03",
    ),
    "scale of a prototype": (
        AREAS,
        "[0.2 m^2, 0.1 m^2], «scale: 2",
        "devices[0].scale",
        "`tested` `prototype` E-KEY-03",
    ),
    "too many scales": ("number: 2", "number: 2, scale: «[1, 2]", "devices[1].scale", "E-VALUE-04"),
    "too many deformations": (
        "number: 2",
        "number: 2, design_deformation: «[1 mm, 2 mm]",
        "devices[1].design_deformation",
        "E-VALUE-04",
    ),
    "no scale": ("number: 2", "number: 2, scale: «0", "devices[1].scale", "E-VALUE-02"),
    "none of them": ("number: 2", "number: «0", "devices[1].number", "E-VALUE-02"),
    "word for a brace": (BRACE, "brace: «stiff", "devices[1].brace", "`rigid` E-VALUE-03"),
    "half a brace": (BRACE, "«brace: {section: HEB100}", "devices[1].brace.material", "E-KEY-02"),
    "brace section of a storey damper": (
        "storeys: 1, law: oil}",
        "storeys: 1, law: oil, brace: «{section: HEB120, material: S275}}",
        "devices[3].brace",
        "`stiffness` E-DAMPER-02",
    ),
    "unknown section": (
        BRACE,
        "brace: {section: «HEB105, material: S275}",
        "devices[1].brace.section",
        "`HEB100` E-NAME-01",
    ),
    "unknown material": (
        BRACE,
        "brace: {section: HEB100, material: «S257}",
        "devices[1].brace.material",
        "`S275` E-NAME-01",
    ),
    "unknown node": ("[A0, B1]", "[A0, «B3]", "devices[2].nodes[1]", "`B2` E-NAME-01"),
    "node to itself": ("[A0, B1]", "«[B1, B1]", "devices[2].nodes", "E-DAMPER-05"),
    "ground to ground": ("[A0, B1]", "«[A0, B0]", "devices[2].nodes", "`A0` `B0` never move apart ground E-DAMPER-05"),
    "three nodes": ("[A0, B1]", "«[A0, B1, A1]", "devices[2].nodes", "E-VALUE-01"),
    # attachments
    "unknown attachment": ("kind: tuned_mass", "kind: «tuned_mas", "attachments[0].kind", "`tuned_mass` E-VALUE-03"),
    "floor outside": ("floor: 2", "floor: «3", "attachments[0].floor", "1 to 2 E-NAME-01"),
    "floor zero": ("floor: 2", "floor: «0", "attachments[0].floor", "E-VALUE-02"),
    "weight for mass": ("mass: 2 t", "mass: «2 kN", "attachments[0].mass", "force `29.5 t` E-UNIT-02"),
    "depth of nothing": ("depth: 0.3 m", "depth: «0 m", "attachments[1].depth", "E-VALUE-02"),
    # keys of buildings
    "direction of a frame": ("kind: storey, ", "kind: storey, «along: x, ", "devices[3].along", "E-KEY-03"),
    "direction of a mass": ("floor: 2", "«direction: x, floor: 2", "attachments[0].direction", "E-KEY-03"),
    # the block
    "misspelt list": ("devices:\n", "«device:\n", "device", "`devices` E-KEY-01"),
}
# of analyses: key from the root
ANALYSES = {
    "both amplitudes": (
        "damper_deformation: 5 mm",
        "damper_strain: 30 %, «damper_deformation: 5 mm",
        "analyses[0].damper_deformation",
        "E-KEY-03",
    ),
    "strain of dampers without layers": (
        "damper_deformation: 5 mm",
        "«damper_strain: 30 %",
        "analyses[0].damper_strain",
        "`oil` `prototype` E-DAMPER-01",
    ),
    "amplitude without dampers": (
        "damper_deformation: 5 mm",
        "«damper_deformation: 5 mm, dampers: false",
        "analyses[0].damper_deformation",
        "E-DAMPER-04",
    ),
    "neither with nor without": (
        "damper_deformation: 5 mm",
        "dampers: «maybe",
        "analyses[0].dampers",
        "`true` `false` E-VALUE-01",
    ),
    "word for the block": (DAMPERS, "dampers: «maybe\n", "dampers", "E-VALUE-01"),
}
CASES = {name: (old, new, f"dampers.{key}", said) for name, (old, new, key, said) in WRONG.items()} | ANALYSES


def written(folder: Path, *changes: tuple[str, str]) -> tuple[Path, str]:
    """Write the project with changes; its path, and `file:line:column` of the mark."""
    text = WHOLE
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the project once"
        text = text.replace(old, new)
    at = text.find("«")
    path = folder / "project.yaml"
    path.write_text(text.replace("«", ""), encoding="utf-8")
    (folder / "motion.AT2").write_text(RECORD, encoding="utf-8")
    return path, f"{path}:{text.count(chr(10), 0, at) + 1}:{at - text.rfind(chr(10), 0, at)}"


@pytest.mark.parametrize(("old", "new", "key", "said"), CASES.values(), ids=CASES.keys())
def test_a_wrong_damper_is_refused_where_it_is_wrong(
    tmp_path: Path, capsys: Capture, old: str, new: str, key: str, said: str
) -> None:
    path, place = written(tmp_path, (old, new))
    heard = []
    for verb in ("check", "run"):
        assert main([verb, str(path)]) == 2
        output, errors = capsys.readouterr()
        assert output == "" and "Traceback" not in errors
        heard.append(errors)
    assert heard[0] == heard[1]
    assert heard[0].startswith(f"edesign: {place}: {key}: ")
    assert heard[0].count("\n") == 1, heard[0]  # one message
    assert says(heard[0], said), heard[0]
    assert sorted(item.name for item in tmp_path.iterdir()) == ["motion.AT2", "project.yaml"]


def test_nodes_of_a_rigid_floor_never_move_apart(tmp_path: Path, capsys: Capture) -> None:
    """Without the rigid floor they do, as the beam between them gives way."""
    floor = ("[A0, B1]", "«[A1, B1]")
    path, place = written(tmp_path, floor, ("frame:\n", "frame:\n  diaphragms: 1\n"))
    assert main(["check", str(path)]) == 2
    assert says(capsys.readouterr().err, f"{place}: devices[2].nodes `A1` `B1` floor 1 rigid E-DAMPER-05")
    assert main(["check", str(written(tmp_path, floor)[0])]) == 0


def test_the_project_is_right_before_it_is_made_wrong(tmp_path: Path, capsys: Capture) -> None:
    path, _ = written(tmp_path)
    assert main(["check", str(path)]) == 0
    assert "2 dampers `tested`, 3 dampers `oil`, 2 tuned mass" in capsys.readouterr().out
    assert main(["run", str(path), "-q"]) == 0
    names = [device.name for device in make_frame(load_project(path), dampers=True).devices]
    assert names == ["V_1_1", "V_1_2", "R_1_2", "N_A0_B1", "S_1_1"]


def test_a_scale_is_a_factor_on_the_coefficient(tmp_path: Path) -> None:
    """A damper of a scale is that of a law whose coefficient is so much larger."""
    scaled, _ = written(tmp_path, ("law: oil, number: 2", "law: oil, number: 2, scale: [1.5]"))
    found = make_frame(load_project(scaled), dampers=True).devices
    assert [d.force_scale for d in found if d.law == "oil"] == [3.0, 1.0, 1.0]
    assert {d.deformation_scale for d in found if d.law == "oil"} == {1.0}


def test_several_wrong_parameters_are_reported_each_with_its_place(tmp_path: Path, capsys: Capture) -> None:
    path, _ = written(tmp_path, (OIL, "parameters: {c: 300 kN*(s/m)^0.35, alpha: 2.5, beta: 1}"))
    assert main(["check", str(path)]) == 2
    first, second = capsys.readouterr().err.removeprefix("edesign: ").splitlines()
    line = (
        path.read_text(encoding="utf-8")
        .splitlines()
        .index("      parameters: {c: 300 kN*(s/m)^0.35, alpha: 2.5, beta: 1}")
    )
    assert first.startswith(f"{path}:{line + 1}:") and "dampers.laws.oil.parameters.beta: " in first
    assert second.startswith(f"{path}:{line + 1}:") and says(second, "dampers.laws.oil.parameters.alpha E-VALUE-02")


def test_a_place_without_a_node_is_reported(tmp_path: Path, capsys: Capture) -> None:
    """Line B ends at floor 1: the chevron of storey 2 has nowhere to hold on the right."""
    path, place = written(
        tmp_path,
        ("  columns: [", "  missing: {columns: [{lines: B, storeys: 2}], beams: [{floors: 2}]}\n  columns: ["),
        ("    - {kind: chevron", "    - «{kind: chevron"),
        ("modes: 2,", "modes: 1,"),
    )
    assert main(["check", str(path)]) == 2
    assert capsys.readouterr().err.startswith(f"edesign: {place}: dampers.devices[0]: there is no node `B2`")


def test_a_questionable_temperature_is_a_note(tmp_path: Path, capsys: Capture) -> None:
    path, _ = written(tmp_path, ("temperature: 25 degC", "temperature: 40 degC"))
    assert main(["check", str(path)]) == 0
    assert (
        "damper law tested: gamma_T at 40 degC is 0.76 on a straight line beyond its table" in capsys.readouterr().out
    )
    assert len(law_warnings(load_project(path))) == 1
