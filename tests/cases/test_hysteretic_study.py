"""The case `hysteretic_dampers`: three designs as a user runs them, and the dampers of one written by hand."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import HERE, copied_study

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_study
from edesign.ground_motion.project_records import find_recordings
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.dampers.designs import HystereticDesign
from edesign.report.archive.document import page_text
from edesign.report.archive.study_tables import study_tables
from edesign.study.design.hysteretic.designer import HystereticDesigner
from edesign.study.motions.motions import Motion
from edesign.study.run.analyses import run_analysis
from edesign.study.run.run import run_study

CASE = HERE / "hysteretic_dampers"
SLIP = np.array([3.345, 2.563, 1.323]) * 30e3  # N, of project.yaml
BRACE = np.array([17.49e6, 17.77e6, 15.73e6])
STIFFNESS = SLIP / 0.5e-3  # 60 kN/mm at 30 kN
Results = Callable[[str, str], Group]
study_in = partial(copied_study, "hysteretic_dampers")


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_study(load_study(study_in(tmp_path_factory.mktemp("hysteretic")))).archive


def test_forces_are_those_of_slip_and_brace(results_of: Results) -> None:
    # Coulomb friction behind springs: the play of the archived deformation, written down once more
    shake = results_of("hysteretic_dampers", "shake")
    u, force = shake.variables["damper_deformation"].values, shake.variables["damper_force"].values
    # a path that turns between two samples goes on by an eighth of the second difference, at both ends of the play
    turns = np.diff(u[1:], axis=0) * np.diff(u[:-1], axis=0) < 0.0
    unseen = 2.0 * STIFFNESS * np.where(turns, np.abs(np.diff(u, 2, axis=0)), 0.0).max(axis=0) / 8.0
    assert np.all(unseen < 0.05 * SLIP)
    slipped = np.zeros(3)
    for now, found in zip(u, force, strict=True):
        slipped = np.clip(slipped, now - SLIP / STIFFNESS, now + SLIP / STIFFNESS)
        assert np.all(np.abs(found - STIFFNESS * (now - slipped)) <= unseen)
    assert np.all(np.abs(force).max(axis=0) == pytest.approx(SLIP, rel=1e-9))  # all of them slip


def test_elastic_period_of_the_dampers_written_by_hand(results_of: Results, archive: Path) -> None:
    with open_archive(archive) as opened:
        design = opened.group("designs/share")
        bare = opened.group("analyses/bare.modes").variables["period"].values[0]
        secant = opened.group("analyses/share.modes").variables["period"].values[0]
    by_hand = results_of("hysteretic_dampers", "modes").variables["period"].values[0]
    # modes take the first harmonic of the loop, which slips for most of a cycle: softer than its secant, by what
    # slips, so that the period lies between that of the secants and the bare one
    assert by_hand == pytest.approx(secant, rel=1e-3)
    assert design.variables["elastic_period"].values[0] < design.variables["period"].values[0] < secant * 1.05 < bare


def test_design_is_what_stands_in_the_project(archive: Path) -> None:
    with open_archive(archive) as opened:
        design, damping = opened.group("designs/share"), opened.group("designs/damping")
    np.testing.assert_allclose(design.variables["device_yield_force"].values, SLIP, rtol=1e-3)
    np.testing.assert_allclose(design.variables["brace_stiffness"].values, BRACE, rtol=1e-3)
    np.testing.assert_allclose(design.variables["shear_share"].values, 0.30, rtol=1e-12)
    np.testing.assert_allclose(design.variables["device_stiffness"].values, STIFFNESS, rtol=1e-3)
    assert damping.attributes["damping"] == damping.attributes["damping_average"] == pytest.approx(0.12, abs=1e-6)


def test_devices_to_order(archive: Path) -> None:
    with open_archive(archive) as opened:
        tables = [t for t in study_tables(opened) if t.title.startswith("Largest values of one damper")]
        order = next(t for t in study_tables(opened) if t.title == "Devices to order, design share")
        history = opened.group("analyses/share.DBE.motion")
        force = float(opened.group("designs/share").variables["device_yield_force"].values[2])
    assert [row[0] for row in tables[0].rows] == ["estimate", "share, DBE"] * 3
    last = tables[0].texts[-1]
    # a row a storey: what the histories ask for, and not the estimate
    assert [row[0] for row in order.texts] == ["1", "2", "3"]
    assert order.texts[-1][4:] == [last[6], last[8], last[10]]
    stroke = max(abs(history.variables[f"damper_deformation_{which}"].values[2]) for which in ("max", "min"))
    assert float(last[3]) == float(last[5]) == float(last[6]) == pytest.approx(force / 1e3, rel=1e-3)
    assert float(last[7]) == pytest.approx(1e3 * stroke, rel=1e-3)
    work = float(history.variables["damper_work_final"].values[2])
    assert float(last[9]) == pytest.approx(1e3 * work / force, rel=1e-3)


def test_connections_of_the_study(archive: Path) -> None:
    """Storey 1 is 4 m high in a bay of 6 m: the damper slips at F, so N = 5 / 6 F, H = F / 2 and V = 4 / 6 F."""
    with open_archive(archive) as opened:
        found = study_tables(opened)
        slip = float(opened.group("designs/share").variables["device_yield_force"].values[0])
    (table,) = (one for one in found if one.title == "Connections of the dampers, share, largest of each storey")
    gusset, apex, beam = table.rows[:3]  # of the gussets A0 and B0, which have the same force, the first
    assert [row[2] for row in table.rows[:3]] == ["lower gusset", "apex, to the damper", "beam above"]
    assert [row[3] for row in table.rows[:3]] == ["A0", "storey 1", "storey 1"] and len(table.rows) == 9
    # both ways it slips; the law of friction reaches its force to 1e-3
    assert gusset[5:] == pytest.approx(
        [5 / 6 * slip, 5 / 6 * slip, 1.0, 5 / 6 * slip, slip / 2, 4 / 6 * slip], rel=2e-3
    )
    assert apex[8:] == beam[8:] == pytest.approx([slip, slip, 0.0], rel=2e-3)
    assert any("none in `device_factors`" in note for note in table.notes)


def test_optimum_against_a_grid_of_histories(archive: Path, tmp_path: Path) -> None:
    study = load_study(study_in(tmp_path))
    spec = study.designs["optimum"]
    assert isinstance(spec, HystereticDesign)
    made = HystereticDesigner(study.base, "optimum", spec, lambda text: None)
    motion = Motion("motion", find_recordings(study.base, ["motion"])["motion"])
    task = HistoryAnalysis.model_construct(
        kind="history", name="grid", variant="optimum", record="motion", level="DBE", free_vibration=2.0
    )

    def objective(share: float) -> float:
        project = study.base.model_copy(update={"dampers": made.dampers(made.make(share))})
        group = run_analysis(project, task, motion=motion)
        drift = max(np.abs(group.variables[f"storey_drift_{which}"].values).max() for which in ("max", "min"))
        roof = max(abs(group.variables[f"floor_acceleration_{which}"].values[-1]) for which in ("max", "min"))
        return float(0.5 * (drift / 0.012 + roof / (0.6 * 9.80665)))

    with open_archive(archive) as opened:
        design = opened.group("designs/optimum")
    chosen = int(str(design.attributes["chosen_round"])) - 1
    found = float(design.variables["round_objective"].values[chosen])
    assert objective(float(design.variables["round_share"].values[chosen])) == pytest.approx(found, rel=1e-9)
    grid = np.linspace(0.05, 1.0, 39)
    values = [objective(float(share)) for share in grid]
    assert found <= min(values) * 1.01  # among 39 shares none is better by more than the roughness of the curve
    assert abs(grid[int(np.argmin(values))] / float(str(design.attributes["share"])) - 1.0) < 0.15


def test_report(archive: Path) -> None:
    text = page_text(archive)
    assert "Devices to order" in text and "with other forces in the same distribution" in text
    assert "rounds of histories; the least value is the design" in text
