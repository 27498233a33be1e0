"""A spectrum that ends before the period that a run takes it at is refused before anything runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign import load_project, load_study
from edesign.errors import InputError
from edesign.study.check.summary import check_project, check_study

PROJECT = """\
edesign: 1
title: Elastic portal, T1 = 0.55 s
frame:
  bays: [6 m]
  storeys: [3.5 m]
  columns: [{storeys: all, section: HEB240, material: steel}]
  beams: [{floors: all, section: IPE330, material: steel}]
materials: {steel: {law: elastic, E: 210 GPa}}
masses: {given: [{floors: all, mass: 30 t}]}
damping: {kind: rayleigh, ratio: 5 %, periods: [0.1 s, 0.5 s]}
integration: {method: newmark, time_step: 0.01 s}
hazard:
  code: user
  damping: 5 %
  spectrum: {periods: [0 s, 0.1 s, @last@ s], accelerations: [0.3 g, 0.7 g, 0.7 g]}
  levels: {rare: {factor: 1.5}}
records: {motion: {file: motion.csv, acceleration_unit: g, time_step: 0.01 s}}
analyses: [{name: push, kind: pushover, pattern: {modes: 2}, roof_drift: 1 %}]
"""
STUDY = """\
edesign_study: 1
title: Harder and harder
project: project.yaml
variants: {bare: {dampers: none}}
@part@
"""
PARTS = {
    "pushovers": "pushovers: [{variants: bare, pattern: {modes: 2}, roof_drift: 1 %}]",
    "incremental": "incremental:\n  - {name: ida, records: motion, intensity: spectral_acceleration, "
    "levels: [0.1 g, 0.2 g], level: rare}",
}


def write(folder: Path, last: str, part: str = "") -> Path:
    (folder / "motion.csv").write_text("\n".join(["0.0", "0.1", "-0.1"] * 5), encoding="utf-8")
    text = PROJECT.replace("@last@", last)
    (folder / "project.yaml").write_text(text.replace("pattern: {modes: 2}", "pattern: uniform") if part else text)
    (folder / "study.yaml").write_text(STUDY.replace("@part@", part), encoding="utf-8")
    return folder


def test_a_pushover_by_modes(tmp_path: Path) -> None:
    project = load_project(write(tmp_path, "0.2") / "project.yaml")
    said = r"project.yaml:\d+:50: analyses\[0\].pattern: .* 0.2 s.* 0.5537 s.*E-HAZ-01"
    with pytest.raises(InputError, match=said):
        check_project(project)
    check_project(load_project(write(tmp_path, "2") / "project.yaml"))


@pytest.mark.parametrize("key", PARTS)
def test_studies(tmp_path: Path, key: str) -> None:
    said = rf"study.yaml:\d+:\d+: {key}\[0\].\w+: .* 0.2 s.*E-HAZ-01"
    with pytest.raises(InputError, match=said):
        check_study(load_study(write(tmp_path, "0.2", PARTS[key]) / "study.yaml"))
    check_study(load_study(write(tmp_path, "2", PARTS[key]) / "study.yaml"))
