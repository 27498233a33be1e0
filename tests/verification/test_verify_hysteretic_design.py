"""Sizing of hysteretic dampers against closed forms, published formulas, whole frames, and cycles of the core."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from design_examples import THESIS, design, shear_project
from scipy import linalg
from shear_frames import HEIGHT, MASS, STIFFNESS

from edesign.core import LawValues
from edesign.core.damper import CoreDamper
from edesign.damper.hysteresis import behind_brace, hysteresis
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.one_thread import one_thread
from edesign.project.dampers.designs import HYSTERETIC_LAWS, HystereticDesign
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.study.analysis.structure import make_structure
from edesign.study.design.design import DesignResult, run_design
from edesign.study.design.hysteretic.designer import HystereticDesigner
from edesign.study.design.hysteretic.sizing import HystereticSizing, largest_hysteretic_damping, unit_forces

ROOT = THESIS.parents[2]
PLACES = "kind: storey, bays: 1, state: initial"
LAWS = """
dampers:
  laws:
    stiff: {type: friction, parameters: {mu: 0.5, N: 100 kN, k: 5e8 kN/mm}}
    pad: {type: friction, parameters: {mu: 0.3, N: 100 kN, k: 60 kN/mm}}
    plastic: {type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0}}
    steel: {type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0.03}}
    smooth: {type: bouc_wen, parameters: {Fy: 50 kN, Y: 2 mm, alpha: 0.03, n: 2}}
    elastic: {type: self_centring, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0.03, beta: 0}}
    flag: {type: self_centring, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0.03, beta: 0.8}}
"""


@pytest.fixture(autouse=True)
def alone() -> Iterator[None]:
    """Small matrices are slower in several threads, as in a run."""
    with one_thread():
        yield


def shear(storeys: int) -> Project:
    return shear_project(storeys, LAWS)


def run(text: str, project: Project, where: str = PLACES) -> DesignResult:
    return run_design(project, "tried", design(f"method: hysteretic, {where}, {text}", project), Path("."))


def designer(text: str, project: Project, where: str = PLACES) -> HystereticDesigner:
    spec = design(f"method: hysteretic, {where}, {text}", project)
    assert isinstance(spec, HystereticDesign)
    return HystereticDesigner(project, "tried", spec, lambda text: None)


# --- the loops of the laws

VALUES = {
    "friction": (0.3, 3e5, 1e8),
    "elastic_plastic": (5e7, 8e4, 0.05),
    "self_centring": (5e7, 8e4, 0.05, 0.8),
    "ramberg_osgood": (5e7, 8e4, 0.5, 6.0),
    "bouc_wen": (1e5, 2e-3, 0.05, 1.0, 0.5, 0.5, 2.0),
}
MORE = [("bouc_wen", (1e5, 2e-3, 0.1, 1.3, -0.2, 0.9, 3.0)), ("bouc_wen", (1e5, 2e-3, 0.0, 1.0, 0.5, 0.5, 100.0))]


def steady(law: LawValues, amplitude: float, brace: float = 0.0, points: int = 4000) -> tuple[float, float]:
    """Largest force and energy of the last of 30 cycles of a zigzag in the core: N and J."""
    quarter = np.linspace(0.0, 1.0, points // 4, endpoint=False)
    cycle = np.concatenate((quarter, 1.0 - quarter, -quarter, quarter - 1.0))
    u = amplitude * np.append(np.tile(cycle, 30), 0.0)
    time = np.arange(u.size) / points
    force = CoreDamper(law.law, law.values, brace).force(time, u, np.gradient(u, time))
    last = slice(-points - 1, None)
    return float(force[last].max()), float(np.trapezoid(force[last], u[last]))


@pytest.mark.parametrize("ratio", [0.8, 2.0, 10.0])
@pytest.mark.parametrize(("name", "values"), [*VALUES.items(), *MORE])
def test_loops_are_the_steady_cycles_of_the_core(name: str, values: tuple[float, ...], ratio: float) -> None:
    # the trapezoidal rule over 4000 points errs by 1e-6 of curved loops; Bouc-Wen creeps to its symmetric loop
    law = LawValues(name, values)
    loop = hysteresis(law)
    amplitude = ratio * loop.yield_force / loop.stiffness
    force, energy = steady(law, amplitude)
    assert float(loop.force(np.array(amplitude))) == pytest.approx(force, rel=1e-5)
    assert float(loop.energy(np.array(amplitude))) == pytest.approx(energy, rel=1e-5, abs=1e-5 * force * amplitude)
    flexibility = 0.7 / loop.stiffness
    stroke = behind_brace(loop, np.array([amplitude]), np.array([flexibility]))
    force, energy = steady(law, amplitude, 1.0 / flexibility)
    assert float(loop.force(stroke)[0]) == pytest.approx(force, rel=1e-5)
    assert float(loop.energy(stroke)[0]) == pytest.approx(energy, rel=1e-5, abs=1e-5 * force * amplitude)
    step = 1e-6 * amplitude
    slope = float(loop.force(np.array(amplitude + step)) - loop.force(np.array(amplitude - step))) / (2.0 * step)
    assert float(loop.tangent(np.array(amplitude))) == pytest.approx(slope, rel=1e-5, abs=1e-6 * loop.stiffness)


def test_every_law_that_may_be_named_can_be_sized() -> None:
    assert set(HYSTERETIC_LAWS) == {*VALUES, "buckling_restrained"}  # test_verify_restrained_design.py
    with pytest.raises(InputError, match="kelvin_voigt .*`friction`.*E-DESIGN-03"):
        hysteresis(LawValues("kelvin_voigt", (1.0, 1.0)))


# --- the target in closed form


@pytest.mark.parametrize("ductility", [1.5, 4.0, 20.0])
def test_damping_of_one_storey_in_closed_form(ductility: float) -> None:
    # elastic-perfectly plastic beside a spring: 4 F (u - u_y) / (2 pi (k u + F) u), at the secant period
    u = ductility * 2.5e-3
    group = run(f"law: plastic, shear_share: 20 %, level: DBE, amplitude: {{roof_displacement: {u} m}}", shear(1)).group
    force = float(group.variables["yield_force"].values[0])
    expected = 4.0 * force * (u - 2.5e-3) / (2.0 * math.pi * (STIFFNESS * u + force) * u)
    assert group.attributes["damping_at_amplitude"] == pytest.approx(expected, rel=1e-5)  # columns lengthen by 1e-6
    period = 2.0 * math.pi * math.sqrt(MASS / (STIFFNESS + force / u))
    assert group.variables["period"].values[0] == pytest.approx(period, rel=1e-5)
    elastic = 2.0 * math.pi * math.sqrt(MASS / (STIFFNESS + force / 2.5e-3))
    assert group.variables["elastic_period"].values[0] == pytest.approx(elastic, rel=1e-5)
    assert group.variables["yield_drift"].values[0] == pytest.approx(2.5e-3 / HEIGHT)


@pytest.mark.parametrize("ductility", [2.0, 8.0])
def test_average_damping_by_kasai(ductility: float) -> None:
    # Kasai, Fu and Watanabe (1998), Journal of Structural Engineering 124(5); JSSI (2003): the mean over amplitudes is
    # 2 / (pi mu p) ln((1 + p (mu - 1)) / mu^p), p: stiffness after over before yielding. Gauss's rule has a kink.
    u = ductility * 2.5e-3
    text = f"law: plastic, shear_share: 20 %, level: DBE, amplitude: {{roof_displacement: {u} m}}"
    group = run(f"{text}, equivalent_damping: average", shear(1)).group
    dampers = float(group.variables["yield_force"].values[0]) / 2.5e-3
    p = STIFFNESS / (STIFFNESS + dampers)
    expected = 2.0 / (math.pi * ductility * p) * math.log((1.0 + p * (ductility - 1.0)) / ductility**p)
    assert group.attributes["damping"] == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 2.5])
def test_largest_damping_is_at_the_optimum_strength_ratio(ratio: float) -> None:
    # Inoue and Kuwahara (1998), EESD 27, 577: with a given stiffness k of dampers over frame the damping is largest
    # where the dampers carry 1 - 1 / sqrt(1 + k) of the shear; it is 2/pi (sqrt(1 + k) - 1) / (sqrt(1 + k) + 1).
    # Here rigid dampers slip on braces of k times the storey; shares are over the shear of the frame, k_S u.
    root = math.sqrt(1.0 + ratio)
    limit = 2.0 / math.pi * (root - 1.0) / (root + 1.0)
    text = f"law: stiff, brace: {{ratio: {ratio}}}, amplitude: {{roof_displacement: 40 mm}}"
    model = designer(f"damping: 2 %, {text}", shear(1)).model
    assert largest_hysteretic_damping(model) == pytest.approx(limit, rel=1e-6)
    made = designer(f"damping: {99.9999 * limit} %, {text}", shear(1))
    sizing = made.make(0.999999 * limit)
    share = sizing.size[0] / (sizing.size[0] + STIFFNESS * 0.04)
    assert share == pytest.approx(1.0 - 1.0 / root, rel=3e-3)  # flat at the top: 1e-6 of damping is 1e-3 of force
    with pytest.raises(InputError, match=rf" {100.0 * limit:.4g} % at most, .* {ratio:g} times .*E-DESIGN-04"):
        run(f"damping: {101.0 * limit} %, {text}", shear(1))


def test_least_force_of_two() -> None:
    # the closed form of one storey, 2/pi k r (1 - r) / (1 + k r) with r = F / (k_b u): two forces reach a damping below
    # the largest, and the smaller one is taken
    ratio, u, target = 2.0, 0.04, 0.12
    text = f"law: stiff, brace: {{ratio: {ratio}}}, amplitude: {{roof_displacement: 40 mm}}, damping: {100 * target} %"
    group = run(text, shear(1)).group
    a, b = 2.0 / math.pi * ratio, target * ratio
    smaller = min(np.roots([a, b - a, target]).real)
    assert group.variables["yield_force"].values[0] == pytest.approx(smaller * ratio * STIFFNESS * u, rel=1e-4)


def test_dampers_that_do_not_yield() -> None:
    with pytest.raises(InputError, match="yield at 2.5 mm.*E-DESIGN-04"):
        run("law: steel, damping: 5 %, amplitude: {roof_displacement: 2 mm}", shear(1))
    with pytest.raises(InputError, match="`elastic` .*E-DESIGN-03"):
        run("law: elastic, damping: 5 %, level: DBE", shear(1))


# --- shape, period and amplitude of frames


def spectral_displacement(omega: float, damping: float) -> float:
    """EN 1998-1, Eqs. 3.2 to 3.6 and 3.7: type 1, ground C, 0.36 g, written down once more."""
    T, a, S, eta = 2.0 * math.pi / omega, 0.36 * 9.80665, 1.15, max(math.sqrt(0.10 / (0.05 + damping)), 0.55)
    if T <= 0.2:
        S_e = a * S * (1.0 + T / 0.2 * (eta * 2.5 - 1.0))
    elif T <= 0.6:
        S_e = a * S * eta * 2.5
    else:
        S_e = a * S * eta * 2.5 * 0.6 / T * (2.0 / T if T > 2.0 else 1.0)
    return S_e / omega**2


@pytest.mark.parametrize(("law", "brace"), [("steel", math.inf), ("steel", 4.0), ("pad", 4.0)])
def test_secant_iteration_of_a_shear_frame(law: str, brace: float) -> None:
    # own matrices, own loops in closed form, own spectrum, and the plain fixed point that textbooks have
    n, inherent = 4, 0.03
    text = f"law: {law}, damping: 9 %, level: DBE, inherent_damping: 3 %"
    text += "" if math.isinf(brace) else f", brace: {{ratio: {brace}}}"
    group = run(text, shear(n)).group
    F, k, b = {"steel": (50e3, 20e6, 0.03), "pad": (30e3, 60e6, 0.0)}[law]
    scale = group.variables["yield_force"].values / F
    K = STIFFNESS * (np.diag([2.0] * (n - 1) + [1.0]) - np.eye(n, k=1) - np.eye(n, k=-1))
    T = np.eye(n) - np.eye(n, k=-1)  # drifts of displacements
    k_b = brace * STIFFNESS
    k1 = scale * k if math.isinf(brace) else 1.0 / (1.0 / (scale * k) + 1.0 / k_b)
    k2 = scale * b * k if math.isinf(brace) or b == 0.0 else 1.0 / (1.0 / (scale * b * k) + 1.0 / k_b)
    u_y = scale * F / k1
    u, zeta = np.full(n, 0.02), 0.0
    for _ in range(400):
        force = np.where(u > u_y, scale * F + k2 * (u - u_y), k1 * u)
        squared, shapes = linalg.eigh(K + T.T @ np.diag(force / u) @ T, MASS * np.eye(n))
        phi, omega = shapes[:, 0] / shapes[-1, 0], math.sqrt(squared[0])
        energy = 4.0 * (scale * F - k2 * u_y) * np.maximum(u - u_y, 0.0)
        D = abs(phi.sum() / (phi @ phi)) * spectral_displacement(omega, inherent + zeta)
        following = D * np.abs(T @ phi)
        strain = 0.5 * omega**2 * MASS * float(phi @ phi) * D**2
        zeta = float(energy @ (following / u) ** 2) / (4.0 * math.pi * strain)
        u = np.sqrt(u * following)
    assert zeta == pytest.approx(0.09, abs=1e-5)  # columns lengthen by 1e-6 each; agreement 1e-6
    assert group.variables["period"].values[0] == pytest.approx(2.0 * math.pi / omega, rel=1e-5)
    assert group.attributes["roof_displacement_m"] == pytest.approx(D, rel=1e-5)
    strokes = u - (0.0 if math.isinf(brace) else force / k_b)
    np.testing.assert_allclose(group.variables["design_stroke"].values, strokes, rtol=2e-5)


FRAMES = {
    "thesis": (THESIS, "kind: chevron, bays: [1, 3]"),
    "braces": (THESIS, "kind: chevron_braces, bays: 2"),
    "setback": (ROOT / "tests" / "cases" / "irregular_setback" / "project.yaml", "kind: rising, bays: 1"),
}


@pytest.mark.parametrize(("law", "brace"), [("steel", "{ratio: 5}"), ("smooth", "rigid"), ("flag", "rigid")])
@pytest.mark.parametrize("name", list(FRAMES))
def test_target_by_the_whole_frame_and_cycles_of_the_core(name: str, law: str, brace: str) -> None:
    # every degree of freedom, nothing condensed; forces and energies of dampers and braces by the core's own cycles
    path, where = FRAMES[name]
    text = re.sub(r"(?m)^dampers:\n(?:(?:[ #].*)?\n)*", "", path.read_text(encoding="utf-8"))
    text = re.sub(r"(?m)^(.*damper_(?:strain|deformation).*)$", "", text)
    project = parse_project(text + LAWS, path, profile_names())
    made = designer(f"law: {law}, damping: 4 %, amplitude: {{drift: 1 %}}, brace: {brace}", project, where)
    sizing = made.make(0.04)
    damping, period = explicit(project, made, sizing)
    assert damping == pytest.approx(0.04, abs=1e-5)  # of curved loops the trapezoidal rule misses 1e-4
    assert period == pytest.approx(sizing.vibration.period, rel=1e-5)


def explicit(project: Project, made: HystereticDesigner, sizing: HystereticSizing) -> tuple[float, float]:
    """Damping ratio and period (s) of the first mode at the amplitude of the design, by cycles of the core."""
    structure = make_structure(project.with_dampers(made.dampers(sizing)), dampers=True)
    structure.apply_gravity()
    stiffness, mass = structure.analysis.stiffness().toarray(), structure.analysis.masses()
    devices = structure.frame.devices
    rows = structure.analysis.damper_directions().toarray()[[device.number for device in devices]]
    roof = np.zeros(mass.size)
    nodes = [node for ((_, node, _),) in structure.frame.floors[-1].movers[0]]
    roof[[structure.analysis.equations[node, 0] for node in nodes]] = 1.0 / len(nodes)
    forces, energies = np.empty(len(devices)), np.empty(len(devices))
    for i, (device, u) in enumerate(zip(devices, sizing.vibration.deformation, strict=True)):
        scale = device.force_scale
        found = steady(made.building.law.law, float(u), device.brace / scale, 400)
        forces[i], energies[i] = scale * found[0], scale * found[1]
    K = stiffness + rows.T @ np.diag(forces / sizing.vibration.deformation) @ rows
    inverse, shapes = linalg.eigh(np.diag(mass), K, subset_by_index=[mass.size - 1, mass.size - 1])
    phi = shapes[:, 0] * (sizing.vibration.roof / float(roof @ shapes[:, 0]))
    np.testing.assert_allclose(np.abs(rows @ phi), sizing.vibration.deformation, rtol=1e-4)
    strain = 0.5 * float(phi @ K @ phi)
    return float(energies.sum()) / (4.0 * math.pi * strain), 2.0 * math.pi * math.sqrt(float(inverse[0]))


# --- shares, distributions, estimates


def test_shares_of_the_shears() -> None:
    # one mode of equal storeys is sin(j theta); CQC of one storey is its only mode
    plain = run("law: pad, shear_share: 25 %, level: DBE, inherent_damping: 5 %", shear(1)).group
    shear_force = MASS * (OMEGA**2 * spectral_displacement(OMEGA, 0.05))
    np.testing.assert_allclose(plain.variables["yield_force"].values, 0.25 * shear_force, rtol=1e-5)
    storeys, theta = 4, math.pi / 9.0
    shape = np.sin(theta * np.arange(storeys + 1))
    group = run(
        "law: pad, shear_share: 25 %, level: DBE, inherent_damping: 5 %, shear: first_mode", shear(storeys)
    ).group
    omega, phi = 2.0 * OMEGA * math.sin(0.5 * theta), shape[1:]
    inertia = MASS * omega**2 * phi * (phi.sum() / (phi @ phi)) * spectral_displacement(omega, 0.05)
    expected = 0.25 * np.cumsum(inertia[::-1])[::-1]
    np.testing.assert_allclose(group.variables["yield_force"].values, expected, rtol=1e-4)
    for distribution, pattern in {
        "uniform": np.ones(storeys),
        "storey_stiffness": np.ones(storeys),
        "strain_energy": np.cumsum(phi[::-1])[::-1] * np.diff(shape),
    }.items():
        text = f"law: pad, shear_share: 25 %, level: DBE, shear: first_mode, distribution: {distribution}"
        found = run(text + ", inherent_damping: 5 %", shear(storeys)).group.variables["yield_force"].values
        np.testing.assert_allclose(found, expected.sum() * pattern / pattern.sum(), rtol=1e-4)


OMEGA = math.sqrt(STIFFNESS / MASS)


def test_inclined_dampers_count_with_their_cosine() -> None:
    text = "law: pad, shear_share: 25 %, level: DBE, number: 2"
    group = run(text, shear(1), "kind: rising, bays: 1, state: initial").group
    cosine = 8.0 / math.hypot(8.0, 4.0)
    device, storey = (float(group.variables[name].values[0]) for name in ("device_yield_force", "yield_force"))
    assert storey == pytest.approx(2.0 * cosine * device, rel=1e-9)
    assert group.variables["yield_drift"].values[0] == pytest.approx(0.5e-3 / cosine / HEIGHT, rel=1e-9)


def test_estimates_of_one_storey() -> None:
    # one mode: the estimate is the vibration of the design itself
    group = run(
        "law: steel, damping: 10 %, level: DBE, brace: {ratio: 4}, bounds: {upper: 1.2, lower: 0.8}", shear(1)
    ).group
    values = {name: variable.values for name, variable in group.variables.items()}
    assert values["estimated_storey_drift"][0] == pytest.approx(
        group.attributes["roof_displacement_m"] / HEIGHT, rel=1e-5
    )
    np.testing.assert_allclose(values["estimated_device_stroke"], values["design_stroke"], rtol=1e-5)
    force = values["device_yield_force"] * (1.0 + 0.03 * (values["design_ductility"] - 1.0))
    np.testing.assert_allclose(values["estimated_device_force"], force, rtol=1e-5)
    np.testing.assert_allclose(values["bound_damping"][1], 0.10, rtol=1e-5)
    assert group.attributes["governing"]["damper_force"] == "upper"
    assert group.attributes["governing"]["damper_stroke"] == "lower"


def test_curve_goes_through_the_design() -> None:
    made = designer("law: pad, shear_share: 25 %, level: DBE, brace: {ratio: 3}", shear(3))
    sizing = made.make(0.25)
    np.testing.assert_allclose(sizing.size, 0.25 * unit_forces(made.model))
    group = run("law: pad, shear_share: 25 %, level: DBE, brace: {ratio: 3}", shear(3)).group
    curve = np.interp(0.25, group.coords["curve_share"].values, group.variables["curve_damping"].values)
    assert curve == pytest.approx(float(str(group.attributes["damping"])), rel=1e-2)  # chords between 25 points
