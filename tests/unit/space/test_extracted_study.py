"""The study that `edesign extract --study` writes: it is read as it stands, and says what the building says."""

from __future__ import annotations

from pathlib import Path

import pytest
from building_examples import SMALL
from typer.testing import CliRunner

from edesign.cli.main import app
from edesign.codes.ec8.ground import ground_type
from edesign.frame.project_file import load_study
from edesign.ground_motion.sources import find_suite
from edesign.ground_motion.suite import load_suite
from edesign.project.dampers.designs import StrainEnergyDesign
from edesign.project.study.study import Study


def extract(folder: Path, text: str, *more: str, frame: str = "X2") -> str:
    """Run the command in a folder; returns what it prints."""
    (folder / "building.yaml").write_text(text, encoding="utf-8")
    names = ["-o", str(folder / "frame.yaml"), "--study", str(folder / "study.yaml")]
    done = CliRunner().invoke(app, ["extract", str(folder / "building.yaml"), "--frame", frame, *names, *more])
    return done.output if done.exit_code == 0 else f"{done.exception or ''}{done.output}"


def study_of(folder: Path, text: str, *more: str) -> Study:
    said = extract(folder, text, *more)
    assert "study.yaml written" in said, said
    return load_study(folder / "study.yaml")


def test_the_study_is_that_of_the_building(tmp_path: Path) -> None:
    """Limit of ductile partitions 0.75 %, nu 0.5: 1.5 % at the level of the design; a second level is judged too."""
    two = SMALL.replace("{DBE: {probability: 10 %}}", "{DBE: {probability: 10 %}, MCE: {return_period: 2475 year}}")
    study = study_of(tmp_path, two.replace("  ductility_class", "  level: DBE\n  ductility_class"))
    drift, residual = study.criteria
    assert (drift.most, residual.most) == (pytest.approx(0.015), pytest.approx(0.005))
    assert study.objectives == ("h", "l")
    design = study.designs["dampers"]
    assert isinstance(design, StrainEnergyDesign) and design.verify is not None
    assert design.bays.numbers(1, 2) == (1, 2) and design.verify.levels == ("DBE",)
    assert study.base.damping is not None and study.base.integration is not None


@pytest.mark.parametrize("storey", [1, 2])
def test_a_bay_without_a_beam_has_no_dampers(tmp_path: Path, storey: int) -> None:
    """Of the two bays of X2 the second lacks its beam at one floor."""
    gone = f"missing: {{beams: [{{along: x, frames: 2, bays: 2, floors: {storey}}}]}}\nmaterials: {{"
    design = study_of(tmp_path, SMALL.replace("materials: {", gone, 1)).designs["dampers"]
    assert isinstance(design, StrainEnergyDesign) and design.bays.numbers(1, 2) == (1,)


def test_motions_are_simulated_for_the_ground_until_recordings_are_named(tmp_path: Path) -> None:
    """Ground B: 360 to 800 m/s. Of seven motions the mean counts; their peaks need no factor above 3."""
    study_of(tmp_path, SMALL)
    suite = load_suite(tmp_path / "study_records.yaml")
    found = find_suite(suite, [])
    assert [one.origin for one in found] == ["simulated"] * 7
    low, high = ground_type("B").v_s30 or (0.0, 0.0)
    assert all(low < (entry.simulated.v_s30 if entry.simulated else 0.0) < high for entry in suite.records)
    peaks = [float(abs(one.record.acceleration).max()) for one in found]
    assert all(1 / 3 < 0.24 * 9.81 * 1.2 / peak < 3 for peak in peaks)


def test_recordings_and_drift_of_the_command(tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    study = study_of(tmp_path, SMALL, "--recordings", str(tmp_path / "mine"), "--drift", "1 %")
    assert study.criteria[0].most == pytest.approx(0.01)
    assert 'folders: ["mine"]' in study.base.text or "folders: [mine]" in study.base.text


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("masses: {from_loads: {}}\n", "", "a study needs `masses`"),
        (
            "hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}\n",
            "",
            "a study needs a `hazard` with `levels`",
        ),
        (
            "  - {along: y, frames: [A, C]",
            "  - {along: x, frames: 2, bays: all, kind: cross, section: CHS101.6x5, material: S275}\n"
            "  - {along: y, frames: [A, C]",
            "[E-SPACE-06]",
        ),
    ],
)
def test_what_a_study_needs(tmp_path: Path, old: str, new: str, said: str) -> None:
    output = extract(tmp_path, SMALL[: SMALL.index("design:")].replace(old, new))
    assert said in output and not (tmp_path / "frame.yaml").exists()


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (["--recordings", "nowhere"], "--recordings: there is no folder `nowhere`"),
        (["--drift", "0.5 m"], "--drift: `0.5 m` has the unit `m`"),
        (["--drift", "-1 %"], "--drift: `-1 %` is out of range"),
    ],
)
def test_options_that_are_wrong(tmp_path: Path, more: list[str], said: str) -> None:
    assert said in extract(tmp_path, SMALL, *more)


def test_options_of_a_study_without_one(tmp_path: Path) -> None:
    (tmp_path / "building.yaml").write_text(SMALL, encoding="utf-8")
    arguments = ["extract", str(tmp_path / "building.yaml"), "--frame", "X2", "-o", str(tmp_path / "frame.yaml")]
    done = CliRunner().invoke(app, [*arguments, "--drift", "1 %"])
    assert done.exit_code != 0 and "give --study FILE too" in f"{done.exception}{done.output}"
