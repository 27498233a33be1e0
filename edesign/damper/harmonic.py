"""Stiffness of dampers in steady harmonic motion: what natural modes see of them."""

from __future__ import annotations

import numpy as np

from edesign.core import LawValues
from edesign.core.damper import CoreDamper

CYCLES = 12
SAMPLES = 100
"""Steps a cycle; the steps are exact along the cubic path, which meets a sine to 1e-7."""


def steady_cycle(
    law: LawValues, amplitude: float, frequency: float, brace: float = 0.0, play: float = 0.0
) -> tuple[np.ndarray, np.ndarray]:
    """Return the force of a damper in the last of 12 cycles of a steady sine of its deformation.

    Args:
        law: law and parameters.
        amplitude: of the deformation, m.
        frequency: Hz.
        brace: stiffness in series, N/m; 0: rigid.
        play: of the pins of the brace, from end to end, m.

    Returns:
        Phase of the deformation (SAMPLES,), rad, in the last turn, and force (SAMPLES,), N.
    """
    omega = 2.0 * np.pi * frequency
    time = np.arange(CYCLES * SAMPLES + 1) / (SAMPLES * frequency)
    phase = omega * time
    force = CoreDamper(law.law, law.values, brace, law.amendments, play=play).force(
        time, amplitude * np.sin(phase), amplitude * omega * np.cos(phase)
    )
    return phase[-SAMPLES:], force[-SAMPLES:]


def complex_stiffness(
    law: LawValues, amplitude: float, frequency: float, brace: float = 0.0, play: float = 0.0
) -> complex:
    """Return the stiffness of a damper in a steady sine.

    The real part is in phase with the deformation, the imaginary one with the velocity. It is the first harmonic of the
    last of 12 cycles; amendments that count what happened are as far as they are there.

    Args:
        law: the law with its parameters and amendments.
        amplitude: of the deformation of damper and brace, m.
        frequency: Hz.
        brace: stiffness in series, N/m; 0: rigid.
        play: of the pins of the brace, from end to end, m.

    Returns:
        K' + i K'', N/m; the loss factor is K''/K' (thesis Eqs. 2.47-2.50).
    """
    angle, last = steady_cycle(law, amplitude, frequency, brace, play)
    scale = 2.0 / (SAMPLES * amplitude)
    return complex(scale * (last @ np.sin(angle)), scale * (last @ np.cos(angle)))


def secant_stiffness(law: LawValues, amplitude: float, frequency: float) -> tuple[float, float]:
    """Return the effective stiffness and the energy of a cycle of a damper in a steady sine.

    Args:
        law: law and parameters.
        amplitude: of the deformation, m.
        frequency: Hz.

    Returns:
        Forces at both extremes of the deformation over the distance between these, N/m, and work of the cycle, J.

    Source: EN 1998-1:2004, 10.9.2(2) and (3); ASCE/SEI 7-16, Eq. 17.2-3.
    """
    angle, last = steady_cycle(law, amplitude, frequency)
    quarter = SAMPLES // 4  # the cycle begins one step after its zero
    stiffness = (last[quarter - 1] - last[3 * quarter - 1]) / (2.0 * amplitude)
    return float(stiffness), float(2.0 * np.pi * amplitude / SAMPLES * (last @ np.cos(angle)))
