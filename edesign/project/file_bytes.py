"""Reading files that a user names, with errors for people."""

from __future__ import annotations

from pathlib import Path

from edesign.errors import InputError


def read_file(path: Path, what: str) -> bytes:
    """Read a file.

    Args:
        path: the file.
        what: it is, for messages: "project file".

    Raises:
        InputError: missing, a folder, or unreadable.
    """
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such {what}") from None
    except IsADirectoryError:
        raise InputError(f"{path}: this is a folder; name the {what} in it") from None
    except OSError as error:
        raise InputError(f"{path}: the {what} cannot be read: {error.strerror}") from None
