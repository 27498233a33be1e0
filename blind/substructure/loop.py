"""A storey in the computer and the damper of thesis Eq. 4.29 behind a rig: what target the loop makes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from blind import law
from blind.law import Parameters
from blind.signals import rise
from blind.substructure.rig import Follower

STIFF = 7.0  # kN/mm: of the damper at some 30 % strain and 2 Hz
LOST = 3.0  # times the wanted peak, at which a loop has run away


class RanAway(ArithmeticError):
    """The loop is not stable with this rig."""


@dataclass(frozen=True)
class Storey:
    """A structure of one degree of freedom; force kN, displacement mm.

    Attributes:
        mass: kN s2/mm.
        damping: kN s/mm.
        stiffness: kN/mm.
    """

    mass: float
    damping: float
    stiffness: float


def draw_storey(rng: Generator) -> Storey:
    """Draw a storey of 1 to 3 Hz, 3 to 6 times as stiff as the damper, 2 to 5 % damped."""
    stiffness = STIFF * rng.uniform(3.0, 6.0)
    w = 2.0 * math.pi * rng.uniform(1.0, 3.0)
    mass = stiffness / w**2
    return Storey(mass, 2.0 * rng.uniform(0.02, 0.05) * mass * w, stiffness)


def ground_motion(rng: Generator, t: np.ndarray) -> np.ndarray:
    """Acceleration (n,) of any size: modulated noise through soil (Kanai and Tajimi)."""
    peak, power = rng.uniform(0.15, 0.4) * t[-1], rng.uniform(1.5, 3.0)
    envelope = (t / peak) ** power * np.exp(power * (1.0 - t / peak))
    f = np.fft.rfftfreq(2 * t.size, t[1] - t[0])
    x = f / rng.uniform(2.0, 4.0)
    soil = (1.0 + 1.2j * x) / (1.0 - x * x + 1.2j * x) * rise((f - 0.1) / 0.1) * rise((25.0 - f) / 10.0)
    noise = np.fft.rfft(rng.standard_normal(t.size) * envelope, 2 * t.size)
    return np.fft.irfft(noise * soil)[: t.size] * rise(t / 0.5) * rise((t[-1] - t) / 2.0)


class Damper:
    """The damper step by step, from rest; the same as `law.force`."""

    def __init__(self, p: Parameters, h: float) -> None:
        self._p, self._h = p, h
        self._keep = math.exp(-h / law.relaxation(p))
        self._c = law.relaxation(p) * p["k0"] + p["c1"] + p["c_b"]
        self._u = self._force = self._above = self._below = self._faster = self._slower = 0.0

    def step(self, u: float) -> float:
        """Force, kN, at the next displacement, mm."""
        p, before = self._p, self._above - self._below
        v = (u - self._u) / self._h
        self._above, self._below = max(self._above, u), min(self._below, u)
        self._faster, self._slower = max(self._faster, v), min(self._slower, v)
        u_max, v_max = 0.25 * (before + self._above - self._below), 0.5 * (self._faster - self._slower)
        right = (p["k0"] + p["k_a"] * math.exp(-u_max / p["u_ref"]) + p["k_b"]) * 0.5 * (self._u + u)
        right += (self._c + p["c_a"] * math.exp(-v_max / p["v_ref"])) * v
        right += p["c_NL"] * math.copysign(abs(v) ** p["alpha"], v)
        self._u, self._force = u, self._keep * self._force + (1.0 - self._keep) * right
        return self._force


def run(storey: Storey, p: Parameters, follower: Follower, ground: np.ndarray, h: float, most: float) -> np.ndarray:
    """Target (n,) mm of a test, by the explicit Newmark method (beta 0, gamma 1/2; thesis 6.1 to 6.3).

    Args:
        storey: in the computer.
        p: parameters of the damper.
        follower: the rig, at rest.
        ground: acceleration (n,) mm/s2.
        h: step, s.
        most: LOST times it is no test any more, mm.

    Raises:
        RanAway: the loop is not stable.
    """
    damper = Damper(p, h)
    u = v = 0.0
    a = -float(ground[0])
    target = [0.0]
    mass, c, k = storey.mass, storey.damping, storey.stiffness
    for shaking in ground[1:].tolist():
        u += h * v + 0.5 * h * h * a
        half = v + 0.5 * h * a
        force = damper.step(follower.step(u))
        a = (-mass * shaking - c * half - k * u - force) / (mass + 0.5 * h * c)
        v = half + 0.5 * h * a
        target.append(u)
        if abs(u) > LOST * most:
            raise RanAway
    return np.array(target)
