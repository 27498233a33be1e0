"""Files that appear only when they are whole, and the folders they go into."""

from __future__ import annotations

import os
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from edesign.errors import ArchiveError

_HDF5 = b"\x89HDF\r\n\x1a\n"  # how a file of HDF5 begins


def check_folder(folder: Path) -> None:
    """Check that files can be written into a folder, or that it can be made, without making it.

    Raises:
        ArchiveError: they cannot, or it cannot.
    """
    existing = folder
    while not existing.exists() and existing != existing.parent:
        existing = existing.parent
    if not existing.is_dir():
        raise ArchiveError(f"{folder}: {existing} is a file, and a folder is needed")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise ArchiveError(f"{folder}: the folder {existing} cannot be written to")


def make_folder(folder: Path) -> None:
    """Make a folder if it is not there.

    Raises:
        ArchiveError: it cannot be made.
    """
    check_folder(folder)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ArchiveError(f"{folder}: the folder cannot be made: {error.strerror}") from error


def write_text(text: str, path: Path) -> None:
    """Write a text file that appears only when it is whole; it never takes the place of an archive.

    Raises:
        ArchiveError: it cannot be written.
    """
    if _is_hdf5(path):
        raise ArchiveError(f"{path}: cannot be written: this file is an archive, and it is left as it is")
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


def _is_hdf5(path: Path) -> bool:
    try:
        with path.open("rb") as file:
            return file.read(len(_HDF5)) == _HDF5
    except OSError:
        return False
