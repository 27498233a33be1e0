"""Matching leaves a motion that fits alone, and never returns a motion that is farther from the target than another.

References: the own spectrum of a record is a target of which the misfit is zero, at every period.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from shared_records import needs_recordings, recordings
from verification.own_spectrum import Own
from verification.test_verify_matching_frequency import DBE, synthetic

from edesign.ground_motion.matching import MatchOptions, match_record
from edesign.ground_motion.matching.closeness import SPREAD, Closeness, Closest
from edesign.ground_motion.matching.options import Method
from edesign.ground_motion.matching.ordinates import ordinates
from edesign.ground_motion.record import Record

METHODS: tuple[Method, ...] = ("wavelets", "frequency")


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("points", [20, 100])
@pytest.mark.parametrize("factor", [1.0, 2.5])
def test_a_record_matched_to_its_own_spectrum_stays_as_it_is(method: Method, points: int, factor: float) -> None:
    """Bit by bit, with few matching periods too: between them the spectrum of a record is no straight line."""
    record = synthetic()
    target = Own(record.scaled(factor))
    match = match_record(record, target, MatchOptions(method=method, points=points))
    assert match.scale == pytest.approx(factor, rel=1e-12) and match.iterations == 0 and match.lead == 0.0
    np.testing.assert_array_equal(match.matched.acceleration, match.scale * record.acceleration)
    assert match.misfit_after.largest < 1e-11 and match.notes == ()


@pytest.mark.parametrize("method", METHODS)
def test_a_motion_that_drifts_but_fits_is_left_alone_and_its_drift_is_reported(method: Method) -> None:
    still = synthetic()
    drifting = Record("drifting", still.acceleration + 0.004, still.time_step, "made here")
    match = match_record(drifting, Own(drifting), MatchOptions(method=method))
    np.testing.assert_array_equal(match.matched.acceleration, match.scale * drifting.acceleration)
    assert any("still moves" in note for note in match.notes)


@needs_recordings
@pytest.mark.parametrize("method", METHODS)
def test_recordings_stay_as_they_are_too(method: Method) -> None:
    for record in recordings():
        match = match_record(record, Own(record), MatchOptions(method=method))
        np.testing.assert_array_equal(match.matched.acceleration, match.scale * record.acceleration)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("points", [20, 100])
def test_a_target_near_the_own_spectrum_comes_nearer(method: Method, points: int) -> None:
    """A wave of 2 % on the own spectrum, rms 1.4 %; wavelets to interpolated targets end at several per cent."""
    record = synthetic()
    match = match_record(record, Own(record, ripple=0.02), MatchOptions(method=method, points=points))
    assert match.misfit_before.rms == pytest.approx(0.02 / np.sqrt(2.0), rel=0.05)
    assert match.misfit_after.rms < 0.7 * match.misfit_before.rms


@pytest.mark.parametrize("method", METHODS)
def test_more_iterations_never_come_out_farther(method: Method) -> None:
    """Judged as the result is: rms, or a quarter of the largest, at periods that are not the matching ones."""
    record, options = synthetic(seed=4), MatchOptions(method=method, points=40, periods=(0.1, 4.0))
    measure = Closeness(DBE.acceleration, options.matching_periods, record.time_step, 0.05, DBE.zero_period)
    reached = [
        measure(match_record(record, DBE, replace(options, iterations=n)).matched.acceleration) for n in (1, 2, 3, 6)
    ]
    assert reached == sorted(reached, reverse=True)
    assert reached[0] < measure(match_record(record, DBE, replace(options, method="scale")).matched.acceleration)


def test_the_closest_motion_is_kept() -> None:
    closeness = Closeness(lambda period: np.ones_like(period), np.array([0.1, 1.0]), 0.01, 0.05, 1.0)
    motions = [np.concatenate((np.zeros(50), [a], np.zeros(50))) for a in (1.0, 1.2, 0.9, 1.2, 1.1)]
    distances = [closeness(motion) for motion in motions]
    assert len(set(distances)) == 4
    closest = Closest(motions[0], closeness)
    for motion in motions[1:]:
        closest.try_(motion)
    assert closest.misfit == min(distances) and closest.motion is motions[int(np.argmin(distances))]


def test_closeness_is_rms_or_a_quarter_of_the_largest() -> None:
    """A motion whose spectrum is its target but for the ground, which is off by 60 %: a quarter of that counts."""
    record = synthetic()
    periods = np.geomspace(0.1, 3.0, 30)
    own = Own(record)
    exact = Closeness(own.acceleration, periods, record.time_step, 0.05, record.pga)
    assert exact(record.acceleration) < 1e-12
    off = Closeness(own.acceleration, periods, record.time_step, 0.05, record.pga / 1.6)
    assert off(record.acceleration) == pytest.approx(0.6 / SPREAD, rel=1e-9)
    assert Closeness(own.acceleration, periods, record.time_step, 0.05, None)(record.acceleration) < 1e-12


def test_targets_are_asked_at_their_own_periods() -> None:
    """Between matching periods 20 % apart a wavy target is what it is there, not a line from one to the next."""

    def wavy(period: np.ndarray) -> np.ndarray:
        return 1.0 + 0.5 * np.sin(20.0 * np.log(period))

    goal = ordinates(np.geomspace(0.1, 2.0, 17), wavy, 0.05, None)
    assert goal.periods.size > 5 * 16
    np.testing.assert_array_equal(goal.target[:-1], wavy(goal.periods))
