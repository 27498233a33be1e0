"""Text files appear whole or not at all, and never in place of an archive."""

from __future__ import annotations

import os
import re
from pathlib import Path

import h5py
import pytest

from edesign.archive.dataset import Group
from edesign.archive.files import write_text
from edesign.archive.reader import open_archive, refuse_calibration
from edesign.archive.writer import ArchiveWriter
from edesign.errors import ArchiveError


def test_text_never_takes_the_place_of_an_archive(tmp_path: Path) -> None:
    path = tmp_path / "results.csv"  # whatever its name
    with h5py.File(path, "w") as file:
        file["x"] = 1.0
    before = path.read_bytes()
    with pytest.raises(ArchiveError, match=r"results\.csv: .*E-FILE-07"):
        write_text("a,b\n", path)
    assert path.read_bytes() == before and list(tmp_path.iterdir()) == [path]


def test_text_takes_the_place_of_text(tmp_path: Path) -> None:
    path = tmp_path / "table.csv"
    for text in ("a\n", "b\n"):
        write_text(text, path)
        assert path.read_text(encoding="utf-8") == text
    assert list(tmp_path.iterdir()) == [path]


def test_content_is_on_the_disk_before_the_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After a power failure a file is the old one or the new one, never an empty one."""
    steps = []
    sync, replace = os.fsync, os.replace

    def noted_sync(descriptor: int) -> None:
        steps.append(f"synced {os.fstat(descriptor).st_size} bytes")
        sync(descriptor)

    def noted_replace(old: Path, new: Path) -> None:
        steps.append("renamed")
        replace(old, new)

    monkeypatch.setattr(os, "fsync", noted_sync)
    monkeypatch.setattr(os, "replace", noted_replace)
    write_text("a,b\n", tmp_path / "table.csv")
    assert steps == ["synced 4 bytes", "renamed"]


def test_the_archive_of_a_calibration_names_the_page_that_has_its_results(tmp_path: Path) -> None:
    path, page = tmp_path / "my calibration.h5", tmp_path / "calibration.html"
    with ArchiveWriter(path, Group(attributes={"kind": "calibration"})) as writer:
        writer.finish({"status": "completed"})
    with open_archive(path) as archive:
        with pytest.raises(ArchiveError, match=re.escape(f"there is no report {page},") + ".*E-ARCH-08"):
            refuse_calibration(archive)
        page.write_text("<html>", encoding="utf-8")
        said = re.escape(f"its report is {page}. `edesign export '{path}' --histories '*'`")
        with pytest.raises(ArchiveError, match=f"{said}.*E-ARCH-08"):
            refuse_calibration(archive)
