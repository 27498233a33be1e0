"""The factor that makes the mean of a suite satisfy EN 1998-1:2004, 3.2.3.1.2(4), against the criteria themselves."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from edesign.codes.ec8 import SET_RULES, ElasticSpectrum, national_parameters
from edesign.ground_motion.matching import Match, MatchOptions, match_record
from edesign.ground_motion.matching.raising import MOST, raised, suite_factor
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.simulation import simulate

T_1 = 0.8
TARGET = ElasticSpectrum(2.0, national_parameters().horizontal(1, "B"))


@pytest.fixture(scope="module")
def matches() -> list[Match]:
    options = MatchOptions(method="scale", periods=(0.16, 1.6))
    return [match_record(simulate(6.5, 15e3, 400.0, seed), TARGET, options) for seed in (1, 2, 3)]


def failed_clauses(matches: list[Match]) -> set[str]:
    periods = SET_RULES.check_periods(T_1)
    records = [match.matched for match in matches]
    spectra = [psa(record.acceleration, record.time_step, periods) for record in records]
    check = SET_RULES.check(periods, spectra, [record.pga for record in records], TARGET, T_1)
    return {criterion.clause for criterion in check.failed}


def test_it_is_the_least_with_which_the_criteria_hold(matches: list[Match]) -> None:
    """Just below it one of b and c fails, which the code's own check says; at it none does."""
    factor = suite_factor(matches, TARGET, (T_1,))
    assert 1.0 < factor < MOST
    assert failed_clauses([raised(match, factor) for match in matches]) == set()
    below = failed_clauses([raised(match, factor * (1.0 - 1e-6)) for match in matches])
    assert len(below) == 1 and below < {"3.2.3.1.2(4)b", "3.2.3.1.2(4)c"}


def test_without_a_period_only_the_peaks_count(matches: list[Match]) -> None:
    mean = float(np.mean([match.matched.pga for match in matches]))
    peaks = [raised(match, 0.8 * TARGET.zero_period / mean) for match in matches]
    assert suite_factor(peaks, TARGET, None) == pytest.approx(1.25, rel=1e-8)


def test_it_never_lowers_a_suite_and_has_a_limit(matches: list[Match]) -> None:
    assert suite_factor([raised(match, 10.0) for match in matches], TARGET, (T_1,)) == 1.0
    assert suite_factor([raised(match, 0.1) for match in matches], TARGET, (T_1,)) == MOST


def test_all_that_is_said_of_a_raised_record_is_that_of_the_product(matches: list[Match]) -> None:
    """Accelerations, velocities and spectra follow the factor, Arias intensity its square, durations stay."""
    match = matches[0]
    twice = raised(match, 2.0)
    assert np.array_equal(twice.matched.acceleration, 2.0 * match.matched.acceleration)
    record = twice.matched
    assert twice.psa_after == pytest.approx(psa(record.acceleration, record.time_step, match.periods), rel=1e-12)
    assert twice.misfit_after.rms == pytest.approx(np.sqrt(np.mean((twice.psa_after / match.target - 1.0) ** 2)))
    before, after = match.after, twice.after
    assert (after.pga, after.pgv, after.arias) == pytest.approx((2 * before.pga, 2 * before.pgv, 4 * before.arias))
    assert after.duration_5_95 == pytest.approx(before.duration_5_95)
    assert twice.shape == replace(match.shape, arias_ratio=4.0 * match.shape.arias_ratio)
    assert twice.suite_factor == 2.0 and raised(twice, 1.5).suite_factor == 3.0


def test_notes_on_the_shape_are_those_of_the_raised_record(matches: list[Match]) -> None:
    """1.3 squared is within the bound on the Arias intensity, 1.4 squared is not; back at 1 nothing is left of it."""
    assert not any("Arias" in note for note in raised(matches[0], 1.3).notes)
    beyond = raised(matches[0], 1.4)
    assert sum("the Arias intensity is 1.96 times" in note for note in beyond.notes) == 1
    assert raised(beyond, 1.0 / 1.4).notes == matches[0].notes
