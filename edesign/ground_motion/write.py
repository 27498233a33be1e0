"""Records as text files for other programs."""

from __future__ import annotations

from pathlib import Path

from edesign.archive.files import write_text
from edesign.ground_motion.record import Record

HEADER = "time_s,acceleration_m_s2"


def write_csv(record: Record, path: Path) -> None:
    """Write a record as two columns, time (s) and acceleration (m/s2), under the line `time_s,acceleration_m_s2`.

    The accelerations have all their digits: reading gives the same floats.

    Raises:
        ArchiveError: it cannot be written.
    """
    rows = (f"{i * record.time_step:.9g},{value!r}\n" for i, value in enumerate(record.acceleration.tolist()))
    write_text(f"{HEADER}\n{''.join(rows)}", path)
