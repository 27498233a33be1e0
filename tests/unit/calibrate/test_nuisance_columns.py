"""Columns whose share is each test's own: what they take out, and what they must leave."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from unit.calibrate.sine_trials import ROUNDING, W, share_left, sine_sizes, sine_trial

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import drift, gain, hum, offset
from edesign.calibrate.dampers.effects.drift import slowest_frequency
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Sizes, Trial
from edesign.calibrate.problem import Part, PredictionError
from edesign.damper.laws import law


def test_own_columns_take_out_what_is_each_tests_own() -> None:
    trial = sine_trial(100.0, 4.0)
    since = trial.motion.time - trial.motion.time[0]
    line = 120.0 - 30.0 * since
    assert share_left(drift.EachOwn().columns({}, trial), line) < ROUNDING
    assert share_left(offset.PerTest().columns({}, trial), 0.0 * since + 60.0) < ROUNDING
    # the mean goes: a line from 120 to 0 keeps its triangle, 60/sqrt(3) of 120/sqrt(3)
    assert share_left(offset.PerTest().columns({}, trial), line) == pytest.approx(0.5, abs=2e-3)
    assert share_left(drift.Wandering().columns({}, trial), 5.0 + np.cos(np.pi * since / 4.0)) < ROUNDING
    assert share_left(drift.Warming().columns({"tau": 0.7}, trial), 3.0 - 8.0 * np.exp(-since / 0.7)) < ROUNDING
    assert (
        share_left(drift.Swinging().columns({"period": 22.0}, trial), 3.0 - 8.0 * np.sin(W * since / 22.0 + 0.3))
        < ROUNDING
    )
    assert share_left(drift.EachOwn().columns({}, trial), 3.0 - 8.0 * np.exp(-since / 0.7)) > 0.1


def test_a_course_of_its_own_is_not_told_where_tests_are_not_left_out_as_a_whole() -> None:
    # of fewer tests quarters are left out, and a line through the rest of a relaxing test goes on in them
    own = (drift.EachOwn(), drift.Warming(), drift.Swinging(), drift.Wandering())
    for few, offered in (((True,) * 2 + (False,), False), ((True,) * 3 + (False,), True)):
        sizes = replace(sine_sizes(len(few)), fitted=few)
        assert all(bool(form.starts(sizes)) == offered for form in own)


def test_wandering_leaves_the_motion_alone() -> None:
    # a sine of 12 cycles: slowest frequency 1 Hz less the Hann window's width of 2 / duration
    trial = sine_trial(100.0, 12.0)
    assert 1.0 - 2.0 / 12.0 <= slowest_frequency(trial.motion) <= 1.0
    columns = drift.Wandering().columns({}, trial)
    since = (trial.motion.time - trial.motion.time[0]) / 12.0
    for j in range(columns.shape[1]):
        np.testing.assert_allclose(columns[:, j], np.cos(np.pi * j * since), atol=1e-12)
    assert columns.shape[1] == 9
    share = columns @ np.linalg.lstsq(columns, trial.force, rcond=None)[0]
    # whole cycles are orthogonal to the even cosines, nearly so to the odd ones
    assert np.sum(share**2) < 0.03 * np.sum(trial.force**2)
    # half a cycle in the test: the motion is as slow as anything, and only the constant is left
    assert drift.Wandering().columns({}, sine_trial(100.0, 0.5)).shape[1] <= 2


def _nuisance(trial: Trial, parts: list[tuple[Form, tuple[float, ...]]]) -> tuple[np.ndarray, np.ndarray]:
    """Columns of a problem with these parts, and those of the forms side by side."""
    sizes, rest = Sizes.of((trial,) * 4), [np.sin(W * 50.0 * trial.motion.time)]
    problem = DamperProblem(law("kelvin_voigt"), {"k": 1e7, "c": 0.0}, (trial,), sizes)
    given: list[Part] = []
    columns = []
    for form, values in parts:
        candidate = candidate_of(form, sizes, Left((trial,), rest))
        assert candidate is not None
        given.append((candidate, np.array(values)))
        columns.append(form.columns({u.name: v for u, v in zip(candidate.unknowns, values, strict=True)}, trial))
    found = problem.nuisance(problem.declared, given, 0)
    assert found is not None and problem.nuisance(problem.declared, given, 0) is found  # kept
    return found, np.hstack([c for c in columns if c is not None])


def test_nuisance_is_an_orthonormal_basis_of_the_columns() -> None:
    trial = sine_trial(120.0, 10.0)
    found, columns = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ()), (gain.Force(), (0.1,))])
    assert found.shape == columns.shape == (trial.force.size, 44)
    np.testing.assert_allclose(found.T @ found, np.eye(44), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(found @ (found.T @ columns), columns, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize(
    ("parts", "rank"),
    [
        ([(offset.PerTest(), ()), (drift.EachOwn(), ())], 2),  # both have the constant
        ([(hum.Restless(), (50.0,)), (hum.Hunting(), (50.0,))], 162),  # 42 columns stand twice
        ([(hum.Tone(), (120.0,))], 1),  # at the rate of the samples a tone is a constant
    ],
)
def test_nuisance_takes_nothing_out_that_is_in_no_column(
    parts: list[tuple[Form, tuple[float, ...]]], rank: int
) -> None:
    found, columns = _nuisance(sine_trial(120.0, 10.0), parts)
    assert np.linalg.matrix_rank(columns, tol=1e-9) == rank == found.shape[1]
    np.testing.assert_allclose(found @ (found.T @ columns), columns, rtol=0.0, atol=1e-9)


def test_nuisance_that_is_not_finite_is_no_prediction() -> None:
    trial = sine_trial(120.0, 10.0)
    broken = replace(trial, weight=np.where(np.arange(trial.force.size) == 7, np.nan, 1.0))
    for bad in (broken, replace(trial, weight=np.full(trial.force.size, 1e200))):
        with pytest.raises(PredictionError, match="each test's own is not finite"):
            _nuisance(bad, [(hum.Tone(), (50.0,)), (drift.EachOwn(), ())])


def test_nuisance_does_without_eigenvalues_that_do_not_converge(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> None:
        raise np.linalg.LinAlgError("Eigenvalues did not converge")

    trial = sine_trial(120.0, 10.0)
    expected, _ = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ())])
    monkeypatch.setattr(np.linalg, "eigh", fails)
    found, _ = _nuisance(trial, [(hum.Restless(), (50.0,)), (drift.EachOwn(), ())])
    np.testing.assert_allclose(found @ found.T, expected @ expected.T, rtol=0.0, atol=1e-12)
