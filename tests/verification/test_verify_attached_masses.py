"""Tuned mass and liquid dampers on floors, against equations of motion of the few masses there are.

References: state space over piecewise linear ground motion, exact (matrix exponential); the fixed points of the
amplitude (Den Hartog 1956, 3.3, here for an accelerated base); potential flow by hand for the liquid.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
import scipy.linalg
from scipy.optimize import brentq
from shear_frames import MASS, STIFFNESS, shear_frame_text

from edesign.core import Channel, Newmark
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.study.analysis.history import load_and_damp
from edesign.study.analysis.structure import Structure, make_structure

G = 9.80665

DAMPED = """\
dampers:
  attachments:
    - @attachment@
analyses:
  - {name: modes, kind: modal, modes: 1}
"""


def structure(attachment: str, storeys: int) -> Structure:
    text = shear_frame_text(storeys) + DAMPED.replace("@attachment@", attachment)
    made = make_structure(parse_project(text, "project.yaml", profile_names()), dampers=True)
    made.install_dampers()
    return made


def run(made: Structure, ground: np.ndarray, dt: float) -> np.ndarray:
    """Displacements (n, floors + 1) of the floors and the tuned mass."""
    nodes = [floor.movers[0][0][0][1] for floor in made.frame.floors]
    nodes += [stroke[0][1] for stroke in made.frame.attached.values()]
    channels = [Channel(str(node), ((1.0, "displacement", node, 0),)) for node in nodes]
    response = made.analysis.history(ground, dt, Newmark(), channels)
    assert response.status == "completed", response.reason
    assert response.statistics["energy_error"] < 1e-6
    return np.array([response.values[str(node)] for node in nodes]).T


def exact(mass: np.ndarray, damping: np.ndarray, stiffness: np.ndarray, ground: np.ndarray, dt: float) -> np.ndarray:
    """Displacements (n, masses) under ground acceleration that is linear between its samples."""
    n = mass.size
    system = np.zeros((2 * n + 2, 2 * n + 2))
    system[:n, n : 2 * n] = np.eye(n)
    system[n : 2 * n, :n] = -stiffness / mass[:, None]
    system[n : 2 * n, n : 2 * n] = -damping / mass[:, None]
    system[n : 2 * n, 2 * n] = -1.0
    system[2 * n, 2 * n + 1] = 1.0
    step = scipy.linalg.expm(system * dt)[: 2 * n]
    state, found = np.zeros(2 * n), [np.zeros(n)]
    for now, following in zip(ground[:-1], ground[1:], strict=True):
        state = step @ np.concatenate([state, [now, (following - now) / dt]])
        found.append(state[:n])
    return np.array(found)


def motion() -> np.ndarray:
    t = np.arange(401) * 0.02
    return np.sin(5.0 * t) * np.exp(-0.3 * t) + 0.7 * np.sin(11.0 * t + 0.5) * np.sin(0.8 * t)


@pytest.mark.parametrize("floor", [1, 2])
def test_a_tuned_mass_on_a_two_storey_frame(floor: int) -> None:
    """1e-3 of the peak at 1000 steps a period, and order 2 in the step (average acceleration)."""
    m_d, omega, zeta = 4e3, 2.0 * math.pi * 0.9, 0.12
    k_d, c_d = m_d * omega**2, 2.0 * zeta * m_d * omega
    mass = np.array([MASS, MASS, m_d])
    stiffness, damping = np.zeros((3, 3)), np.zeros((3, 3))
    stiffness[:2, :2] = STIFFNESS * np.array([[2.0, -1.0], [-1.0, 1.0]])
    across = np.array([0.0, 0.0, 1.0])
    across[floor - 1] = -1.0
    stiffness += k_d * np.outer(across, across)
    damping += c_d * np.outer(across, across)
    given = motion()
    errors = []
    for parts in (5, 10, 20):
        dt = 0.02 / parts
        ground = np.interp(np.arange((given.size - 1) * parts + 1) / parts, np.arange(given.size), given)
        expected = exact(mass, damping, stiffness, ground, dt)
        attachment = f"{{kind: tuned_mass, floor: {floor}, mass: 4 t, frequency: 0.9 Hz, damping: 12 %}}"
        found = run(structure(attachment, 2), ground, dt)
        errors.append(np.max(np.abs(found - expected), axis=0) / np.max(np.abs(expected), axis=0))
    assert np.max(errors[-1]) < 1e-3
    # columns and beams are rigid but for 1e-7
    np.testing.assert_allclose(np.log2(np.array(errors[0]) / errors[1]), 2.0, atol=0.1)
    np.testing.assert_allclose(np.log2(np.array(errors[1]) / errors[2]), 2.0, atol=0.1)


def amplitude(mu: float, f: float, zeta: float, r: float) -> complex:
    """Of the structure relative to its base over a / omega^2, for base acceleration a at r times its frequency."""
    spring = mu * f**2 + 2j * r * zeta * mu * f
    a11, a12, a22 = 1.0 - r**2 + spring, -spring, spring - mu * r**2
    return (a22 - mu * a12) / (a11 * a22 - a12**2)


def test_fixed_points() -> None:
    """At two frequencies the amplitude does not depend on the damping of the tuned mass: there the two limits, free and
    locked, meet with opposite signs. Amplitudes of the last cycles of a long harmonic motion."""
    mu, f = 0.08, 0.92
    omega = math.sqrt(STIFFNESS / MASS)

    def both(r: float) -> float:
        return (amplitude(mu, f, 1e-9, r) + amplitude(mu, f, 1e9, r)).real

    free = [  # poles of the free one, between which and the pole of the locked one the points lie
        r for r in np.sqrt(np.linalg.eigvals(np.array([[1 + mu * f**2, -mu * f**2], [-(f**2), f**2]])))
    ]
    locked = 1.0 / math.sqrt(1.0 + mu)
    low, high = sorted(float(r) for r in np.real(free))
    points = [brentq(both, low + 1e-6, locked - 1e-6), brentq(both, locked + 1e-6, high - 1e-6)]
    for r in points:
        height = abs(amplitude(mu, f, 0.3, r))
        for zeta in (0.06, 0.2):
            attachment = (
                f"{{kind: tuned_mass, floor: 1, mass: {mu * MASS!r} kg, frequency: {f * omega / 2 / math.pi!r} Hz, "
                f"damping: {zeta}}}"
            )
            dt = 2.0 * math.pi / (r * omega) / 200
            t = np.arange(200 * 60 + 1) * dt
            last = run(structure(attachment, 1), np.sin(r * omega * t), dt)[-201:-1, 0]
            phase = r * omega * t[-201:-1]
            found = 0.01 * abs(complex(last @ np.sin(phase), last @ np.cos(phase))) * omega**2
            # 200 steps a cycle make the period 1e-4 longer, which steep flanks magnify; transients die out to 1e-4
            assert found == pytest.approx(height, rel=3e-3), (r, zeta)


LIQUID = "{kind: tuned_liquid, floor: 1, number: 12, length: 2.5 m, width: 3 m, depth: 0.4 m, damping: 4 %}"


def test_a_tuned_liquid_damper_is_its_first_sloshing_mode() -> None:
    """omega^2 = g pi / L tanh(pi h / L); mass 8 L / (pi^3 h) tanh(pi h / L) of all the water."""
    wave = math.tanh(math.pi * 0.4 / 2.5)
    omega = math.sqrt(G * math.pi / 2.5 * wave)
    mass = 8.0 * 2.5 / (math.pi**3 * 0.4) * wave * 12 * 2.5 * 3.0 * 0.4 * 1000.0
    made = structure(LIQUID, 1)
    (stroke,) = made.frame.attached.values()
    node = stroke[0][1]
    equation = made.analysis.equations[node, 0]
    assert made.analysis.masses()[equation] == pytest.approx(mass, rel=1e-12)
    assert made.analysis.stiffness()[equation, equation] == pytest.approx(mass * omega**2, rel=1e-12)
    assert made.frame.mass == pytest.approx(MASS)  # that of the frame alone
    same = structure(
        f"{{kind: tuned_mass, floor: 1, mass: {mass!r} kg, frequency: {omega / 2 / math.pi!r} Hz, damping: 4 %}}", 1
    )
    found, expected = (run(one, motion(), 0.02) for one in (made, same))
    assert np.max(np.abs(found - expected)) < 1e-9 * np.max(np.abs(expected))
    assert np.max(np.abs(expected[:, 1] - expected[:, 0])) > 1.5 * np.max(np.abs(expected[:, 0]))  # it does slosh


def test_modal_damping_is_that_of_the_frame_alone() -> None:
    """Chopra 2012, Eq. 11.4.5 with the two modes of the frame; the tuned mass has its own damping and no other."""
    m_d, omega, zeta, ratio = 4e3, 2.0 * math.pi * 0.9, 0.12, 0.05
    k_d, c_d = m_d * omega**2, 2.0 * zeta * m_d * omega
    frame = STIFFNESS * np.array([[2.0, -1.0], [-1.0, 1.0]])
    squares, shapes = scipy.linalg.eigh(frame, MASS * np.eye(2))  # shapes of generalised mass 1
    modal = sum(
        2.0 * ratio * math.sqrt(w) * np.outer(MASS * s, MASS * s) for w, s in zip(squares, shapes.T, strict=True)
    )
    across = np.array([0.0, -1.0, 1.0])
    stiffness, damping = k_d * np.outer(across, across), c_d * np.outer(across, across)
    stiffness[:2, :2] += frame
    damping[:2, :2] += modal
    dt = 0.005
    given = motion()
    ground = np.interp(np.arange((given.size - 1) * 4 + 1) / 4, np.arange(given.size), given)
    expected = exact(np.array([MASS, MASS, m_d]), damping, stiffness, ground, dt)
    attachment = "{kind: tuned_mass, floor: 2, mass: 4 t, frequency: 0.9 Hz, damping: 12 %}"
    text = shear_frame_text(2) + DAMPED.replace("@attachment@", attachment)
    text += "damping: {kind: modal, ratio: 5 %, modes: 2}\nintegration: {method: newmark}\n"
    project = parse_project(text, "project.yaml", profile_names())
    made = make_structure(project, dampers=True)
    load_and_damp(project, made)
    found = run(made, ground, dt)
    error = np.max(np.abs(found - expected), axis=0) / np.max(np.abs(expected), axis=0)
    assert np.max(error) < 3e-3  # average acceleration at 200 steps a period of the second mode
