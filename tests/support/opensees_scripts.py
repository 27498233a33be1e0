"""Scripts of `edesign translate` written, run by OpenSeesPy as users run them, and their tables."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from benchmarks.peers import LOADED_FIRST
from edesign.exchange.formats import find_format, write_translation
from edesign.project.building import Building
from edesign.project.project import Project


def written(project: Project | Building, model: Path, without_dampers: bool = False) -> tuple[str, ...]:
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


def columns(path: Path) -> list[str]:
    """Names of all columns but the first of a table."""
    return path.read_text(encoding="utf-8").splitlines()[0].split(",")[1:]


def off(ours: Any, theirs: Any) -> float:
    """Largest difference over the largest value."""
    difference = np.max(np.abs(np.asarray(ours) - np.asarray(theirs)))
    return float(difference / max(np.max(np.abs(ours)), 1e-300)) if difference else 0.0


def run_tcl(script: Path) -> None:
    """Run a script in the Tcl of Python; its commands for OpenSees go to OpenSeesPy."""
    tkinter = pytest.importorskip("tkinter", reason="this Python has no Tcl")
    import openseespy.opensees as ops

    interpreter = tkinter.Tcl()

    def forward(name: str) -> Callable[..., str]:
        def call(*words: str) -> str:
            body = words[-1] if name in ("section", "pattern") and "\n" in words[-1] else None
            found = getattr(ops, name)(*map(word, words if body is None else words[:-1]))
            if body is not None:
                interpreter.eval(body)
            return " ".join(map(repr, found)) if isinstance(found, list) else "" if found is None else repr(found)

        return call

    for name in dir(ops):
        if callable(getattr(ops, name)) and not name.startswith("_") and name[0].islower() and name != "exit":
            interpreter.createcommand(name, forward(name))
    interpreter.setvar("argv", "all")
    interpreter.evalfile(str(script))
    ops.wipe()


def word(text: str) -> str | int | float:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def check_languages(project: Project | Building, folder: Path) -> None:
    """Run the scripts in Python and in Tcl: their tables are the same, but for the order in which sums are rounded."""
    for model in ("model.py", "script.tcl"):
        written(project, folder / model)
    run(folder / "model.py")
    run_tcl(folder / "script.tcl")
    tables = sorted(path.name for path in (folder / "model_results").iterdir())
    assert tables == sorted(path.name for path in (folder / "script_results").iterdir())
    for file in tables:
        ours, theirs = (folder / f"{stem}_results" / file for stem in ("model", "script"))
        assert off(table(ours), table(theirs)) < 1e-12
        assert ours.read_text().splitlines()[0] == theirs.read_text().splitlines()[0]
