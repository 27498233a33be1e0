"""Designs of dampers of buildings along one direction, by all methods.

References: the design of the plane frame of which a building is rows; matrices by hand of a floor on cantilevers whose
centres of mass and stiffness lie apart (Chopra, Dynamics of Structures, 4th edition, section 9.6), and their complex
eigenvalues; the same building turned by a quarter.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from building_examples import changed
from design_examples import design
from scipy import linalg
from verification.test_verify_shaken_buildings import TABLE, UNEQUAL, unequal_floor

from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.steel_section import steel_section
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building import parse_building
from edesign.project.loader import parse_project
from edesign.study.analysis.leading_mode import torsional_ratios
from edesign.study.analysis.structure import make_structure
from edesign.study.design.building import make_building
from edesign.study.design.condensed import condense
from edesign.study.design.design import DesignResult, first_warnings, run_design
from edesign.study.design.plausibility import shared_mode
from edesign.study.design.viscous.dashpot_modes import dashpot_modes

COMMON = """\
elements: {geometry: {columns: linear}}
hazard: {code: ec8-2004, a_gR: 0.36 g, ground: C, spectrum: 1, levels: {DBE: {gamma_I: 1.0}}}
damping: {kind: rayleigh, ratio: 3 %, periods: [0.9 s, 0.2 s]}
dampers:
  laws:
    oil: {type: viscous, parameters: {c: 100 kN*s/m}}
    oil4: {type: viscous_power, parameters: {c: 100 kN*(s/m)^0.4, alpha: 0.4}}
    steel: {type: elastic_plastic, parameters: {k: 50 kN/mm, Fy: 120 kN, b: 0.02}}
    rubber: {type: kelvin_voigt, parameters: {k: 2 kN/mm, c: 200 kN*s/m},
      prototype: {layers: 2, layer_area: 0.01 m^2, layer_thickness: 10 mm}}
"""
_COLUMN, _BEAM = steel_section("HEB240"), steel_section("IPE300")
FRAME = f"""\
edesign: 1
title: A plane frame
frame:
  bays: [6 m, 4 m]
  storeys: [4 m, 3.5 m, 3.2 m]
  diaphragms: all
  columns: [{{storeys: all, section: column, material: S275}}]
  beams: [{{floors: all, section: beam, material: S275}}]
materials: {{S275: {{law: elastic, E: 210 GPa}}}}
sections:
  column: {{area: {_COLUMN.A!r} m^2, inertia: {_COLUMN.I_y!r} m^4}}
  beam: {{area: {_BEAM.A!r} m^2, inertia: {_BEAM.I_y!r} m^4}}
masses: {{given: [{{lines: all, floors: all, mass: 8 t}}], directions: horizontal}}
analyses: [{{name: modes, kind: modal, modes: 3}}]
{COMMON}"""
ROWS = f"""\
edesign_building: 1
title: Three rows of the frame
plan: {{x: [6 m, 4 m], y: [5 m, 5 m]}}
storeys: [4 m, 3.5 m, 3.2 m]
columns: [{{section: HEB240, material: S275, strong: x}}]
beams:
  - {{along: x, section: IPE300, material: S275}}
  - {{along: y, section: IPE240, material: S275}}
materials: {{S275: {{fy: 275 MPa, law: elastic}}}}
loads: {{self_weight: false}}
masses: {{given: [{{at: all, floors: all, mass: 8 t}}]}}
{COMMON}"""
TURNED = (
    ROWS.replace("x: [6 m, 4 m], y: [5 m, 5 m]", "x: [5 m, 5 m], y: [6 m, 4 m]")
    .replace("strong: x", "strong: y")
    .replace("along: x", "along: z")
    .replace("along: y", "along: x")
    .replace("along: z", "along: y")
)
METHODS = {
    "viscous": "method: viscous, law: oil, kind: chevron, bays: 1, damping: 15 %, brace: {ratio: 10}",
    "alpha": "method: viscous, law: oil4, kind: rising, bays: 1, damping: 15 %, amplitude: spectrum, level: DBE,"
    " brace: {ratio: 10}",
    "pattern": "method: viscous, law: oil4, kind: chevron, bays: all, damping: 12 %, amplitude: {drift: 1 %},"
    " distribution: strain_energy",
    "least c": "method: viscous, law: oil4, kind: chevron, bays: 1, drift: 1.2 %, level: DBE, amplitude: spectrum,"
    " distribution: least_coefficient",
    "share": "method: hysteretic, law: steel, kind: chevron, bays: 1, shear_share: 20 %, level: DBE, brace: {ratio: 9}",
    "loops": "method: hysteretic, law: steel, kind: falling, bays: 1, damping: 6 %, level: DBE,"
    " equivalent_damping: average",
    "Eq. 5.9": "method: strain_energy, law: rubber, kind: chevron, bays: 1, damping: 10 %, strain: 20 %,"
    " layer_thickness: 20 mm, brace: {ratio: 7}, level: DBE, bounds: {upper: 1.2, lower: 0.85}",
    "first mode": "method: strain_energy, law: rubber, kind: storey, bays: 1, damping: 10 %, strain: spectrum,"
    " layer_thickness: 20 mm, target_in: first_mode, level: DBE",
    "least area": "method: strain_energy, law: rubber, kind: chevron, bays: 1, drift: 1 %, strain: 20 %,"
    " layer_thickness: 20 mm, distribution: least_area, level: DBE",
    "simplified": "method: simplified, law: rubber, kind: chevron, bays: 1, drift: 1 %, strain: 20 %,"
    " layer_thickness: 20 mm, level: DBE",
}
SIZES = ("damping_coefficient", "yield_force", "damper_stiffness")
"""Of all dampers of a storey, by any method."""
SHARED = ("brace_stiffness", "computed_storey_stiffness", "estimated_column_shear", "storey_shear")
"""What a row has a third of, beside the sizes."""
ALIKE = ("bare_period", "period", "estimated_storey_drift", "damping_complex", "damping_strain_energy", "bound_damping")


def made(text: str, file: AnalysisFile) -> DesignResult:
    return run_design(file, "tried", design(f"{text}, state: initial", file), Path("."))


def building(text: str) -> AnalysisFile:
    return parse_building(text, "building.yaml", BuildingSections())


@pytest.mark.parametrize("name", METHODS)
def test_rows_of_a_frame_get_the_dampers_of_the_frame(name: str) -> None:
    """1e-10: eigenvalues of two solvers that agree to 1e-13, and iterations that end alike; observed 2e-13."""
    plane = made(METHODS[name], parse_project(FRAME, "project.yaml", profile_names())).group
    space = made(f"{METHODS[name]}, along: x, frames: all", building(ROWS)).group
    assert plane.attributes["status"] == space.attributes["status"] == "completed"
    compared = [key for key in (*SIZES, *SHARED) if key in plane.variables]
    assert sum(key in SIZES for key in compared) == 1
    for key in compared:
        assert space.variables[key].values == pytest.approx(3.0 * plane.variables[key].values, rel=1e-10), key
    for key in ALIKE:
        if key in plane.variables:
            assert space.variables[key].values == pytest.approx(plane.variables[key].values, rel=1e-10), key


@pytest.mark.parametrize("name", METHODS)
def test_a_turned_building_gets_the_same_dampers(name: str) -> None:
    """1e-10: as above. Frames at the edges alone, whose dampers brake turns too."""
    here = made(f"{METHODS[name]}, along: x, frames: [X1, X3]", building(ROWS)).group
    there = made(f"{METHODS[name]}, along: y, frames: [A, C]", building(TURNED)).group
    size = next(key for key in SIZES if key in here.variables)
    for key in (size, "plan_period", "plan_damping", "period", "computed_storey_stiffness"):
        assert there.variables[key].values == pytest.approx(here.variables[key].values, rel=1e-10), key
    for one, other in (("x", "y"), ("y", "x"), ("turn", "turn")):
        ratios = (found.variables[f"plan_mass_ratio_{axis}"].values for found, axis in ((here, one), (there, other)))
        assert next(ratios) == pytest.approx(next(ratios), abs=1e-10)


SETBACK = (
    "storeys: [4 m, 3.5 m, 3.2 m]\n",
    "storeys: [4 m, 3.5 m, 3.2 m]\nsetbacks: [{floors: 3, bays: {x: all, y: 1}}]\n",
)


@pytest.mark.parametrize("name", ["alpha", "pattern", "loops", "Eq. 5.9"])
def test_a_turned_setback_gets_the_same_dampers(name: str) -> None:
    """Centres of mass of the floors lie apart across the design, so that turns take part in drifts and modes."""
    texts = (changed(ROWS, SETBACK), changed(TURNED, (SETBACK[0], SETBACK[1].replace("x: all, y: 1", "x: 1, y: all"))))
    here = made(f"{METHODS[name]}, along: x, frames: [X1, X2]", building(texts[0])).group
    there = made(f"{METHODS[name]}, along: y, frames: [A, B]", building(texts[1])).group
    size = next(key for key in SIZES if key in here.variables)
    for key in (size, "plan_period", "plan_damping", "period", "computed_storey_stiffness", "estimated_storey_drift"):
        if key in here.variables:
            assert there.variables[key].values == pytest.approx(here.variables[key].values, rel=1e-9), key
    assert here.variables["plan_mass_ratio_turn"].values[int(here.attributes["leading_mode"]) - 1] > 1e-3


def test_a_drift_is_that_at_the_centre_of_mass_above() -> None:
    """By the displacements of two column lines of each rigid floor, in the modes of the core."""
    file = building(changed(ROWS, SETBACK))
    structure = make_structure(file)
    frame = condense(structure)
    modes, core = frame.modes(), structure.modes(6)
    assert modes.omega[:6] == pytest.approx(core.omega, rel=1e-9)
    ratios = np.column_stack([core.effective_mass_ratio[:, :2], torsional_ratios(structure.frame, core)])
    assert frame.mass_ratios(modes)[:6] == pytest.approx(ratios, abs=1e-9)
    centres = [structure.frame.places[f"floor.{floor}"][1] for floor in (1, 2, 3)]
    for mode in range(6):
        before = np.zeros(2)
        for floor, centre in enumerate(centres, start=1):
            here = np.array([core.shapes[mode, structure.frame.nodes[f"A{line}.{floor}"], 0] for line in (1, 2)])
            at = [before, here]
            drift = np.diff([u[0] + (u[1] - u[0]) * centre / 5.0 for u in at])
            scale = np.abs(core.shapes[mode, :, :2]).max()
            assert abs(modes.storeys[mode, floor - 1]) == pytest.approx(abs(drift[0]), abs=1e-7 * scale)
            before = here


# --- a floor that turns as it moves

LAWS = "dampers: {laws: {oil: {type: viscous, parameters: {c: 1 kN*s/m}}}}\n"
LEVERS = {"X1": 0.0, "X2": 5.0}
"""y of the frames along x, m."""


def table() -> AnalysisFile:
    text = changed(
        TABLE, *UNEQUAL, ("damping: {kind: rayleigh, ratio: 3 %, periods: [0.6 s, 0.15 s]}", "damping: {kind: none}")
    )
    kept = [line for line in text.splitlines() if "both:" not in line and "one:" not in line and "shaken" not in line]
    return building("\n".join(line for line in kept if line not in ("records:", "analyses:")) + "\n" + LAWS)


def by_hand(frames: dict[str, float]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Mass, stiffness, and damping of dampers of coefficients in frames along x, (3, 3) each: x, y and the turn."""
    floor = unequal_floor()
    masses = {"A1": 8e3, "A2": 8e3, "B1": 8e3, "B2": 14e3}
    centre = (masses["A2"] + masses["B2"]) * 5.0 / sum(masses.values())
    rows = np.array([[1.0, 0.0, -(LEVERS[frame] - centre)] for frame in frames])
    return floor.M, floor.K, rows.T @ np.diag(list(frames.values())) @ rows


def complex_modes(M: np.ndarray, K: np.ndarray, C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Eigenvalues that oscillate, in rising order of size, and their shapes, (3,) and (3, 3)."""
    n = len(M)
    state = np.block([[np.zeros((n, n)), np.eye(n)], [-np.linalg.solve(M, K), -np.linalg.solve(M, C)]])
    s, vectors = linalg.eig(state)
    upper = np.flatnonzero(s.imag > 0.0)
    upper = upper[np.argsort(np.abs(s[upper]))]
    return s[upper], vectors[:n, upper].T


def damping_ratios(M: np.ndarray, K: np.ndarray, C: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Ratios of the complex modes, in rising order of size, and their shapes, (3,) and (3, 3)."""
    s, shapes = complex_modes(M, K, C)
    return -s.real / np.abs(s), shapes


def shares(M: np.ndarray, K: np.ndarray, C: np.ndarray) -> np.ndarray:
    """Of the complex modes in the guided vibration along x, (3,): see docs/how_to/damper_design.md."""
    mass, c = M[0, 0], C[0, 0]
    s, shapes = complex_modes(M, K, C)
    guided = -c / (2.0 * mass) + 1.0j * np.sqrt(K[0, 0] / mass - (c / (2.0 * mass)) ** 2)

    def part(s: complex, phi: np.ndarray) -> complex:
        common = (C[0] + (s + guided) * M[0]) @ phi
        return complex(phi[0] * common / (phi @ (2.0 * s * M + C) @ phi))

    parts = [abs(part(of, phi) + part(of.conj(), phi.conj())) for of, phi in zip(s, shapes, strict=True)]
    return np.array(parts) / np.sum(parts)


@pytest.mark.parametrize("frames", ["all", "X1", "X2"])
@pytest.mark.parametrize("target", [0.05, 0.2])
def test_an_eccentric_floor_has_the_damping_of_the_design(frames: str, target: float) -> None:
    """The mean of the modes by their shares, by matrices by hand; 1e-7: the core's stiffness of cantilevers."""
    chosen = list(LEVERS) if frames == "all" else [frames]
    text = f"method: viscous, law: oil, kind: storey, along: x, frames: {frames}, bays: 1, damping: {target}"
    found = made(text, table()).group
    coefficient = float(found.variables["damping_coefficient"].values[0]) / len(chosen)
    M, K, C = by_hand(dict.fromkeys(chosen, coefficient))
    ratios, _ = damping_ratios(M, K, C)
    assert shares(M, K, C) @ ratios == pytest.approx(target, rel=1e-7)
    omega2, undamped = linalg.eigh(K, M)
    share = (undamped.T @ M[0]) ** 2 / M[0, 0]
    assert found.attributes["leading_mode"] == share.argmax() + 1
    assert found.variables["plan_period"].values == pytest.approx(2.0 * np.pi / np.sqrt(omega2), rel=1e-7)
    assert shares(M, K, 1e-9 * C) == pytest.approx(share, abs=1e-6)  # effective masses


def test_each_mode_is_damped_by_strain_energy_to_first_order() -> None:
    """Dashpots of half the size leave a quarter of the distance from the complex eigenvalues, relative to these."""
    text = "method: viscous, law: oil, kind: storey, along: x, frames: X2, bays: 1, damping: "
    apart: list[np.ndarray] = []
    for target in (0.01, 0.005):
        found = made(f"{text}{target}", table()).group
        M, K, C = by_hand({"X2": float(found.variables["damping_coefficient"].values[0])})
        exact, _ = damping_ratios(M, K, C)
        apart.append(found.variables["plan_damping"].values / exact - 1.0)
        assert np.all(exact > 1e-4)  # each mode moves the dampers
    assert apart[0] / apart[1] == pytest.approx([4.0] * 3, rel=0.05)


def test_all_modes_of_an_eccentric_building_are_those_of_its_matrices() -> None:
    """Complex eigenvalues with dashpots by the condensed building and by matrices by hand."""
    spec: Any = design("method: viscous, law: oil, kind: storey, along: x, frames: X1, bays: 1, damping: 5 %", table())
    found = make_building(table(), "tried", spec.model_copy(update={"state": "initial"}))
    c = np.array([2e5])
    modes = dashpot_modes(found.frame, found.frame.modes(), c, np.zeros(1))
    ratios, _ = damping_ratios(*by_hand({"X1": 2e5}))
    assert modes.damping == pytest.approx(ratios, rel=1e-7)


def test_modes_that_share_the_direction_are_warned_of() -> None:
    spec: Any = design("method: viscous, law: oil, kind: storey, along: x, frames: X1, bays: 1, damping: 5 %", table())
    frame = make_building(table(), "tried", spec.model_copy(update={"state": "initial"})).frame
    bare, damping = frame.modes(), np.array([0.0, 0.03, 0.05])
    assert bare.lead.share == pytest.approx(bare.participation**2 / 38e3, rel=1e-9)  # of one storey, effective masses
    assert list(shared_mode(bare, damping)) == []  # 90 % and 9 %
    mixed = replace(bare, lead=replace(bare.lead, share=np.array([0.01, 0.35, 0.64])))
    (text,) = shared_mode(mixed, damping)
    assert text.startswith("modes 3 and 2 with dampers share the direction, 64 % and 35 % of it")
    assert "5 % and 3 %" in text


def test_modes_of_one_frequency_are_turned_into_the_direction() -> None:
    """Of a square table, the mode of a design along x or y has all of the mass, whatever pair the solver gives."""
    square = changed(TABLE, ("y: [5 m]", "y: [6 m]"), ("section: HEB200", "section: SHS200x10"))
    kept = [
        line
        for line in square.splitlines()
        if not line.startswith(("records:", "analyses:", "  - {name: sh", "  both", "  one"))
    ]
    file = building("\n".join(kept) + "\n" + LAWS)
    sizes = []
    for along, frames in (("x", "X1-X2"), ("y", "A-B")):
        text = f"method: viscous, law: oil, kind: storey, along: {along}, frames: {frames}, bays: 1, damping: 10 %"
        found = made(text, file).group
        led = int(found.attributes["leading_mode"]) - 1
        assert found.variables[f"plan_mass_ratio_{along}"].values[led] == pytest.approx(1.0, abs=1e-9)
        sizes.append(found.variables["damping_coefficient"].values)
    assert sizes[0] == pytest.approx(sizes[1], rel=1e-9)


HELD = building(f"{ROWS}restrained_floors: [{{floors: 1}}]\n")


def test_a_floor_that_the_ground_holds_has_no_part_in_the_modes_of_a_design() -> None:
    """All modes together move all of the mass that is free, in each direction (Chopra, 13.3); 1e-9 is rounding.

    Dampers in A and C do not stand alike about the centre of mass, so that another mode has 5e-4 of the vibration.
    """
    spec = design(f"{METHODS['viscous']}, along: y, frames: [A, C], storeys: 2-3, state: initial", HELD)
    found = make_building(HELD, "tried", spec)
    assert np.isnan(found.storey_stiffness).tolist() == [True, False, False]
    assert found.frame.mass_ratios(found.frame.modes()).sum(axis=0) == pytest.approx([1.0, 1.0, 1.0], rel=1e-9)
    group = run_design(HELD, "tried", spec, Path(".")).group
    leading = int(group.attributes["leading_mode"]) - 1
    assert group.variables["bare_period"].values[0] == pytest.approx(
        group.variables["plan_bare_period"].values[leading]
    )
    assert group.attributes["damping"] == pytest.approx(0.15)
    assert group.variables["damping_complex"].values[0] == pytest.approx(0.15, rel=1e-3)


def test_a_design_below_a_floor_that_the_ground_holds_is_foretold_to_fail() -> None:
    spec = design(f"{METHODS['viscous']}, along: y, frames: [A, C], state: initial", HELD)
    (warning,) = first_warnings(HELD, "tried", spec, Path("."))
    assert "it will fail: storey 1 does not shear" in warning
