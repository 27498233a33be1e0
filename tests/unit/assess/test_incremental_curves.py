"""Counts, capacities and fractiles of curves that can be read off."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.assess.fragility import fit_capacities
from edesign.assess.incremental import (
    COLLAPSE,
    Stripes,
    capacities,
    collect_stripes,
    fractile_curves,
    last_intensities,
    stripe_counts,
)
from edesign.assess.limit_fragility import limit_fragility

INF, NAN = np.inf, np.nan
IM = np.array([1.0, 2.0, 3.0, 4.0])
VALUES = np.array(
    [
        [0.01, 0.02, 0.03, 0.04],  # elastic throughout
        [0.01, 0.03, INF, INF],  # collapses at 3
        [0.02, NAN, 0.04, INF],  # lost at 2, collapses at 4
        [0.01, 0.03, 0.02, 0.05],  # comes back at 3
        [NAN, NAN, NAN, NAN],
    ]
)
STRIPES = Stripes("ida", "bare", "interstorey_drift", ("a", "b", "c", "d", "e"), IM, VALUES)


def test_counts_leave_out_what_is_missing() -> None:
    analyses, passed = stripe_counts(STRIPES, 0.025)
    assert analyses.tolist() == [4, 3, 4, 4]
    assert passed.tolist() == [0, 2, 3, 4]
    assert stripe_counts(STRIPES, COLLAPSE)[1].tolist() == [0, 0, 1, 2]
    assert len(STRIPES.missing) == 5 and STRIPES.missing[0] == ("c", 2.0)


def test_capacities_are_interpolated() -> None:
    """Linear between points and from zero; half way to a collapse; over a lost point; the first of two crossings."""
    assert capacities(STRIPES, 0.025) == pytest.approx([2.5, 1.75, 1.5, 1.75, NAN], nan_ok=True)
    assert capacities(STRIPES, 0.005) == pytest.approx([0.5, 0.5, 0.25, 0.5, NAN], nan_ok=True)
    assert capacities(STRIPES, 0.045) == pytest.approx([INF, 2.5, 3.5, 3.0 + 25 / 30, NAN], nan_ok=True)
    assert capacities(STRIPES, COLLAPSE) == pytest.approx([INF, 2.5, 3.5, INF, NAN], nan_ok=True)
    assert capacities(STRIPES, [0.01, 0.02])[0] == pytest.approx([1.0, 2.0])


def test_fractiles_are_counted() -> None:
    """Of four records 50 % are the second, 84 % the fourth; a curve ends where too few records reach the value."""
    curves = fractile_curves(STRIPES, [0.025, 0.045], (0.25, 0.5, 0.84))
    assert curves[:, 0] == pytest.approx([1.5, 1.75, 2.5])
    assert curves[:, 1] == pytest.approx([2.5, 3.5, NAN], nan_ok=True)


def history(record: str, intensity: float, drift: float | None, **more: object) -> Group:
    about = {"kind": "history", "status": "completed", "variant": "bare", "incremental": "ida", "height": 7.0, **more}
    group = Group(attributes={**about, "record": record, "intensity": intensity})
    if drift is not None:
        group.add("storey_drift_max", ("storey",), [0.1 * drift, 0.5 * drift], "1", "")
        group.add("storey_drift_min", ("storey",), [-drift, 0.0], "1", "")
    return group


def test_stripes_from_the_groups_of_an_archive() -> None:
    groups = {
        "1": history("a", 2.0, 0.02),
        "2": history("a", 1.0, 0.01),
        "3": history("b", 1.0, 0.09, status="failed", collapsed=True),
        "4": history("b", 2.0, None, status="skipped"),
        "5": history("c", 1.0, 0.01, status="failed"),
        "6": history("a", 1.0, 0.5, variant="damped"),
        "7": history("a", 1.0, 0.5, incremental="other"),
    }
    stripes = collect_stripes(groups, "ida", "bare", ("interstorey_drift",))["interstorey_drift"]
    assert stripes.records == ("a", "b", "c")
    assert stripes.intensity.tolist() == [1.0, 2.0]
    expected = [[0.01, 0.02], [INF, INF], [NAN, NAN]]
    assert stripes.values == pytest.approx(np.array(expected), nan_ok=True)
    with pytest.raises(KeyError, match="ida of braced"):
        collect_stripes(groups, "ida", "braced", ("interstorey_drift",))


def test_fragility_of_a_limit_or_the_reason_why_not() -> None:
    found = limit_fragility(STRIPES, "LS", 0.025, "capacities", level_intensity=0.5)
    needed = np.log([2.5, 1.75, 1.5, 1.75])
    assert found.fit is not None and found.fit.theta == pytest.approx(np.exp(needed.mean()))
    assert found.margin == pytest.approx(np.exp(needed.mean()) / 0.5)
    assert (found.records, found.missing, found.measure, found.limit) == (5, 5, "interstorey_drift", "LS")
    none = limit_fragility(STRIPES, "far", 0.5, "capacities")
    assert none.fit is not None and none.fit.censored == 2  # collapses count
    none = limit_fragility(Stripes("ida", "bare", "d", ("a",), IM, VALUES[:1]), "far", 0.5, level_intensity=1.0)
    assert none.fit is None and none.margin is None and "no analysis passes" in none.reason


def test_a_record_that_was_lost_early_is_censored_where_its_results_end() -> None:
    """Record b has no result beyond the intensity 2: that it would stand 4 is not known."""
    values = np.array(
        [[0.01, 0.02, 0.03, 0.04], [0.01, 0.02, NAN, NAN], [0.02, 0.04, INF, INF], [NAN, 0.02, 0.05, NAN]]
    )
    stripes = Stripes("ida", "bare", "interstorey_drift", ("a", "b", "c", "d"), IM, values)
    assert last_intensities(stripes).tolist() == [4.0, 2.0, 4.0, 3.0]
    assert last_intensities(STRIPES) == pytest.approx([4.0] * 4 + [NAN], nan_ok=True)
    found = limit_fragility(stripes, "LS", 0.025, "capacities").fit
    right = fit_capacities([2.5, INF, 1.25, 2.0 + 5 / 30], [4.0, 2.0, 4.0, 3.0])
    assert found is not None and found.censored == 1
    assert (found.theta, found.beta) == pytest.approx((right.theta, right.beta), rel=1e-9)
    assert found.theta < fit_capacities([2.5, INF, 1.25, 2.0 + 5 / 30], 4.0).theta
