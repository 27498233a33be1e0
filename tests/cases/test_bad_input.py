"""What a user gets for bad input: exit code 2, where it stands and what is allowed, no traceback, and no archive.

How each value is checked is tested in tests/unit/project and tests/unit/ground_motion; this is the whole way, from the
command to what lies in the folder afterwards.
"""

from __future__ import annotations

from pathlib import Path

import pytest
from cases.small_frame import RECORD, edesign, place_of, write
from messages import says

from edesign import load_project, run_project
from edesign.archive.reader import open_archive
from edesign.cli.main import main

Capture = pytest.CaptureFixture[str]


def refused(capsys: Capture, *words: str | Path, code: int = 2) -> str:
    """Call a command that must refuse its input; return what it says."""
    assert main([str(word) for word in words]) == code
    output, errors = capsys.readouterr()
    assert output == "" and errors.startswith("edesign: ") and "Traceback" not in errors
    return errors.removeprefix("edesign: ")


def test_the_project_is_right_before_it_is_made_wrong(tmp_path: Path, capsys: Capture) -> None:
    assert main(["run", str(write(tmp_path))]) == 0
    assert "3 of 3 completed" in capsys.readouterr().out


# old text, new text, where the message points to (words in the new file), what it says
WRONG = {
    "unknown key": ("masses: {", "colour: red\nmasses: {", "colour", ["colour: ", "E-KEY-01", "`materials`"]),
    "misspelt key": ("  storeys: [4", "  storays: [4", "storays", ["frame.storays", "did you mean `storeys`?"]),
    "missing key": (
        ", material: S275}]\n  beams",
        "}]\n  beams",
        "{storeys: all",
        ["frame.columns[0].material", "E-KEY-02"],
    ),
    "duplicate key": ("  bays: [6 m]", "  bays: [6 m]\n  bays: [5 m]", "bays: [5", ["frame.bays", "line 4"]),
    "bare number": ("[4 m, 3 m]", "[4 m, 3]", "3]", ["frame.storeys[1]", "E-UNIT-01", "`3 m`"]),
    "wrong dimension": ("fy: 275 MPa", "fy: 275 kN", "275 kN", ["materials.S275.fy", "E-UNIT-02", "stress"]),
    "negative size": ("[6 m]", "[-6 m]", "-6 m", ["frame.bays[0]", "E-VALUE-02"]),
    "zero size": ("[4 m, 3 m]", "[4 m, 0 m]", "0 m]", ["frame.storeys[1]", "E-VALUE-02"]),
    "unknown section": ("HEB200", "HEB205", "HEB205", ["columns[0].section", "HEB205", "near it `HEB180`, `HEB200`"]),
    "zero step": ("time_step: 0.01 s", "time_step: 0 s", "0 s", ["integration.time_step", "E-VALUE-02"]),
    "output of no member": ("[C_A_1]", "[C_A_3]", "C_A_3", ["outputs.members[0]", "no member `C_A_3`", "did you mean"]),
    "output of no kind": (
        "members: [C_A_1]",
        "histories: [storey]",
        "storey]",
        ["outputs.histories[0]", "did you mean `storeys`?"],
    ),
    "output of no layer": (
        "members: [C_A_1]",
        "fibres: [{member: C_A_1, layers: 40}]",
        "40}",
        ["outputs.fibres[0].layers", "1 to 24"],
    ),
    "no analyses": ("analyses:\n", "analyses: []\nanalises:\n", "[]\nanalises", ["analyses", "empty"]),
    "more modes than there are": ("modes: 2", "modes: 9", "9}", ["analyses[0].modes: ", "8 degrees", "E-MODAL-03"]),
    "damping of no mode": ("ratio: 2 %", "ratio: 2 %, modes: [1, 12]", "[1, 12]", ["damping.modes: ", "E-MODAL-03"]),
    "step longer than the record": (
        "time_step: 0.01 s",
        "time_step: 1 s",
        "1 s}",
        ["integration.time_step: ", "(0.14 s)", "E-HIST-02"],
    ),
    "more steps than can be kept": (
        "time_step: 0.01 s",
        "time_step: 1e-12 s",
        "1e-12",
        ["integration.time_step: ", "1.4e+11", "10000000", "E-HIST-02"],
    ),
}


@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize(("old", "new", "words", "said"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_project_is_refused_where_it_is_wrong(
    tmp_path: Path, capsys: Capture, verb: str, old: str, new: str, words: str, said: list[str]
) -> None:
    path = write(tmp_path, (old, new))
    message = refused(capsys, verb, path)
    assert place_of(path, words) in message
    assert [part for part in said if part not in message] == []
    assert sorted(item.name for item in tmp_path.iterdir()) == ["motion.AT2", "project.yaml"]


def test_numbers_without_a_point_are_numbers(tmp_path: Path) -> None:
    """`1e-2` is text for YAML 1.1; here it is the number, bare and with a unit, and gives the same results."""
    plain = load_project(write(tmp_path))
    first = run_project(plain, tmp_path / "plain.h5")
    changes = (("0.01 s", "1e-2 s"), ("ratio: 2 %", "ratio: 2e-2"), ("hardening: 1 %", "hardening: 1E-2"))
    second = run_project(load_project(write(tmp_path, *changes)), tmp_path / "powers.h5")
    with open_archive(first.archive) as a, open_archive(second.archive) as b:
        for name in ("modes", "push", "shake"):
            one, other = (archive.group(f"analyses/{name}").variables for archive in (a, b))
            assert one.keys() == other.keys()
            assert all((one[key].values == other[key].values).all() for key in one)


# ---- frames that cannot stand

UNSTABLE = {
    "mechanism": (
        [("  columns: [", "  supports: pinned\n  releases: [{beams: {floors: all}, ends: both}]\n  columns: [")],
        ["mechanism", "A1.ux"],
    ),
    "on rollers": ([("  columns: [", "  supports: roller\n  columns: [")], ["mechanism", "A0.ux", "B0.ux"]),
    "not connected": (
        [("  columns: [", "  missing: {columns: [{storeys: 2}]}\n  columns: [")],
        ["A2, B2", "E-CORE-05"],
    ),
}


@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize(("changes", "said"), UNSTABLE.values(), ids=UNSTABLE.keys())
def test_a_frame_that_cannot_stand_is_refused_by_its_degrees_of_freedom(
    tmp_path: Path, capsys: Capture, verb: str, changes: list[tuple[str, str]], said: list[str]
) -> None:
    path = write(tmp_path, *changes)
    message = refused(capsys, verb, path)
    assert message.startswith(f"{path}:") and "frame: " in message
    assert [part for part in said if part not in message] == []
    assert not (tmp_path / "project.h5").exists()


def test_a_frame_that_buckles_under_gravity_says_so_and_where(tmp_path: Path, capsys: Capture) -> None:
    """Elastic columns under several times their critical load: a failed analysis, since only running it shows it."""
    elastic = ("law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %", "law: elastic, E: 210 GPa")
    path = write(tmp_path, elastic, ("G: 20 kN/m", "G: 5 MN/m"))
    assert main(["run", str(path)]) == 3
    errors = capsys.readouterr().err
    assert "3 of 3 analyses failed" in errors and "Traceback" not in errors
    assert "under the gravity loads" in errors and "unstable" in errors and "A1.ux" in errors


# ---- records

RECORDS = {
    "too few samples": (RECORD.replace("NPTS=  8", "NPTS=  9"), ":6:", "E-REC-05"),
    "no number": (RECORD.replace("0.20", "nan", 1), ":5:", "E-TABLE-08"),
    "text": (RECORD.replace("-0.20", "gap"), ":6:", "E-TABLE-08"),
    "zero length": ("", "", "E-REC-21"),
    "no samples": (RECORD.replace("NPTS=  8", "NPTS=  0"), ":4:", "E-REC-04"),
    "step of zero": (RECORD.replace(".0200", ".0000"), ":4:", "E-REC-20"),
    "binary": ("\0\1\2", "", "E-TABLE-01"),
    "another file": ("edesign: 1\n", "", "E-FILE-05"),
    "nothing to scale": (RECORD.replace("0.10", "0.00").replace("0.20", "0.00"), "", "E-HIST-01"),
}


@pytest.mark.parametrize(("record", "line", "said"), RECORDS.values(), ids=RECORDS.keys())
def test_a_bad_record_is_refused_before_anything_runs(
    tmp_path: Path, capsys: Capture, record: str, line: str, said: str
) -> None:
    path = write(tmp_path, record=record)
    message = refused(capsys, "run", path)
    assert f"{path}:16:" in message and "records.motion" in message  # who asks for it
    assert f"motion.AT2{line}" in message or not line
    assert says(message, said)
    assert not (tmp_path / "project.h5").exists() and not (tmp_path / "project.h5.partial").exists()


def test_only_the_records_that_are_needed_are_read(tmp_path: Path, capsys: Capture) -> None:
    path = write(tmp_path, record="")
    assert main(["run", str(path), "--only", "push"]) == 0
    assert "completed" in capsys.readouterr().out


# ---- files


def test_what_is_no_project_is_refused(tmp_path: Path, capsys: Capture) -> None:
    for content, said in ((b"", "empty"), (b"\x93NUMPY\x01", "not UTF-8"), (b"edesign: 1\n\ttitle: x\n", "tab")):
        path = tmp_path / "x.yaml"
        path.write_bytes(content)
        assert said in refused(capsys, "run", path)
    assert says(refused(capsys, "run", tmp_path / "y.yaml"), "y.yaml: E-FILE-01")


def test_a_file_of_another_kind_is_not_replaced_by_an_archive(tmp_path: Path, capsys: Capture) -> None:
    path = write(tmp_path)
    before = path.read_bytes()
    assert "E-FILE-06" in refused(capsys, "run", path, "--archive", path)
    message = refused(capsys, "run", path, "--archive", tmp_path / "notes.txt")
    assert says(message, "notes.txt: E-FILE-08")
    (tmp_path / "notes.h5").write_text("by hand\n")
    message = refused(capsys, "run", path, "--archive", tmp_path / "notes.h5", "--overwrite", code=4)
    assert says(message, "notes.h5: E-FILE-07") and path.read_bytes() == before
    assert (tmp_path / "notes.h5").read_text() == "by hand\n"
    (tmp_path / "zero.h5").symlink_to("/dev/zero")
    assert says(refused(capsys, "run", path, "--archive", tmp_path / "zero.h5", code=4), "zero.h5: E-FILE-06")
    (tmp_path / "zero.h5").unlink()
    assert sorted(item.name for item in tmp_path.iterdir()) == ["motion.AT2", "notes.h5", "project.yaml"]
    assert main(["run", str(path), "--quiet"]) == 0 and main(["run", str(path), "--quiet"]) == 0  # an older archive is


def test_an_older_archive_survives_a_project_that_became_wrong(tmp_path: Path, capsys: Capture) -> None:
    path = write(tmp_path)
    assert main(["run", str(path), "--quiet"]) == 0
    before = (tmp_path / "project.h5").read_bytes()
    refused(capsys, "run", write(tmp_path, ("HEB200", "HEB205")))
    refused(capsys, "run", write(tmp_path, record=""))
    assert (tmp_path / "project.h5").read_bytes() == before


def test_a_process_of_its_own_says_the_same(tmp_path: Path) -> None:
    path = write(tmp_path, ("HEB200", "HEB205"))
    call = edesign("run", path)
    assert (call.returncode, call.stdout) == (2, "")
    assert call.stderr.startswith(f"edesign: {place_of(path, 'HEB205')}: frame.columns[0].section: ")
    assert call.stderr.count("\n") == 1
