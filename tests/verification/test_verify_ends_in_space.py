"""What stands at the ends of members in space: rigid ends, joints, hinges, panel zones.

References: the frame in its plane by the core of plane frames; closed forms of elastic frames; stiffnesses moved by
hand; the energy that was put in.
"""

from __future__ import annotations

import numpy as np
import pytest
from verification.test_verify_building_model import SHARP, completed, motion, plane_project, regular, responses

from edesign.core import Analysis, Channel, DeterioratingSide, DeterioratingSpring, Model, MultilinearSpring, Response
from edesign.frame.hinges import MemberBuilder, MemberEnd
from edesign.project.frame.hinges import Joints
from edesign.space.nonlinear import build_building
from edesign.study.analysis.structure import make_frame

HINGE = "{M_y: @M@ kN*m, theta_p: 0.02 rad, theta_pc: 0.1 rad, theta_u: 0.2 rad, Lambda: 1 rad, M_c_ratio: 1.1@side@}"
ENDS = {
    "rigid ends": "elements: {rigid_ends: {columns: 0.3 m, beams: 1}}",
    "rigid ends that turn far": "elements: {rigid_ends: {columns: 0.2 m, beams: 0.4}, geometry: @far@}",
    "joints of beams": "joints: [{beams: {along: @a@, floors: 1}, stiffness: 30 MN*m/rad, resistance: 60 kN*m}]",
    "joints of columns": "joints: [{columns: {storeys: 1}, ends: start, stiffness: 30 MN*m/rad, resistance: 60 kN*m}]",
    "hinges of beams": "hinges: [{beams: {along: @a@, floors: 1}, parameters: @hinge@}]",
    "hinges beside columns": "hinges: [{beams: {along: @a@, floors: 1}, distance: 0.4 m, parameters: @hinge@}]",
    "hinges of columns": "hinges: [{columns: {storeys: 1}, parameters: @plain@},"
    " {columns: {storeys: 2}, distance: 0.2 m, parameters: @plain@}]",
    "panels": "panel_zones: [{floors: all, doubler: 1 mm}]",
    "panels that turn far": "panel_zones: [{floors: all, hardening: 0.02}]\nelements: {geometry: @far@}",
    "panels and hinges": "panel_zones: [{floors: all}]\nhinges: [{beams: {along: @a@, floors: 1}, distance: 0.4 m,"
    " parameters: @hinge@}]",
}
"""Two bays and two storeys; columns with P-Delta, but for those that turn far."""


def written(ends: str, along: str) -> str:
    hinge = HINGE.replace("@M@", "150").replace("@side@", ", hogging: {M_y: 120 kN*m}")
    plain = HINGE.replace("@M@", "200").replace("@side@", "")
    text = ENDS[ends].replace("@a@", along).replace("@hinge@", hinge).replace("@plain@", plain)
    return text.replace("@far@", "{columns: corotational, beams: corotational}") + "\n"


@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("ends", ENDS)
def test_a_row_of_plane_frames(along: str, ends: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Modes, gravity, a push and a history of two equal frames that yield are those of one of them in its plane.

    1e-9 of the largest value: both iterate to 1e-12 of the forces.
    """
    expected, found = both(ends, along, monkeypatch)
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-9)
    largest = agree(expected[1], found[1])
    yielded = [size for name, size in largest.items() if "plastic" in name and ("spring" in name or "panel" in name)]
    assert max(yielded, default=1.0) > 1e-3


@pytest.mark.parametrize("ends", ["hinges of columns", "panels and hinges", "panels that turn far"])
def test_a_row_of_plane_frames_without_rigid_floors(ends: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Periods, gravity and a history as above; floors move by the mean of their nodes, not by the first of them."""
    expected, found = both(ends, "x", monkeypatch, "diaphragms: none\n")
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-9)
    agree(expected[1][::2], found[1][::2], but="floor")


Responses = tuple[np.ndarray, list[Response]]


def both(ends: str, along: str, monkeypatch: pytest.MonkeyPatch, more: str = "") -> tuple[Responses, Responses]:
    """Periods and responses of the frame in its plane, and of the row in space."""
    whole = regular(along, "", written(ends, along) + more)
    project = plane_project(whole, along, monkeypatch)
    elements = project.elements.model_copy(update={"geometry": whole.elements.geometry})
    plane, space = make_frame(project.model_copy(update={"elements": elements})), build_building(whole)
    lines = ("A1", "B1", "C1") if along == "x" else ("A1", "A2", "A3")
    members = ("C_A1_1", "BX_1_1_1" if along == "x" else "BY_A_1_1")
    expected = responses(plane, 0, 1.0, lines, members, 1.0)
    return expected, responses(space, "xy".index(along), 2.0, lines, members, -1.0)


def agree(expected: list[Response], found: list[Response], but: str = " ") -> dict[str, float]:
    """Compare all channels whose names do not begin so; returns their largest values."""
    sizes = {name: max(np.abs(run.values[name]).max() for run in expected) for name in expected[0].values}
    for own, run in zip(found, expected, strict=True):
        assert own.statistics["energy_error"] == pytest.approx(run.statistics["energy_error"], abs=1e-8)
        for name, values in run.values.items():
            if name.startswith(but):
                continue
            scale = max(size for other, size in sizes.items() if other.startswith(name.rstrip("0123456789 ")))
            np.testing.assert_allclose(own.values[name], values, rtol=0.0, atol=1e-9 * max(scale, 1e-6), err_msg=name)
    return sizes


# --- closed forms

EA, EI_Z, EI_Y, GJ, HEIGHT = 3e9, 2e7, 5e7, 4e6, 4.0
UP, ALONG_X = (0.0, 0.0, HEIGHT), (1.0, 0.0, 0.0)


def flexibility_of_a_cantilever() -> np.ndarray:
    """Displacements and turns of its top under unit forces and moments there, whose web stands along x, (6, 6)."""
    L, found = HEIGHT, np.zeros((6, 6))
    found[2, 2], found[5, 5] = L / EA, L / GJ
    for u, r, EI, sign in ((0, 4, EI_Y, 1.0), (1, 3, EI_Z, -1.0)):
        found[u, u], found[r, r] = L**3 / (3 * EI), L / EI
        found[u, r] = found[r, u] = sign * L**2 / (2 * EI)
    return found


def cantilever(offset: tuple[float, ...], geometry: str) -> tuple[Model, int, int]:
    """A column whose top is held by an arm from a node beside it; its model, the node, and a pattern of loads."""
    model = Model(3)
    foot, node = model.node("foot", 0.0, 0.0, 0.0), model.node("node", *(np.array(UP) - offset).tolist())
    model.fix(foot, True, True, True, uz=True, rx=True, ry=True)
    column = model.beam_column(
        "column", foot, node, model.elastic_section(EA, EI_Z, EI_Y, GJ), 5, geometry, (False,) * 4, web=web(offset)
    )
    model.offset_ends(column, (0.0, 0.0, 0.0), offset)
    return model, node, model.pattern()


def web(offset: tuple[float, ...]) -> tuple[float, float, float]:
    """At right angles to the line from the foot to the node, so that the column has its web along x."""
    line = np.array(UP) - offset
    x = np.array(ALONG_X) - line[0] / (line @ line) * line
    return tuple((x / np.linalg.norm(x)).tolist())


@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
def test_a_cantilever_under_loads_beside_it(geometry: str) -> None:
    """Its stiffness moved by u_top = u + t x r; the web is turned by 7 degrees, which its axes do not notice.

    Loads are so small that their squares are below 1e-9 of the displacements.
    """
    offset = (0.4, 0.0, -0.3)
    model, node, pattern = cantilever(offset, geometry)
    rng = np.random.default_rng(3)
    load = rng.uniform(-1e-2, 1e-2, 6)
    model.nodal_load(pattern, node, *load[[0, 1]], load[5], fz=load[2], mx=load[3], my=load[4])
    channels = [Channel(d, ((1.0, "displacement", node, i),)) for i, d in enumerate(model.degrees)]
    analysis = Analysis(model, **SHARP)
    final = completed(analysis.static(pattern, channels=channels)).final
    move = np.eye(6)
    move[:3, 3:] = [[0.0, offset[2], -offset[1]], [-offset[2], 0.0, offset[0]], [offset[1], -offset[0], 0.0]]
    expected = np.linalg.inv(move) @ flexibility_of_a_cantilever() @ np.linalg.inv(move).T @ load
    found = np.array([final[degree] for degree in model.degrees])
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-8 * np.abs(expected).max())


def test_arms_take_the_second_order_of_a_weight() -> None:
    """P-Delta of a weight on a rigid column of length L with a spring k at its foot, which falls at N = k / L.

    Nine tenths of the column are an arm.
    """
    stiffness, length = 1e6, 5.0
    periods = []
    for share in (0.0, 0.5):
        model = Model(3)
        foot, above, top = (model.node(name, 0.0, 0.0, z) for name, z in (("f", 0.0), ("a", 0.0), ("t", length)))
        model.fix(foot, True, True, True, uz=True, rx=True, ry=True)
        model.tie(above, foot, ux=True, uy=True, rz=True, uz=True, rx=True)
        turn = (0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0)
        model.spring("spring", foot, above, turn, MultilinearSpring(stiffness))
        stiff = model.elastic_section(1e13, 1e13, 1e13, 1e13)
        column = model.beam_column("column", above, top, stiff, 2, "p_delta", (False,) * 4, web=ALONG_X)
        model.offset_ends(column, (0.0, 0.0, 0.9 * length), (0.0, 0.0, 0.0))
        model.mass(top, 1e3)
        weight = model.pattern()
        model.nodal_load(weight, top, fz=-share * stiffness / length)
        analysis = Analysis(model, **SHARP)
        completed(analysis.static(weight))
        modes = analysis.modes(1)
        periods.append(float(modes.period[modes.effective_mass_ratio[:, 0] > 0.5][0]))
    # k / L^2 - N / L is left of k / L^2
    assert (periods[0] / periods[1]) ** 2 == pytest.approx(0.5, rel=1e-5)


@pytest.mark.parametrize("axis", ["x", "y", "z"])
def test_springs_about_any_axis(axis: str) -> None:
    """Of a cantilever whose foot turns on a deteriorating spring about an axis: a cycle follows the spring alone."""
    at = "xyz".index(axis)
    model = Model(3)
    foot, top = model.node("foot", 0.0, 0.0, 0.0), model.node("top", 0.0, 0.0, 0.0)
    model.fix(foot, True, True, True, uz=True, rx=True, ry=True)
    free = {degree: i != 3 + at for i, degree in enumerate(model.degrees)}
    model.fix(top, **{degree: held for degree, held in free.items()})
    terms = [0.0] * 12
    terms[3 + at], terms[9 + at] = -1.0, 1.0
    side = DeterioratingSide(0.02, 0.1, 0.2, 1e5, 1.1, 0.4, 1.0)
    model.spring("spring", foot, top, terms, DeterioratingSpring(1e7, side, side, 1e5, 1e5, 1e5, (1.0,) * 3))
    pattern = model.pattern()
    model.nodal_load(pattern, top, **{f"m{axis}": 1.0})
    analysis = Analysis(model, **SHARP)
    channels = [Channel("M", ((1.0, "axial_force", 0, 0),)), Channel("t", ((1.0, "displacement", top, 3 + at),))]
    run = completed(analysis.pushover(pattern, top, model.degrees[3 + at], 0.028, 28, channels))
    rotation, moment = run.values["t"], run.values["M"]
    yielded, capped = 1e5 / 1e7, 1e5 / 1e7 + 0.02
    expected = np.where(
        rotation <= yielded, 1e7 * rotation, 1e5 * (1 + 0.1 * (rotation - yielded) / (capped - yielded))
    )
    np.testing.assert_allclose(moment, expected, rtol=1e-9)


def test_a_portal_with_semi_rigid_ends() -> None:
    """Sway of a portal with pinned feet: h^3 / 6EI_c + h^2 L / 12EI_b + h^2 / 2k, by the work of half of it."""
    EI, k, h, L = 5e7, 2e7, 4.0, 6.0
    model = Model(3)
    section = model.elastic_section(1e14, 1e12, EI, 1e12)
    feet = [model.node(f"foot {i}", L * i, 0.0, 0.0) for i in (0, 1)]
    tops = [model.node(f"top {i}", L * i, 0.0, h) for i in (0, 1)]
    for foot in feet:
        model.fix(foot, True, True, True, uz=True, rx=True)
    places = {node: model.node_places[node] for node in (*feet, *tops)}
    builder, none = MemberBuilder(model, dict(places)), (MemberEnd(), MemberEnd())
    for i in (0, 1):
        builder.add("column", (feet[i], tops[i]), section, EI, 5, "linear", (False,) * 4, none, web=ALONG_X)
    soft = MemberEnd(joint=Joints.model_construct(stiffness=k, resistance=None, hardening=0.0))
    builder.add("beam", (tops[0], tops[1]), section, EI, 5, "linear", (False,) * 4, (soft, soft), web=(0.0, 0.0, 1.0))
    pattern = model.pattern()
    for top in tops:
        model.nodal_load(pattern, top, 1e3)
    final = completed(Analysis(model, **SHARP).static(pattern, channels=[_moved(tops[0])])).final
    # each column carries 1 kN; its moment at the top h turns half of the beam and one joint
    expected = 1e3 * (h**3 / (3 * EI) + h**2 * L / (6 * EI) + h**2 / k)
    assert final["u"] == pytest.approx(expected, rel=1e-6)  # columns and beams shorten by 1e-7 of it


def _moved(node: int) -> Channel:
    return Channel("u", ((1.0, "displacement", node, 0),))


# --- energy


@pytest.mark.parametrize("geometry", ["linear", "p_delta", "corotational"])
def test_energy_of_eccentric_members(geometry: str) -> None:
    """A tower of four columns beside their nodes, under gravity and two components; below 1e-4 of the input.

    What is left goes with the square of the time step.
    """
    model = Model(3)
    section, offset = model.elastic_section(2e9, 8e6, 3e7, 4e6), 0.35
    beams = model.elastic_section(2e9, 4e6, 2e7, 1e6)
    gravity, corners = model.pattern(), [(0.0, 0.0), (5.0, 0.0), (5.0, 4.0), (0.0, 4.0)]
    tops = []
    for i, (x, y) in enumerate(corners):
        foot, top = model.node(f"f{i}", x, y, 0.0), model.node(f"t{i}", x, y, 4.0)
        model.fix(foot, True, True, True, uz=True, rx=True, ry=True)
        column = model.beam_column(f"c{i}", foot, top, section, 5, geometry, (False,) * 4, web=ALONG_X)
        model.offset_ends(column, (offset, 0.0, 0.2), (offset, -0.1 * i, -0.3))
        model.uniform_load(gravity, column, 0.0, 500.0, -300.0)
        model.mass(top, 2e4, 2e4)
        model.nodal_load(gravity, top, fz=-2e5)
        tops.append(top)
    for i in range(4):
        pair = tops[i], tops[(i + 1) % 4]
        beam = model.beam_column(f"b{i}", *pair, beams, 5, "linear", (False,) * 4, web=(0.0, 0.0, 1.0))
        model.offset_ends(beam, (0.0, 0.0, -0.2), (0.0, 0.0, -0.2))
        model.uniform_load(gravity, beam, 0.0, 0.0, -1e4)
    analysis = Analysis(model, **SHARP)
    completed(analysis.static(gravity))
    analysis.rayleigh(0.3, 0.002, "initial")
    times = np.arange(0.0, 219.0, 0.5)
    first, second = (np.interp(times, np.arange(220), motion(seed)) for seed in (1, 2))
    run = completed(analysis.history(first, 0.005, along_y=second))
    assert run.statistics["energy_error"] < 1e-4
    assert run.energy_final["input"] > 1.0
