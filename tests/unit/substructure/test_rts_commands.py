"""The commands `edesign rts ...` given a file that is not theirs, or a place that is not theirs."""

from __future__ import annotations

import hashlib
import math
from pathlib import Path

import numpy as np
import pytest
from messages import says

from edesign.archive.reader import open_archive
from edesign.cli.main import main
from edesign.report.substructure.file import archived_tests
from edesign.report.substructure.tables import runs

MOVED = """\
edesign_rts: 1
rig: {kind: ideal}
compensators: {none: {kind: none}}
tests: [{name: cycles, kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz}}]
"""


def said(capsys: pytest.CaptureFixture[str], *words: str | Path, code: int = 2) -> str:
    """Call a command that must fail with one line, and return it."""
    assert main([str(word) for word in words]) == code
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    return error


@pytest.mark.parametrize("kind", ["project", "study", "building"])
@pytest.mark.parametrize("command", ["check", "run", "serve"])
def test_a_file_of_another_command_names_that_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], kind: str, command: str
) -> None:
    path = tmp_path / "x.yaml"
    path.write_text({"project": "edesign: 1\n"}.get(kind, f"edesign_{kind}: 1\n"), encoding="utf-8")
    error = said(capsys, "rts", command, path)
    assert f"this is a {kind} file; a substructure test file begins with `edesign_rts: 1`" in error
    assert says(error, "edesign: `edesign run` E-FILE-05")


def test_run_runs_substructure_tests_as_rts_run_does(tmp_path: Path) -> None:
    for words in (("run",), ("rts", "run")):
        path = tmp_path / "_".join(words) / "rts.yaml"
        path.parent.mkdir()
        path.write_text(MOVED, encoding="utf-8")
        assert main([*words, str(path), "--quiet"]) == 0
    rows = []
    for folder in ("run", "rts_run"):
        with open_archive(tmp_path / folder / "rts.h5") as archive:
            rows.append([run.text("outcome") for run in runs(archive)])
    assert rows[0] == rows[1] == ["done"]


def test_a_missing_file_is_called_what_it_would_be(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert says(said(capsys, "rts", "check", tmp_path / "rts.yaml"), "rts.yaml: E-FILE-01")


def test_an_archive_has_the_name_of_one_and_takes_no_other_place(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "rts.yaml"
    path.write_text(MOVED, encoding="utf-8")
    said_of = said(capsys, "rts", "run", path, "--quiet", "--archive", tmp_path / "x.txt")
    assert says(said_of, "x.txt: E-FILE-08")
    notes = tmp_path / "rts.h5.partial"
    notes.write_text("mine", encoding="utf-8")
    assert f"{notes}: cannot write the archive: this file is no archive" in said(
        capsys, "rts", "run", path, "--quiet", code=4
    )
    assert notes.read_text(encoding="utf-8") == "mine"
    assert sorted(item.name for item in tmp_path.iterdir()) == ["rts.h5.partial", "rts.yaml"]


@pytest.mark.parametrize(
    ("rig", "steps", "refused"),
    [
        ("proportional_gain: 990 /s", 1, False),  # a gain of 1 in a sub-step is the limit without a lag: det = -a / 2,
        ("proportional_gain: 1010 /s", 1, True),  # trace = 1 - 3/2 a, and 1 + trace + det = 2 - 2 a
        ("proportional_gain: 1010 /s", 2, False),
        ("proportional_gain: 1010 /s, valve_time_constant: 2.6 ms", 1, False),
        ("proportional_gain: 1e9 /s, valve_time_constant: 2.6 ms", 5, True),
    ],
)
def test_a_servo_rig_that_its_sub_steps_make_swing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], rig: str, steps: int, refused: bool
) -> None:
    path = tmp_path / "rts.yaml"
    text = MOVED.replace("{kind: ideal}", f"{{kind: servo_hydraulic, {rig}}}") + f"loop: {{sub_steps: {steps}}}\n"
    path.write_text(text, encoding="utf-8")
    if refused:
        assert says(said(capsys, "rts", "run", path, "--quiet"), "rig.proportional_gain: E-RTS-03")
    else:
        assert main(["rts", "run", str(path), "--quiet"]) == 0
        with open_archive(tmp_path / "rts.h5") as archive:
            assert runs(archive)[0].text("outcome") == "done"


def test_a_command_of_days_is_refused_before_it_takes_memory(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "days.csv").write_text("time_s,displacement_mm\n0,0\n1e9,1\n2e9,0\n", encoding="utf-8")
    path = tmp_path / "rts.yaml"
    path.write_text(
        MOVED.replace("type: sine, displacement: 5 mm, frequency: 2 Hz", "file: days.csv"), encoding="utf-8"
    )
    assert says(said(capsys, "rts", "check", path), "days.csv: 2e+09 5000000 E-RTS-01")


def test_a_command_that_begins_displaced_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """20 mm cos(2 pi t) moves 20 (2 pi) 1e-3 = 0.126 mm in a step of 1 ms, and would jump by 20 mm."""
    path = tmp_path / "rts.yaml"
    path.write_text(MOVED.replace("type: sine, displacement: 5 mm, frequency: 2 Hz", "file: u.csv"), encoding="utf-8")

    def write(first: float) -> None:
        lines = [f"{0.01 * i:g},{20.0 * math.sin(2.0 * math.pi * 0.01 * i + first):.9g}" for i in range(200)]
        (tmp_path / "u.csv").write_text("\n".join(["time_s,displacement_mm", *lines, ""]), encoding="utf-8")

    write(0.5 * math.pi)
    error = said(capsys, "rts", "run", path, "--quiet")
    assert says(error, "u.csv: 20 mm, E-RTS-02") and "moves 0.126 mm at most" in error
    assert "ramp from 0" in error and not (tmp_path / "rts.h5").exists()
    write(0.005)  # 0.1 mm, less than it moves in other steps
    assert main(["rts", "run", str(path), "--quiet"]) == 0


def test_two_runs_of_one_csv_name_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "rts.yaml"
    sine = "kind: command, command: {type: sine, displacement: 5 mm, frequency: 2 Hz}"
    compensators = "{b_c: {kind: none}, c: {kind: inverse, delay: 5 ms}}"
    text = MOVED.replace("{none: {kind: none}}", compensators).partition("tests:")[0]
    path.write_text(f"{text}tests: [{{name: a, {sine}}}, {{name: a_b, {sine}}}]\n", encoding="utf-8")
    error = said(capsys, "rts", "run", path, "--quiet", "--csv", tmp_path / "csv")
    assert says(error, "a_b_c.csv E-NAME-02")
    assert [item.name for item in tmp_path.iterdir()] == ["rts.yaml"]
    assert main(["rts", "run", str(path), "--quiet"]) == 0


def test_rig_and_law_in_files_are_archived_and_count(tmp_path: Path) -> None:
    """Each of two states of each file has a checksum of its own: that of the texts one after another."""
    path = tmp_path / "rts.yaml"
    text = MOVED.replace("rig: {kind: ideal}", "rig: {file: rig.yaml}\nspecimen: {law_file: law.yaml}")
    path.write_text(text, encoding="utf-8")
    for delay, k in ((5, 5), (15, 5), (5, 50)):
        rig = f"rig: {{kind: delay, delay: {delay} ms}}\n"
        law = f"type: kelvin_voigt\nparameters: {{k: {k} kN/mm, c: 1 N*s/m}}\n"
        (tmp_path / "rig.yaml").write_text(rig, encoding="utf-8")
        (tmp_path / "law.yaml").write_text(law, encoding="utf-8")
        assert main(["rts", "run", str(path), "--quiet"]) == 0
        with open_archive(tmp_path / "rts.h5") as archive:
            held = archive.group().variables
            assert str(held["rig_text"].values) == rig and str(held["law_text"].values) == law
            expected = hashlib.sha256("\n".join((text, rig, law)).encode()).hexdigest()
            assert archive.attributes["rts_checksum"] == expected


SHAKEN = """\
edesign_rts: 1
structure: {masses: [100 t], stiffnesses: [20 kN/mm], damping: {kind: modal, ratio: 2 %}}
specimen: {law_file: law.yaml}
rig: {kind: delay, delay: 4 ms}
loop: {main_step: 4 ms}
compensators: {none: {kind: none}, live: {kind: live_delay, delay: 2 ms}}
records: {shake: {file: shake.csv, acceleration_unit: m/s^2, columns: {time: 1, acceleration: 2}}}
tests:
  - {name: quake, kind: rts, record: shake}
  - {name: slow, kind: pseudo_dynamic, record: shake}
"""
LAW = "type: kelvin_voigt\nparameters: {k: 4 kN/mm, c: 100 kN*s/m}\n"


def shaken(folder: Path) -> Path:
    """A file of tests with a law file, under three seconds of a sine."""
    rows = "".join(f"{0.02 * i:.2f},{np.sin(2.0 * np.pi * 2.0 * 0.02 * i):.6f}\n" for i in range(151))
    (folder / "shake.csv").write_text(f"t,a\n{rows}", encoding="utf-8")
    (folder / "law.yaml").write_text(LAW, encoding="utf-8")
    (folder / "rts.yaml").write_text(SHAKEN, encoding="utf-8")
    return folder / "rts.yaml"


def test_an_edited_file_replaces_its_archive_and_says_what_goes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = shaken(tmp_path)
    assert main(["rts", "run", str(path), "--quiet"]) == 0
    path.write_text(SHAKEN.replace(", live: {kind: live_delay, delay: 2 ms}", ""), encoding="utf-8")
    assert main(["rts", "run", str(path)]) == 0
    assert "rts.h5, which has `quake:live` that rts.yaml no longer asks for" in capsys.readouterr().err
    with open_archive(tmp_path / "rts.h5") as archive:
        assert {run.compensator for run in runs(archive)} == {"none"}


def test_tests_by_other_methods_are_written_as_csv(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = shaken(tmp_path)
    assert main(["rts", "run", str(path), "--quiet", "--csv", str(tmp_path / "csv")]) == 0
    assert {one.name for one in (tmp_path / "csv").iterdir()} == {"quake_none.csv", "quake_live.csv", "slow.csv"}
    with open_archive(tmp_path / "rts.h5") as archive:
        kept = archive.group("tests/slow").variables
        (live,) = (run for run in runs(archive) if run.compensator == "live")
    table = np.loadtxt(tmp_path / "csv" / "slow.csv", delimiter=",", skiprows=1)
    for column, name, unit in ((1, "target", 1e-3), (2, "deformation", 1e-3), (3, "force", 1e3)):
        np.testing.assert_allclose(unit * table[:, column], kept[name].values, rtol=1e-8, atol=1e-15)
    # the rig is late by 4 ms alone; zero crossings between samples of 4 ms are those of straight lines
    assert live.value("estimated_delay") == pytest.approx(4e-3, rel=0.2)
    path.write_text(SHAKEN.replace("name: slow", "name: quake_none"), encoding="utf-8")
    error = said(capsys, "rts", "run", path, "--quiet", "--csv", tmp_path / "csv")
    assert says(error, "quake_none.csv E-NAME-02")


def test_a_report_takes_the_law_from_the_archive(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = shaken(tmp_path)
    assert main(["rts", "run", str(path), "--quiet"]) == 0
    (tmp_path / "law.yaml").write_text("type: none of these\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    with open_archive(tmp_path / "rts.h5") as archive:
        found = archived_tests(archive)
    assert found.notes == [] and found.laboratory is not None and found.laboratory.damper is not None
    assert found.laboratory.damper.values.values == (4e6, 1e5)
