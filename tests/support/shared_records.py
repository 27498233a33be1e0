"""The real recordings beside the repository, for tests that are skipped where they are not."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from edesign.ground_motion.formats.read import read_record_file
from edesign.ground_motion.record import Record

SHARED = Path(os.environ.get("EDESIGN_SHARED") or Path(__file__).parents[3] / "shared") / "records"

needs_recordings = pytest.mark.skipif(not SHARED.is_dir(), reason="no folder of real recordings beside the repository")


def recordings() -> list[Record]:
    """All thirteen: AT2 files, and tables in g."""
    paths = [path for path in sorted(SHARED.iterdir()) if path.suffix in (".AT2", ".csv")]
    assert len(paths) == 13
    return [read_record_file(path, acceleration_unit="g" if path.suffix == ".csv" else None) for path in paths]
