"""Reading a file of substructure tests, and the project and rig file that it names."""

from __future__ import annotations

from pathlib import Path

from edesign.project.frame.sections import Catalogue
from edesign.project.loader import load_project
from edesign.project.project import Project
from edesign.project.reading.checks_files import check_file
from edesign.project.reading.file_model import Reader
from edesign.project.reading.problems import FileProblems, Problems
from edesign.project.reading.yaml_file import check_model, read_yaml_text
from edesign.project.substructure.checks_compensators import check_compensators
from edesign.project.substructure.checks_rig import (
    check_covariance,
    check_loop,
    check_noise,
    check_plant,
    check_sensors,
    check_sub_steps,
)
from edesign.project.substructure.checks_specimen import check_specimen
from edesign.project.substructure.checks_structure import check_structure
from edesign.project.substructure.checks_tests import check_tests
from edesign.project.substructure.rig import RigFile, RigInFile
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure

WHAT = "substructure test file"
_BEGINS = "edesign_rts: 1"


class RtsFileError(FileProblems):
    """A file of substructure tests, or a rig file, is wrong."""


def load_rts_file(path: Path | str, profiles: Catalogue | None = None) -> RtsFile:
    """Read and check a file of substructure tests, its project and its rig file.

    Args:
        path: the YAML file, UTF-8.
        profiles: names of the catalogue's sections, as for `load_project`.

    Returns:
        The tests, all values in SI.

    Raises:
        InputError: a file cannot be read.
        RtsFileError: the file or its rig file is wrong; the message lists all problems with file, line and column.
        ProjectError: its project is wrong.
    """
    path = Path(path)
    return parse_rts_file(read_yaml_text(path, WHAT), path, profiles)


def parse_rts_file(text: str, path: Path | str = "rts.yaml", profiles: Catalogue | None = None) -> RtsFile:
    """Check the text of a file of substructure tests that (supposedly) stands at `path`; else as `load_rts_file`.

    Args:
        path: path of the file, for messages and for the files that it names.
        profiles: names of the catalogue's sections, as for `load_project`.

    Returns:
        The file with its project and its rig file, all values in SI.

    Raises:
        RtsFileError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    rts, problems = check_model(text, RtsFile, WHAT, _BEGINS)
    if rts is not None:
        rts.read_from(path, text, problems.root, Reader(parse_rts_file, path, {"profiles": profiles}))
        rts.set_named(_project(rts, profiles, problems), _rig_file(rts, problems))
        _check(rts, problems)
    if rts is None or problems.found:
        raise RtsFileError(path, problems.found)
    return rts


def read_rig_file(path: Path | str) -> RigFile:
    """Read and check a rig file.

    Raises:
        InputError: the file cannot be read.
        RtsFileError: it is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    found, problems = check_model(
        read_yaml_text(path, "rig file"), RigFile, "rig file", "rig: {kind: second_order, ...}"
    )
    if found is not None:
        check_plant(found.rig, ("rig",), problems)
        check_covariance(found, problems)
    if found is None or problems.found:
        raise RtsFileError(path, problems.found)
    return found


def _check(rts: RtsFile, problems: Problems) -> None:
    """Cross checks, which need a whole file."""
    check_structure(rts, problems)
    check_specimen(rts, problems)
    check_loop(rts, problems)
    if isinstance(rts.rig, RigInFile) and rts.rig_file is None:
        return  # all others ask what the rig can do
    if not isinstance(rts.rig, RigInFile):
        check_plant(rts.rig, ("rig",), problems)
    check_sensors(rts, problems)
    check_noise(rts, problems)
    check_sub_steps(rts, problems)
    check_compensators(rts, problems)
    check_tests(rts, problems)


def _project(rts: RtsFile, profiles: Catalogue | None, problems: Problems) -> Project | None:
    if not isinstance(rts.structure, ProjectStructure):
        return None
    path = rts.folder / rts.structure.project
    there = check_file(path, ("structure", "project"), problems, WHAT)
    return load_project(path, profiles) if there else None


def _rig_file(rts: RtsFile, problems: Problems) -> RigFile | None:
    if not isinstance(rts.rig, RigInFile):
        return None
    path = rts.folder / rts.rig.file
    return read_rig_file(path) if check_file(path, ("rig", "file"), problems, WHAT) else None
