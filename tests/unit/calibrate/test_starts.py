"""Tests that start away from rest in the loop: what is not judged, what is each test's own, what is said of it."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from edesign.calibrate.dampers.prepare import damper_problem, thinned
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.starts import as_started, settled, with_starts
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.run import calibrate
from edesign.calibrate.write import calibration_json
from edesign.damper.damper import Damper
from edesign.damper.history import spline_velocity
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.start import StartKind
from edesign.report.calibration.tables import starts_table, verdict_text

MGMM = law("mgmm")
TABLE_4_2 = read_parameters(MGMM, "thesis_table_4_2")
T = np.arange(0.0, 6.0, 1.0 / 500.0)
NOISE = 100.0  # N
U0, FAST = 7e-5, 1.0  # m, m/s: the step to the first sample of a test that starts so


def sine(amplitude: float, frequency: float) -> np.ndarray:
    grow = np.clip(2.0 * np.minimum(T, T[-1] - T), 0.0, 1.0)
    smooth = grow**3 * (10.0 - 15.0 * grow + 6.0 * grow**2)
    return np.asarray(1e-3 * amplitude * smooth * np.sin(2.0 * np.pi * frequency * T))


def made(name: str, u: np.ndarray, use: str = "fit", start: StartKind = "unknown") -> DamperTest:
    """A test from rest, or after a step to its first displacement that the record does not show."""
    v, seed = spline_velocity(T, u), int(name[-1])
    time, deformation, velocity = T, u, v
    if u[0] != 0.0:
        soon, way = 1e-6, 0.5e-6 * FAST
        ramp = (U0 - way) / FAST
        time = np.concatenate(([-1.0, -ramp - soon, -ramp], T))
        deformation = np.concatenate(([0.0, 0.0, way], u))
        velocity = np.concatenate(([0.0, 0.0, FAST], v))
    force = Damper(MGMM, TABLE_4_2).force(time, deformation, velocity)[-T.size :]
    force = force + NOISE * np.random.default_rng(seed).standard_normal(T.size)
    return DamperTest(name, T, u, force, 20.0, use=use, start=start)  # type: ignore[arg-type]


def stepped(start: StartKind = "unknown") -> list[DamperTest]:
    """Two tests that start with a step, two from rest; a sweep of 1 Hz is softened by its step all along."""
    slow = U0 + 1e-3 * (1.0 + T / T[-1]) * np.sin(2.0 * np.pi * T)
    return [
        made("test_1", slow, start=start),
        made("test_2", sine(4.0, 1.0), start=start),
        made("test_3", sine(2.0, 2.0), start=start),
        made("test_4", 1.5 * slow - 0.5 * U0, "validate", start=start),
    ]


def campaign(folder: Path, tests: list[DamperTest]) -> Campaign:
    choice = LawChoice("mgmm", "thesis_table_4_2", extremes="fresh")
    return load_campaign(write_campaign(folder, Specimen("s", 2, 0.0414, 0.012), tests, choice).path)


def declared(problem: DamperProblem) -> Judged:
    held = Model(problem, tuple(trial.noise for trial in problem.trials), held=True)
    return Judged(fit(held, held.coordinates()))


def test_the_law_that_made_the_tests_is_at_the_floor_of_each(tmp_path: Path) -> None:
    loaded = campaign(tmp_path, stepped())
    full = damper_problem(loaded)
    assert declared(thinned(full)).left > 20.0  # as if all tests began at rest
    problem = with_starts(thinned(full), loaded.tests)
    assert [trial.start is not None for trial in problem.trials] == [True, False, False, True]
    assert declared(problem).at_floor
    at_all_samples = as_started(full, problem)
    assert declared(at_all_samples).at_floor
    first = at_all_samples.trials[0]
    # a force that a step made falls as exp(-t / tau), tau = c1 / k1 = 29 ms: 7 tau from c_a U0 / tau = 2.1 kN to noise
    assert 0.05 < T[first.first] < 0.25
    assert first.counted is not None and not np.any(first.counted[: first.first])
    assert np.mean(first.counted**2) == pytest.approx(1.0)


def test_a_step_that_is_said_is_taken_as_said(tmp_path: Path) -> None:
    """A step within one interval, 35 mm/s, is no step of 1 m/s: the law is not softened enough then."""
    loaded = campaign(tmp_path, stepped("at_rest"))
    problem = with_starts(thinned(damper_problem(loaded)), loaded.tests)
    start = problem.trials[0].start
    assert start is not None and start.known and start.been[2] == pytest.approx(U0 * 500.0)
    assert problem.nuisance(problem.declared, (), 0) is None
    assert not declared(problem).at_floor


def test_what_a_test_owes_to_its_start_is_no_matter_to_the_fit(tmp_path: Path) -> None:
    """Residuals are the same with whatever softening before the test, as c_mod is a line in exp(-v / v_ref)."""
    loaded = campaign(tmp_path, stepped())
    problem = with_starts(thinned(damper_problem(loaded)), loaded.tests)
    held = Model(problem, tuple(trial.noise for trial in problem.trials), held=True)
    columns = problem.nuisance(problem.declared, (), 0)
    assert columns is not None and 1 <= columns.shape[1] <= 2
    assert columns.T @ columns == pytest.approx(np.eye(columns.shape[1]), abs=1e-9)
    (residual, *_) = held.residuals(held.coordinates())
    assert columns.T @ residual == pytest.approx(0.0, abs=1e-6 * np.linalg.norm(residual))
    assert problem.nuisance(problem.declared, (), 1) is None
    assert settled(problem).nuisance(problem.declared, (), 0) is None  # errors are told without such a share
    assert declared(settled(problem)).at_floor


def test_the_verdict_is_none_and_says_which_tests_start_away_from_rest(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, stepped()), workers=1, seconds=5.0)
    assert found.verdict == "none" and found.worst is None and not found.effects
    text = verdict_text(found)
    assert "test_1, test_4 start away from rest" in text and "not judged" in text
    assert [row[0] for row in starts_table(found).rows] == ["test_1", "test_4"]
    told = json.loads(json.dumps(calibration_json(found)))
    assert list(told["starts"]) == ["test_1", "test_4"] and told["worst_test"] is None
    one = told["starts"]["test_1"]
    assert one["before_is"] == "found" and 0.05 < one["velocity_before"] <= 1.05 * FAST
