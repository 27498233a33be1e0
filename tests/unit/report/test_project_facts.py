"""A project in words names the springs that its members have."""

from __future__ import annotations

from pathlib import Path

from edesign import load_project
from edesign.project.template import new_project
from edesign.report.page.project_facts import project_rows

CASES = Path(__file__).parents[2] / "cases"


def test_hinges_joints_panel_zones_and_braces_that_buckle_are_named() -> None:
    rows = dict(project_rows(load_project(CASES / "deteriorating_hinges" / "project.yaml")))
    hinges = "at both ends of 1 beam, Lignos and Krawinkler (2011); at both ends of 1 beam, M_y = 400 kN m"
    assert rows["Plastic hinges"].startswith(hinges)
    assert rows["Joints that turn"] == "at the end of 1 beam, S_j = 90.0 MN m/rad, M_j,Rd = 300 kN m"
    assert rows["Panel zones"] == "lines all, floors 1, doubler plates 6.00 mm"
    braces = dict(project_rows(load_project(CASES / "buckling_braces" / "project.yaml")))
    assert braces["Braces"] == "5, of which 5 buckle in the analysis"
    assert "Plastic hinges" not in braces


def test_every_storey_bay_and_floor_of_loads_is_said(tmp_path: Path) -> None:
    """Storeys of 4, 3.5 and 3.5 m were told as 3 of 4 m, 3.5 m."""
    rows = dict(project_rows(load_project(new_project(tmp_path / "frame"))))
    assert rows["Storeys"] == "3: 4 m, 2 × 3.5 m; 11 m in all"
    assert rows["Bays"] == "3 of 6 m; 18 m in all"
    first, second = rows["Floor loads"].split("; ")
    assert first.startswith("floors 1-2: G = 4.50") and second.startswith("floor 3: G = 4.00")
