"""The suites of recordings that come with edesign, which files name without a path."""

from __future__ import annotations

import re
from functools import cache
from importlib import resources
from pathlib import Path

_NAME = re.compile(r"[A-Za-z0-9_-]+")
_ENDING = ".yaml"


@cache
def suite_names() -> tuple[str, ...]:
    """Return the names of the suites that come with edesign."""
    files = (Path(item.name) for item in resources.files("edesign.project.records").joinpath("suites").iterdir())
    return tuple(sorted(file.stem for file in files if file.suffix == _ENDING))


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
        return Path(str(resources.files("edesign.project.records").joinpath("suites", f"{text}{_ENDING}")))
    return folder / text
