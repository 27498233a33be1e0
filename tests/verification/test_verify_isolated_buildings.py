"""Isolated buildings: bearings that act in two directions at once, under buildings and by themselves.

References: isolated plane frames by their own model; symmetry; the motion of a circle in closed form; statics.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from scipy.integrate import solve_ivp
from verification.test_verify_building_model import SHARP, STEP, completed, motion, plane_project, regular, watched

from edesign.core import Analysis, Channel, CoreDamper, LawValues, Model, Newmark, Response
from edesign.core.analysis import SupportMotion
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import parse_project
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame
from edesign.study.analysis.structure import make_frame

LAWS = """\
  laws:
    lead: {type: lead_rubber, parameters: {Q: 12 kN, K_d: 300 kN/m, Y: 6 mm}}
    dish: {type: friction_pendulum, parameters: {W: 1 MN, R: 1.8 m, f_slow: 2 %, f_fast: 6 %, a: 30 s/m, Y: 0.5 mm}}
    pad: {type: kelvin_voigt, parameters: {k: 400 kN/m, c: 60 kN*s/m}}
    rubber: {type: bouc_wen, parameters: {Fy: 15 kN, Y: 8 mm, alpha: 0.15, beta: 0.3, gamma: 0.7, n: 1.4}}
"""
VERTICAL = "vertical: {stiffness: 500 kN/mm, uplift: true}"


def isolation(isolators: str, base: str, beside: str = "") -> str:
    return (
        f"dampers:\n{LAWS}  isolation:\n    isolators: [{isolators}]\n    beside: [{beside}]\n"
        f"    base: {{{base}}}\n    design_displacement: 100 mm\n"
    )


OIL = "{at: A1, direction: y, law: pad, scale: 0.5}"


# --- plane frames

ROWS = {
    "lead": ("law: lead", "rotation: fixed"),
    "lead under beams": ("law: lead, number: 2", "beams: {section: HEB240, material: S275}"),
    "dish": ("law: dish", "rotation: fixed"),
    "dish under the weight of the moment": ("law: dish, weight: varying", "beams: {section: HEB240, material: S275}"),
    "pad": ("law: pad", "rotation: 40 MN*m/rad"),
    "rubber": ("law: rubber", "rotation: fixed"),
}


@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("case", ROWS)
def test_a_row_of_isolated_plane_frames(along: str, case: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Modes, gravity and a history of two equal frames on isolators that yield or slide are those of one in its plane.

    1e-9 of the largest value: both iterate to 1e-12 of the forces.
    """
    bare, direction = regular(along, ""), "xy".index(along)
    isolator, base = ROWS[case]
    text = isolation(f"{{{isolator}, {VERTICAL}}}", f"{base}, G: 4 kN/m^2, mass: 30 t")
    space = make_frame(building(bare.text + text), dampers=True)
    plane_project(bare, along, monkeypatch)
    of_plane = project_text(frame_row(bare, space_frame(bare), "X1" if along == "x" else "YA"))
    text = isolation(f"{{{isolator}, {VERTICAL}}}", f"{base}, G: 14 kN/m, mass: 15 t")
    of_plane = f"{of_plane.partition('analyses:')[0]}{text}analyses: [{{name: gravity, kind: gravity}}]\n"
    plane = make_frame(parse_project(of_plane, "frame.yaml", BuildingSections()), dampers=True)
    lines = ("A1", "B1", "C1") if along == "x" else ("A1", "A2", "A3")
    expected, found = shaken(plane, 0, 1.0, lines), shaken(space, direction, 2.0, lines)
    sizes = {name: np.abs(values).max() for name, values in expected.values.items()}
    for name, values in expected.values.items():
        scale = max(size for other, size in sizes.items() if other.startswith(name.rstrip("0123456789 ")))
        np.testing.assert_allclose(found.values[name], values, rtol=0.0, atol=1e-9 * scale, err_msg=name)
    assert sizes["stroke 0"] > 0.03 and sizes["force 0"] > 10e3
    energy = [run.statistics["energy_error"] for run in (expected, found)]
    assert energy[0] < 2e-4 and energy[1] == pytest.approx(energy[0], rel=1e-6)  # columns yield and pads lift off


def shaken(frame: FrameModel, direction: int, count: float, lines: tuple[str, ...]) -> Response:
    """A history under gravity, with the isolators of a plane frame.

    Args:
        count: plane frames that it is.
        lines: its column lines.
    """
    assert frame.isolated is not None
    channels = watched(frame, direction, count, lines)
    for i, line in enumerate(lines):
        base = frame.grid.node_name(line, 0)
        (number,) = frame.isolated.at(base, direction)
        channels.append(Channel(f"force {i}", ((1.0, "damper_force", number, 0),)))
        channels.append(Channel(f"stroke {i}", ((1.0, "damper_deformation", number, 1),)))
        channels.append(Channel(f"axial {i}", frame.reaction(base, frame.up)))
    analysis = Analysis(frame.model, **SHARP)
    completed(analysis.static(frame.gravity, 1.0, 5))
    analysis.install_dampers()
    analysis.rayleigh(0.1, 0.002, "initial")
    ground = motion(1, 1.5)
    x, y = (ground, None) if direction == 0 else (np.zeros_like(ground), ground)
    return completed(analysis.history(x, STEP, channels=channels, along_y=y))


# --- all directions

SQUARE = """\
edesign_building: 1
title: A square
plan: {x: [6 m], y: [6 m]}
storeys: [4 m, 3.5 m]
columns: [{section: SHS300x12, material: S275, strong: x}]
beams: [{along: x, section: IPE300, material: S275}, {along: y, section: IPE300, material: S275}]
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {nodes: [{at: all, floors: all, G: 150 kN}], self_weight: false}
masses: {from_loads: {}}
elements: {geometry: {columns: linear, beams: linear}}
"""
"""P-Delta with axial forces of overturning would turn it a little, 1e-6 of its displacement."""


def turned(samples: np.ndarray, angle: float) -> np.ndarray:
    """Pairs (2, nt), turned from x towards y."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]]) @ samples


def square(isolator: str) -> FrameModel:
    text = isolation(f"{{{isolator}, vertical: 500 kN/mm}}", "G: 5 kN/m^2, beams: {section: SHS300x12, material: S275}")
    return make_frame(building(SQUARE + text), dampers=True)


def under_pair(frame: FrameModel, pair: np.ndarray, more: list[Channel]) -> Response:
    analysis = Analysis(frame.model, **SHARP)
    completed(analysis.static(frame.gravity, 1.0, 5))
    analysis.install_dampers()
    analysis.rayleigh(0.1, 0.002, "initial")
    return completed(analysis.history(pair[0], STEP, channels=more, along_y=pair[1]))


def both(frame: FrameModel) -> list[Channel]:
    """Base, roof, an isolator's displacement and force along x and y, and turns of base and roof."""
    assert frame.isolated is not None
    places = {"base": frame.nodes["floor.0"], "roof": frame.nodes["floor.2"], "foot": frame.nodes["B2.0"]}
    found = [
        Channel(f"{name} {axis}", ((1.0, "displacement", node, at),))
        for name, node in places.items()
        for at, axis in enumerate("xy")
    ]
    numbers = [*frame.isolated.at("B2.0", 0), *frame.isolated.at("B2.0", 1)]
    found += [Channel(f"force {axis}", ((1.0, "damper_force", n, 0),)) for n, axis in zip(numbers, "xy", strict=True)]
    return [*found, *(Channel(f"turn {name}", ((1.0, "displacement", places[name], 5),)) for name in ("base", "roof"))]


@pytest.mark.parametrize("isolator", ["law: lead", "law: dish", "law: pad", "law: rubber"])
@pytest.mark.parametrize("degrees", [30.0, 90.0, 217.0])
def test_a_turned_pair_turns_the_response(isolator: str, degrees: float) -> None:
    """Of a building that is alike in all directions, 1e-9: equilibrium to 1e-12 of the forces."""
    pair, angle = np.array([motion(1, 1.2), motion(2, 0.9)]), np.radians(degrees)
    frame = square(isolator)
    plain = under_pair(frame, pair, both(frame))
    other = under_pair(square(isolator), turned(pair, angle), both(frame))
    for name in ("base", "roof", "foot", "force"):
        expected = turned(np.array([plain.values[f"{name} {axis}"] for axis in "xy"]), angle)
        found = np.array([other.values[f"{name} {axis}"] for axis in "xy"])
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max(), err_msg=name)
    assert np.abs(plain.values["turn roof"]).max() < 1e-12
    assert np.hypot(plain.values["base x"], plain.values["base y"]).max() > 0.05
    assert plain.statistics["energy_error"] < 1e-6


UNEQUAL = """\
{at: [A1, A2], law: lead}, {at: B1, law: dish, weight: varying, vertical: 500 kN/mm}, {at: B2, law: pad}"""


def test_inertia_balances_the_isolators() -> None:
    """Unequal isolators, masses beside their places, no damping: forces along x and y and their moment, at every step.

    Axial forces carry the weight and the overturning moment. 1e-9 of the largest: equilibrium to 1e-12 of the forces.
    """
    pair = np.array([motion(1, 1.2), motion(2, 0.9)])
    text = SQUARE + isolation(UNEQUAL, "G: 5 kN/m^2, beams: {section: SHS300x12, material: S275}", OIL)
    frame = make_frame(building(text), dampers=True, eccentricity=(0.05, -0.05))
    isolated = frame.isolated
    assert isolated is not None
    masters = {name: (*frame.places[name], frame.nodes[name]) for name in ("floor.0", "floor.1", "floor.2")}
    channels = [
        Channel(f"{name} {at}", ((1.0, "total_acceleration", node, degree),))
        for name, (*_, node) in masters.items()
        for at, degree in enumerate((0, 1, 5))
    ]
    channels += [Channel(device.name, ((1.0, "damper_force", device.number, 0),)) for device in isolated.devices]
    bases = [f"{line}.0" for line in ("A1", "A2", "B1", "B2")]
    channels += [Channel(base, frame.reaction(base, frame.up)) for base in bases]
    analysis = Analysis(frame.model, **SHARP)
    completed(analysis.static(frame.gravity, 1.0, 5))
    analysis.install_dampers()
    values = completed(analysis.history(pair[0], STEP, channels=channels, along_y=pair[1])).values
    force = {name: frame.masses[name] * np.array([values[f"{name} {at}"] for at in (0, 1)]) for name in masters}
    sums = sum(force.values())
    moment = sum(
        x * force[name][1] - y * force[name][0] + frame.turning[name] * values[f"{name} 2"]
        for name, (x, y, _, _) in masters.items()
    )
    scale = max(np.abs(part).max() for part in force.values())
    for device in isolated.devices:
        assert device.direction is not None
        x, y, _ = frame.places[device.column_base]
        sums[device.direction] += values[device.name]
        moment = moment + (x if device.direction else -y) * values[device.name]
    np.testing.assert_allclose(sums, 0.0, atol=1e-9 * scale)
    np.testing.assert_allclose(moment, 0.0, atol=1e-9 * scale * 6.0)
    weight = 8 * 150e3 + 5e3 * 36.0
    np.testing.assert_allclose(sum(values[base] for base in bases), weight, rtol=1e-9)
    overturning = sum(z * force[name][0] for name, (_, _, z, _) in masters.items())
    by_axial = sum(frame.places[base][0] * values[base] for base in bases) - 3.0 * weight
    np.testing.assert_allclose(-by_axial, overturning, atol=1e-9 * weight)
    assert np.abs(values["floor.0 2"]).max() * frame.turning["floor.0"] > 1e-2 * scale  # it turns


# --- a bearing by itself


def moved_bearing(law: LawValues, u: np.ndarray, v: np.ndarray, a: np.ndarray, dt: float) -> np.ndarray:
    """Forces of a bearing whose foot is moved along a path, (2, nt) N.

    Args:
        u, v, a: displacement, velocity and acceleration along x and y, (2, nt).
    """
    model = Model(dimension=3)
    foot, top = model.node("foot", 0.0, 0.0, 0.0), model.node("top", 0.0, 0.0, 1.0)
    model.fix(foot, **dict.fromkeys(model.degrees, True))
    model.fix(top, uz=True, rx=True, ry=True, rz=True)
    model.mass(top, 1e9, 1e9)  # stands still: a thousandth of the forces moves it by nothing that counts
    numbers = model.damper("x", law, ((1.0, foot, 0),), carries=True, across=("y", ((1.0, foot, 1),)))
    stand = LawValues("kelvin_voigt", (1e3, 0.0))
    for degree in (0, 1):
        model.damper(f"stand {degree}", stand, ((1.0, top, degree),), carries=True)
    channels = [Channel(axis, ((1.0, "damper_force", numbers + at, 0),)) for at, axis in enumerate("xy")]
    still = np.zeros(u.shape[1])
    moving = [SupportMotion(foot, degree, (u[at], v[at], a[at])) for at, degree in enumerate(("ux", "uy"))]
    response = completed(Analysis(model).history(still, dt, channels=channels, method=Newmark(), supports=moving))
    return np.array([response.values[axis] for axis in "xy"])


def test_circle_of_a_friction_pendulum() -> None:
    """N/R times the displacement, and the friction of the speed against the motion, on a circle at constant speed.

    The friction lags behind the velocity by asin(limit / (k r)), k the stiffness before it slips, 0.4 degrees here, and
    by half of the last chord of a step, a 32nd of the angle of a step. The start, which is gradual, is left out.
    """
    N, R, slow, fast, rate, Y = 1e6, 2.0, 0.02, 0.06, 20.0, 0.5e-3
    law = LawValues("friction_pendulum", (N, R, slow, fast, rate, Y))
    r, omega, dt, steps = 0.15, 2.0, 0.005, 1600
    t = np.arange(steps) * dt
    s = np.clip(t / 2.0, 0.0, 1.0)
    grow, grown, growth = (
        s**3 * (10 - 15 * s + 6 * s**2),
        30 * s**2 * (1 - s) ** 2 / 2,
        60 * s * (1 - s) * (1 - 2 * s) / 4,
    )
    e = np.array([np.cos(omega * t), np.sin(omega * t)])
    n = np.array([-e[1], e[0]])
    u = r * grow * e
    v = r * (grown * e + grow * omega * n)
    a = r * (growth * e + 2.0 * grown * omega * n - grow * omega**2 * e)
    found = moved_bearing(law, u, v, a, dt) - N / R * u
    late = t > 3.0
    mu = fast - (fast - slow) * np.exp(-rate * r * omega)
    k = slow * N / Y
    np.testing.assert_allclose(np.hypot(*found[:, late]), mu * N, rtol=1e-9)
    along, inward = np.sum(found * n, axis=0)[late], -np.sum(found * e, axis=0)[late]
    np.testing.assert_allclose(np.arctan2(-inward, along), np.arcsin(mu * N / (k * r)), atol=omega * dt / 30.0)


@pytest.mark.parametrize("n", [1.0, 1.5, 2.0, 6.0])
def test_bouc_wen_on_an_ellipse(n: float) -> None:
    """Its equation in two directions, integrated by SciPy, and the work of the force: z goes through no zero.

    1e-7 of the force: the sharpest bend needs as much of SciPy. The path between the samples is a cubic, 2e-8 from the
    ellipse. Work by the trapezoidal rule at steps of 5 ms: 1e-4.
    """
    Fy, Y, alpha, A, beta, gamma = 90e3, 8e-3, 0.1, 1.0, 0.3, 0.7
    dt, t = 0.005, np.arange(1200) * 0.005
    phases = np.array([[0.0], [1.1]])
    sizes, rates = np.array([[0.06], [0.04]]), np.array([[2.0], [3.1]])

    def moved(at: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        s = np.clip(at / 2.0, 0.0, 1.0)
        grow, grown = s**3 * (10 - 15 * s + 6 * s**2), 15 * s**2 * (1 - s) ** 2
        growth = 15 * s * (1 - s) * (1 - 2 * s)
        sine, cosine = np.sin(rates * at + phases), np.cos(rates * at + phases)
        u, v = sizes * grow * sine, sizes * (grown * sine + grow * rates * cosine)
        return u, v, sizes * (growth * sine + 2.0 * grown * rates * cosine - grow * rates**2 * sine)

    def rate(at: float, z: np.ndarray) -> np.ndarray:
        v, r = moved(np.array([at]))[1][:, 0], float(np.hypot(*z))
        work = float(z @ v)
        lost = r ** (n - 2.0) * (gamma * abs(work) + beta * work) if r > 0.0 else 0.0
        return np.asarray((A * v - lost * z) / Y)

    u, v, a = moved(t)
    found = moved_bearing(LawValues("bouc_wen", (Fy, Y, alpha, A, beta, gamma, n)), u, v, a, dt)
    z = solve_ivp(rate, (0.0, t[-1]), [0.0, 0.0], "DOP853", t, rtol=1e-10, atol=1e-12, max_step=0.01).y
    expected = alpha * Fy / Y * u + (1.0 - alpha) * Fy * z
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-7 * np.abs(expected).max())
    assert np.hypot(*(found - alpha * Fy / Y * u)).max() <= (1.0 - alpha) * Fy * (1.0 + 1e-12)  # within its circle
    loss = np.sum(np.sum(0.5 * (found[:, 1:] + found[:, :-1]) * np.diff(u), axis=0))
    assert loss == pytest.approx(np.trapezoid(np.sum(expected * v, axis=0), t), rel=1e-4) and loss > 0.0


@pytest.mark.parametrize("degrees", [0.0, 30.0, 90.0])
@pytest.mark.parametrize(
    "law",
    [
        LawValues("lead_rubber", (80e3, 1e6, 8e-3)),
        LawValues("elastic_plastic", (2e7, 120e3, 0.08)),
        LawValues("friction", (0.05, 1e6, 4e7)),
        LawValues("friction_pendulum", (1e6, 2.0, 0.02, 0.06, 20.0, 0.5e-3)),
        LawValues("bouc_wen", (90e3, 6e-3, 0.1, 1.0, 0.3, 0.7, 1.6)),
    ],
    ids=lambda law: law.law,
)
def test_one_direction_is_the_law_of_the_plane(law: LawValues, degrees: float) -> None:
    """1e-9 of the largest force, along the motion, and nothing across."""
    t = np.arange(1200) * 0.005
    size = 0.1 * (np.sin(2.1 * t) ** 3 + 0.6 * np.sin(7.3 * t) ** 3)
    speed = 0.3 * (np.sin(2.1 * t) ** 2 * np.cos(2.1 * t) * 2.1 + 0.6 * np.sin(7.3 * t) ** 2 * np.cos(7.3 * t) * 7.3)
    rate = np.gradient(speed, t)
    e = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])[:, None]
    found = moved_bearing(law, size * e, speed * e, rate * e, 0.005)
    expected = CoreDamper(law.law, law.values).force(t, size, speed)
    np.testing.assert_allclose(found, expected * e, rtol=0.0, atol=1e-9 * np.abs(expected).max())
