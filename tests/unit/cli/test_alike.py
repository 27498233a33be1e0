"""What commands have in common is alike: workers, quiet ones, JSON, and one `run` for every file that is run."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from edesign.archive.reader import open_archive
from edesign.cli.main import main


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_workers_have_one_default_and_one_sentence(capsys: pytest.CaptureFixture[str]) -> None:
    found = {}
    for name in ("calibrate", "design", "fit", "match", "run"):
        assert main([name, "--help"]) == 0
        words = " ".join(capsys.readouterr().out.replace("│", " ").split())
        found[name] = words[words.index("--workers") :].partition(" --")[0]
    assert set(found.values()) == {found["run"]} and "[default: 2]" in found["run"]


def test_new_is_quiet_where_it_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "frame", "-q"]) == 0
    assert capsys.readouterr().out == "" and Path("frame/project.yaml").is_file()


def test_run_runs_substructure_tests_as_rts_run_does(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "rts", "--template", "substructure", "-q"]) == 0
    assert main(["rts", "run", "rts/rts.yaml", "--archive", "one.h5"]) == 0
    one = capsys.readouterr()
    assert main(["run", "rts/rts.yaml", "--archive", "other.h5", "--report"]) == 0
    other = capsys.readouterr()
    said = other.out.replace("other.h5", "one.h5").splitlines()
    assert said[4:-1] == one.out.splitlines()[4:] and said[-1] == "report: other.html" and Path("other.html").is_file()
    with open_archive("one.h5") as first, open_archive("other.h5") as second:
        assert first.names("tests") == second.names("tests")
    assert main(["run", "rts/rts.yaml", "--only", "sines"]) == 2
    assert "--only, --folder, --scheduler and --fresh are for analyses" in capsys.readouterr().err


def test_tests_of_the_virtual_rig_are_json_too(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "laboratory", "--template", "laboratory", "-q"]) == 0
    assert main(["test", "laboratory/programme.yaml", "--json", "--output", "campaign"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found.pop("campaign") == "campaign/campaign.yaml"
    assert main(["characterise", "campaign/campaign.yaml", "--json"]) == 0
    again = json.loads(capsys.readouterr().out)
    assert found["units"] == again["units"] and found["tests"].keys() == again["tests"].keys()
    for name, of in found["tests"].items():  # files have seven digits
        assert of["mean"]["G_storage"] == pytest.approx(again["tests"][name]["mean"]["G_storage"], rel=1e-4)
