"""A small project that is right, for tests that make it wrong, and the command line as a user calls it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

TEXT = """\
edesign: 1
title: Two storeys
frame:
  bays: [6 m]
  storeys: [4 m, 3 m]
  columns: [{storeys: all, section: HEB200, material: S275}]
  beams: [{floors: all, section: IPE300, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 1 %}
loads:
  beams: [{floors: all, G: 20 kN/m, Q: 8 kN/m}]
masses: {from_loads: {}}
damping: {kind: rayleigh, ratio: 2 %}
integration: {method: newmark, time_step: 0.01 s}
records:
  motion: {file: motion.AT2}
analyses:
  - {name: modes, kind: modal, modes: 2}
  - {name: push, kind: pushover, pattern: uniform, roof_drift: 1 %, steps: 20}
  - {name: shake, kind: history, record: motion, pga: 0.3 g}
outputs: {members: [C_A_1]}
"""

RECORD = """\
PEER NGA STRONG MOTION DATABASE RECORD
Made for tests
ACCELERATION TIME SERIES IN UNITS OF G
NPTS=  8, DT=  .0200 SEC
  0.00 0.10 0.20 0.10
 -0.10 -0.20 -0.10 0.00
"""


def write(folder: Path, *changes: tuple[str, str], record: str = RECORD) -> Path:
    """Write the project with some of its text changed, and its record; return the path of the project."""
    text = TEXT
    for old, new in changes:
        assert text.count(old) == 1, f"{old!r} must stand in the project once"
        text = text.replace(old, new)
    (folder / "motion.AT2").write_text(record, encoding="utf-8")
    path = folder / "project.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def place_of(path: Path, words: str) -> str:
    """`file:line:column` of words that stand once in a file, counted from 1."""
    text = path.read_text(encoding="utf-8")
    assert text.count(words) == 1, f"{words!r} must stand in {path.name} once"
    before = text[: text.index(words)]
    return f"{path}:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}"


def command(*words: str | Path) -> list[str]:
    """The command line in a process of its own."""
    return [sys.executable, "-m", "edesign", *map(str, words)]


def edesign(*words: str | Path, **options: object) -> subprocess.CompletedProcess[str]:
    """Call the command line and wait for its end."""
    given = {"capture_output": True} if "stdout" not in options else {"stderr": subprocess.PIPE}
    return subprocess.run(  # type: ignore[call-overload, no-any-return]
        command(*words), text=True, encoding="utf-8", check=False, timeout=60, env=environment(), **given, **options
    )


def environment() -> dict[str, str]:
    """The environment with this package on the path, whatever the working directory is."""
    root = str(Path(__file__).parents[2])
    return os.environ | {"PYTHONPATH": os.pathsep.join([root, os.environ.get("PYTHONPATH", "")])}
