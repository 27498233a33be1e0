"""Checks that the files are there that a file names."""

from __future__ import annotations

from pathlib import Path

from edesign.project.reading.file_bytes import is_file, is_there
from edesign.project.reading.problems import Keys, Problems


def check_file(path: Path, keys: Keys, problems: Problems, what: str) -> bool:
    """Check that a file exists, and return whether it does.

    Args:
        what: what the file is, for messages.
    """
    if not is_there(path):
        slash = "; folders are divided by `/`" if "\\" in str(path) else ""
        problems.at_value(keys, f"there is no file `{path}` (the path is relative to the {what}){slash} [E-FILE-01]")
    elif not is_file(path):
        problems.at_value(keys, f"`{path}` is not a file [E-FILE-01]")
    return is_file(path)
