"""Tables and figures of incremental dynamic analysis: what they say of known curves."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.assess.incremental import COLLAPSE, Stripes
from edesign.assess.limit_fragility import LimitFragility, limit_fragility
from edesign.report.capacity.incremental_figures import fragility_figure, ida_figure
from edesign.report.capacity.incremental_results import IncrementalResults
from edesign.report.capacity.incremental_tables import fractile_table, fragility_table
from edesign.report.page.sections.incremental import incremental_summary, incremental_tiles

G = 9.80665
IM = G * np.array([0.2, 0.4, 0.6, 0.8])
BARE = np.array([[0.01, 0.02, np.inf, np.inf], [0.01, 0.03, 0.06, np.inf], [0.02, 0.04, np.nan, 0.09]])
DAMPED = np.array([[0.005, 0.01, 0.015, 0.02]] * 3)
STRIPES = [
    Stripes("ida", "bare", "interstorey_drift", ("a", "b", "c"), IM, BARE),
    Stripes("ida", "damped", "interstorey_drift", ("a", "b", "c"), IM, DAMPED),
]


def fragilities() -> list[LimitFragility]:
    limits = {"LS": 0.025, "collapse": COLLAPSE}
    return [limit_fragility(one, n, v, "capacities", 0.3 * G) for n, v in limits.items() for one in STRIPES]


def test_fragilities_in_g_with_margins_and_reasons() -> None:
    table = fragility_table(fragilities(), "m/s^2", "MCE")
    needed = np.log([0.5, 0.35, 0.25])  # half way to the collapse at 0.6 g; interpolated
    theta, beta = np.exp(needed.mean()), needed.std(ddof=1)
    first = dict(zip(table.headers, table.texts[0], strict=True))
    assert (first["variant"], first["limit"], first["records"], first["analyses"]) == ("bare", "LS", "3", "11")
    assert first["theta [g]"] == f"{theta:.3f}" and first["beta"] == f"{beta:.3f}"
    assert first["theta / MCE"] == f"{theta / 0.3:.2f}"
    assert table.texts[1][5:] == ["-"] * 6
    assert (
        "damped, LS, capacities: no fragility: 0 of 3 records pass the limit; two are needed [E-FRAG-01]" in table.notes
    )
    assert "bare: 1 analyses without a result are left out" in table.notes
    assert len(fragility_table(fragilities()).columns) == len(table.columns) - 1


def test_the_summary_says_who_collapses_and_at_what_median() -> None:
    stripes = {one.variant: {one.measure: one} for one in STRIPES}
    results = IncrementalResults(
        "ida",
        "spectral acceleration (g)",
        "m/s^2",
        "MCE",
        {},
        stripes,
        tuple(fragilities()),
        {"bare": {"completed": 11}},
    )
    tiles = {(tile.label, tile.detail.partition(";")[0]): tile for tile in incremental_tiles(results)}
    assert tiles["Records that collapse, ida", "bare"].value == "2 of 3"
    assert tiles["Records that collapse, ida", "damped"].value == "0 of 3"
    needed = np.exp(np.log([0.5, 0.35, 0.25]).mean())
    median = tiles["Median spectral acceleration at LS, ida", "bare"]
    assert median.value == f"{needed:.3f}\N{NO-BREAK SPACE}g" and median.detail.endswith(
        f"{needed / 0.3:.2f} times MCE"
    )
    assert ("Median spectral acceleration at LS, ida", "damped") not in tiles  # no record reaches it
    assert incremental_summary(results) == "ida: 3 records at 4 intensities; histories of bare: 11 completed."


def test_intensities_that_fractions_need() -> None:
    table = fractile_table(STRIPES, {"LS": 0.025, "collapse": COLLAPSE})
    assert table.texts[0] == ["bare", "LS", "0.250", "0.350", "0.500"]
    assert table.texts[1] == ["bare", "collapse", "0.500", "0.700", "not reached"]
    assert table.texts[3] == ["damped", "collapse", *["not reached"] * 3]


def test_curves_of_records_and_marks_of_collapse() -> None:
    figure = ida_figure(STRIPES, "Sa (g)", G, "drift (%)", 0.01, {"LS": 0.025})
    bare, damped = figure.axes
    assert bare.get_title("left") == "bare: 2 of 3 records collapse"
    assert damped.get_title("left") == "damped: 0 of 3 records collapse"
    crosses = [line for line in bare.lines if line.get_marker() == "x"]
    assert sorted(float(line.get_ydata()[0]) for line in crosses) == pytest.approx([0.5, 0.7])
    assert not [line for line in damped.lines if line.get_marker() == "x"]
    curves = [line for line in bare.lines if line.get_linewidth() == 0.6]
    assert len(curves) == 3
    assert np.asarray(curves[2].get_xdata()) == pytest.approx([0.0, 2.0, 4.0, 9.0])  # the lost one is left out
    assert bare.get_ylabel() == "Sa (g)" and bare.get_xlabel() == damped.get_xlabel() == "drift (%)"


def test_fragilities_with_observed_fractions() -> None:
    figure = fragility_figure(fragilities(), "Sa (g)", G)
    first, collapse = figure.axes
    assert (first.get_title("left"), collapse.get_title("left")) == ("LS", "collapse")
    points = {line.get_label(): line for line in first.lines}
    assert np.asarray(points["bare, observed"].get_ydata()) == pytest.approx([0.0, 2 / 3, 1.0, 1.0])
    assert np.asarray(points["bare, observed"].get_xdata()) == pytest.approx([0.2, 0.4, 0.6, 0.8])
    assert "bare, fitted" in points and "damped, fitted" not in points
    fit = fragilities()[0].fit
    assert fit is not None
    curve = points["bare, fitted"]
    assert np.interp(fit.theta / G, curve.get_xdata(), curve.get_ydata()) == pytest.approx(0.5, abs=1e-3)


def test_the_legend_fits_a_single_panel() -> None:
    figure = ida_figure(STRIPES[:1], "Sa (g)", G, "drift (%)", 0.01, {})
    (legend,) = figure.legends
    assert len(legend.get_texts()) == 4 and legend.get_window_extent().width <= figure.bbox.width
