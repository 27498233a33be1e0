"""The case on buckling-restrained braces against members of the same stiffness, statics, and its own forces.

The braces of the case by hand: length between work points, then area 1000 mm2 times the scale of each.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from cases.conftest import HERE

from edesign.archive.dataset import Group
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project import load_project
from edesign.project.loader import parse_project
from edesign.study.analysis.history import run_history
from edesign.study.analysis.modal import run_modal

Results = Callable[[str, str], Group]
HEIGHTS = np.array([4.0, 3.5, 3.5])
SCALES = np.array([1.7, 1.4, 0.8, 1.0, 1.0, 0.8, 0.8, 0.5, 0.5])
STOREYS = np.array([1, 2, 3, 1, 1, 2, 2, 3, 3])
WIDTHS = np.array([6.0] * 3 + [3.5] * 6)
LENGTHS = np.hypot(WIDTHS, HEIGHTS[STOREYS - 1])
E, FY, KF = 200e9, 262e6, 1.35
AREAS = 1e-3 * SCALES
STIFFNESS = KF * E * AREAS / LENGTHS
YIELDING = LENGTHS * 4.4 / 6.5
SINGLE = 1e-6
"""Histories are kept in single precision."""
CASE = HERE / "brb_frame" / "project.yaml"


def value(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values)


def test_modes_are_those_of_the_frame_with_elastic_members(results_of: Results) -> None:
    """Pin-ended members of the same E A / L in place of the braces, unloaded. To the tolerance of eigenvalues."""
    text = CASE.read_text(encoding="utf-8").replace("../records", str(HERE / "records"))
    text = text.replace("modes, kind: modal, modes: 3", "modes, kind: modal, modes: 6, state: initial")
    restrained = parse_project(text, "restrained.yaml", BuildingSections())
    members, sections = [], []
    for storey in (1, 2, 3):
        for kind, bay, at in (("rising", 1, storey - 1), ("chevron", 3, 2 * storey + 1)):
            name = f"bar_{kind}_{storey}"
            sections.append(f"  {name}: {{area: {1e6 * KF * AREAS[at]:.12g} mm^2}}")
            members.append(f"    - {{kind: {kind}, bays: {bay}, storeys: {storey}, section: {name}, material: core}}")
    before, rest = text.split("dampers:", 1)
    elastic = before.replace("materials:\n", "materials:\n  core: {law: elastic, E: 200 GPa}\n")
    elastic = elastic.replace("  releases:", "  braces:\n" + "\n".join(members) + "\n  releases:")
    elastic += "sections:\n" + "\n".join(sections) + "\n" + rest[rest.index("damping:") :]
    plain = parse_project(elastic, "elastic.yaml", BuildingSections())
    spec = restrained.analyses[0]
    one, two = (run_modal(project, spec) for project in (restrained, plain))  # type: ignore[arg-type]
    np.testing.assert_allclose(value(one, "period"), value(two, "period"), rtol=1e-9)
    assert value(results_of("brb_frame", "modes"), "period")[0] == pytest.approx(value(two, "period")[0], rel=0.01)


def test_forces_are_those_of_the_law_at_the_length_of_each_place(results_of: Results) -> None:
    """The brace of each place made anew with its own area and lengths; forces that follow the archived deformations,
    which are linear between samples here: the path inside a step hardly matters to a rate-independent law."""
    group = results_of("brb_frame", "shake")
    given = {
        **{"E": "200 GPa", "F_ysc": "262 MPa", "KF": KF, "alpha": "0.4 %"},
        **{"strain": ["0.5 %", "1 %", "2 %"], "omega": [1.12, 1.28, 1.46], "beta": [1.02, 1.06, 1.12]},
    }
    time, all_deformations = np.asarray(group.coords["time"].values), value(group, "damper_deformation")
    for i in range(9):
        own = {"A_sc": f"{AREAS[i]:.12g} m^2", "L_wp": f"{LENGTHS[i]:.12g} m", "L_y": f"{YIELDING[i]:.12g} m"}
        damper = Damper(law("buckling_restrained"), read_parameters(law("buckling_restrained"), {**given, **own}))
        u = all_deformations[:, i]
        force = damper.core.force(time, u, np.zeros_like(u))
        np.testing.assert_allclose(value(group, "damper_force")[:, i], force, rtol=0.0, atol=5e-3 * FY * AREAS[i])


def test_strains_and_ductilities_follow_from_forces_and_deformations(results_of: Results) -> None:
    group = results_of("brb_frame", "shake")
    force, u = value(group, "damper_force"), value(group, "damper_deformation")
    plastic = u - force / STIFFNESS
    strain = force / (E * AREAS) + plastic / YIELDING
    yields = FY * AREAS / STIFFNESS
    for end, of in (("max", np.max), ("min", np.min)):
        np.testing.assert_allclose(value(group, f"core_strain_{end}"), of(strain, axis=0), rtol=SINGLE)
        np.testing.assert_allclose(value(group, f"core_ductility_{end}"), of(u, axis=0) / yields, rtol=SINGLE)
    # sums from step to step miss what goes back and forth inside a step
    cumulated = np.abs(np.diff(plastic, axis=0)).sum(axis=0) / yields
    np.testing.assert_allclose(value(group, "cumulative_ductility_final"), cumulated, rtol=5e-3)
    assert np.all(cumulated > 5.0)
    np.testing.assert_allclose(value(group, "damper_yield_force"), FY * AREAS, rtol=1e-12)
    np.testing.assert_allclose(value(group, "damper_adjusted_tension"), 1.1 * 1.46 * FY * AREAS, rtol=1e-12)
    np.testing.assert_allclose(value(group, "damper_adjusted_compression"), 1.12 * 1.1 * 1.46 * FY * AREAS, rtol=1e-12)
    terms = dict(zip(group.coords["energy_term"].values, value(group, "energy_final"), strict=True))
    assert value(group, "damper_work_final").sum() == pytest.approx(terms["dampers"], rel=1e-9)


def test_horizontal_forces_of_a_storey_are_those_of_its_braces(results_of: Results) -> None:
    """Chevrons push with both braces: their compression counts against the deformation."""
    group = results_of("brb_frame", "shake")
    way = np.array([1.0, 1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    along = value(group, "damper_force") * way * WIDTHS / LENGTHS
    storeys = np.array([along[:, storey == STOREYS].sum(axis=1) for storey in (1, 2, 3)]).T
    np.testing.assert_allclose(value(group, "storey_damper_force"), storeys, rtol=0.0, atol=SINGLE * np.max(storeys))


def test_the_unbalanced_force_of_a_chevron_bends_its_beam(results_of: Results) -> None:
    """Where both braces meet the beam the shear of its halves jumps by the vertical parts of their forces; each half is
    a beam on its hinged end and on that force, under 33.6 kN/m. At the end of the push."""
    group = results_of("brb_frame", "push")
    names = [str(name) for name in group.coords["damper"].values]
    pair = [names.index("V_3_1_r"), names.index("V_3_1_f")]
    forces, sine = value(group, "damper_force_final")[pair], 4.0 / LENGTHS[3]
    up = -forces.sum() * sine
    assert forces[0] > 0.0 > forces[1] and abs(up) > 500.0  # N: in a first push both are near the yield force
    kept = [str(name) for name in group.coords[group.variables["member_shear_force"].dims[1]].values]
    halves = [kept.index("B_3_1_1"), kept.index("B_3_1_2")]
    shear = value(group, "member_shear_force")[-1, halves]
    moment = value(group, "member_bending_moment")[-1, halves]
    assert shear[0, 1] + shear[1, 0] == pytest.approx(up, abs=SINGLE * 120e3)
    expected = 33.6e3 * 7.0**2 / 8.0 - up * 7.0 / 4.0
    np.testing.assert_allclose(np.abs([moment[0, 1], moment[1, 0]]), abs(expected), rtol=SINGLE)


def test_the_history_converges_with_the_square_of_the_step() -> None:
    """The trapezoidal rule is of second order; where braces yield inside a step the order wavers: halves of 0.01 s
    leave less than a third each. The braces themselves are exact along any path."""
    project = load_project(CASE, BuildingSections())
    displacements = {}
    for parts in (1, 2, 4, 16):
        fine = project.with_values({"integration.time_step": f"{0.01 / parts} s", "outputs.every": parts})
        group = run_history(fine, fine.analyses[2])  # type: ignore[arg-type]
        displacements[parts] = value(group, "floor_displacement")
    size = np.max(np.abs(displacements[16]))
    errors = [np.max(np.abs(displacements[parts] - displacements[16])) / size for parts in (1, 2, 4)]
    assert errors[0] < 0.1
    assert errors[1] < errors[0] / 3.0 and errors[2] < errors[1] / 3.0


def test_a_frame_that_stands_by_its_braces(results_of: Results) -> None:
    """Chevrons carry what the middle of a continuous beam brings: more than half of the load on a bay, as over two
    hinged beams, and less than the 5/8 of a rigid support. Histories begin from there."""
    gravity = results_of("brb_pinned", "gravity")
    feet = 0.3048 * 25.0
    load = (85.0 + 0.25 * 50.0) * 30.0 * 4.4482216 / 0.3048  # N/m
    assert value(gravity, "reaction_y_final").sum() == pytest.approx(2 * 2 * load * feet, rel=1e-7)
    forces = value(gravity, "damper_force_final")
    for storey, height in enumerate((14.0, 12.0)):
        sine = height / np.hypot(12.5, height)
        brought = -forces[4 * storey :][:4].sum() * sine / 2.0  # of two braces
        assert 0.5 * load * feet < brought < 0.625 * load * feet
    assert value(results_of("brb_pinned", "shake"), "damper_force")[0] == pytest.approx(forces, rel=1e-5)
