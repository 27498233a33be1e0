"""No verdict is better than the worst test allows: each test is compared with its own noise."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from damper_problems import problem

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.results.floor import Floor, _from_test_to_test, only_noise
from edesign.calibration.results.predictions import errors_of
from edesign.damper.testing.measured_histories import USES

NOISE = 100.0  # N
TESTS = 12


def floor_and_errors(louder: dict[int, float], seed: int = 1):
    """Tests of which a law leaves noise, and so many times its power in some of them."""
    tests = problem(tests=TESTS)
    random = np.random.default_rng(seed)
    forces = [one.force for one in tests.experiments]
    measured = [
        force + NOISE * np.sqrt(louder.get(i, 1.0)) * random.standard_normal(force.size)
        for i, force in enumerate(forces)
    ]
    noisy = tests.with_experiments(
        [replace(one, force=f, channel_noise=NOISE) for one, f in zip(tests.experiments, measured, strict=True)]
    )
    floor = Floor(noisy, (NOISE,) * TESTS, (0.0,) * TESTS, (0.0,) * TESTS, True)
    return floor, errors_of(noisy, forces)


def test_noise_alone_reaches_the_floor():
    for seed in range(5):
        floor, errors = floor_and_errors({}, seed)
        assert floor.worst(errors) is None
        assert only_noise(errors, {use: floor.nrms(use) for use in USES}, None)


@pytest.mark.parametrize("loud", [3, TESTS - 1])
def test_one_test_among_many_is_found_though_all_together_are_at_the_floor(loud: int):
    floor, errors = floor_and_errors({loud: 5.0})
    if loud != TESTS - 1:  # a test that is fitted to: the mean over those has (10 + 5) / 11
        assert errors.fit < 2.0 * floor.nrms("fit") and errors.validate < 2.0 * floor.nrms("validate")
    worst = floor.worst(errors)
    assert worst is not None and worst.name == f"test {loud + 1}"
    assert worst.times == pytest.approx(5.0, rel=0.21)  # 750 samples: four standard errors of sqrt(2 / n)
    assert not only_noise(errors, {use: floor.nrms(use) for use in USES}, worst)


def test_the_worst_of_two_is_reported():
    floor, errors = floor_and_errors({2: 5.0, 6: 9.0})
    worst = floor.worst(errors)
    assert worst is not None and worst.name == "test 7"


@pytest.mark.parametrize(("structure", "hidden"), [(0.0, False), (3.0 * NOISE, True)])
def test_noise_of_few_samples_hides_nothing_of_the_others(structure: float, hidden: bool):
    """Every 50th sample has 100 times the noise, as ends and corners of motions have: 201 times the power of all.

    A sine of three times the noise of the others is left: ten times their noise in power, a fifth more of all.
    """
    tests, random = problem(), np.random.default_rng(1)
    forces, noisy = [one.force for one in tests.experiments], []
    for one, force in zip(tests.experiments, forces, strict=True):
        local = np.where(np.arange(force.size) % 50, NOISE, 100.0 * NOISE)
        left = local * random.standard_normal(force.size) + structure * np.sqrt(2.0) * np.sin(9.0 * one.motion.time)
        rest = float(np.sqrt(np.mean(local**2) - NOISE**2))
        noisy.append(replace(one, force=force + left, channel_noise=NOISE, motion_noise=rest, local_noise=local))
    made = tests.with_experiments(noisy)
    law = SimpleNamespace(effects=(), fit=SimpleNamespace(values=np.array([one.centre for one in made.base])))
    floor, errors = Floor.under(made, law, forces), errors_of(made, forces)
    assert only_noise(errors, {use: floor.nrms(use) for use in USES}, floor.worst(errors))
    assert floor.times == pytest.approx(1.0 + 0.98 * (structure / NOISE) ** 2, rel=0.15)
    assert ("most of the noise is in few samples" in floor.doubtful(errors, 2)) == hidden


def test_an_error_of_the_thermometer_is_allowed_for():
    floor, errors = floor_and_errors({3: 5.0})
    thermal = [0.0] * TESTS
    thermal[3] = NOISE**2  # twice its standard deviation: four times its power, beside the noise
    assert replace(floor, thermal=tuple(thermal)).worst(errors) is None


def test_tests_that_begin_alike_show_what_does_not_repeat():
    """Ramps at one rate to several amplitudes and back: specimens of their own, whose stiffness scatters."""
    tests = problem(tests=3)
    tops = (4e-3, 6e-3, 8e-3)
    ramps = []
    for top in tops:
        t = np.arange(0.0, 2.0 * top / 1e-3, 0.01)
        u = np.minimum(1e-3 * t, 2.0 * top - 1e-3 * t)
        ramps.append(Motion(t, u, np.gradient(u, t), np.zeros_like(t)))
    experiments = [
        replace(one, motion=m, force=1e6 * m.displacement) for one, m in zip(tests.experiments, ramps, strict=True)
    ]
    left = [share * one.force for share, one in zip((0.0, 0.02, 0.0), experiments, strict=True)]
    found = _from_test_to_test(experiments, left)
    # 2 % of a ramp to 4 mm, shared by two; the motions are alike for little longer
    assert found[0] == pytest.approx(0.02 * 1e6 * 4e-3 / np.sqrt(3.0) / np.sqrt(2.0), rel=0.1)
    slower = replace(experiments[0], motion=ramps[0].scaled(0.5))
    assert np.isnan(_from_test_to_test([slower, *experiments[1:]], left)[0])


def test_harmonics_that_the_declared_law_lacks_are_no_noise_beside_the_one_that_has_them():
    """Noise of 300 N by a law that is far off is that of the channel, 100 N, beside the law fitted again."""
    random = np.random.default_rng(2)
    tests = problem(tests=4)
    forces = [one.force for one in tests.experiments]
    noisy = [
        replace(one, force=one.force + NOISE * random.standard_normal(one.force.size)) for one in tests.experiments
    ]
    made = tests.with_experiments([replace(one, channel_noise=3.0 * NOISE) for one in noisy])
    values = np.array([one.centre for one in made.base]) * (1.0 + 1e-9)
    law = SimpleNamespace(effects=(), fit=SimpleNamespace(values=values))
    assert Floor.under(made, law, forces).noise == pytest.approx([NOISE] * 4, rel=0.25)
