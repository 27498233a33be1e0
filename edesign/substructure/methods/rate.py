"""What a slow test sees of a damper: its stiffness at the frequency of the earthquake and at that of the test."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.core.damper import CoreDamper
from edesign.damper.harmonic import CYCLES, SAMPLES
from edesign.substructure.methods.comparison import positive


@dataclass(frozen=True)
class RateEffect:
    """Stiffness of a damper at real speed and in a slow test, from its law.

    Attributes:
        amplitude: of the steady sine, m.
        frequency: at real speed, Hz.
        time_scale: by which the test is slower.
        stiffness: K' + i K'' at `frequency`, N/m.
        slow_stiffness: the same at frequency / time_scale, N/m.
    """

    amplitude: float
    frequency: float
    time_scale: float
    stiffness: complex
    slow_stiffness: complex

    @property
    def change(self) -> float:
        """Share of the damper's force that the slow test makes wrong: |K_slow - K| / |K|; NaN without a force."""
        size = abs(self.stiffness)
        return abs(self.slow_stiffness - self.stiffness) / size if size else math.nan

    def valid(self, tolerance: float) -> bool:
        """Say whether the change of the force is within a tolerance.

        Args:
            tolerance: dimensionless, e.g. that of the response error.
        """
        return self.change <= tolerance

    def sentence(self, tolerance: float) -> str:
        """Say what the slow test does to the damper, and whether the method is valid.

        Args:
            tolerance: of the change of the force, dimensionless.
        """
        slow, fast = self.slow_stiffness, self.stiffness
        verdict = "valid" if self.valid(tolerance) else "not valid"
        return (
            f"The method is {verdict} for this damper: at {1e3 * self.amplitude:.3g} mm and {self.frequency:.3g} Hz "
            f"its storage and loss stiffness are {fast.real / 1e6:.3g} and {fast.imag / 1e6:.3g} kN/mm; the test, "
            f"{self.time_scale:g} times slower, sees {slow.real / 1e6:.3g} and {slow.imag / 1e6:.3g} kN/mm. The force "
            f"is {100.0 * self.change:.3g} % wrong; {100.0 * tolerance:.3g} % are allowed."
        )


def rate_effect(damper: CoreDamper, amplitude: float, frequency: float, time_scale: float) -> RateEffect:
    """Return what a test that is `time_scale` times slower sees of a damper.

    Args:
        amplitude: of its deformation, m.
        frequency: of the motion at real speed, Hz.
        time_scale: greater than zero.

    Raises:
        InputError: a number is not greater than zero.
    """
    positive("time_scale", time_scale)
    fast = steady_stiffness(damper, amplitude, frequency)
    return RateEffect(
        amplitude, frequency, time_scale, fast, steady_stiffness(damper, amplitude, frequency / time_scale)
    )


def steady_stiffness(damper: CoreDamper, amplitude: float, frequency: float) -> complex:
    """Return K' + i K'' (N/m) of a damper in a steady sine: the first harmonic of the last of 12 cycles from rest.

    Args:
        amplitude: of the deformation, m.
        frequency: Hz.

    Raises:
        InputError: amplitude or frequency is not greater than zero.

    Source: thesis Eqs. 2.47-2.50; as `damper.harmonic.complex_stiffness`, which takes the law by its values.
    """
    positive("amplitude", amplitude)
    positive("frequency", frequency)
    omega = 2.0 * math.pi * frequency
    time = np.arange(CYCLES * SAMPLES + 1) / (SAMPLES * frequency)
    sine, cosine = np.sin(omega * time), np.cos(omega * time)
    force = damper.force(time, amplitude * sine, amplitude * omega * cosine)[-SAMPLES:]
    scale = 2.0 / (SAMPLES * amplitude)
    return complex(scale * (force @ sine[-SAMPLES:]), scale * (force @ cosine[-SAMPLES:]))


def motion_frequency(deformation: np.ndarray, step: float) -> float:
    """Return rms velocity / (2 pi rms deformation) in Hz: of a sine its frequency, otherwise a mean one.

    Args:
        deformation: (n,) m.
        step: of the samples, s.

    Returns:
        Frequency, Hz.
    """
    rate = np.gradient(deformation, step)
    return float(np.sqrt(np.mean(rate**2) / np.mean(deformation**2))) / (2.0 * math.pi)
