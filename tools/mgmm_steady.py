"""Steady loops of the MGMM in closed form: under a sine its memories stand still, the rest is a Fourier series."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

SAMPLES = 256

Arrangement = Literal["printed", "beside"]


def steady_loops(
    values: Mapping[str, float],
    amplitude: ArrayLike,
    frequency: ArrayLike,
    samples: int = SAMPLES,
    arrangement: Arrangement = "printed",
) -> np.ndarray:
    """Return the force of the MGMM over one steady cycle of amplitude sin(2 pi frequency t).

    Args:
        values: parameters by name, SI units.
        amplitude: shape (n,), m.
        frequency: shape (n,), Hz.
        samples: a cycle, a multiple of 4.
        arrangement: "printed": Eq. 4.29, in which the relaxation c1/k1 of the branch holds for all forces; "beside":
            softened spring, softened dashpot and power-law dashpot beside the branch, their forces at once.

    Returns:
        Force, shape (n, samples), N; sample i at the phase 2 pi i / samples.
    """
    a = np.atleast_1d(np.asarray(amplitude, dtype=float))[:, None]
    omega = 2.0 * np.pi * np.atleast_1d(np.asarray(frequency, dtype=float))[:, None]
    i = np.arange(samples)
    sine, cosine = np.sin(2.0 * np.pi * i / samples), np.cos(2.0 * np.pi * i / samples)
    sine[i % (samples // 2) == 0] = 0.0
    cosine[(i + samples // 4) % (samples // 2) == 0] = 0.0
    u, v = a * sine, a * omega * cosine
    tau = values["c1"] / values["k1"]
    k_mod = values["k_a"] * np.exp(-a / values["u_ref"]) + values["k_b"]
    c_mod = values["c_a"] * np.exp(-a * omega / values["v_ref"]) + values["c_b"]
    slow = values["k0"] * u + (tau * values["k0"] + values["c1"]) * v
    rest = k_mod * u + c_mod * v + values["c_NL"] * np.sign(v) * np.abs(v) ** values["alpha"]
    if values.get("consistent", 0.0):
        rest = rest + tau * k_mod * v
    right = slow if arrangement == "beside" else slow + rest
    spectrum = np.fft.rfft(right, axis=1)
    spectrum /= 1.0 + 1j * omega * tau * np.arange(spectrum.shape[1])
    force: np.ndarray = np.fft.irfft(spectrum, samples, axis=1)
    return force + rest if arrangement == "beside" else force


def steady_moduli(force: np.ndarray) -> np.ndarray:
    """Return force amplitudes in phase, largest, and in phase with the velocity, (3, n) N: area strain G', G_eq, G''.

    Args:
        force: (n, samples) N in the last cycle of a sine.

    Source: thesis Eqs. 3.1-3.4.
    """
    samples = force.shape[1]
    cosine = np.cos(2.0 * np.pi * np.arange(samples) / samples)
    in_phase = 0.5 * (force[:, samples // 4] - force[:, 3 * samples // 4])
    largest = 0.5 * (force.max(axis=1) - force.min(axis=1))
    return np.array([in_phase, largest, 2.0 * (force @ cosine) / samples])
