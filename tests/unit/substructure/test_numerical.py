"""Linear numerical parts: shear buildings given inline, and frames of projects condensed to the degrees with mass."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from messages import says
from shear_frames import BAY, HEIGHT, E, shear_frame_text
from unit.study.frames import ANALYSED, PULSE, project, shear_frame

from edesign.errors import InputError
from edesign.project import load_project
from edesign.project.analysis.damping import ModalDamping, NoDamping, RayleighDamping
from edesign.project.project import Project
from edesign.study.analysis.structure import make_structure
from edesign.study.run.analyses import run_analysis
from edesign.substructure.structure.numerical import LinearPart, shear_building
from edesign.substructure.structure.project_structure import project_part
from edesign.substructure.structure.recursion import Recursion, recursion

PROJECTS = Path(__file__).parents[3] / "projects"
NONE = NoDamping(kind="none")
RAYLEIGH = RayleighDamping(kind="rayleigh", ratio=0.02, modes=(1, 3))
MASSES, STIFFNESSES = [143.26e3, 143.26e3, 71.63e3], [22.6e6, 22.6e6, 18.08e6]  # kg, N/m: thesis 6.2.6


def test_one_storey_of_the_thesis() -> None:
    """sqrt(k/m) = 1.999 Hz; the thesis prints 1.99."""
    part = shear_building(MASSES[:1], STIFFNESSES[:1], ModalDamping(kind="modal", ratio=0.02, modes=1), 1)
    omega = math.sqrt(22.6e6 / 143.26e3)
    assert part.frequencies() == pytest.approx([omega / (2.0 * math.pi)], rel=1e-12)
    assert part.frequencies() == pytest.approx([1.999], abs=5e-4)
    assert part.damping == pytest.approx(np.array([[2.0 * 0.02 * omega * 143.26e3]]), rel=1e-12)
    assert part.names == ("floor 1",)


def test_three_storeys_of_the_thesis() -> None:
    """Without its damper 1.029, 2.700, 3.637 Hz; with 4.346 kN/mm the thesis prints 1.0826, 2.7746 and 3.67 Hz.

    Its own stiffness of the damper is rounded: 5e-4 of a frequency.
    """
    part = shear_building(MASSES, STIFFNESSES, RAYLEIGH, 1)
    assert part.frequencies() == pytest.approx([1.029, 2.700, 3.637], abs=5e-4)
    assert part.frequencies(4.346e6) == pytest.approx([1.0826, 2.7746, 3.67], rel=5e-4)


@pytest.mark.parametrize("modal", [False, True])
def test_damping_ratios(modal: bool) -> None:
    """Of the modes: 2 % where it is given, a0/(2 w) + a1 w/2 in the second under Rayleigh, 0 in the third if modal."""
    damping = ModalDamping(kind="modal", ratio=0.02, modes=2) if modal else RAYLEIGH
    part = shear_building(MASSES, STIFFNESSES, damping, 2)
    omega, shapes = part.modes()
    table = shapes.T @ part.damping @ shapes
    between = 0.02 * (omega[0] * omega[2] / omega[1] + omega[1]) / (omega[0] + omega[2])
    expected = [0.02, 0.02, 0.0] if modal else [0.02, between, 0.02]
    assert np.diag(table) / (2.0 * omega) == pytest.approx(expected, abs=1e-13)
    assert table - np.diag(np.diag(table)) == pytest.approx(np.zeros((3, 3)), abs=1e-10)


def test_the_specimen_takes_the_drift_of_its_storey() -> None:
    """A spring beside a storey adds to its stiffness."""
    part = shear_building(MASSES, STIFFNESSES, NONE, 2)
    assert part.interface == pytest.approx([-1.0, 1.0, 0.0])
    stiffer = shear_building(MASSES, [22.6e6, 22.6e6 + 5e6, 18.08e6], NONE, 2)
    assert part.with_specimen(5e6) == pytest.approx(stiffer.stiffness)


@pytest.mark.parametrize(
    ("masses", "stiffnesses", "damping", "storey", "message"),
    [
        ([1.0], [1.0, 2.0], NONE, 1, "structure.*E-PART-02"),
        ([], [], NONE, 1, "0 masses"),
        ([1.0, 0.0], [1.0, 2.0], NONE, 1, r"masses\[1\].*E-VALUE-02"),
        ([1.0], [math.inf], NONE, 1, r"stiffnesses\[0\].*E-VALUE-02"),
        ([1.0, 1.0], [1.0, 2.0], NONE, 3, "structure.*E-PART-03"),
        ([1.0], [1.0], RAYLEIGH, 1, "damping.*E-PART-03"),
        ([1.0], [1.0], RayleighDamping(kind="rayleigh", ratio=0.02, modes=(1, 1)), 1, "E-VALUE-04"),
    ],
)
def test_impossible_buildings(
    masses: list[float], stiffnesses: list[float], damping: NoDamping | RayleighDamping, storey: int, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        shear_building(masses, stiffnesses, damping, storey)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"mass": np.diag([1.0, 0.0])}, "floor 2.*E-PART-01"),
        ({"mass": np.ones((2, 2))}, "mass matrix.*E-PART-01"),
        ({"stiffness": np.array([[2.0, -1.0], [0.0, 1.0]])}, "stiffness.*E-PART-02"),
        ({"damping": np.zeros((1, 1))}, "damping.*E-PART-02"),
        ({"influence": np.array([1.0, math.nan])}, "influence.*E-PART-02"),
        ({"interface": np.zeros(2)}, "E-PART-03"),
    ],
)
def test_impossible_matrices(change: dict[str, np.ndarray], message: str) -> None:
    good = {
        "mass": np.eye(2),
        "damping": np.zeros((2, 2)),
        "stiffness": np.array([[2.0, -1.0], [-1.0, 1.0]]),
        "influence": np.ones(2),
        "interface": np.array([1.0, 0.0]),
    }
    with pytest.raises(InputError, match=message):
        LinearPart(**(good | change), names=("floor 1", "floor 2"))


def test_a_part_that_falls_over() -> None:
    part = LinearPart(np.eye(1), np.zeros((1, 1)), -np.eye(1), np.ones(1), np.ones(1), ("floor 1",))
    with pytest.raises(InputError, match="E-PART-04"):
        part.frequencies()
    assert part.frequencies(2.0) == pytest.approx([1.0 / (2.0 * math.pi)])


@pytest.mark.parametrize(("name", "count"), [("thesis_one_storey", 3), ("thesis_three_storey", 9)])
def test_condensed_projects_of_the_thesis(name: str, count: int) -> None:
    """The natural frequencies of the whole frame are left, up to rounding; horizontally those of the shear building.

    The columns of the frame can shorten, which takes 1.3e-4 of a frequency.
    """
    made = load_project(PROJECTS / name / "project.yaml")
    found = project_part(made, "S_1_1")
    full = make_structure(made).modes(count).omega / (2.0 * math.pi)
    assert found.part.frequencies() == pytest.approx(full, rel=1e-8)
    storeys = made.frame.n_storeys
    shear = shear_building(MASSES[:storeys], STIFFNESSES[:storeys], NONE, 1)
    assert found.part.frequencies()[:storeys] == pytest.approx(shear.frequencies(), rel=2e-4)
    assert found.part.names[0] == "floor 1"
    assert found.part.interface == pytest.approx(np.eye(count)[0], abs=1e-12)
    assert not found.warnings


def test_without_vertical_inertia() -> None:
    """The three floors are left, with the floors' own names and the frequencies of the shear building."""
    made = load_project(PROJECTS / "thesis_three_storey" / "project.yaml")
    found = project_part(made, "S_1_1", vertical=False)
    assert found.part.names == ("floor 1", "floor 2", "floor 3")
    shear = shear_building(MASSES, STIFFNESSES, RAYLEIGH, 1)
    assert found.part.frequencies() == pytest.approx(shear.frequencies(), rel=2e-4)
    assert found.part.damping == pytest.approx(shear.damping, rel=2e-3, abs=2e-3 * shear.damping.max())
    assert found.building.floor_rows == pytest.approx(np.eye(3), abs=1e-12)


LAWS = """\
dampers:
  laws:
    spring: {type: kelvin_voigt, parameters: {k: 3 kN/mm, c: 0 N*s/m}}
    pot: {type: viscous, parameters: {c: 200 kN*s/m}}
    tested: {type: mgmm, parameters: thesis_table_4_2, temperature: 20 degC}
"""
HISTORY = "{name: h, kind: history, record: pulse, scale: 2.0, free_vibration: 0.88 s}"
STEP = 0.001


def soft_frame(devices: str, damping: str, folder: Path, storeys: int = 2) -> Project:
    """A frame whose beams bend, so that joints without mass turn; P-Delta under gravity."""
    text = (shear_frame_text(storeys) + ANALYSED).replace("@damping@", damping).replace("@outputs@", "{}")
    text = text.replace("@analyses@", f"  - {HISTORY}").replace("inertia: 1e3 m^4", "inertia: 2e-4 m^4")
    text = text.replace("columns: linear", "columns: p_delta").replace("time_step: 0.01 s", f"time_step: {STEP} s")
    (folder / "pulse.csv").write_text("\n".join(map(str, PULSE)))
    devices = "".join(f"    - {device}\n" for device in devices.splitlines())
    return project(text + LAWS + "  devices:\n" + devices, folder / "project.yaml")


def roof(made: Recursion, floors: np.ndarray, ground: np.ndarray, spring: float) -> np.ndarray:
    """Displacement of the last floor (n,), of a loop whose specimen is a spring at the target."""
    z, force, before, found = np.zeros(made.A.shape[0]), 0.0, 0.0, [0.0]
    for now, ahead in zip(ground[:-1], ground[1:], strict=True):
        w = np.array([force, before, now, ahead])
        y = made.C @ z + made.D @ w
        z = made.A @ z + made.B @ w
        before, force = force, spring * y[0]
        found.append(floors[-1] @ y[3:])
    return np.array(found)


DAMPINGS = [
    "{kind: rayleigh, ratio: 5 %, modes: [1, 2], stiffness: initial, state: initial}",
    "{kind: rayleigh, ratio: 5 %, modes: [1, 2]}",
    "{kind: modal, ratio: 5 %, modes: 2}",
]


@pytest.mark.parametrize("damping", DAMPINGS)
def test_loop_with_a_spring_is_the_history_of_the_project(damping: str, tmp_path: Path) -> None:
    """The whole chain against the core: frame, gravity, damping, a dashpot that stays, a spring in the laboratory.

    Newmark 1/4 of the core at 1 ms errs by (omega dt)^2/12 of the phase, omega below 100 rad/s: 1e-3. With `initial`
    Rayleigh damping the joints without mass have the stiffness under gravity in the motion and without it in the
    damping: condensation is not exact, far below that.
    """
    devices = "{kind: storey, bays: 1, storeys: 1, law: spring}\n{kind: storey, bays: 1, storeys: 2, law: pot}"
    made = soft_frame(devices, damping, tmp_path)
    group = run_analysis(made, made.analyses[0])
    assert group.attributes["status"] == "completed", group.attributes["reason"]
    found = project_part(made, "S_1_1")
    ground = group.variables["ground_acceleration"].values
    moved = roof(recursion(found.part, STEP, "exact", "extrapolated"), found.building.floor_rows, ground, 3e6)
    largest, smallest = (float(group.variables[f"floor_displacement_{end}"].values[-1]) for end in ("max", "min"))
    assert [moved.max(), moved.min()] == pytest.approx([largest, smallest], rel=1e-3)


def test_tuned_mass_stays_in_the_numerical_part(tmp_path: Path) -> None:
    """As above, with a tuned mass on the roof; inherent damping is that of the frame without it."""
    made = soft_frame("{kind: storey, bays: 1, storeys: 1, law: spring}", DAMPINGS[2], tmp_path)
    tuned = "  attachments:\n    - {kind: tuned_mass, floor: 2, mass: 4 t, frequency: 1.5 Hz, damping: 0.1}\n"
    made = project(made.text + tuned, tmp_path / "project.yaml")
    group = run_analysis(made, made.analyses[0])
    found = project_part(made, "S_1_1")
    assert found.part.names[-1] == "T_2_1 ux"
    ground = group.variables["ground_acceleration"].values
    moved = roof(recursion(found.part, STEP, "exact", "extrapolated"), found.building.floor_rows, ground, 3e6)
    largest, smallest = (float(group.variables[f"floor_displacement_{end}"].values[-1]) for end in ("max", "min"))
    assert [moved.max(), moved.min()] == pytest.approx([largest, smallest], rel=1e-3)


def test_frequencies_of_a_frame_with_turning_joints(tmp_path: Path) -> None:
    """Static condensation is exact: the frequencies under gravity of the whole frame, up to rounding."""
    made = soft_frame("{kind: storey, bays: 1, storeys: 1, law: tested}", DAMPINGS[1], tmp_path, storeys=3)
    alone = make_structure(made)
    alone.apply_gravity()
    found = project_part(made, "S_1_1")
    assert found.part.frequencies() == pytest.approx(alone.modes(3).omega / (2.0 * math.pi), rel=1e-9)
    assert found.device.law == "tested" and found.device.values.law == "mgmm"


@pytest.mark.parametrize(("area", "share"), [(1000.0, None), (0.1, 0.07), (0.001, 7.0)])
def test_a_chevron_on_columns_without_vertical_mass(area: float, share: float | None, tmp_path: Path) -> None:
    """Its force strains the columns below, which have no mass: in series 2 (h/b)^2 h/(E A).

    Of 1000 m2 that is nothing, of 0.1 m2 left out and reported, of 0.001 m2 refused.
    """
    made = soft_frame("{kind: chevron, bays: 1, storeys: 2, law: tested}", "{kind: none}", tmp_path)
    made = project(made.text.replace("area: 1000 m^2", f"area: {area} m^2"), made.path)
    if share is None:
        assert not project_part(made, "V_1_2").warnings
        return
    if share > 1.0:
        with pytest.raises(InputError, match="V_1_2 .*directions: both.*E-PART-01"):
            project_part(made, "V_1_2")
        return
    (warning,) = project_part(made, "V_1_2").warnings
    expected = 2.0 * (HEIGHT / BAY) ** 2 * HEIGHT / (E * area)
    assert f"({expected:.3g} m/N) belongs to degrees without mass; it is left out" in warning


@pytest.mark.parametrize(
    ("devices", "name", "message"),
    [
        ("{kind: storey, bays: 1, storeys: 1, law: tested}", "S_1_2", "no damper `S_1_2`; did you mean `S_1_1`?"),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested, brace: {stiffness: 50 kN/mm}}",
            "S_1_1",
            "project.yaml S_1_1 E-PART-05",
        ),
        ("{kind: storey, bays: 1, storeys: 1-2, law: tested}", "S_1_1", "project.yaml S_1_2 (mgmm) E-PART-05"),
        (
            "{kind: storey, bays: 1, storeys: 1, law: tested}\n"
            "{kind: storey, bays: 1, storeys: 2, law: pot, brace: {stiffness: 50 kN/mm}}",
            "S_1_1",
            "project.yaml S_1_2 brace E-PART-05",
        ),
    ],
)
def test_devices_that_cannot_be_the_specimen(devices: str, name: str, message: str, tmp_path: Path) -> None:
    made = soft_frame(devices, "{kind: none}", tmp_path)
    with pytest.raises(InputError) as caught:
        project_part(made, name)
    assert says(str(caught.value), message)


def test_a_project_without_dampers() -> None:
    with pytest.raises(InputError, match=r"project\.yaml.*E-PART-03"):
        project_part(shear_frame("{name: m, kind: modal, modes: 1}"), "S_1_1")


def test_an_interface_without_mass(tmp_path: Path) -> None:
    """The first floor has no mass: the damper's force would move it at once."""
    made = soft_frame("{kind: storey, bays: 1, storeys: 1, law: tested}", "{kind: none}", tmp_path)
    light = project(made.text.replace("lines: all, floors: all, mass", "lines: all, floors: 2, mass"), made.path)
    with pytest.raises(InputError, match="S_1_1.*E-PART-01"):
        project_part(light, "S_1_1")


def test_a_frame_that_could_yield_says_so(tmp_path: Path) -> None:
    made = soft_frame("{kind: storey, bays: 1, storeys: 1, law: tested}", "{kind: none}", tmp_path)
    text = made.text.replace("law: elastic, E: 210 GPa", "law: bilinear, E: 210 GPa, fy: 250 MPa")
    (warning,) = project_part(project(text, made.path), "S_1_1").warnings
    assert warning == "the numerical part is linear: steel would not yield in it"
