"""The commands as a user calls them: output, messages, exit codes; the numerical core is replaced by known numbers."""

from __future__ import annotations

import io
import json
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import typer
from support.messages import says
from unit.assess.known_history import known_history, known_modes
from unit.cli.small_project import Core, fail, project

import edesign
import edesign.cli.run  # loads what keeps `load_project` before a test replaces it
from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.cli.main import app, main
from edesign.cli.shared import progress
from edesign.project import loader
from edesign.study.run import analyses, run


@pytest.fixture
def core(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Core:
    """The fake core, and a loader that gives the small project for any file."""
    core = Core()
    monkeypatch.setattr(analyses, "run_analysis", core)
    monkeypatch.setattr(run, "check_inputs", lambda *_: {})  # the small project has no frame
    monkeypatch.setattr(run, "project_warnings", lambda *_: [])
    monkeypatch.setattr(loader, "load_project", lambda path, *_, **__: project(tmp_path, "ab"))
    return core


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    groups = {"modes": known_modes(), "el_centro": known_history(), "lost": known_history(status="failed")}
    root = Group(attributes={"title": "Two storeys", "planned": [*groups, "later"], "project_file": "p.yaml"})
    with ArchiveWriter(tmp_path / "a.h5", root) as writer:
        for order, (name, group) in enumerate(groups.items()):
            group.attributes |= {"order": order, "name": name}
            writer.write(f"analyses/{name}", group)
        return writer.finish({"status": "failed"})


def test_a_run_prints_a_line_an_analysis(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "project.yaml"]) == 0
    lines = capsys.readouterr().err.splitlines()
    assert [line.partition(" (")[0] for line in lines] == [
        "[1/2] a: completed",
        "[2/2] b: completed",
    ]


def test_run_prints_progress_lines_and_a_summary(
    core: Core, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(progress, "LOG_EVERY", 0.0)
    assert main(["run", "project.yaml"]) == 0
    output, errors = capsys.readouterr()
    said = [line for line in errors.splitlines() if line.startswith("[1/2] a: ")]
    assert said[0].startswith("[1/2] a: 0%") and said[-1].startswith("[1/2] a: completed (")
    assert f"archive: {tmp_path / 'small.h5'}" in output and "completed" in output


def test_a_failed_analysis_gives_exit_code_3_and_its_reason(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    core.on = {("a", 7): fail}
    assert main(["run", "project.yaml", "--quiet"]) == 3
    output, errors = capsys.readouterr()
    assert output == ""
    assert "1 of 2 analyses failed" in errors and "a: step 7 at 0.07 s: no convergence" in errors


def test_ctrl_c_gives_exit_code_130_and_says_what_was_kept(core: Core, capsys: pytest.CaptureFixture[str]) -> None:
    core.on = {("b", 5): lambda: os.kill(os.getpid(), signal.SIGINT)}
    assert main(["run", "project.yaml", "--workers", "1"]) == 130
    assert "1 of 2 analyses are finished and kept in" in capsys.readouterr().err
    core.on, core.ran = {}, []
    assert main(["run", "project.yaml"]) == 0
    assert core.ran == ["b"] and "[1/2] a: reused" in capsys.readouterr().err


def test_options_of_run(core: Core, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", "project.yaml", "--only", "b", "--archive", str(tmp_path / "x.h5"), "--workers", "2"]) == 0
    assert core.ran == ["b"] and (tmp_path / "x.h5").exists()
    assert main(["run", "project.yaml", "--only", "c"]) == 2
    assert says(capsys.readouterr().err, "'c' E-NAME-01")
    assert main(["run", "project.yaml", "--archive", str(tmp_path / "no" / "x.h5")]) == 4


def test_show_prints_tables(archive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(archive), "--all"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "Two storeys"

    def cells(start: str, after: str) -> list[str]:
        return next(line for line in lines[lines.index(after) :] if line.startswith(start)).split()

    assert cells("el_centro", "Analyses") == ["el_centro", "history", "-", "el_centro", "-", "completed"]
    assert cells("later", "Analyses")[-2:] == ["not", "run"]
    assert "lost: step 1500: no convergence" in lines
    assert cells("   1", "modes: periods") == ["1", "0.8000", "1.2500", "85.00", "85.00"]
    measures = "Response measures (largest absolute values)"
    expected = "el_centro 0.2100 0.02000 3.000 5.700 0.3300 300.0 300.0 5.000 11.00 2.000 900.0"  # m, %, kN, m/s2, mrad
    first = cells("el_centro", measures)  # a table of 120 characters, and below it the columns that are left
    rest = [line.split()[1:] for line in lines[lines.index(measures) + 4 :] if line.startswith("el_centro")][0]
    assert [*first, *rest] == expected.split()
    assert cells("lost *", measures)[3] == "-"  # no residual
    assert cells("el_centro", "Statistics") == ["el_centro", "2000", "4100", "30", "1", "0.310", "2.5e-09"]


def test_show_of_one_analysis_has_storeys_and_fallbacks(archive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(archive), "--analysis", "el_centro"]) == 0
    lines = capsys.readouterr().out.splitlines()
    rows = lines[lines.index("el_centro: storeys (largest absolute values)") + 3 :]
    assert rows[0].split() == ["2", "0.2100", "5.700", "0.3300", "100.0", "5.000"]  # the roof first
    assert rows[1].split() == ["1", "0.05000", "1.250", "0.2500", "300.0", "7.000"]
    fallbacks = lines[lines.index("el_centro: fallbacks") + 3]
    assert fallbacks.split(maxsplit=2) == ["250", "2.500", "halved step  4 substeps"]
    assert main(["show", str(archive), "--analysis", "nothing"]) == 2
    assert says(capsys.readouterr().err, "`modes`, `el_centro`, `lost`, `later`) E-ARCH-07")


def test_show_json_has_the_agreed_form(archive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(archive), "--json"]) == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    assert [item["name"] for item in found["analyses"]] == ["modes", "el_centro", "lost", "later"]
    assert [item["status"] for item in found["analyses"]] == ["completed", "completed", "failed", "not run"]
    for item in found["analyses"]:
        assert {"name", "variant", "record", "level", "status", "reason", "measures", "statistics"} <= item.keys()
        assert list(item["measures"]) == [
            "roof_displacement_m", "residual_roof_displacement_m", "final_roof_displacement_m", "roof_drift",
            "interstorey_drift", "residual_interstorey_drift", "final_interstorey_drift", "base_shear_N",
            "column_base_shear_N", "roof_acceleration_m_s2", "relative_roof_acceleration_m_s2",
            "beam_plastic_rotation_rad", "column_plastic_rotation_rad", "column_axial_force_N", "brace_ductility",
            "brace_damage", "damper_strain", "damper_deformation_m", "damper_force_N",
        ]  # fmt: skip
        statistics = {"steps", "iterations", "refactorisations", "fallbacks", "cpu_s", "energy_error"}
        assert statistics <= item["statistics"].keys()
    assert set(found["analyses"][0]["measures"].values()) == {None}
    assert found["analyses"][1]["measures"]["base_shear_N"] == 3e5
    assert found["analyses"][1]["statistics"]["energy_error"] == 2.5e-9
    assert found == edesign.summarise(archive)


def test_a_number_that_is_not_finite_becomes_null(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    group = known_history()
    group.add("base_shear_max", (), float("nan"), "N", "base shear")
    with ArchiveWriter(tmp_path / "a.h5", Group()) as writer:
        writer.write("analyses/x", group)
        writer.finish()
    assert main(["show", str(tmp_path / "a.h5"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["analyses"][0]["measures"]["base_shear_N"] is None


def test_show_reads_the_partial_archive_of_an_interrupted_run(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    root = Group(attributes={"title": "t", "planned": ["el_centro", "later"], "status": "running"})
    with ArchiveWriter(tmp_path / "a.h5", root) as writer:
        writer.write("analyses/el_centro", known_history())
    assert main(["show", str(partial_path(tmp_path / "a.h5"))]) == 0
    output = capsys.readouterr().out
    assert "not complete" in output and "not run" in output
    assert main(["show", str(tmp_path / "a.h5")]) == 4
    assert says(capsys.readouterr().err, "a.h5.partial E-ARCH-01")


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (["show", "nowhere.h5"], 4, "nowhere.h5: E-ARCH-01"),
        (["run", "nowhere.yaml"], 2, "nowhere.yaml: E-FILE-01"),
        (["check", "nowhere.yaml"], 2, "nowhere.yaml: E-FILE-01"),
        (["frobnicate"], 2, "No such command"),
        (["run"], 2, "Missing argument"),
        (["run", "x.yaml", "--workers", "0"], 2, "workers"),
    ],
)
def test_bad_input_is_a_message_and_no_traceback(
    words: list[str], code: int, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words) == code
    output, errors = capsys.readouterr()
    assert says(errors, message) and "Traceback" not in errors and output == ""


def test_an_unexpected_error_is_short_and_debug_shows_all(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object, **__: object) -> None:
        raise KeyError("hidden")

    monkeypatch.setattr(loader, "load_project", broken)
    assert main(["run", "x.yaml"]) == 1
    errors = capsys.readouterr().err
    assert "please report it" in errors and "KeyError" in errors and "Traceback" not in errors
    assert main(["run", "x.yaml", "--debug"]) == 1
    assert "Traceback" in capsys.readouterr().err


def test_new_makes_a_project_and_spares_an_old_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", str(tmp_path / "p")]) == 0
    assert "edesign run" in capsys.readouterr().out
    before = (tmp_path / "p" / "project.yaml").read_bytes()
    assert main(["new", str(tmp_path / "p")]) == 2
    assert (tmp_path / "p" / "project.yaml").read_bytes() == before


def test_help_version_and_module(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--version"]) == 0
    assert capsys.readouterr().out == f"edesign {edesign.__version__}\n"
    assert main(["--help"]) == 0
    output = capsys.readouterr().out
    assert all(word in output for word in ("new", "check", "run", "show", "130"))
    root = str(Path(edesign.__file__).parents[1])
    call = subprocess.run(
        [sys.executable, "-m", "edesign", "--version"], capture_output=True, text=True, cwd=root, check=False
    )
    assert (call.returncode, call.stdout) == (0, f"edesign {edesign.__version__}\n")


def test_the_sentence_of_a_command_begins_its_own_help() -> None:
    groups = [typer.main.get_command(app)]
    for group in groups:
        for name, command in group.commands.items():  # type: ignore[attr-defined]
            assert command.loaded.name == name
            assert command.loaded.help.partition("\n\n")[0].replace("\n", " ") == command.help
            groups += [command.loaded] if hasattr(command.loaded, "commands") else []
    assert len(groups) == 2


def test_importing_the_package_loads_nothing_heavy() -> None:
    root = str(Path(edesign.__file__).parents[1])
    heavy = ("numpy", "h5py", "scipy", "pydantic")
    code = f"import edesign, edesign.cli.main, sys; print([name for name in {heavy} if name in sys.modules])"
    call = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=root, check=True)
    assert call.stdout == "[]\n"


def test_a_check_does_not_load_what_it_does_not_need() -> None:
    """Archives, and the parts of scipy that take as long to load as all else that a check does."""
    root = Path(edesign.__file__).parents[1]
    heavy = ("h5py", "scipy.fft", "scipy.interpolate", "scipy.optimize", "scipy.signal", "scipy.special", "matplotlib")
    code = (
        "import sys; from edesign.cli.main import main; main(['check', 'projects/thesis_10_storey/study.yaml']); "
        f"print([name for name in {heavy} if name in sys.modules])"
    )
    call = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=root, check=True)
    assert call.stdout.splitlines()[-1] == "[]"


def test_documented_functions_exist() -> None:
    for name in edesign.__all__:
        assert getattr(edesign, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        edesign.nothing  # noqa: B018


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


def test_a_terminal_gets_a_bar_and_ruled_tables(
    core: Core, archive: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "160")
    output, errors = Terminal(), Terminal()
    monkeypatch.setattr(sys, "stderr", errors)
    assert main(["run", "project.yaml", "--quiet"]) == 0
    assert errors.getvalue() == ""
    assert main(["run", "project.yaml"]) == 0
    assert "━" in errors.getvalue() and "[1/2] a: completed" in errors.getvalue()
    monkeypatch.setattr(sys, "stdout", output)
    assert main(["show", str(archive)]) == 0
    assert "----" in output.getvalue() and "el_centro" in output.getvalue()
