"""Criteria of EN 1998-1:2004, 3.2.3.1.2 and 4.3.3.4.3(3): for each an example that passes and one that fails."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import ArrayLike

from edesign.codes.asce7.ground_motions import set_rules
from edesign.codes.ec8 import SET_RULES, RuleCheck
from edesign.codes.motion_sets import SetCheck, SetRules
from edesign.codes.ntc2018.accelerograms import SERVICEABILITY, ULTIMATE
from edesign.errors import InputError

check_accelerograms, check_periods = SET_RULES.check, SET_RULES.check_periods
NUMBER, ZERO_PERIOD, MEAN, STATIONARY, USE = range(5)
T = check_periods(1.0)  # 0.2 s to 2 s


@dataclass(frozen=True)
class Flat:
    """A target of 2 m/s2 at all periods but zero, where it is 1 m/s2."""

    label: str = "flat"
    damping: float = 0.05
    zero_period: float = 1.0
    last_period: float = np.inf

    def acceleration(self, period: ArrayLike) -> np.ndarray:
        return np.full(np.shape(period), 2.0)

    def displacement(self, period: ArrayLike) -> np.ndarray:
        return self.acceleration(period) * (np.asarray(period) / (2.0 * np.pi)) ** 2


def check(levels: list[float], pgas: list[float] | None = None, **more: object) -> SetCheck:
    """Records with flat spectra of these levels, m/s2."""
    spectra = np.array(levels)[:, None] * np.ones(T.size)
    return check_accelerograms(T, spectra, pgas or [1.0] * len(levels), Flat(), 1.0, **more)  # type: ignore[arg-type]


def found(result: SetCheck, which: int) -> tuple[float | None, float | None, bool | None]:
    criterion = result.criteria[which]
    return criterion.required, criterion.value, criterion.passed


def test_a_suite_that_meets_everything() -> None:
    result = check([1.7, 2.0, 2.3])
    assert result.passed and not result.failed
    assert [criterion.clause for criterion in result.criteria] == [
        "3.2.3.1.2(4)a",
        "3.2.3.1.2(4)b",
        "3.2.3.1.2(4)c",
        "3.2.3.1.2(2)P, (3)",
        "4.3.3.4.3(3)",
    ]


def test_at_least_three_records() -> None:
    assert found(check([2.0, 2.0, 2.0]), NUMBER) == (3, 3.0, True)
    two = check([2.0, 2.0])
    assert found(two, NUMBER) == (3, 2.0, False)
    assert not two.passed and two.failed == (two.criteria[NUMBER],)


def test_mean_zero_period_acceleration() -> None:
    # one record may lie below a_g S = 1 as long as the mean, (0.7 + 1.0 + 1.3) / 3, does not
    assert found(check([2.0] * 3, [0.7, 1.0, 1.3]), ZERO_PERIOD) == (1.0, pytest.approx(1.0), True)
    low = check([2.0] * 3, [0.7, 1.0, 1.2])
    assert found(low, ZERO_PERIOD) == (1.0, pytest.approx(2.9 / 3.0), False)
    assert not low.passed and low.criteria[ZERO_PERIOD].unit == "m/s2"


def test_mean_spectrum() -> None:
    # means 1.8 and 1.797 of 2: exactly 90 % is enough
    assert found(check([1.2, 1.8, 2.4]), MEAN) == (0.9, pytest.approx(0.9), True)
    assert found(check([1.2, 1.8, 2.391]), MEAN) == (0.9, pytest.approx(0.8985), False)


def test_one_valley_inside_the_band_fails_and_is_located() -> None:
    spectra = np.full((3, T.size), 2.0)
    at = 77
    spectra[:, at] = [1.5, 1.8, 2.0]  # mean 5.3 / 3 = 1.7667, ratio 0.8833
    result = check_accelerograms(T, spectra, [1.0] * 3, Flat(), 1.0)
    assert found(result, MEAN) == (0.9, pytest.approx(5.3 / 6.0), False)
    assert (result.worst_period, result.worst_ratio) == (T[at], pytest.approx(5.3 / 6.0))
    assert result.criteria[MEAN].detail == f"at T = {T[at]:.3g} s"


def test_valleys_outside_the_band_do_not_count() -> None:
    periods = np.concatenate(([0.05, 0.1], T, [3.0]))
    spectra = np.full((3, periods.size), 2.0)
    spectra[:, :2] = spectra[:, -1:] = 0.1
    assert check_accelerograms(periods, spectra, [1.0] * 3, Flat(), 1.0).passed


def test_the_ends_of_the_band_count() -> None:
    for end in (0, -1):
        spectra = np.full((3, T.size), 2.0)
        spectra[:, end] = 1.7
        assert not check_accelerograms(T, spectra, [1.0] * 3, Flat(), 1.0).passed


def test_without_t1_the_mean_spectrum_stays_open() -> None:
    periods = np.array([0.5, 3.0])  # no band to cover
    spectra = np.full((3, 2), 0.1)
    result = check_accelerograms(periods, spectra, [1.0] * 3, Flat(), None)
    assert found(result, MEAN) == (0.9, None, None) and result.worst_period is None
    assert result.passed is None
    assert check_accelerograms(periods, spectra, [0.5] * 3, Flat(), None).passed is False


def test_stationary_part_of_artificial_records() -> None:
    assert found(check([2.0] * 3), STATIONARY) == (10.0, None, None)
    assert "not applicable" in check([2.0] * 3).criteria[STATIONARY].detail
    assert found(check([2.0] * 3, artificial_durations=[12.0, 10.0]), STATIONARY) == (10.0, 10.0, True)
    short = check([2.0] * 3, artificial_durations=[12.0, 9.9])
    assert found(short, STATIONARY) == (10.0, 9.9, False) and not short.passed


def test_seven_records_allow_the_mean() -> None:
    six, seven = check([2.0] * 6).criteria[USE], check([2.0] * 7).criteria[USE]
    assert (six.required, six.value, six.passed) == (7, 6.0, None)
    assert six.detail == "the most unfavourable response counts"
    assert seven.detail == "the mean of the responses may be used"


def test_a_rule_that_only_informs_hides_no_failure() -> None:
    result = SetCheck((RuleCheck("x", "x", 1.0, 0.5, "", False), RuleCheck("y", "y", 1, 1, "", None)), 1.0, 1.0)
    assert not result.passed


def test_periods_reach_from_0_2_to_2_t1() -> None:
    periods = check_periods(2.65)
    assert periods[0] == pytest.approx(0.53, rel=1e-12) and periods[-1] == pytest.approx(5.3, rel=1e-12)
    assert np.max(periods[1:] / periods[:-1]) < 1.012


@pytest.mark.parametrize("rules", [SET_RULES, ULTIMATE, SERVICEABILITY, set_rules("7-16"), set_rules("7-22")])
def test_the_ends_of_the_band_are_points_of_the_grid(rules: SetRules) -> None:
    """To the bit, whatever T_1: a mean that is just enough fails nowhere, and the target ends with the band."""
    for T_1 in np.random.default_rng(1).uniform(0.05, 5.0, 300):
        low, high = rules.period_band(T_1)
        periods = rules.check_periods(T_1)
        assert (periods[0], periods[-1]) == (low, high)
        target = Flat(last_period=high)
        spectra = np.tile(rules.least_ratio * target.acceleration(periods), (11, 1))
        assert rules.check(periods, spectra, [10.0] * 11, target, T_1).failed == ()


@pytest.mark.parametrize(
    "periods",
    [
        T[1:],  # the shorter end is missing
        T[:-1],
        T[::-1],
        np.geomspace(0.2, 2.0, 40),  # 6 % apart
        np.delete(T, slice(50, 56)),
    ],
)
def test_periods_that_cannot_show_a_valley_are_refused(periods: np.ndarray) -> None:
    with pytest.raises(InputError, match="E-EC8-07"):
        check_accelerograms(periods, np.full((3, periods.size), 2.0), [1.0] * 3, Flat(), 1.0)


def test_bad_input_is_refused() -> None:
    spectra = np.full((3, T.size), 2.0)
    with pytest.raises(InputError, match="E-EC8-07"):
        check_accelerograms(T, spectra, [1.0] * 3, Flat(damping=0.02), 1.0)
    with pytest.raises(InputError, match="E-VALUE-01"):
        check_accelerograms(T, spectra, [1.0] * 2, Flat(), 1.0)
    with pytest.raises(InputError, match="E-VALUE-01"):
        check_accelerograms(T, spectra[:0], [], Flat(), 1.0)
    with pytest.raises(InputError, match="E-VALUE-02"):
        check_accelerograms(T, np.where(spectra > 0, np.nan, 0), [1.0] * 3, Flat(), 1.0)
    with pytest.raises(InputError, match="T_1 .*E-VALUE-02"):
        check_accelerograms(T, spectra, [1.0] * 3, Flat(), 0.0)
    with pytest.raises(InputError, match="E-EC8-07"):
        check_periods(1.0, points=30)
