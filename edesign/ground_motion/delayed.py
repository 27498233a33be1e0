"""Ground motion that arrives later: a wave on its way along a building."""

from __future__ import annotations

import numpy as np

from edesign.ground_motion.intensity import displacement, velocity


def motion_at(acceleration: np.ndarray, time_step: float, times: np.ndarray) -> np.ndarray:
    """Return displacement, velocity and acceleration of a motion at any times, (3, times), m, m/s, m/s2.

    Acceleration is linear between samples, 0 before the first and after the last one; displacement and velocity are its
    exact integrals from rest. After the record the ground goes on at the velocity that it has left.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        times: from the first sample on, s.
    """
    a, h = acceleration, time_step
    u, v = displacement(a, h), velocity(a, h)
    last = a.size - 1
    i = np.clip(np.floor(np.clip(times / h, 0.0, last)).astype(int), 0, last)
    t = times - i * h
    slope = np.append(np.diff(a) / h, 0.0)[i]
    start = np.where(i < last, a[i], 0.0)
    found = np.array(
        [
            u[i] + t * (v[i] + t * (0.5 * start + t * slope / 6.0)),
            v[i] + t * (start + 0.5 * t * slope),
            start + t * slope,
        ]
    )
    found[2] = np.where((i == last) & (t <= 1e-9 * h), a[-1], found[2])
    return np.where(times < 0.0, 0.0, found)


def delayed_by(acceleration: np.ndarray, time_step: float, delay: float) -> np.ndarray:
    """Return how a place to which the motion comes later moves relative to the ground before it.

    Args:
        acceleration: (n,) of the ground, m/s2.
        time_step: s.
        delay: of the motion at the place, s, not negative.

    Returns:
        Displacement, velocity and acceleration at the times of the samples, (3, n), m, m/s, m/s2.
    """
    times = time_step * np.arange(acceleration.size)
    return motion_at(acceleration, time_step, times - delay) - motion_at(acceleration, time_step, times)
