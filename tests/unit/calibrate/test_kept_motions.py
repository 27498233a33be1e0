"""Motions that parts make of the recorded one: the same object as long as it is asked for in the same way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from irregular_motion import motion, sizes, trial

from edesign.calibrate.dampers import problem
from edesign.calibrate.dampers.acting import Acting
from edesign.calibrate.dampers.effects import gain
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of


def test_a_motion_is_made_once_for_each_set_of_parameters() -> None:
    test = trial(replace(motion(21), resampled=True))
    candidate = candidate_of(gain.Displacement(), sizes(), Left())
    assert candidate is not None
    first, again, other = (
        problem._actuator(Acting.of((candidate, np.array([g]))), test, test.motion) for g in (0.25, 0.25, 0.3)
    )
    assert again is first and other is not first
    # a channel that reads a quarter too much has moved by 1/1.25 of what it says
    np.testing.assert_allclose(first.displacement, 0.8 * test.motion.displacement, rtol=1e-15)
    assert first.resampled  # what it was made of still is
