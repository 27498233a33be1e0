"""Stiffness of dampers in steady harmonic motion: what natural modes see of them."""

from __future__ import annotations

import numpy as np

from edesign.core import LawValues
from edesign.core.damper import CoreDamper

CYCLES = 12
SAMPLES = 100
"""Steps a cycle; the steps are exact along the cubic path, which meets a sine to 1e-7."""


def complex_stiffness(
    law: LawValues, amplitude: float, frequency: float, brace: float = 0.0, play: float = 0.0
) -> complex:
    """Stiffness of a damper in a steady sine: in phase with the deformation and, imaginary, with the velocity.

    First harmonic of the last of 12 cycles; amendments that count what happened are as far as they are there.

    Args:
        law: the law with its parameters and amendments.
        amplitude: of the deformation of damper and brace, m.
        frequency: Hz.
        brace: stiffness in series, N/m; 0: rigid.
        play: of the pins of the brace, from end to end, m.

    Returns:
        K' + i K'', N/m; the loss factor is K''/K' (thesis Eqs. 2.47-2.50).
    """
    omega = 2.0 * np.pi * frequency
    time = np.arange(CYCLES * SAMPLES + 1) / (SAMPLES * frequency)
    phase = omega * time
    force = CoreDamper(law.law, law.values, brace, law.amendments, play=play).force(
        time, amplitude * np.sin(phase), amplitude * omega * np.cos(phase)
    )
    last, angle = force[-SAMPLES:], phase[-SAMPLES:]
    scale = 2.0 / (SAMPLES * amplitude)
    return complex(scale * (last @ np.sin(angle)), scale * (last @ np.cos(angle)))
