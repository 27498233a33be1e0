"""Choice of records for a project, against a plain search over all sets that shares only the response spectrum.

The factor of a record alone is in closed form: least squares of ln(psa / target) over the band gives the mean of the
logarithms. What sets are compared by, and the bounds, are written here again.
"""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from support.messages import says

from edesign.codes.ec8 import SET_RULES, ElasticSpectrum, national_parameters
from edesign.errors import InputError
from edesign.ground_motion.record_choice import EarlierChoice, RecordChoice, choose
from edesign.ground_motion.response_spectrum import psa
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.records.chosen_records import ChosenRecords

T1, STEP, WEIGHT = 0.4, 0.01, 0.3
TARGET = ElasticSpectrum(2.0, national_parameters().horizontal(1, "B"))
T = SET_RULES.check_periods(T1)


def motion(seed: int) -> np.ndarray:
    """Ground acceleration, m/s2: 60 waves with random phases whose spectrum wanders about a multiple of the target."""
    rng = np.random.default_rng(seed)
    t = np.arange(800) * STEP
    period = np.geomspace(0.06, 1.0, 60)
    waves = np.sin(2.0 * np.pi * np.outer(1.0 / period, t) + rng.uniform(0.0, 2.0 * np.pi, 60)[:, None])
    waves *= np.sin(np.pi * t / 8.0) ** 2
    size = np.ones(60)
    for _ in range(5):
        size *= TARGET.acceleration(period) / psa(size @ waves, STEP, period)
    position = np.linspace(0.0, np.pi, 60)
    wander = sum(rng.normal(0.0, 0.25 / j) * np.cos(j * position) for j in range(1, 5))
    return rng.uniform(0.5, 2.0) * (size * np.exp(wander)) @ waves


def write(folder: Path, motions: dict[str, np.ndarray], titles: dict[str, str] | None = None) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for name, values in motions.items():
        rows = "\n".join(f"{value:.12e}" for value in values / STANDARD_GRAVITY)
        title = (titles or {}).get(name, "Somewhere")
        head = f"PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"
        (folder / f"{name}.AT2").write_text(f"{head}NPTS= {values.size}, DT= {STEP} SEC\n{rows}\n")


def chosen(folder: Path, count: int, source: object = None, **keys: object) -> RecordChoice:
    about = {"choose": count, "from": source or {"folder": "all"}, "scatter_weight": WEIGHT, **keys}
    return choose(ChosenRecords.model_validate(about), folder / "project.yaml", TARGET, T1)


def best_of_all(
    motions: dict[str, np.ndarray], count: int, bounds: tuple[float, float], groups: dict[str, str] | None = None
) -> tuple[tuple[str, ...], np.ndarray]:
    """The set with individual factors that meets EC8 and has the least misfit, of all sets."""
    names = sorted(motions)
    spectra = np.array([psa(motions[name], STEP, T) for name in names])
    ratio = spectra / TARGET.acceleration(T)
    factors = np.clip(np.exp(-np.log(ratio).mean(axis=1)), *bounds)
    peaks = factors * np.array([np.abs(motions[name]).max() for name in names]) / TARGET.zero_period
    best: tuple[bool, float, tuple[int, ...]] = (True, np.inf, ())
    for sample in combinations(range(len(names)), count):
        at = list(sample)
        if groups and len({groups[names[i]] for i in sample}) < count:
            continue
        scaled = factors[at, None] * ratio[at]
        missed = scaled.mean(axis=0).min() < 0.9 or peaks[at].mean() < 1.0
        misfit = np.mean((scaled.mean(axis=0) - 1.0) ** 2) + WEIGHT * np.mean(scaled.var(axis=0))
        best = min(best, (bool(missed), float(misfit), sample))
    assert not best[0], "no set meets the criteria: the catalogue is no test"
    return tuple(names[i] for i in best[2]), factors[list(best[2])]


@pytest.fixture(scope="module")
def motions() -> dict[str, np.ndarray]:
    return {f"m{seed:02d}": motion(seed) for seed in range(11)}


@pytest.fixture(scope="module")
def folder(motions: dict[str, np.ndarray], tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("choice")
    titles = {name: f"Event{i // 3}, 1/1/1990, Station{i // 2}, {i}" for i, name in enumerate(motions)}
    write(path / "all", motions, titles)
    return path


@pytest.mark.parametrize("count", [3, 4])
@pytest.mark.parametrize("bounds", [(0.2, 5.0), (0.8, 1.6)])
def test_the_best_of_all_sets(
    folder: Path, motions: dict[str, np.ndarray], count: int, bounds: tuple[float, float]
) -> None:
    found = chosen(folder, count, scaling="individual", scale_bounds=bounds, max_per_station=2)
    names, factors = best_of_all(motions, count, bounds)
    assert tuple(found.candidates) == names
    # files have 13 digits; the spectrum is linear in the motion
    assert list(found.factors.values()) == pytest.approx(factors.tolist(), rel=1e-9)
    assert found.selection.exhaustive and found.compared == 11 and found.selection.after.passed


def test_one_of_each_station_and_event(folder: Path, motions: dict[str, np.ndarray]) -> None:
    """Stations count within their earthquake: m02 and m03 are of one station, and of two events."""
    wide = (0.2, 5.0)
    names = list(motions)
    stations = {name: f"{i // 3} {i // 2}" for i, name in enumerate(names)}
    events = {name: f"{i // 3}" for i, name in enumerate(names)}
    by_station = chosen(folder, 4, scaling="individual", scale_bounds=wide)  # one of a station by default
    by_event = chosen(folder, 4, scaling="individual", scale_bounds=wide, max_per_event=1)
    assert tuple(by_station.candidates) == best_of_all(motions, 4, wide, stations)[0]
    assert tuple(by_event.candidates) == best_of_all(motions, 4, wide, events)[0]
    with pytest.raises(InputError, match="5 .* 4 of 11 .* 1 of an event .*E-MATCH-07"):
        chosen(folder, 5, max_per_event=1)


def test_neither_names_nor_order_nor_places_of_the_files_matter(
    folder: Path, motions: dict[str, np.ndarray], tmp_path: Path
) -> None:
    """The same motions under other names, in two folders: the same ones are chosen, with the same factors."""
    first = chosen(folder, 4, max_per_station=2)
    other = {name: f"z{(7 * i) % 11:02d}" for i, name in enumerate(motions)}
    for i, (name, values) in enumerate(motions.items()):
        write(tmp_path / ("left" if i % 2 else "right"), {other[name]: values})
    for sources in (({"folder": "left"}, {"folder": "right"}), ({"folder": "right"}, {"folder": "left"})):
        again = chosen(tmp_path, 4, sources)
        assert set(again.candidates) == {other[name] for name in first.candidates}
        for name, factor in first.factors.items():
            assert again.factors[other[name]] == pytest.approx(factor, rel=1e-12)


def test_a_motion_times_a_number_has_its_factor_divided_by_it(folder: Path, tmp_path: Path) -> None:
    found = chosen(folder, 4, max_per_station=2, scale_bounds=(0.01, 100.0))
    names = list(found.candidates)
    motions = {f"m{seed:02d}": motion(seed) * (3.0 if f"m{seed:02d}" == names[0] else 1.0) for seed in range(11)}
    write(tmp_path / "all", motions)
    times_3 = chosen(tmp_path, 4, scale_bounds=(0.01, 100.0))
    assert list(times_3.candidates) == names
    assert times_3.factors[names[0]] == pytest.approx(found.factors[names[0]] / 3.0, rel=1e-9)
    assert times_3.factors[names[1]] == pytest.approx(found.factors[names[1]], rel=1e-9)


def test_the_band_follows_T1_or_is_given(folder: Path) -> None:
    of_T1 = chosen(folder, 3, periods=("0.5 T_1", "1.5 T_1"))
    given = chosen(folder, 3, periods=("0.2 s", "0.6 s"))
    assert of_T1.band == pytest.approx((0.2, 0.6)) and given.band == (0.2, 0.6)
    assert of_T1.factors == pytest.approx(dict(given.factors), rel=1e-9)
    assert of_T1.fit_band == pytest.approx((0.08, 0.8))  # what EC8 checks, 0.2 T1 to 2 T1
    with pytest.raises(InputError, match="1 s to 0.8 s, with T_1 = 0.4 s, .*E-MATCH-04"):
        chosen(folder, 3, periods=("1 s", "2 T_1"))


def test_an_earlier_choice_is_taken_only_where_nothing_has_changed(folder: Path) -> None:
    """A made-up earlier choice of other records shows whether it was taken; the right one changes no bit."""
    keys = {"max_per_station": 2}
    found = chosen(folder, 4, **keys)
    names = tuple(found.candidates)
    spec = ChosenRecords.model_validate({"choose": 4, "from": {"folder": "all"}, "scatter_weight": WEIGHT, **keys})

    def again(checksum: str, of: tuple[str, ...], T_1: float = T1) -> RecordChoice:
        return choose(spec, folder / "project.yaml", TARGET, T_1, EarlierChoice(checksum, of, False))

    taken = again(found.checksum, names)
    assert taken.selection.chosen == found.selection.chosen and taken.compared == found.compared == 11
    assert not taken.selection.exhaustive  # as the earlier choice says
    np.testing.assert_array_equal(taken.selection.factors, found.selection.factors)
    np.testing.assert_array_equal(taken.selection.mean_after, found.selection.mean_after)
    others = tuple(sorted({"m00", "m01", "m02", "m03", "m04", "m05"} - set(names)))[:2] + names[:2]
    assert set(again(found.checksum, others).candidates) == set(others)
    assert tuple(again("another", others).candidates) == names
    assert set(again(found.checksum, others, 1.01 * T1).candidates) != set(others)


def test_too_few_candidates_are_reported_with_what_was_left_out(tmp_path: Path) -> None:
    write(tmp_path / "all", {"one": motion(1)})
    (tmp_path / "all" / "bad.AT2").write_text("nothing\n")
    with pytest.raises(InputError) as caught:
        chosen(tmp_path, 3)
    assert says(str(caught.value), "3 1 of 1 left out: bad: all/bad.AT2:1: E-MATCH-07")
    (tmp_path / "all" / "one.AT2").unlink()
    with pytest.raises(InputError, match=r"\n    left out: bad(.|\n)*E-MATCH-07"):
        chosen(tmp_path, 3)
    (tmp_path / "all" / "bad.AT2").unlink()
    with pytest.raises(InputError, match=rf"{tmp_path / 'all'} and all .* \.at2, .*E-MATCH-07"):
        chosen(tmp_path, 3)
