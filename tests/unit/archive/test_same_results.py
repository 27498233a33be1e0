"""The comparison of archives to the last bit: `tools/same_results.py`."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from unit.archive.archive_samples import history_group

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from tools.same_results import differences


def written(path: Path, group: Group, code: str = "a") -> Path:
    with ArchiveWriter(path, Group(attributes={"code_checksum": code})) as writer:
        writer.write("analyses/shake", group)
        writer.write("provenance", Group(attributes={"created": code}))
        return writer.finish({"status": "completed"})


def test_last_bits_and_labels_show_and_times_do_not(tmp_path: Path) -> None:
    before = written(tmp_path / "before.h5", history_group())
    same = history_group()
    same.attributes["statistics"] = {"steps": 50, "cpu_s": 0.2}
    assert differences(before, written(tmp_path / "same.h5", same, code="b")) == []
    other = history_group()
    moved = other.variables["displacement"].values
    moved[3, 1] = np.nextafter(moved[3, 1], np.inf)
    other.attributes["steps"] = 51
    other.add("more", (), 1.0, "1", "one more")
    found = differences(before, written(tmp_path / "other.h5", other))
    assert found == ["/analyses/shake: attribute steps, displacement, more"]
