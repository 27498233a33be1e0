"""The file that all commands before a test read."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from edesign.errors import InputError

if TYPE_CHECKING:
    from edesign.project.substructure.rts_file import RtsFile

RUN_BY = {"project": "edesign run", "study": "edesign run", "building": "edesign run"}
"""The command that runs a file of another kind."""


def load_tests(path: Path) -> RtsFile:
    """Read and check a file of substructure tests, with the catalogue of sections.

    Raises:
        InputError: it cannot be read, is of another kind, or is wrong.
    """
    from edesign.building.building_sections import BuildingSections
    from edesign.project.substructure import load_rts_file
    from edesign.project.yaml_file import file_kind

    kind = file_kind(path, "substructure test file")
    if kind in RUN_BY:
        raise InputError(f"{path}: this is a {kind} file; `{RUN_BY[kind]} {path}` runs it")
    return load_rts_file(path, BuildingSections())
