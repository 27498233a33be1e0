"""Statistics of few numbers that can be worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from edesign.assess.statistics import STATISTICS, counted_percentile, statistics


def test_four_histories_of_five() -> None:
    found = statistics({"a": 1.0, "b": 8.0, "c": None, "d": 2.0, "e": 4.0})
    assert (found.count, found.mean, found.maximum, found.minimum, found.median) == (4, 3.75, 8.0, 1.0, 3.0)
    assert (found.governing, found.missing) == ("b", ("c",))
    assert found.percentile_84 == 8.0  # the 4th of 4: 0.84 * 4 = 3.36
    # logarithms 0, 1, 2, 3 times ln 2 about 1.5: the sum of squares is 5, over n - 1 = 3
    assert found.dispersion == pytest.approx(math.log(2.0) * math.sqrt(5.0 / 3.0), rel=1e-14)
    assert [of(found) for of in STATISTICS.values()] == [3.75, 8.0, 3.0, 8.0]


@pytest.mark.parametrize(("count", "rank"), [(1, 1), (6, 6), (20, 17), (25, 21), (50, 42), (100, 84)])
def test_84_per_cent_are_counted(count: int, rank: int) -> None:
    assert counted_percentile([float(value) for value in range(count, 0, -1)], 0.84) == rank


@given(st.lists(st.floats(0.0, 1e9), min_size=1, max_size=40), st.floats(0.01, 1.0))
def test_the_counted_percentile_is_numpys_inverted_cdf(values: list[float], fraction: float) -> None:
    if abs(fraction * len(values) - round(fraction * len(values))) > 1e-6:  # else both may round to either side
        assert counted_percentile(values, fraction) == np.quantile(values, fraction, method="inverted_cdf")


def test_zeros_have_no_dispersion_and_nothing_has_no_statistics() -> None:
    assert statistics({"a": 0.0, "b": 1.0}).dispersion is None
    assert statistics({"a": 0.0, "b": 1.0}).mean == 0.5
    assert statistics({"a": 3.0}).dispersion is None
    empty = statistics({"a": None})
    assert (empty.count, empty.mean, empty.median, empty.governing, empty.missing) == (0, None, None, "", ("a",))


def test_infinite_values_leave_order_statistics_finite() -> None:
    found = statistics({"a": 1.0, "b": 2.0, "c": math.inf})
    assert (found.median, found.maximum, found.mean) == (2.0, math.inf, math.inf)
    assert found.dispersion is None
