"""Reading a project or study file with the catalogue of sections at hand."""

from __future__ import annotations

from pathlib import Path

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import loader
from edesign.project.project import Project
from edesign.project.study import study_loader
from edesign.project.study.study import Study


def load_project(path: Path | str) -> Project:
    """Read and check a project file; sections that it does not define itself must be in the catalogue, or hollow.

    Args:
        path: the YAML file, UTF-8.

    Returns:
        The project, all values in SI.

    Raises:
        InputError: the file cannot be read, or is wrong; the message lists all problems with file, line and column.
    """
    return loader.load_project(path, BuildingSections())


def load_study(path: Path | str) -> Study:
    """Read and check a study file and its project; otherwise as `load_project`.

    Args:
        path: of the study file.
    """
    return study_loader.load_study(path, BuildingSections())
