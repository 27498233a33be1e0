"""A campaign of a structure through the command: what is written, printed and refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import yaml
from messages import says
from typer.testing import CliRunner

from edesign.archive.reader import open_archive
from edesign.calibration.structures.campaign import load_structure_campaign
from edesign.calibration.structures.from_campaign import blank_problem
from edesign.cli.main import app, main
from edesign.damper.law_file import read_law_file, resolve

STEP, SAMPLES = 0.02, 300
STRENGTH, YIELDING = 10e3, 0.003
CAMPAIGN = """\
structure:
  name: block
  base: isolated
  floor_masses: [100 t]
law: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 100 kN*s/m}}
channels:
  time: time
  base_acceleration: table
  floor_accelerations: [a1]
  floor_displacements: [u1]
  units: {time: s, acceleration: m/s^2, displacement: mm}
tests:
  - {file: small.csv}
  - {file: large.csv}
  - {file: other.csv, use: validate}
"""


def base_motion(seed: int, size: float) -> np.ndarray:
    random = np.random.default_rng(seed)
    time = STEP * np.arange(SAMPLES)
    omega = np.linspace(1.0, 40.0, 50)
    sines = np.sin(np.outer(time, omega) + random.uniform(0.0, 6.3, omega.size)).sum(axis=1)
    return np.asarray(size * sines / np.max(np.abs(sines)) * np.sin(np.pi * time / time[-1]))


def write(folder: Path, name: str, base: np.ndarray, a: np.ndarray, u: np.ndarray) -> None:
    rows = np.column_stack((STEP * np.arange(SAMPLES), base, a, 1e3 * u))
    (folder / name).write_text("time,table,a1,u1\n" + "\n".join(",".join(f"{x:.9g}" for x in row) for row in rows))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A rigid block on a layer with a hidden Bouc-Wen force, by central differences at a twentieth of the step."""
    folder = tmp_path_factory.mktemp("block")
    (folder / "campaign.yaml").write_text(CAMPAIGN)
    fine = 20
    for seed, (name, size) in enumerate({"small.csv": 0.5, "large.csv": 2.5, "other.csv": 1.2}.items()):
        base = base_motion(seed, size)
        u = v = z = 0.0
        h, rows = STEP / fine, []
        ground = np.interp(np.arange((SAMPLES - 1) * fine + 1) / fine, np.arange(SAMPLES), base)
        for i, shaking in enumerate(ground.tolist()):
            force = 2e6 * u + 1e5 * v + STRENGTH * z
            if i % fine == 0:
                rows.append((-force / 1e5, u))
            v += h * (-force / 1e5 - shaking)
            u += h * v
            z += h * (v - 0.5 * abs(v) * z - 0.5 * v * abs(z)) / YIELDING
        found = np.array(rows)
        found += 0.005 * found.std(axis=0) * np.random.default_rng(seed + 9).standard_normal(found.shape)
        write(folder, name, base, found[:, 0], found[:, 1])
    return folder


def run(*arguments: object) -> tuple[int, str]:
    found = CliRunner().invoke(app, ["calibrate", *map(str, arguments)])
    return found.exit_code, f"{found.output} {found.exception or ''}".replace("\n", " ")


@pytest.mark.slow
def test_from_the_command_to_the_files(folder: Path) -> None:
    code, text = run(folder / "campaign.yaml", "--output", folder / "out", "-w", 1)
    assert code == 0, text
    reported = json.loads((folder / "out" / "calibration.json").read_text())
    (effect,) = reported["effects"]
    assert (effect["name"], effect["form"], effect["kind"]) == ("isolation_softening", "bouc_wen", "structure")
    assert (reported["verdict"], reported["subject"]) == ("explained", "structure")
    strength = effect["parameters"]["F"]
    assert strength["value"] == pytest.approx(STRENGTH, rel=0.1)
    # of one draw of noise: one in 400 is further off
    assert abs(strength["value"] - STRENGTH) < 3.0 * strength["standard_error"]
    error = reported["error"]["corrected"]
    assert error["validate"] < 0.02 * reported["error"]["refit"]["validate"]
    assert set(error["tests"]) == {"small", "large", "other"}
    assert "other: acceleration of floor 1" in error["channels"]
    assert "Explained: the tests show smooth hysteresis in the isolation layer" in text
    assert "structure.yaml has the building as corrected" in text and "law.yaml has" not in text

    # the files say the same building again: a linear layer beside an ideally plastic Bouc-Wen one
    beside = resolve(*read_law_file(folder / "out" / "law_beside_bouc_wen.yaml"), None)
    assert beside.values["Fy"] == pytest.approx(effect["parameters"]["F"]["value"], rel=1e-5)
    assert (beside.law.name, beside.values["alpha"]) == ("bouc_wen", 0.0)
    layer = resolve(*read_law_file(folder / "out" / "law.yaml"), None)
    assert layer.values["k"] == pytest.approx(reported["parameters"]["corrected"]["k"]["value"], rel=1e-5)
    written = yaml.safe_load((folder / "out" / "structure.yaml").read_text())
    again = yaml.safe_load(CAMPAIGN) | written
    (folder / "again.yaml").write_text(yaml.safe_dump(again))
    problem = blank_problem(load_structure_campaign(folder / "again.yaml"))
    declared = {one.name: one.centre for one in problem.base}
    assert declared == pytest.approx({name: layer.values[name] for name in "kc"}, rel=1e-5)

    page = (folder / "out" / "calibration.html").read_text()
    assert "Records before and after" in page and "m/s²" in page
    assert "kN)" not in page  # no axis or column of a damper test
    with open_archive(folder / "out" / "calibration.h5") as archive:
        group = archive.group("tests/small: acceleration of floor 1")
    assert group.variables["measured_acceleration"].values.size == SAMPLES


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("large.csv}", "large.csv, use: validate}", "1 with `use: fit`"),
        (", use: validate", "", "none has `use: validate`"),
        ("displacement: mm", "displacement: m", "the displacement of floor 1 is"),
    ],
)
def test_what_is_refused(folder: Path, old: str, new: str, message: str) -> None:
    path = folder / "wrong.yaml"
    path.write_text(CAMPAIGN.replace(old, new))
    code, text = run(path, "--output", folder / "none")
    assert code != 0 and says(text, message)


def test_floors_against_the_base_are_refused(folder: Path, tmp_path: Path) -> None:
    for name in ("small", "large", "other"):
        time, base, a, u = np.loadtxt(folder / f"{name}.csv", delimiter=",", skiprows=1).T
        write(tmp_path, f"{name}.csv", -base, a, 1e-3 * u)
    (tmp_path / "campaign.yaml").write_text(CAMPAIGN)
    code, text = run(tmp_path / "campaign.yaml", "--output", tmp_path / "out")
    assert code != 0 and "must point the same way" in text


def test_the_campaign_is_not_written_over(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "structure.yaml").write_text(CAMPAIGN)
    assert main(["calibrate", str(folder / "structure.yaml"), "--overwrite"]) == 2
    assert says(capsys.readouterr().err, "structure.yaml: E-FILE-06")
    assert (folder / "structure.yaml").read_text() == CAMPAIGN
