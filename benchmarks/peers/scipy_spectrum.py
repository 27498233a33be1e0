"""Response spectra by scipy alone, slow and fine: the reference of tests and benchmarks; nothing of edesign is used.

The motion is upsampled by zero padding of its Fourier transform, without anything beyond its ends, until a period has
`resolution` steps; the oscillator is the exact first-order-hold filter of its state equations; peaks are at samples.
Linear interpolation and sampled peaks each err by at most (pi / resolution)^2 / 2, 3e-5 with 400 steps.
"""

from __future__ import annotations

import numpy as np
import scipy.fft
import scipy.signal
from numpy.typing import NDArray

Array = NDArray[np.float64]
_QUIET = 4000  # zeros after the motion, so that the end does not reach round into the beginning


def upsampled(acceleration: Array, factor: int) -> Array:
    """The band-limited motion through the samples (n,) at ((n - 1) factor + 1) times."""
    size = scipy.fft.next_fast_len(acceleration.size + _QUIET)
    content = scipy.fft.rfft(acceleration, size)
    if size % 2 == 0:
        content[-1] *= 0.5
    return np.asarray(factor * scipy.fft.irfft(content, size * factor)[: (acceleration.size - 1) * factor + 1])


def reference_spectra(
    acceleration: Array, time_step: float, periods: Array, damping: float, resolution: int = 400, factor: int = 16
) -> tuple[Array, Array, Array]:
    """Peak relative displacement, relative velocity and absolute acceleration, (n_T,) each.

    Args:
        acceleration: (n,) m/s2.
        time_step: s.
        periods: (n_T,) s.
        damping: ratio of critical.
        resolution: steps a period, at least.
        factor: of upsampling, at least.
    """
    peaks = np.empty((3, periods.size))
    motions: dict[int, Array] = {}
    for i, period in enumerate(periods):
        needed = max(factor, 2 ** int(np.ceil(np.log2(max(1.0, resolution * time_step / period)))))
        if needed not in motions:
            motions = {needed: upsampled(acceleration, needed)}
        step, omega = time_step / needed, 2.0 * np.pi / period
        motion = np.concatenate((motions[needed], np.zeros(int(0.6 * period / step) + 2)))
        last = np.array([-(omega**2), -2.0 * damping * omega])
        state = np.array([[0.0, 1.0], last])
        output = np.array([[1.0, 0.0], [0.0, 1.0], last])
        continuous = (state, np.array([[0.0], [-1.0]]), output, np.zeros((3, 1)))
        discrete = scipy.signal.cont2discrete(continuous, step, "foh")
        numerators, denominator = scipy.signal.ss2tf(*discrete[:4])
        for kind, numerator in enumerate(numerators):
            peaks[kind, i] = np.max(np.abs(scipy.signal.lfilter(numerator, denominator, motion)))
    return peaks[0], peaks[1], peaks[2]


def noise_motion(samples: int, time_step: float, seed: int = 1) -> Array:
    """A motion like an earthquake's (n,), m/s2: noise under an envelope, between 0.1 and 25 Hz, ground at 2.5 Hz."""
    t = np.arange(samples) * time_step
    duration = samples * time_step
    envelope = (t / (0.15 * duration)) ** 2 * np.exp(2.0 - 2.0 * t / (0.15 * duration))
    noise = np.random.default_rng(seed).standard_normal(samples) * envelope
    size = scipy.fft.next_fast_len(2 * samples)
    f = scipy.fft.rfftfreq(size, time_step)
    ground = np.abs((1.0 + 1.2j * f / 2.5) / (1.0 - (f / 2.5) ** 2 + 1.2j * f / 2.5))
    band = (f / 0.1) ** 4 / (1.0 + (f / 0.1) ** 4) / (1.0 + (f / min(25.0, 0.3 / time_step)) ** 12)
    motion = scipy.fft.irfft(scipy.fft.rfft(noise, size) * ground * band, size)[:samples]
    fade = np.minimum(1.0, np.minimum(t, t[-1] - t) / (0.02 * duration))  # starts and ends at rest
    motion *= np.sin(0.5 * np.pi * fade) ** 2
    return np.asarray(3.0 * motion / np.max(np.abs(motion)))
