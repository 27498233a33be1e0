"""The case `viscous_dampers`: a design of viscous dampers as a user runs it, and the same dampers written by hand."""

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
from edesign.report.archive.document import page_text
from edesign.report.archive.study_tables import study_tables
from edesign.report.design.designs_tables import property_factors_of
from edesign.study.run.run import run_study

CASE = HERE / "viscous_dampers"
C, ALPHA = (90.5e3, 69.4e3, 32.3e3), 0.35  # of project.yaml
Results = Callable[[str, str], Group]
study_in = partial(copied_study, "viscous_dampers")


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_study(load_study(study_in(tmp_path_factory.mktemp("viscous")))).archive


def test_force_of_every_damper_is_that_of_its_own_coefficient(results_of: Results) -> None:
    # velocities by central differences of the kept deformations: their error, (omega dt)^2 / 6 for the 8 Hz that the
    # record has at most, counts alpha times; where the velocity is near zero, so is the force, and neither is a ratio
    shake = results_of("viscous_dampers", "shake")
    time, u, force = (shake.variables[k].values if k != "time" else shake.coords[k].values for k in KEPT)
    dt = time[1] - time[0]
    velocity = (u[2:] - u[:-2]) / (2.0 * dt)
    for damper, c in enumerate(C):
        v, f = velocity[:, damper], force[1:-1, damper]
        fast = np.abs(v) > 0.2 * np.abs(v).max()
        assert fast.sum() > 200
        expected = c * np.abs(v[fast]) ** ALPHA * np.sign(v[fast])
        tolerance = ALPHA * (2.0 * np.pi * 8.0 * dt) ** 2 / 6.0
        assert np.linalg.norm(f[fast] - expected) < tolerance * np.linalg.norm(expected)


KEPT = ("time", "damper_deformation", "damper_force")


def test_period_of_the_dampers_written_by_hand(results_of: Results, archive: Path) -> None:
    with open_archive(archive) as opened:
        designed = opened.group("analyses/damped.modes").variables["period"].values
        bare = opened.group("analyses/bare.modes").variables["period"].values
    by_hand = results_of("viscous_dampers", "modes").variables["period"].values
    np.testing.assert_allclose(by_hand, designed, rtol=1e-4)  # three digits of what the dampers store, 2 % of it all
    assert 0.98 < designed[0] / bare[0] < 1.0


def test_design_reaches_its_target_and_is_what_stands_in_the_project(archive: Path) -> None:
    with open_archive(archive) as opened:
        design = opened.group("designs/oil")
    assert design.attributes["status"] == "completed"
    assert design.attributes["damping"] == pytest.approx(0.15, abs=1e-9)
    np.testing.assert_allclose(design.variables["device_coefficient"].values, C, rtol=2e-3)
    np.testing.assert_array_equal(design.variables["device_count"].values, 1)
    np.testing.assert_allclose(1e3 * design.variables["design_stroke"].values, [33.4, 25.2, 13.2], rtol=5e-3)


def test_devices_to_order(archive: Path) -> None:
    with open_archive(archive) as opened:
        tables = {table.title: table for table in study_tables(opened)}
        history = opened.group("analyses/upper.DBE.motion")
        design = opened.group("designs/oil")
    table, order = (
        tables["Largest values of one damper, design oil"],
        tables["Devices to order, design oil"],
    )
    assert [row[0] for row in table.rows] == ["estimate", "damped, DBE", "upper, DBE"] * 3
    last = table.texts[-1]
    # each value the largest of both variants: `damped` has the longer stroke, `upper` the larger force
    before = table.texts[-2]
    largest = [max(float(before[i]), float(last[i])) for i in (6, 8, 10)]
    assert [float(value) for value in order.texts[-1][4:7]] == largest and len(order.rows) == 3
    force, stroke = (
        max(abs(history.variables[f"damper_{name}_{which}"].values[2]) for which in ("max", "min"))
        for name in ("force", "deformation")
    )
    assert float(last[5]) == float(last[6]) == pytest.approx(force / 1e3, rel=1e-3)
    assert float(last[7]) == pytest.approx(1e3 * stroke, rel=1e-3)
    c = 1.2 * design.variables["device_coefficient"].values[2]
    assert float(last[9]) == pytest.approx((force / c) ** (1.0 / ALPHA), rel=1e-3)


def test_report(archive: Path) -> None:
    text = page_text(archive)
    assert "Devices to order" in text and "damping coefficient of a damper of each storey" in text


@pytest.mark.parametrize("change", ["target", "coefficient"])
def test_verification_changes_the_dampers_until_the_drift_is_met(tmp_path: Path, change: str) -> None:
    verify = f"verify: {{records: motion, levels: DBE, criteria: drift, rounds: 8, precision: 20 %, change: {change}}}"
    path = study_in(
        tmp_path,
        ("    bounds: {upper: 1.2, lower: 0.85}", f"    {verify}"),
        ("most: 1 %", "most: 1.2 %"),
        ("  upper: {design: oil, property_factor: 1.2}\n", ""),
    )
    found = run_study(load_study(path)).archive
    with open_archive(found) as opened:
        design, history = opened.group("designs/oil"), opened.group("analyses/damped.DBE.motion")
    assert design.attributes["status"] == "completed" and design.coords["round"].values.size > 1
    chosen = int(str(design.attributes["chosen_round"])) - 1
    drift = max(np.abs(history.variables[f"storey_drift_{which}"].values).max() for which in ("max", "min"))
    assert design.variables["verdict_value"].values[chosen, 0] == pytest.approx(drift, rel=1e-9) and drift <= 0.012
    device = design.variables["round_device_coefficient"].values
    assert np.all(device[chosen] > device[0])
    if change == "coefficient":
        np.testing.assert_allclose(device[chosen] / device[0], design.variables["round_changed"].values[chosen])


def test_devices_of_bounds_have_the_factors_of_bounds(tmp_path: Path) -> None:
    change = ("upper: {design: oil, property_factor: 1.2}", "x: {design: oil, bounds: {upper: 1.3, lower: 0.8}}")
    found = property_factors_of(load_study(study_in(tmp_path, change)), "oil")
    assert found == pytest.approx({"damped": 1.0, "x": 1.0, "x_lower": 0.8, "x_upper": 1.3})
