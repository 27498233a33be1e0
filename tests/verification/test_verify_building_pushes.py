"""Pushes of buildings along x and y against plastic theory, plane frames, statics of rigid floors and symmetry.

References: mechanism loads and rotations of rigid floors by hand; plane frames by the core of plane frames, extracted
from the building; energies that the core counts.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import scipy.linalg
from building_examples import SMALL, building
from verification.test_verify_building_model import SHARP, leaning_building, plane_project, regular

from edesign.archive.dataset import Group
from edesign.core import Analysis, Modes
from edesign.frame.sections.steel_section import steel_section
from edesign.project.analysis.analyses import BuildingPushover, FramePushover, TargetAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building import Building
from edesign.study.analysis import structure
from edesign.study.analysis.capacity import Basis, capacity
from edesign.study.analysis.leading_mode import leading_mode
from edesign.study.analysis.pushover import run_pushover
from edesign.study.analysis.structure import make_structure
from edesign.study.analysis.target import run_target
from edesign.study.plan.plan import pushover_parts


@pytest.fixture
def sharp(monkeypatch: pytest.MonkeyPatch) -> None:
    """Answers are iterated to rounding, so that what is left between them is the difference of the models."""

    def analysis(model: Any, tolerance: float) -> Analysis:
        return Analysis(model, **SHARP)

    monkeypatch.setattr(structure, "Analysis", analysis)


def pushover(direction: str, **more: Any) -> BuildingPushover:
    values = {"name": "push", "kind": "pushover", "pattern": "uniform", "steps": 40, "direction": direction, **more}
    return BuildingPushover.model_validate(values)


def pushed(of: Building, direction: str, **more: Any) -> Group:
    group = run_pushover(of, pushover(direction, **more))
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    return group


def values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


# --- plastic theory

PORTAL = """\
edesign_building: 1
title: A table of four columns under stiff beams
plan: {x: [@x@], y: [@y@]}
storeys: [4 m]
columns: [{section: HEB200, material: S275, strong: x}]
beams:
  - {along: x, section: HEB600, material: stiff}
  - {along: y, section: HEB600, material: stiff}
materials: {S275: {fy: 275 MPa}, stiff: {fy: 275 MPa, law: elastic}}
loads: {self_weight: false, nodes: [{at: all, floors: 1, G: @G@}]}
masses: {given: [{floors: 1, mass: 10 t}]}
elements: {geometry: {columns: @geometry@}}
"""
W_Y, W_Z, H, FY = 642.5e-6, 305.8e-6, 4.0, 275e6
"""Plastic section moduli of an HEB200 about both axes, m3 (tables of the producers), height and yield stress."""


def portal(x: str = "12 m", y: str = "12 m", G: str = "0 kN", geometry: str = "linear") -> Building:
    text = PORTAL
    for name, value in {"x": x, "y": y, "G": G, "geometry": geometry}.items():
        text = text.replace(f"@{name}@", value)
    return building(text)


@pytest.mark.parametrize(("direction", "modulus"), [("x+", W_Y), ("x-", W_Y), ("y+", W_Z), ("y-", W_Z)])
def test_mechanism_load_of_a_space_portal(direction: str, modulus: float) -> None:
    """Hinges at both ends of four columns: V = 8 W_pl f_y / h, about the strong axis and about the weak one.

    1 %: fibres have the area and second moments of the section with its fillets, not its plastic modulus, and the
    columns get 1 % of N_pl from the beams.
    """
    group = pushed(portal(), direction, roof_drift=0.08)
    sign = 1.0 if direction.endswith("+") else -1.0
    along = "xy".index(direction[0])
    shear = sign * values(group, "base_shear")
    assert shear[-1, along] == pytest.approx(8.0 * modulus * FY / H, rel=0.01)
    assert abs(shear[:, 1 - along]).max() < 1e-6 * shear[-1, along]
    assert values(group, "control_displacement")[-1] == pytest.approx(0.08 * H)
    assert group.attributes["direction"] == direction
    happened = values(group, "capacity_event_what").tolist()
    about, other = ("y", "z") if along == 0 else ("z", "y")
    assert f"first hinge in a column about {about}" in happened
    assert f"first hinge in a column about {other}" not in happened
    place = values(group, "capacity_event_place")[happened.index("drift of CP, 5 %")]
    assert place.startswith(f"storey 1 along {direction[0]} at ")


# --- statics of a rigid floor


@pytest.mark.parametrize(("direction", "position", "way"), [("x+", "+y", -1), ("x+", "-x-y", 1), ("y-", "+x", -1)])
def test_loads_beside_the_centre_of_mass_turn_the_floor(direction: str, position: str, way: int) -> None:
    """A turn of V e / K of the floor, K = k_x B^2 / 4 + k_y L^2 / 4 + 4 G I_t / h with the stiffness of both axes.

    The stiffness k is that of a push without eccentricity. 2e-3: corner columns shorten otherwise when the floor turns.
    """
    of = portal("10 m", "6 m")
    k = {}
    for axis in ("x", "y"):
        group = pushed(of, f"{axis}+", roof_drift=1e-5, steps=1)
        k[axis] = values(group, "base_shear")[-1, "xy".index(axis)] / values(group, "control_displacement")[-1]
    group = pushed(of, direction, roof_drift=1e-5, steps=1, eccentricity=position, eccentricity_ratio=0.1)
    torsion = 4.0 * 210e9 / 2.6 * steel_section("HEB200").I_t / H
    K = k["x"] * 6.0**2 / 4.0 + k["y"] * 10.0**2 / 4.0 + torsion
    e, shear = (0.6, k["x"] * 4e-5) if direction[0] == "x" else (1.0, k["y"] * 4e-5)
    assert values(group, "base_shear")[-1, "xy".index(direction[0])] == pytest.approx(
        shear * (1 if direction.endswith("+") else -1), rel=1e-6
    )
    assert values(group, "floor_rotation")[-1, 0] == pytest.approx(way * shear * e / K, rel=2e-3)
    moment = values(group, "storey_torque")[-1, 0] / values(group, "lateral_load")[-1]
    assert moment == pytest.approx(values(group, "lateral_load_moment")[0], rel=1e-6)
    assert moment * (1 if direction.endswith("+") else -1) == pytest.approx(way * e, rel=1e-6)
    assert group.attributes["eccentricity"] == position


# --- plane frames

HAZARD = """\
hazard: {code: ec8-2004, a_gR: 0.6 g, ground: C, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}
"""
SHARED = ("base_shear", "storey_shear", "curve_base_shear", "idealised_base_shear", "lateral_load")
"""What two equal frames have together."""
ALONE = ("roof_drift", "control_displacement", "floor_displacement", "storey_drift", "curve_displacement")
TARGETS = (
    "T",
    "Gamma",
    "d_t",
    "q_u",
    "T_i",
    "T_e",
    "C_0",
    "C_1",
    "alpha",
    "mu_strength",
    "mu_max",
    "alpha_PDelta",
    "R",
)


@pytest.mark.parametrize(("along", "pattern"), [("x", "first_mode"), ("y", "first_mode"), ("y", "triangular")])
def test_pushes_of_plane_frames(along: str, pattern: str, sharp: None, monkeypatch: pytest.MonkeyPatch) -> None:
    """A building of two equal frames is pushed as one of them is in its plane, with its targets and events.

    1e-9 of the largest value: both iterate to 1e-12 of the forces.
    """
    whole = regular(along, "", HAZARD)
    plane = plane_project(whole, along, monkeypatch)
    shared = {"name": "push", "kind": "pushover", "pattern": pattern, "steps": 60, "roof_drift": 0.06}
    shared |= {"targets": ("n2", "fema356", "asce41")}
    for of_building, of_frame in ((f"{along}+", "right"), (f"{along}-", "left")):
        found = results(whole, BuildingPushover.model_validate({**shared, "direction": of_building}))
        expected = results(plane, FramePushover.model_validate({**shared, "direction": of_frame}))
        assert list(found) == list(expected)
        for name, group in expected.items():
            own = found[name]
            assert own.attributes["status"] == "completed", own.attributes["reason"]
            assert own.attributes["direction"] == of_building
            for keys, count in ((ALONE, 1.0), (SHARED, 2.0)):
                for key in (key for key in keys if key in group.variables):
                    same(of_axis(own, key, along), count * values(group, key), key)
            for key in (f"{name.split('.')[1]}_{key}" for key in TARGETS if "." in name):
                if key in group.variables:
                    same(values(own, key), values(group, key), key)
            assert [(step, word.partition(" about")[0]) for step, word in events(own)] == events(group)
        assert len(events(expected["push"])) > 5


def same(own: np.ndarray, expected: np.ndarray, what: str) -> None:
    scale = np.abs(expected).max()
    np.testing.assert_allclose(own, expected, rtol=0.0, atol=1e-9 * scale, err_msg=what)


def of_axis(group: Group, name: str, along: str) -> np.ndarray:
    variable = group.variables[name]
    return np.asarray(variable.values[..., "xy".index(along)] if "direction" in variable.dims else variable.values)


def results(of: AnalysisFile, spec: BuildingPushover | FramePushover) -> dict[str, Group]:
    parts = pushover_parts(spec, tuple(of.hazard_levels))
    return {
        part.name: run_target(of, part) if isinstance(part, TargetAnalysis) else run_pushover(of, part)
        for part in parts
    }


def events(group: Group) -> list[tuple[int, str]]:
    if "capacity_event_what" not in group.variables:
        return []
    return list(zip(*(values(group, f"capacity_event_{key}").tolist() for key in ("step", "what")), strict=True))


# --- symmetry


@pytest.mark.parametrize("pattern", ["first_mode", {"modes": 6}])
def test_a_mirrored_and_a_turned_building_are_pushed_alike(sharp: None, pattern: Any) -> None:
    """A setback, weak columns and one brace: floors, their turns, drifts, forces and events follow the axes.

    Turned by its diagonal x becomes y, which is a mirror too, so that turns about the vertical change their sign.
    1e-9 of the largest value: iterated to 1e-12 of the forces.
    """
    hazard = building(
        PORTAL.replace("@x@", "6 m").replace("@y@", "6 m").replace("@G@", "1 kN").replace("@geometry@", "linear")
        + HAZARD
    ).hazard
    of = {
        key: leaning_building(*key).model_copy(update={"hazard": hazard})
        for key in (("x", False), ("x", True), ("y", False))
    }
    for direction, position in (("x+", "-x+y"), ("y-", "+x+y")):
        expected = pushed(of["x", False], direction, pattern=pattern, eccentricity=position, roof_drift=0.03)
        assert np.abs(values(expected, "floor_rotation")).max() > 1e-3
        assert np.abs(values(expected, "column_plastic_rotation_max")).max() > 1e-3
        mirror = str.maketrans("+-", "-+")
        seen = direction.translate(mirror) if direction[0] == "x" else direction
        own = pushed(
            of["x", True],
            seen,
            pattern=pattern,
            eccentricity=position[:2].translate(mirror) + position[2:],
            roof_drift=0.03,
        )
        alike(own, expected, (-1.0, 1.0), (0, 1))
        swap = str.maketrans("xy", "yx")
        turned = position[2:].translate(swap) + position[:2].translate(swap)
        own = pushed(of["y", False], direction.translate(swap), pattern=pattern, eccentricity=turned, roof_drift=0.03)
        alike(own, expected, (1.0, 1.0), (1, 0))


def alike(own: Group, expected: Group, signs: tuple[float, float], axes: tuple[int, int]) -> None:
    """What was pushed in a mirror that changes signs along x and y, or takes one axis for the other."""
    for name in ("floor_displacement", "storey_drift", "base_shear", "storey_shear"):
        same(values(own, name)[..., axes] * signs, values(expected, name), name)
    same(-values(own, "floor_rotation"), values(expected, "floor_rotation"), "turn")
    same(values(own, "control_displacement"), values(expected, "control_displacement"), "control")
    same(values(own, "lateral_load_share"), values(expected, "lateral_load_share"), "shares")
    assert events(own) == events(expected)


# --- leading modes

SQUARE = """\
edesign_building: 1
title: A square table
plan: {x: [6 m], y: [6 m]}
storeys: [4 m, 4 m]
columns: [{section: SHS200x10, material: S275, strong: x}]
beams: [{along: x, section: IPE300, material: S275}, {along: y, section: IPE300, material: S275}]
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {self_weight: false}
masses: {given: [{floors: all, mass: 10 t}]}
"""


@pytest.mark.parametrize("angle", [0.0, 0.25, 1.0])
def test_modes_of_one_frequency_lead_each_in_its_direction(angle: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both axes of a square building have one frequency: in each direction one mode leads, with equal shapes.

    So it is whichever turn, as a share of 90 degrees, the solution gives these two modes. Two storeys have some 90 % of
    their mass in the first mode; with half of them turned by 45 degrees it would be 45 %.
    """
    of = building(SQUARE)

    def turned(analysis: Analysis, count: int, stiffness: Any = None) -> Modes:
        modes = whole(analysis, count, stiffness)
        c, s = np.cos(angle * np.pi / 2.0), np.sin(angle * np.pi / 2.0)
        mixed = {}
        for name in ("shapes", "participation"):
            mixed[name] = getattr(modes, name).copy()
            mixed[name][:2] = np.tensordot(np.array([[c, s], [-s, c]]), mixed[name][:2], axes=1)
        return replace(modes, **mixed, effective_mass_ratio=mixed["participation"] ** 2 / 80e3)

    whole = Analysis.modes
    monkeypatch.setattr(Analysis, "modes", turned)
    made = make_structure(of)
    made.apply_gravity()
    for direction, other in zip(made.frame.directions, made.frame.directions[::-1], strict=True):
        mode = leading_mode(made, direction)
        assert 0.85 < mode.participation**2 / 80e3 < 0.99
        across = mode.shape[:, other.degree]
        assert np.abs(across).max() < 1e-6 * np.abs(mode.shape[:, direction.degree]).max()
    first, second = (Basis(of, pushover(f"{axis}+", pattern="first_mode")) for axis in ("x", "y"))
    assert first.forces == pytest.approx(second.forces, rel=1e-9)
    assert first.first_mode == pytest.approx(second.first_mode, rel=1e-9)


def test_the_leading_mode_is_not_the_first_one() -> None:
    """HEB columns are weaker about z: mode 1 is along y, and the pattern along x is still that of a mode along x."""
    of = building(SQUARE, ("SHS200x10", "HEB200"))
    made = make_structure(of)
    made.apply_gravity()
    x, y = (leading_mode(made, direction) for direction in made.frame.directions)
    assert made.modes(1).period[0] == pytest.approx(y.period, rel=1e-12)
    assert x.period < 0.8 * y.period
    assert Basis(of, pushover("x+", pattern="first_mode")).first_mode[0] == pytest.approx(x.period, rel=1e-9)


# --- second order


@pytest.mark.parametrize("direction", ["x+", "y-"])
def test_the_descent_of_a_mechanism(direction: str) -> None:
    """Four columns with hinges at both ends lose P / h of their base shear for each metre, all by vertical loads."""
    found = capacity(portal(G="150 kN", geometry="p_delta"), pushover(direction, roof_drift=0.08, steps=80))
    u, V = found.curve.displacement, found.curve.force
    slope = found.second_order_slope(0.24, 0.32)
    assert slope is not None and slope == pytest.approx(-4 * 150e3 / H, rel=1e-3)
    assert np.interp(0.32, u, V) - np.interp(0.24, u, V) == pytest.approx(0.08 * slope, rel=0.1)


def test_the_second_order_slope_of_a_floor_that_turns() -> None:
    """The work of vertical loads that the core counts is half of the slope's part times the work of the loads.

    An elastic frame moves in proportion to its loads. 1e-3: gravity has moved it before.
    """
    of = portal("10 m", "6 m", "150 kN", "p_delta")
    elastic = of.model_copy(
        update={"materials": {n: s.model_copy(update={"law": "elastic"}) for n, s in of.materials.items()}}
    )
    found = capacity(elastic, pushover("y+", roof_drift=0.01, steps=4, eccentricity="+x", eccentricity_ratio=0.3))
    one = found.push
    end = one.displacement[-1]
    work = one.response.energy["p_delta"][-1] - one.response.energy["p_delta"][0]
    name = one.frame.model.node_names[one.frame.control]
    moved = one.floors[-1, 0] - one.floors[0, 0] + one.moments[name] * (one.turned[-1, 0] - one.turned[0, 0])
    assert abs(one.turned[-1, 0]) > 1e-3
    assert found.second_order_slope(0.0, end) == pytest.approx(2.0 * work / moved / end, rel=1e-3)


def test_a_roof_that_is_not_rigid() -> None:
    """The node in its middle is the control node, and its nodes share the forces by their masses; it has no moments."""
    of = building(SMALL, ("columns: [{s", "diaphragms: none\ncolumns: [{s"))
    made = make_structure(of)
    assert made.frame.model.node_names[made.frame.control] == "B2.2"
    group = pushed(of, "y+", pattern="first_mode", roof_drift=0.005, steps=10)
    loads = dict(zip(group.coords["loaded_node"].values.tolist(), values(group, "lateral_load_share"), strict=True))
    assert len(loads) == len(made.frame.masses) and min(loads.values()) > 0.0
    assert "floor_rotation" not in group.variables
    assert values(group, "base_shear")[-1, 1] == pytest.approx(values(group, "lateral_load")[-1], rel=1e-6)


@pytest.mark.parametrize(
    ("masses", "node"),
    [
        ({"A1": 30, "B1": 2, "C1": 10, "C3": 20}, "B1.1"),  # the centre is (6 m, 3.87 m): the lightest is nearest
        ({"A1": 10, "A3": 10, "C1": 10, "C3": 10}, "A1.1"),  # all are as near and as heavy
        ({"A1": 10, "A3": 20, "C1": 10, "C3": 20}, "A3.1"),  # (6 m, 8 m) is nearer to A3 and C3
    ],
)
def test_control_nodes_of_roofs_that_are_not_rigid(masses: dict[str, int], node: str) -> None:
    """By hand: the node with mass nearest to the centre of mass of the roof, whatever its own mass."""
    given = ", ".join(f"{{at: {at}, floors: 1, mass: {mass} t}}" for at, mass in masses.items())
    text = FLEXIBLE.replace("@section@", "HEM400").replace("{at: @at@, floors: all, mass: 10 t}", given)
    made = make_structure(building(text.replace("columns:", "diaphragms: none\ncolumns:")))
    assert made.frame.model.node_names[made.frame.control] == node


# --- torsion

FLEXIBLE = """\
edesign_building: 1
title: A strong cross of columns in the middle of a wide floor
plan: {x: [6 m, 6 m], y: [6 m, 6 m]}
storeys: [4 m]
columns:
  - {section: SHS120x8, material: S275, strong: x}
  - {at: B2, section: @section@, material: S275, strong: x}
beams: [{along: x, section: IPE300, material: S275}, {along: y, section: IPE300, material: S275}]
materials: {S275: {fy: 275 MPa}}
loads: {self_weight: false}
masses: {given: [{at: @at@, floors: all, mass: 10 t}]}
"""


@pytest.mark.parametrize(
    ("section", "at", "numbers"), [("SHS120x8", "[A2, B1, B2, B3, C2]", []), ("HEM400", "all", [1])]
)
def test_warnings_of_torsionally_flexible_buildings(section: str, at: str, numbers: list[int]) -> None:
    """A column in the middle holds the floor against displacements and not against turns: the first mode is a turn.

    Of nine equal columns turns are stiffer, as masses have a radius of 5.4 m about the middle and columns one of 6.9 m.
    """
    of = building(FLEXIBLE.replace("@section@", section).replace("@at@", at) + HAZARD)
    (spec,) = pushover_parts(pushover("x+", targets=("n2",)), ("DBE",))[1:]
    assert isinstance(spec, TargetAnalysis)
    basis = Basis(of, spec)
    assert list(basis.torsional_modes) == numbers
    assert all(part == pytest.approx(1.0, abs=1e-6) for part in basis.torsional_modes.values())
    said = [warning["kind"] for warning in run_target(of, spec).attributes["warnings"]]
    assert ("target_torsion" in said) == bool(numbers)


ECCENTRIC = """\
edesign_building: 1
title: Cantilever columns under a rigid floor, those of frame YC stronger
plan: {x: [6 m, 5 m], y: [6 m]}
storeys: [4 m]
columns:
  - {section: HEB160, material: S275, strong: y}
  - {at: C, section: @section@, material: S275, strong: y}
beams:
  - {along: x, section: IPE80, material: S275, ends: pinned}
  - {along: y, section: IPE80, material: S275, ends: pinned}
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {self_weight: false}
masses: {given: [{at: all, floors: 1, mass: 8 t}]}
elements: {geometry: {columns: linear}}
hazard: {code: ec8-2004, a_gR: 0.2 g, ground: B, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}
"""


def three_degrees(strong: str, eccentricity: float) -> tuple[np.ndarray, np.ndarray]:
    """Normalised displacements along y of frames YA, YB, YC: by CQC of three modes, and by statics.

    Cantilevers 3 E I / h^3 about both axes and G I_t / h; masses of a grid of six points, moved along x by a part of
    11 m; S_e of ground B in place of formulas of the package: plateau, T_B = 0.15 s, T_C = 0.5 s, T_D = 2 s, S = 1.2.
    """
    xs, ys = np.repeat([0.0, 6.0, 11.0], 2), np.tile([0.0, 6.0], 3)
    sections = [steel_section(strong if x == 11.0 else "HEB160") for x in xs]
    k_y = np.array([3.0 * 210e9 * of.I_y / 64.0 for of in sections])
    k_x = np.array([3.0 * 210e9 * of.I_z / 64.0 for of in sections])
    turning = sum(210e9 / 2.6 * of.I_t / 4.0 for of in sections)
    x_m, y_m = xs.mean() + eccentricity * 11.0, ys.mean()
    x, y = xs - x_m, ys - y_m
    K = np.array([[k_y.sum(), k_y @ x], [k_y @ x, k_y @ x**2 + k_x @ y**2 + turning]])  # y and turn: x is apart
    m = 8e3
    M = np.diag([6 * m, m * np.sum((xs - xs.mean()) ** 2 + (ys - ys.mean()) ** 2)])
    values, shapes = scipy.linalg.eigh(K, M)
    T = 2.0 * np.pi / np.sqrt(values)
    S_e = 0.2 * 9.80665 * 1.2 * 2.5 * np.where(T <= 0.5, 1.0, np.where(T <= 2.0, 0.5 / T, 0.5 * 2.0 / T**2))
    assert T.min() > 0.15
    peaks = shapes[0] * 6 * m * S_e * (T / (2.0 * np.pi)) ** 2
    r = T[0] / T[1]
    rho = 8 * 0.05**2 * (1 + r) * r**1.5 / ((1 - r**2) ** 2 + 4 * 0.05**2 * r * (1 + r) ** 2)

    def ratios(of: np.ndarray) -> np.ndarray:
        """Of displacements along y and turns, by mode or of one push, (2,) or (2, n)."""
        at = np.array([of[0] + lever * of[1] for lever in (-x_m, 6.0 - x_m, 11.0 - x_m, xs.mean() - x_m)])
        combined = at if at.ndim == 1 else np.sqrt(at[:, 0] ** 2 + at[:, 1] ** 2 + 2 * rho * at[:, 0] * at[:, 1])
        return combined[:3] / combined[3]

    return ratios(shapes * peaks), ratios(np.linalg.solve(K, [1.0, 0.0]))


@pytest.mark.parametrize(
    ("strong", "position", "part"), [("HEB260", "0", 0.0), ("HEB260", "+x", 0.05), ("HEB160", "-x", -0.05)]
)
def test_torsional_amplification_of_a_rigid_floor(strong: str, position: str, part: float) -> None:
    """Ratios at the column lines against two degrees of freedom by hand; 1e-4: beams resist torsion a little."""
    of = building(ECCENTRIC.replace("@section@", strong))
    parts = pushover_parts(pushover("y+", targets=("n2",), eccentricity=position), ("DBE",))
    group = run_target(of, next(one for one in parts if isinstance(one, TargetAnalysis)))
    elastic, pushed_there = three_degrees(strong, part)
    lines = group.coords["amplified_line"].values.tolist()
    order = [lines.index(line) for line in ("A1", "B1", "C1")]
    assert values(group, "line_ratio_elastic")[order] == pytest.approx(elastic, rel=1e-4)
    assert values(group, "line_ratio_push")[order] == pytest.approx(pushed_there, rel=1e-4)
    factor = np.maximum(np.maximum(elastic, 1.0) / pushed_there, 1.0)
    assert values(group, "torsional_amplification")[order] == pytest.approx(factor, rel=1e-4)
    assert factor.max() > 1.02
    drift = np.maximum(values(group, "line_drift_max")[:, 1], -values(group, "line_drift_min")[:, 1])
    on_lines = [lines.index(name.partition(".")[0]) for name in group.coords["drift_line"].values.tolist()]
    assert values(group, "amplified_line_drift") == pytest.approx(
        drift * values(group, "torsional_amplification")[on_lines]
    )


def test_a_symmetric_building_is_not_amplified() -> None:
    of = building(ECCENTRIC.replace("@section@", "HEB160").replace("6 m, 5 m", "6 m, 6 m"))
    (spec,) = pushover_parts(pushover("y-", targets=("n2",)), ("DBE",))[1:]
    assert isinstance(spec, TargetAnalysis)
    assert values(run_target(of, spec), "torsional_amplification") == pytest.approx(1.0, abs=1e-9)
