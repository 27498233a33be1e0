"""No command writes over its inputs, and none replaces results of something else unless asked to."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
from support.messages import says
from unit.archive.archive_samples import archived_groups, write_layout_1
from unit.cli.small_project import Core, project
from unit.project.conftest import SMALL

from edesign.archive.dataset import Group
from edesign.archive.files import check_own_yaml, write_whole, write_yaml
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.cli.main import main
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.testing.measured_files import write_test
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.signals import sine
from edesign.errors import ArchiveError, InputError, Interrupted
from edesign.input_files import note_input, noting_inputs, spare_inputs
from edesign.project import Project
from edesign.study.run import analyses, run
from edesign.study.run.run import run_project

RUNNING = SMALL.replace("girder, material", "IPE400, material").partition("damping:")[0] + (
    "analyses:\n  - {name: modes, kind: modal, modes: 3}\n"
)
CAMPAIGN = """\
title: Pair of dampers
specimen: {name: pair, layers: 2, layer_area_mm2: 41400, layer_thickness_mm: 12}
law: {type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}}
tests:
  - {file: one.csv, temperature_C: 20, use: fit}
  - {file: two.csv, temperature_C: 20, use: validate}
"""
SPECIMEN = ("--layers", "2", "--layer-area", "41400 mm^2", "--layer-thickness", "12 mm", "--temperature", "20 degC")


@pytest.fixture
def lab(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with two tests of a linear damper and their campaign, in which the commands are called."""
    damper = Damper(law("kelvin_voigt"), {"k": 3e6, "c": 2e5})
    for name, amplitude in (("one", 0.004), ("two", 0.006)):
        time, u = sine(amplitude, 1.0, 16, sampling_rate=100.0)
        test = DamperTest(name, time, u, None, 20.0)
        write_test(tmp_path / f"{name}.csv", test.with_force(np.asarray(damper.force(time, u))))
    (tmp_path / "campaign.yaml").write_text(CAMPAIGN)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def link(how: Callable[[Path, Path], None], old: str, new: str) -> str:
    how(Path(old), Path(new))
    return new


LINKS = {"symbolic": lambda old, new: new.symlink_to(old), "hard": lambda old, new: os.link(old, new)}


def refused(capsys: pytest.CaptureFixture[str], *words: str, code: int = 2) -> str:
    """Call a command that must change no file, and return what it says."""
    before = {path: path.read_bytes() for path in Path().rglob("*") if path.is_file()}
    assert main(words) == code
    assert {path: path.read_bytes() for path in Path().rglob("*") if path.is_file()} == before
    return capsys.readouterr().err


@pytest.mark.parametrize("how", [None, *LINKS])
def test_a_table_is_not_written_over_a_test(lab: Path, how: str | None, capsys: pytest.CaptureFixture[str]) -> None:
    output = "one.csv" if how is None else link(LINKS[how], "one.csv", "table.csv")
    said = refused(capsys, "characterise", "one.csv", *SPECIMEN, "--output", output)
    assert says(said, f"{output}: E-FILE-06") and ("(one.csv)" in said) == (how is not None)
    said = refused(capsys, "characterise", "campaign.yaml", "--output", output)  # which only names it
    assert says(said, f"{output}: E-FILE-06")
    assert main(["characterise", "one.csv", *SPECIMEN, "--output", "new.csv"]) == 0
    assert main(["characterise", "one.csv", *SPECIMEN, "--output", "new.csv"]) == 0  # an earlier output may go


def test_a_file_named_like_an_unfinished_one_stays(lab: Path) -> None:
    shutil.copy("one.csv", "table.partial.csv")
    before = Path("table.partial.csv").read_bytes()
    assert main(["characterise", "table.partial.csv", *SPECIMEN, "--output", "table.csv"]) == 0
    assert Path("table.partial.csv").read_bytes() == before and Path("table.csv").read_text().startswith("temperature")
    os.symlink("one.csv", "other.partial.csv")
    write_whole(lab / "other.csv", lambda partial: partial.write_text("text"))
    assert Path("one.csv").read_bytes() == before and Path("other.csv").read_text() == "text"


def test_tables_have_the_ending_of_tables(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    Path("project.yaml").write_text(RUNNING)
    for words in (
        ("characterise", "one.csv", *SPECIMEN, "--output", "project.yaml"),
        ("spectrum", "--ground", "B", "--a-gr", "0.24 g", "--csv", "project.yaml"),
        ("compare", "none.h5", "none.yaml", "--csv", "project.yaml"),
        ("show", "none.h5", "--csv", "project.yaml"),
        ("sections", "HEB", "--csv", "project.yaml"),
        ("records", ".", "--csv", "project.yaml"),
        ("effects", "--csv", "project.yaml"),
    ):
        assert says(refused(capsys, *words), "project.yaml: .csv E-FILE-08")


def test_results_of_a_fit(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fit = ("fit", "campaign.yaml", "--law", "kelvin_voigt", "--starts", "1", "--quiet", "--output", "fits")
    Path("fits").mkdir()
    Path("fits/law.yaml").write_text("type: kelvin_voigt  # by hand\n")
    assert says(refused(capsys, *fit), "fits/law.yaml: E-FILE-07")
    assert main([*fit, "--overwrite"]) == 0 and main(fit) == 0  # its own result may be replaced
    assert (
        Path("fits/law.yaml")
        .read_text()
        .splitlines()[0]
        .endswith(' from "../campaign.yaml"; its next run replaces this file.')
    )
    shutil.copy("campaign.yaml", "other.yaml")
    said = refused(capsys, fit[0], "other.yaml", *fit[2:])
    assert says(said, "fits/law.yaml: ../campaign.yaml E-FILE-07")
    Path("both").mkdir()
    shutil.copytree(".", "both/moved", ignore=shutil.ignore_patterns("both"))
    monkey = os.getcwd()
    os.chdir("both/moved")
    try:
        assert main(fit) == 0  # a pair that moved is still one
    finally:
        os.chdir(monkey)
    shutil.copy("campaign.yaml", "fits/law.yaml")
    shutil.copy("one.csv", "fits/one.csv")
    shutil.copy("two.csv", "fits/two.csv")
    said = refused(capsys, fit[0], "fits/law.yaml", *fit[2:], "--overwrite")
    assert says(said, "fits/law.yaml: E-FILE-06")


def test_results_of_a_calibration(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    calibrate = ("calibrate", "campaign.yaml", "--output", "found", "--no-page", "--quiet")
    Path("found").mkdir()
    Path("found/law.yaml").write_text("type: kelvin_voigt\n")
    assert says(refused(capsys, *calibrate), "found/law.yaml: E-FILE-07")
    Path("found/law.yaml").unlink()
    with h5py.File("found/calibration.h5", "w") as file:
        file.attrs.update({"edesign_archive": 1, "kind": "calibration", "title": "Bars", "source_file": "../bars.yaml"})
    said = refused(capsys, *calibrate, code=4)
    assert says(said, "found/calibration.h5: calibration (`Bars`, ../bars.yaml) E-ARCH-05")
    for name in ("law.yaml", "calibration.json"):
        shutil.copy("campaign.yaml", name)
        assert says(refused(capsys, "calibrate", name, "--overwrite", "--quiet"), f"{name}: E-FILE-06")
        Path(name).unlink()


def test_a_programme_is_not_replaced_by_its_campaign(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    programme = (
        "specimen: {name: pair, layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}\n"
        "law: {type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 0.2 kN*s/mm}}\n"
        "tests:\n  - {type: record, file: 001_record_20C.csv, temperature: 20 degC}\n"
    )
    Path("campaign.yaml").write_text(programme)
    shutil.copy("one.csv", "001_record_20C.csv")
    said = refused(capsys, "test", "campaign.yaml", "--output", ".", "--overwrite", "--quiet")
    assert says(said, "campaign.yaml: E-FILE-06")
    Path("campaign.yaml").rename("programme.yaml")
    said = refused(capsys, "test", "programme.yaml", "--output", ".", "--quiet")
    assert says(said, "001_record_20C.csv: E-FILE-06")
    Path("properties.csv").write_text("by hand\n")
    said = refused(capsys, "test", "programme.yaml", "--output", ".", "--quiet")
    assert says(said, "properties.csv: E-FILE-07")


def test_matched_records_do_not_replace_the_recordings(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    time = np.arange(2000) * 0.01
    rows = np.column_stack([time, np.sin(9.0 * time) * np.exp(-0.3 * time)])
    Path("wave.csv").write_text("time_s,acceleration\n" + "\n".join(f"{t:.2f},{a:.6f}" for t, a in rows))
    words = (
        "match",
        "wave.csv",
        "--unit",
        "m/s^2",
        "--ground",
        "B",
        "--a-gr",
        "0.24 g",
        "--method",
        "scale",
        "--quiet",
        "--archive",
        "m.h5",
    )
    assert says(refused(capsys, *words, "--csv", "."), "wave.csv: E-FILE-06")
    assert main([*words, "--csv", "matched"]) == 0 and Path("matched/wave.csv").is_file()
    assert main(words) == 0  # its own archive may be replaced
    Path("other.csv").write_text(Path("wave.csv").read_text())
    said = refused(capsys, "match", "other.csv", *words[2:], code=4)
    assert says(said, "m.h5: matching ( wave.csv) E-ARCH-05")


def test_the_archive_of_another_project_stays(lab: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for folder in ("mine", "other"):
        Path(folder).mkdir()
        Path(folder, "project.yaml").write_text(RUNNING.replace("Small frame", f"Frame of {folder}"))
    assert main(["run", "other/project.yaml", "--quiet"]) == 0
    with Path("mine/project.yaml").open("a") as file:
        file.write("outputs: {archive: ../other/project.h5}\n")
    said = refused(capsys, "run", "mine/project.yaml", "--quiet", code=4)
    assert says(said, "project.h5: (`Frame of other`, project.yaml) --overwrite E-ARCH-05")
    # a project that moved with its archive, and changed its title, is still the same
    shutil.move("other", "moved")
    text = Path("moved/project.yaml").read_text().replace("Frame of other", "Frame that moved")
    Path("moved/project.yaml").write_text(text)
    assert main(["run", "moved/project.yaml", "--quiet"]) == 0
    shutil.move("moved", "other")
    assert main(["run", "mine/project.yaml", "--quiet", "--overwrite"]) == 0
    with open_archive("other/project.h5") as archive:
        assert archive.attributes["title"] == "Frame of mine"
        assert archive.attributes["source_file"] == "../mine/project.yaml"
    with h5py.File("foreign.h5", "w") as file:
        file["x"] = 1.0
    said = refused(capsys, "run", "other/project.yaml", "--archive", "foreign.h5", "--quiet", code=4)
    assert says(said, "foreign.h5: HDF5 E-FILE-07")
    said = refused(capsys, "run", "other/project.yaml", "--archive", link(LINKS["hard"], "other/project.yaml", "p.h5"))
    assert says(said, "p.h5: (other/project.yaml) E-FILE-06")
    link(LINKS["symbolic"], "other/project.yaml", "new.h5.partial")
    said = refused(capsys, "run", "other/project.yaml", "--archive", "new.h5")
    assert says(said, "new.h5.partial: (other/project.yaml) E-FILE-06")


def use(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(analyses, "run_analysis", Core())
    monkeypatch.setattr(run, "check_inputs", lambda *_: {})  # the small project has no frame
    monkeypatch.setattr(run, "project_warnings", lambda *_: [])


def test_an_archive_of_an_older_version_is_known_by_its_names(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch)
    path = run_project(project(tmp_path)).archive
    root = archived_groups(path)[""]
    del root.attributes["source_file"]
    write_layout_1(path, {"": root})
    run_project(project(tmp_path))
    for name, value in (("title", "large"), ("project_file", "large.yaml")):
        write_layout_1(path, {"": replace(root, attributes=root.attributes | {name: value})})
        with pytest.raises(ArchiveError, match="E-ARCH-05"):
            run_project(project(tmp_path))
        run_project(project(tmp_path), overwrite=True)


def test_an_interrupted_run_of_another_project_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def elsewhere() -> Project:
        (tmp_path / "other").mkdir(exist_ok=True)
        return project(tmp_path / "other", text="title: other")

    core = Core({("c", 3): lambda: os.kill(os.getpid(), 2)})
    monkeypatch.setattr(analyses, "run_analysis", core)
    monkeypatch.setattr(run, "check_inputs", lambda *_: {})  # the small project has no frame
    monkeypatch.setattr(run, "project_warnings", lambda *_: [])
    with pytest.raises(Interrupted):
        run_project(project(tmp_path))
    core.on.clear()
    path = tmp_path / "small.h5"
    with pytest.raises(ArchiveError, match=r"small\.h5\.partial: .*E-ARCH-05"):
        run_project(elsewhere(), path)
    assert partial_path(path).is_file()
    core.ran.clear()
    run_project(project(tmp_path))  # goes on with what is there
    assert core.ran == ["c", "d"]


def test_one_analysis_does_not_replace_the_archive_of_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    use(monkeypatch)
    path = run_project(project(tmp_path)).archive
    with pytest.raises(ArchiveError, match=r"small\.h5: .* 3 analyses .*\(b, c, d\).*E-ARCH-05"):
        run_project(project(tmp_path), path, only=["a"])
    run_project(project(tmp_path))
    run_project(project(tmp_path), path, only=["a"], overwrite=True)
    with open_archive(path) as archive:
        assert archive.attributes["planned"] == ["a"]


def test_files_that_a_command_wrote_itself_are_no_inputs(tmp_path: Path) -> None:
    note_input(tmp_path)  # nothing is noted outside
    spare_inputs(tmp_path)
    with noting_inputs():
        write_whole(tmp_path / "a.csv", lambda partial: partial.write_text("a"))
        note_input(tmp_path / "a.csv")
        write_whole(tmp_path / "a.csv", lambda partial: partial.write_text("b"))
        (tmp_path / "b.csv").write_text("b")
        note_input(tmp_path / "b.csv")
        with pytest.raises(InputError, match=r"b\.csv: .*E-FILE-06"):
            write_whole(tmp_path / "b.csv", lambda partial: partial.write_text("c"))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.csv", "b.csv"]


def test_any_first_line_is_read(tmp_path: Path) -> None:
    path = tmp_path / "law.yaml"
    for name in ("campaign.yaml", 'a "b" \\ c.yaml', "päir; it.yaml"):
        path.unlink(missing_ok=True)
        write_yaml("type: mgmm\n", path, tmp_path / name)
        check_own_yaml(path, tmp_path / name)
        with pytest.raises(InputError, match="law.yaml: .*E-FILE-07"):
            check_own_yaml(path, tmp_path / "other.yaml")
    for text in (
        b"",
        b"\xff\xfe\n",
        b'# Written by edesign 1 from "a',
        b'# Written by edesign 1 from "a" and "b"',
        b"x" * 100_000,
    ):
        path.write_bytes(text)
        with pytest.raises(InputError, match="E-FILE-07"):
            check_own_yaml(path, tmp_path / "campaign.yaml")


def test_the_report_of_a_calibration_is_not_replaced_by_an_empty_one(
    lab: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`edesign report` would write calibration.html, as `edesign calibrate` does, without any of its results."""
    root = Group(attributes={"title": "Bars", "kind": "calibration", "source_file": "bars.yaml", "planned": []})
    with ArchiveWriter("calibration.h5", root) as writer:
        writer.finish({"status": "completed"})
    Path("calibration.html").write_text("the effects")
    for command in ("report", "show"):
        assert says(refused(capsys, command, "calibration.h5", code=4), "calibration.html E-ARCH-08")
    assert Path("calibration.html").read_text() == "the effects"
    assert main(["export", "calibration.h5", "--list"]) == 0
