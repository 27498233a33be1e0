"""Buildings on springs against closed forms, and against plane frames on springs that stand in space.

References: springs in series by hand; the core of plane frames, by project files extracted from the building whose
supports are replaced.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_building_model import plane_project, regular, responses
from verification.test_verify_shaken_buildings import TABLE, stiffness

from edesign.core import Analysis, Response
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import parse_project
from edesign.project.building import Building
from edesign.project.project import Project
from edesign.space.nonlinear import build_building
from edesign.study.analysis.structure import make_frame

FIRST = {"x": ("A1", "B1", "C1"), "y": ("A1", "A2", "A3")}
"""Column lines of the first frame along a direction."""


def on(support: str, along: str, more: str = "") -> Building:
    """Two equal frames along a direction on supports; `@u@` and `@r@` are sway and turn in their planes."""
    turn = {"x": "ry", "y": "rx"}[along]
    written = support.replace("@u@", f"u{along}").replace("@r@", turn)
    return regular(along, "", f"supports: {{default: {written}}}\n{more}")


def on_plane(whole: Building, support: str, along: str, monkeypatch: pytest.MonkeyPatch, more: str = "") -> Project:
    """The project of one of the frames, on supports of its own."""
    fixed = whole.model_copy(update={"supports": "fixed"})
    text = plane_project(fixed, along, monkeypatch).text
    text = text.replace("  supports: fixed\n", f"  supports: {{default: {support}}}\n") + more
    return parse_project(text, "frame.yaml", BuildingSections())


def compare(plane: FrameModel, space: FrameModel, along: str) -> list[Response]:
    """Modes, gravity, a push and a history of the frames that yield, to 1e-9 of the largest value of each kind."""
    members = ("C_A1_1", "BX_1_1_1" if along == "x" else "BY_A_1_1")
    expected = responses(plane, 0, 1.0, ("A", "B", "C"), ("C_A_1", "B_1_1"), 1.0)
    found = responses(space, "xy".index(along), 2.0, FIRST[along], members, -1.0)
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-9)
    sizes = {name: max(np.abs(run.values[name]).max() for run in expected[1]) for name in expected[1][0].values}
    for own, run in zip(found[1], expected[1], strict=True):
        for name, values in run.values.items():
            scale = max(size for other, size in sizes.items() if other.startswith(name.rstrip("0123456789 ")))
            np.testing.assert_allclose(own.values[name], values, rtol=0.0, atol=1e-9 * scale, err_msg=name)
    return found[1]


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_row_of_plane_frames_on_springs(along: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """1e-9: both iterate to 1e-12 of the forces. The building has twice the frames, each on springs of its own."""
    whole = on("{@u@: 60 MN/m, uz: 300 MN/m, @r@: 40 MN*m/rad}", along)
    plane = on_plane(whole, "{horizontal: 60 MN/m, vertical: 300 MN/m, rotation: 40 MN*m/rad}", along, monkeypatch)
    runs = compare(make_frame(plane), build_building(whole), along)
    assert max(np.abs(run.values["column plastic_rotation 0"]).max() for run in runs) > 1e-3


def test_a_table_on_springs() -> None:
    """Columns that sway and twist in series with the springs under them; 1e-9: the columns are elastic, no more than
    roundings are between the two."""
    springs = {"ux": 20e6, "uy": 30e6, "rx": 8e6, "ry": 5e6, "rz": 0.3e6}
    written = ", ".join(f"{name}: {k / 1e6} MN{'*m/rad' if name[0] == 'r' else '/m'}" for name, k in springs.items())
    still = TABLE[: TABLE.index("records:")]
    whole = building(still, ("storeys: [3.5 m]", f"storeys: [3.5 m]\nsupports: {{default: {{{written}}}}}"))
    k_x, k_y, k_t = stiffness("HEB200")
    k_x = 1.0 / (1.0 / k_x + 1.0 / springs["ux"] + 3.5**2 / springs["ry"])
    k_y = 1.0 / (1.0 / k_y + 1.0 / springs["uy"] + 3.5**2 / springs["rx"])
    k_t = 1.0 / (1.0 / k_t + 1.0 / springs["rz"])
    turning = 4.0 * (k_x * 2.5**2 + k_y * 3.0**2 + k_t)
    mass, polar = 32e3, 32e3 * (3.0**2 + 2.5**2)
    expected = sorted(2 * np.pi * np.sqrt([mass / (4 * k_x), mass / (4 * k_y), polar / turning]), reverse=True)
    np.testing.assert_allclose(Analysis(build_building(whole).model).modes(3).period, expected, rtol=1e-9)
