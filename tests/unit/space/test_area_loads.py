"""Shares of the beams around a bay: closed forms, integrals, equilibrium."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.space.structure.area_loads import BayShares, BeamShare, bay_shares, trapezoid

EXACT = 1e-12  # rounding of a few operations


def fixed_end_moment(share: BeamShare, length: float) -> float:
    """At the start of a beam that is fixed at both ends: w L2/12 and P a b2 / L2 (any table of beams)."""
    points = sum(force * a * (1.0 - a) ** 2 * length for a, force in share.points)
    return share.uniform * length**2 / 12.0 + points


def mid_span_moment(share: BeamShare, length: float) -> float:
    """At the middle of a beam that is pinned at both ends: w L2/8 and P min(a, b)/2."""
    points = sum(0.5 * force * min(a, 1.0 - a) * length for a, force in share.points)
    return share.uniform * length**2 / 8.0 + points


@pytest.mark.parametrize("ramp", [0.05, 0.7, 1.3, 2.0, 3.0])
def test_what_stands_for_a_trapezoid_has_its_total_and_moments(ramp: float) -> None:
    """Against the integral of many small point loads: midpoint rule with kinks on its grid, error below 1e-8."""
    peak, length, n = 12e3, 6.0, 60_000
    share = trapezoid(peak, length, ramp)
    x = (np.arange(n) + 0.5) / n
    load = peak * np.minimum(1.0, np.minimum(x, 1.0 - x) * length / ramp) * length / n
    assert share.total(length) == pytest.approx(load.sum(), rel=1e-8)
    assert fixed_end_moment(share, length) == pytest.approx((load * x * (1 - x) ** 2 * length).sum(), rel=1e-8)
    middle = (0.5 * load * np.minimum(x, 1 - x) * length).sum()
    assert mid_span_moment(share, length) == pytest.approx(middle, rel=1e-8)


def test_a_triangle_has_the_moments_of_the_tables() -> None:
    """W = pL/2, 5/96 p L2 at fixed ends, p L2/12 in the middle: tables of beams under a symmetric triangle."""
    share = trapezoid(8e3, 5.0, 2.5)
    assert share.total(5.0) == pytest.approx(20e3, rel=EXACT)
    assert fixed_end_moment(share, 5.0) == pytest.approx(5.0 / 96.0 * 8e3 * 25.0, rel=EXACT)
    assert mid_span_moment(share, 5.0) == pytest.approx(8e3 * 25.0 / 12.0, rel=EXACT)


def test_no_ramp_is_uniform() -> None:
    assert trapezoid(8e3, 5.0, 0.0) == BeamShare(8e3, ((0.25, 0.0), (0.5, 0.0), (0.75, 0.0)))


@pytest.mark.parametrize("spans", ["x", "y", "two_way"])
@pytest.mark.parametrize("secondary_beams", [0, 1, 2, 5])
@pytest.mark.parametrize(("width_x", "width_y"), [(7.2, 7.2), (6.0, 4.0), (3.0, 9.5)])
def test_the_shares_make_the_whole(spans: str, secondary_beams: int, width_x: float, width_y: float) -> None:
    shares = bay_shares(4.5e3, width_x, width_y, spans, secondary_beams)  # type: ignore[arg-type]
    total = 2.0 * (shares.along_x.total(width_x) + shares.along_y.total(width_y))
    assert total == pytest.approx(4.5e3 * width_x * width_y, rel=EXACT)


@pytest.mark.parametrize(("spans", "turned"), [("x", "y"), ("two_way", "two_way")])
@pytest.mark.parametrize("secondary_beams", [0, 2])
def test_a_plan_that_is_turned_turns_its_shares(spans: str, turned: str, secondary_beams: int) -> None:
    shares = bay_shares(3e3, 5.0, 8.0, spans, secondary_beams)  # type: ignore[arg-type]
    other = bay_shares(3e3, 8.0, 5.0, turned, secondary_beams)  # type: ignore[arg-type]
    assert BayShares(other.along_y, other.along_x) == shares


def test_secondary_beams_at_third_points_bring_two_thirds_to_the_girders() -> None:
    """Section 5.2 of the thesis: 9.6 kN/m of 2 kN/m2 at 7.2 m are two thirds; the other third goes to the columns."""
    shares = bay_shares(2e3, 7.2, 7.2, "x", 2)
    assert 2.0 * shares.along_x.total(7.2) / 7.2 == pytest.approx(9.6e3, rel=EXACT)
    assert [place for place, _ in shares.along_x.points] == pytest.approx([1 / 3, 2 / 3])
    assert 2.0 * shares.along_y.uniform == pytest.approx(2e3 * 7.2 / 3.0, rel=EXACT)
