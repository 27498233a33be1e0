"""Design of dampers against closed forms, explicit matrices, the core's own modes, and a free vibration of the core."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from design_examples import design, shear_project, thesis_project
from hypothesis import given
from hypothesis import strategies as st
from scipy import linalg
from shear_frames import HEIGHT, MASS, STIFFNESS

from edesign.codes.asce7 import largest_property_factor, smallest_property_factor
from edesign.codes.ec8 import damping_correction
from edesign.codes.ec8.analysis.lateral_force import correction_factor, is_applicable, lateral_forces
from edesign.core import Channel, Newmark
from edesign.damper import sizing as s
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project.dampers.designs import SimplifiedDesign, StrainEnergyDesign
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.study.analysis.structure import make_structure
from edesign.study.design.building import make_building
from edesign.study.design.damping import modal_damping
from edesign.study.design.design import DesignResult, run_design
from edesign.study.design.elastomer.designer import ElastomerDesigner
from edesign.study.design.elastomer.distribution import least_area
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.model import ElastomerModel, Layers
from edesign.study.design.elastomer.simplified import static_response
from edesign.study.design.estimate import cqc

N = 0.35
COMMON = "law: rubber, kind: storey, bays: 1, strain: 20 %, layer_thickness: 20 mm, state: initial"
FIXED = "properties: {G_storage: 1 MPa, loss_factor: 0.35}"
stiffnesses = st.floats(1e5, 1e9)


def run(text: str, storeys: int = 3) -> DesignResult:
    project = shear_project(storeys)
    return run_design(project, "tried", design(f"{COMMON}, {text}", project), Path("."))


def shear_matrices(k: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mass and stiffness of a chain of storeys."""
    above = np.append(k[1:], 0.0)
    return MASS * np.eye(k.size), np.diag(k + above) - np.diag(above[:-1], 1) - np.diag(above[:-1], -1)


# --- equations


@given(k_d=stiffnesses, k_b=stiffnesses, n=st.floats(0.01, 2.0))
def test_brace_and_damper_are_in_series(k_d: float, k_b: float, n: float) -> None:
    damper = k_d * (1.0 + 1j * n)
    np.testing.assert_allclose(s.in_series(damper, k_b), 1.0 / (1.0 / damper + 1.0 / k_b), rtol=1e-12)
    assert s.in_series(damper, math.inf) == damper


@given(n=st.floats(0.05, 1.5), share=st.floats(0.02, 0.98), brace=st.sampled_from([1.0, 7.0, 30.0, math.inf]))
def test_stiffness_for_a_damping_gives_that_damping(n: float, share: float, brace: float) -> None:
    target = share * s.largest_damping(n, brace)
    K = s.in_series(s.stiffness_ratio(target, n, brace) * (1.0 + 1j * n), brace)
    assert K.imag / (2.0 * (1.0 + K.real)) == pytest.approx(target, rel=1e-9)


@pytest.mark.parametrize("brace", [1.0, 7.0, 1e9])
def test_largest_damping_is_the_maximum_over_all_dampers(brace: float) -> None:
    K = s.in_series(np.geomspace(1e-3, 1e7, 200_001) * (1.0 + 1j * N), brace)
    assert s.largest_damping(N, brace) == pytest.approx(np.max(K.imag / (2.0 * (1.0 + K.real))), rel=1e-6)


def test_a_damping_beyond_the_material_is_refused() -> None:
    with pytest.raises(InputError, match=r" 17.5 %.*E-DESIGN-04"):
        s.stiffness_ratio(0.175, N)
    with pytest.raises(InputError, match="brace 7 times .*E-DESIGN-04"):
        s.stiffness_ratio(0.12, N, 7.0)


def test_property_factors_of_asce_7() -> None:
    assert largest_property_factor(1.4, 1.1, 1.15) == pytest.approx(1.3 * 1.1 * 1.15)
    assert largest_property_factor() == 1.2
    assert smallest_property_factor(0.8, 0.9, 0.85) == pytest.approx(0.85 * 0.9 * 0.85)
    assert smallest_property_factor() == 0.85
    with pytest.raises(InputError, match=" test is 0.9; .*E-VALUE-02"):
        largest_property_factor(test=0.9)


def test_lateral_forces_of_ec8() -> None:
    forces = lateral_forces(100.0, np.array([2.0, 1.0]), np.array([3.0, 6.0]))
    np.testing.assert_allclose(forces, [50.0, 50.0])
    assert (correction_factor(1.2, 0.6, 3), correction_factor(1.21, 0.6, 3), correction_factor(1.0, 0.6, 2)) == (
        0.85,
        1,
        1,
    )
    assert is_applicable(2.0, 0.6) and not is_applicable(2.01, 0.6) and not is_applicable(1.7, 0.4)


# --- modes with dampers


def test_dampers_in_proportion_to_the_storeys() -> None:
    # K_D = r K_S: all modes have n/2 r/(1+r), and complex frequencies omega sqrt(1 + r (1 + i n))
    group = run(f"method: strain_energy, damping: 9 %, {FIXED}").group
    r = 0.18 / (N - 0.18)
    np.testing.assert_allclose(group.variables["computed_storey_stiffness"].values, STIFFNESS, rtol=1e-6)
    np.testing.assert_allclose(group.variables["damper_stiffness"].values, r * STIFFNESS, rtol=1e-6)
    for name in ("damping_strain_energy", "damping_frequencies"):
        np.testing.assert_allclose(group.variables[name].values, 0.09, rtol=1e-6)
    exact = math.sin(0.5 * math.atan(N * r / (1.0 + r)))
    np.testing.assert_allclose(group.variables["damping_complex"].values, exact, rtol=1e-6)


def model_of(text: str, project: Project) -> ElastomerModel:
    """The dampers of a design in the frame."""
    spec = design(text, project)
    assert isinstance(spec, StrainEnergyDesign | SimplifiedDesign)
    return ElastomerDesigner(project, "tried", spec, Path("."), lambda text: None).model


@pytest.mark.parametrize("brace", [None, np.array([2.0, 5.0, 1.0]) * STIFFNESS])
def test_unequal_dampers_against_explicit_matrices(brace: np.ndarray | None) -> None:
    project = shear_project(3)
    model = model_of(f"{COMMON}, method: strain_energy, damping: 5 %, {FIXED}", project)
    model.brace = brace
    k_D = np.array([0.2, 3.0, 1.0]) * STIFFNESS
    found = modal_damping(model.building.frame, model.bare, model.stiffness(k_D, N))
    damper = k_D * (1.0 + 1j * N)
    added = damper if brace is None else 1.0 / (1.0 / damper + 1.0 / brace)
    M, K = shear_matrices(np.full(3, STIFFNESS))
    _, K_D = shear_matrices(added)
    omega2, shapes = linalg.eigh(K + K_D.real, M)
    np.testing.assert_allclose(found.omega, np.sqrt(omega2), rtol=1e-6)
    energy = [0.5 * (v @ K_D.imag @ v) / (v @ (K + K_D.real) @ v) for v in shapes.T]
    np.testing.assert_allclose(found.strain_energy, energy, rtol=1e-6)
    root = np.sqrt(linalg.eigvals(K + K_D, M))
    root = root[np.argsort(np.abs(root))]
    np.testing.assert_allclose(found.complex, root.imag / np.abs(root), rtol=1e-6)


def test_condensed_frame_against_the_modes_of_the_core() -> None:
    # chevrons of the thesis' frame in two bays: all degrees of freedom, factorised with the dampers
    project = thesis_project()
    text = "method: strain_energy, law: elastomer, kind: chevron, bays: [1, 3], damping: 10 %, strain: 20 %"
    spec = design(f"{text}, layer_thickness: 70 mm, {FIXED}, brace: {{ratio: 7}}", project)
    result = run_design(project, "tried", spec, Path("."))
    building = make_building(project, "tried", spec)
    structure = make_structure(project.model_copy(update={"dampers": result.dampers}), dampers=True)
    structure.apply_gravity()
    k_D, k_S = (result.group.variables[name].values for name in ("damper_stiffness", "storey_stiffness"))
    series = [1.0 / (1.0 / (0.5 * k * (1.0 + 0.35j)) + 1.0 / (3.5 * b)) for k, b in zip(k_D, k_S, strict=True)]
    stiffness = np.repeat(series, 2)  # of each of the two places
    modes = structure.modes(3, stiffness.real)
    np.testing.assert_allclose(result.group.variables["period"].values[1], modes.period, rtol=1e-9)
    deformation = modes.equations @ structure.analysis.damper_directions().T
    damping = 0.5 * (np.asarray(deformation) ** 2 @ stiffness.imag) / modes.omega**2
    np.testing.assert_allclose(result.group.variables["damping_strain_energy"].values[1], damping, rtol=1e-8)
    np.testing.assert_allclose(building.cosine, 1.0)
    assert [device.brace for device in structure.frame.devices][::2] == pytest.approx(3.5 * k_S)


def test_designed_dampers_let_a_free_vibration_decay_as_designed() -> None:
    # a damper of a spring and a dashpot, by its law: K'' / 2 K' of all is the ratio of a viscous oscillator
    project = shear_project(1)
    spec = design(f"{COMMON}, method: strain_energy, damping: 10 %, properties: law", project)
    result = run_design(project, "tried", spec, Path("."))
    structure = make_structure(project.model_copy(update={"dampers": result.dampers}), dampers=True)
    analysis = structure.analysis
    analysis.install_dampers()
    period = float(result.group.variables["period"].values[1, 0])
    velocity = np.zeros(analysis.n_equations)
    top = structure.frame.nodes["A1"]
    velocity[analysis.equations[top, 0]] = 0.1
    analysis.initial_velocity(velocity)
    channel = Channel("u", ((1.0, "displacement", top, 0),))
    steps = 4000
    response = analysis.history(np.zeros(4 * steps + 1), period / steps, Newmark(), [channel])
    u, t = response.values["u"], response.time
    crossing = np.flatnonzero((u[:-1] < 0.0) & (u[1:] >= 0.0))
    zeros = t[crossing] - u[crossing] * (t[1] - t[0]) / (u[crossing + 1] - u[crossing])
    peaks = [u[(t > a) & (t < b)].max() for a, b in zip(zeros, zeros[1:], strict=False)]
    decrement = math.log(peaks[0] / peaks[1])
    ratio = decrement / math.hypot(2.0 * math.pi, decrement)
    assert ratio == pytest.approx(0.10, rel=1e-4)  # peaks between steps of T/4000 are missed by 1e-6
    assert zeros[1] - zeros[0] == pytest.approx(period / math.sqrt(1.0 - 0.01), rel=1e-5)
    assert result.group.attributes["law_damping_strain_energy"] == pytest.approx(0.10, rel=1e-5)
    assert result.group.attributes["frequency_Hz"] == pytest.approx(1.0 / period, rel=1e-6)


@pytest.mark.parametrize("distribution", ["uniform", "strain_energy"])
def test_distributions_reach_the_target_in_the_first_mode(distribution: str) -> None:
    group = run(f"method: strain_energy, damping: 9 %, distribution: {distribution}, {FIXED}").group
    assert group.variables["damping_strain_energy"].values[0, 0] == pytest.approx(0.09, rel=1e-9)
    k_D = group.variables["damper_stiffness"].values
    _, K = shear_matrices(np.full(3, STIFFNESS))
    shape = linalg.eigh(K)[1][:, 0]
    pattern = np.diff(shape, prepend=0.0) ** 2 if distribution == "strain_energy" else np.ones(3)
    np.testing.assert_allclose(k_D / k_D[0], pattern / pattern[0], rtol=1e-6)


# --- response


def test_estimate_of_one_storey() -> None:
    project = shear_project(1)
    text = f"{COMMON}, method: strain_energy, damping: 10 %, level: DBE, inherent_damping: 2 %, {FIXED}"
    spec = design(f"{text}, brace: {{ratio: 4}}, braces_in_target: false", project)
    result = run_design(project, "tried", spec, Path("."))
    model = model_of(f"{text}, brace: {{ratio: 4}}, braces_in_target: false", project)
    assert model.action is not None
    damper, brace = STIFFNESS * 0.2 / (N - 0.2) * (1.0 + 1j * N), 4.0 * STIFFNESS
    added = 1.0 / (1.0 / damper + 1.0 / brace)
    omega = math.sqrt((STIFFNESS + added.real) / MASS)
    damping = 0.02 + added.imag / (2.0 * (STIFFNESS + added.real))
    T = 2.0 * math.pi / omega
    assert 0.2 < T < 0.6  # on the plateau
    u = 0.36 * 9.80665 * 1.15 * 2.5 * damping_correction(damping) / omega**2
    found = model.estimate(Layers(np.array([added]), np.array([brace]), 0.02), model.action)
    assert found.roof_displacement == pytest.approx(u, rel=1e-6)
    assert found.drift[0] == pytest.approx(u / HEIGHT, rel=1e-6)
    assert found.base_shear == pytest.approx((STIFFNESS + added.real) * u, rel=1e-6)
    assert found.storey_shear[0] == pytest.approx(STIFFNESS * u, rel=1e-6)
    assert found.damper_force[0] == pytest.approx(abs(added) * u, rel=1e-6)
    assert found.dampers["strain"][0] == pytest.approx(abs(added / damper) * u / 0.02, rel=1e-6)
    assert result.group.variables["estimated_storey_drift"].values[0] == pytest.approx(u / HEIGHT, rel=1e-6)


@pytest.mark.parametrize(("beta", "more"), [(1.45, False), (1.55, True)])
def test_dampers_that_stiffen_more_than_they_damp(beta: float, more: bool) -> None:
    """One storey under S_e = a/T: V goes as sqrt(1 + beta) eta, with zeta = 2 % + n/2 beta/(1 + beta). It is that of
    the bare frame at beta = 50 n / (5 + 2) - 1 = 1.5, and larger beyond."""
    table = "{periods: [0 s, 0.01 s, 9 s], accelerations: [0.1 g, 9 g, 0.01 g]}"
    hazard = "damping: 5 %\n  damping_correction: ec8\n  levels: {DBE: {spectrum: @}}\nrecords".replace("@", table)
    text = re.sub(r"code: ec8-2004.*?\nrecords", f"code: user\n  {hazard}", shear_project(1).text, flags=re.DOTALL)
    project = parse_project(text, "project.yaml", profile_names())
    damping = 100.0 * 0.5 * N * beta / (1.0 + beta)
    asked = f"method: strain_energy, damping: {damping!r} %, level: DBE, inherent_damping: 2 %, {FIXED}"
    result = run_design(project, "tried", design(f"{COMMON}, {asked}", project), Path("."))
    warnings = result.group.attributes["warnings"]
    assert result.group.variables["damper_stiffness"].values[0] == pytest.approx(beta * STIFFNESS, rel=1e-6)
    assert any(f"with k_D of up to {beta:g} times the stiffness of a storey" in text for text in warnings) == more
    reached = result.group.attributes["estimated_strain"]
    most = f"G' would be {0.2 / reached:.3g} times that value, outside 0.85 to 1.2"
    assert any("where alone the given `properties` hold" in text and most in text for text in warnings)


def test_correlation_of_modes() -> None:
    # Chopra (2012), Table 13.7.1: 5 % damping, frequency ratio 0.9 gives 0.473 (Eq. 13.7.10 to three digits)
    beta, zeta = 0.9, 0.05
    expected = 8 * zeta**2 * (1 + beta) * beta**1.5 / ((1 - beta**2) ** 2 + 4 * zeta**2 * beta * (1 + beta) ** 2)
    found = cqc(np.array([0.9, 1.0]), np.array([zeta, zeta]))
    np.testing.assert_allclose(np.diag(found), 1.0)
    assert found[0, 1] == pytest.approx(expected) == found[1, 0]


def test_static_response_of_the_simplified_method() -> None:
    project = shear_project(2)
    text = f"{COMMON}, method: simplified, level: DBE, drift: 1 %, inherent_damping: 5 %, forces: heights, {FIXED}"
    model = model_of(text, project)
    assert isinstance(model.spec, SimplifiedDesign)
    beta, alpha = 1.5, 10.0
    fixed = Moduli(1e6, N)
    found = static_response(model, model.spec, lambda f: fixed, beta * np.full(2, STIFFNESS))
    added = 1.0 / (1.0 / (beta * (1.0 + 1j * N)) + 1.0 / alpha)
    omega = math.sqrt((3.0 - math.sqrt(5.0)) / 2.0 * (1.0 + added.real) * STIFFNESS / MASS)  # of two equal storeys
    T, damping = 2.0 * math.pi / omega, 0.05 + added.imag / (2.0 * (1.0 + added.real))
    assert 0.2 < T < 0.6  # on the plateau
    V = 0.36 * 9.80665 * 1.15 * 2.5 * damping_correction(damping) * 2.0 * MASS  # lambda 1: two storeys
    assert found.base_shear == pytest.approx(V, rel=1e-6)
    drifts = np.array([V, 2.0 / 3.0 * V]) / ((1.0 + added.real) * STIFFNESS) / HEIGHT  # heights 1 : 2
    np.testing.assert_allclose(found.drift, drifts, rtol=1e-6)


def test_simplified_method_takes_the_least_beta() -> None:
    text = f"method: simplified, level: DBE, drift: 1.1 %, beta: [0.5, 5], beta_step: 0.25, {FIXED}"
    result = run(text)
    assert result.status == "completed"
    drifts = result.group.variables["iteration_drift"].values
    betas = result.group.variables["iteration_beta"].values
    assert np.all(drifts[:-1] > 0.011) and drifts[-1] <= 0.011 and drifts.size > 1
    np.testing.assert_allclose(np.diff(betas), 0.25)
    np.testing.assert_allclose(result.group.variables["damper_stiffness"].values, betas[-1] * STIFFNESS, rtol=1e-6)
    failed = run(text.replace("1.1 %", "0.1 %"))
    assert failed.status == "failed" and "no beta up to 5 meets the drift of 0.1 %" in failed.reason


def test_least_area_against_all_distributions_of_a_grid() -> None:
    project = shear_project(2)
    model = model_of(f"{COMMON}, method: strain_energy, damping: 5 %, level: DBE, {FIXED}", project)
    action, limit = model.action, 0.012
    assert action is not None
    best = least_area(model, Moduli(1e6, N), limit, 0.02) / STIFFNESS

    def drift(x: np.ndarray) -> float:
        return float(model.estimate(Layers(model.stiffness(x * STIFFNESS, N), None, 0.02), action).drift.max())

    assert drift(best) <= limit * (1.0 + 1e-6)
    axis = np.linspace(1e-3, 1.5 * best.sum(), 50)
    cheaper = [x for x in (np.array([a, b]) for a in axis for b in axis) if x.sum() < best.sum() * (1.0 - 1e-6)]
    assert len(cheaper) > 500 and all(drift(x) > limit for x in cheaper)


def test_bounds_enclose_the_design() -> None:
    bounds = "bounds: {upper: 1.5, lower: 0.7}"
    group = run(f"method: strain_energy, damping: 8 %, level: DBE, {bounds}, {FIXED}").group
    np.testing.assert_allclose(group.variables["bound_stiffness_ratio"].values, [0.7, 1.0, 1.5])
    r = 0.16 / (N - 0.16) * np.array([0.7, 1.0, 1.5])
    np.testing.assert_allclose(group.variables["bound_damping"].values, 0.5 * N * r / (1.0 + r), rtol=1e-6)
    assert group.attributes["governing"]["storey_drift"] == "lower"
    assert group.attributes["governing"]["damper_force"] == "upper"


def test_devices_of_a_design_stand_in_a_project_file() -> None:
    project = thesis_project()
    text = "method: strain_energy, law: elastomer, kind: rising, bays: [1, 3], storeys: 2-9, damping: 6 %, strain: 20 %"
    result = run_design(
        project, "tried", design(f"{text}, layer_thickness: 70 mm, {FIXED}, brace: {{ratio: 7}}", project), Path(".")
    )
    block = "".join(f"  {line}\n" for line in str(result.group.attributes["devices"]).splitlines())
    before, _, laws = project.text.partition("\ndampers:")
    del laws
    law = "  laws: {elastomer: {type: mgmm, parameters: thesis_table_4_2, prototype: "
    law += "{layers: 2, layer_area: 41400 mm^2, layer_thickness: 12 mm}}}\n"
    rest = "" if "\nanalyses:" in before else "analyses: [{name: modes, kind: modal, modes: 1}]\n"
    again = parse_project(f"{before}\ndampers:\n{law}{block}{rest}", project.path)
    by_file = make_structure(again, dampers=True).frame.devices
    by_design = make_structure(project.model_copy(update={"dampers": result.dampers}), dampers=True).frame.devices
    assert by_file == by_design and len(by_file) == 16
    # horizontal stiffness: each diagonal by the square of its cosine
    k = 1e6 * np.array(result.dampers.devices[0].layer_area) * 2 / 0.07
    np.testing.assert_allclose(2 * k * 7.2**2 / (7.2**2 + 3.5**2), result.group.variables["damper_stiffness"].values)


@pytest.mark.parametrize("kind", ["falling", "chevron_braces"])
def test_dampers_that_shorten_as_a_storey_drifts_take_their_share_of_its_shear(kind: str) -> None:
    """The shear of the columns of a symmetric frame with falling dampers is that with rising ones."""
    project = shear_project(3)
    text = f"{COMMON}, method: strain_energy, damping: 9 %, {FIXED}, level: DBE"
    shears = {}
    for one in ("rising", kind):
        group = run_design(project, "tried", design(text.replace("storey", one), project), Path(".")).group
        shears[one] = group.variables["estimated_column_shear"].values
    assert shears[kind] == pytest.approx(shears["rising"], rel=1e-6)
