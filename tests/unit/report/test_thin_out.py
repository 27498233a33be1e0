"""Thinning of curves: the deviation is bounded, and it is checked point by point, without the routine's own means."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.report.drawing.thin_out import thin_out, thin_out_all

STEPS = 4000


def _to_line(points: np.ndarray, line: np.ndarray) -> np.ndarray:
    """Distance of each point to a polyline: to each of its segments in turn, the least."""
    found = np.full(len(points), np.inf)
    for start, end in zip(line[:-1], line[1:], strict=True):
        along = end - start
        length2 = float(along @ along)
        share = np.clip((points - start) @ along / length2, 0.0, 1.0) if length2 > 0.0 else np.zeros(len(points))
        found = np.minimum(found, np.linalg.norm(points - start - share[:, None] * along, axis=1))
    return found


def _curves() -> dict[str, np.ndarray]:
    rng = np.random.default_rng(7)
    across = np.linspace(0.0, 400.0, STEPS)
    phase = np.arange(STEPS) / 40.0
    return {
        "noise": np.column_stack((across, 50.0 * rng.standard_normal(STEPS))),
        "sine": np.column_stack((across, 100.0 * np.sin(across / 5.0))),
        "loops": np.linspace(0.0, 50.0, STEPS)[:, None] * np.column_stack((np.sin(phase), np.cos(phase + 0.3))),
        "walk": np.cumsum(0.2 * rng.standard_normal((STEPS, 2)), axis=0),
    }


@pytest.mark.parametrize("name", ["noise", "sine", "loops", "walk"])
def test_no_point_is_farther_from_the_thinned_curve_than_the_tolerance(name: str) -> None:
    points = _curves()[name]
    kept = thin_out(points, 0.3)
    assert len(kept) < len(points)
    assert np.max(_to_line(points, kept)) <= 0.3 + 1e-9
    assert np.array_equal(kept[[0, -1]], points[[0, -1]])


def test_extremes_of_a_history_stay() -> None:
    """A peak that is a single sample high must not vanish from a figure."""
    points = np.column_stack((np.linspace(0.0, 100.0, 1001), np.zeros(1001)))
    points[437, 1] = 12.0
    assert thin_out(points, 0.25)[:, 1].max() == 12.0


def test_straight_line_is_two_points() -> None:
    points = np.column_stack((np.linspace(0.0, 9.0, 500), np.linspace(1.0, -4.0, 500)))
    assert np.array_equal(thin_out(points, 1e-6), points[[0, -1]])


def test_line_that_runs_back_over_itself_keeps_its_turning_point() -> None:
    """Distance to the infinite line would let the turning points of a loop go."""
    there = np.linspace(0.0, 10.0, 50)
    points = np.column_stack((np.concatenate((there, there[::-1])), np.zeros(100)))
    assert thin_out(points, 0.1)[:, 0].max() == 10.0


@settings(max_examples=60, deadline=None)
@given(
    st.lists(st.tuples(st.integers(-50, 50), st.integers(-50, 50)), min_size=1, max_size=60),
    st.floats(0.01, 20.0),
)
def test_any_curve_is_within_the_tolerance(points: list[tuple[int, int]], tolerance: float) -> None:
    curve = np.array(points, dtype=float)
    kept = thin_out(curve, tolerance)
    assert np.array_equal(kept[0], curve[0]) and np.array_equal(kept[-1], curve[-1])
    if len(kept) > 1:
        assert np.max(_to_line(curve, kept)) <= tolerance * (1.0 + 1e-9)


def test_curves_together_are_thinned_out_as_each_alone() -> None:
    """Short ones, a point, and one that returns to its start stand between long ones."""
    t = np.linspace(0.0, 20.0, 4000)
    long = np.column_stack((t, np.sin(7.0 * t) * np.exp(-0.1 * t)))
    curves = [long, np.zeros((1, 2)), np.array([[0.0, 0.0], [1.0, 1.0]]), np.vstack((long[:50], long[:1])), long[::-1]]
    together = thin_out_all(curves, 0.01)
    assert len(together[0]) < len(long) / 4
    for one, curve in zip(together, curves, strict=True):
        assert np.array_equal(one, thin_out(curve, 0.01))
    assert thin_out_all([], 0.01) == []
