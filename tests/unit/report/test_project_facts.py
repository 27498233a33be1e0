"""A project in words names the springs that its members have."""

from __future__ import annotations

from pathlib import Path

from edesign import load_project
from edesign.project.template import new_project
from edesign.report.page.project_facts import project_rows

CASES = Path(__file__).parents[2] / "cases"


def test_hinges_joints_panel_zones_and_braces_that_buckle_are_named() -> None:
    rows = dict(project_rows(load_project(CASES / "deteriorating_hinges" / "project.yaml")))
    found, given, *_ = rows["Plastic hinges"].split("; ")
    # 1.06 M_p of the plates of IPE400 without 4 x 40 mm of flange (Lignos and Krawinkler 2011; AISC 358, Eq. 5.8-4)
    W_pl = (180.0 - 2.0 * 40.0) * 13.5 * (400.0 - 13.5) + 8.6 * (400.0 - 2.0 * 13.5) ** 2 / 4.0
    M_y = f"{1.06 * W_pl * 275.0 / 1e6:.0f} kN m"
    assert found == f"at both ends of 1 beam, M_y = {M_y}, by Lignos and Krawinkler (2011)"
    assert given == "at both ends of 1 beam, M_y = 400 kN m"
    assert rows["Semi-rigid joints"] == "at the end of 1 beam, S_j = 90.0 MN m/rad, M_j,Rd = 300 kN m"
    assert rows["Panel zones"] == "lines all, floors 1, doubler plates 6.00 mm"
    braces = dict(project_rows(load_project(CASES / "buckling_braces" / "project.yaml")))
    assert braces["Braces"] == "5, of which 5 buckle in the analysis"
    assert "Plastic hinges" not in braces


def test_every_storey_bay_and_floor_of_loads_is_said(tmp_path: Path) -> None:
    """Storeys of 4, 3.5 and 3.5 m were printed as 3 of 4 m, 3.5 m."""
    rows = dict(project_rows(load_project(new_project(tmp_path / "frame"))))
    assert rows["Storeys"] == "3: 4 m, 2 × 3.5 m; 11 m in all"
    assert rows["Bays"] == "3 of 6 m; 18 m in all"
    first, second = rows["Floor loads"].split("; ")
    assert first.startswith("floors 1-2: G = 4.50") and second.startswith("floor 3: G = 4.00")


def test_loads_inside_members_and_of_a_leaning_column_are_said() -> None:
    """As the files have them: forces at thirds, a wall that grows, earth pressure on one storey."""
    rows = dict(project_rows(load_project(CASES / "loads_inside_members" / "project.yaml")))
    thirds, wall, post = rows["Beam loads"].replace("; G = ", " and G = ").split("; ")
    assert thirds == "floor 1, bay 1: G = 60.0 kN, Q = 20.0 kN at 33.3 %, 66.7 %"
    assert wall == (
        "floor 1, bay 2: G = 40.0 kN, Q = 0 kN at 3 m and G = 6.00 to 12.0 kN/m, Q = 0 kN/m from 4 m to 6 m"
    )
    assert post.startswith("floor 2, bay 1: G = 30.0 kN, Q = 0 kN at 50 % and G = 4.00 to 8.00 kN/m")
    assert rows["Column loads"] == "line A, storey 1: G = 5.00 kN/m, Q = 0 kN/m to the right"
    assert rows["Floor loads"] == "all beams: G = 3.00 kN/m², Q = 2.00 kN/m² on a tributary width of 2.5 m"
    rows = dict(project_rows(load_project(CASES / "leaning_column" / "project.yaml")))
    assert rows["Leaning column"] == "at each floor G = 1400 kN, Q = 500 kN"


def test_rigid_ends_are_reported_with_their_lengths() -> None:
    """Half the depth of HEB300 and of IPE400."""
    rows = dict(project_rows(load_project(CASES / "rigid_ends" / "project.yaml")))
    assert "of half the depth of the beams, 200 mm" in rows["Rigid ends"]
    assert "of half the depth of the columns, 150 mm" in rows["Rigid ends"]
