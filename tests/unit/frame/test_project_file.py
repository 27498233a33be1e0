"""Reading a project file from Python finds what the command line finds."""

from __future__ import annotations

from pathlib import Path

import pytest

import edesign
from edesign.project import ProjectError


def test_section_names_are_checked_against_the_catalogue(tmp_path: Path) -> None:
    path = edesign.new_project(tmp_path / "frame")
    assert edesign.load_project(path).frame.members["C_A_1"].section == "HEB240"
    path.write_text(path.read_text(encoding="utf-8").replace("HEB240", "HEB24O"), encoding="utf-8")
    with pytest.raises(ProjectError, match=r"frame\.columns\[0\]\.section: .*`HEB24O`; did you mean `HEB240`"):
        edesign.load_project(path)
