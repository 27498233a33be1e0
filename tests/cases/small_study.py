"""A small study that is right: a design with rounds of verification, variants, two levels, criteria, details."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from cases.small_frame import RECORD, TEXT

STEP = 0.02  # s

PROJECT = (
    TEXT[: TEXT.index("records:")]
    + """\
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
records:
  set: {suite: set.yaml, match: {method: scale, periods: [0.2 s, 1 s]}}
  motion: {file: motion.AT2}
dampers:
  laws:
    rubber:
      type: mgmm
      parameters: thesis_table_4_2
      prototype: {layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}
analyses: [{name: modes, kind: modal, modes: 2}]
"""
)

SUITE = """\
edesign_suite: 1
title: Three motions
records:
  - {id: first, event: One, year: 2001, file: first.csv, acceleration_unit: m/s^2}
  - {id: second, event: Two, year: 2002, file: second.csv, acceleration_unit: m/s^2}
  - {id: third, event: Three, year: 2003, file: third.csv, acceleration_unit: m/s^2}
"""

STUDY = """\
edesign_study: 1
title: Small study
project: project.yaml
designs:
  added:
    method: strain_energy
    law: rubber
    kind: chevron
    bays: all
    layers: 2
    damping: 4 %
    strain: 20 %
    temperature: 20 degC
    frequency: 2 Hz
    layer_thickness: 12 mm
    verify:
      {records: set, levels: DBE, criteria: drift, free_vibration: 1 s, rounds: 6, precision: 2 %}
variants:
  bare: {dampers: none}
  damped: {design: added}
  upper: {design: added, property_factor: 1.5}
  warm: {design: added, temperature: 35 degC}
modal: {modes: 2}
histories:
  - {variants: [bare, damped, upper], levels: [DBE, MCE], records: set, free_vibration: 1 s}
  - {variants: warm, levels: DBE, records: set/first, free_vibration: 1 s}
  - {variants: damped, levels: DBE, records: set/first, temperatures: [10 degC, 35 degC], free_vibration: 1 s}
criteria:
  - {name: drift, measure: interstorey_drift, levels: DBE, most: 2 %, statistic: mean}
  - {name: no hinges in columns, plastic_hinges: none, of: columns, levels: DBE}
objectives: [h]
outputs:
  archive: out.h5
  histories: [floors]
  every: 2
  details: {records: set/first, members: [C_A_1]}
"""

HISTORIES = 3 * 2 * 3 + 1 + 2
PLANNED = 4 * 2 + HISTORIES  # modes and gravity of each variant


def write(folder: Path, *changes: tuple[str, str], project: tuple[tuple[str, str], ...] = ()) -> Path:
    """Write study, project, suite and recordings, with some of the text changed; return the path of the study."""
    (folder / "project.yaml").write_text(changed(PROJECT, *project), encoding="utf-8")
    (folder / "motion.AT2").write_text(RECORD, encoding="utf-8")
    (folder / "set.yaml").write_text(SUITE, encoding="utf-8")
    for i, name in enumerate(("first", "second", "third")):
        (folder / f"{name}.csv").write_text(_recording(i), encoding="utf-8")
    path = folder / "study.yaml"
    path.write_text(changed(STUDY, *changes), encoding="utf-8")
    return path


def changed(text: str, *changes: tuple[str, str]) -> str:
    """Text with parts replaced that each stand in it once."""
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the file once"
        text = text.replace(old, new)
    return text


def _recording(number: int) -> str:
    """Four seconds of three sines that swell and fade, different for each number."""
    t = STEP * np.arange(200)
    waves = sum(np.sin(2.0 * math.pi * f * t + number * f) for f in (1.1 + 0.1 * number, 2.3, 4.1))
    lines = [f"{x:.4f},{y:.8f}" for x, y in zip(t, 1.2 * waves * np.sin(math.pi * t / t[-1]) ** 2, strict=True)]
    return "\n".join(["time_s,acceleration_m_s2", *lines, ""])
