"""Dampers in fixed steps: earthquakes against SUNDIALS, smoothness in the parameters, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from series_history import force_in_series

from edesign.core import CoreDamper, CoreError

LENGTH = 1e-3  # deformation at yield of the laws below, m
LAWS = {
    "modified_bouc_wen": (30e6, 20e6, 5e-3, LENGTH, 0.05, 1.0, 0.5, 0.5, 1.5, 50e3, 0.5),
    "bouc_wen": (50e3, LENGTH, 0.05, 1.0, 0.5, 0.5, 1.5),
    "maxwell_power": (300e3, 0.35, 40e6),
    "asymptote": (50e3, 10e6, 0.0, 0.0, 3.0, 1.5, 1e4),
    "ramberg_osgood": (50e6, 50e3, 1.0, 7.0),
}
BRACE = 60e6  # N/m: with it and its dashpot the modified Bouc-Wen law has no exact step


def shaken(step: float, n: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A motion of many sines that rises and falls, of some 10 mm."""
    rng = np.random.default_rng(3)
    time = step * np.arange(n)
    u, v = np.zeros(n), np.zeros(n)
    envelope, slope = np.sin(np.pi * time / time[-1]), np.pi / time[-1] * np.cos(np.pi * time / time[-1])
    for f in (0.3, 0.8, 1.5, 2.5, 4.0):
        w, a, phase = 2.0 * np.pi * f, 4e-3 * rng.normal(), rng.uniform(0.0, 2.0 * np.pi)
        u += a * envelope * np.sin(w * time + phase)
        v += a * (slope * np.sin(w * time + phase) + envelope * w * np.cos(w * time + phase))
    return time, u, v


MOTION = shaken(0.01, 2000)


def with_share(law: str, index: int, share: float) -> CoreDamper:
    values = list(LAWS[law])
    values[index] *= 1.0 + share
    return CoreDamper(law, values, BRACE if law == "modified_bouc_wen" else 0.0)


@pytest.mark.parametrize("dashpot", [(50e3, 0.3), (50e3, 0.5), (50e3, 1.0), (50e3, 1.6), (500e3, 0.5)])
def test_an_earthquake_is_that_of_sundials(dashpot):
    damper = CoreDamper("modified_bouc_wen", (*LAWS["modified_bouc_wen"][:9], *dashpot), BRACE)
    expected = damper.force(*MOTION, method="ode", tolerance=1e-9)
    peak = np.max(np.abs(expected))
    error = [
        np.sqrt(np.mean((damper.force(*MOTION, method="fixed", length=length) - expected) ** 2))
        for length in (LENGTH, LENGTH / 4)
    ]
    assert error[0] < 5e-4 * peak  # what a fit needs; 1.2 to 3.1e-4 seen
    assert error[1] < error[0]


@pytest.mark.parametrize("law", LAWS)
def test_forces_are_smooth_in_every_parameter(law):
    """Differences of 1e-6 and of 1e-4 give one derivative: to 1e-3, as those of 1e-4 leave out curvature."""
    for index, value in enumerate(LAWS[law]):
        if value == 0.0:
            continue
        slopes = []
        for share in (1e-4, 1e-6):
            up, down = (
                with_share(law, index, sign * share).force(*MOTION, method="fixed", length=LENGTH) for sign in (1, -1)
            )
            slopes.append((up - down) / (2.0 * share))
        size = np.sqrt(np.mean(slopes[0] ** 2))
        assert np.sqrt(np.mean((slopes[1] - slopes[0]) ** 2)) < 1e-3 * size, index


def test_forces_in_series_with_a_rig_are_smooth():
    slopes = []
    for share in (1e-4, 1e-6):
        up, down = (
            force_in_series(
                with_share("modified_bouc_wen", 1, sign * share),
                *MOTION,
                80e6,
                damping=1e4,
                method="fixed",
                length=LENGTH,
            )[0]
            for sign in (1, -1)
        )
        slopes.append((up - down) / (2.0 * share))
    # its balance is met to 1e-8 of the force, by Newton's method mostly far better
    assert np.sqrt(np.mean((slopes[1] - slopes[0]) ** 2)) < 1e-3 * np.sqrt(np.mean(slopes[0] ** 2))


def test_work_is_lost_in_every_cycle():
    time = 0.01 * np.arange(1001)
    u, v = 8e-3 * np.sin(2.0 * np.pi * time), 8e-3 * 2.0 * np.pi * np.cos(2.0 * np.pi * time)
    damper = CoreDamper("modified_bouc_wen", LAWS["modified_bouc_wen"], BRACE)
    force = damper.force(time, u, v, method="fixed", length=LENGTH)
    power = 0.5 * (force[1:] + force[:-1]) * np.diff(u)
    assert np.all(power.reshape(-1, 100).sum(axis=1) > 0.0)


@pytest.mark.parametrize("length", [None, 0.0, -1.0, float("nan"), float("inf")])
def test_a_length_is_needed(length):
    damper = CoreDamper("bouc_wen", LAWS["bouc_wen"])
    with pytest.raises(CoreError, match=rf"length = {length} .*fixed.*E-CORE-02"):
        damper.force(*MOTION, method="fixed", length=length)
