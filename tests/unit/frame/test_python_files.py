"""Projects, studies and buildings made in Python are those of a file that says the same, with its messages."""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from messages import says

import edesign
from edesign.frame.python_files import ArgumentProblems
from edesign.project.reading.file_model import FileModel

ROOT = Path(__file__).parents[3]
TEMPLATES = ROOT / "edesign" / "project" / "templates"
MAKERS = {
    "make_project": (edesign.make_project, edesign.Project, edesign.load_project),
    "make_building": (edesign.make_building, edesign.Building, edesign.load_building),
    "make_study": (edesign.make_study, edesign.Study, edesign.load_study),
}
FRAME: dict[str, Any] = {
    "frame": {
        "storeys": np.array([4.0, 3.5]),
        "bays": {"count": 2, "width": 6},
        "supports": "fixed",
        "columns": [{"storeys": "all", "section": "HEB240", "material": "S275"}],
        "beams": [{"floors": "all", "section": "IPE330", "material": "S275"}],
    },
    "materials": {"S275": {"law": "bilinear", "E": 210e9, "fy": np.float64(275e6), "hardening": 0.01}},
    "loads": {"floors": [{"floors": "all", "G": 4.5e3, "Q": 2500, "width": 6.0}], "gravity": {"G": 1.0, "Q": 0.3}},
    "masses": {"from_loads": {"G": 1.0, "Q": 0.3}},
    "damping": {"kind": "rayleigh", "ratio": 0.03, "modes": [1, 2]},
    "analyses": [{"name": "modes", "kind": "modal", "modes": 2}],
}
BY_HAND = """\
edesign: 1
title: Two storeys
frame:
  storeys: [4 m, 3.5 m]
  bays: {count: 2, width: 6 m}
  supports: fixed
  columns: [{storeys: all, section: HEB240, material: S275}]
  beams: [{floors: all, section: IPE330, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}}
loads:
  floors: [{floors: all, G: 4.5 kN/m^2, Q: 2.5 kN/m^2, width: 6 m}]
  gravity: {G: 1.0, Q: 0.3}
masses: {from_loads: {G: 1.0, Q: 0.3}}
damping: {kind: rayleigh, ratio: 3 %, modes: [1, 2]}
analyses: [{name: modes, kind: modal, modes: 2}]
"""


@pytest.mark.parametrize("name", MAKERS)
def test_every_key_of_a_file_is_an_argument(name: str) -> None:
    make, model, _ = MAKERS[name]
    arguments = inspect.signature(make).parameters
    assert set(arguments) - {"path"} == {key for key in model.model_fields if not key.startswith("edesign")}
    needed = {key for key, field in model.model_fields.items() if field.is_required() and not key.startswith("edesign")}
    assert {key for key, one in arguments.items() if one.default is inspect.Parameter.empty} == needed


@pytest.mark.parametrize(
    ("name", "path"),
    [
        ("make_project", TEMPLATES / "frame" / "project.yaml"),
        ("make_project", TEMPLATES / "damped" / "project.yaml"),
        ("make_project", ROOT / "projects" / "thesis_10_storey" / "project.yaml"),
        ("make_building", TEMPLATES / "building" / "building.yaml"),
        ("make_study", ROOT / "projects" / "thesis_10_storey" / "study.yaml"),
        ("make_study", ROOT / "tests" / "cases" / "any_quantity" / "sweep.yaml"),
    ],
    ids=lambda value: value if isinstance(value, str) else f"{value.parent.name}-{value.stem}",
)
def test_what_a_file_says_makes_its_model(name: str, path: Path) -> None:
    make, _, load = MAKERS[name]
    try:
        loaded: FileModel = load(path)
    except edesign.InputError:  # templates name records that `edesign new` puts beside them
        loaded = load(edesign.new_project(path.parent.name, kind=path.parent.name))
    said = {key: value for key, value in loaded.root.plain().items() if not key.startswith("edesign")}
    if name == "make_study":
        said["project"] = loaded.base
    made = make(**said, path=loaded.path)
    assert made.analysis_checksum == loaded.analysis_checksum
    differing = [key for key in type(made).model_fields if getattr(made, key) != getattr(loaded, key)]
    assert differing == []


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_numbers_are_in_si_and_the_file_has_units() -> None:
    made = edesign.make_project("Two storeys", **FRAME)
    assert made.frame.storey_heights == (4.0, 3.5) and made.materials["S275"].fy == 275e6
    for text in ("storeys: [4 m, 3.5 m]", "width: 6 m", "E: 210 GPa, fy: 275 MPa, hardening: 0.01", "Q: 2.5 kN/m^2"):
        assert text in made.to_yaml()
    Path("by_hand.yaml").write_text(BY_HAND)
    by_hand = edesign.load_project("by_hand.yaml")
    for key in ("frame", "materials", "loads", "masses", "damping", "analyses"):
        assert getattr(made, key) == getattr(by_hand, key), key
    made.to_yaml("saved.yaml")
    assert edesign.load_project("saved.yaml").checksum == made.checksum
    assert made.with_values("materials.S275.fy", "355 MPa").materials["S275"].fy == 355e6


@pytest.mark.parametrize("value", [1.0 / 3.0, 0.1 + 0.2, 1234567.891, 3e-3, 99.99999999999])
def test_numbers_that_no_unit_writes_shortly_keep_all_digits(value: float) -> None:
    materials = {"S275": {"law": "elastic", "E": 1e11 * (1.0 + value / 1e7)}}
    made = edesign.make_project("Digits", **FRAME | {"materials": materials})
    assert made.materials["S275"].E == materials["S275"]["E"]


def test_a_study_of_it_runs_and_its_archive_has_the_texts() -> None:
    project = edesign.make_project("Two storeys", **FRAME)
    places = {"materials.S275.E": ["200 GPa", "210 GPa"], "frame.storeys[0]": ["4 m", "5 m"]}
    study = edesign.make_study(
        "Stiffer",
        project,
        variants={"bare": {"dampers": "none"}},
        vary=[{"name": "g", "variants": "bare", "grid": places}],
        modal={"modes": 1},
    )
    done = edesign.run_study(study)
    assert not done.failed and done.archive == Path("study.h5") and len(study.variants) == 5
    with edesign.open_archive(done.archive) as archive:
        table = archive.table("periods")  # modes that are alike stand in one row
    periods = {name: T for names, T in zip(table["of"], table["T"], strict=True) for name in names.split("; ")}
    stiff, soft = periods["bare_g_2_1.modes"], periods["bare_g_1_1.modes"]
    assert soft / stiff == pytest.approx((210.0 / 200.0) ** 0.5, rel=2e-3)  # gravity's second order moves it a little


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"materials": {"S275": {"law": "bilinear", "E": "210 kN", "fy": 275e6}}}, "materials.S275.E: `210 kN` force"),
        ({"frame": {**FRAME["frame"], "colums": []}}, "frame.colums: unknown `columns` E-KEY-01"),
        ({"frame": {**FRAME["frame"], "storeys": [4.0, -3.5]}}, "frame.storeys[1]: greater E-VALUE-02"),
        ({"frame": {**FRAME["frame"], "columns": [{"section": "HEB24O", "material": "S275", "storeys": "all"}]}},
         "frame.columns[0].section: `HEB240` E-NAME-01"),
        ({"loads": {"gravity": {"G": object()}}}, "loads: object E-VALUE-01"),
        ({"damping": {"kind": "rayleigh", "ratio": 3, "modes": [1, 2]}}, "damping.ratio: `3 %` E-VALUE-02"),
    ],
)  # fmt: skip
def test_messages_name_the_argument(change: dict[str, Any], said: str) -> None:
    with pytest.raises(ArgumentProblems) as caught:
        edesign.make_project("Wrong", **FRAME | change)
    place, _, words = said.partition(" ")
    line = str(caught.value).splitlines()[0]
    assert line.startswith(f"make_project: {place}") and says(line, words), line


def test_parameters_of_laws_need_their_units() -> None:
    dampers = {"laws": {"fluid": {"type": "viscous", "parameters": {"c": 2e5}}}, "devices": [
        {"kind": "chevron", "bays": 1, "storeys": "all", "law": "fluid", "brace": "rigid"}]}  # fmt: skip
    project = edesign.make_project("Damped", **FRAME | {"dampers": dampers})
    with pytest.raises(edesign.InputError, match=r"bare number `200000.0` needs a unit"):
        edesign.run_project(project)
