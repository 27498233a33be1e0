"""What the actuator does: motions on a fine grid of time, from rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import butter, lfilter, sosfilt

Array = NDArray[np.float64]

FINE = 2400.0  # Hz, least rate of the fine grid
PER_PERIOD = 80  # least points of the fine grid a period of the fastest content


@dataclass(frozen=True)
class Motion:
    """Displacement (mm), velocity (mm/s) and acceleration (mm/s^2) on a grid, and its fastest content (Hz)."""

    kind: str
    dt: float
    x: Array
    v: Array
    a: Array
    fastest: float

    @property
    def time(self) -> Array:
        """Time of the grid, s."""
        return np.asarray(np.arange(len(self.x)) * self.dt, dtype=np.float64)


@dataclass(frozen=True)
class Plan:
    """A test as it is asked for; `seed` draws what is random in it."""

    kind: str  # sine, dwell, triangle, stairs, sweep, random, earthquake
    amplitude: float  # mm
    frequency: float  # Hz; of random and earthquake motions the centre
    top: float  # Hz, fastest content
    seconds: float
    rest: float  # s before the trigger
    seed: int
    actuator: tuple[float, float]  # natural frequency in Hz and damping; the latter below 0.7 overshoots
    ramp: float  # cycles


def make(plan: Plan, rate: float) -> Motion:
    """The motion of a plan, on a grid of a multiple of a rate.

    Args:
        plan: of the test.
        rate: of the grid, Hz.

    Returns:
        The motion, which starts at rest.
    """
    dt = 1.0 / rate
    number = round((plan.seconds + plan.rest) * rate) + 1
    t: Array = np.asarray(np.arange(number) * dt - plan.rest, dtype=np.float64)
    rng = np.random.default_rng(plan.seed)
    on = t >= 0
    cycles = np.maximum(t, 0) * plan.frequency
    grow = _smooth(cycles / plan.ramp)
    if plan.kind in ("sine", "stairs"):
        steps = 1.0
        if plan.kind == "stairs":
            levels = np.array([0.3, 0.6, 1.0])
            at = cycles / (plan.seconds * plan.frequency) * 3
            steps = levels[0] + sum((levels[i] - levels[i - 1]) * _smooth((at - i) / 0.15) for i in (1, 2))
        x = np.sin(2 * np.pi * cycles) * grow * steps
    elif plan.kind in ("triangle", "dwell"):
        saw = 2 / np.pi * np.arcsin(np.sin(2 * np.pi * cycles) * (1 - 1e-9))
        x = (np.clip(1.35 * saw, -1, 1) if plan.kind == "dwell" else saw) * grow
    elif plan.kind == "sweep":
        low, high = 0.4 * plan.frequency, plan.top
        growth = np.log(high / low) / plan.seconds
        phase = 2 * np.pi * low * np.expm1(growth * np.maximum(t, 0)) / growth
        x = (
            np.sin(phase)
            * _smooth(np.maximum(t, 0) * low)
            / (1 + (low / plan.frequency) * np.expm1(growth * np.maximum(t, 0)))
        )
    else:
        x = _random(plan, t, rng, dt)
    x = np.where(on, x, 0.0)
    if plan.kind in ("triangle", "dwell", "sine", "stairs", "sweep"):
        x = _follow(x, plan.actuator, dt)
    x = x * plan.amplitude / np.abs(x).max()
    return Motion(plan.kind, dt, x, _slope(x, dt), _slope(_slope(x, dt), dt), plan.top)


def _random(plan: Plan, t: Array, rng: np.random.Generator, dt: float) -> Array:
    """Broadband motion: noise through a resonance and a fall to the fastest content; an envelope."""
    noise = rng.standard_normal(len(t))
    top = butter(4, plan.top, fs=1 / dt, output="sos")
    bottom = butter(2, 0.25 * plan.frequency, btype="high", fs=1 / dt, output="sos")
    flat = sosfilt(top, noise)
    slow = sosfilt(butter(2, plan.frequency, fs=1 / dt, output="sos"), flat)
    fast = rng.uniform(0.1, 0.7) * 1.7 * plan.frequency / plan.top  # of the speed, a share of the slow motion's
    x = sosfilt(bottom, slow / slow.std() + fast * flat / flat.std())
    s = np.maximum(t, 0) / plan.seconds
    if plan.kind == "earthquake":
        x = x * np.where(s < 0.15, _smooth(s / 0.15), np.exp(-3.5 * np.maximum(s - 0.35, 0)))
    else:
        x = x * _smooth(s / 0.04)
    return x * _smooth((1 - s) / 0.04) if rng.random() < 0.6 else x


def _follow(x: Array, actuator: tuple[float, float], dt: float) -> Array:
    """An actuator of second order after a first one, whose rate makes corners of the command round."""
    frequency, damping = actuator
    w = 2 * np.pi * frequency
    for _ in range(2):
        q = np.tan(0.5 * w * dt)
        b = np.array([1.0, 2.0, 1.0]) * q * q
        a = np.array([1 + 2 * damping * q + q * q, 2 * q * q - 2, 1 - 2 * damping * q + q * q])
        x = lfilter(b / a[0], a / a[0], x)
        damping, w = 0.8, 2 * w
    return np.asarray(x)


def _slope(x: Array, dt: float) -> Array:
    """Derivative of order 4 within, of order 2 at the ends."""
    slope = np.gradient(x, dt, edge_order=2)
    slope[2:-2] = (x[:-4] - 8 * x[1:-3] + 8 * x[3:-1] - x[4:]) / (12 * dt)
    return slope


def _smooth(s: Array) -> Array:
    """From 0 at 0 to 1 at 1 without corners."""
    s = np.clip(s, 0.0, 1.0)
    return s * s * s * (10 - 15 * s + 6 * s * s)
