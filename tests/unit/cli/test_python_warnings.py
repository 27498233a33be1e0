"""No command writes a warning of Python or of its packages to standard error; --debug shows them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from unit.report.figure_archive import history, small_archive

import edesign

NAMELESS = "\u4e2d\u6587 \U0001f600"  # matplotlib warns of signs that its fonts do not have


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An archive with such a name, a project, and a programme of damper tests."""
    made = tmp_path_factory.mktemp("warnings")
    small_archive(made, ("analyses/other", history(NAMELESS, "Tabas1978_FER-L1", 50, 1.0)))
    edesign.new_project(made / "frame")
    (made / "programme.yaml").write_text(
        f"specimen: {{name: '{NAMELESS}', layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}}\n"
        "law: {type: zener, parameters: {k0: 1 kN/mm, k1: 2 kN/mm, c1: 1 kN*s/mm}}\n"
        "tests:\n  - {type: sine, strain: 10 %, frequency: 1 Hz, temperature: 20 degC}\n",
        encoding="utf-8",
    )
    return made


def errors_of(folder: Path, *words: str) -> str:
    """Standard error of a command under -W always, which shows what Python usually says once, or not at all."""
    command = [sys.executable, "-W", "always", "-m", "edesign", *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=600, check=False)
    assert done.returncode == 0, done.stderr
    return done.stderr


@pytest.mark.parametrize(
    "words",
    [
        ("report", "small.h5", "--quiet"),
        pytest.param(("show", "small.h5", "--figures", "figures", "--format", "png"), marks=pytest.mark.slow),
        ("run", "frame/project.yaml", "--quiet", "--only", "pushover"),
        ("test", "programme.yaml", "--output", "rig", "--figures", "rig_figures", "--format", "pdf", "--quiet"),
        ("spectrum", "--ground", "C", "--a-gr", "0.36g", "--csv", "s.csv", "--figure", "s.png"),
        ("laws", "zener"),
        ("sections", "HEB"),
    ],
    ids=lambda words: words[0],
)
def test_no_warning_reaches_standard_error(folder: Path, words: tuple[str, ...]) -> None:
    assert "Warning" not in errors_of(folder, *words)


@pytest.mark.slow
def test_debug_shows_warnings(folder: Path) -> None:
    assert "py.warnings: " in errors_of(folder, "report", "small.h5", "--quiet", "--debug")
