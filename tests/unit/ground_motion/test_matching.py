"""Spectrum matching: options, bad input, definitions, what a result holds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.intensity import displacement, velocity
from edesign.ground_motion.matching import MatchOptions, match_record, misfit
from edesign.ground_motion.matching.drift import DriftCorrection
from edesign.ground_motion.matching.shape import compare
from edesign.ground_motion.record import Record


@dataclass(frozen=True)
class Flat:
    """A target of one value, with a flaw where a test wants one."""

    value: float = 3.0
    zero_period: float = 3.0
    damping: float = 0.05
    label: str = "flat target"
    last_period: float = np.inf

    def acceleration(self, period: Any) -> np.ndarray:
        return np.full(np.shape(period), self.value)

    def displacement(self, period: Any) -> np.ndarray:
        return self.acceleration(period) * (np.asarray(period) / (2.0 * np.pi)) ** 2


def noise(seconds: float = 20.0, step: float = 0.01, seed: int = 3) -> Record:
    """Noise under an envelope: enough of a motion for bad input and bookkeeping."""
    time = np.arange(round(seconds / step) + 1) * step
    envelope = np.sin(np.pi * time / time[-1]) ** 2
    samples = envelope * np.random.default_rng(seed).normal(size=time.size)
    return Record("noise", samples, step, "test")


def quick(**changes: Any) -> MatchOptions:
    return MatchOptions(method="frequency", periods=(0.1, 2.0), points=30, iterations=4, **changes)


@pytest.mark.parametrize(
    ("change", "code"),
    [
        ({"method": "wavelet"}, "did you mean `wavelets`.*E-VALUE-03"),
        ({"periods": (2.0, 0.1)}, "E-VALUE-04"),
        ({"periods": (1.0, 1.0)}, "E-VALUE-04"),
        ({"periods": (0.0, 1.0)}, "E-VALUE-02"),
        ({"periods": (0.1, np.inf)}, "E-VALUE-02"),
        ({"periods": (0.1, 1.0, 2.0)}, "E-VALUE-01"),
        ({"scale_bounds": (2.0, 0.5)}, "E-VALUE-04"),
        ({"scale_bounds": (-1.0, 2.0)}, "E-VALUE-02"),
        ({"damping": 0.0}, "E-VALUE-02"),
        ({"damping": 5.0}, "E-VALUE-02"),
        ({"points": 1}, "E-VALUE-02"),
        ({"iterations": 0}, "E-VALUE-02"),
        ({"tolerance": 0.0}, "E-VALUE-02"),
        ({"tolerance": np.nan}, "E-VALUE-02"),
    ],
)
def test_options_that_make_no_sense_are_refused_in_words(change: dict[str, Any], code: str) -> None:
    with pytest.raises(InputError, match=f"{next(iter(change))}.*{code}"):
        MatchOptions(**change)


def test_one_scale_is_allowed_and_the_periods_are_even_in_the_logarithm() -> None:
    options = MatchOptions(scale_bounds=(1.0, 1.0), periods=(0.1, 10.0), points=5)
    assert options.matching_periods == pytest.approx([0.1, 10**-0.5, 1.0, 10**0.5, 10.0], rel=1e-12)


@pytest.mark.parametrize(
    ("target", "code"),
    [
        (Flat(value=0.0), "E-MATCH-01"),
        (Flat(value=-1.0), "E-MATCH-01"),
        (Flat(value=np.nan), "E-MATCH-01"),
        (Flat(zero_period=0.0), "E-MATCH-01"),
        (Flat(damping=0.02), "E-MATCH-03"),
    ],
)
def test_targets_that_cannot_be_matched(target: Flat, code: str) -> None:
    with pytest.raises(InputError, match=code):
        match_record(noise(), target, quick())


def test_a_record_of_zeros_cannot_be_matched() -> None:
    with pytest.raises(InputError, match="silence: .*E-REC-23"):
        match_record(Record("silence", np.zeros(2000), 0.01, "test"), Flat(), quick())


def test_a_band_below_the_nyquist_period_names_the_shortest_possible() -> None:
    with pytest.raises(InputError, match=r"below 0\.16 s.*E-MATCH-02"):
        match_record(noise(step=0.08), Flat(), quick())


def test_a_band_too_long_for_the_record_names_the_longest_possible() -> None:
    with pytest.raises(InputError, match=r"above 1\.5 s.*E-MATCH-02"):
        match_record(noise(seconds=3.0), Flat(), quick())


def test_misfit_is_the_relative_error_of_the_ordinates() -> None:
    # errors 0.3, -0.4, 0: rms sqrt(0.25 / 3), the largest in size is the second
    found = misfit(np.array([1.3, 1.2, 5.0]), np.array([1.0, 2.0, 5.0]), np.array([0.1, 0.2, 0.3]))
    assert found.rms == pytest.approx(np.sqrt(0.25 / 3.0), rel=1e-12)
    assert found.largest == pytest.approx(0.4, rel=1e-12)
    assert found.at_period == 0.2


def test_a_match_holds_both_motions_on_one_time_axis() -> None:
    record = noise()
    match = match_record(record, Flat(), quick())
    assert match.original is record and match.method == "frequency"
    assert match.matched.acceleration.size == match.scaled.acceleration.size >= record.acceleration.size
    assert match.matched.time_step == record.time_step and match.matched.name == record.name
    assert match.matched.checksum == record.checksum  # of the samples as read
    assert "matched to flat target over 0.1 to 2 s (frequency)" in match.matched.source
    at = int(np.argmax(np.abs(match.scaled.acceleration))) - int(np.argmax(np.abs(record.acceleration)))
    part = match.scaled.acceleration[at : at + record.acceleration.size]
    assert part == pytest.approx(match.scale * record.acceleration, rel=1e-12)
    assert match.iterations == len(match.history) - 1 <= 4


def test_spectra_of_a_match_stand_on_a_finer_grid_than_the_one_that_was_matched() -> None:
    options = quick()
    match = match_record(noise(), Flat(), options)
    assert match.periods.size >= 300 and match.psa_after.shape == match.target.shape == match.periods.shape
    assert match.periods[[0, -1]] == pytest.approx(options.periods, rel=1e-12)
    shared = np.min(np.abs(np.log(match.periods[1:-1, None] / options.matching_periods)), axis=1)
    assert np.count_nonzero(shared < 1e-9) == 0
    assert match.misfit_after == misfit(match.psa_after, match.target, match.periods)
    assert match.misfit_before == misfit(match.psa_before, match.target, match.periods)
    assert match.pga_ratio == pytest.approx(match.matched.pga / 3.0, rel=1e-12)


def test_the_scale_is_the_best_in_the_logarithms_of_the_ordinates() -> None:
    record = noise()
    match = match_record(record, Flat(), quick())
    assert np.mean(np.log(match.psa_before / match.target)) == pytest.approx(0.0, abs=0.01)  # two grids
    doubled = match_record(record.scaled(2.0), Flat(), quick())
    assert doubled.scale == pytest.approx(0.5 * match.scale, rel=1e-12)


def test_a_scale_at_its_bound_is_reported() -> None:
    match = match_record(noise().scaled(1e-3), Flat(), quick(scale_bounds=(0.5, 2.0)))
    assert match.scale == 2.0
    assert any("the best constant factor would be" in note and "its bound 2 was used" in note for note in match.notes)


def test_a_motion_that_begins_and_ends_abruptly_gets_room() -> None:
    abrupt = Record("abrupt", np.random.default_rng(1).normal(size=1001), 0.01, "test")
    match = match_record(abrupt, Flat(), quick())
    # the longest period is 2 s: half of it before, all of it after, but for what is quiet anyway
    assert 2.9 < match.scaled.duration - abrupt.duration < 3.0 + 2 * 0.01
    assert match.scaled.acceleration[0] == match.scaled.acceleration[-1] == 0.0
    quiet = Record("quiet", np.pad(abrupt.acceleration, 400), 0.01, "test")
    assert match_record(quiet, Flat(), quick()).scaled.duration == quiet.duration


def test_a_misfit_that_is_left_is_reported() -> None:
    match = match_record(noise(), Flat(), replace(quick(), iterations=1))
    assert match.misfit_after.rms > 0.05
    assert any("the spectrum is off by" in note for note in match.notes)


def test_shape_of_a_motion_against_itself_and_its_double() -> None:
    record = noise()
    same, double = compare(record, record), compare(record, record.scaled(2.0))
    assert (same.arias_ratio, same.duration_ratio, same.husid_difference) == (1.0, 1.0, 0.0)
    assert same.correlation == pytest.approx(1.0, abs=1e-12) and same.notes() == ()
    assert double.arias_ratio == pytest.approx(4.0, rel=1e-12)
    assert double.husid_difference == pytest.approx(0.0, abs=1e-12)
    assert len(double.notes()) == 1 and "4.00 times that of the scaled original" in double.notes()[0]


def test_shape_of_a_motion_that_comes_later() -> None:
    early = np.zeros(2001)
    early[100:201] = 1.0
    late = np.roll(early, 1500)
    shape = compare(Record("early", early, 0.01, "test"), Record("late", late, 0.01, "test"))
    assert shape.husid_difference == pytest.approx(1.0, abs=1e-12) and shape.correlation == 0.0
    assert [note.split(":")[0].split(" is ")[0] for note in shape.notes()] == [
        "energy arrives at other times",
        "the correlation with the scaled original",
    ]


STEP, TIME = 0.01, np.arange(4001) * 0.01
WAVE = 0.2 * np.cos(2.0 * np.pi / 5.0 * TIME) * np.exp(-(((TIME - 20.0) / 6.0) ** 2))  # 5 s: to be kept


def test_drift_correction_takes_the_drift_and_leaves_the_wave() -> None:
    corrected = DriftCorrection(TIME.size, STEP, 6.0)(WAVE - 0.004, np.zeros(TIME.size))
    # without it: -0.16 m/s and -3.2 m at the end
    assert velocity(corrected, STEP)[-1] == pytest.approx(0.0, abs=1e-10)
    assert displacement(corrected, STEP)[-1] == pytest.approx(0.0, abs=1e-9)
    assert corrected[[0, -1]] == pytest.approx((WAVE - 0.004)[[0, -1]], abs=1e-12)
    inside = slice(500, -500)  # the correction is zero at the ends, where a constant cannot be taken out
    assert np.max(np.abs(corrected - WAVE)[inside]) < 0.1 * 0.2
    wandering = np.abs(displacement(corrected, STEP) - displacement(WAVE, STEP))
    assert np.max(wandering) < 0.1  # m, of the 3.2 m that were there


def test_drift_of_the_original_is_taken_out_of_the_sum_smoothly() -> None:
    original = 5.0 * WAVE + 0.003  # ends with 0.12 m/s and 2.4 m
    total = original + DriftCorrection(TIME.size, STEP, 6.0)(np.zeros(TIME.size), original)
    assert velocity(total, STEP)[-1] == pytest.approx(0.0, abs=1e-10)
    assert displacement(total, STEP)[-1] == pytest.approx(0.0, abs=1e-9)
    # a parabola with the area of the constant is 1.5 times as high; nothing sharper than that
    assert np.max(np.abs(total - original)) < 2.0 * 0.003
