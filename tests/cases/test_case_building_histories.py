"""`edesign run building.yaml` with analyses: design and histories in one archive, options, and a run that goes on."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import numpy as np
import pytest
from building_examples import ANALYSED
from cases.small_frame import command, environment
from limited import limited
from typer.testing import CliRunner

from edesign.archive.reader import open_archive
from edesign.cli.main import app
from edesign.errors import AnalysisError, ArchiveError, InputError
from edesign.frame.building_file import load_building
from edesign.study.run.run import run_project

FILE = "\n".join(line for line in ANALYSED.splitlines() if "name: push," not in line)
SHORT = FILE.replace("pga: 0.3 g,", "pga: 0.05 g,").replace(
    "geometry: {columns: corotational", "geometry: {columns: linear"
)


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "building.yaml"
    path.write_text(SHORT, encoding="utf-8")
    return path


def test_design_and_histories_share_an_archive(file: Path) -> None:
    summary = run_project(load_building(file))
    assert summary.archive.name == "shaken.h5"
    assert [outcome.status for outcome in summary.outcomes] == ["completed"] * 3
    with open_archive(summary.archive) as archive:
        assert archive.complete
        assert archive.attributes["kind"] == "building"
        assert archive.attributes["planned"] == ["gravity", "modes", "shaken"]
        assert archive.has("building/members")
        shaken = archive.group("analyses/shaken")
        drift = shaken.variables["storey_drift"]
        assert drift.dims == ("time", "storey", "direction")
        assert np.all(np.abs(drift.values).max(axis=0)[:, 0] > 1e-4)
        assert shaken.attributes["height"] == 7.0


def test_a_run_goes_on_with_the_same_results(file: Path) -> None:
    """A run that was killed during the history, and one that was not."""
    whole = run_project(load_building(file)).archive
    with open_archive(whole) as archive:
        expected = archive.group("analyses/shaken")
    again = file.with_name("again.h5")
    process = subprocess.Popen(
        command("run", file, "--workers", "1", "--archive", again), stderr=subprocess.PIPE, text=True, env=environment()
    )
    assert process.stderr is not None
    with limited(process):
        next(line for line in process.stderr if line.startswith("[2/3]"))  # its end: the history begins
        process.send_signal(signal.SIGKILL)
        process.communicate(timeout=30)
    assert not again.exists()
    summary = run_project(load_building(file), again)
    assert [outcome.reused for outcome in summary.outcomes] == [True, True, False]
    with open_archive(again) as archive:
        assert archive.has("building/members")
        found = archive.group("analyses/shaken")
    assert set(found.variables) == set(expected.variables)
    for name, variable in expected.variables.items():
        np.testing.assert_array_equal(found.variables[name].values, variable.values, name)


def test_some_analyses_alone_have_an_archive_without_the_design(file: Path) -> None:
    summary = run_project(load_building(file), only=["modes"])
    assert summary.archive.name == "shaken.modes.h5"
    with open_archive(summary.archive) as archive:
        assert archive.attributes["planned"] == ["modes"]
        assert not archive.has("building")
    run_project(load_building(file))
    with pytest.raises(ArchiveError, match="this archive has 2 analyses that this run leaves out"):
        run_project(load_building(file), file.with_name("shaken.h5"), only=["modes"])


def test_a_building_without_a_design_is_analysed(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    design = text[text.index("design:\n") : text.index("fibres:")]
    file.write_text(text.replace(design, ""), encoding="utf-8")
    with open_archive(run_project(load_building(file), only=["gravity"]).archive) as archive:
        assert archive.group_attributes("analyses/gravity")["status"] == "completed"


def test_the_command(file: Path) -> None:
    """The checks of the small building are not met: `--check` says so after the histories."""
    found = CliRunner().invoke(app, ["run", str(file), "--check", "--only", "modes"])
    assert found.exit_code == 0, found.output
    found = CliRunner().invoke(app, ["run", str(file), "--check"])
    assert isinstance(found.exception, AnalysisError)
    assert str(found.exception).endswith("[E-RUN-02]")
    assert "shaken" in found.output
    assert file.with_name("shaken.h5").exists()


def test_outputs_that_do_not_exist_are_refused_before_the_first_history(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    file.write_text(text.replace("points: [1, 4]", "points: [1, 9]"), encoding="utf-8")
    with pytest.raises(InputError, match="building.yaml:"):
        run_project(load_building(file))
    assert not file.with_name("shaken.h5").exists()
