"""Reading a reference file."""

from __future__ import annotations

from pathlib import Path

from edesign.project.reading.problems import FileProblems
from edesign.project.reading.yaml_file import check_model, read_yaml_text
from edesign.project.study.checks_reference import check_reference
from edesign.project.study.reference import Reference

_WHAT, _BEGINS = "reference file", "edesign_reference: 1"


class ReferenceFileError(FileProblems):
    """A reference file is wrong."""


def load_reference(path: Path | str) -> Reference:
    """Read and check a reference file.

    Raises:
        InputError: the file cannot be read.
        ReferenceFileError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    text = read_yaml_text(path, _WHAT)
    reference, problems = check_model(text, Reference, _WHAT, _BEGINS)
    if reference is not None:
        check_reference(reference, problems)
    if reference is None or problems.found:
        raise ReferenceFileError(path, problems.found)
    return reference.read_from(path, text, problems.root)
