"""Records and tables as text files for other programs."""

from __future__ import annotations

import os
from pathlib import Path

from edesign.errors import ArchiveError
from edesign.ground_motion.record import Record

HEADER = "time_s,acceleration_m_s2"


def make_folder(folder: Path) -> None:
    """Make a folder if it is not there.

    Raises:
        ArchiveError: it cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ArchiveError(f"{folder}: the folder cannot be made: {error.strerror}") from error


def write_text(text: str, path: Path) -> None:
    """Write a text file that appears only when it is whole.

    Raises:
        ArchiveError: it cannot be written.
    """
    partial = path.with_name(path.name + ".partial")
    try:
        partial.write_text(text, encoding="utf-8", newline="\n")
        os.replace(partial, path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise ArchiveError(f"{path}: cannot be written: {error.strerror}") from error


def write_csv(record: Record, path: Path) -> None:
    """Write a record as two columns, time (s) and acceleration (m/s2), under the line `time_s,acceleration_m_s2`.

    The accelerations have all their digits: reading gives the same floats.

    Raises:
        ArchiveError: it cannot be written.
    """
    rows = (f"{i * record.time_step:.9g},{value!r}\n" for i, value in enumerate(record.acceleration.tolist()))
    write_text(f"{HEADER}\n{''.join(rows)}", path)
