"""A tone in the force channel. The size is its amplitude, kN."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.random import Generator
from scipy.signal import lfilter

from blind.effects.base import Effect, Histories, TrueParameters
from blind.programme import Trial


class Mains(Effect):
    name, kind, form = "hum", "instrument", "mains"
    first, most = 2.0, 100.0

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency = float(rng.choice([50.0, 60.0])) + 0.05 * rng.standard_normal()

    def force_channel(self, tests: Sequence[Trial], force: Histories) -> Histories:
        return [f + self.size * self.tone(test, self.random(test)) for test, f in zip(tests, force, strict=True)]

    def tone(self, test: Trial, rng: Generator) -> np.ndarray:
        """Tone (n,), its phase another one in each test."""
        return np.sin(2.0 * np.pi * self.frequency * test.t + rng.uniform(0.0, 2.0 * np.pi))

    def true_parameters(self) -> TrueParameters:
        return {"amplitude": (self.size, "kN"), "frequency": (self.frequency, "Hz")}


class Harmonics(Mains):
    """With the third harmonic of a rectifier."""

    form = "mains_with_harmonic"

    def tone(self, test: Trial, rng: Generator) -> np.ndarray:
        w, phase = 2.0 * np.pi * self.frequency, rng.uniform(0.0, 2.0 * np.pi, 2)
        return np.sin(w * test.t + phase[0]) + 0.35 * np.sin(3.0 * w * test.t + phase[1])


class Pump(Mains):
    """A tone of the pump, somewhere between 12 and 90 Hz."""

    form = "pump"

    def shape(self, rng: Generator, tests: Sequence[Trial]) -> None:
        self.frequency = rng.uniform(12.0, 90.0)


class Unsteady(Pump):
    """Amplitude and phase of the tone wander."""

    form = "unsteady"

    def tone(self, test: Trial, rng: Generator) -> np.ndarray:
        e = float(np.exp(-test.h / 4.0))
        slow = lfilter([np.sqrt(1.0 - e * e)], [1.0, -e], rng.standard_normal((2, test.n)), axis=1)
        phase = 2.0 * np.pi * self.frequency * test.t + rng.uniform(0.0, 2.0 * np.pi)
        return (1.0 + 0.3 * slow[0]) * np.sin(phase + 0.6 * slow[1])


FORMS = (Mains, Harmonics, Pump, Unsteady)
