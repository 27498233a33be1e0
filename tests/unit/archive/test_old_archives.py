"""Archives of earlier layouts are read as the program that wrote them read them (docs/develop/versioning.md).

The files in layout_2, and what `show --json` printed of them, come from a commit before layout 3.
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from cases.small_frame import edesign

from edesign.archive.reader import open_archive
from edesign.report.archive.summary import summarise

OLD = Path(__file__).parent / "layout_2"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A copy of the old archive, its project and its record."""
    for name in ("project.yaml", "motion.csv", "project.h5", "project.h5.partial"):
        shutil.copy(OLD / name, tmp_path)
    return tmp_path


def kept(old: Any, new: Any, place: str = "") -> list[str]:
    """Places where a value of the old summary is not in the new one; the new one may say more."""
    if isinstance(old, dict):
        lost = [f"{place}/{key}" for key in old if key not in new]
        return lost + [found for key in old if key in new for found in kept(old[key], new[key], f"{place}/{key}")]
    if isinstance(old, list):
        if len(old) != len(new):
            return [place]
        return [found for i, pair in enumerate(zip(old, new, strict=True)) for found in kept(*pair, f"{place}/{i}")]
    return [] if old == new else [place]


def test_the_summary_says_what_it_said(folder: Path) -> None:
    """Every number, bit for bit: response measures are computed anew from the stored extremes."""
    printed = json.loads((OLD / "show.json").read_text(encoding="utf-8"))
    now = json.loads(json.dumps(summarise(folder / "project.h5")))
    printed["archive"] = now["archive"]  # the path
    assert kept(printed, now) == []


def test_values_and_attributes_are_read(folder: Path) -> None:
    with open_archive(folder / "project.h5") as archive:
        assert archive.attributes["edesign_archive"] == 2 and archive.complete
        shake = archive.group("analyses/shake")
        project = archive.group().variables["project_text"]
    assert str(project.values) == (OLD / "project.yaml").read_text(encoding="utf-8")
    assert shake.attributes["status"] == "completed"
    history, most = shake.variables["storey_drift"], shake.variables["storey_drift_max"]
    assert history.dims == ("time", "storey") and most.dims == ("storey",)
    # rigid diaphragms: every column line has the mean; 1e-6: layout 2 keeps both in double precision
    assert history.values.max(axis=0) == pytest.approx(most.values, rel=1e-6)


def test_the_report_is_written(folder: Path) -> None:
    done = edesign("report", folder / "project.h5")
    assert done.returncode == 0, done.stderr
    page = (folder / "project.html").read_text(encoding="utf-8")
    assert "An archive of layout 2" in page and "shake" in page


def test_a_run_stopped_under_an_older_state_is_shown_but_not_continued(folder: Path) -> None:
    """Results of two states of the program are never mixed: the run says so and starts afresh."""
    (folder / "project.h5").unlink()
    shown = summarise(folder / "project.h5.partial")
    done = [analysis["name"] for analysis in shown["analyses"] if analysis["status"] == "completed"]
    assert done == ["modes", "gravity"]
    again = edesign("run", folder / "project.yaml")
    assert again.returncode == 0, again.stderr
    said = f"{again.stdout}{again.stderr}"
    assert "results of an interrupted run not used" in said and "starting afresh" in said
    with open_archive(folder / "project.h5") as archive:
        assert archive.attributes["edesign_archive"] == 3 and archive.complete
