"""The examples of docs/how_to/notebooks.md run as they stand, on the project that `edesign new` makes."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

import edesign

pytest.importorskip("pandas")
pytest.importorskip("xarray")
PAGE = Path(__file__).parents[3] / "docs" / "how_to" / "notebooks.md"


def test_the_examples_of_the_page_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    project = edesign.load_project(edesign.new_project(Path("my_frame")))
    analyses = ("modes", "pushover.uniform", "as_recorded")  # of which the page speaks
    edesign.run_project(project, Path("my_frame/project.h5"), only=analyses)
    blocks = re.findall(r"(?:^    .*\n(?:\n(?=    ))?)+", PAGE.read_text(), re.MULTILINE)
    lines = [line[4:] for block in blocks for line in block.splitlines() if not line.strip().startswith("edesign ")]
    code = "\n".join(line for line in lines if "calibration" not in line)  # of which the page makes none
    names: dict[str, object] = {}
    exec(compile(code, str(PAGE), "exec"), names)  # noqa: S102
    periods, largest, data = (names[name] for name in ("periods", "largest", "data"))
    with edesign.open_archive("my_frame/project.h5") as archive:
        modes, history = (archive.group(f"analyses/{name}").variables for name in ("modes", "as_recorded"))
    np.testing.assert_array_equal(periods["T"], modes["period"].values)  # type: ignore[index]
    np.testing.assert_array_equal(largest, history["storey_drift_max"].values)  # type: ignore[call-overload]
    assert data.attrs["status"] == "completed"  # type: ignore[attr-defined]
