"""Reading a study file and the project that it studies."""

from __future__ import annotations

import re
from pathlib import Path

from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.loader import load_building
from edesign.project.frame.sections import Catalogue
from edesign.project.loader import load_project
from edesign.project.reading.file_bytes import is_file
from edesign.project.reading.file_model import Reader
from edesign.project.reading.problems import FileProblems, Problems
from edesign.project.reading.yaml_file import check_model, read_yaml_text
from edesign.project.study.checks_study import check_study
from edesign.project.study.study import Study

_BUILDING = re.compile(r"^edesign_building\s*:", re.MULTILINE)
_WHAT, _BEGINS = "study file", "edesign_study: 1"


class StudyError(FileProblems):
    """A study file is wrong."""


def load_study(path: Path | str, profiles: Catalogue | None = None) -> Study:
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
    return parse_study(read_yaml_text(path, _WHAT), path, profiles=profiles)


def parse_study(
    text: str,
    path: Path | str,
    base: AnalysisFile | None = None,
    profiles: Catalogue | None = None,
    of: str | None = None,
) -> Study:
    """Check the text of a study file that (supposedly) stands at `path`.

    Args:
        path: where the file stands, for messages and for the files that it names.
        base: the project, if it is at hand; otherwise the one that the file names is read.
        profiles: as for `load_study`.
        of: the `project` of the file that `base` stands for; where the text names another one, that is read.

    Returns:
        The study with its project, all values in SI.

    Raises:
        StudyError: the study is wrong; the message lists all problems with file, line and column.
        ProjectError, InputError: its project is wrong, or cannot be read.
    """
    path = Path(path)
    study, problems = check_model(text, Study, _WHAT, _BEGINS)
    if study is not None and (base is None or of not in (None, study.project)):
        base = _load_base(study, path, profiles, problems)
    if study is not None and base is not None:
        more = {"base": base, "profiles": profiles, "of": study.project}
        read = Reader(parse_study, path, more, _completed)
        study = read.completed(study)
        check_study(study.read_from(path, text, problems.root, read).set_base(base), problems)
    if study is None or problems.found:
        raise StudyError(path, problems.found)
    return study


def _load_base(study: Study, path: Path, profiles: Catalogue | None, problems: Problems) -> AnalysisFile | None:
    project_path = path.parent / study.project
    if is_file(project_path):
        of_building = _BUILDING.search(read_yaml_text(project_path, "project file"))
        return load_building(project_path, profiles) if of_building else load_project(project_path, profiles)
    message = f"there is no file `{project_path}` (the path is relative to the study file) [E-FILE-01]"
    problems.at_value(("project",), message)
    return None


def _completed(study: Study, _profiles: Catalogue | None) -> Study:
    """The study with the variants that `vary` and `bounds` make."""
    return study.with_derived()
