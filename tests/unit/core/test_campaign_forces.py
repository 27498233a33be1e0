"""Campaigns of many dampers in one call: against single histories, threads, what carries over, failures."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core import CampaignTest, CoreDamper, CoreError, EffectValues, SeriesRig, campaign_forces

MGMM = (0.515e6, 15.1e3, 0.107e6, 21e3, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0)
MODIFIED = (30e6, 20e6, 5e-3, 1e-3, 0.05, 1.0, 0.5, 0.5, 1.5, 50e3, 0.5)
RIG = SeriesRig(80e6, play=5e-4, compression_ratio=0.8, damping=1e4)


def swept(n: int, amplitude: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sine that grows from rest and ends there."""
    time = 0.01 * np.arange(n)
    grows, w = np.pi / time[-1], 9.0
    u = amplitude * np.sin(grows * time) ** 2 * np.sin(w * time)
    v = amplitude * (
        grows * np.sin(2.0 * grows * time) * np.sin(w * time) + np.sin(grows * time) ** 2 * w * np.cos(w * time)
    )
    u[[0, -1]] = v[[0, -1]] = 0.0
    return time, u, v


MOTIONS = [swept(n, a) for n, a in ((301, 4e-3), (450, 9e-3), (200, 6e-3))]
ENDS = np.linspace(1.0, 0.5, 450)
TESTS = [
    CampaignTest(*MOTIONS[0]),
    CampaignTest(*MOTIONS[1], factor=ENDS, added=100.0 * ENDS, spring=1e5 * ENDS, rig=RIG, rest=20.0),
    CampaignTest(*MOTIONS[2], factor=np.full(200, 0.5), spring=np.full(200, 1e5), rest=3.0),
]


def dampers(n: int) -> list[CoreDamper]:
    return [CoreDamper("mgmm", (MGMM[0] * (1.0 + 0.01 * i), *MGMM[1:])) for i in range(n)]


@pytest.mark.parametrize("threads", [1, 2, 3, None])
def test_it_is_the_single_histories_to_the_last_bit_with_any_threads(threads):
    sets = dampers(5)
    found = campaign_forces(sets, TESTS, own=True, threads=threads)
    assert found.failed == {}
    for i, damper in enumerate(sets):
        alone = damper.force(*MOTIONS[0])
        single = campaign_forces([damper], [TESTS[1]], own=True)
        force, own = single.force[0][0], single.own[0][0]
        last = 0.5 * damper.force(*MOTIONS[2]) + 1e5 * MOTIONS[2][1]
        for one, expected in zip(found.force, (alone, force, last), strict=True):
            assert np.array_equal(one[i], expected)
        for one, expected in zip(found.own, (MOTIONS[0][1], own, MOTIONS[2][1]), strict=True):
            assert np.array_equal(one[i], expected)


def test_fixed_steps_with_and_without_rig():
    damper = CoreDamper("modified_bouc_wen", MODIFIED, 60e6)
    found = campaign_forces([damper], [TESTS[1], TESTS[0]], method="fixed", length=1e-3)
    assert np.array_equal(found.force[1][0], damper.force(*MOTIONS[0], method="fixed", length=1e-3))


def test_a_specimen_carries_over_what_one_long_test_would():
    """With rests in which the law itself forgets: its relaxation time is 0.03 s."""
    effects = [
        EffectValues("payne.whole", (0.3, 5e-3, 1.0, 50.0)),
        EffectValues("self_heating.rate", (1e-4, 100.0)),
        EffectValues("mullins.path", (0.3, 0.1, 1.0, 0.0)),
    ]
    damper, rests = CoreDamper("mgmm", MGMM, effects=effects), (0.0, 20.0, 40.0)
    times, start = [], 0.0
    for rest, (time, _, _) in zip(rests, MOTIONS, strict=True):
        times.append(start + rest + time)
        start = times[-1][-1]
    u, v = (np.concatenate([motion[k] for motion in MOTIONS]) for k in (1, 2))
    expected = damper.force(np.concatenate(times), u, v)
    tests = [CampaignTest(*motion, rest=rest) for motion, rest in zip(MOTIONS, rests, strict=True)]
    found = np.concatenate([force[0] for force in campaign_forces([damper], tests, carry=True).force])
    peak = np.max(np.abs(expected))
    assert np.max(np.abs(found - expected)) < 1e-11 * peak  # rounding over 951 steps
    anew = np.concatenate([force[0] for force in campaign_forces([damper], tests).force])
    assert np.max(np.abs(anew - expected)) > 0.1 * peak


def test_a_damper_that_fails_leaves_the_others_alone():
    far = MOTIONS[0][1].copy()
    far[7] = 1e200
    tests = [CampaignTest(*MOTIONS[2]), CampaignTest(MOTIONS[0][0], far, MOTIONS[0][2])]
    sets = [CoreDamper("kelvin_voigt", (k, 0.0)) for k in (2.0, 1e300, 3.0)]
    found = campaign_forces(sets, tests, threads=2)
    assert found.failed == {1: "a result is not a finite number in test 2 at sample 8"}
    assert np.all(np.isfinite(found.force[1][[0, 2]])) and np.all(np.isfinite(found.force[0]))
    assert np.all(np.isfinite(found.force[1][1, :7])) and np.all(np.isnan(found.force[1][1, 7:]))


def test_no_damper_is_no_force():
    assert [force.shape for force in campaign_forces([], TESTS).force] == [(0, 301), (0, 450), (0, 200)]


def test_tests_that_are_not_allowed_are_named():
    time, u, v = MOTIONS[0]
    sets = dampers(2)
    with pytest.raises(ValueError, match="a campaign without tests"):
        campaign_forces(sets, [])
    with pytest.raises(ValueError, match="test 2: 301 times, 300 values of velocity"):
        campaign_forces(sets, [TESTS[0], CampaignTest(time, u, v[1:])])
    with pytest.raises(CoreError, match="test 2: .* sample 3 of 301.*E-CORE-10"):
        campaign_forces(sets, [TESTS[0], CampaignTest(time, np.where(time == time[2], np.nan, u), v)])
    with pytest.raises(CoreError, match="test 2: rest = 0 s .*E-CORE-02"):
        campaign_forces(sets, [TESTS[0], TESTS[0]], carry=True)
    with pytest.raises(CoreError, match="stiffness = -1 .*E-CORE-02"):
        SeriesRig(-1.0)


def test_dampers_of_each_test_are_those_of_single_campaigns():
    warm = [CoreDamper("mgmm", (MGMM[0] * (0.8 + 0.01 * i), *MGMM[1:])) for i in range(3)]
    exchanged = [TESTS[0], CampaignTest(*MOTIONS[2], rest=3.0, dampers=warm)]
    found = campaign_forces(dampers(3), exchanged, threads=2)
    assert found.failed == {}
    for i, (cold, other) in enumerate(zip(dampers(3), warm, strict=True)):
        assert np.array_equal(found.force[0][i], cold.force(*MOTIONS[0]))
        assert np.array_equal(found.force[1][i], other.force(*MOTIONS[2]))


def test_effects_alone_go_on_where_that_is_asked():
    """The path goes on in 1 - d (1 - exp(-s/s0)), whatever the parameters of each test; extremes of the MGMM do not."""
    d, s0 = 0.3, 0.1
    worn = EffectValues("degradation.path", (d, s0, 1.0))
    before, own = (np.concatenate(([0.0], np.cumsum(np.abs(np.diff(u))))) for _, u, _ in (MOTIONS[0], MOTIONS[2]))
    warmer = (0.8 * MGMM[0], *MGMM[1:])
    tests = [TESTS[0], CampaignTest(*MOTIONS[2], rest=3.0, dampers=[CoreDamper("mgmm", warmer, effects=[worn])])]
    found = campaign_forces([CoreDamper("mgmm", MGMM, effects=[worn])], tests, carry="effects")
    expected = (1.0 - d * (1.0 - np.exp(-(before[-1] + own) / s0))) * CoreDamper("mgmm", warmer).force(*MOTIONS[2])
    # sums in another order
    assert np.max(np.abs(found.force[1][0] - expected)) < 1e-12 * np.max(np.abs(expected))


def test_dampers_of_a_test_are_of_the_same_law_and_as_many():
    other = [CoreDamper("viscous", (1e5,))]
    found = campaign_forces(dampers(1), [TESTS[0], CampaignTest(*MOTIONS[2], dampers=other)])
    assert "test 2" in found.failed[0]
    with pytest.raises(ValueError, match="test 1: 1 dampers in place of 2"):
        campaign_forces(dampers(2), [CampaignTest(*MOTIONS[2], dampers=other)])
