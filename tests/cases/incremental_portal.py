"""A portal whose columns yield sharply, and incremental studies of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_study
from edesign.project.study.study import Study

HEIGHT = 4.0  # m
PROJECT = """\
edesign: 1
title: Portal whose columns yield sharply, under a heavy beam that does not bend
frame:
  bays: [1000 m]
  storeys: [4 m]
  diaphragms: all
  columns: [{storeys: all, section: column, material: steel}]
  beams: [{floors: 1, section: rigid, material: elastic}]
sections:
  column: {rectangles: [{width: 100 mm, depth: 20 mm, centre: -140 mm}, {width: 100 mm, depth: 20 mm, centre: 140 mm}]}
  rigid: {area: 1 m^2, inertia: 1e6 m^4}
materials:
  steel: {law: bilinear, E: 210 GPa, fy: 250 MPa}
  elastic: {law: elastic, E: 210 GPa}
elements: {geometry: {columns: @geometry@}}
loads: {nodes: [{lines: all, floors: 1, G: @load@}]}
masses: {given: [{lines: all, floors: all, mass: 20 t}], directions: horizontal}
damping: {kind: modal, ratio: 5 %, modes: 1}
integration: {method: newmark, time_step: 0.005 s, tolerance: 1e-10}
hazard: {code: ec8-2004, country: greece, zone: 3, ground: C, spectrum: 1, levels: {MCE: {probability: 2 %}}}
records:
  shake: {file: shake.csv, acceleration_unit: m/s^2, time_step: 0.01 s}
  still: {file: still.csv, acceleration_unit: m/s^2, time_step: 0.01 s}
  fitted: {file: shake.csv, acceleration_unit: m/s^2, time_step: 0.01 s, match: {method: scale, periods: [0.2 s, 1 s]}}
analyses: [{name: modes, kind: modal, modes: 1}]
"""
STUDY = """\
edesign_study: 1
title: Portal shaken harder and harder
project: project.yaml
variants: {bare: {dampers: none}, same: {dampers: none}}
modal: {modes: 1}
incremental:
  - {name: ida, @about@}
outputs: {archive: out.h5, histories: [floors]}
"""
LEVELS = ("0.05g", "2g", "3g", "4g", "5g", "6g")
TO_COLLAPSE = (
    "records: shake, intensity: spectral_acceleration, period: 0.8 s, levels: [0.05 g, 2 g, 3 g, 4 g, 5 g, 6 g], "
    "collapse_drift: 8 %, free_vibration: 2 s, level: MCE, limits: {LS: {interstorey_drift: 2.5 %}}"
)
"""Under gravity the yielding portal falls at one of the intensities from 2 g on."""


def write(folder: Path, about: str = TO_COLLAPSE, geometry: str = "p_delta", load: str = "500 kN") -> Path:
    """Write study, project and records; return the path of the study."""
    t = np.arange(400) * 0.01
    motion = np.sin(np.pi * t / 4.0) ** 2 * (np.sin(9.0 * t) + 0.5 * np.sin(23.0 * t + 1.0))
    (folder / "shake.csv").write_text("\n".join(map(str, motion)), encoding="utf-8")
    (folder / "still.csv").write_text("\n".join(["0.0"] * 400), encoding="utf-8")
    text = PROJECT.replace("@geometry@", geometry).replace("@load@", load)
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    path = folder / "study.yaml"
    path.write_text(STUDY.replace("@about@", about), encoding="utf-8")
    return path


def study(folder: Path, about: str = TO_COLLAPSE, geometry: str = "p_delta", load: str = "500 kN") -> Study:
    """The study of files in a folder."""
    return load_study(write(folder, about, geometry, load))


def histories(archive: Path) -> dict[str, Group]:
    """The histories of the study `ida` by name, in the order of the plan."""
    with open_archive(archive) as opened:
        groups = {name: opened.group(f"analyses/{name}") for name in opened.names("analyses")}
    return {name: group for name, group in groups.items() if group.attributes.get("incremental") == "ida"}


def same(a: Group, b: Group) -> bool:
    """Whether two results are equal to the bit, but for the time they took."""

    def plain(group: Group) -> dict[str, object]:
        about = dict(group.attributes)
        about["statistics"] = {k: v for k, v in dict(about.get("statistics", {})).items() if k != "cpu_s"}
        return about

    values = all(np.array_equal(v.values, b.variables[k].values) for k, v in a.variables.items())
    return values and list(a.variables) == list(b.variables) and plain(a) == plain(b)
