"""Wave passage: delays by hand, displacements of the supports by integration, sums of reactions, balance."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import copied_study

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_study
from edesign.ground_motion.delayed import motion_at
from edesign.study.run.run import run_study

Results = Callable[[str, str], Group]
CASE = "wave_passage"


def test_supports_move_as_the_record_does_later(results_of: Results) -> None:
    """20 m at 400 m/s are 50 ms. The ground displacement is integrated here from the archived acceleration."""
    group = results_of(CASE, "passing")
    assert group.variables["foot_delay"].values == pytest.approx([0.0, 0.025, 0.05])
    acceleration = group.variables["ground_acceleration"].values.astype(float)
    time = group.coords["time"].values
    late, now = (motion_at(acceleration, 0.005, time - delay)[0] for delay in (0.05, 0.0))
    largest = group.variables["foot_displacement_largest"].values
    assert largest[2] == pytest.approx(np.abs(late - now).max(), rel=1e-5)  # archived in single precision
    assert largest[0] == 0.0


def test_delays_are_what_the_velocity_makes(results_of: Results) -> None:
    """Bit for bit, and the wave from the right reaches line A last."""
    passing, by_line = (results_of(CASE, name) for name in ("passing", "by_line"))
    for name in ("floor_displacement", "storey_drift", "base_shear"):
        assert np.array_equal(passing.variables[name].values, by_line.variables[name].values)
    assert results_of(CASE, "leftwards").variables["foot_delay"].values == pytest.approx([0.05, 0.025, 0.0])


def test_supports_that_move_apart_pull_at_each_other(results_of: Results) -> None:
    """The reaction of line A is another, and the sum of all is the base shear still."""
    group, still = results_of(CASE, "passing"), results_of(CASE, "at_once")
    apart = group.variables["support_horizontal_reaction"].values
    together = still.variables["support_horizontal_reaction"].values
    assert np.abs(apart - together)[:, 0].max() > 0.2 * np.abs(together[:, 0]).max()
    shear = group.variables["base_shear"].values
    assert apart.sum(axis=1) == pytest.approx(-shear, abs=1e-3 * np.abs(shear).max())


def test_work_of_the_supports_is_in_the_balance(results_of: Results) -> None:
    for name in ("at_once", "passing", "leftwards"):
        group = results_of(CASE, name)
        assert group.attributes["statistics"]["energy_error"] < 2e-3
    assert "wave" not in str(results_of(CASE, "at_once").attributes.get("warnings", ""))


def test_a_record_that_ends_with_a_velocity_is_reported(results_of: Results) -> None:
    """Some 20 mm/s, the integral of the archived acceleration, are 1 mm in 50 ms."""
    group = results_of(CASE, "passing")
    end = np.trapezoid(group.variables["ground_acceleration"].values.astype(float), dx=0.005)
    assert abs(end) == pytest.approx(0.02, rel=0.05)
    assert group.variables["foot_displacement_final"].values[2] == pytest.approx(-end * 0.05, rel=1e-4)
    assert "baseline is corrected" in str(group.attributes["warnings"])


def test_studies_have_the_same_waves(results_of: Results, tmp_path: Path) -> None:
    """Bit for bit the history of the project; a soil of half the modulus under the footing moves it further."""
    with open_archive(run_study(load_study(copied_study(CASE, tmp_path))).archive) as archive:
        bare, soft = (archive.group(f"analyses/{name}.motion") for name in ("bare", "soft"))
        first, second = (archive.group(f"analyses/bare.peaks.motion.{level}") for level in ("0.1g", "0.2g"))
    project = results_of(CASE, "passing")
    for name in ("base_shear_max", "storey_drift_max", "foot_displacement_largest", "energy_final"):
        assert np.array_equal(bare.variables[name].values, project.variables[name].values), name
    moved = [group.variables["support_displacement_x_max"].values[0] for group in (bare, soft)]
    assert moved[1] == pytest.approx(2.0 * moved[0], rel=0.1)
    apart = [group.variables["foot_displacement_largest"].values for group in (first, second)]
    assert 2.0 * apart[0] == pytest.approx(apart[1], rel=1e-9)
    assert apart[0][1] == 0.0 and apart[0][2] > 0.0
