"""Text of record files."""

from __future__ import annotations

from pathlib import Path

from edesign.errors import InputError
from edesign.project.reading.file_bytes import read_file
from edesign.tables.binary import describe_binary
from edesign.tables.text import decoded, lines_of


def read_lines(path: Path, otherwise: str = "latin-1") -> list[str]:
    """Read the lines of a text file.

    Args:
        otherwise: its encoding, of one byte a character, if it is not UTF-8.

    Raises:
        InputError: missing, a folder, unreadable, empty, not text, or with more or longer lines than are read.
    """
    data = read_file(path, "record file")
    if b"\n" in data and b"\0" not in (kept := data.rstrip(b"\0\x1a \r\n\t\f")):
        data = kept  # old systems filled the last block of a text with zeros
    if not data.strip():
        raise InputError(f"{path}: the file is empty [E-REC-21]")
    if b"\0" in data:  # in UTF-16
        if seen := describe_binary(data):
            raise InputError(f"{path}: this is not a text file; {seen} [E-REC-02]")
        text = decoded(path, data)[1]
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode(otherwise, errors="replace")
    return lines_of(path, text.rstrip())
