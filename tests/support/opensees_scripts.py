"""Scripts of `edesign translate` written, run by OpenSeesPy as users run them, and their tables."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

from benchmarks.peers import LOADED_FIRST
from edesign.exchange.formats import find_format, write_translation
from edesign.project.project import Project


def written(project: Project, model: Path, without_dampers: bool = False) -> tuple[str, ...]:
    """Write a script; returns what is left out."""
    translation = find_format(model).translate(project, model, without_dampers)
    write_translation(translation)
    return translation.left_out


def run(model: Path) -> None:
    """Run all analyses of a script in a process of its own."""
    command, environment = [sys.executable, str(model), "all"], {**os.environ, **LOADED_FIRST}
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)
    assert done.returncode == 0, done.stderr[-2000:]


def table(path: Path) -> np.ndarray:
    """All columns but the first of a table."""
    with path.open(encoding="utf-8") as file:
        return np.array([[float(value) for value in row[1:]] for row in list(csv.reader(file))[1:]])
