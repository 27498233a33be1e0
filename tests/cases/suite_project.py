"""A small project under a suite that is fitted to the spectrum of its hazard."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from cases.small_frame import TEXT

from edesign.ground_motion.formats.write import write_csv
from edesign.ground_motion.simulation import simulate

HAZARD = """\
hazard:
  code: ec8-2004
  a_gR: 0.2 g
  ground: B
  spectrum: 1
  levels: {DBE: {probability: 10 %}, MCE: {probability: 2 %}}
records:
  set: {suite: set.yaml, match: {method: frequency, periods: [0.1 s, 2 s]}}
"""

SUITE = """\
edesign_suite: 1
title: Three motions
records:
  - {id: first, event: One, year: 2001, file: first.csv, acceleration_unit: m/s^2}
  - {id: second, event: Two, year: 2002, file: second.csv, acceleration_unit: m/s^2}
  - {id: third, event: Three, year: 2003, magnitude: 6.5, distance: 20 km, v_s30: 500 m/s, simulated: {seed: 3}}
"""

HISTORIES = """\
  - {name: dbe, kind: history, record: set, level: DBE}
  - {name: mce, kind: history, record: set, level: MCE}
"""


def write(folder: Path, *changes: tuple[str, str]) -> Path:
    """Write project, suite and two recordings, with some of the project's text changed; return the project's path."""
    text = TEXT.replace("records:\n  motion: {file: motion.AT2}\n", HAZARD)
    text = text.replace("  - {name: shake, kind: history, record: motion, pga: 0.3 g}\n", HISTORIES)
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the project once"
        text = text.replace(old, new)
    write_suite(folder)
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    return folder / "project.yaml"


def write_suite(folder: Path) -> Path:
    """Write the suite and its two files; return its path."""
    for seed, name in enumerate(("first", "second"), start=1):
        record = simulate(6.0, 15e3, 500.0, seed)
        assert np.all(np.isfinite(record.acceleration))
        write_csv(record, folder / f"{name}.csv")
    (folder / "set.yaml").write_text(SUITE, encoding="utf-8")
    return folder / "set.yaml"
