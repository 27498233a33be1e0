"""From a campaign to the problem: noise, thinning, tones, refusals."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kelvin_voigt_campaign import NOISE, C, K, campaign, lawful

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.motion import Motion
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.errors import InputError


@pytest.fixture(scope="module")
def hummed(tmp_path_factory: pytest.TempPathFactory) -> Campaign:
    def hum(t, u, v, a, order):
        return lawful(t, u, v, a, order) + 200.0 * np.sin(2.0 * np.pi * 49.7 * t + order)

    return campaign(tmp_path_factory.mktemp("hummed"), hum, tests=5)


def test_a_campaign_is_thinned_and_knows_its_noise(tmp_path):
    tests = damper_problem(campaign(tmp_path, tests=4))
    assert [one.use for one in tests.experiments] == ["fit", "fit", "validate", "validate"]
    assert dict(tests.declared) == pytest.approx({"k": K, "c": C})
    for one, full in zip(tests.experiments, tests.full_rate.experiments, strict=True):
        assert one.motion.time.size < full.motion.time.size == 2000
        assert one.start is None
        # estimated from a spectrum of some thirty segments
        assert full.channel_noise == pytest.approx(NOISE, rel=0.15)
    assert tests.typical.tones == ()


def test_two_samples_close_together_do_not_refine_a_whole_record():
    """A frame that logs a turn of the ramp at once, beside its two samples a second."""
    time = np.insert(np.arange(0.0, 400.0, 0.5), 401, 200.001)
    ramp = 1e-6 * np.minimum(time, 200.0)
    velocity = np.where(time <= 200.0, 1e-6, 0.0)
    motion = Motion(time, ramp, velocity, np.gradient(velocity, time))
    assert motion.frequency <= 1.0  # half of the sampling (Shannon 1949)
    slow = Motion(time, np.sin(0.2 * time), 0.2 * np.cos(0.2 * time), -0.04 * np.sin(0.2 * time))
    assert slow.frequency == pytest.approx(0.2 / (2.0 * np.pi), rel=0.02)


def test_hum_is_found_with_its_frequency(hummed):
    tests = damper_problem(hummed)
    # a hundredth of the width of a line over 8 s
    assert tests.typical.tones == pytest.approx((49.7,), abs=2e-3)
    assert "hum.tone" in {one.label for one in tests.effects}


def test_a_force_of_the_wrong_sign_or_unit_is_refused(tmp_path):
    right = campaign(tmp_path, tests=4)
    turned = replace(right, tests=tuple(one.with_force(-one.force) for one in right.tests))
    with pytest.raises(InputError, match="all 4 tests: .*`reversed: .*E-CALIB-07"):
        damper_problem(turned)
    large = replace(right, tests=(right.tests[0].with_force(1e3 * right.tests[0].force), *right.tests[1:]))
    with pytest.raises(InputError, match="a scale of 1000: .*E-CALIB-07"):
        damper_problem(large)
    small = replace(right, tests=tuple(one.with_force(1e-3 * one.force) for one in right.tests))
    with pytest.raises(InputError, match="a scale of 1/1000: .*E-CALIB-07"):
        damper_problem(small)


def test_an_offset_is_not_reported_as_a_wrong_unit(tmp_path):
    right = campaign(tmp_path, tests=4)
    size = max(float(np.max(np.abs(one.force))) for one in right.tests)
    first, *others = right.tests
    forces = replace(right, tests=(first.with_force(first.force + 200.0 * size), *others))
    with pytest.raises(InputError, match=r"test_01: .* \d.* kN .*force channel.*E-CALIB-03"):
        damper_problem(forces)
    moved = replace(first, displacement=first.displacement + 200.0 * size / K)
    with pytest.raises(InputError, match="`displacement_zero` .*E-CALIB-03"):
        damper_problem(replace(right, tests=(moved, *others)))


def test_a_campaign_without_law_or_with_too_few_tests_is_refused(tmp_path):
    right = campaign(tmp_path, tests=4)
    with pytest.raises(InputError, match="law: .*E-CALIB-01"):
        damper_problem(replace(right, law=LawChoice("kelvin_voigt")))
    with pytest.raises(InputError, match="tests: 1 .*E-CALIB-02"):
        damper_problem(replace(right, tests=right.tests[1:]))


def test_an_absurd_force_is_reported_with_its_time_if_it_is_longer_than_a_spike(tmp_path):
    right = campaign(tmp_path, tests=4)
    first, *others = right.tests
    force = first.force.copy()
    force[100] = 1e9
    one = damper_problem(replace(right, tests=(first.with_force(force), *others))).experiments[0].full
    assert np.flatnonzero(one.spikes).tolist() == [100] and np.max(np.abs(one.force)) < 1e6
    force[100:105] = 1e9
    with pytest.raises(InputError, match=rf"1e\+06 kN at {first.time[100]:.6g} s.*E-CALIB-03"):
        damper_problem(replace(right, tests=(first.with_force(force), *others)))
