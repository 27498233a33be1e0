"""Spikes of channels are found and nothing else is: corners, impacts, slips, coarse sampling. Own signals."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.spikes import (
    repeated_frames,
    spike_notes,
    spike_warnings,
    spikes,
    spikes_beside,
    spikes_of,
    without_spikes,
)
from edesign.report.check.damper_files import force_warnings

RNG = np.random.default_rng(62)
T = np.arange(0.0, 10.0, 1.0 / 200.0)
U, V = np.sin(2.0 * np.pi * T), np.cos(2.0 * np.pi * T)
NOISE = 0.003 * RNG.standard_normal(T.size)
FORCE = U + 0.4 * V + NOISE


def plastic(stiffness: float = 8.0) -> np.ndarray:
    """An elastic-plastic force of unit strength by return mapping."""
    found, force = np.zeros(T.size), 0.0
    for i in range(1, T.size):
        force = min(max(force + stiffness * (U[i] - U[i - 1]), -1.0), 1.0)
        found[i] = force
    return found


def impacts(samples: int, each: float = 1.0, ringing: bool = False) -> np.ndarray:
    """Half sines of a length in samples at the same place of every cycle, or what rings after a blow there."""
    found = np.zeros(T.size)
    for begin in np.arange(0.2317, 9.5, each):
        since = 200.0 * (T - begin)
        wave = np.sin(np.pi * np.clip(since, 0.0, np.inf) / samples)
        shape = np.exp(-np.clip(since, 0.0, np.inf) / 10.0) if ringing else since < samples
        found += np.where(since > 0.0, 0.6 * wave * shape, 0.0)
    return found


@pytest.mark.parametrize("row", [1, 2, 3])
@pytest.mark.parametrize("force", [FORCE, plastic() + 0.2 * U + NOISE], ids=["viscous", "plastic"])
def test_spikes_are_found_and_interpolated(force: np.ndarray, row: int) -> None:
    places = np.array([133, 479, 812, 1210, 1534, 1841])  # away from the corners, at any phase
    at = np.zeros(T.size, dtype=bool)
    for i in places:
        at[i : i + row] = True
    spiky = force + np.where(at, 0.8 * np.sign(np.sin(7.0 * np.arange(T.size) // 10)), 0.0)
    found = spikes(T, spiky, (U, V))
    assert np.array_equal(found.at, at)
    assert np.all(np.abs(found.mended - force)[at] < 8.0 * 0.003)
    assert np.array_equal(found.mended[~at], spiky[~at])


@pytest.mark.parametrize(
    "force",
    [
        FORCE,
        FORCE - NOISE,
        U + 0.5 * np.sign(V) + NOISE,
        np.sign(V) * np.abs(V) ** 0.15 + NOISE,
        plastic(40.0) + NOISE,
        plastic(40.0),
        np.clip(2.0 * U, -1.0, 1.0) + NOISE,
        U + 30.0 * np.clip(U - 0.95, 0.0, None) ** 1.5 + NOISE,
        U + 0.2 * ((13.0 * T) % 1.0) + NOISE,
        U + impacts(1) + NOISE,
        U + impacts(2) + NOISE,
        U + impacts(5) + NOISE,
        U + impacts(4, ringing=True) + NOISE,
        U + 0.05 * np.sin(2.0 * np.pi * 50.0 * T) + NOISE,
        np.round(FORCE / 0.05) * 0.05,
        np.round(20.0 * T / 7.0) + 0.0,
        np.where(T < 5.0, 0.0, FORCE),
        RNG.standard_normal(T.size),
    ],
    ids=(
        "clean exact friction power plastic plastic_exact clipped contact slips impact_1 impact_2 impact_5 ringing "
        "hum digitiser steps rest noise"
    ).split(),
)
def test_nothing_else_is_a_spike(force: np.ndarray) -> None:
    assert not spikes(T, force, (U, V)).at.any()


@pytest.mark.parametrize("a_period", [6, 8, 12, 25])
@pytest.mark.parametrize("noise", [0.0, 1e-3, 1e-2])
def test_coarse_sampling_makes_none(a_period: int, noise: float) -> None:
    time = np.arange(0.0, 40.0, 1.0 / a_period) + 0.013
    u, v = np.sin(2.0 * np.pi * time), np.cos(2.0 * np.pi * time)
    for force in (u, u + 0.3 * v, np.sign(v) * np.abs(v) ** 0.3, u + 0.5 * np.sign(v)):
        noisy = force + noise * RNG.standard_normal(time.size)
        assert not spikes(time, noisy, (u, v)).at.any()


def test_what_a_model_leaves_shows_spikes_that_steep_forces_hide() -> None:
    time = np.arange(0.0, 40.0, 1.0 / 20.0)
    u, v = np.sin(2.0 * np.pi * time), np.cos(2.0 * np.pi * time)
    places = np.array([51, 133, 272, 404])  # at other places of the cycle
    force = u + 0.4 * np.sign(v) * np.abs(v) ** 0.5 + 0.003 * RNG.standard_normal(time.size)
    true = force.copy()
    force[places] += np.array([0.6, -0.6, 0.6, -0.6])
    model = 1.02 * u + 0.39 * np.sign(v) * np.abs(v) ** 0.5
    assert not spikes(time, force, (u, v)).at.any()
    found = spikes_beside(time, force, model, (u, v))
    assert np.flatnonzero(found.at).tolist() == places.tolist()
    assert np.max(np.abs(found.mended - true)[places]) < 0.03


@pytest.mark.parametrize("late", [-3, -2, -1, 1, 2, 3])
def test_a_model_that_is_late_at_a_corner_makes_none(late: int) -> None:
    random = np.random.default_rng(5)
    amplitude = np.cumsum(random.standard_normal(T.size)) / 50.0  # no two half cycles are alike
    velocity = np.gradient(amplitude * U, T)
    force = amplitude * U + 0.5 * np.sign(velocity) + NOISE
    model = amplitude * U + 0.5 * np.sign(np.roll(velocity, late))
    assert not spikes_beside(T, force, model, (amplitude * U, velocity)).at.any()


def test_noise_alone_has_one_in_a_hundred_records_at_most() -> None:
    time = np.arange(400.0)
    found = sum(spikes(time, RNG.standard_normal(time.size)).at.any() for _ in range(400))
    assert found <= 4 + 3 * 2  # three standard deviations above one in a hundred


def test_they_are_said_by_test_channel_and_time() -> None:
    force, motion = 1e4 * FORCE, 0.01 * U + 1e-5 * NOISE
    force[700] += 8e3
    motion[[300, 301]] -= 0.004
    test = DamperTest("a", T, motion, force)
    of_force, of_motion = spike_notes([DamperTest("b", T, 0.01 * U, 1e4 * FORCE), test])
    assert of_force.startswith("a: force: 1 sample is a spike, at 3.5 s, up to 7.9") and "not judge" in of_force
    assert of_motion.startswith("a: displacement: 2 samples are spikes, at 1.5, 1.505 s, up to 4 mm ")
    assert [of_force[3:], of_motion[3:]] == force_warnings(test)[:2]
    assert np.max(np.abs(without_spikes(test).displacement - 0.01 * U)) < 1e-6


RESOLUTION = 5e-6  # m
LATE = (37, 60, 61, 150, 203)


def repeating(step: float, late: tuple[int, ...] = LATE, rounded: bool = True) -> DamperTest:
    """A sine of 30 mm that a logger has read at 100 Hz, some frames twice; steps of the motion are as large as that."""
    t = 0.01 * np.arange(300)
    u = 30e-3 * np.sin(step / 30e-3 * np.arange(300))
    force = 900.0 * np.sign(np.gradient(u)) + 4e4 * u
    if rounded:
        u, force = RESOLUTION * np.round(u / RESOLUTION), np.round(force)
    for i in late:
        u[i], force[i] = u[i - 1], force[i - 1]
    return DamperTest("test_1", t, u, force)


def test_frames_that_a_logger_repeats_are_none() -> None:
    test = repeating(1e-3)
    assert np.flatnonzero(repeated_frames(test)).tolist() == list(LATE)
    of_motion, of_force = spikes_of(test)
    assert of_force is not None
    assert np.all(of_motion.at[list(LATE)] & of_force.at[list(LATE)])
    assert np.max(np.abs(of_motion.mended - repeating(1e-3, ()).displacement)) < 2.0 * RESOLUTION
    (said,) = spike_warnings(test)
    assert said.startswith("displacement: 5 samples have the readings of those before, at 0.37, 0.6, 0.61, 1.5, 2.03 s")


def test_a_motion_that_is_slow_for_its_resolution_repeats_none() -> None:
    for step in (0.3 * RESOLUTION, RESOLUTION, 3.0 * RESOLUTION):
        assert not np.any(repeated_frames(repeating(step, ())))
    assert not np.any(repeated_frames(repeating(1e-3, (), rounded=False)))


def test_noise_that_is_read_twice_by_chance_repeats_no_frame() -> None:
    """Noise of four times the resolution reads one of ten samples as the one before where the motion is slow."""
    rng, t = np.random.default_rng(9), 0.005 * np.arange(5000)
    for rate in (0.3, 1.0, 3.0):
        u = 10e-3 * np.sin(2.0 * np.pi * rate * t) + 4.0 * RESOLUTION * rng.standard_normal(t.size)
        u, force = RESOLUTION * np.round(u / RESOLUTION), 500.0 * np.round(4e4 * u / 500.0)
        assert not np.any(repeated_frames(DamperTest("test_1", t, u, force)))
