"""Campaigns of a Kelvin-Voigt specimen whose forces are closed forms of the motion: F = k u + c v + what is hidden."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from edesign.damper.testing.campaign import Campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen

K, C = 4.0e6, 2.0e5  # N/m, N s/m
RATE = 250.0  # Hz
NOISE = 60.0  # N
Hidden = Callable[[np.ndarray, np.ndarray, np.ndarray, np.ndarray, int], np.ndarray]
"""Force (n,) N of time, displacement, velocity, acceleration (n,) and order, instead of the law's."""


def lawful(t: np.ndarray, u: np.ndarray, v: np.ndarray, a: np.ndarray, order: int) -> np.ndarray:
    """The law alone."""
    return K * u + C * v


def motion(order: int, late: float = 0.0) -> tuple[np.ndarray, ...]:
    """Time, displacement, velocity, acceleration of a test: two sines that grow from rest; `late` shifts the motion
    in time.
    """
    t = np.arange(0.0, 8.0, 1.0 / RATE)
    s = t - late
    f = (0.5, 1.0, 2.0, 0.7, 1.5, 3.0, 0.9, 1.2)[order % 8]
    amplitude = (3e-3, 5e-3, 2e-3, 1e-3, 4e-3, 1.5e-3, 2.5e-3, 5e-3)[order % 8]
    total = [np.zeros_like(t) for _ in range(3)]
    for share, w in ((0.7, 2.0 * np.pi * f), (0.3, 2.0 * np.pi * 2.3 * f)):
        g, g1, g2 = 1.0 - np.exp(-s), np.exp(-s), -np.exp(-s)
        sine, cosine = np.sin(w * s), np.cos(w * s)
        total[0] += amplitude * share * g * sine
        total[1] += amplitude * share * (g1 * sine + w * g * cosine)
        total[2] += amplitude * share * (g2 * sine + 2.0 * w * g1 * cosine - w**2 * g * sine)
    return (t, *total)


def campaign(
    folder: Path, hidden: Hidden = lawful, tests: int = 8, seed: int = 1, late: float = 0.0, noise: float = NOISE
) -> Campaign:
    """A campaign with something hidden: the last two tests validate; the law is declared as it is."""
    random = np.random.default_rng(seed)
    made = []
    for order in range(tests):
        recorded = motion(order)
        force = hidden(*motion(order, late), order) + noise * random.standard_normal(recorded[0].size)
        use = "fit" if order < tests - 2 else "validate"
        made.append(DamperTest(f"test_{order + 1:02d}", recorded[0], recorded[1], force, 20.0, use=use))
    law = LawChoice("kelvin_voigt", {"k": f"{K / 1e6} kN/mm", "c": f"{C / 1e6} kN*s/mm"})
    return write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), made, law)
