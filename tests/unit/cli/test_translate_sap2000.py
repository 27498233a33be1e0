"""`edesign translate` with SAP2000's text: what it writes, what it prints, and what it leaves alone."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest
from building_examples import DAMPED
from unit.exchange.sap2000_texts import FRAME, with_table

from edesign.cli.main import main

PROJECTS = Path(__file__).parents[3] / "projects"


@pytest.fixture()
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "model.s2k").write_text(FRAME)
    return tmp_path


def test_there_and_back(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["translate", "model.s2k", "model.yaml"]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith(
        "model.yaml written, a project file. Next: edesign check model.yaml\nleft out: load pattern"
    )
    assert main(["check", "model.yaml"]) == 0
    assert main(["translate", "model.yaml", "again.s2k"]) == 0
    assert "again.s2k written for SAP2000." in capsys.readouterr().out
    text = (folder / "again.s2k").read_text()
    assert 'TABLE:  "CONNECTIVITY - FRAME"' in text and "model.yaml without yielding" in text
    assert main(["translate", "again.s2k", "back.yaml"]) == 0


def test_a_building(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copy(PROJECTS / "office_6_storeys" / "building.yaml", folder)
    assert main(["translate", "building.yaml", "building.s2k"]) == 0
    assert main(["translate", "building.s2k", "back.yaml"]) == 0
    assert "back.yaml written, a building file." in capsys.readouterr().out
    assert main(["check", "back.yaml"]) == 0
    text = with_table(
        (folder / "building.s2k").read_text(), "CONNECTIVITY - LINK", "Link=1   JointI=A1.0   JointJ=B1.1"
    )
    text = with_table(text, "LINK PROPERTY ASSIGNMENTS", "Link=1   LinkProp=L")
    text = with_table(text, "LINK PROPERTY DEFINITIONS 02 - LINEAR", "Link=L   DOF=U1   TransKE=900   TransCE=40")
    (folder / "linked.s2k").write_text(text)
    assert main(["translate", "linked.s2k", "linked.yaml"]) == 2
    assert re.search("CONNECTIVITY - LINK: link 1: .*E-SAP-13", capsys.readouterr().err)
    assert main(["translate", "building.yaml", "building.py"]) == 0
    assert "left out: analyses: the file names none" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["model.s2k", "model.s2k"], "E-FILE-08"),
        (["model.s2k", "mine.yaml"], "mine.yaml: .*E-FILE-07"),
        (["none.s2k", "x.yaml"], "none.s2k: "),
        (["mine.yaml", "x.s2k"], "mine.yaml:1:1: "),
        (["model.s2k", "no_folder.yaml/x.yaml"], "no_folder.yaml"),
    ],
)
def test_what_is_refused(folder: Path, arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "mine.yaml").write_text("a: 1\n")
    (folder / "no_folder.yaml").write_text("a: 1\n")
    before = sorted(folder.iterdir())
    assert main(["translate", *arguments]) in (2, 4)
    assert re.search(said, capsys.readouterr().err)
    assert sorted(folder.iterdir()) == before


def test_dampers_that_sap2000_lacks(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    project = str(PROJECTS / "thesis_one_storey" / "project.yaml")
    assert main(["translate", project, "x.s2k"]) == 2
    assert "E-SAP-28" in capsys.readouterr().err
    assert main(["translate", project, "x.s2k", "--without-dampers"]) == 0
    assert "left out: dampers, isolators and tuned masses" in capsys.readouterr().out


def test_a_building_is_translated_without_its_dampers(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "damped.yaml").write_text(DAMPED, encoding="utf-8")
    assert main(["translate", "damped.yaml", "damped.s2k"]) == 0
    assert "its dampers and tuned masses" in capsys.readouterr().out
