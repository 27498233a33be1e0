"""Regularity, EN 1998-1:2004, 4.2.3: geometry worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from edesign.codes.ec8.analysis.regularity import (
    NTC_2018,
    eccentricity_and_radius,
    gradual_mass,
    gradual_stiffness,
    recess,
    setbacks,
    slenderness,
    torsional_radius,
)
from edesign.errors import InputError


def test_plan() -> None:
    assert slenderness(28.8, 21.6).value == pytest.approx(4.0 / 3.0)
    assert slenderness(10.0, 40.0).passed and not slenderness(41.0, 10.0).passed
    assert recess(4.9, 100.0).passed and not recess(5.1, 100.0).passed


def test_torsional_radius_of_two_and_of_four_frames() -> None:
    """Two frames k at +-a along y alone: K_theta = 2 k a2, r = a. With as much along x at +-b: r2 = a2 + b2."""
    k, a, b = 5e6, 14.4, 10.8
    assert torsional_radius(2.0 * k * a**2, 2.0 * k) == pytest.approx(a)
    assert torsional_radius(2.0 * k * (a**2 + b**2), 2.0 * k) == pytest.approx(math.hypot(a, b))


def test_eccentricity_and_radius_name_the_worst_floor() -> None:
    e, r = eccentricity_and_radius([1.0, -4.0, 0.0], [12.0, 12.0, 9.0], 10.0, "y")
    assert (e.passed, e.detail) == (False, "floor 2") and e.value == pytest.approx(1.0 / 3.0)
    assert (r.passed, r.detail) == (False, "floor 3") and r.value == pytest.approx(0.9)
    e, r = eccentricity_and_radius(3.0, 10.0, 10.0, "x")
    assert e.passed and r.passed  # both limits are allowed values


def test_gradual_changes_are_for_the_engineer_unless_limits_are_given() -> None:
    mass = [360.0, 360.0, 460.0, 350.0]
    assert gradual_mass(mass).passed is None
    check = gradual_mass(mass, NTC_2018)
    assert check.value == pytest.approx(100.0 / 360.0) and check.passed is False
    assert check.detail == "from storey 2 to 3"
    fall, rise = gradual_stiffness([10.0, 6.9, 7.5], NTC_2018)
    assert fall.value == pytest.approx(0.31) and fall.passed is False
    assert rise.value == pytest.approx(0.6 / 6.9) and rise.passed is True
    fall, rise = gradual_stiffness([5.0])
    assert (fall.value, rise.value, fall.detail) == (0.0, 0.0, "no change")
    with pytest.raises(InputError, match="E-VALUE-02"):
        gradual_mass([1.0, 0.0])


TOP = np.arange(1, 11) * 3.5


def test_no_setback() -> None:
    assert setbacks(np.zeros(10), np.full(10, 20.0), TOP) == ()


@pytest.mark.parametrize(("step", "passed"), [(2.0, True), (2.1, False)])
def test_symmetric_setback(step: float, passed: bool) -> None:
    """a) At most 20 % of the plan below: 2 m a side of 20 m."""
    lower = np.where(np.arange(10) < 5, 0.0, step)
    (check,) = setbacks(lower, 20.0 - lower, TOP)
    assert (check.clause, check.passed, check.detail) == ("4.2.3.3(5)a", passed, "above storey 5")
    assert check.value == pytest.approx(2.0 * step / 20.0)


@pytest.mark.parametrize(("storeys", "clause"), [(1, "4.2.3.3(5)b"), (2, "4.2.3.3(5)a")])
def test_single_setback_low_in_the_building(storeys: int, clause: str) -> None:
    """b) Up to 50 % within the lower 15 %: storey 1 ends at 10 %, storey 2 at 20 %."""
    lower = np.where(np.arange(10) < storeys, 0.0, 4.0)
    (check,) = setbacks(lower, 20.0 - lower, TOP)
    assert check.clause == clause and check.value == pytest.approx(0.4)
    assert check.passed is (storeys == 1)
    assert ("75 %" in check.detail) is (storeys == 1)


def test_setbacks_of_one_face() -> None:
    """c) The sum of a face at most 30 % of the lowest plan, each at most 10 % of the plan below."""
    upper = np.array([20.0, 20.0, 18.0, 18.0, 16.5, 16.5, 15.0, 15.0, 13.9, 13.9])
    total, single = setbacks(np.zeros(10), upper, TOP)
    assert (total.value, total.passed) == (pytest.approx(0.305), False)
    assert (single.value, single.passed, single.detail) == (pytest.approx(0.1), True, "above storey 2")
    total, single = setbacks(np.zeros(10), np.maximum(upper, 14.5), TOP)
    assert total.passed and single.passed


def test_a_storey_that_stands_out_is_reported() -> None:
    (check,) = setbacks(np.zeros(3), [10.0, 12.0, 12.0], [3.0, 6.0, 9.0])
    assert check.passed is None and "stands out" in check.text
    with pytest.raises(InputError, match="E-VALUE-04"):
        setbacks([0.0, 5.0], [10.0, 5.0], [3.0, 6.0])
    with pytest.raises(InputError, match="E-VALUE-01"):
        setbacks([0.0, 5.0], [10.0, 9.0], [3.0])
