"""Sizing of viscous dampers against closed forms, explicit matrices of whole frames, and vibrations of the core."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from design_examples import THESIS, design, shear_project
from scipy import integrate, linalg
from shear_frames import MASS, STIFFNESS

from edesign.codes.ec8 import damping_correction
from edesign.core import Channel, LawValues, Newmark
from edesign.damper.dashpot import Dashpot, added_damping, energy_factor, linear_dashpot
from edesign.damper.harmonic import complex_stiffness
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.one_thread import one_thread
from edesign.project.dampers.designs import ViscousDesign
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.study.analysis.structure import make_structure
from edesign.study.design.design import DesignResult, run_design
from edesign.study.design.estimate import make_action
from edesign.study.design.viscous.designer import ViscousDesigner
from edesign.study.design.viscous.model import Dashpots
from edesign.study.design.viscous.sizing import ViscousSizing, largest_viscous_damping

ROOT = THESIS.parents[2]
OMEGA = math.sqrt(STIFFNESS / MASS)  # of one storey
DBE = 0.36 * 9.80665 * 1.15 * 2.5  # plateau of the shear frames' spectrum at 5 %, m/s2
PLACES = "kind: storey, bays: 1, state: initial"
EXPONENTS = (1.0, 0.5, 0.2)


@pytest.fixture(autouse=True)
def alone() -> Iterator[None]:
    """Small matrices are slower in several threads, as in a run."""
    with one_thread():
        yield


def fluid(alpha: float, kind: str = "viscous_power", more: str = "") -> str:
    c = f"c: 500 kN*(s/m)^{alpha:g}, alpha: {alpha:g}"
    return f"\ndampers:\n  laws:\n    fluid: {{type: {kind}, parameters: {{{c}{more}}}}}\n"


def shear(storeys: int, alpha: float = 1.0) -> Project:
    return shear_project(storeys, fluid(alpha))


def run(text: str, project: Project, where: str = PLACES) -> DesignResult:
    return run_design(project, "tried", design(f"method: viscous, law: fluid, {where}, {text}", project), Path("."))


def designer(text: str, project: Project, where: str = PLACES) -> ViscousDesigner:
    spec = design(f"method: viscous, law: fluid, {where}, {text}", project)
    assert isinstance(spec, ViscousDesign)
    return ViscousDesigner(project, "tried", spec, lambda text: None)


# --- the dashpot


@pytest.mark.parametrize(
    ("alpha", "printed"),
    [(0.25, 3.7), (0.5, 3.5), (0.75, 3.3), (1.0, 3.1), (1.25, 3.0), (1.5, 2.9), (1.75, 2.8), (2.0, 2.7)],
)
def test_energy_factor_of_fema_356(alpha: float, printed: float) -> None:
    # FEMA 356, Table 9-4, rounded to one digit; and the integral of |cos|^(1 + alpha) over a cycle that it stands for
    assert round(energy_factor(alpha), 1) == printed
    quarter, _ = integrate.quad(lambda x: math.cos(x) ** (1.0 + alpha), 0.0, 0.5 * math.pi)
    assert energy_factor(alpha) == pytest.approx(4.0 * quarter, rel=1e-9)


@pytest.mark.parametrize("alpha", EXPONENTS)
def test_linear_dashpot_has_the_energy_of_the_law_in_the_core(alpha: float) -> None:
    # the first harmonic of a steady sine carries all the work; 100 samples a cycle leave (pi / 100)^(1 + alpha) of it
    c, amplitude, frequency = 4e5, 0.02, 0.6
    found = complex_stiffness(LawValues("viscous_power", (c, alpha)), amplitude, frequency)
    omega = 2.0 * math.pi * frequency
    expected = omega * linear_dashpot(c, alpha, amplitude, omega)
    assert found.imag == pytest.approx(expected, rel=(math.pi / 100.0) ** (1.0 + alpha))
    assert abs(found.real) < 1e-3 * found.imag


def test_formula_is_exact_for_one_storey() -> None:
    # W_D / (4 pi W_k) = lambda c (omega D)^alpha D / (2 pi k D^2)
    c, alpha, D, m, period = 3e5, 0.4, 0.05, 2e5, 1.3
    omega = 2.0 * math.pi / period
    expected = energy_factor(alpha) * c * (omega * D) ** alpha * D / (2.0 * math.pi * m * omega**2 * D**2)
    found = added_damping(np.array([c]), alpha, np.array([1.0]), D, period, m)
    assert found == pytest.approx(expected, rel=1e-12)
    assert added_damping(np.array([c]), 1.0, np.array([1.0]), D, period, m) == pytest.approx(c / (2 * m * omega))


# --- the target


def test_dampers_in_proportion_to_the_storeys() -> None:
    # C = 2 zeta / omega_1 K: every mode has zeta omega_i / omega_1 exactly, the eigenvalues keep their size
    group = run("damping: 12 %", shear(3)).group
    np.testing.assert_allclose(group.variables["damping_coefficient"].values, STIFFNESS * 0.24 / first(3), rtol=1e-6)
    bare = group.variables["bare_period"].values
    np.testing.assert_allclose(group.variables["period"].values, bare, rtol=1e-6)
    np.testing.assert_allclose(group.variables["damping_complex"].values, 0.12 * bare[0] / bare, rtol=1e-6)
    assert group.attributes["damping_fema356"] == pytest.approx(0.12, rel=1e-6)


def first(storeys: int) -> float:
    """First frequency of equal storeys and floors, rad/s."""
    return 2.0 * OMEGA * math.sin(0.5 * math.pi / (2 * storeys + 1))


@pytest.mark.parametrize("ratio", [0.001, 0.01, 0.5, 2.0, 5.0])
def test_brace_limits_the_damping(ratio: float) -> None:
    # one storey with dashpot and brace in series is a Zener solid with a mass: (sqrt(1 + r) - 1) / 2 at most, up to
    # r = 8, where all three eigenvalues meet; the closed form is checked against its characteristic polynomial
    limit = 0.5 * (math.sqrt(1.0 + ratio) - 1.0)
    tried = []
    for y in np.geomspace(0.1, 3.0, 4001):  # omega c / k_brace, for k = m = 1
        roots = np.roots([y / ratio, 1.0 / ratio, y / ratio * (1.0 + ratio), 1.0 / ratio])
        s = roots[np.argmax(roots.imag)]
        tried.append(-s.real / abs(s) if s.imag > 0.0 else 0.0)
    assert max(tried) == pytest.approx(limit, rel=1e-4)  # steps of 0.1 % miss it by less
    brace = f"brace: {{ratio: {ratio:g}}}"
    assert largest_viscous_damping(designer(f"damping: 2 %, {brace}", shear(1)).model) == pytest.approx(limit, rel=1e-6)
    result = run(f"damping: {99.0 * limit} %, {brace}", shear(1))
    assert result.group.attributes["damping"] == pytest.approx(0.99 * limit, rel=1e-9)
    with pytest.raises(InputError, match=f" {100.0 * limit:.4g} % at most, .* {ratio:g} times .*E-DESIGN-04"):
        run(f"damping: {101.0 * limit} %, {brace}", shear(1))


FRAMES = {
    "thesis": (THESIS, "kind: chevron, bays: [1, 3]"),
    "office": (ROOT / "projects" / "office_6_storeys" / "frame.yaml", "kind: chevron, bays: [1, 4, 11, 14]"),
    "three_storeys": (ROOT / "projects" / "thesis_three_storey" / "project.yaml", "kind: chevron, bays: 1"),
    "setback": (ROOT / "tests" / "cases" / "irregular_setback" / "project.yaml", "kind: rising, bays: 1"),
}


def frame_of(name: str, alpha: float) -> tuple[Project, str]:
    """A project of the repository with a fluid damper's law in place of its dampers."""
    if name == "shear":
        return shear(4, alpha), PLACES
    path, where = FRAMES[name]
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"(?m)^dampers:\n(?:(?:[ #].*)?\n)*", "", text)
    text = re.sub(r"(?m)^(.*damper_(?:strain|deformation).*)$", "", text)
    return parse_project(text + fluid(alpha), path, profile_names()), where


@pytest.mark.parametrize(("alpha", "brace"), [(1.0, "rigid"), (0.5, "{ratio: 6}"), (0.2, "rigid")])
@pytest.mark.parametrize("name", ["shear", *FRAMES])
def test_target_by_complex_eigenvalues_of_the_whole_frame(name: str, alpha: float, brace: str) -> None:
    # every degree of freedom of the core's stiffness, and one for each brace; nothing condensed, no modes
    project, where = frame_of(name, alpha)
    made = designer(f"damping: 15 %, amplitude: {{drift: 1 %}}, brace: {brace}", project, where)
    sizing = made.make(0.15)
    assert sizing.reason == ""
    damping, omega = explicit(project, made, sizing)
    assert damping[0] == pytest.approx(0.15, abs=1e-6)  # agreement of the dashpots; the bar is 3e-3
    assert omega[0] == pytest.approx(sizing.vibration.omega, rel=1e-6)


def explicit(project: Project, made: ViscousDesigner, sizing: ViscousSizing) -> tuple[np.ndarray, np.ndarray]:
    """Damping ratios and frequencies (rad/s) of free vibration with all degrees of freedom, in rising order."""
    structure = make_structure(project.model_copy(update={"dampers": made.dampers(sizing)}), dampers=True)
    if made.spec.state == "gravity":
        structure.apply_gravity()
    stiffness, mass = structure.analysis.stiffness().toarray(), structure.analysis.masses()
    devices = structure.frame.devices
    rows = structure.analysis.damper_directions().toarray()[[device.number for device in devices]]
    braced = [device.brace for device in devices if device.brace > 0.0]
    n = mass.size + len(braced)
    K, C, M = np.zeros((n, n)), np.zeros((n, n)), np.zeros(n)
    K[: mass.size, : mass.size], M[: mass.size] = stiffness, mass
    brace = iter(range(mass.size, n))
    for device, row, c in zip(devices, rows, sizing.vibration.linear, strict=True):
        direction = np.pad(row, (0, n - mass.size))
        if device.brace > 0.0:
            at = next(brace)
            K[at, at] += device.brace
            direction[at] -= 1.0
        C += c * np.outer(direction, direction)
    zero, one = np.zeros((n, n)), np.eye(n)
    inverse = linalg.eigvals(np.linalg.solve(np.block([[zero, one], [-K, -C]]), linalg.block_diag(one, np.diag(M))))
    s = 1.0 / inverse[inverse.imag < -1e-9 * np.abs(inverse)]
    s = s[np.argsort(np.abs(s))]
    return -s.real / np.abs(s), np.abs(s)


@pytest.mark.parametrize("alpha", EXPONENTS)
def test_sized_dampers_hold_a_resonance_in_the_core(alpha: float) -> None:
    # A harmonic ground motion at the natural frequency drives a linear oscillator of damping zeta to
    # D = a_g / (2 zeta omega^2). The law of the design must do so at its amplitude D; the force of a power law has
    # harmonics, of which the third, the largest, moves the mass by less than F3 / (8 k) with F3 < F1 / 3: zeta D / 12.
    D, zeta = 0.04, 0.1
    result = run(f"damping: {100 * zeta} %, amplitude: {{roof_displacement: {1e3 * D} mm}}", shear(1, alpha))
    peak = resonance(result, shear(1, alpha), zeta, D)
    assert peak == pytest.approx(D, rel=zeta / 12.0)


def resonance(result: DesignResult, project: Project, zeta: float, amplitude: float) -> float:
    structure = make_structure(project.model_copy(update={"dampers": result.dampers}), dampers=True)
    analysis = structure.analysis
    analysis.install_dampers()
    steps, cycles = 200, 40
    period = float(result.group.variables["bare_period"].values[0])
    omega = 2.0 * math.pi / period
    time = np.arange(cycles * steps + 1) * period / steps
    ground = 2.0 * zeta * omega**2 * amplitude * np.sin(omega * time)
    channel = Channel("u", ((1.0, "displacement", structure.frame.nodes["A1"], 0),))
    u = analysis.history(ground, period / steps, Newmark(), [channel]).values["u"]
    return float(0.5 * (u[-steps:].max() - u[-steps:].min()))


# --- amplitude, distributions, estimates


def test_amplitude_of_the_spectrum() -> None:
    # one storey on the plateau: D = S_e(5 %) eta / omega^2 with eta of inherent and added damping
    made = run("damping: 10 %, level: DBE, inherent_damping: 3 %", shear(1, 0.5)).group
    assert 0.2 < 2.0 * math.pi / OMEGA < 0.6
    D = DBE * damping_correction(0.13) / OMEGA**2
    assert made.attributes["roof_displacement_m"] == pytest.approx(D, rel=1e-6)
    c = 0.2 * math.sqrt(STIFFNESS * MASS) * math.pi / energy_factor(0.5) * (OMEGA * D) ** 0.5
    np.testing.assert_allclose(made.variables["device_coefficient"].values, c, rtol=1e-5)
    np.testing.assert_allclose(made.variables["estimated_device_stroke"].values, D, rtol=1e-5)
    np.testing.assert_allclose(made.variables["estimated_device_velocity"].values, OMEGA * D, rtol=1e-5)
    np.testing.assert_allclose(made.variables["estimated_device_force"].values, c * (OMEGA * D) ** 0.5, rtol=1e-5)
    assert np.all(np.diff(made.variables["iteration_difference"].values) < 0.0)


def test_distributions() -> None:
    # equal storeys and floors: the shape is sin(j theta), the shear of storey j the sum of the shape from floor j up
    storeys, theta = 4, math.pi / 9.0
    shape = np.sin(theta * np.arange(storeys + 1))
    shear_force, drift = np.cumsum(shape[:0:-1])[::-1], np.diff(shape)
    patterns = {"uniform": np.ones(storeys), "storey_stiffness": np.ones(storeys), "storey_shear": shear_force}
    patterns["strain_energy"] = shear_force * drift
    for distribution, pattern in patterns.items():
        group = run(f"damping: 8 %, distribution: {distribution}", shear(storeys)).group
        found = group.variables["damping_coefficient"].values
        np.testing.assert_allclose(found / found[0], pattern / pattern[0], rtol=1e-5)  # columns lengthen by 1e-6
        assert group.variables["damping_complex"].values[0] == pytest.approx(0.08, rel=1e-9)


def test_inclined_dampers() -> None:
    # a damper at an angle feels v cos and its force counts with cos: the storey has c cos^(1 + alpha)
    alpha, D = 0.5, 0.05
    group = run(
        f"damping: 10 %, number: 2, amplitude: {{roof_displacement: {D} m}}",
        shear(1, alpha),
        "kind: rising, bays: 1, state: initial",
    ).group
    device, storey = (group.variables[f"{name}_coefficient"].values[0] for name in ("device", "damping"))
    cosine = 8.0 / math.hypot(8.0, 4.0)
    assert storey == pytest.approx(2.0 * device * cosine ** (1.0 + alpha), rel=1e-9)
    expected = 0.2 * math.sqrt(STIFFNESS * MASS) * math.pi / energy_factor(alpha) * (OMEGA * D) ** (1.0 - alpha)
    assert storey == pytest.approx(expected, rel=1e-5)  # columns of 1000 m2 hardly lengthen


def test_least_coefficients_against_a_grid() -> None:
    project, limit = shear(2), 0.014
    result = run(f"distribution: least_coefficient, level: DBE, drift: {100 * limit} %", project)
    assert result.status == "completed"
    best = result.group.variables["damping_coefficient"].values
    made = designer("damping: 5 %, level: DBE", project)
    action = make_action(project, made.spec)
    assert action is not None

    def drift(c: np.ndarray) -> float:
        return float(made.model.drift(Dashpots(c, c, np.zeros(2), first(2)), action).max())

    assert drift(best) <= limit * (1.0 + 1e-6)
    axis = np.linspace(0.0, 1.2 * best.sum(), 50)
    cheaper = [x for x in (np.array([a, b]) for a in axis for b in axis) if x.sum() < best.sum() * (1.0 - 1e-6)]
    assert len(cheaper) > 500 and all(drift(x) > limit for x in cheaper)


def test_bounds_enclose_the_design() -> None:
    # linear dashpots in proportion to the storeys: damping is proportional to the coefficients
    group = run("damping: 8 %, level: DBE, bounds: {upper: 1.5, lower: 0.7}", shear(3)).group
    np.testing.assert_allclose(group.variables["bound_damping"].values, 0.08 * np.array([0.7, 1.0, 1.5]), rtol=1e-6)
    assert group.attributes["governing"]["storey_drift"] == "lower"
    assert group.attributes["governing"]["damper_stroke"] == "lower"
    assert group.attributes["governing"]["damper_force"] == "upper"


def test_spring_of_the_law_is_in_series() -> None:
    # a Maxwell law keeps its relaxation time whatever its size: c and spring grow together
    c0, relaxation = 500e3, 0.02
    law = "\ndampers: {laws: {fluid: {type: maxwell, parameters: {c0: 500 kN*s/m, lambda: 0.02 s}}}}\n"
    made = run("damping: 10 %", shear_project(1, law)).group
    c, k = (float(made.variables[f"device_{name}"].values[0]) for name in ("coefficient", "spring"))
    assert c / k == pytest.approx(relaxation, rel=1e-12)
    roots = np.roots([MASS * relaxation, MASS, STIFFNESS * relaxation + c, STIFFNESS])
    s = roots[np.argmax(roots.imag)]
    assert -s.real / abs(s) == pytest.approx(0.10, rel=1e-6)
    np.testing.assert_allclose(made.variables["device_scale"].values, c / c0)
    power = shear_project(1, fluid(1.0, "maxwell_power", ", k: 25 kN/mm"))
    np.testing.assert_allclose(run("damping: 10 %", power).group.variables["device_coefficient"].values, c, rtol=1e-9)


def test_laws_that_are_no_dashpot() -> None:
    assert Dashpot(1.0, 0.5).spring == math.inf
    for alpha, said in ((0.1, "alpha = 0.1"), (1.2, "alpha = 1.2")):
        with pytest.raises(InputError, match=f"designs.tried.law: .*{said} .* 0.15 to 1 .E-LAW-03"):
            run("damping: 5 %, amplitude: {drift: 1 %}", shear(1, alpha))
    with pytest.raises(InputError, match="designs.tried.amplitude: .*`level`.*E-KEY-02"):
        run("damping: 5 %", shear(1, 0.5))
