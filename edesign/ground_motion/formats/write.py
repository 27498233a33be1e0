"""Records as text files for other programs."""

from __future__ import annotations

from pathlib import Path

from edesign.archive.csv_files import write_csv_file
from edesign.ground_motion.record import Record

HEADERS = ("time_s", "acceleration_m_s2")


def write_csv(record: Record, path: Path) -> None:
    """Write a record as two columns, time (s) and acceleration (m/s2), under the line `time_s,acceleration_m_s2`.

    The accelerations have all their digits: reading gives the same floats.

    Raises:
        ArchiveError: it cannot be written.
    """
    rows = ((f"{i * record.time_step:.9g}", value) for i, value in enumerate(record.acceleration.tolist()))
    write_csv_file(HEADERS, rows, path)
