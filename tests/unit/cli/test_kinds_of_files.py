"""A file of another kind than a command needs is called what it is, whatever its name, and what to do with it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.messages import says

from edesign import yaml_parser
from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.file_kinds import recognise
from edesign.file_kinds.kinds import (
    BUILDING,
    CHECKED_KINDS,
    PROJECT,
    STRUCTURE,
    STUDY,
    SUBSTRUCTURE_TESTS,
    YAML_KINDS,
    FileKind,
)
from edesign.file_kinds.recognise import kind_of, kind_of_content, kind_of_keys
from edesign.report.check.by_kind import SUMMARIES
from edesign.schema import kinds as schema_kinds

ROOT = Path(__file__).parents[3]
SIGNS = (*":?-{}[],#&*!|>'\"%@ \t\n\r", ": ", "? ", "\u2028", "\ufeff", "---\n", "...\n", "edesign: 1\n")
"""Which mean something to YAML."""
TEXTS = {
    "project": "# a project\nedesign: 1\ntitle: x\n",
    "study": "edesign_study: 1\n",
    "building": "{edesign_building: 1}\n",
    "tests": "edesign_rts: 1\nrig: {kind: ideal}\n",
    "suite": "title: last is well\nedesign_suite: 1\n",
    "reference": "edesign_reference: 1\n",
    "rig": "rig: {kind: ideal}\nsource: mine\n",
    "law": "type: mgmm\nparameters: {}\n",
    "campaign": "specimen: {}\ntests:\n  - {file: a.csv}\n",
    "structure": "structure: {}\nchannels: {}\ntests: []\n",
    "properties": "specimen: {}\nproperties: a.csv\n",
    "table": "Lab: 7\ntime_s;command_mm\n# one\n0,0;0,1\n0,1;0,2\n",
}
NAMES = {
    "archive": "an archive of results (HDF5)",
    "table": "a table of numbers (CSV)",
    "tests": "a substructure test file",
    "campaign": "a campaign or programme file",
    "structure": "a campaign file",
    "properties": "a campaign file",
}
"""In messages; otherwise `a NAME file`."""
CAMPAIGNS = ("campaign", "structure", "properties")
ACTION = ("--ground", "B", "--a-gr", "0.2 g")
COMMANDS: dict[str, tuple[list[str], tuple[str, ...]]] = {
    "show": (["show", "FILE"], ("archive",)),
    "report": (["report", "FILE"], ("archive",)),
    "export": (["export", "FILE"], ("archive",)),
    "compare": (["compare", "FILE", "reference"], ("archive",)),
    "compare with": (["compare", "archive", "FILE"], ("reference",)),
    "check": (["check", "FILE"], (*TEXTS, "archive")),
    "run": (["run", "FILE"], ("project", "study", "building", "tests")),
    "design": (["design", "FILE"], ("building",)),
    "extract": (["extract", "FILE", "--frame", "A", "-o", "made.yaml"], ("building",)),
    "translate": (["translate", "FILE", "made.py"], ("project", "building")),
    "test": (["test", "FILE"], ("campaign",)),
    "calibrate": (["calibrate", "FILE"], CAMPAIGNS),
    "fit": (["fit", "FILE"], CAMPAIGNS),
    "characterise": (["characterise", "FILE"], (*CAMPAIGNS, "table")),
    "spectrum": (["spectrum", "FILE", *ACTION], ("suite", "table")),
    "match": (["match", "FILE", *ACTION], ("suite", "table")),
    "rts check": (["rts", "check", "FILE"], ("tests",)),
    "rts run": (["rts", "run", "FILE"], ("tests",)),
    "rts export": (["rts", "export", "FILE", "none", "-o", "made"], ("tests",)),
    "rts serve": (["rts", "serve", "FILE"], ("tests",)),
    "rts identify": (["rts", "identify", "FILE"], ("table",)),
    "rts judge": (["rts", "judge", "FILE"], ("table",)),
    "rts judge by": (["rts", "judge", "table", "--rts", "FILE"], ("tests",)),
}
"""Words of each command, and the kinds that it takes."""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a file of each kind, under names that say nothing."""
    folder = tmp_path_factory.mktemp("kinds")
    for kind, text in TEXTS.items():
        (folder / kind).write_text(text, encoding="utf-8")
    with ArchiveWriter(folder / "archive.h5", Group(attributes={"title": "x", "planned": []})) as writer:
        writer.finish({"status": "completed"})
    (folder / "archive.h5").rename(folder / "archive")
    return folder


@pytest.fixture
def files(made: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The same, as the folder of the process."""
    monkeypatch.chdir(made)
    return made


@pytest.mark.parametrize("kind", [*TEXTS, "archive"])
def test_a_kind_is_recognised_by_content(files: Path, kind: str) -> None:
    found = kind_of(files / kind)
    assert found is not None and found.described.startswith(NAMES.get(kind, f"a {kind} file"))


@pytest.mark.parametrize("kind", [*YAML_KINDS, *CHECKED_KINDS], ids=lambda kind: kind.schema or kind.name)
def test_no_kind_of_file_is_forgotten(kind: FileKind) -> None:
    """Each has a model and a guide, and `check` prints what is in it; a structure alone is no file of its own."""
    run = (PROJECT, STUDY, BUILDING, SUBSTRUCTURE_TESTS)
    reported = kind_of_keys(kind.keys)
    assert reported is not None and (reported == kind or kind.entries is not None)
    if kind == STRUCTURE:
        return
    assert (reported in SUMMARIES) != (reported in run)
    assert schema_kinds.KINDS[kind.schema] == kind and schema_kinds.model_of(kind).model_fields.keys() >= set(kind.keys)
    assert (ROOT / "docs" / kind.guide).is_file()


@pytest.mark.parametrize("text", ["", "- 1\n- 2\n", "title: x\n", "DIN 4150\n", "a: [1,\n 2, 3,\n 4]\n", "\0"])
def test_nothing_is_said_of_other_files(tmp_path: Path, text: str) -> None:
    (tmp_path / "x").write_text(text, encoding="utf-8")
    assert kind_of(tmp_path / "x") is None and kind_of(tmp_path) is None and kind_of(tmp_path / "y") is None


@pytest.mark.skipif(yaml_parser._QUICK is None, reason="PyYAML was built without libyaml")
@given(
    st.sampled_from([*TEXTS.values(), "a: [1,\n 2]\nPGA: 3 at 00:05 {x\n"]),
    st.lists(st.tuples(st.integers(0, 50), st.integers(0, 2), st.sampled_from(SIGNS)), max_size=3),
)
def test_the_quick_parser_finds_the_same_kind(text: str, edits: list[tuple[int, int, str]]) -> None:
    """As PyYAML's own parser alone, of texts right and wrong, and where the parser is left out."""
    for place, cut, new in edits:
        text = text[:place] + new + text[place + cut :]
    quickly = kind_of_content(text.encode())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(yaml_parser, "_QUICK", None)
        patch.setattr(recognise, "_MAY_HAVE_KEYS", re.compile(""))
        assert kind_of_content(text.encode()) == quickly


@pytest.mark.parametrize("kind", [*TEXTS, "archive"])
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_says_what_a_file_of_another_kind_is(
    files: Path, capsys: pytest.CaptureFixture[str], command: str, kind: str
) -> None:
    words, taken = COMMANDS[command]
    if kind in taken:
        return
    before = sorted(files.iterdir())
    assert main([kind if word == "FILE" else word for word in words]) in (2, 4)
    error = capsys.readouterr().err
    assert f"{kind}:" in error and f"this is {NAMES.get(kind, f'a {kind} file')}" in error and "Traceback" not in error
    assert sorted(files.iterdir()) == before


def test_compare_says_which_file_comes_first(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compare", "reference", "archive"]) == 2
    assert says(capsys.readouterr().err, "`edesign compare archive reference` E-CLI-05")
    assert main(["compare", "archive", "archive"]) == 2
    assert says(capsys.readouterr().err, "archive: reference E-FILE-05")


FOREIGN = {
    "x.pdf": (b"%PDF-1.4\n\xff", "this is a PDF document"),
    "x.png": (b"\x89PNG\r\n\x1a\n", "this is a picture"),
    "x.xlsx": (b"PK\x03\x04\x14\x00\x06", "this is a workbook or another zip file"),
    "x.gz": (b"\x1f\x8b\x08\x00", "this is a compressed file"),
    "x.html": (b"<!DOCTYPE html>\n<html>", "this is a page of HTML"),
    "x.s2k": (b'File x\nTABLE:  "PROGRAM CONTROL"\n', "this is a model of SAP2000 (text)"),
    "x.AT2": (b"PEER\nx\nG\nNPTS=  2, DT= .01 SEC\n 0.1 0.2\n", "this is a recorded motion"),
}
"""Content of files of other programs, and what messages call them."""


@pytest.mark.parametrize("words", [["show", "FILE"], ["run", "FILE"], ["fit", "FILE"], ["compare", "archive", "FILE"]])
@pytest.mark.parametrize("name", FOREIGN)
def test_a_file_of_another_program_is_called_what_it_is(
    files: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], words: list[str], name: str
) -> None:
    content, message = FOREIGN[name]
    (tmp_path / name).write_bytes(content)
    assert main([str(tmp_path / name) if word == "FILE" else word for word in words]) in (2, 4)
    error = capsys.readouterr().err
    assert f"{name}: {message}" in error and "damaged" not in error and "Traceback" not in error


@pytest.mark.parametrize(
    ("content", "message"),
    [(b"", "this is a file without content"), (b"notes: [\n", "this is a file of text"), (b'{"a": 1}', "file of JSON")],
)
def test_what_is_no_archive_is_not_called_a_damaged_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], content: bytes, message: str
) -> None:
    (tmp_path / "x.h5").write_bytes(content)
    assert main(["show", str(tmp_path / "x.h5")]) == 4
    assert message in capsys.readouterr().err


def test_mistakes_in_the_file_come_before_options_that_do_not_belong_to_it(
    files: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["sheet", "nowhere.yaml", "--temperature", "20 degC"]) == 2
    assert main(["characterise", "nowhere.yaml", "--layers", "1"]) == 2
    assert capsys.readouterr().err.count("[E-FILE-01]") == 2


def test_a_study_is_translated_by_its_project(files: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["translate", "study", "made.tcl"]) == 2
    assert says(capsys.readouterr().err, "study: `edesign show ARCHIVE --devices DESIGN` E-FILE-05")


def test_show_prints_the_devices_of_a_design(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "a.h5"
    with ArchiveWriter(path, Group(attributes={"title": "x", "planned": []})) as writer:
        writer.write(
            "designs/added", Group(attributes={"status": "completed", "devices": "devices:\n- kind: chevron\n"})
        )
        writer.write("designs/broken", Group(attributes={"status": "failed", "devices": "devices: []\n"}))
        writer.finish({"status": "completed"})
    assert main(["show", str(path), "--devices", "added"]) == 0
    assert capsys.readouterr().out == "devices:\n- kind: chevron\n"
    assert main(["show", str(path), "--devices", "broken"]) == 2
    assert main(["show", str(path), "--devices", "adde"]) == 2
    reported = capsys.readouterr().err
    assert says(reported, "--devices: `broken` E-ARCH-08") and "did you mean `added`" in reported
