"""The whole path on the project of `edesign new`: check, run, show; needs the core."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from support.messages import says

from edesign.archive.reader import open_archive
from edesign.cli.main import main


@pytest.fixture
def project(tmp_path: Path) -> Path:
    assert main(["new", str(tmp_path / "p")]) == 0
    return tmp_path / "p" / "project.yaml"


def test_check_prints_the_frame_and_its_period(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", str(project)]) == 0
    output = capsys.readouterr().out
    assert "3 storeys, 11 m high; 3 bays, 18 m wide; 16 nodes" in output and "12 columns, 9 beams" in output
    assert "T1 = 1." in output and output.endswith("ok\n")
    assert sorted(path.name for path in project.parent.iterdir()) == ["project.yaml", "records"]  # nothing was run


def test_run_and_show_agree_with_the_archive(project: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["run", str(project), "--workers", "2"]) == 0
    capsys.readouterr()
    archive = project.with_suffix(".h5")
    assert main(["show", str(archive), "--json"]) == 0
    found = {item["name"]: item for item in json.loads(capsys.readouterr().out)["analyses"]}
    assert list(found) == [
        *("gravity", "modes"),
        *("pushover.first_mode", "pushover.first_mode.n2.DBE", "pushover.first_mode.n2.MCE"),
        *("pushover.uniform", "pushover.uniform.n2.DBE", "pushover.uniform.n2.MCE"),
        *("as_recorded", "design_earthquake"),
    ]
    assert {item["status"] for item in found.values()} == {"completed"}
    assert set(found["modes"]["measures"].values()) == {None}
    # The pushover goes to 150 % of the largest target displacement; gravity alone moves the roof by 1e-5 of the height.
    largest = found["pushover.uniform.n2.MCE"]["measures"]["roof_drift"]
    assert found["pushover.uniform"]["measures"]["roof_drift"] > 1.4 * largest
    assert found["pushover.uniform"]["measures"]["roof_acceleration_m_s2"] is None
    history = found["design_earthquake"]["measures"]
    assert all(value is not None for name, value in history.items() if not name.startswith(("damper_", "brace_")))
    assert history["roof_drift"] < history["interstorey_drift"]  # their weighted mean is not above the largest
    assert found["design_earthquake"]["statistics"]["energy_error"] < 1e-3
    with open_archive(archive) as opened:  # envelopes count every step, and so does a history with `every: 1`
        group = opened.group("analyses/design_earthquake")
    largest = abs(group.variables["base_shear"].values).max()
    assert history["base_shear_N"] == pytest.approx(largest, rel=6e-8)  # archived histories are float32


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("HEB240", "HEB241", "`HEB241` E-NAME-01"),
        ("4 m, 3.5 m", "4, 3.5 m", "E-UNIT-01"),
        ("supports: fixed", "suports: fixed", "`supports` E-KEY-01"),
    ],
)
def test_a_wrong_project_is_exit_code_2_and_nothing_is_written(
    project: Path, old: str, new: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text = project.read_text()
    assert old in text
    project.write_text(text.replace(old, new))
    assert main(["run", str(project)]) == 2
    errors = capsys.readouterr().err
    assert str(project) in errors and says(errors, message) and "Traceback" not in errors
    assert sorted(path.name for path in project.parent.iterdir()) == ["project.yaml", "records"]


@pytest.mark.parametrize("name", ["/tmp/out.h5", "a/b", "..", "elcentro"])
def test_an_unknown_analysis_is_refused_by_its_name(
    name: str, project: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["run", str(project), "--only", name]) == 2
    assert says(capsys.readouterr().err, f"{name!r} E-NAME-01")
    assert sorted(path.name for path in project.parent.iterdir()) == ["project.yaml", "records"]
