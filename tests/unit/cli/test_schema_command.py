"""`edesign schema` prints and writes schemas, and replaces nothing else."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from support.messages import says

from edesign.cli.main import main


def test_without_words_it_lists_the_kinds(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    output = capsys.readouterr().out
    assert "project file; known by edesign" in output and max(map(len, output.splitlines())) <= 90


def test_one_kind_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema", "suite"]) == 0
    schema = json.loads(capsys.readouterr().out)
    assert schema["title"] == "edesign suite file" and schema["required"] == ["edesign_suite", "title", "records"]


def test_an_unknown_kind_is_refused_with_the_nearest(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema", "projct"]) == 2
    assert "did you mean `project`?" in capsys.readouterr().err


def test_all_are_written_and_refer_to_each_other(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "a" / "schemas"
    assert main(["schema", "--output", str(folder)]) == 0
    combined = json.loads((folder / "edesign.schema.json").read_text(encoding="utf-8"))
    assert capsys.readouterr().out.splitlines()[-1].endswith(f"$schema={folder / 'edesign.schema.json'}")
    while "if" in combined:
        assert (folder / combined["then"]["$ref"]).is_file()
        combined = combined["else"]
    assert main(["schema", "rig", "-o", str(folder)]) == 0


def test_a_file_of_something_else_is_left_as_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "rig.schema.json").write_text("mine", encoding="utf-8")
    assert main(["schema", "-o", str(tmp_path)]) == 2
    assert says(capsys.readouterr().err, "rig.schema.json: E-FILE-07")
    assert [path.name for path in tmp_path.iterdir()] == ["rig.schema.json"]
    assert main(["schema", "-o", str(tmp_path / "rig.schema.json")]) == 4


def test_other_commands_load_nothing_of_schemas() -> None:
    script = "import sys, edesign.cli.main; import edesign.project.project; print('edesign.schema' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
