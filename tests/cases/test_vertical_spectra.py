"""Vertical motion fitted to the vertical spectrum, and in studies: posts that are oscillators of axial stiffness."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import HERE
from messages import says

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.errors import InputError
from edesign.frame.project_file import load_project, load_study
from edesign.project.reading.problems import ProjectError
from edesign.project.study.study_loader import StudyError
from edesign.study.run.run import run_project, run_study

MASS, STIFFNESS = 50e3, 210e9 * 1e-3 / 4.0  # kg on a post (the mass of each node), N/m
HAZARD = """\
hazard:
  code: ec8-2004
  a_gR: 2 m/s2
  ground: B
  spectrum: 1
  levels: {DBE: {gamma_I: 1}, MCE: {gamma_I: 1.5}}
"""
FITTED = """\
  shaken: {file: @motion@, acceleration_unit: m/s^2, match: {method: scale, periods: [0.1 s, 1 s]}}
  fitted:
    file: @motion@
    acceleration_unit: m/s^2
    processing: [{resample: {time_step: 0.002 s}}]
    match: {component: vertical, method: scale, periods: [0.1 s, 0.3 s]}
"""
STUDY = """\
edesign_study: 1
title: Vertical motion
project: project.yaml
variants: {bare: {dampers: none}}
histories:
  - {records: motion, vertical: {ratio: 0.9}}
  - {levels: [DBE, MCE], records: shaken, vertical: {record: fitted}}
"""


def files(folder: Path, analysis: str = "", study: str = STUDY, **changes: str) -> Path:
    """A project of posts with a hazard and a record fitted upwards, and a study of it."""
    text = (HERE / "vertical_motion" / "project.yaml").read_text(encoding="utf-8")
    motion = str(HERE / "records" / "motion.csv")
    text = text.replace("../records/motion.csv", motion)
    text = text.replace("records:\n", HAZARD + "records:\n" + FITTED.replace("@motion@", motion))
    text = text[: text.index("analyses:")] + "analyses:\n  - {name: modes, kind: modal, modes: 3}\n" + analysis
    for old, new in changes.items():
        assert text.count(old) == 1
        text = text.replace(old, new)
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    (folder / "study.yaml").write_text(study, encoding="utf-8")
    return folder / "project.yaml"


def dynamic_axial(group: Group) -> float:
    """Largest axial force of the posts, N; no load stands on them."""
    return float(max(np.max(np.abs(group.variables[f"column_axial_force_{end}"].values)) for end in ("max", "min")))


def test_posts_meet_the_vertical_spectrum(tmp_path: Path) -> None:
    """A post has m gamma_I S_a(T) of the fitted record; that is fitted to S_ve of EN 1998-1, Eqs. 3.8 to 3.11.

    a_vg = 0.9 a_g and F_0 = 3 of type 1, T_C = 0.15 s (Table 3.4); the damping of the modes is that of the spectrum.
    The record keeps its shape, so at one period it has another ordinate than the target. The horizontal motion, which
    bends the posts, adds no axial force as their beam is hinged. The record's ordinates are interpolated: 0.5 %.
    """
    period = 2.0 * math.pi * math.sqrt(MASS / STIFFNESS)
    history = "  - {name: up, kind: history, record: motion, level: MCE, vertical: {record: fitted}}\n"
    archive = run_project(load_project(files(tmp_path, history)), tmp_path / "up.h5").archive
    with open_archive(archive) as opened:
        group = opened.group("analyses/up")
        record = opened.group("records/fitted")
    at = record.coords["period"].values
    ordinate = float(np.interp(period, at, record.variables["psa_after"].values))
    assert dynamic_axial(group) == pytest.approx(MASS * 1.5 * ordinate, rel=5e-3)
    assert group.attributes["vertical_scale_factor"] == pytest.approx(1.5, rel=1e-12)
    assert record.variables["target"].values == pytest.approx(0.9 * 2.0 * 3.0 * np.minimum(1.0, 0.15 / at), rel=1e-9)
    assert record.attributes["match_notes"][-1] == "fitted to the vertical spectrum"


def test_study_has_vertical_motion(tmp_path: Path) -> None:
    """A study applies what a project's history does, and a fitted record grows with the level."""
    alone = "  - {name: alone, kind: history, record: motion, vertical: {ratio: 0.9}}\n"
    path = files(tmp_path, alone)
    single = run_project(load_project(path), tmp_path / "alone.h5").archive
    many = run_study(load_study(tmp_path / "study.yaml"), tmp_path / "study.h5").archive
    with open_archive(single) as one, open_archive(many) as other:
        first, second = one.group("analyses/alone"), other.group("analyses/bare.motion")
        for name in ("column_axial_force_max", "column_axial_force_min", "floor_displacement_max"):
            assert np.array_equal(first.variables[name].values, second.variables[name].values)
        levels = {level: other.group(f"analyses/bare.{level}.shaken") for level in ("DBE", "MCE")}
        assert "records/fitted" in [f"records/{name}" for name in other.names("records")]
    assert dynamic_axial(levels["MCE"]) == pytest.approx(1.5 * dynamic_axial(levels["DBE"]), rel=1e-6)
    assert levels["MCE"].attributes["vertical_scale_factor"] == pytest.approx(1.5)


@pytest.mark.parametrize(
    ("vertical", "message"),
    [
        ("{record: shaken}", "histories[1].vertical.record E-SCALE-02"),
        ("{record: fitted, scale: 2}", "histories[1].vertical.scale E-KEY-03"),
        ("{record: fitted, pga: 0.1 g}", "histories[1].vertical.pga E-KEY-03"),
        ("{record: upwards}", "histories[1].vertical.scale E-KEY-02"),
        ("{ratio: 0.9, scale: 2}", "histories[1].vertical.scale E-KEY-03"),
        ("{}", "histories[1].vertical E-KEY-03"),
        ("{record: fited}", "did you mean `fitted`"),
    ],
)
def test_wrong_vertical_motion_of_a_study(tmp_path: Path, vertical: str, message: str) -> None:
    study = STUDY.replace("{record: fitted}", vertical)
    files(tmp_path, study=study)
    with pytest.raises(StudyError, match=r"study.yaml:\d+:\d+: histories\[1\]\.vertical") as caught:
        load_study(tmp_path / "study.yaml")
    assert says(str(caught.value), message)


def test_records_are_used_in_their_direction(tmp_path: Path) -> None:
    files(tmp_path, study=STUDY.replace("records: shaken", "records: fitted"))
    with pytest.raises(StudyError, match=r"histories\[1\]\.records: `fitted` .*E-SCALE-02"):
        load_study(tmp_path / "study.yaml")
    files(
        tmp_path,
        study=STUDY.replace(
            "{records: motion, vertical: {ratio: 0.9}}", "{records: motion, vertical: {record: fitted}}"
        ),
    )
    with pytest.raises(StudyError, match=r"histories\[0\]\.vertical\.record: .*E-HAZ-05"):
        load_study(tmp_path / "study.yaml")
    history = "  - {name: up, kind: history, record: fitted, level: DBE}\n"
    with pytest.raises(ProjectError, match=r"analyses\[1\]\.record: `fitted` .*E-SCALE-02"):
        load_project(files(tmp_path, history))


def test_code_without_vertical_spectrum(tmp_path: Path) -> None:
    history = "  - {name: up, kind: history, record: motion, level: DBE, vertical: {record: fitted}}\n"
    asce = "hazard: {code: asce7-22, S_DS: 1 g, S_D1: 0.6 g, T_L: 8 s, levels: {DBE: {earthquake: DE}}}\n"
    path = files(tmp_path, history)
    text = path.read_text(encoding="utf-8").replace(HAZARD, asce)
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=r"records\.fitted\.match: .*vertical.*E-SPEC-03"):
        run_project(load_project(path), tmp_path / "no.h5")
