"""Buildings on springs and footings against closed forms, and against plane frames on them that stand in space.

References: springs in series by hand; the core of plane frames, by project files extracted from the building whose
supports are replaced; a rigid base in closed form.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_building_model import plane_project, regular, responses
from verification.test_verify_shaken_buildings import HEIGHT, TABLE, stiffness

from edesign.core import Analysis, Response
from edesign.frame.footings import footing_springs
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import parse_project
from edesign.project.building import Building
from edesign.project.project import Project
from edesign.space.nonlinear import build_building
from edesign.space.structure.geometry import space_frame
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
    expected = responses(plane, 0, 1.0, FIRST[along], members, 1.0)
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


def table(supports: str, more: str = "") -> Building:
    """Four cantilevers under a rigid floor of 32 t, 6 m by 5 m."""
    still = TABLE[: TABLE.index("records:")] + more
    return building(still, ("storeys: [3.5 m]", f"storeys: [3.5 m]\nsupports: {{default: {supports}}}"))


def periods_on(springs: Mapping[str, float]) -> np.ndarray:
    """Periods of the table along x and y and about the vertical, whose columns stand on springs."""
    k_x, k_y, k_t = stiffness("HEB200")
    k_x = 1.0 / (1.0 / k_x + 1.0 / springs["ux"] + HEIGHT**2 / springs["ry"])
    k_y = 1.0 / (1.0 / k_y + 1.0 / springs["uy"] + HEIGHT**2 / springs["rx"])
    k_t = 1.0 / (1.0 / k_t + 1.0 / springs["rz"])
    turning = 4.0 * (k_x * 2.5**2 + k_y * 3.0**2 + k_t)
    mass, polar = 32e3, 32e3 * (3.0**2 + 2.5**2)
    return np.asarray(2.0 * np.pi * np.sqrt([mass / (4.0 * k_x), mass / (4.0 * k_y), polar / turning]))


def test_a_table_on_springs() -> None:
    """Columns that sway and twist in series with the springs under them; 1e-9: both are exact but for rounding."""
    springs = {"ux": 20e6, "uy": 30e6, "rx": 8e6, "ry": 5e6, "rz": 0.3e6}
    written = ", ".join(f"{name}: {k / 1e6} MN{'*m/rad' if name[0] == 'r' else '/m'}" for name, k in springs.items())
    found = Analysis(build_building(table(f"{{{written}}}")).model).modes(3)
    np.testing.assert_allclose(found.period, sorted(periods_on(springs), reverse=True), rtol=1e-9)


# --- footings

SOILS = "soils: {sand: {density: 1900 kg/m^3, shear_wave_velocity: 180 m/s, poisson: 0.3, damping: 4 %}}\n"


def footing(along: str, more: str) -> str:
    """A footing of 2.6 m along the frames and 1.9 m across."""
    sides = ("length", "width") if along == "x" else ("width", "length")
    return f"{{footing: {{soil: sand, {sides[0]}: 2.6 m, {sides[1]}: 1.9 m, {more}}}}}"


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_row_of_plane_frames_on_footings(along: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """1e-9, as on springs."""
    more = "embedment: 1 m, thickness: 0.6 m, period: 0.6 s"
    whole = on(footing(along, more), along, SOILS)
    plane = on_plane(whole, footing("x", more), along, monkeypatch, SOILS)
    frame = build_building(whole)
    compare(make_frame(plane), frame, along)
    assert {len(built.dashpots) for built in frame.footings.values()} == {6}


@pytest.mark.parametrize("along", ["x", "y"])
def test_a_row_of_plane_frames_that_lift_off(along: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """1e-9 with light loads, under which footings lift off, and weak soil, into which they are pressed."""
    more = "formula: gazetas, thickness: 0.3 m, uplift: true, bearing_resistance: 34 kPa, period: 0.6 s"
    whole = on(footing(along, more), along, SOILS)
    whole = whole.with_values({("loads", "nodes", 0, "G"): "3 kN", ("loads", "beams", 0, "G"): "4 kN/m"})
    plane = on_plane(whole, footing("x", more), along, monkeypatch, SOILS)
    runs = compare(make_frame(plane), build_building(whole), along)
    force, weight = np.concatenate([run.values["column N"] for run in runs]), 2.6 * 1.9 * 0.3 * 2500.0 * 9.80665
    assert force.max() > weight and force.min() < weight - 34e3 * 2.6 * 1.9


@pytest.mark.parametrize("sides", [(2.2, 1.4), (1.4, 2.2)])
def test_a_table_on_footings(sides: tuple[float, float]) -> None:
    """In series with footings at its own first period, longer along x or along y; 1e-9 as with springs."""
    whole = table(f"{{footing: {{soil: sand, length: {sides[0]} m, width: {sides[1]} m, embedment: 0.8 m}}}}", SOILS)
    frame = build_building(whole)
    modes = Analysis(frame.model).modes(3)
    of = frame.footings["B2.0"].springs
    assert of.period == pytest.approx(modes.period[0], rel=1e-9)
    expected = periods_on(dict(zip(frame.model.degrees, of.stiffness, strict=True)))
    np.testing.assert_allclose(modes.period, sorted(expected, reverse=True), rtol=1e-9)
    long, short = (dict(zip(("x", "y", "z", "rx", "ry", "rz"), of.stiffness, strict=True))[way] for way in ("ry", "rx"))
    assert (long > short) == (sides[0] > sides[1])


def test_a_building_is_designed_on_its_static_footings() -> None:
    """The elastic space frame has the static stiffness of footings as springs at its column bases."""
    whole = table("{footing: {soil: sand, length: 2.2 m, width: 1.4 m, formula: gazetas}}", SOILS)
    frame = space_frame(whole)
    of = footing_springs(whole.footings["A1"], whole.soils["sand"], np.inf, dimension=3)
    assert of.static == of.stiffness and not any(of.dashpot)
    expected = periods_on(dict(zip(("ux", "uy", "uz", "rx", "ry", "rz"), of.static, strict=True)))
    found = build_building(whole, footings={line: of for line in whole.footings})
    assert frame.springs[frame.node_names.index("A1.0")].tolist() == list(of.static)
    np.testing.assert_allclose(Analysis(found.model).modes(3).period, sorted(expected, reverse=True), rtol=1e-9)
