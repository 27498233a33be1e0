"""Motions of tests: displacement (n,) mm at times (n,) s, from rest at zero and back to it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.random import Generator
from scipy.interpolate import PchipInterpolator

FASTEST = 155.0  # mm/s: what the pumps give


def rise(x: np.ndarray) -> np.ndarray:
    """From 0 to 1 with two continuous derivatives, for x from 0 to 1."""
    x = np.clip(x, 0.0, 1.0)
    return x**3 * (10.0 - 15.0 * x + 6.0 * x * x)


def window(t: np.ndarray, up: float, down: float) -> np.ndarray:
    """One but for rise and fall, s."""
    return rise(t / up) * rise((t[-1] - t) / down)


def slow_enough(amplitude: float, frequency: float) -> float:
    """The amplitude in mm, less if the rig cannot follow at this frequency in Hz."""
    return min(amplitude, FASTEST / (2.0 * np.pi * frequency))


def sine(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    f = float(rng.choice([0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0]))
    a = slow_enough(amplitude, f)
    ramp = min(rng.uniform(1.0, 2.5) / f, 0.3 * t[-1])
    return a * window(t, ramp, ramp) * np.sin(2.0 * np.pi * f * t), f"sine {f:g} Hz, {_strain(a)}"


def staircase(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """A few cycles on each of several amplitudes."""
    f = float(rng.choice([0.5, 1.0, 1.5, 2.0, 3.0]))
    a = slow_enough(amplitude, f)
    count = int(rng.integers(5, 10))
    levels = rng.permutation(np.linspace(1.0 / count, 1.0, count)) if rng.random() < 0.7 else np.linspace(0.2, 1, count)
    edges = np.linspace(0.0, t[-1], count + 2)
    centres = 0.5 * (edges[1:] + edges[:-1])
    quarter = 0.3 * (edges[1] - edges[0])
    knots = np.concatenate(
        [[0.0], np.ravel(np.column_stack([centres[:-1] - quarter, centres[:-1] + quarter])), [t[-1]]]
    )
    shape = PchipInterpolator(knots, np.concatenate([[0.0], np.repeat(levels, 2), [0.0]]))(t)
    return a * shape * window(t, 0.3 / f, 0.3 / f) * np.sin(2.0 * np.pi * f * t), f"steps {f:g} Hz, to {_strain(a)}"


def swelling(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """The amplitude grows and falls in proportion to time."""
    f = float(rng.choice([0.5, 1.0, 2.0, 3.0, 4.0]))
    a = slow_enough(amplitude, f)
    top = rng.uniform(0.3, 0.8)
    shape = np.interp(t / t[-1], [0.0, top, 1.0], [0.0, 1.0, 0.0])
    return a * shape * window(t, 0.5, 0.5) * np.sin(2.0 * np.pi * f * t), f"swelling {f:g} Hz, to {_strain(a)}"


def chirp(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """The frequency runs from one end to the other."""
    low, high = rng.uniform(0.2, 0.5), rng.uniform(2.5, 4.0)
    f = low * (high / low) ** (t / t[-1])
    if rng.random() < 0.4:
        f = f[::-1]
    phase = 2.0 * np.pi * np.concatenate([[0.0], np.cumsum(0.5 * (f[1:] + f[:-1]) * np.diff(t))])
    a = np.minimum(amplitude, FASTEST / (2.0 * np.pi * f))
    title = f"sweep {f[0]:.2g} to {f[-1]:.2g} Hz, {_strain(amplitude)}"
    return a * window(t, 0.7 / f[0], 0.7 / f[-1]) * np.sin(phase), title


def random(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """Gaussian noise in a band, falling with frequency."""
    low, high = rng.uniform(0.1, 0.4), rng.uniform(2.0, 5.0)
    slope = rng.uniform(0.5, 1.3)
    shaped = _shaped(rng.standard_normal(t.size), t, lambda f: _band(f, low, high) / np.maximum(f, low) ** slope)
    return _scaled(
        shaped * window(t, 1.0, 1.0), t, amplitude
    ), f"random {low:.1f} to {high:.1f} Hz, {_strain(amplitude)}"


def earthquake(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """Modulated noise through a storey that sways."""
    peak = rng.uniform(0.15, 0.4) * t[-1]
    power = rng.uniform(1.5, 3.0)
    envelope = (t / peak) ** power * np.exp(power * (1.0 - t / peak))
    storey, damping, ground = rng.uniform(0.45, 1.8), rng.uniform(0.08, 0.25), rng.uniform(2.0, 4.0)

    def response(f: np.ndarray) -> np.ndarray:
        x, g = f / storey, f / ground
        sway = 1.0 / (1.0 - x * x + 2j * damping * x)
        soil = (1.0 + 1.2j * g) / (1.0 - g * g + 1.2j * g)
        return sway * soil * _band(f, 0.12, 9.0)

    shaped = _shaped(rng.standard_normal(t.size) * envelope, t, response)
    name = "".join(rng.choice(list("abcdefghkmnprstuvw"), 2))
    return _scaled(shaped * window(t, 0.5, 2.0), t, amplitude), f"earthquake {name}, {_strain(amplitude)}"


def two_tones(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    f, g = rng.uniform(0.3, 0.8), rng.uniform(1.5, 4.0)
    both = np.sin(2.0 * np.pi * f * t) + rng.uniform(0.2, 0.6) * np.sin(2.0 * np.pi * g * t + rng.uniform(0.0, 6.28))
    return _scaled(both * window(t, 1.5, 1.5), t, amplitude), f"two tones {f:.2g} and {g:.2g} Hz, {_strain(amplitude)}"


def hold(rng: Generator, t: np.ndarray, amplitude: float) -> tuple[np.ndarray, str]:
    """A ramp to a deformation that is held, then cycles."""
    side, f = float(rng.choice([-1.0, 1.0])), float(rng.choice([0.5, 1.0, 2.0]))
    up, back = rng.uniform(0.1, 0.8), rng.uniform(0.3, 0.45) * t[-1]
    held = side * rise((t - 0.3) / up) * rise((back - t) / 0.6)
    cycles = rise((t - back) / 0.7) * rise((t[-1] - t) / 1.0) * np.sin(2.0 * np.pi * f * (t - back))
    return slow_enough(amplitude, f) * (
        held + rng.uniform(0.5, 1.0) * cycles
    ), f"hold, then {f:g} Hz, {_strain(amplitude)}"


Signal = Callable[[Generator, np.ndarray, float], tuple[np.ndarray, str]]
SIGNALS: dict[str, Signal] = {
    "sine": sine,
    "staircase": staircase,
    "swelling": swelling,
    "chirp": chirp,
    "random": random,
    "earthquake": earthquake,
    "two_tones": two_tones,
    "hold": hold,
}


def _strain(amplitude: float) -> str:
    return f"{amplitude / 0.12:.0f} %"


def _band(f: np.ndarray, low: float, high: float) -> np.ndarray:
    return rise((f - 0.5 * low) / (0.5 * low)) * rise((1.6 * high - f) / (0.6 * high))


def _shaped(noise: np.ndarray, t: np.ndarray, response: Callable[[np.ndarray], np.ndarray]) -> np.ndarray:
    length = 2 * t.size
    f = np.fft.rfftfreq(length, t[1] - t[0])
    return np.fft.irfft(np.fft.rfft(noise, length) * response(f), length)[: t.size]


def _scaled(u: np.ndarray, t: np.ndarray, amplitude: float) -> np.ndarray:
    """Peak at the amplitude, or less where the rig is too slow for it."""
    fastest = np.abs(np.diff(u)).max() / (t[1] - t[0])
    return u * min(amplitude / np.abs(u).max(), FASTEST / fastest)
