"""Text of record files, and numbers in it."""

from __future__ import annotations

import math
from pathlib import Path

from edesign.errors import InputError
from edesign.project.reading.file_bytes import read_file


def read_lines(path: Path, otherwise: str = "latin-1") -> list[str]:
    """Read the lines of a text file.

    Args:
        path: the file.
        otherwise: its encoding, of one byte a character, if it is not UTF-8.

    Raises:
        InputError: missing, a folder, unreadable, empty, or not text.
    """
    data = read_file(path, "record file")
    if not data.strip():
        raise InputError(f"{path}: the file is empty")
    if b"\0" in data:
        raise InputError(f"{path}: this is not a text file")
    try:
        return data.decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        return data.decode(otherwise, errors="replace").splitlines()


def number(word: str, path: Path, line: int, what: str = "an acceleration") -> float:
    """Read a finite number.

    Raises:
        InputError: `word` is none; the message names file, line (from 1) and what was expected.
    """
    try:
        value = float(word)
    except ValueError:
        raise InputError(f"{path}:{line}: `{word[:40]}` is not a number; {what} is expected here") from None
    if not math.isfinite(value):
        raise InputError(f"{path}:{line}: `{word[:40]}` is not a finite number; {what} is expected here")
    return value
