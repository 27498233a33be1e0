"""A project that needs no file, and a fake of the numerical core, for tests of the run and the command line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.errors import AnalysisError
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis.outputs import Outputs
from edesign.project.project import Project
from edesign.study.motions.motions import Motion

STEPS = 20


def project(folder: Path, names: str = "abcd", text: str = "title: small") -> Project:
    """A project with one history analysis for each letter of `names`."""
    specs = tuple(
        HistoryAnalysis.model_construct(name=name, kind="history", record="el_centro", variant="", level="DBE")
        for name in names
    )
    made = Project.model_construct(
        edesign=1, title="small", records={}, analyses=specs, outputs=Outputs(archive="small.h5")
    )
    made.__pydantic_private__ = {"_path": folder / "project.yaml", "_text": text, "_root": None, "_contents": {}}
    return made


class Core:
    """Stands for `run_analysis`: reproducible numbers, and whatever a test wants to happen at a step of an analysis.

    Attributes:
        ran: names of the analyses that were started.
        on: what to call at (name, step).
    """

    def __init__(self, on: dict[tuple[str, int], Callable[[], None]] | None = None) -> None:
        self.ran: list[str] = []
        self.on = on or {}

    def __call__(
        self,
        project: Project,
        spec: Any,
        progress: Callable[[int, int], None] | None = None,
        stop: Callable[[], bool] | None = None,
        motion: Motion | None = None,
        vertical: Motion | None = None,
    ) -> Group:
        self.ran.append(spec.name)
        group = Group(coords={"time": Variable(("time",), np.arange(STEPS) * 0.01, "s", "time")})
        random = np.random.default_rng(ord(spec.name[0]))
        group.add("base_shear", ("time",), random.normal(size=STEPS) * 1e6, "N", "base shear")
        statistics = {"steps": STEPS, "iterations": 40, "refactorisations": 3, "fallbacks": 0, "cpu_s": 0.1}
        group.attributes = {"status": "completed", "reason": "", "statistics": {**statistics, "energy_error": 1e-9}}
        for step in range(STEPS):
            self.on.get((spec.name, step), lambda: None)()
            if stop is not None and stop():
                group.attributes["status"] = "interrupted"
                return group
            if progress is not None:
                progress(step + 1, STEPS)
        return group


def fail() -> None:
    """An analysis that cannot be finished."""
    raise AnalysisError("step 7 at 0.07 s: no convergence [E-CORE-08]")
