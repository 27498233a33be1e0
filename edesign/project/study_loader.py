"""Reading a study file and the project that it studies."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from edesign.project.checks_study import check_study
from edesign.project.loader import load_project
from edesign.project.problems import FileProblems, Problems
from edesign.project.project import Project
from edesign.project.study import Study
from edesign.project.yaml_file import check_model, read_yaml_text
from edesign.project.yaml_nodes import parse

KIND = "edesign_study"
"""First key of a study file."""

_WHAT, BEGINS = "study file", f"{KIND}: 1"


class StudyError(FileProblems):
    """A study file is wrong."""


def is_study(path: Path | str) -> bool:
    """Whether a file is a study rather than a project.

    Raises:
        InputError: it cannot be read.
    """
    return parse(read_yaml_text(Path(path), "project or study file"))[0].child(KIND) is not None


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
    study, problems = _checked(read_yaml_text(path, _WHAT))
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
    study, problems = _checked(text)
    if study is not None:
        study._path, study._text, study._root, study._base = path, text, problems.root, base
        check_study(study, problems)
    if study is None or problems.found:
        raise StudyError(path, problems.found)
    return study


def _checked(text: str) -> tuple[Study | None, Problems]:
    study, problems = check_model(text, Study, _WHAT, BEGINS)
    if problems.root.child("edesign") and not problems.root.child(KIND):
        problems.found = []
        problems.at_key(("edesign",), f"this is a project file; a {_WHAT} begins with `{BEGINS}`")
    return study, problems
