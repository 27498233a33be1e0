"""Dampers and tuned masses in models of buildings.

References: plane frames with their dampers by the core of plane frames; equations of motion of one storey written here;
complex modes by numpy from flexibilities of the elastic space frame, which shares no source with the model; the laws by
themselves on the deformations of a history.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL, building, changed
from damper_examples import EXAMPLES
from verification.test_verify_building_model import (
    SHARP,
    STEP,
    completed,
    motion,
    plane_frame,
    regular,
    rigid_in_shear,
    straight,
    under_gravity,
    watched,
    with_law,
)

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.core import Analysis, Channel, LawValues, Newmark, Response
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.frame.building_file import load_building
from edesign.frame.devices import DeviceLaw
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.steel_section import steel_section
from edesign.project import parse_project
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.building import Building
from edesign.space.extract import frame_row, project_text
from edesign.space.nonlinear import build_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model
from edesign.study.analysis.damper_stiffness import damped_modes, store_damper_stiffness
from edesign.study.analysis.structure import make_frame, make_structure
from edesign.study.results.couples import couple_terms
from edesign.study.results.dampers import storey_damper_forces
from edesign.study.results.warnings import warnings_of
from edesign.study.run.run import run_project

__all__ = ["rigid_in_shear"]  # a fixture


# --- plane frames with dampers

LAW = "  laws: {pad: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 300 kN*s/m}}}\n"
KINDS = {
    "chevron": "kind: chevron, @where@bays: 1, storeys: all, law: pad, scale: [2, 1], brace: {stiffness: 90 kN/mm}",
    "chevron_braces": "kind: chevron_braces, @where@bays: 2, storeys: all, law: pad, number: 2",
    "rising": "kind: rising, @where@bays: 1, storeys: 2, law: pad, brace: {section: SHS100x5, material: S275}",
    "falling": "kind: falling, @where@bays: all, storeys: 1, law: pad, brace: {section: SHS100x5, material: S275}",
    "storey": "kind: storey, @where@bays: 2, storeys: all, law: pad, brace: {stiffness: 90 kN/mm}",
}
MASS = "{kind: tuned_mass, floor: 2, mass: @m@ t, frequency: 1.2 Hz, damping: 10 %@more@}"


def dampers(kind: str, where: str, mass: float, more: str) -> str:
    tuned = MASS.replace("@m@", str(mass)).replace("@more@", more)
    run = KINDS[kind].replace("@where@", where)
    return f"dampers:\n{LAW}  devices: [{{{run}}}]\n  attachments: [{tuned}]\n"


@pytest.mark.parametrize("along", ["x", "y"])
@pytest.mark.parametrize("kind", KINDS)
def test_a_row_of_plane_frames_with_dampers(along: str, kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """A history of two equal frames that yield is that of one in its plane, with its dampers and half the tuned mass.

    Floors, drifts, shears and base, forces and deformations of the dampers, their couples and forces by storey. 1e-9 of
    the largest value: both iterate to 1e-12 of the forces.
    """
    bare, direction = regular(along, ""), "xy".index(along)
    text = bare.text + dampers(kind, f"along: {along}, frames: all, ", 3.0, f", direction: {along}")
    space = make_frame(building(text), dampers=True)
    plane = plane_with_dampers(bare, along, dampers(kind, "", 1.5, ""), monkeypatch)
    names = [device.name for device in plane.devices]
    lines = ("A1", "B1", "C1") if along == "x" else ("A1", "A2", "A3")
    expected = shaken(plane, 0, 1.0, lines, names)
    found = shaken(space, direction, 2.0, lines, names)
    sizes = {name: np.abs(values).max() for name, values in expected.values.items()}
    for name, values in expected.values.items():
        scale = max(size for other, size in sizes.items() if other.startswith(name.rstrip("0123456789 ")))
        np.testing.assert_allclose(found.values[name], values, rtol=0.0, atol=1e-9 * scale, err_msg=name)
    assert max(sizes["of storey 1"], sizes["of storey 2"]) > 10e3 and sizes["stroke 0"] > 1e-3
    assert (sizes["couple 0"] > 0.0) == (kind == "storey")


def plane_with_dampers(bare: Building, along: str, block: str, monkeypatch: pytest.MonkeyPatch) -> FrameModel:
    """A frame of the building as a project with dampers; its layers are the fibres of the sections in space."""
    plane_frame(bare, along, monkeypatch)
    text = project_text(frame_row(bare, space_frame(bare), "X1" if along == "x" else "YA"))
    return make_frame(parse_project(f"{text}\n{block}", "frame.yaml", BuildingSections()), dampers=True)


def shaken(frame: FrameModel, direction: int, count: float, lines: tuple[str, ...], names: list[str]) -> Response:
    """A history under gravity in a direction.

    Args:
        count: plane frames that it is.
        lines: its column lines.
        names: of its dampers in one of them.
    """
    channels = watched(frame, direction, count, lines)
    by_name = {device.name: device for device in frame.devices}
    assert len(by_name) == count * len(names)
    for i, name in enumerate(names):
        number = by_name[name].number
        channels.append(Channel(f"force {i}", ((1.0, "damper_force", number, 0),)))
        channels += [Channel(f"deformation {i} {k}", ((1.0, "damper_deformation", number, k),)) for k in (0, 1)]
    sums = {"couple 0": couple_terms(frame, direction)}
    of_storeys = storey_damper_forces(frame, history=True).cells[direction :: len(frame.directions)]
    sums |= {f"of storey {storey}": terms for storey, terms in enumerate(of_storeys, start=1)}
    for name, terms in sums.items():
        nothing = ((0.0, "displacement", 0, 0),)
        channels.append(Channel(name, tuple((c / count, kind, item, at) for c, kind, item, at in terms) or nothing))
    (stroke,) = frame.attached.values()
    channels.append(Channel("stroke 0", tuple((c, "displacement", node, at) for c, node, at in stroke)))
    analysis, _ = under_gravity(frame)
    analysis.install_dampers()
    analysis.rayleigh(0.3, 0.002, "initial")
    ground = motion(1, 1.5)
    x, y = (ground, None) if direction == 0 else (np.zeros_like(ground), ground)
    return completed(analysis.history(x, STEP, channels=channels, along_y=y))


# --- the laws


@pytest.mark.parametrize("law", LAWS)
def test_each_law_in_a_building(law: str) -> None:
    """The force of a diagonal is that of the law alone on its deformation and speed, times its scale.

    1e-6: laws that SUNDIALS integrates keep its tolerance; the others are the same steps.
    """
    damper = Damper(LAWS[law], EXAMPLES[law])
    text = regular("x", "").text + (
        "dampers:\n  laws: {it: {type: viscous, parameters: {c: 1 kN*s/m}}}\n"
        "  devices: [{kind: rising, along: x, frames: 2, bays: 1, storeys: 1, law: it, scale: 0.5}]\n"
    )
    frame = build_building(building(text), laws={"it": DeviceLaw(LawValues(law, tuple(damper.values.values())))})
    (device,) = frame.devices
    length = np.hypot(6.0, 4.0)
    scale = EXAMPLES[law]["L_wp"] / length if law == "buckling_restrained" else 1.0
    assert (device.force_scale, device.deformation_scale) == (0.5, pytest.approx(scale, rel=1e-15))
    speed = tuple((c, "velocity", node, degree) for c, node, degree in device.terms)
    channels = [Channel("v", speed), *(Channel(f"u{k}", ((1.0, "damper_deformation", 0, k),)) for k in (0, 1))]
    channels.append(Channel("force", ((1.0, "damper_force", 0, 0),)))
    analysis, _ = under_gravity(frame)
    analysis.install_dampers()
    analysis.rayleigh(0.3, 0.002, "initial")
    run = completed(analysis.history(motion(1, 0.2), STEP, channels=channels, along_y=motion(2, 0.2)))
    np.testing.assert_array_equal(run.values["u0"], run.values["u1"])
    alone = damper.core.force(run.time, scale * run.values["u0"], scale * run.values["v"])
    np.testing.assert_allclose(run.values["force"], 0.5 * alone, rtol=0.0, atol=1e-6 * np.abs(alone).max())
    assert 5e-3 < np.abs(run.values["u0"]).max() < 0.1


# --- one storey: equations by hand

FLOOR = """\
edesign_building: 1
title: A floor on four columns, held by nothing else
plan: {x: [6 m], y: [5 m]}
storeys: [4 m]
columns:
  - {section: HEB200, material: S275, strong: x}
  - {at: B2, section: HEB240, material: S275, strong: y}
beams:
  - {along: x, section: IPE300, material: S275}
  - {along: y, section: IPE300, material: S275}
missing: {beams: [{along: x}, {along: y}]}
materials: {S275: {fy: 275 MPa, law: elastic}}
elements: {geometry: {columns: linear}}
loads:
  nodes: [{at: [A1, A2, B2], floors: 1, G: 100 kN}, {at: B1, floors: 1, G: 250 kN}]
  self_weight: false
masses: {from_loads: {}}
dampers:
  laws: {oil: {type: viscous, parameters: {c: 60 kN*s/m}}}
  devices:
    - {kind: storey, along: x, frames: 1, bays: 1, storeys: 1, law: oil, scale: 1.5}
    - {kind: storey, along: y, frames: B, bays: 1, storeys: 1, law: oil}
"""
TUNED = {
    "nothing": [],
    "at a corner": [("x", "B2")],
    "both ways": [("x", "A1"), ("y", "B1"), ("y", "")],
}
"""Direction and column line of tuned masses of 3 t, 0.9 Hz and 12 %."""


def by_hand(tuned: list[tuple[str, str]], aside: tuple[float, float]) -> tuple[np.ndarray, ...]:
    """Mass, damping and stiffness over u_x, u_y and the turn about the centre of the floor's own mass and the tuned
    masses, the directions of ground motion, and what the displacements of corner A2 are of all these.

    Args:
        aside: by how much the floor's masses stand beside their places, m.
    """
    g, corners = 9.80665, {"A1": (0.0, 0.0), "A2": (0.0, 5.0), "B1": (6.0, 0.0), "B2": (6.0, 5.0)}
    weights = {"A1": 100e3, "A2": 100e3, "B1": 250e3, "B2": 100e3}
    centre = np.average(list(corners.values()), axis=0, weights=list(weights.values()))
    size = 3 + len(tuned)

    def moved(place: tuple[float, float], axis: int) -> np.ndarray:
        row = np.zeros(size)
        row[axis], row[2] = 1.0, -(place[1] - centre[1]) if axis == 0 else place[0] - centre[0]
        return row

    M, C, K = (np.zeros((size, size)) for _ in range(3))
    for line, place in corners.items():
        of, along = (steel_section("HEB240"), 1) if line == "B2" else (steel_section("HEB200"), 0)
        K[2, 2] += 210e9 / 2.6 * of.I_t / 4.0
        for axis in (0, 1):
            row, beside = moved(place, axis), moved((place[0] + aside[0], place[1] + aside[1]), axis)
            M += weights[line] / g * np.outer(beside, beside)
            K += 3.0 * 210e9 * (of.I_y if axis == along else of.I_z) / 4.0**3 * np.outer(row, row)
    for c, row in ((90e3, moved((0.0, 0.0), 0)), (60e3, moved((6.0, 0.0), 1))):
        C += c * np.outer(row, row)
    ground = np.zeros((size, 2))
    ground[[0, 1], [0, 1]] = 1.0
    for i, (direction, line) in enumerate(tuned, start=3):
        axis = "xy".index(direction)
        place = corners[line] if line else tuple(centre)
        stroke = np.eye(size)[i] - moved(place, axis)
        omega = 2.0 * np.pi * 0.9
        K += 3e3 * omega**2 * np.outer(stroke, stroke)
        C += 2.0 * 0.12 * 3e3 * omega * np.outer(stroke, stroke)
        M[i, i] += 3e3
        rides = moved(place, 1 - axis)
        M += 3e3 * np.outer(rides, rides)
        ground[i, axis] = 1.0
    return M, C, K, ground, np.array([moved(corners["A2"], axis) for axis in (0, 1)])


def exact(A: np.ndarray, B: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """States (n, nt) of x' = A x + B g from rest by the modes of A, for ground motion (2, nt) linear in each step."""
    values, vectors = np.linalg.eig(A)
    assert values.real.max() < 0.0 and np.linalg.cond(vectors) < 1e8
    grown = np.exp(values * STEP)
    at_start = (grown - 1.0) / values
    by_slope = (grown - 1.0 - values * STEP) / values**2
    loads = np.linalg.solve(vectors, B) @ ground
    found = np.zeros((values.size, ground.shape[1]), dtype=complex)
    for k in range(1, ground.shape[1]):
        slope = (loads[:, k] - loads[:, k - 1]) / STEP
        found[:, k] = grown * found[:, k - 1] + at_start * loads[:, k - 1] + by_slope * slope
    return np.asarray((vectors @ found).real)


def extrapolated(frame: FrameModel, channels: list[Channel], ground: np.ndarray) -> tuple[list[float], np.ndarray]:
    """Values (channels, nt) of histories in steps of a half and a quarter, extrapolated to none; and these of both.

    Newmark's error falls with the square of the step; what is left falls with its fourth power.
    """
    runs = []
    for parts in (2, 4, 8):
        samples = np.arange(ground.shape[1])
        fine = np.arange((samples.size - 1) * parts + 1) / parts
        x, y = (np.interp(fine, samples, row) for row in ground)
        analysis = Analysis(frame.model, **SHARP)
        analysis.install_dampers()
        run = completed(analysis.history(x, STEP / parts, Newmark(), channels, along_y=y, every=parts))
        runs.append(np.array([run.values[channel.name] for channel in channels]))
    first, second, third = runs
    order = np.log2(np.abs(first - second).max(axis=1) / np.abs(second - third).max(axis=1))
    return order.tolist(), (64.0 * third - 20.0 * second + first) / 45.0


@pytest.mark.parametrize(("case", "eccentricity"), [*((case, 0.0) for case in TUNED), ("both ways", 0.05)])
def test_a_storey_with_dampers_at_its_edges_follows_its_equations(case: str, eccentricity: float) -> None:
    """Displacements of a corner, of the turn and of tuned masses are those of the complex modes of 3 by 3 equations.

    1e-7 of the largest: extrapolated from steps of 1/8 of the motion's.
    """
    tuned = TUNED[case]
    block = "".join(
        f"    - {{kind: tuned_mass, floor: 1, mass: 3 t, frequency: 0.9 Hz, damping: 12 %, direction: {direction}"
        f"{', at: ' + line if line else ''}}}\n"
        for direction, line in tuned
    )
    whole = building(FLOOR + ("  attachments:\n" + block if block else ""))
    frame = make_frame(whole, dampers=True, eccentricity=(eccentricity, -eccentricity))
    M, C, K, along, corner = by_hand(tuned, (eccentricity * 6.0, -eccentricity * 5.0))
    size = len(M)
    inverse = np.linalg.inv(M)
    A = np.block([[np.zeros((size, size)), np.eye(size)], [-inverse @ K, -inverse @ C]])
    ground = np.array([motion(1, 0.2), motion(2, 0.2)])
    states = exact(A, np.vstack([np.zeros((size, 2)), -along]), ground)
    rows = np.vstack([corner, np.eye(size)[2:]])
    channels = [Channel(axis, ((1.0, "displacement", frame.nodes["A2.1"], d),)) for d, axis in enumerate("xy")]
    channels.append(Channel("turn", ((1.0, "displacement", frame.nodes["floor.1"], 5),)))
    channels += [Channel(n, ((1.0, "displacement", s[0][1], s[0][2]),)) for n, s in frame.attached.items()]
    orders, found = extrapolated(frame, channels, ground)
    for name, order, row, values in zip([c.name for c in channels], orders, rows, found, strict=True):
        expected = row @ states[:size]
        np.testing.assert_allclose(values, expected, rtol=0.0, atol=1e-7 * np.abs(expected).max(), err_msg=name)
        assert order == pytest.approx(2.0, abs=0.1)
    modes = Analysis(frame.model).modes(size)
    squares = np.linalg.eigvals(inverse @ K)
    np.testing.assert_allclose(modes.omega, np.sqrt(np.sort(squares.real)), rtol=1e-9)


# --- complex modes of two storeys

DASHPOTS = """\
dampers:
  laws: {oil: {type: viscous, parameters: {c: 800 kN*s/m}}}
  devices:
    - {kind: chevron, along: x, frames: 3, bays: 1, storeys: all, law: oil, scale: [2, 1],
       brace: {section: SHS100x5, material: S275}}
    - {kind: falling, along: y, frames: B, bays: 2, storeys: 1, law: oil, brace: {section: SHS100x5, material: S275}}
    - {kind: nodes, nodes: [A1.0, B2.1], law: oil, number: 2, brace: {stiffness: 60 kN/mm}}
    - {kind: nodes, nodes: [C1.1, C3.2], law: oil, brace: {stiffness: 60 kN/mm}}
    - {kind: nodes, nodes: [B1.0, B1.2], law: oil, brace: {stiffness: 60 kN/mm}}
"""


def pushed_apart(
    places: dict[str, np.ndarray],
) -> tuple[list[float], list[float], list[dict[str, np.ndarray]]]:
    """Coefficients of these dashpots, stiffnesses of their braces, and what their unit forces do to the nodes."""
    found: list[tuple[float, float, dict[str, np.ndarray]]] = []
    EA = 210e9 * steel_section("SHS100x5").A
    for storey, c in ((1, 1.6e6), (2, 0.8e6)):
        low, high = (f"A3.{storey - 1}", f"B3.{storey - 1}"), (f"A3.{storey}", f"B3.{storey}")
        height = places[high[0]][2] - places[low[0]][2]
        forces = {high[0]: np.array([0.5, 0, 0]), high[1]: np.array([0.5, 0, 0])}
        forces |= {low[0]: np.array([-0.5, 0, -height / 6.0]), low[1]: np.array([-0.5, 0, height / 6.0])}
        brace = np.hypot(3.0, height)
        found.append((c, 2.0 * EA / brace * (3.0 / brace) ** 2, forces))
    for start, end, c, k in (
        ("B3.0", "B2.1", 0.8e6, EA / np.hypot(5.0, 4.0)),
        ("A1.0", "B2.1", 1.6e6, 60e6),
        ("C1.1", "C3.2", 0.8e6, 60e6),
        ("B1.0", "B1.2", 0.8e6, 60e6),
    ):
        towards = (places[end] - places[start]) / np.linalg.norm(places[end] - places[start])
        found.append((c, k, {start: -towards, end: towards}))
    coefficients, braces, forces = zip(*found, strict=True)
    return list(coefficients), list(braces), list(forces)


def test_complex_modes_of_a_building_with_dashpots(rigid_in_shear: None) -> None:
    """Floors and forces of dashpots are those of the complex modes of floors and dashpots, by numpy.

    The flexibilities are of the elastic space frame under unit forces on the floors and along the dashpots, and of the
    braces of these. A chevron's force goes along its braces to their feet.
    """
    whole = straight(with_law(building(SMALL + DASHPOTS), law="elastic"))
    space = space_frame(whole)
    places = dict(zip(space.node_names, space.coordinates, strict=True))
    sizes, braces, apart = pushed_apart(places)
    loads, inertia = [], []
    for floor in (1, 2):
        at = np.flatnonzero(space.node_diaphragm == floor - 1)
        m = space.node_mass[at]
        arm = space.coordinates[at, :2] - m @ space.coordinates[at, :2] / m.sum()
        turn = float(m @ (arm**2).sum(axis=1))
        for one in (np.eye(2)[0] * np.ones_like(arm), np.eye(2)[1] * np.ones_like(arm), arm[:, ::-1] * (-1, 1)):
            weight = turn if len(loads) % 3 == 2 else m.sum()
            load = np.zeros((len(space.node_names), 6))
            load[at, :2] = m[:, None] * one / weight
            loads.append(load)
            inertia.append(weight)
    for forces in apart:
        load = np.zeros((len(space.node_names), 6))
        for name, force in forces.items():
            load[space.node_names.index(name), :3] = force
        loads.append(load)
    cases = np.array(loads)
    moved = space_model(space, whole.materials).static(cases).displacements
    flexibility = np.einsum("and,bnd->ab", cases, moved)
    assert np.abs(flexibility - flexibility.T).max() < 1e-9 * np.abs(flexibility).max()
    q, M, c = len(inertia), np.diag(inertia), np.diag(sizes)
    flexibility[q:, q:] += np.diag(1.0 / np.array(braces))
    K = np.linalg.inv(flexibility)
    # x' = A x + B g of floors, dashpots and speeds of the floors; dashpots have no mass: c d' = -(K_dq q + K_dd d)
    A = np.zeros((2 * q + len(sizes),) * 2)
    A[:q, -q:] = np.eye(q)
    A[q:-q, :-q] = -np.linalg.inv(c) @ K[q:]
    A[-q:, :-q] = -np.linalg.inv(M) @ K[:q]
    B = np.zeros((len(A), 2))
    B[-q:] = -np.tile(np.eye(3)[:, :2], (2, 1))
    ground = np.array([motion(1, 0.2), motion(2, 0.2)])
    states = exact(A, B, ground)
    expected = np.vstack([states[:q], -K[q:] @ states[:-q]])
    frame = make_frame(whole, dampers=True)
    channels = [
        Channel(f"floor {floor} {d}", ((1.0, "displacement", frame.nodes[f"floor.{floor}"], d),))
        for floor in (1, 2)
        for d in (0, 1, 5)
    ]
    channels += [Channel(f"force {d.name}", ((1.0, "damper_force", d.number, 0),)) for d in frame.devices]
    _, found = extrapolated(frame, channels, ground)
    for channel, values, row in zip(channels, found, expected, strict=True):
        np.testing.assert_allclose(values, row, rtol=0.0, atol=1e-6 * np.abs(row).max(), err_msg=channel.name)
    damping = -np.linalg.eigvals(A).real / np.abs(np.linalg.eigvals(A))
    assert np.count_nonzero((damping > 0.03) & (damping < 0.999)) >= 4  # vibrations that the dashpots damp


# --- results

SHAKEN = """\
damping: {kind: none}
integration: {method: newmark, time_step: 0.005 s}
records: {one: {file: @motion@, acceleration_unit: m/s^2}}
analyses:
  - {name: modes, kind: modal, modes: 4}
  - {name: shaken, kind: history, record: one}
outputs: {histories: [floors, storeys, supports, dampers]}
"""
PUSHING = """\
dampers:
  laws: {oil: {type: viscous, parameters: {c: 800 kN*s/m}}}
  devices:
    - {kind: @kind@, along: x, frames: 1, bays: 1, storeys: all, law: oil, scale: [2, 1]}
    - {kind: @kind@, along: y, frames: [B, C], bays: 2, storeys: all, law: oil}
    - {kind: nodes, nodes: [A1.0, B2.1], law: oil, number: 2}
"""


@pytest.mark.parametrize("kind", ["storey", "falling"])
def test_floors_of_a_damped_building_are_in_equilibrium(tmp_path: Path, kind: str) -> None:
    """Inertia above a storey is its shear and the force of its dampers; its moment overturns the building, both ways.

    1e-6: histories of an archive are rounded to 6e-8 of their numbers.
    """
    where = Path(__file__).parent.parent / "cases" / "records" / "motion.csv"
    text = changed(SMALL[: SMALL.index("design:")], ("fy: 275 MPa", "fy: 275 MPa, law: elastic"))
    text += "elements: {geometry: {columns: linear}}\n" + PUSHING.replace("@kind@", kind)
    file = tmp_path / "building.yaml"
    file.write_text(text + SHAKEN.replace("@motion@", str(where)), encoding="utf-8")
    whole = load_building(file)
    with open_archive(run_project(whole).archive) as archive:
        group = archive.group("analyses/shaken")
    found, warned = group.variables, [one.text for one in warnings_of(group) if one.kind == "damper_couple"]
    assert [("along y" in text, "at line C" in text) for text in warned] == [(True, True)] * (kind == "storey")
    values = {name: np.asarray(variable.values) for name, variable in found.items()}
    assert found["storey_damper_force"].dims == ("time", "storey", "direction")
    assert list(values["damper_frame"]) == ["X1"] * 2 + ["YB", "YC"] * 2 + [""]
    assert list(values["damper_stands"]) == [kind] * 6 + ["nodes"]
    space = space_frame(whole)
    mass = np.array([space.node_mass[space.level_of_nodes == floor].sum() for floor in (1, 2)])
    inertia = -mass[:, None] * values["floor_acceleration"]
    above = np.cumsum(inertia[:, ::-1], axis=1)[:, ::-1]
    held = values["storey_shear"] + values["storey_damper_force"]
    scale = np.abs(above).max()
    assert np.abs(values["storey_damper_force"]).max(axis=0).min() > 0.02 * scale
    np.testing.assert_allclose(held, above, rtol=0.0, atol=1e-6 * scale)
    np.testing.assert_allclose(values["base_shear"], above[:, 0], rtol=0.0, atol=1e-6 * scale)
    overturning = values["overturning_moment"] - values["overturning_moment"][0]
    moment = inertia.transpose(0, 2, 1) @ np.array([4.0, 7.0])
    np.testing.assert_allclose(overturning, moment, rtol=0.0, atol=1e-6 * np.abs(moment).max())


# --- natural modes


def test_dampers_count_in_modes_at_the_frequency_of_their_direction(tmp_path: Path) -> None:
    """Dashpots with springs in series, whose stiffness follows the frequency, along x and y of a table of four columns.

    By hand: k'(omega) = c^2 k omega^2 / (k^2 + c^2 omega^2) on each axis, with omega of its own mode. 1e-7: rounds end
    when a frequency changes by less than 1e-9.
    """
    block = """\
dampers:
  laws: {soft: {type: maxwell, parameters: {c0: 300 kN*s/m, lambda: 0.15 s}}}
  devices:
    - {kind: storey, along: x, frames: all, bays: 1, storeys: 1, law: soft}
    - {kind: storey, along: y, frames: all, bays: 1, storeys: 1, law: soft, scale: 3}
"""
    table = changed(
        FLOOR[: FLOOR.index("dampers:")],
        ("  - {at: B2, section: HEB240, material: S275, strong: y}\n", ""),
        ("at: [A1, A2, B2], floors: 1, G: 100 kN}, {at: B1, floors: 1, G: 250 kN}", "at: all, floors: 1, G: 140 kN}"),
    )
    whole = building(table + block)
    structure = make_structure(whole, dampers=True)
    spec = ModalAnalysis(kind="modal", name="modes", modes=3)
    found = damped_modes(whole, structure, spec)
    group = Group()
    store_damper_stiffness(group, structure, found)
    shape, mass, c, k = steel_section("HEB200"), 4 * 140e3 / 9.80665, 300e3, 300e3 / 0.15
    for devices, scale, inertia in ((slice(0, 2), 1.0, shape.I_y), (slice(2, 4), 3.0, shape.I_z)):
        columns, omega = 4 * 3.0 * 210e9 * inertia / 4.0**3, 0.0
        for _ in range(100):
            storing = scale * c**2 * k * omega**2 / (k**2 + (c * omega) ** 2)
            omega = np.sqrt((columns + 2 * storing) / mass)
        np.testing.assert_allclose(found.stiffness.real[devices], storing, rtol=1e-7)
        np.testing.assert_allclose(group.variables["damper_frequency"].values[devices], omega / 2 / np.pi, rtol=1e-7)
        assert np.abs(found.modes.omega / omega - 1.0).min() < 1e-7
