"""Choice of records, compared with a plain search over all choices and common factors that shares no code with it."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest

from edesign.codes.ec8 import SET_RULES, ElasticSpectrum, national_parameters
from edesign.errors import InputError
from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa
from edesign.ground_motion.selection import Selection, select, select_records, selection_periods
from edesign.ground_motion.selection_scaling import SelectionOptions

T_1 = 1.0
T = SET_RULES.check_periods(T_1)
TARGET = ElasticSpectrum(3.0, national_parameters().horizontal(1, "C"))
WEIGHT = SelectionOptions().scatter_weight


def library(n: int, seed: int, level: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Spectra that wander smoothly around `level` times the target, and peaks of the ground around level a_g S."""
    rng = np.random.default_rng(seed)
    position = np.linspace(0.0, 1.0, T.size)
    waves = [rng.normal(0.0, 0.4 / j, (n, 1)) * np.cos(np.pi * j * position) for j in range(1, 6)]
    logarithm = rng.normal(0.0, 0.4, (n, 1)) + sum(waves)
    return level * TARGET.acceleration(T) * np.exp(logarithm), level * 3.45 * np.exp(rng.normal(0.0, 0.3, n))


def objective(scaled: np.ndarray) -> float:
    ratio = scaled / TARGET.acceleration(T)
    return float(np.mean((ratio.mean(axis=0) - 1.0) ** 2) + WEIGHT * np.mean(ratio.std(axis=0) ** 2))


def plain_search(spectra: np.ndarray, pgas: np.ndarray, k: int) -> tuple[tuple[int, ...], float]:
    """All choices; individual factors by the mean logarithm; 4 000 common factors, those that meet EC8 alone."""
    own = np.exp(-np.log(spectra / TARGET.acceleration(T)).mean(axis=1))
    best: tuple[float, tuple[int, ...]] = (np.inf, ())
    for choice in combinations(range(len(pgas)), k):
        at = list(choice)
        ratio = own[at, None] * spectra[at] / TARGET.acceleration(T)
        lowest, peak = ratio.mean(axis=0).min(), np.mean(own[at] * pgas[at]) / 3.45
        mean, square, variance = ratio.mean(), np.mean(ratio.mean(axis=0) ** 2), np.mean(ratio.std(axis=0) ** 2)
        common = np.linspace(0.5, 3.0, 4001)
        common = common[(common * lowest >= 0.9) & (common * peak >= 1.0)]
        if common.size:
            values = common**2 * (square + WEIGHT * variance) - 2.0 * common * mean + 1.0
            best = min(best, (float(values.min()), choice))
    return best[1], best[0]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("k", [3, 4])
def test_the_best_of_all_choices(seed: int, k: int) -> None:
    spectra, pgas = library(9, seed)
    found = select(T, spectra, pgas, TARGET, T_1, k)
    choice, value = plain_search(spectra, pgas, k)
    assert found.exhaustive and found.chosen == choice
    # the plain search has steps of the common factor of 6e-4: its misfit is at most 1e-3 above the least one
    reached = objective(found.factors[:, None] * spectra[list(found.chosen)])
    assert value - 1e-3 < reached <= value * (1.0 + 1e-9)
    assert found.deviation**2 + WEIGHT * found.scatter**2 == pytest.approx(reached, rel=1e-9)
    assert found.after.passed


@pytest.mark.parametrize("seed", range(6))
def test_greedy_search_with_exchanges_against_all_choices(seed: int) -> None:
    spectra, pgas = library(12, seed)
    every = select(T, spectra, pgas, TARGET, T_1, 5)
    greedy = select(T, spectra, pgas, TARGET, T_1, 5, SelectionOptions(exhaustive_limit=1))
    assert every.exhaustive and not greedy.exhaustive
    best = objective(every.factors[:, None] * spectra[list(every.chosen)])
    reached = objective(greedy.factors[:, None] * spectra[list(greedy.chosen)])
    # no guarantee exists for greedy searches; on these libraries it finds the best of the 792 choices
    assert best <= reached <= best * (1.0 + 1e-12)


def test_better_than_the_usual_choice_of_the_records_that_fit_best_one_by_one() -> None:
    spectra, pgas = library(40, 11)
    found = select(T, spectra, pgas, TARGET, T_1, 7)
    single = np.std(np.log(spectra / TARGET.acceleration(T)), axis=1)
    by_one = select(T, spectra[np.argsort(single)[:7]], pgas[np.argsort(single)[:7]], TARGET, T_1, 7)
    assert not found.exhaustive and found.after.passed
    assert found.deviation < by_one.deviation


def test_the_same_input_gives_the_same_choice() -> None:
    spectra, pgas = library(40, 3)
    first, second = (select(T, spectra, pgas, TARGET, T_1, 7) for _ in range(2))
    assert first.chosen == second.chosen
    np.testing.assert_array_equal(first.factors, second.factors)


def test_one_record_that_is_the_target_is_found() -> None:
    spectra, pgas = library(30, 5)
    exact = [4, 17, 23]
    spectra[exact] = TARGET.acceleration(T) * np.array([[0.5], [1.0], [2.0]])
    pgas[exact] = 3.45 * np.array([0.5, 1.0, 2.0])
    found = select(T, spectra, pgas, TARGET, T_1, 3)
    assert found.chosen == (4, 17, 23)
    np.testing.assert_allclose(found.factors, [2.0, 1.0, 0.5], rtol=1e-8)
    assert found.deviation < 1e-8 and found.scatter < 1e-8 and found.largest_deviation < 1e-8


def test_no_more_of_one_event_than_allowed() -> None:
    spectra, pgas = library(12, 7)
    free = select(T, spectra, pgas, TARGET, T_1, 4)
    events = ["one" if i in free.chosen else f"event {i % 3}" for i in range(12)]
    for limit in (1, 2):
        for most in (1, 100_000):
            options = SelectionOptions(max_per_event=limit, exhaustive_limit=most)
            found = select(T, spectra, pgas, TARGET, T_1, 4, options, events)
            counts = [sum(events[i] == event for i in found.chosen) for event in set(events)]
            assert max(counts) == limit
            assert objective(found.factors[:, None] * spectra[list(found.chosen)]) > objective(
                free.factors[:, None] * spectra[list(free.chosen)]
            )


def test_stations_count_within_their_event() -> None:
    """Two stations of each of four events, two components each: one of a station leaves two of an event."""
    spectra, pgas = library(16, 8)
    events = [f"event {i // 4}" for i in range(16)]
    stations = [f"station {i // 2 % 2}" for i in range(16)]  # alike in all events
    for most in (1, 100_000):
        options = SelectionOptions(max_per_station=1, exhaustive_limit=most)
        found = select(T, spectra, pgas, TARGET, T_1, 5, options, events, stations)
        assert len({(events[i], stations[i]) for i in found.chosen}) == 5
    select(T, spectra, pgas, TARGET, T_1, 8, options, events, stations)
    with pytest.raises(InputError, match="only 8 of 16 .*1 of a station.*E-MATCH-07"):
        select(T, spectra, pgas, TARGET, T_1, 9, options, events, stations)
    with pytest.raises(InputError, match="E-MATCH-06"):
        select(T, spectra, pgas, TARGET, T_1, 5, options, events)


def _unit(found: Selection) -> np.ndarray:
    return found.factors / found.common_factor


def test_ways_of_scaling() -> None:
    spectra, pgas = library(9, 2, level=0.5)
    none = select(T, spectra, pgas, TARGET, T_1, 3, SelectionOptions(scaling="none"))
    np.testing.assert_array_equal(none.factors, 1.0)
    np.testing.assert_array_equal(none.mean_before, none.mean_after)
    assert not none.after.passed

    common = select(T, spectra, pgas, TARGET, T_1, 3, SelectionOptions(scaling="common"))
    np.testing.assert_allclose(common.factors, common.common_factor, rtol=1e-15)
    assert common.after.passed

    individual = select(T, spectra, pgas, TARGET, T_1, 3, SelectionOptions(scaling="individual"))
    assert individual.common_factor == 1.0
    scaled = individual.factors[:, None] * spectra[list(individual.chosen)]
    np.testing.assert_allclose(np.log(scaled / TARGET.acceleration(T)).mean(axis=1), 0.0, atol=1e-12)

    both = select(T, spectra, pgas, TARGET, T_1, 3)
    scaled = _unit(both)[:, None] * spectra[list(both.chosen)]
    np.testing.assert_allclose(np.log(scaled / TARGET.acceleration(T)).mean(axis=1), 0.0, atol=1e-12)
    assert both.after.passed and not both.before.passed


def test_factors_stay_within_their_bounds_and_what_fails_is_reported() -> None:
    spectra, pgas = library(9, 2, level=0.2)
    options = SelectionOptions(scale_bounds=(0.5, 2.0))
    for scaling in ("individual", "common", "both"):
        found = select(T, spectra, pgas, TARGET, T_1, 3, SelectionOptions(scaling, options.scale_bounds))
        assert np.all((found.factors >= 0.5) & (found.factors <= 2.0 * (1.0 + 1e-12)))
        assert not found.after.passed
        failed = [criterion.clause for criterion in found.after.failed]
        assert failed == ["3.2.3.1.2(4)b", "3.2.3.1.2(4)c"]


def test_what_cannot_be_met_is_missed_by_as_little_as_possible() -> None:
    spectra, pgas = library(9, 4, level=0.2)
    options = SelectionOptions("common", (0.5, 2.0))
    found = select(T, spectra, pgas, TARGET, T_1, 3, options)

    def least(choice: tuple[int, ...]) -> float:
        at = list(choice)
        ratio = 2.0 * spectra[at].mean(axis=0) / TARGET.acceleration(T)
        return min(1.0, float(ratio.min()) / 0.9, 2.0 * float(pgas[at].mean()) / 3.45)

    assert least(found.chosen) == max(least(choice) for choice in combinations(range(9), 3))


def test_two_records_never_meet_the_code() -> None:
    spectra, pgas = library(6, 1)
    found = select(T, spectra, pgas, TARGET, T_1, 2)
    assert [criterion.clause for criterion in found.after.failed] == ["3.2.3.1.2(4)a"]


def test_the_band_of_misfit_may_be_wider_than_that_of_the_code() -> None:
    options = SelectionOptions(band=(0.05, 6.0))
    periods = selection_periods(SET_RULES, T_1, options)
    assert periods[0] <= 0.05 and periods[-1] >= 6.0
    assert np.max(periods[1:] / periods[:-1]) < 1.012
    np.testing.assert_allclose(periods[(periods > 0.1999) & (periods < 2.0001)], T, rtol=1e-12)
    rng = np.random.default_rng(9)
    spectra = TARGET.acceleration(periods) * np.exp(rng.normal(0.0, 0.1, (8, periods.size)))
    found = select(periods, spectra, np.full(8, 3.45), TARGET, T_1, 3, options)
    inside = (periods >= 0.05) & (periods <= 6.0)
    ratio = found.mean_after[inside] / TARGET.acceleration(periods[inside])
    assert found.deviation == pytest.approx(np.sqrt(np.mean((ratio - 1.0) ** 2)), rel=1e-12)
    with pytest.raises(InputError, match="E-MATCH-04"):
        select(T, *library(5, 1), TARGET, T_1, 3, options)


def test_records_are_chosen_by_their_own_spectra() -> None:
    """Decaying sines of different periods and sizes: the spectra of the scaled records are what was reported."""
    time = 0.01 * np.arange(2000)
    records = []
    for i, period in enumerate([0.3, 0.5, 0.8, 1.2, 1.6]):
        motion = (1 + i) * np.exp(-0.2 * time) * np.sin(2 * np.pi * time / period)
        records.append(Record(f"sine {period}", motion, 0.01, "computed"))
    found = select_records(records, TARGET, T_1, 3)
    scaled = [records[i].scaled(factor) for i, factor in zip(found.chosen, found.factors, strict=True)]
    mean = np.mean([psa(record.acceleration, record.time_step, found.periods) for record in scaled], axis=0)
    np.testing.assert_allclose(mean, found.mean_after, rtol=1e-9)
    pga = np.mean([record.pga for record in scaled])
    assert found.after.criteria[1].value == pytest.approx(pga, rel=1e-12)


def test_bad_input_is_refused() -> None:
    spectra, pgas = library(5, 1)
    with pytest.raises(InputError, match="only 5 of 5.*E-MATCH-07"):
        select(T, spectra, pgas, TARGET, T_1, 6)
    with pytest.raises(InputError, match="E-VALUE-02"):
        select(T, spectra, pgas, TARGET, T_1, 0)
    one_event = SelectionOptions(max_per_event=2)
    with pytest.raises(InputError, match="only 2 of 5 .*2 of an event.*E-MATCH-07"):
        select(T, spectra, pgas, TARGET, T_1, 3, one_event, ["same"] * 5)
    with pytest.raises(InputError, match="E-MATCH-06"):
        select(T, spectra, pgas, TARGET, T_1, 3, one_event)
    with pytest.raises(InputError, match="E-MATCH-05"):
        select(T, spectra * 0.0, pgas, TARGET, T_1, 3)
    with pytest.raises(InputError, match="shape"):
        select(T, spectra[:, 1:], pgas, TARGET, T_1, 3)
    with pytest.raises(InputError, match="bounds.*E-VALUE-04"):
        SelectionOptions(scale_bounds=(2.0, 1.0))
    with pytest.raises(InputError, match="band.*E-VALUE-04"):
        SelectionOptions(band=(2.0, 1.0))
    with pytest.raises(InputError, match="weight.*E-VALUE-02"):
        SelectionOptions(scatter_weight=-1.0)
    with pytest.raises(InputError, match="max_per_event.*E-VALUE-02"):
        SelectionOptions(max_per_event=0)
