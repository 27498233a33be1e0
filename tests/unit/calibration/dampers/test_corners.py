"""Records with few samples, which turn at these: what goes between them, and what a law that yields makes of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kelvin_voigt_campaign import campaign

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.signals.corners import cornered
from edesign.calibration.signals.noise import smooth
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice

BOUC_WEN = {"Fy": 2.0e4, "Y": 1e-3, "alpha": 0.05, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.0}
DECLARED = {"Fy": "20 kN", "Y": "1 mm", "alpha": 0.05, "n": 1}


def zigzag(order: int, random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Growing cycles at one speed, digitised at unequal distances and at turns: time (n,) s, displacement (n,) m."""
    turns = np.concatenate(([0.0], *([a, -a] for a in (1.0 + 0.2 * order) * np.array((1.0, 1.5, 2.0, 3.0, 4.0, 5.0)))))
    points = [0.0]
    for begin, end in zip(turns[:-1], turns[1:], strict=True):
        number = max(int(abs(end - begin)), 1)
        inside = (np.arange(1, number) + random.uniform(-0.3, 0.3, number - 1)) / number
        points += [*(begin + (end - begin) * inside), end]
    u = 1e-3 * np.array(points)
    return np.concatenate(([0.0], np.cumsum(np.abs(np.diff(u))))) / 1e-3, u


@pytest.fixture
def digitised(tmp_path) -> Campaign:
    random = np.random.default_rng(1)
    whole = campaign(tmp_path, tests=4)
    tests = []
    for order, test in enumerate(whole.tests):
        time, u = zigzag(order, random)
        # along straight lines, which at one speed have no other way between two samples
        fine = np.linspace(0.0, 1.0, 40, endpoint=False)
        every = np.append((u[:-1, None] + np.diff(u)[:, None] * fine).ravel(), u[-1])
        force = Damper(LAWS["bouc_wen"], BOUC_WEN).force(np.arange(every.size, dtype=float), every)[::40]
        tests.append(replace(test, time=time, displacement=u, force=force))
    return replace(whole, tests=tuple(tests), law=LawChoice("bouc_wen", DECLARED))


def test_only_records_that_turn_at_their_samples_are_cornered():
    random = np.random.default_rng(2)
    time, u = zigzag(1, random)
    assert cornered(time, u, 0.0)
    t = np.arange(0.0, 10.0, 0.01)
    wave = np.sin(6.0 * t) * np.sin(0.3 * t)
    assert not cornered(t, wave, 0.0)
    assert not cornered(t, wave + 1e-3 * random.standard_normal(t.size), 1e-3)


def test_a_motion_on_uneven_samples_keeps_what_an_even_grid_does_not_resolve():
    time, u = zigzag(0, np.random.default_rng(3))
    assert np.max(np.abs(smooth(time, u)[0] - u)) < 1e-3 * np.max(np.abs(u))


def test_a_digitised_campaign_is_predicted_along_its_samples(digitised):
    problem = damper_problem(digitised, 1)
    (found,) = problem.model((), ("fit", "validate")).forces(np.array([[one.centre for one in problem.base]]))
    for one, force in zip(problem.experiments, found, strict=True):
        assert one.motion.cornered
        assert one.parts(2) <= 4
        # the law is the true one and its path exact: what is left are sub-steps of the law
        assert np.sqrt(np.mean((force - one.force) ** 2)) < 3e-3 * np.max(np.abs(one.force))
