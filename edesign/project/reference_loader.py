"""Reading a reference file."""

from __future__ import annotations

from pathlib import Path

from edesign.project.checks_reference import check_reference
from edesign.project.problems import FileProblems
from edesign.project.reference import Reference
from edesign.project.yaml_file import check_model, read_yaml_text

BEGINS = "edesign_reference: 1"
OTHER_FILES = {"edesign": "project", "edesign_suite": "suite", "edesign_study": "study"}


class ReferenceFileError(FileProblems):
    """A reference file is wrong."""


def load_reference(path: Path | str) -> Reference:
    """Read and check a reference file.

    Raises:
        InputError: the file cannot be read.
        ReferenceFileError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    reference, problems = check_model(read_yaml_text(path, "reference file"), Reference, "reference file", BEGINS)
    if reference is not None:
        check_reference(reference, problems)
    else:
        for key, what in OTHER_FILES.items():
            if problems.root.child(key) and not problems.root.child("edesign_reference"):
                problems.found = []
                problems.at_key((key,), f"this is a {what} file; a reference file begins with `{BEGINS}`")
    if reference is None or problems.found:
        raise ReferenceFileError(path, problems.found)
    reference._path, reference._root = path, problems.root
    return reference
