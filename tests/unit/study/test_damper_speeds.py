"""Velocities of dampers by every step of a history, whatever is kept of it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.study.results.dampers import DamperSpeeds


@pytest.mark.parametrize("piece", [1, 3, 50])
def test_a_swelling_wave_of_5_Hz_in_steps_of_10_ms(piece: int) -> None:
    """Its derivative in closed form, within h^4 u'''''/30 = 3.3e-4; a step that is halved does not spoil it."""
    w, frame = 2.0 * np.pi * 5.0, SimpleNamespace(devices=(1, 2))
    time = 0.01 * np.arange(201)
    time = np.sort(np.append(time, 0.435))
    swell = np.sin(0.5 * np.pi * time) ** 2
    rate = 0.5 * np.pi * np.sin(np.pi * time) * np.sin(w * time) + swell * w * np.cos(w * time)
    strokes = np.column_stack([0.01 * swell * np.sin(w * time), -0.02 * swell * np.sin(w * time)])
    speeds = DamperSpeeds(frame)  # type: ignore[arg-type]  # only its dampers count
    for at in range(0, len(time), piece):
        speeds.see(time[at : at + piece], {"damper_deformation": strokes[at : at + piece]})
    group = Group()
    speeds.store(group, "time", "s")
    found = np.asarray(group.variables["damper_velocity_max"].values)
    largest = np.abs(rate).max()
    np.testing.assert_allclose(found, [0.01 * largest, 0.02 * largest], rtol=4e-4)


def test_pushovers_have_none() -> None:
    group = Group()
    DamperSpeeds(SimpleNamespace(devices=(1,))).store(group, "displacement", "m")  # type: ignore[arg-type]
    assert not group.variables
