"""Completion in shells: the protocol by which bash, zsh and fish ask, and what typer writes for them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from edesign.cli.main import COMPLETE, main
from edesign.project.template import new_project


def bash(line: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> list[str]:
    """What bash receives for the last word of a line."""
    monkeypatch.setenv("COMP_WORDS", line)
    monkeypatch.setenv("COMP_CWORD", str(len(line.split(" ")) - 1))
    monkeypatch.setenv(COMPLETE, "complete_bash")
    assert main([]) == 0
    shown = capsys.readouterr()
    assert shown.err == ""
    return shown.out.split()


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("edesign cal", ["calibrate"]),
        ("edesign laws ze", ["zener"]),
        ("edesign new x --template s", ["study", "shaken", "substructure"]),
        ("edesign sections HEB30", ["HEB300"]),
        ("edesign effects mul", ["mullins"]),
        ("edesign schema proj", ["project"]),
        ("edesign records thesis", ["thesis_table_5_6"]),
        ("edesign fit campaign.yaml --law mg", ["mgmm"]),
        ("edesign check FOLDER/proj", []),  # bash completes files then
        ("edesign run FOLDER/project.yaml --only damped_D", ["damped_DBE_1", "damped_DBE_2"]),
        ("edesign run FOLDER/suite.yaml --only x", []),
        ("edesign run nowhere.yaml --only x", []),
        ("edesign run 'FOLDER/project.yaml --only damped_D", []),
        ("edesign show FOLDER/project.yaml --analysis x", []),
    ],
)
def test_names_are_offered(
    line: str,
    offered: list[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    new_project(tmp_path, kind="damped")
    assert bash(line.replace("FOLDER", str(tmp_path)), monkeypatch, capsys) == offered


def test_compensators_of_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = new_project(tmp_path, kind="substructure")
    assert bash(f"edesign rts export {path} ", monkeypatch, capsys) == ["none", "cubic", "adaptive"]


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells(shell: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setenv("_TYPER_COMPLETE_ARGS", "edesign laws ze")
    monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "get-args")
    monkeypatch.setenv(COMPLETE, f"complete_{shell}")
    assert main([]) == 0
    assert "zener" in capsys.readouterr().out
    if shell == "fish":  # which asks by the exit code whether it should offer files
        monkeypatch.setenv("_TYPER_COMPLETE_FISH_ACTION", "is-args")
        assert main([]) == 0
        monkeypatch.setenv("_TYPER_COMPLETE_ARGS", "edesign check x")
        assert main([]) == 1


def test_a_process_is_asked_as_a_shell_asks(tmp_path: Path) -> None:
    environment = {**os.environ, COMPLETE: "complete_bash", "COMP_WORDS": "edesign quan", "COMP_CWORD": "1"}
    command = [sys.executable, "-m", "edesign"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=120, check=True)
    assert done.stdout.strip() == "quantities" and done.stderr == ""


def test_installation_writes_below_home_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("bash", "/bin/bash"))
    monkeypatch.setenv("HOME", str(tmp_path))
    assert main(["--install-completion"]) == 0
    assert "completion installed" in capsys.readouterr().out
    script = tmp_path / ".bash_completions" / "edesign.sh"
    assert COMPLETE in script.read_text() and str(script) in (tmp_path / ".bashrc").read_text()
    assert main(["--show-completion"]) == 0
    assert COMPLETE in capsys.readouterr().out


def test_what_cannot_be_installed_is_an_error_of_the_user(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("tcsh", "/bin/tcsh"))
    assert main(["--install-completion"]) == 2
    assert "shell" in capsys.readouterr().err
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("bash", "/bin/bash"))
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("HOME", str(tmp_path / "file"))
    assert main(["--install-completion"]) == 2
    error = capsys.readouterr().err
    assert str(tmp_path / "file") in error and "Traceback" not in error
