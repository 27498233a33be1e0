"""The templates of `edesign new`: complete, right as they are, and with data that can be made again."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.cli.main import main
from edesign.damper.testing.measured_files import read_test
from edesign.errors import InputError
from edesign.ground_motion.formats.at2 import read_at2
from edesign.project.template import DEFAULT, FOLDER, new_project, template, templates
from tools import template_data

NAMES = tuple(templates())
SHORT = {  # commands after `edesign new`, of those that it names or that its files do, that take a second or two
    "frame": ["run FOLDER/project.yaml --only as_recorded"],
    "damped": ["run FOLDER/project.yaml --only damped_DBE_1"],
    "study": ["run FOLDER/project.yaml"],
    "building": ["run FOLDER/building.yaml --check", "extract FOLDER/building.yaml --frame X2 -o FOLDER/frame.yaml"],
    "shaken": ["run FOLDER/building.yaml --only modes", "run FOLDER/study.yaml --only bare.modes"],
    "laboratory": ["characterise FOLDER/campaign.yaml"],
    "substructure": ["rts check FOLDER/rts.yaml"],
    "calibration": ["characterise FOLDER/campaign.yaml --cycles 1-6"],
}


def test_templates_are_the_folders_that_there_are() -> None:
    assert set(NAMES) == {path.name for path in FOLDER.iterdir() if path.is_dir()} - {"records"}
    assert DEFAULT in NAMES
    shipped = {path.name for path in (FOLDER / "records").iterdir()}
    assert shipped == {name for one in templates().values() for name in one.records}
    for one in templates().values():
        assert all(len(command) < 160 and command.startswith("edesign ") for command in one.next)
        assert (FOLDER / one.name / one.file).is_file() and len(one.about) < 110


@pytest.mark.parametrize("name", NAMES)
def test_each_file_of_a_template_is_right_as_it_is(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main_file = new_project(tmp_path / name, 'A "first" \\ test', name)
    assert main_file == tmp_path / name / template(name).file
    for path in sorted((tmp_path / name).glob("*.yaml")):
        assert main(["check", str(path)]) == 0
        shown = capsys.readouterr()
        assert shown.err == "" and shown.out.splitlines()[-1].startswith("ok")
        assert name == "substructure" or shown.out.endswith("ok\n")  # a test warns that its frame is linear
        if path == main_file:
            assert shown.out.startswith('title:      A "first" \\ test')


@pytest.mark.parametrize("name", NAMES)
def test_a_template_runs(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    new_project(tmp_path / name, kind=name)
    for command in SHORT[name]:
        assert main([word.replace("FOLDER", str(tmp_path / name)) for word in command.split()]) == 0


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_commands_that_are_named_run_one_after_the_other(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new_project(tmp_path / name, kind=name)
    for command in template(name).next:
        assert main([word.replace("FOLDER", str(tmp_path / name)) for word in command.split()[1:]]) == 0, command
    shown = capsys.readouterr().out
    if name == "calibration":  # programme.yaml has it hidden
        assert "payne.whole" in shown and "Explained" in shown
    if name == "laboratory":
        assert "mgmm suffices" in shown


@pytest.mark.slow
def test_the_study_says_what_dampers_are_for_and_sizes_those_of_the_damped_frame(tmp_path: Path) -> None:
    from edesign import load_project, load_study, open_archive, run_study, summarise

    study = load_study(new_project(tmp_path / "study", kind="study"))
    run_study(study)
    verdicts = {(one["criterion"], one["variant"]): one["verdict"] for one in summarise(study.archive_path)["criteria"]}
    damped = {criterion: verdict for (criterion, variant), verdict in verdicts.items() if variant == "damped"}
    shared = [criterion for criterion in damped if (criterion, "bare") in verdicts]  # not those of the design
    assert set(damped.values()) == {"met"}
    assert {verdicts[criterion, "bare"] for criterion in shared} == {"not met", "does not apply"}
    given = load_project(new_project(tmp_path / "damped", kind="damped"))
    assert given.dampers is not None
    (device,) = given.dampers.devices
    with open_archive(study.archive_path) as archive:
        areas = archive.group("designs/added").variables["layer_area"].values
    np.testing.assert_allclose(device.layer_area, areas, rtol=0.02)  # rounded to two digits


def test_nothing_is_replaced_and_nothing_is_half_written(tmp_path: Path) -> None:
    (tmp_path / "suite.yaml").write_text("mine")
    with pytest.raises(InputError, match=r"suite\.yaml: .*E-FILE-07"):
        new_project(tmp_path, kind="study")
    assert [path.name for path in tmp_path.iterdir()] == ["suite.yaml"]
    (tmp_path / "new").mkdir()
    (tmp_path / "new" / "records").write_text("no folder")
    with pytest.raises(InputError, match="E-FILE-07"):
        new_project(tmp_path / "new", kind="frame")
    assert [path.name for path in (tmp_path / "new").iterdir()] == ["records"]


def test_the_nearest_template_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="`laboratory`.*E-NAME-01"):
        new_project(tmp_path / "x", kind="labratory")
    assert not list(tmp_path.iterdir())


def test_a_title_is_one_line_of_text_and_stands_in_all_files(tmp_path: Path) -> None:
    new_project(tmp_path, "Tower: 'A'", "study")
    for name in ("study", "project"):
        assert "Tower: 'A'" in (tmp_path / f"{name}.yaml").read_text(encoding="utf-8")
    assert not any("@title@" in path.read_text(encoding="utf-8") for path in tmp_path.glob("*.yaml"))


def test_commands_can_be_pasted_into_a_shell() -> None:
    commands = template("frame").commands(Path("my frame"))
    assert commands[0] == "edesign check 'my frame/project.yaml'"


def test_records_are_those_that_the_simulation_makes() -> None:
    """Samples have eight digits in the files; the simulation is the same bit for bit on one kind of processor."""
    for name, record in template_data.records():
        shipped = read_at2(FOLDER / "records" / name)
        assert shipped.time_step == record.time_step and record.source in shipped.source
        np.testing.assert_allclose(shipped.acceleration, record.acceleration, atol=1e-6 * record.pga)


def test_every_record_says_that_it_is_simulated() -> None:
    for path in (FOLDER / "records").iterdir():
        head = path.read_text(encoding="utf-8").splitlines()[:2]
        assert "NOT RECORDED" in head[0] and "simulated record" in head[1]


@pytest.mark.parametrize("name", template_data.PROGRAMMES)
def test_damper_tests_are_those_that_the_programme_makes(name: str, tmp_path: Path) -> None:
    """Files have five digits, of forces and displacements up to their peaks."""
    found = dict(template_data.tests(name))
    shipped = {path.name: path for path in (FOLDER / name / "tests").iterdir()}
    assert set(found) == set(shipped)
    for file, text in found.items():
        (tmp_path / file).write_text(text)
        assert shipped[file].read_text(encoding="utf-8").startswith(template_data.TEST_HEAD)
        made, there = (read_test(path, temperature_C=20.0) for path in (tmp_path / file, shipped[file]))
        for one, other in ((made.displacement, there.displacement), (made.measured_force(), there.measured_force())):
            np.testing.assert_allclose(one, other, atol=1e-4 * np.max(np.abs(other)))


def test_the_templates_are_in_what_is_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    """By what setuptools would put into a wheel."""
    distributions = pytest.importorskip("setuptools.dist")
    root = FOLDER.parents[2]
    monkeypatch.chdir(root)
    distribution = distributions.Distribution()
    distribution.parse_config_files()
    build = distribution.get_command_obj("build_py")
    build.ensure_finalized()
    build.manifest_files = {}  # what version control knows does not count
    found = set()
    for package in (name for name in distribution.packages if name.startswith("edesign.project.templates")):
        found |= {root / file for file in build.find_data_files(package, package.replace(".", "/"))}
    assert found == {path for path in FOLDER.rglob("*") if path.is_file()}
