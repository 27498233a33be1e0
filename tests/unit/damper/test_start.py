"""How tests start, against whole histories of which a record shows the end only."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.damper.damper import Damper
from edesign.damper.history import NONE, Extremes, spline_velocity
from edesign.damper.law import Law
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.start import Recorded, Start, StartKind, extremes_before, find_start

MGMM, ZENER, KELVIN = LAWS["mgmm"], LAWS["zener"], LAWS["kelvin_voigt"]
TABLE_4_2 = read_parameters(MGMM, "thesis_table_4_2")
SOLID = {"k0": 3e6, "k1": 6e6, "c1": 6e5}  # relaxes in c1 / k1 = 0.1 s
STEP = 0.002
NOISE = 100.0  # N
T = np.arange(0.0, 8.0, STEP)


def force_after(test):  # type: ignore[no-untyped-def]
    """Force of the MGMM in a test, of the extremes that it went through before."""
    return lambda prior: Damper(MGMM, TABLE_4_2, prior_extremes=prior).force(
        test.time, test.displacement, test.velocity
    )


def force_of(law: Law, values: dict[str, float], prior: Extremes = NONE):  # type: ignore[no-untyped-def]
    def force(time: np.ndarray, u: np.ndarray, v: np.ndarray, prior: Extremes) -> np.ndarray:
        return Damper(law, values, prior_extremes=prior).force(time, u, v)

    return force


def recorded(
    law: Law, values: dict[str, float], u: np.ndarray, before: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None
) -> Recorded:
    """A test of which what stands before it (time, displacement, velocity) is not recorded; with noise of the force."""
    v = spline_velocity(T, u)
    t0, u0, v0 = (np.empty(0),) * 3 if before is None else before
    whole = [np.concatenate(both) for both in ((t0, T), (u0, u), (v0, v))]
    force = Damper(law, values).force(*whole)[t0.size :]
    return Recorded(T, u, v, force + NOISE * np.random.default_rng(1).standard_normal(T.size), 0.0, NOISE)


def start_of(law: Law, values: dict[str, float], test: Recorded, kind: StartKind = "unknown") -> Start | None:
    return find_start(test, kind, STEP, force_of(law, values))


def swept(first: float = 0.0) -> np.ndarray:
    """1 Hz, amplitudes from 2 to 8 mm, from a first displacement."""
    return np.asarray(first * np.exp(-T) + 1e-3 * (2.0 + 6.0 * T / T[-1]) * np.sin(2.0 * np.pi * T))


def cut(at: float) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """A sine of 1 Hz and 3 mm, from a time on, and what went before it, from rest."""
    t = np.arange(-3.0, 0.0, STEP)
    w, size = 2.0 * np.pi, 3e-3
    return size * np.sin(w * (T + at)), (t, size * np.sin(w * (t + at)), size * w * np.cos(w * (t + at)))


@pytest.mark.parametrize("kind", ["unknown", "at_rest"])
@pytest.mark.parametrize(("law", "values"), [(MGMM, TABLE_4_2), (ZENER, SOLID)])
def test_a_motion_from_rest_at_zero_starts_at_rest(law: Law, values: dict[str, float], kind: StartKind) -> None:
    """Its velocity jumps, as that of a sine that is switched on; nothing softened the law before."""
    assert start_of(law, values, recorded(law, values, swept()), kind) is None


@pytest.mark.parametrize("at", [0.0, 0.1, 0.25])
def test_forces_of_a_test_in_motion_are_not_judged_until_they_have_died_away(at: float) -> None:
    """F - k0 u = Q with Q + tau Q' = c1 v: what Q was at the first sample falls as exp(-t / tau). In steady motion it
    is c1 w A cos(w t - atan(w tau)) / sqrt(1 + (w tau)^2); after rest it is 0.
    """
    u, before = cut(at)
    test = recorded(ZENER, SOLID, u, before)
    found = start_of(ZENER, SOLID, test)
    assert found is not None and found.dies_away and found.prior_extremes == NONE
    w, tau = 2.0 * np.pi, SOLID["c1"] / SOLID["k1"]
    state = SOLID["c1"] * w * 3e-3 * np.cos(w * at - np.arctan(w * tau)) / np.hypot(1.0, w * tau)
    left = Damper(ZENER, SOLID).force(test.time, test.displacement, test.velocity) - (
        test.force - NOISE * np.random.default_rng(1).standard_normal(T.size)
    )
    assert abs(left[0]) == pytest.approx(abs(state), rel=1e-3)  # splines at the ends
    judged = found.first(T)
    assert np.max(np.abs(left[judged:])) <= 1.2 * NOISE
    # and no longer than it takes the largest force there may be: that of a step by the whole amplitude
    assert found.judged_from <= tau * np.log(2.0 * SOLID["k1"] * 6e-3 / NOISE) + STEP


def test_a_few_samples_show_no_start() -> None:
    few = Recorded(T[:3], swept(7e-5)[:3], np.zeros(3), np.zeros(3), 0.0, NOISE)
    assert start_of(MGMM, TABLE_4_2, few, "in_motion") is None


def test_a_law_without_memory_starts_as_it_goes_on() -> None:
    u, before = cut(0.1)
    values = {"k": 3e6, "c": 2e5}
    assert start_of(KELVIN, values, recorded(KELVIN, values, u, before)) is None


@pytest.mark.parametrize("fast", [0.03, 1.0])
def test_what_a_step_before_the_first_sample_softened_is_found(fast: float) -> None:
    """From rest to 0.07 mm at a constant velocity, then the record: its law is that of the whole history."""
    u0 = 7e-5
    u = swept(u0)
    soon, way = 1e-6, 0.5e-6 * fast  # it speeds up evenly
    ramp = (u0 - way) / fast
    before = np.array([-1.0, -ramp - soon, -ramp]), np.array([0.0, 0.0, way]), np.array([0.0, 0.0, fast])
    test = recorded(MGMM, TABLE_4_2, u, before)
    found = start_of(MGMM, TABLE_4_2, test)
    assert found is not None and found.dies_away
    judged = found.first(T)
    prior = extremes_before(test, judged, np.ones(T.size), force_after(test))
    left = {
        name: np.mean((test.force - force_after(test)(one))[judged:] ** 2) / NOISE**2
        for name, one in (("at rest", NONE), ("found", prior))
    }
    assert left["at rest"] > 3.0
    assert left["found"] == pytest.approx(1.0, abs=0.1)  # 4000 samples: 0.022 one standard deviation
    # the cubic to the first sample, 12.5 mm/s, is faster than its mean; one way. Of much more than the 13.5 mm/s of
    # v_ref nothing is left to show how much it was
    assert prior[2] == pytest.approx(0.0358, rel=0.02) if fast < 0.1 else 0.1 < prior[2] <= 1.05 * fast
    assert prior[:2] == (0.0, 0.0) and prior[3] == 0.0


def test_a_ramp_that_is_said_is_taken() -> None:
    u = swept(7e-5)
    test = recorded(MGMM, TABLE_4_2, u)
    found = find_start(test, "at_rest", 7e-5, force_of(MGMM, TABLE_4_2))
    assert found is not None and found.known
    assert found.prior_extremes == pytest.approx((7e-5, 0.0, 1.0, 0.0))
    down = test._replace(displacement=-test.displacement, velocity=-test.velocity, force=-test.force)
    found = find_start(down, "at_rest", 7e-5, force_of(MGMM, TABLE_4_2))
    assert found is not None and found.prior_extremes == pytest.approx((0.0, -7e-5, 0.0, -1.0))


def test_a_larger_motion_before_is_found_where_it_is_said_to_have_been() -> None:
    """Steady cycles of 3 mm after some of 9 mm: k_mod is that of 9 mm, c_mod that of their velocity."""
    t = np.arange(-6.0, 0.0, STEP)
    size = np.where(t < -2.0, 9e-3, 3e-3)
    before = t, size * np.sin(2.0 * np.pi * t), 2.0 * np.pi * size * np.cos(2.0 * np.pi * t)
    test = recorded(MGMM, TABLE_4_2, 3e-3 * np.sin(2.0 * np.pi * T), before)
    found = start_of(MGMM, TABLE_4_2, test, "in_motion")
    assert found is not None and not found.known
    prior = extremes_before(test, found.first(T), np.ones(T.size), force_after(test))
    assert prior[0] == pytest.approx(9e-3, rel=0.05)
    assert prior[2] == pytest.approx(2.0 * np.pi * 9e-3, rel=0.2)  # beyond 4 v_ref little softening is left to show it


def test_nothing_is_found_where_the_record_goes_beyond_what_was_before() -> None:
    u, before = cut(0.1)
    test = recorded(MGMM, TABLE_4_2, u, before)
    found = start_of(MGMM, TABLE_4_2, test)
    assert found is not None
    prior = extremes_before(test, found.first(T), np.ones(T.size), force_after(test))
    reach = test.largest
    assert prior[0] <= 1.05 * reach[0] and prior[2] <= 1.2 * reach[1]


@pytest.mark.parametrize("name", ["bouc_wen", "elastic_plastic"])
def test_hysteresis_is_judged_once_it_has_forgotten(name: str) -> None:
    """Cut from a steady motion: what is judged is what the whole history has, though the law starts at rest."""
    values = {
        "bouc_wen": {"Fy": 1e4, "Y": 5e-4, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 2.0},
        "elastic_plastic": {"k": 1e7, "Fy": 1e4, "b": 0.05},
    }[name]
    law = LAWS[name]
    u, before = cut(0.4)  # unloading
    test = recorded(law, values, u, before)
    found = start_of(law, values, test)
    assert found is not None
    left = test.force - Damper(law, values).force(test.time, test.displacement, test.velocity)
    judged = found.first(T)
    assert judged < 1.0 / STEP  # a cycle, in which all of it yields both ways
    assert np.mean(left[judged:] ** 2) < 1.2 * NOISE**2
    assert np.mean(left[: judged or 1] ** 2) > 10.0 * NOISE**2


def test_what_was_at_rest_came_from_nowhere_else_however_wrong_the_law_is() -> None:
    """A ramp that began at rest: the law that it is compared with is half as stiff, so that much is left."""
    slow = {**SOLID, "c1": 6e6}  # relaxes in 1 s
    test = recorded(ZENER, slow, 2e-3 * (T + 10.0 * STEP), (np.array([-STEP]), np.zeros(1), np.full(1, 2e-3)))
    poor = {name: 0.5 * value for name, value in slow.items()}
    start, good = start_of(ZENER, poor, test, "at_rest"), start_of(ZENER, slow, test, "at_rest")
    assert start is not None and good is not None
    assert start.known and start.judged_from <= good.judged_from < 1.0
    # where it is not said, the specimen may have come from farther away
    moving = start_of(ZENER, poor, test, "in_motion")
    assert moving is not None and moving.judged_from > 3.0
