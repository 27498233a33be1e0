"""Isolated bases against closed forms, the oscillator of the same law, and statics.

Superstructures are shear frames: columns fixed in rigid floors, masses that resist horizontal motion.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from shear_frames import MASS, STIFFNESS, shear_frame_text

from edesign.archive.dataset import Group
from edesign.codes.ec8.analysis.isolation import equivalent_linear
from edesign.core import Analysis, Channel, LawValues, Model
from edesign.core.damper import EffectValues
from edesign.damper.harmonic import effective_stiffness
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.study.analysis.isolation_estimate import system_loop
from edesign.study.analysis.structure import make_structure
from edesign.study.run.analyses import run_analysis

G = 9.80665  # m/s2
BASE = 30e3  # kg
ALL = MASS + BASE
WEIGHT = 700e3  # N: 300 kN at each node of the floor, and 12.5 kN/m on 8 m of base
REST = """\
loads: {nodes: [{lines: all, floors: all, G: 300 kN}], gravity: {G: 1, Q: 0}}
damping: {kind: none}
integration: {method: newmark, time_step: 0.002 s, tolerance: 1e-10}
dampers:
  laws: {isolator: @law@}
  isolation:
    isolators: [{lines: all, law: isolator@more@}]
    base: {G: 12.5 kN/m, mass: 30 t, @bases@}
    design_displacement: 150 mm
analyses:
  - {name: modes, kind: modal, modes: 2}
  - {name: gravity, kind: gravity}
"""
LINEAR = "{type: kelvin_voigt, parameters: {k: @k@ N/m, c: 0 N*s/m}}"
PENDULUM = (
    "{type: friction_pendulum, parameters: {W: 1 MN, R: 1.5 m, f_slow: @slow@, f_fast: @fast@, a: 0 s/m, Y: 0.1 mm}}"
)
LEAD = "{type: lead_rubber, parameters: {Q: 18 kN, K_d: 0.35 kN/mm, Y: 8 mm}}"


def isolated(
    law: str, more: str = "", storeys: int = 1, stiff: bool = False, bases: str = "rotation: fixed"
) -> Project:
    return parse_project(isolated_text(law, more, storeys, stiff, bases))


def isolated_text(
    law: str, more: str = "", storeys: int = 1, stiff: bool = False, bases: str = "rotation: fixed"
) -> str:
    text = shear_frame_text(storeys) + REST.replace("@law@", law).replace("@more@", more).replace("@bases@", bases)
    if stiff:  # a rigid body above the isolators: its columns are 1e7 times as stiff
        text = text.replace("inertia: 1e-4 m^4", "inertia: 1e3 m^4")
    return text


def pendulum(slow: float, fast: float) -> str:
    return PENDULUM.replace("@slow@", repr(slow)).replace("@fast@", repr(fast))


def value(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


@pytest.mark.parametrize("epsilon", [0.01, 0.05, 0.3])
def test_two_degrees_of_naeim_and_kelly(epsilon: float) -> None:
    """Naeim & Kelly (1999), Design of Seismic Isolated Structures, 2.2: base and one floor on linear isolators.

    omega^2 = (omega_b^2 + omega_s^2 -+ sqrt((omega_b^2 - omega_s^2)^2 + 4 gamma omega_b^2 omega_s^2)) / (2 (1 - gamma))
    with gamma = m / M, omega_b^2 = k_b / M, omega_s^2 = k_s / m and epsilon = omega_b^2 / omega_s^2; the floor moves by
    omega^2 / (omega_s^2 - omega^2) of the base relative to it. The frame's floors are stiffer than its columns by 1e7.
    """
    gamma, square_s = MASS / ALL, STIFFNESS / MASS
    square_b = epsilon * square_s
    project = isolated(LINEAR.replace("@k@", repr(0.5 * square_b * ALL)))
    group = run_analysis(project, project.analyses[0])
    root = math.sqrt((square_b - square_s) ** 2 + 4.0 * gamma * square_b * square_s)
    squares = np.array([square_b + square_s - root, square_b + square_s + root]) / (2.0 * (1.0 - gamma))
    assert value(group, "circular_frequency") ** 2 == pytest.approx(squares, rel=2e-6)
    relative = squares / (square_s - squares)
    assert value(group, "floor_shape")[:, 0] / value(group, "base_shape") == pytest.approx(1.0 + relative, rel=1e-5)
    # L = M (1 + gamma q), generalised mass M (1 + 2 gamma q + gamma q^2)
    share = (1.0 + gamma * relative) ** 2 / (1.0 + 2.0 * gamma * relative + gamma * relative**2)
    assert value(group, "effective_mass_ratio_x") == pytest.approx(share, rel=1e-5)
    if epsilon < 0.02:  # their first-order solution, whose error is of the order of epsilon squared
        assert squares[0] == pytest.approx(square_b * (1.0 - gamma * epsilon), rel=epsilon**2)
        assert share[0] == pytest.approx(1.0, abs=epsilon**2)


def test_period_of_a_pendulum_does_not_depend_on_the_weight() -> None:
    """2 pi sqrt(R / g) without friction (Zayas, Low & Mahin 1990), for a rigid body whose mass is its weight / g."""
    project = isolated(pendulum(1e-12, 1e-12), stiff=True)
    project = project.with_values("masses.given[0].mass", f"{300e3 / G!r} kg")
    project = project.with_values("dampers.isolation.base.mass", f"{100e3 / G!r} kg")
    group = run_analysis(project, project.analyses[0])
    assert value(group, "period")[0] == pytest.approx(2.0 * math.pi * math.sqrt(1.5 / G), rel=1e-6)


def test_effective_stiffness_and_damping_of_a_pendulum() -> None:
    """K_eff = W/R + mu W/D and xi = 2/pi mu / (mu + D/R) (Naeim & Kelly 1999, 4.5), but for the way before it slips.

    Before it slips, Y = 0.1 mm, the loop misses 4 mu W Y of its energy: 0.07 % at 150 mm.
    """
    mu, R, D = 0.06, 1.5, 0.15
    structure = make_structure(isolated(pendulum(mu, mu)), dampers=True)
    assert structure.frame.isolated is not None
    stiffness, energy = system_loop(structure.frame.isolated.devices)(D, 0.4, 0.0)
    assert stiffness == pytest.approx(WEIGHT / R + mu * WEIGHT / D, rel=1e-9)
    damping = energy / (2.0 * math.pi * stiffness * D**2)
    assert damping == pytest.approx(2.0 / math.pi * mu / (mu + D / R), rel=1e-3)


@pytest.mark.parametrize(("slow", "fast", "a"), [(0.02, 0.06, 40.0), (0.03, 0.06, 40.0), (0.03, 0.1, 5.0)])
def test_friction_that_grows_with_speed_counts_as_at_the_largest_speed(slow: float, fast: float, a: float) -> None:
    """K_eff = W/R + mu(omega d) W/d and xi_eff = E_D / (2 pi K_eff d^2), E_D the area of the loop of a sine.

    mu = f_fast - (f_fast - f_slow) exp(-a v), Constantinou, Mokha & Reinhorn (1990). At the turn itself it is f_slow,
    and the force a third too small. So count the modes at the design displacement, and the estimate at its own.
    """

    def mu(speed: np.ndarray) -> np.ndarray:
        return fast - (fast - slow) * np.exp(-a * speed)

    def closed(d: float, mass: float, weight: float) -> tuple[float, float, float]:
        """Effective stiffness, energy of a cycle and frequency that belong together."""
        omega = 3.0
        for _ in range(200):
            stiffness = weight / R + float(mu(np.array(omega * d))) * weight / d
            omega = math.sqrt(stiffness / mass)
        angle = (np.arange(20000) + 0.5) * 0.5 * math.pi / 20000  # of a quarter of the sine, by the midpoint rule
        friction = float(np.mean(mu(omega * d * np.cos(angle)) * np.cos(angle))) * 0.5 * math.pi
        return stiffness, 4.0 * weight * d * friction, omega / (2.0 * math.pi)

    R, D = 1.5, 0.15
    hazard = "hazard: {code: ec8-2004, a_gR: 0.3 g, ground: C, spectrum: 1, levels: {D: {gamma_I: 1}}}\n"
    law = pendulum(slow, fast).replace("a: 0 s/m", f"a: {a!r} s/m")
    project = isolated(law, stiff=True)
    structure = make_structure(project, dampers=True)
    assert structure.frame.isolated is not None
    stiffness, energy, frequency = closed(D, ALL, WEIGHT)
    found = system_loop(structure.frame.isolated.devices)(D, frequency, 2.0 * math.pi * frequency * D)
    assert found[0] == pytest.approx(stiffness, rel=1e-9)
    # what the law has not: f_slow W Y at each of the turns, 0.1 mm in 150 mm; the corners cost 100 samples a cycle 1e-3
    assert found[1] == pytest.approx(energy, rel=3e-3)
    period = value(run_analysis(project, project.analyses[0]), "period")[0]
    assert period == pytest.approx(1.0 / frequency, rel=1e-6)  # a rigid body, stiffer by 1e6

    estimated = parse_project(isolated_text(law, stiff=True) + hazard)
    group = run_analysis(estimated, estimated.analyses[0])
    d = float(value(group, "isolation_displacement")[0])
    stiffness, energy, frequency = closed(d, ALL, WEIGHT)
    xi = energy / (2.0 * math.pi * stiffness * d**2)
    assert value(group, "isolation_shear")[0] == pytest.approx(stiffness * d, rel=1e-6)
    assert value(group, "isolation_damping")[0] == pytest.approx(xi, rel=3e-3)  # as above
    # EN 1998-1, Table 3.2: S 1.15, T_C 0.6 s, T_D 2 s; Eqs. 3.4 to 3.6
    T, eta = 1.0 / frequency, max(math.sqrt(10.0 / (5.0 + 100.0 * xi)), 0.55)
    demand = 0.3 * G * 1.15 * eta * 2.5 * 0.6 / T * min(1.0, 2.0 / T)
    assert stiffness * d == pytest.approx(ALL * demand, rel=2e-3)  # half of the error of xi
    assert value(group, "isolation_restoring")[0] == pytest.approx(WEIGHT / R * 0.5 * d / (ALL * G), rel=1e-6)


def test_which_forces_count_in_the_effective_stiffness() -> None:
    """Springs and friction do, viscous forces do not: k, K_d + Q/d, 0, and what friction beside a law has at omega d.

    Friction: F_c tanh(v/v0) (Andersson et al. 2007), F_c (1 + s exp(-(v/v_s)^2)) tanh(10 v/v_s) (Armstrong-Helouvry et
    al. 1994). Both vanish at the turn.
    """
    d, f = 0.08, 0.4
    v = 2.0 * math.pi * f * d
    coulomb = EffectValues("friction.coulomb", (9e3, 0.15))
    stribeck = EffectValues("friction.stribeck", (7e3, 0.4, 0.2))
    both = 9e3 * math.tanh(v / 0.15) + 7e3 * (1.0 + 0.4 * math.exp(-((v / 0.2) ** 2))) * math.tanh(10.0 * v / 0.2)
    # forces of viscous laws at the turn are what the cubic path leaves of their velocity there, 1e-7 of the largest
    for law, closed in (
        (LawValues("kelvin_voigt", (2e6, 3e5)), 2e6),
        (LawValues("viscous_power", (3e5, 1.0)), 0.0),
        (LawValues("lead_rubber", (18e3, 0.35e6, 8e-3)), 0.35e6 + 18e3 / d),
        (LawValues("friction", (0.1, 4e5, 1e8)), 4e4 / d),
        (LawValues("kelvin_voigt", (2e6, 3e5), (coulomb, stribeck)), 2e6 + both / d),
    ):
        assert effective_stiffness(law, d, f)[0] == pytest.approx(closed, rel=1e-6, abs=1.0)


def test_weights_follow_from_statics() -> None:
    """Beams on hinges bring half of their load to each column, whatever else: 300 kN, and 50 kN of the base."""
    project = isolated(pendulum(0.05, 0.05))
    structure = make_structure(project, dampers=True)
    assert structure.frame.isolated is not None
    weights = [device.force_scale * 1e6 for device in structure.frame.isolated.devices]
    assert weights == pytest.approx([0.5 * WEIGHT] * 2, rel=1e-9)
    group = run_analysis(project, project.analyses[1])
    assert value(group, "isolator_axial_force_final") == pytest.approx([-0.5 * WEIGHT] * 2, rel=1e-9)
    assert abs(float(value(group, "base_displacement_final"))) < 1e-15
    # the law's own weight instead, of 1 MN each
    own = make_structure(isolated(pendulum(0.05, 0.05), ", weight: law"), dampers=True)
    assert own.frame.isolated is not None
    assert [device.force_scale for device in own.frame.isolated.devices] == [1.0, 1.0]


def test_property_factor_of_a_pendulum_is_one_on_its_friction() -> None:
    """The dish keeps its radius: EN 15129 and ASCE/SEI 7-16, 17.2.8.4 change the friction of sliders."""
    project = isolated(pendulum(0.04, 0.06)).with_values("dampers.laws.isolator.property_factor", 1.5)
    structure = make_structure(project, dampers=True)
    assert structure.frame.isolated is not None
    stiffness, _ = system_loop(structure.frame.isolated.devices)(0.15, 0.4, 0.0)
    assert stiffness == pytest.approx(WEIGHT / 1.5 + 1.5 * 0.04 * WEIGHT / 0.15, rel=1e-9)


def test_isolators_hold_the_base_under_horizontal_loads_of_gravity() -> None:
    """Equal columns under 20 kN/m to the right on one of them: the isolators carry it with their stiffness at rest."""
    project = isolated(LEAD)
    project = project.with_values("loads.columns", [{"lines": "A", "storeys": 1, "G": "2 kN/m"}])
    group = run_analysis(project, project.analyses[1])
    stiffness = 2.0 * (0.35e6 + 18e3 / 8e-3)
    assert float(value(group, "base_displacement_final")) == pytest.approx(8e3 / stiffness, rel=1e-6)
    assert value(group, "reaction_x_final") == pytest.approx([-4e3, -4e3], rel=1e-6)


def test_beams_of_the_base_bring_the_moments_of_the_bases_to_the_isolators() -> None:
    """8 kN at 2 m press and relieve the isolators, 8 m apart, by 2 kN; column bases that are fixed keep a part of the
    16 kNm.

    Equal columns in a floor that does not bend share 8 kN; the one under 2 kN/m has w h^2 / 12 more at its column base,
    so the moments of both column bases are w h^2 / 4 + w h^2 / 12 (their shears at mid-height are half of all).
    """
    weight = np.array([-0.5 * WEIGHT] * 2)
    beams = "beams: {section: rigid, material: steel}"
    for bases, moments in (("rotation: fixed", 2e3 * 4.0**2 / 3.0), (beams, 0.0)):
        project = isolated(LEAD, bases=bases)
        project = project.with_values("loads.columns", [{"lines": "A", "storeys": 1, "G": "2 kN/m"}])
        group = run_analysis(project, project.analyses[1])
        change = (16e3 - moments) / 8.0
        assert value(group, "isolator_axial_force_final") == pytest.approx(weight + [change, -change], rel=1e-6)
    assert value(group, "base_displacement_final") == pytest.approx(8e3 / (2.0 * (0.35e6 + 18e3 / 8e-3)), rel=1e-6)


MOTION = (
    4.0 * np.sin(2.0 * np.pi * np.arange(0.0, 12.0, 0.002) / 1.6) * np.sin(np.pi * np.arange(0.0, 12.0, 0.002) / 12.0)
)


def oscillator(law: LawValues, scale: float) -> dict[str, np.ndarray]:
    """Displacement and force of the whole mass on one device of the core; a stiff link says how large forces are."""
    model = Model()
    mass, other = model.node("mass", 0.0, 0.0), model.node("other half", 1.0, 0.0)
    for node in (mass, other):
        model.fix(node, False, True, True)
        model.mass(node, 0.5 * ALL)
    model.link("link", mass, other, (1e13, 0.0, 0.0))
    model.damper("isolator", law, [(1.0, mass, 0)], force_scale=scale, carries=True)
    channels = [
        Channel("u", ((1.0, "displacement", mass, 0),)),
        Channel("F", ((1.0, "damper_force", 0, 0),)),
    ]
    analysis = Analysis(model, tolerance=1e-10)
    response = analysis.history(MOTION, 0.002, channels=channels)
    assert response.status == "completed", response.reason
    return response.values


@pytest.mark.parametrize(
    ("text", "law", "scale"),
    [
        (LEAD, LawValues("lead_rubber", (18e3, 0.35e6, 8e-3)), 2.0),
        (
            pendulum(0.04, 0.08).replace("a: 0", "a: 25"),
            LawValues("friction_pendulum", (1e6, 1.5, 0.04, 0.08, 25.0, 1e-4)),
            0.7,
        ),
    ],
    ids=["lead_rubber", "friction_pendulum"],
)
def test_rigid_superstructure_is_an_oscillator(text: str, law: LawValues, scale: float) -> None:
    """A rigid body, stiffer than its two isolators by 1e6, is as the mass on one of twice the force.

    The weight of a pendulum stands for both: 700 kN where its law has 1 MN.
    """
    project = isolated(text, stiff=True)
    structure = make_structure(project, dampers=True)
    frame = structure.frame
    assert frame.isolated is not None
    structure.apply_gravity()
    structure.install_dampers()
    base = frame.nodes[frame.isolated.isolators[0].column_base]
    numbers = [device.number for device in frame.isolated.devices]
    channels = [
        Channel("u", ((1.0, "displacement", base, 0),)),
        Channel("F", tuple((1.0, "damper_force", number, 0) for number in numbers)),
    ]
    response = structure.analysis.history(MOTION, 0.002, channels=channels)
    assert response.status == "completed", response.reason
    expected = oscillator(law, scale)
    for name in ("u", "F"):
        largest = float(np.max(np.abs(expected[name])))
        assert np.max(np.abs(response.values[name] - expected[name])) < 1e-4 * largest
    if law.law == "friction_pendulum":  # it stops where the dish cannot push it: within f R
        assert abs(response.values["u"][-1]) < 0.08 * 1.5
        assert np.max(np.abs(expected["u"])) > 0.1


def test_friction_under_the_weight_of_the_moment() -> None:
    """Under vertical motion of 0.9 g: F = N (u/R + mu sign) with N of the moment, from a tenth to twice the weight.

    It slides where it is not stuck, so that the friction is at its limit most of the time.
    """
    mu, R = 0.05, 1.5
    varying = ", weight: varying, vertical: {stiffness: 2000 kN/mm, uplift: true}"
    text = shear_frame_text(1).replace("directions: horizontal", "directions: both")
    text += REST.replace("@law@", pendulum(mu, mu)).replace("@more@", varying).replace("@bases@", "rotation: fixed")
    project = parse_project(text).with_values("masses.given[0].mass", f"{300e3 / G!r} kg")
    project = project.with_values("dampers.isolation.base.mass", f"{100e3 / G!r} kg")
    structure = make_structure(project, dampers=True)
    frame = structure.frame
    assert frame.isolated is not None
    structure.apply_gravity()
    structure.install_dampers()
    devices = frame.isolated.devices
    channels = [Channel("u", ((1.0, "displacement", frame.nodes["A0"], 0),))]
    channels += [Channel(f"F{i}", ((1.0, "damper_force", one.number, 0),)) for i, one in enumerate(devices)]
    channels += [Channel(f"N{i}", frame.reaction(one.column_base, 1)) for i, one in enumerate(devices)]
    up = 8.8 * np.sin(2.0 * np.pi * 0.7 * np.arange(MOTION.size) * 0.002)
    response = structure.analysis.history(MOTION, 0.002, channels=channels, vertical=up)
    assert response.status == "completed", response.reason
    u = response.values["u"]
    for i in range(len(devices)):
        N, F = response.values[f"N{i}"], response.values[f"F{i}"]
        friction = F - N * u / R
        assert np.max(np.abs(friction) - mu * N) < 1e-9 * WEIGHT
        assert np.min(N) < 0.15 * 0.5 * WEIGHT and np.max(N) > 1.8 * 0.5 * WEIGHT
        assert np.mean(np.abs(np.abs(friction) - mu * N) < 1e-9 * WEIGHT) > 0.8
    assert response.statistics["energy_error"] < 1e-3


def test_equivalent_linear_displacement_on_the_branch_of_constant_displacement() -> None:
    """Beyond T_D the displacement of the spectrum is 2.5 a_g S eta T_C T_D / (4 pi^2), whatever the period.

    So d follows from eta(xi(d)) alone, here by repeated substitution (EN 1998-1, Eqs. 3.5, 3.6, 3.7 and 10.5).
    """
    mu, R, mass = 0.05, 4.0, 1e5
    hazard = "hazard: {code: ec8-2004, a_gR: 3 m/s2, ground: A, spectrum: 1, parameters: {T_C: 0.8 s, T_D: 1.2 s}}\n"
    project = parse_project(shear_frame_text(1) + hazard + "analyses: [{name: modes, kind: modal, modes: 1}]\n")
    assert project.hazard is not None
    W = mass * G

    def loop(amplitude: float, frequency: float, speed: float) -> tuple[float, float]:
        return W / R + mu * W / amplitude, 4.0 * mu * W * amplitude

    d = 0.1
    for _ in range(200):
        xi = 2.0 / math.pi * mu / (mu + d / R)
        d = 2.5 * 3.0 * max(math.sqrt(10.0 / (5.0 + 100.0 * xi)), 0.55) * 0.8 * 1.2 / (4.0 * math.pi**2)
    found = equivalent_linear(loop, mass, elastic_spectrum(project.hazard), G)
    assert found.period > 1.2
    assert found.displacement == pytest.approx(d, rel=1e-6)
    assert found.damping == pytest.approx(2.0 / math.pi * mu / (mu + d / R), rel=1e-6)
    assert found.shear == pytest.approx(found.mass * found.acceleration, rel=1e-6)
    assert found.restoring == pytest.approx(0.5 * d / R, rel=1e-6)
    assert found.stiffness_ratio == pytest.approx((1.0 / R + mu / d) / (1.0 / R + mu / (0.2 * d)), rel=1e-6)
