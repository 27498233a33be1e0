"""Rigs against their transfer functions, and the loop's sensors."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from edesign.core.damper import LawValues
from edesign.core.substructure import (
    LinearRig,
    LoopRecord,
    RigLimits,
    Sensors,
    ServoHydraulicRig,
    SubstructureLoop,
)
from edesign.errors import InputError
from edesign.substructure.compensation import compensators
from edesign.substructure.rig import rigs

STEP, STIFFNESS = 1e-3, 2e6
SPRING = LawValues("kelvin_voigt", (STIFFNESS, 0.0))


def steady(rig: LinearRig | ServoHydraulicRig, frequency: float, sub_steps: int = 5, **others: object) -> LoopRecord:
    """A sine of 5 mm, 6 s long."""
    t = STEP * np.arange(6001)
    motion = np.column_stack([5e-3 * np.sin(2 * pi * frequency * t), 0.0 * t, 0.0 * t])
    return SubstructureLoop(STEP, sub_steps, compensators.none(), rig, SPRING, **others).run(motion)  # type: ignore[arg-type]


def transfer(found: LoopRecord, frequency: float) -> complex:
    """Measured over command of the last two seconds, at the frequency of a sine (whole cycles)."""
    t = STEP * np.arange(4001, 6001)
    turn = np.exp(-2j * pi * frequency * t)
    return complex((found.deformation[4001:] @ turn) / (found.command[4001:] @ turn))


@pytest.mark.parametrize("frequency", [1.0, 5.0, 10.0])
@pytest.mark.parametrize(
    "rig",
    [
        rigs.ideal(),
        rigs.pure_delay(10.3e-3, 0.99),
        rigs.first_order(8e-3, 1.7e-3),
        rigs.second_order(21.4, 0.4, 4.3e-3, 0.995),
        # servo, feedback and actuator of the virtual RTHS benchmark (Silva et al. 2020), without the specimen's mass
        rigs.RigTransfer((1.0,), (1e-12, 4e-9, 3e-6, 2e-3, 1.0), 0.7e-3),
        rigs.RigTransfer((0.01, 1.0), (1e-4, 2e-2, 1.0)),
    ],
)
def test_discrete_rig_has_its_transfer_function(rig: rigs.RigTransfer, frequency: float) -> None:
    """Exact for ramps; a sine that is sent as ramps errs by (omega step)^2 / 12."""
    exact = rig(np.array([2j * pi * frequency]))[0]
    assert transfer(steady(rig.discrete(STEP / 5), frequency), frequency) == pytest.approx(exact, rel=1.2e-3)


def test_velocity_of_the_rig_is_the_derivative_of_its_displacement() -> None:
    """A dashpot as specimen feels c v: 90 degrees ahead of the displacement and c omega times its size."""
    t = STEP * np.arange(6001)
    motion = np.column_stack([5e-3 * np.sin(4.0 * pi * t), 0.0 * t, 0.0 * t])
    rig = rigs.second_order(21.4, 0.4).discrete(STEP / 5)
    found = SubstructureLoop(STEP, 5, compensators.none(), rig, LawValues("viscous", (3e4,))).run(motion)
    turn = np.exp(-4j * pi * t[4001:])
    assert (found.true_force[4001:] @ turn) / (found.deformation[4001:] @ turn) == pytest.approx(
        3e4 * 4j * pi, rel=1e-4
    )


def test_series_of_the_inverse_rig() -> None:
    """alpha of 1/G by hand: e^(s d) (1 + 2 z s/w + s2/w2) / g."""
    delay, omega, zeta, gain = 4.3e-3, 2 * pi * 21.4, 0.4, 0.99
    found = rigs.second_order(21.4, zeta, delay, gain).inverse_series(2)
    lag = 2.0 * zeta / omega
    assert found == pytest.approx((1 / gain, (delay + lag) / gain, (delay**2 / 2 + delay * lag + omega**-2) / gain))
    assert rigs.second_order(21.4, zeta, delay).low_frequency_delay == pytest.approx(delay + lag)
    with_zero = rigs.RigTransfer((0.01, 2.0), (1e-4, 2e-2, 1.0), 1e-3)
    s = 1e-2j
    series = np.polyval(with_zero.inverse_series(4)[::-1], s)
    assert series == pytest.approx(1.0 / with_zero(np.array([s]))[0], rel=1e-12)


@pytest.mark.parametrize("frequency", [1.0, 3.0, 8.0])
def test_servo_hydraulic_rig_with_a_spring(frequency: float) -> None:
    """K e^(-s d) / ((1 + k/k_oil) s (tau s + 1) + K): x = integral of q less k x / k_oil, tau q' + q = K (w - x).

    The rule over a sub-step is of second order: 0.2 and 0.1 ms.
    """
    rig = ServoHydraulicRig(gain=1.0 / 6.9e-3, oil=5e7, valve_lag=2.6e-3, delay=0.8e-3)
    s = 2j * pi * frequency
    exact = rig.gain * np.exp(-s * rig.delay) / ((1.0 + STIFFNESS / rig.oil) * s * (rig.valve_lag * s + 1.0) + rig.gain)
    assert rigs.servo_hydraulic(rig.gain, rig.valve_lag, rig.delay, STIFFNESS / rig.oil)(np.array([s]))[0] == (
        pytest.approx(exact, rel=1e-12)
    )
    errors = [abs(transfer(steady(rig, frequency, n), frequency) - exact) for n in (5, 10, 40)]
    assert errors[0] < 3e-3
    assert errors[2] < 1.2e-3  # what ramps leave of a sine, as above


def test_flexible_rig_and_its_correction() -> None:
    """x = u / (1 + k/k_rig) without, and u with the correction, but for the main step that it comes late."""
    rig = rigs.ideal().discrete(STEP / 5)
    bare = steady(rig, 1.0, rig_stiffness=2e7)
    assert transfer(bare, 1.0) == pytest.approx(1.0 / 1.1, rel=1e-3)
    assert bare.actuator == pytest.approx(bare.command, abs=1e-6)
    corrected = steady(rig, 1.0, rig_stiffness=2e7, corrected=True)
    assert abs(transfer(corrected, 1.0)) == pytest.approx(1.0, rel=1e-3)
    assert bare.true_force == pytest.approx(STIFFNESS * bare.deformation, abs=1e-6 * STIFFNESS * 5e-3)


def test_what_a_rig_cannot_do_is_held_and_reported() -> None:
    rig = rigs.ideal().discrete(STEP / 5)
    stroke = steady(rig, 1.0, limits=RigLimits(stroke=4e-3))
    assert np.max(np.abs(stroke.actuator)) == 4e-3
    assert set(stroke.saturated) == {0, 1}
    fast = steady(rig, 2.0, limits=RigLimits(velocity=0.05))
    assert np.max(np.abs(np.diff(fast.actuator))) <= 0.05 * STEP * (1 + 1e-12)
    assert 2 in set(fast.saturated)
    weak = steady(rig, 1.0, limits=RigLimits(force=9e3))
    assert {0, 4} == set(weak.saturated)


def test_sensors() -> None:
    """Noise of its standard deviation, readings in steps of quantisation within the range, a late force."""
    rig = rigs.ideal().discrete(STEP / 5)
    noisy = steady(rig, 1.0, sensors=Sensors(displacement_noise=2e-5, force_noise=100.0))
    error = noisy.measured - noisy.deformation
    # of 6001 samples the deviation is known to 1 %, the mean to 1/77 of it: four times that
    assert np.std(error) == pytest.approx(2e-5, rel=0.04)
    assert abs(np.mean(error)) < 4 * 2e-5 / 77
    assert np.std(noisy.force - noisy.true_force) == pytest.approx(100.0, rel=0.04)
    assert abs(np.corrcoef(error, noisy.force - noisy.true_force)[0, 1]) < 4 / 77
    coarse = steady(rig, 1.0, sensors=Sensors(displacement_quantisation=1e-4, displacement_range=4e-3))
    assert coarse.measured == pytest.approx(1e-4 * np.round(coarse.measured / 1e-4), abs=1e-12)
    assert np.max(coarse.measured) == pytest.approx(4e-3)
    assert 8 in set(coarse.saturated)
    late = steady(rig, 1.0, sensors=Sensors(force_delay=2e-3))
    assert late.force[2:] == pytest.approx(late.true_force[:-2], abs=1e-9)


def test_noise_is_decided_by_its_seed() -> None:
    rig = rigs.ideal().discrete(STEP / 5)
    loop = SubstructureLoop(STEP, 5, compensators.none(), rig, SPRING, sensors=Sensors(displacement_noise=1e-6))
    motion = np.zeros((500, 3))
    assert np.array_equal(loop.run(motion, seed=7).measured, loop.run(motion, seed=7).measured)
    assert not np.array_equal(loop.run(motion, seed=7).measured, loop.run(motion, seed=8).measured)


def test_improper_and_too_large_rigs_are_refused() -> None:
    with pytest.raises(InputError, match="denominator.*E-RIG-04"):
        rigs.RigTransfer((1.0, 1.0), (2.0, 1.0)).discrete(STEP)
    with pytest.raises(InputError, match="order 13.*E-RIG-04"):
        rigs.RigTransfer((1.0,), (1.0,) * 14).discrete(STEP)


def test_specimen_at_another_size_behind_a_flexible_rig() -> None:
    """Three springs side by side, sheared half as much: 1.5 k, in series with the rig."""
    rig = rigs.ideal().discrete(STEP / 5)
    found = steady(rig, 1.0, rig_stiffness=2e7, scales=(3.0, 0.5))
    assert found.true_force == pytest.approx(1.5 * STIFFNESS * found.deformation, abs=1e-6 * STIFFNESS * 5e-3)
    assert transfer(found, 1.0) == pytest.approx(1.0 / 1.15, rel=1e-3)
