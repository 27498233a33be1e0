"""Analysis of residuals with one known part beside white noise."""

from __future__ import annotations

import numpy as np
import pytest
from residual_examples import RATE, Example, campaign, cycles, described, force

from edesign.calibration.residual.cycles import Cycles, reversals
from edesign.calibration.residual.pool import Dependence, Pool, against, bins
from edesign.calibration.residual.series import Residual
from edesign.calibration.residual.shape import find_lag
from edesign.calibration.residual.tones import find_tones
from edesign.calibration.residual.whiteness import effective_samples, structured_share
from edesign.errors import InputError
from edesign.report.calibration.history_figures import residual_loop
from edesign.report.calibration.residual_figures import residual_map

LATE = 4e-3  # s


def late(example: Example) -> np.ndarray:
    return force(*example.at(example.time - LATE)) - example.predicted


def path(example: Example) -> np.ndarray:
    return np.concatenate(([0.0], np.cumsum(np.abs(np.diff(example.displacement)))))


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        (lambda e: 6e7 * e.displacement**2, "a force even in the displacement"),
        (lambda e: 1e10 * e.displacement**3, "a force odd in the displacement"),
        (lambda e: 3e3 * np.sign(e.velocity), "a force with the sign of the velocity"),
        (lambda e: 2e3, "a constant force"),
        (lambda e: 0.03 * e.predicted, "a factor on the whole force, +3 %"),
        (late, "a force 4 ms late"),
        (lambda e: 0.2 * np.exp(-path(e) / 0.05) * e.predicted, "a factor that falls with the path from +1"),
        (lambda e: -0.05 * (e.order % 3) * e.predicted, "a factor that falls with the temperature"),
        (lambda e: 0.02 * e.order * e.predicted, "a factor that rises with the test order"),
        (
            lambda e: 0.3 * (e.frequency == 0.25) * e.predicted,
            "a factor that depends on the test order, +30 % in test 4",
        ),
        (lambda e: 400.0 * e.time, "a force that rises with the time"),
    ],
)
def test_a_known_part_is_reported_first(extra: object, words: str) -> None:
    shape = described(extra)  # type: ignore[arg-type]
    # a trend is too slow to be sure of before the constant is taken away
    assert words in (shape if "time" in words else shape.split(", then")[0])


def test_noise_alone_is_reported_as_noise() -> None:
    assert "all of it noise" in described()
    tests = campaign()
    # a share of white noise follows chance, (bins - 1)/n on average: below four times it for 22 dependences
    assert all(one.share < 4.0 * one.chance for one in dependences(tests))
    shares = [structured_share(motion, test.residual) for test, motion in zip(tests, cycles(), strict=True)]
    assert all(share < 0.02 for share in shares)


def dependences(tests: list[Residual]) -> tuple[Dependence, ...]:
    samples = [effective_samples(test.residual) for test in tests]
    return against(Pool(tests, cycles()[: len(tests)], samples))


def test_nothing_left_is_reported() -> None:
    assert described(noise=0.0) == "Nothing is left."


def test_binned_means_are_those_of_the_known_function() -> None:
    """e = 3000 N sgn v over the rms force; and a factor of 5 % a kelvin."""
    tests = campaign(lambda e: 3e3 * np.sign(e.velocity), noise=0.0)[:1]
    sign = next(d for d in dependences(tests) if d.driver == "sign of velocity" and d.action == "force")
    assert sign.mean[[0, -1]] * tests[0].rms_force == pytest.approx([-3e3, 3e3], rel=1e-9)
    tests = campaign(lambda e: 0.01 * (e.order % 3) * e.predicted, noise=0.0)
    warm = next(d for d in dependences(tests) if d.driver == "temperature" and d.action == "factor")
    assert warm.centre == pytest.approx([20.0, 25.0, 30.0])
    assert warm.mean == pytest.approx([0.0, 0.01, 0.02], abs=1e-12)
    assert warm.share + _common(tests) == pytest.approx(1.0, abs=1e-9)


def _common(tests: list[Residual]) -> float:
    """Share of the squared residual that one factor explains, each test over its rms force."""
    e = np.concatenate([test.residual / test.rms_force for test in tests])
    p = np.concatenate([test.predicted / test.rms_force for test in tests])
    return float(e @ p) ** 2 / float(p @ p) / float(e @ e)


def test_lag_of_a_sine_is_found_to_the_cramer_rao_bound() -> None:
    """Error of a lag in white noise s on F0 sin(wt), n samples: s sqrt(2/n) / (F0 w), the Cramer-Rao bound."""
    time = np.arange(0.0, 10.0, 1.0 / RATE)
    omega, f0, s = 2.0 * np.pi * 1.5, 80e3, 800.0
    rng = np.random.default_rng(11)
    u, v = 0.01 * np.sin(omega * time), 0.01 * omega * np.cos(omega * time)
    predicted = f0 * np.sin(omega * time)
    measured = f0 * np.sin(omega * (time - 7.3e-3)) + s * rng.standard_normal(time.size)
    lag = find_lag([Residual("a", 0, "fit", time, u, v, measured, predicted, 20.0)])
    bound = s * np.sqrt(2.0 / time.size) / (f0 * omega)
    assert lag == pytest.approx(7.3e-3, abs=4.0 * bound)


def test_a_lag_is_found_in_tests_of_all_frequencies() -> None:
    tests = campaign(late)
    # the error of a lag is about 0.1 ms of 4 ms here: noise of 300 N beside forces of 80 kN
    assert [find_lag([test]) for test in tests] == pytest.approx([LATE] * len(tests), rel=0.05)
    assert find_lag(tests) == pytest.approx(LATE, rel=0.01)


def test_tone_is_found_with_frequency_and_amplitude() -> None:
    tests = campaign(lambda e: 250.0 * np.sin(2.0 * np.pi * 50.3 * e.time + 1.0))
    for test, motion in zip(tests, cycles(), strict=True):
        (tone,) = find_tones(motion, test.residual)
        # Cramer-Rao for n = 3000: sqrt(6/n) s / (pi A T) = 1.4 mHz, s sqrt(2/n) = 8 N; windows lose a factor of two
        assert tone.frequency == pytest.approx(50.3, abs=0.015)
        assert tone.amplitude == pytest.approx(250.0, abs=60.0)


def test_harmonics_of_the_motion_and_noise_are_no_tones() -> None:
    for test, motion in zip(campaign(lambda e: 3e3 * np.sign(e.velocity)), cycles(), strict=True):
        assert find_tones(motion, test.residual) == ()


def test_effective_samples_of_white_and_of_coloured_noise() -> None:
    """First-order autoregression with coefficient a: sum of the squared correlation is (1 + a^2)/(1 - a^2)."""
    rng = np.random.default_rng(0)
    white = rng.standard_normal(200_000)
    assert effective_samples(white) == pytest.approx(white.size, rel=0.02)
    a = 0.9
    coloured = np.empty_like(white)
    state = 0.0
    for i, x in enumerate(white):
        state = a * state + x
        coloured[i] = state
    assert effective_samples(coloured) == pytest.approx(white.size * (1.0 - a**2) / (1.0 + a**2), rel=0.1)


def test_map_and_loop_hold_the_known_residual() -> None:
    tests = campaign(lambda e: 2e6 * e.displacement, noise=0.0)[2:3]
    found = residual_map(tests)
    centre = 0.5 * (found.displacement[1:] + found.displacement[:-1])
    width = found.displacement[1] - found.displacement[0]
    expected = np.broadcast_to((2e6 * centre / tests[0].rms_force)[:, None], found.mean.shape)
    filled = np.isfinite(found.mean)
    assert filled.any()
    assert np.max(np.abs(found.mean - expected)[filled]) <= 0.5 * 2e6 * width / tests[0].rms_force * (1.0 + 1e-9)
    loop = residual_loop(tests[0], cycles()[2])
    assert loop is not None
    assert loop.residual == pytest.approx(2e6 * loop.displacement, abs=1e-6)
    assert np.max(loop.displacement) == pytest.approx(12e-3, rel=0.01)  # 64 points a cycle


def test_half_cycles_of_a_growing_triangle() -> None:
    """Reversals at 1, -2, 3, each after its own time: strokes 1, 3, 5."""
    time = np.array([0.0, 1.0, 3.0, 6.0])
    fine = np.linspace(0.0, 6.0, 601)
    u = np.interp(fine, time, [0.0, 1.0, -2.0, 3.0])
    half = Cycles(fine, u).half_cycles
    assert half.number[[50, 200, 500]].tolist() == [0, 1, 2]
    assert half.amplitude[[50, 200, 500]] == pytest.approx([0.5, 1.5, 2.5])
    assert half.frequency[[50, 200, 500]] == pytest.approx([0.5, 0.25, 1.0 / 6.0])
    assert reversals(u + 0.001 * np.sin(90.0 * fine), 0.05) == pytest.approx([0, 100, 300, 600], abs=2)


def test_bins_hold_equal_values_together() -> None:
    assert bins(np.array([3.0, 1.0, 3.0, 2.0]), 4).tolist() == [2, 0, 2, 1]
    assert bins(np.full(5, 2.0), 4).tolist() == [0] * 5
    assert np.bincount(bins(np.arange(1000.0), 10)).tolist() == [100] * 10


def test_records_that_do_not_fit_are_refused() -> None:
    time = np.arange(20.0)
    with pytest.raises(InputError, match="test a: 19 samples of measured, 20 .*E-CALIB-03"):
        Residual("a", 0, "fit", time, time, time, time[1:], time, 20.0)
    with pytest.raises(InputError, match="test a: predicted: sample 3 .*E-CALIB-03"):
        Residual("a", 0, "fit", time, time, time, time, np.where(time == 2.0, np.nan, time), 20.0)
