"""The file that all commands before a test read."""

from __future__ import annotations

from pathlib import Path

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.substructure import load_rts_file
from edesign.project.substructure.rts_file import RtsFile


def load_tests(path: Path) -> RtsFile:
    """Read and check a file of substructure tests, with the catalogue of sections.

    Raises:
        InputError: it cannot be read, is of another kind, or is wrong.
    """
    return load_rts_file(path, BuildingSections())
