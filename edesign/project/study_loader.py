"""Reading a study file and the project that it studies."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from edesign.project.checks_study import check_study
from edesign.project.loader import load_project
from edesign.project.problems import FileProblems
from edesign.project.project import Project
from edesign.project.study import Study
from edesign.project.yaml_file import check_model, read_yaml_text
from edesign.project.yaml_nodes import parse

_KIND = "edesign_study"
_WHAT, _BEGINS = "study file", f"{_KIND}: 1"


class StudyError(FileProblems):
    """A study file is wrong."""


def is_study(path: Path | str) -> bool:
    """Whether a file is a study rather than a project.

    Raises:
        InputError: it cannot be read.
    """
    return parse(read_yaml_text(Path(path), "project or study file"))[0].child(_KIND) is not None


def load_study(path: Path | str, profiles: Collection[str] | None = None) -> Study:
    """Read and check a study file and its project.

    Args:
        path: the YAML file, UTF-8.
        profiles: names of the catalogue's sections, as for `load_project`.

    Raises:
        InputError: a file cannot be read.
        StudyError: the study is wrong; the message lists all problems with file, line and column.
        ProjectError: its project is wrong.
    """
    path = Path(path)
    study, problems = check_model(read_yaml_text(path, _WHAT), Study, _WHAT, _BEGINS)
    if study is None:
        raise StudyError(path, problems.found)
    project_path = path.parent / study.project
    if not project_path.is_file():
        message = f"there is no file `{project_path}` (the path is relative to the study file)"
        problems.at_value(("project",), message)
        raise StudyError(path, problems.found)
    return parse_study(read_yaml_text(path, _WHAT), path, load_project(project_path, profiles))


def parse_study(text: str, path: Path | str, base: Project) -> Study:
    """Check the text of a study file that (supposedly) stands at `path`, of a project that is at hand.

    Raises:
        StudyError: the study is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    study, problems = check_model(text, Study, _WHAT, _BEGINS)
    if study is not None:
        study = study.read_from(path, text, problems.root).of(base)
        check_study(study, problems)
    if study is None or problems.found:
        raise StudyError(path, problems.found)
    return study
