"""Virtual substructure tests whose displacement is the target: an undeclared late rig is found under one name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.results.result import Calibration
from edesign.core.damper import LawValues
from edesign.core.substructure import Sensors, SubstructureLoop
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing import signals
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.one_thread import one_thread
from edesign.substructure.compensation import compensators
from edesign.substructure.rig import rigs
from edesign.substructure.rig.rigs import RigTransfer

STEP = 1e-3
SINES = ((2.0, 0.5, 5), (5.0, 1.0, 8), (8.0, 0.5, 5), (2.0, 3.0, 15), (3.0, 1.5, 10))  # mm, Hz, cycles


def motions(seed: int) -> list[np.ndarray]:
    """Sines that swell over two cycles, and noise of 0.1 to 4 Hz, m."""
    found = []
    for size, frequency, cycles in SINES:
        t = np.arange(0.0, cycles / frequency, STEP)
        share = np.minimum(0.5 * frequency * t, 1.0)
        found.append(1e-3 * size * share**2 * (3.0 - 2.0 * share) * np.sin(2.0 * np.pi * frequency * t))
    noise = (signals.random(15.0, (0.1, 4.0), seed + i, peak=5e-3, sampling_rate=1.0 / STEP)[1] for i in (0, 1))
    return [*found, *noise]


def found_behind(rig: RigTransfer, seed: int) -> Calibration:
    """What the calibration finds in tests of the MGMM behind a rig; encoder noise 1 um, force noise 20 N."""
    values = LawValues("mgmm", tuple(read_parameters(law("mgmm"), "thesis_table_4_2").values()))
    sensors = Sensors(displacement_noise=1e-6, force_noise=20.0)
    tests = []
    for i, u in enumerate(motions(seed)):
        loop = SubstructureLoop(STEP, 5, compensators.none(), rig.discrete(STEP / 5), values, sensors=sensors)
        v = np.gradient(u, STEP)
        made = loop.run(np.column_stack([u, v, np.gradient(v, STEP)]), seed=100 * seed + i)
        time, use = STEP * np.arange(u.size), "validate" if i in (3, 6) else "fit"
        tests.append(DamperTest(f"t{i}", time[::2], made.target[::2], made.force[::2], use=use))
    specimen, choice = Specimen("pair", 2, 0.0414, 0.012), LawChoice("mgmm", "thesis_table_4_2")
    with one_thread():
        return calibrate(Campaign(specimen, choice, tuple(tests), Path("campaign.yaml")), threads=1)


@pytest.mark.slow
@pytest.mark.parametrize(
    "rig",
    [
        rigs.pure_delay(0.002),
        rigs.pure_delay(0.015),
        rigs.second_order(12.0, 0.7, 0.001),
        rigs.second_order(30.0, 0.6, 0.003),
    ],
    ids=["2 ms", "15 ms", "12 Hz", "30 Hz"],
)
def test_a_late_rig_is_named_with_its_low_frequency_delay(rig: RigTransfer) -> None:
    found = found_behind(rig, seed=9)
    assert [(effect.name, effect.kind) for effect in found.effects] == [("lag", "instrument")]
    # noise, and the phase of second order, which is that of its delay well below its frequency alone
    assert found.effects[0].parameters["lag"].value == pytest.approx(rig.low_frequency_delay, abs=3e-4)


@pytest.mark.slow
def test_a_rig_that_follows_at_once_is_no_effect() -> None:
    assert found_behind(rigs.ideal(), seed=4).effects == ()
