"""Reading a project file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

from edesign.project.checks.analyses import check_analyses
from edesign.project.checks.dampers import check_dampers
from edesign.project.checks.foundations import check_foundations
from edesign.project.checks.frame import check_frame
from edesign.project.checks.hazard import check_hazard
from edesign.project.checks.hinges import check_hinges
from edesign.project.checks.isolation import check_isolation
from edesign.project.checks.outputs import check_outputs
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.frame.sections import Catalogue
from edesign.project.project import Project
from edesign.project.reading.file_model import Reader
from edesign.project.reading.partial import check_independent, readable_part
from edesign.project.reading.problems import Problems, ProjectError
from edesign.project.reading.yaml_file import check_model, read_yaml_text

_WHAT = "project file"
S = TypeVar("S", ColumnRun, BeamRun, BraceRun)


def load_project(path: Path | str, profiles: Catalogue | None = None) -> Project:
    """Read and check a project file.

    Args:
        path: the YAML file, UTF-8.
        profiles: names of the catalogue's sections, which take the place of other spellings of them in the project;
            None leaves unchecked section names that the project does not define.

    Returns:
        The project, all values in SI.

    Raises:
        InputError: the file cannot be read.
        ProjectError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    return parse_project(read_yaml_text(path, _WHAT), path, profiles)


def parse_project(
    text: str, path: Path | str = "project.yaml", profiles: Catalogue | None = None, files: bool = True
) -> Project:
    """Check the text of a project file that (supposedly) stands at `path`; otherwise as `load_project`.

    Args:
        path: where the file stands, for messages and for the files that it names.
        profiles: names of the catalogue's sections, as for `load_project`.
        files: whether the files that it names must exist.

    Returns:
        The project, all values in SI.

    Raises:
        ProjectError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    hint = "; `edesign new` writes one that runs"
    project, problems = check_model(text, Project, _WHAT, "edesign: 1", hint)
    read = Reader(parse_project, path, {"profiles": profiles, "files": files}, _with_catalogue_names)
    if project is not None:
        project = read.completed(project)
    part = project if project is not None else readable_part(Project, problems)
    if part is not None:
        part.read_from(path, text, problems.root, read)
        check_independent(part, _cross_checks(part, problems, profiles, files))
    if project is None or problems.found:
        raise ProjectError(path, problems.found)
    return project


def _cross_checks(
    project: Project, problems: Problems, profiles: Catalogue | None, files: bool
) -> tuple[Callable[[], None], ...]:
    return (
        lambda: check_frame(project, problems, profiles),
        lambda: check_hinges(project, problems),
        lambda: check_foundations(project, problems, project.frame.supports, ("frame", "supports")),
        lambda: check_analyses(project, problems, files),
        lambda: check_dampers(project, problems),
        lambda: check_isolation(project, problems),
        lambda: check_hazard(project.hazard, project, problems, files),
        lambda: check_outputs(project, problems),
    )


def _with_catalogue_names(project: Project, catalogue: Catalogue | None) -> Project:
    """The project with the catalogue's own names of sections, however they are written; own sections go before."""

    def section(written: str) -> str:
        known = None if catalogue is None or written in project.sections else catalogue.canonical(written)
        return known or written

    def named(part: S) -> S:
        other = section(part.section)
        return part if other == part.section else part.model_copy(update={"section": other})

    frame = project.frame
    members = {kind: tuple(map(named, getattr(frame, kind))) for kind in ("columns", "beams", "braces")}
    changed: dict[str, object] = {"frame": frame.model_copy(update=members)}
    if project.dampers is not None:
        changed["dampers"] = project.dampers.with_sections(section)
    return project.model_copy(update=changed)
