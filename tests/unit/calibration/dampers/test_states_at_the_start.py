"""Tests that begin in motion: what is inside the law and its effects at the first sample, against own histories."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from damper_problems import motion, problem

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.damper.testing.start import Recorded, Start, find_start

MOVING, CUT = 2, 400  # the test that begins in motion, and its first sample


def cut(whole: Motion) -> Motion:
    return Motion(*(np.ascontiguousarray(values[CUT:]) for values in whole.samples))


def branch(t: np.ndarray, v: np.ndarray, k: float, tau: float) -> np.ndarray:
    """Force of a relaxation branch from rest: dF/dt = k v - F/tau, by the trapezoidal rule in small steps."""
    force, h = np.zeros(t.size), np.diff(t)
    for i, step in enumerate(h):
        a = 0.5 * step / tau
        force[i + 1] = (force[i] * (1.0 - a) + 0.5 * step * k * (v[i] + v[i + 1])) / (1.0 + a)
    return force


def begun(k: float, tau: float) -> DamperProblem:
    """A Kelvin-Voigt law with a branch that nobody knows; one record was begun late."""
    tests = problem("kelvin_voigt")
    found = []
    for one in tests.experiments:
        whole = motion(one.order)
        force = one.force + branch(whole.time, whole.velocity, k, tau)
        if one.order == MOVING:
            first = Start(float(whole.displacement[CUT]), float(whole.velocity[CUT]), 0.0, True)
            found.append(replace(one, motion=cut(whole), force=force[CUT:], start=first))
        else:
            found.append(replace(one, force=force))
    return tests.with_experiments(found)


def test_mirror_images_end_at_the_first_sample() -> None:
    own = cut(motion(1))
    for way in (1.0, -1.0):
        whole = own.after(way)
        before = whole.preceded
        assert before == own.time.size - 1 and np.array_equal(whole.displacement[before:], own.displacement)
        # the velocity is the rate of the displacement, the acceleration that of the velocity: by central differences
        inner = slice(1, before - 1)
        for values, rate in ((whole.displacement, whole.velocity), (whole.velocity, whole.acceleration)):
            slope = np.gradient(values, whole.time)
            assert np.allclose(slope[inner], rate[inner], atol=2e-3 * np.max(np.abs(rate)))
        ahead = own.displacement[5] - own.displacement[0]
        assert np.isclose(whole.displacement[before - 5] - own.displacement[0], -way * ahead)
        assert np.isclose(whole.velocity[before - 5], way * own.velocity[5])


def test_what_a_branch_had_in_it_is_a_nuisance_of_the_test() -> None:
    k, tau = 1.0e6, 0.3
    tests = begun(k, tau)
    effect = next(one for one in tests.effects if one.label == "relaxation_branch.maxwell")
    model = tests.model((effect,))
    names = [one.name for one in effect.parameters]
    own = {"stiffness": k, "k": k, "relaxation_time": tau, "tau": tau, "time": tau}
    values = np.array([*(one.centre for one in tests.base), *(own[name] for name in names)])
    (predicted,) = model.predict(values[np.newaxis])
    assert isinstance(predicted, list)
    columns = model.nuisance_columns(values)
    assert [one is not None for one in columns] == [i == MOVING for i in range(3)]
    left = model.measured[MOVING] - predicted[MOVING]
    # what is left is what the branch had in it, and that dies away as exp(-t/tau)
    since = tests.experiments[MOVING].motion.since
    whole, weights = motion(MOVING), model.weights[MOVING]  # 0 at both ends, which are in motion
    inside = branch(whole.time, whole.velocity, k, tau)[CUT]
    size = float(np.max(np.abs(left)))
    assert abs(inside) > 100.0 and np.allclose(left, weights * inside * np.exp(-since / tau), atol=2e-3 * size)
    own_columns = columns[MOVING]
    assert own_columns is not None
    freed = left - own_columns @ np.linalg.lstsq(own_columns, left, rcond=None)[0]
    assert np.max(np.abs(freed)) < 2e-3 * size
    # the law alone remembers nothing
    assert tests.model(()).nuisance_columns(np.array([one.centre for one in tests.base])) == [None] * 3


def test_the_motion_says_how_a_test_starts_of_which_the_law_says_nothing() -> None:
    whole = motion(1)
    own = cut(whole)

    def force_of(time: np.ndarray, displacement: np.ndarray, velocity: np.ndarray, _: object) -> np.ndarray:
        return 4.0e6 * displacement + 2.0e5 * velocity

    def found(moved: Motion, wrong: float | None) -> Start | None:
        force = force_of(moved.time, moved.displacement, moved.velocity, None)
        record = Recorded(moved.time, moved.displacement, moved.velocity, force, 1e-6, 10.0)
        return find_start(record, "unknown", 7e-5, force_of, wrong)

    start = found(own, 0.1)
    assert start is not None and start.judged_from == 0.0 and not start.known
    assert found(own, None) is None and found(whole, 0.1) is None
