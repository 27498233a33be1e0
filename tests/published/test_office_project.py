"""The project of docs/tutorials/building.md: its files follow from each other, and the design meets all checks.

Where a rule or a search changes, `python tools/renew_office.py` makes the files anew.
"""

from __future__ import annotations

import re
import shlex
import shutil
from pathlib import Path

import pytest
from building_examples import SMALL
from typer.testing import CliRunner

from edesign.cli.main import app

ROOT = Path(__file__).parents[2]
PROJECT = ROOT / "projects" / "office_6_storeys"
TUTORIAL = ROOT / "docs" / "tutorials" / "building.md"
CHAIN = [
    "edesign design building.yaml --output designed.yaml",
    "edesign run designed.yaml",
    "edesign extract designed.yaml --frame X --output frame.yaml --study study.yaml",
    "edesign run study.yaml",
]
SMALL_LISTS = """\
  select:
    starts: 1
    lists:
      columns: [HEB240, HEB260, HEB280, HEB300]
      beams: [IPE270, IPE300, IPE330]
      braces: [SHS70x5, SHS80x5, SHS90x5]
    leave_out: [6.7.3(1), 6.7.3(8)]
"""


def edesign(folder: Path, command: str, monkeypatch: pytest.MonkeyPatch) -> str:
    """Run a command of the tutorial in a folder; returns what it prints."""
    monkeypatch.chdir(folder)
    done = CliRunner().invoke(app, shlex.split(command)[1:])
    assert done.exit_code == 0, f"{command}: {done.exception} {done.output}"
    return str(done.output)


def copy(tmp_path: Path, *names: str) -> Path:
    for name in names:
        shutil.copy(PROJECT / name, tmp_path / name)
    return tmp_path


def test_the_tutorial_has_the_four_commands() -> None:
    found = [line.strip() for line in TUTORIAL.read_text(encoding="utf-8").splitlines()]
    assert [line for line in found if line in CHAIN][: len(CHAIN)] == CHAIN


def test_the_design_is_the_building_with_other_sections() -> None:
    text = (PROJECT / "designed.yaml").read_text(encoding="utf-8")
    written, chosen, building = text.split("\n", 2)
    assert 'from "building.yaml"' in written and chosen.startswith("# Sections chosen")
    sections = re.compile(r"section: \w+(\.\d+)?")
    start = (PROJECT / "building.yaml").read_text(encoding="utf-8")
    assert sections.sub("section:", building) == sections.sub("section:", start)


def test_the_design_meets_all_checks_and_has_its_kept_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = copy(tmp_path, "designed.yaml", "reference.yaml")
    assert "all checks and rules are met" in edesign(folder, CHAIN[1], monkeypatch)
    compared = edesign(folder, "edesign compare designed.h5 reference.yaml", monkeypatch)
    assert "42 of them have a bar, 42 are within it" in compared


def test_frame_and_study_are_what_extract_writes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = copy(tmp_path, "designed.yaml")
    edesign(folder, CHAIN[2], monkeypatch)
    for name in ("frame.yaml", "study.yaml", "study_records.yaml"):
        assert (folder / name).read_text(encoding="utf-8") == (PROJECT / name).read_text(encoding="utf-8"), name


def small_chain(tmp_path: Path) -> Path:
    """A building of two storeys that the chain works through in seconds; its crosses are of S235."""
    text = SMALL.replace("section: CHS101.6x5, material: S275", "section: SHS80x5, material: S275") + SMALL_LISTS
    (tmp_path / "building.yaml").write_text(text, encoding="utf-8")
    return tmp_path


def test_the_chain_on_a_small_building(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All commands but the last, whose study is read and checked."""
    folder = small_chain(tmp_path)
    assert "certificate" in edesign(folder, CHAIN[0], monkeypatch)
    edesign(folder, CHAIN[1], monkeypatch)
    edesign(folder, CHAIN[2], monkeypatch)
    assert "motions (7 simulated)" in edesign(folder, "edesign check study.yaml", monkeypatch)


@pytest.mark.study
def test_the_whole_chain_on_a_small_building(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = small_chain(tmp_path)
    said = [edesign(folder, command, monkeypatch) for command in CHAIN]
    assert re.search(r"drift, DBE +met [\d.]+ +met [\d.]+", said[-1])  # bare, damped


@pytest.mark.study
def test_the_study_has_its_kept_results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = copy(tmp_path, "frame.yaml", "study.yaml", "study_records.yaml", "reference_study.yaml")
    edesign(folder, CHAIN[3], monkeypatch)
    compared = edesign(folder, "edesign compare study.h5 reference_study.yaml", monkeypatch)
    assert "20 of them have a bar, 20 are within it" in compared
