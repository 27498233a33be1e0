"""The input files of a command, whose place no output of the same command takes.

Whatever reads a file for the user notes it here, and whatever writes one asks here, so that no command can forget it.
Files are known by device and inode: a symbolic or hard link is the file that it leads to. Outside of `noting_inputs`
nothing is noted or refused; who calls the functions from Python says himself what is written where.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from pathlib import Path

from edesign.errors import InputError

_Identity = tuple[int, int]  # device and inode


@dataclass
class _Notes:
    """The files that a command has read, by the name that it read them by, and those that it has written."""

    read: dict[_Identity, Path] = field(default_factory=dict)
    written: dict[Path, _Identity] = field(default_factory=dict)


_notes: ContextVar[_Notes | None] = ContextVar("_notes", default=None)


@contextmanager
def noting_inputs() -> Iterator[None]:
    """Note the files that are read inside, and refuse to write in their place."""
    token = _notes.set(_Notes())
    try:
        yield
    finally:
        _notes.reset(token)


def note_input(path: Path) -> None:
    """Note that a file was read; one that the command itself wrote before is no input."""
    notes, identity = _notes.get(), _identity(path)
    if notes is not None and identity is not None and identity not in notes.written.values():
        notes.read.setdefault(identity, path)


def note_output(path: Path) -> None:
    """Note that a new file was written; an inode that it took over from a deleted one is no input any more."""
    notes, identity = _notes.get(), _identity(path)
    if notes is not None and identity is not None:
        notes.written[path] = identity
        notes.read.pop(identity, None)


def spare_inputs(*paths: Path) -> None:
    """Refuse paths of outputs at which inputs stand.

    Raises:
        InputError: one of them is, or leads to, a file that this command has read.
    """
    notes = _notes.get()
    for path in paths:
        identity = _identity(path)
        if notes is not None and identity in notes.read:
            known = notes.read[identity]
            other = "" if known == path else f" ({known})"
            raise InputError(
                f"{path}: this is an input{other}, and no output takes its place; choose another name or folder"
                " [E-FILE-06]"
            )


def _identity(path: Path) -> _Identity | None:
    try:
        found = os.stat(path)
    except (OSError, ValueError):  # Python's own for a null byte in a name
        return None
    return found.st_dev, found.st_ino
