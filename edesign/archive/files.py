"""Files that appear only when they are whole, and the folders they go into."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from edesign.errors import ArchiveError


def make_folder(folder: Path) -> None:
    """Make a folder if it is not there.

    Raises:
        ArchiveError: it cannot be made, or not be written to.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise ArchiveError(f"{folder}: this is a file, and a folder is needed") from None
    except OSError as error:
        raise ArchiveError(f"{folder}: the folder cannot be made: {error.strerror}") from error
    if not os.access(folder, os.W_OK | os.X_OK):
        raise ArchiveError(f"{folder}: the folder cannot be written to")


def write_text(text: str, path: Path) -> None:
    """Write a text file that appears only when it is whole.

    Raises:
        ArchiveError: it cannot be written.
    """
    write_whole(path, lambda partial: partial.write_text(text, encoding="utf-8", newline="\n"))


def write_whole(path: Path, write: Callable[[Path], object]) -> None:
    """Let a function write a file that appears only when it is whole.

    Args:
        path: the file.
        write: writes to the path that it is given, beside the file and with its suffix.

    Raises:
        ArchiveError: it cannot be written.
    """
    partial = path.with_name(f"{path.stem}.partial{path.suffix}")
    try:
        write(partial)
        os.replace(partial, path)
    except BaseException as error:
        with suppress(OSError):  # where nothing can be written, nothing can be deleted either
            partial.unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise ArchiveError(f"{path}: cannot be written: {error.strerror}") from error
        raise
