"""The processing that a project file describes: its faults name the step."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.errors import InputError
from edesign.ground_motion.processing.steps import processed
from edesign.ground_motion.record import Record
from edesign.project.records.processing import Step

STEP = 0.01
MOTION = Record("motion", np.sin(np.arange(2001) * STEP), STEP, "sine of 20 s")


def test_steps_are_done_in_their_order() -> None:
    steps = [
        Step.model_validate({"trim": {"start": "5 s", "end": "20 s", "taper": "0 s"}}),
        Step.model_validate({"pad": {"after": "2 s"}}),
    ]
    done = processed(MOTION, steps)
    assert done.duration == pytest.approx(17.0, rel=1e-12)
    assert np.array_equal(done.acceleration[:1501], MOTION.acceleration[500:])


def test_a_reversed_motion_is_the_same_to_the_other_side() -> None:
    """Its sign alone changes, wherever the step stands: every other step is linear in the motion."""
    reverse, other = (
        Step.model_validate(step) for step in ({"reverse": True}, {"filter": {"low": "0.1 Hz", "high": "25 Hz"}})
    )
    done = processed(MOTION, [reverse])
    assert np.array_equal(done.acceleration, -MOTION.acceleration)
    assert done.source == "sine of 20 s; reversed"
    first, last = processed(MOTION, [reverse, other]), processed(MOTION, [other, reverse])
    assert np.array_equal(first.acceleration, last.acceleration)


@pytest.mark.parametrize(
    ("step", "code"),
    [
        ({"trim": {"start": "1 s", "end": "21 s"}}, "E-MOTION-02"),
        ({"pad": {"before": "1e9 s"}}, "E-VALUE-02"),
        ({"filter": {"low": "1e-9 Hz"}}, "E-VALUE-02"),
        ({"taper": {"start": "15 s", "end": "15 s"}}, "E-MOTION-02"),
    ],
)
def test_a_fault_names_its_step(step: dict[str, dict[str, str]], code: str) -> None:
    steps = [Step.model_validate({"baseline": {"order": 0}}), Step.model_validate(step)]
    with pytest.raises(InputError, match=rf"processing\[1\].{next(iter(step))}: .*{code}"):
        processed(MOTION, steps)
