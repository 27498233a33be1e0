"""Slips that leave a file readable: what `edesign check` says of them, or what a refusal says of their reason."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from edesign.cli.main import main
from edesign.project.template import new_project

Capture = pytest.CaptureFixture[str]


@pytest.fixture(scope="module")
def templates(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of each template that is made wrong here."""
    folder = tmp_path_factory.mktemp("templates")
    for kind in ("frame", "damped", "study", "laboratory"):
        new_project(folder / kind, kind=kind)
    return folder


# template/file, old text, new text, what a warning says
WARNED = {
    "storey in mm": ("damped/project.yaml", "[4 m, 3.5", "[4 mm, 3.5", ["storey 1: 0.004 m is implausible", "0.5 to"]),
    "bay in mm": ("damped/project.yaml", "width: 6 m} ", "width: 0.06 m} ", ["bay 3: 0.06 m is implausible"]),
    "area in mm2": (
        "damped/project.yaml",
        "[0.43 m^2,",
        "[0.43 mm^2,",
        ["dampers.devices[0]: a layer of 0.43 mm2", "it bends"],
    ),
    "thin layers": (
        "damped/project.yaml",
        "layer_thickness: 80 mm",
        "layer_thickness: 0.08 mm",
        ["dampers.devices[0]: a layer of 430000 mm2", "is 0.08 mm thick: are", "strain of 2.5e+04 %"],
    ),
    "strain as a number": (
        "damped/project.yaml",
        "strain_limit: 50 %",
        "strain_limit: 50",
        ["a strain limit of 5e+03 %"],
    ),
    "drift as a number": (
        "study/study.yaml",
        "most: 0.75 %",
        "most: 0.75",
        ["criterion `drift`: `most` allows drifts of 75 %", "is written `0.75 %`"],
    ),
    "record twice": (
        "study/suite.yaml",
        "simulated_2.AT2",
        "simulated_1.AT2",
        ["`motions/motion_1`, `motions/motion_2` are one and the same recording"],
    ),
    "specimen in m": (
        "laboratory/campaign.yaml",
        "thickness: 12 mm",
        "thickness: 12 m",
        ["specimen prototype: a layer of 41400 mm2", "12000 mm thick: it bends"],
    ),
}


@pytest.mark.parametrize("slip", WARNED)
def test_slips_are_warned_of(templates: Path, tmp_path: Path, capsys: Capture, slip: str) -> None:
    place, old, new, said = WARNED[slip]
    file = changed(templates, tmp_path, place, old, new)
    assert main(["check", str(file.with_name("study.yaml") if file.name == "suite.yaml" else file)]) == 0
    printed = capsys.readouterr().out
    assert [words for words in said if words not in printed] == []


@pytest.mark.parametrize("place", ["damped/project.yaml", "study/study.yaml", "laboratory/campaign.yaml"])
def test_the_templates_give_no_warnings(templates: Path, capsys: Capture, place: str) -> None:
    assert main(["check", str(templates / place)]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "ok"


# old text, new text, what the refusal says
REFUSED = {
    "dash of a word processor": ("[4 m, 3.5", "[\u22124 m, 3.5", ["project.yaml:15:13: ", "write `-`", "E-VALUE-01"]),
    "no-break space": ("supports: fixed", "supports:\u00a0fixed", ["(line 16 has a no-break space"]),
    "number of the format in quotes": ("edesign: 1", "edesign: '1'", ["project.yaml:10:10: ", "E-FILE-05"]),
    "backslashes": ("recorded: {file: records/", "recorded: {file: records\\", ["divided by `/`"]),
    "another number": ("recorded: {file: records/simulated_4", "recorded: {file: records/simulated_3", ["E-FILE-01"]),
}


@pytest.mark.parametrize("slip", REFUSED)
def test_refusals_give_the_reason(templates: Path, tmp_path: Path, capsys: Capture, slip: str) -> None:
    old, new, said = REFUSED[slip]
    assert main(["check", str(changed(templates, tmp_path, "frame/project.yaml", old, new))]) == 2
    reported = capsys.readouterr()
    assert reported.out == "" and [words for words in said if words not in reported.err] == []


def changed(templates: Path, tmp_path: Path, place: str, old: str, new: str) -> Path:
    """A copy of a template with some text of a file changed where it first stands; returns the file."""
    folder = shutil.copytree(templates / Path(place).parent, tmp_path / "copy")
    file = folder / Path(place).name
    text = file.read_text(encoding="utf-8")
    assert old in text
    file.write_text(text.replace(old, new, 1), encoding="utf-8")
    return file
