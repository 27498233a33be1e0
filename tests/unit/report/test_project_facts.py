"""A project in words names the springs that its members have."""

from __future__ import annotations

from pathlib import Path

from edesign import load_project
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
