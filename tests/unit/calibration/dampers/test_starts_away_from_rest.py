"""Tests that start away from rest: what is not judged, nuisance amplitudes, what is said of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.problem import DamperProblem
from edesign.damper.damper import Damper
from edesign.damper.history import spline_velocity
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters, write_parameters
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.damper.testing.start import StartKind

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


def power_over_noise(problem: DamperProblem) -> list[float]:
    """Mean square of the weighted residuals of the law that made the tests, over that of noise, in each test.

    Nuisance amplitudes are those that leave least.
    """
    model = problem.model((), ("fit", "validate"))
    values = np.array([one.centre for one in problem.base])
    (predicted,) = model.predict(values[np.newaxis])
    assert isinstance(predicted, list)
    found = []
    for y, f, own, one in zip(
        model.measured, predicted, model.nuisance_columns(values), problem.experiments, strict=True
    ):
        left = y - f
        if own is not None:
            left = left - own @ np.linalg.lstsq(own, left, rcond=None)[0]
        found.append(float(np.mean(left**2)) / one.noise**2)
    return found


def test_the_law_that_made_the_tests_leaves_noise_of_each(tmp_path: Path) -> None:
    problem = damper_problem(campaign(tmp_path, stepped()), threads=1)
    assert [one.start is not None for one in problem.experiments] == [True, False, False, True]
    at_rest = problem.with_experiments([replace(one, start=None) for one in problem.experiments])
    # noise is known to a quarter from spectra; what a step leaves of tests taken to begin at rest is many times that
    assert max(power_over_noise(problem)) < 1.5 and max(power_over_noise(at_rest)) > 20.0
    first = problem.full_rate.experiments[0]
    # a force that a step made falls as exp(-t / tau), tau = c1 / k1 = 29 ms: 7 tau from c_a U0 / tau = 2.1 kN to noise
    assert 0.05 < T[first.judged_from] < 0.25
    assert not np.any(first.weights[: first.judged_from])
    assert np.mean(first.weights**2) == pytest.approx(1.0)


def test_starts_are_read_beside_the_law_that_suits_the_tests(tmp_path: Path) -> None:
    """The declared one is a fifth too stiff: what softened a specimen before is then known from the tests alone."""
    too_stiff = {name: value * (1.2 if name != "alpha" else 1.0) for name, value in TABLE_4_2.items()}
    choice = LawChoice("mgmm", write_parameters(MGMM, too_stiff), extremes="fresh")
    written = write_campaign(tmp_path, Specimen("s", 2, 0.0414, 0.012), stepped(), choice)
    problem = damper_problem(load_campaign(written.path), threads=1)
    assert problem.declared["k_a"] == pytest.approx(too_stiff["k_a"])
    of_truth = replace(problem, declared=MGMM.complete(TABLE_4_2), alone={})
    # starts beside the declared law leave 56 and 128 times the noise of the first and the last test, which bend the law
    # that is fitted alone: starts beside that one leave 1.6 and 4.8
    stepped_ones, at_rest = power_over_noise(of_truth)[::3], power_over_noise(of_truth)[1:3]
    assert max(stepped_ones) < 8.0 and max(at_rest) < 1.5


def test_a_step_that_is_said_is_taken_as_said(tmp_path: Path) -> None:
    """A step within one interval, 35 mm/s, is no step of 1 m/s: the law is not softened enough then."""
    problem = damper_problem(campaign(tmp_path, stepped("at_rest")), threads=1)
    start = problem.experiments[0].start
    assert start is not None and start.known and start.prior_extremes[2] == pytest.approx(U0 * 500.0)
    assert problem.model(()).nuisance_columns(np.array([one.centre for one in problem.base]))[0] is None
    assert power_over_noise(problem)[0] > 1.5


def test_nothing_is_found_and_the_tests_say_how_they_start(tmp_path: Path) -> None:
    found = calibrate(campaign(tmp_path, stepped()), threads=1)
    assert (found.verdict, found.effects, found.worst) == ("none", (), None)
    starts = {one.name: one.start for one in found.series if one.start is not None}
    assert list(starts) == ["test_1", "test_4"]
    one = starts["test_1"]
    assert "are not judged" in one.words and not one.known
    assert 0.05 < one.before[1] <= 1.05 * FAST
