"""Reading a project file."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

from pydantic import ValidationError

from edesign.errors import InputError
from edesign.project.checks_actions import check_actions
from edesign.project.checks_frame import check_frame
from edesign.project.checks_outputs import check_outputs
from edesign.project.explain import explain
from edesign.project.problems import Problem, Problems, ProjectError
from edesign.project.project import Project
from edesign.project.yaml_nodes import Mark, parse


def load_project(path: Path | str, profiles: Collection[str] | None = None) -> Project:
    """Read and check a project file.

    Args:
        path: the YAML file, UTF-8.
        profiles: names of the catalogue's sections; None leaves unchecked section names that the project does not
            define.

    Returns:
        The project, all values in SI.

    Raises:
        InputError: the file cannot be read.
        ProjectError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such project file") from None
    except IsADirectoryError:
        raise InputError(f"{path}: this is a folder; name the project file in it") from None
    except OSError as error:
        raise InputError(f"{path}: the project file cannot be read: {error.strerror}") from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(f"{path}:{line}: the file is not UTF-8 text (byte 0x{data[error.start]:02x})") from None
    return parse_project(text, path, profiles)


def parse_project(text: str, path: Path | str = "project.yaml", profiles: Collection[str] | None = None) -> Project:
    """Check the text of a project file that (supposedly) stands at `path`; otherwise as `load_project`."""
    path = Path(path)
    root, faults = parse(text)
    problems = Problems(root)
    for fault in faults:
        problems.add(fault.mark, fault.keys, fault.message)
    if root.entries is None and not root.items and not root.text:
        problems.at_value((), "the project file is empty; `edesign new` writes one that runs")
    elif root.entries is None:
        problems.at_value((), "a project file is a mapping that begins with `edesign: 1`")
    if not root.entries:
        raise ProjectError(path, problems.found)
    project = None
    try:
        project = Project.model_validate(root.plain())
    except ValidationError as error:
        explain(error, Project, problems)
        problems.found = _without_echoes(problems.found, {fault.mark for fault in faults})
    if project is not None:
        project._path, project._text, project._root = path, text, root
        # cross checks need a whole project: they come in a second round, after the schema is satisfied
        check_frame(project, problems, profiles)
        check_actions(project, problems)
        check_outputs(project, problems)
    if project is None or problems.found:
        raise ProjectError(path, problems.found)
    return project


def _without_echoes(found: list[Problem], faulty: set[Mark]) -> list[Problem]:
    """Keep the first problem at a place where the YAML itself is at fault: the others only follow from it."""
    kept: list[Problem] = []
    for problem in found:
        if problem.mark not in faulty or all(problem.mark != other.mark for other in kept):
            kept.append(problem)
    return kept
