"""The suites of recordings that come with edesign, which files name without a path."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

_NAME = re.compile(r"[A-Za-z0-9_-]+")
_ENDING = ".yaml"
_INSTALLED = Path(__file__).parent / "suites"
_FOLDER = _INSTALLED if _INSTALLED.is_dir() else Path(__file__).parents[3] / "records" / "suites"
"""The folder of the suites: setup.py puts them beside this module; in the repository they stand at the top."""


@cache
def suite_names() -> tuple[str, ...]:
    """Return the names of the suites that come with edesign."""
    return tuple(sorted(file.stem for file in _FOLDER.iterdir() if file.suffix == _ENDING))


def is_suite_name(text: str) -> bool:
    """Return whether a text is meant as the name of such a suite: a file would have an ending or a folder."""
    return _NAME.fullmatch(text) is not None


def suite_file(folder: Path, text: str) -> Path:
    """Return the file of a suite.

    Args:
        folder: that paths are relative to.
        text: name of a suite that comes with edesign, or path of a file.
    """
    if text in suite_names():
        return _FOLDER / f"{text}{_ENDING}"
    return folder / text
