"""One degree of freedom whose specimen answers late: m x'' + c x' + k_N x + k_E x(t - tau) = 0, in closed form."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

PHASE_STEP = 0.05
"""Phase |s| tau, rad, by which the delay grows between two solutions; the root moves by less than this share."""
NEWTON_STEPS = 30
ROOT_TOLERANCE = 1e-13
"""Last step of Newton over the root: some rounding errors of a double."""


@dataclass(frozen=True)
class CriticalDelay:
    """Delay at which free vibration neither grows nor decays.

    Attributes:
        delay: s; inf: no delay makes the motion grow.
        frequency: of that vibration, Hz; nan: there is none.
    """

    delay: float
    frequency: float


def critical_delay(mass: float, damping: float, stiffness: float, specimen_stiffness: complex) -> CriticalDelay:
    """Least delay of the specimen's force that makes the oscillator unstable.

    Args:
        mass: kg.
        damping: of the numerical part, N s/m.
        stiffness: of the numerical part k_N, N/m.
        specimen_stiffness: k_E, N/m; complex: k_E (1 + i n) with the loss factor n.

    Source: 6.5-6.6 of the thesis in exact form: modulus and phase of k_N - m w^2 + i c w = -k_E exp(-i w tau).
    """
    k_E = complex(specimen_stiffness)
    b = 2.0 * mass * stiffness - damping**2
    inside = b**2 - 4.0 * mass**2 * (stiffness**2 - abs(k_E) ** 2)
    square = (b + math.sqrt(inside)) / (2.0 * mass**2) if inside >= 0.0 else -1.0
    if square <= 0.0 or k_E == 0.0:
        return CriticalDelay(math.inf, math.nan)
    omega = math.sqrt(square)
    phase = math.atan2(damping * omega, mass * square - stiffness) + cmath.phase(k_E)
    return CriticalDelay(phase / omega, omega / (2.0 * math.pi))


def delayed_root(mass: float, damping: float, stiffness: float, specimen_stiffness: complex, delay: float) -> complex:
    """Root s of m s^2 + c s + k_N + k_E exp(-s tau) = 0 that is the structure's own at tau = 0, 1/s.

    The delay tau (s) grows from zero in small steps; Newton corrects each. It is the dominant root up to a phase of
    some pi; roots that only a delay brings lie farther left there. Other arguments as of `critical_delay`.
    """
    k_E = complex(specimen_stiffness)
    root = (-damping + cmath.sqrt(damping**2 - 4.0 * mass * (stiffness + k_E))) / (2.0 * mass)
    root = root if root.imag > 0.0 else -damping / mass - root
    steps = math.ceil(abs(root) * delay / PHASE_STEP)
    for i in range(1, steps + 1):
        root = _newton(mass, damping, stiffness, k_E, delay * i / steps, root)
    return root


def effective_damping(
    mass: float, damping: float, stiffness: float, specimen_stiffness: complex, delay: float
) -> float:
    """Damping ratio -Re s / |s| of the root of `delayed_root`, whose arguments it takes; less than zero: it grows."""
    root = delayed_root(mass, damping, stiffness, specimen_stiffness, delay)
    return -root.real / abs(root)


def _newton(mass: float, damping: float, stiffness: float, k_E: complex, delay: float, start: complex) -> complex:
    s = start
    for _ in range(NEWTON_STEPS):
        late = k_E * cmath.exp(-s * delay)
        step = (mass * s**2 + damping * s + stiffness + late) / (2.0 * mass * s + damping - delay * late)
        s -= step
        if abs(step) <= ROOT_TOLERANCE * abs(s):
            return s
    raise AssertionError(f"the root of the delayed oscillator is not found at a delay of {1e3 * delay:g} ms")
