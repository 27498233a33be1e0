"""The first and last samples of a record that was cut out of a motion: their derivatives are not known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.signals.interpolation import CUBIC

T = np.arange(0.0, 3.0, 0.01)
TONES = tuple(zip((1.3, 3.1, 5.7, 8.9), (1.0, 0.6, 0.4, 0.3), (0.3, 1.1, 2.0, 4.4), strict=True))


def tones(derivative: int, t: np.ndarray = T) -> np.ndarray:
    """Displacement, velocity or acceleration of four sines, in closed form."""
    of = [
        a * (2 * np.pi * f) ** derivative * np.sin(2 * np.pi * f * t + p + derivative * np.pi / 2) for f, a, p in TONES
    ]
    return np.asarray(1e-3 * sum(of))


def experiment(u: np.ndarray, time: np.ndarray = T) -> Experiment:
    return Experiment("test_1", "fit", 0, 0.0, Motion.along(time, u, CUBIC), np.zeros(time.size), 20.0)


def test_what_an_end_condition_is_wrong_by_falls_to_a_quarter_a_sample() -> None:
    # a clamped end with a wrong slope, and the right one, by another program
    both = [
        make_interp_spline(T, tones(0), bc_type=([(1, tones(1)[0] + off)], [(1, tones(1)[-1])])) for off in (0, 0.1)
    ]
    wrong = np.abs(both[1](T[:8], 1) - both[0](T[:8], 1))
    assert wrong[1:] / wrong[:-1] == pytest.approx(2.0 - 3.0**0.5, rel=1e-3)


def test_a_record_that_begins_and_ends_in_motion_is_not_judged_there() -> None:
    one = experiment(tones(0))
    assert np.flatnonzero(~one.judged).tolist() == [0, 1, 2, 297, 298, 299]
    assert np.all(one.weights[~one.judged] == 0.0)
    off = np.abs(one.motion.acceleration - tones(2))
    assert np.max(off[one.judged]) < 0.2 * np.max(off)


def test_one_that_is_at_rest_there_is_judged_to_its_ends() -> None:
    quiet = np.clip(4.0 * np.minimum(T - 0.2, T[-1] - 0.2 - T), 0.0, 1.0)
    assert np.all(experiment(tones(0) * quiet**3 * (10.0 - 15.0 * quiet + 6.0 * quiet**2)).judged)
    begins = np.where(T < 1.5, 1.0, np.cos(np.pi * (T - 1.5) / 3.0) ** 4)
    assert np.flatnonzero(~experiment(tones(0) * begins).judged).tolist() == [0, 1, 2]


def test_fewer_samples_of_a_fit_lose_those_at_the_same_times() -> None:
    fine = 0.001 * np.arange(3000)
    one = experiment(tones(0, fine), fine).thinned()
    assert one.full is not None and one.motion.time.size < 1000
    lost = one.motion.time[~one.judged]
    assert lost.size >= 1 and np.all((lost < 0.003) | (lost > 2.996))


def test_few_samples_are_all_kept() -> None:
    assert np.all(experiment(tones(0)[:50], T[:50]).judged)
