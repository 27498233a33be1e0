"""Stiffness of dampers in steady harmonic motion: what natural modes see of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

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
    force = CoreDamper(law.law, law.values, brace, law.effects, play=play).force(
        time, amplitude * np.sin(phase), amplitude * omega * np.cos(phase)
    )
    return phase[-SAMPLES:], force[-SAMPLES:]


def complex_stiffness(
    law: LawValues, amplitude: float, frequency: float, brace: float = 0.0, play: float = 0.0
) -> complex:
    """Return the stiffness of a damper in a steady sine.

    The real part is in phase with the deformation, the imaginary one with the velocity. It is the first harmonic of the
    last of 12 cycles; effects that count what happened are as far as they are there.

    Args:
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


def effective_stiffness(
    law: LawValues, amplitude: float, frequency: float, speed: float | None = None
) -> tuple[float, float]:
    """Return the effective stiffness and the energy of a cycle of an isolator in a steady sine.

    The stiffness is the force at the largest deformation over it. There the motion stands still, and friction that
    depends on the speed has fallen to that of rest, which the loop reaches next to the turn alone. The force that codes
    mean has the friction of the sliding before, so friction counts as at the largest speed of the motion. Viscous
    forces have no part in the stiffness: they are zero at the turn, and fall towards it all the way.

    Args:
        amplitude: of the deformation, m.
        frequency: Hz.
        speed: at which friction counts, m/s; None: the largest of the sine.

    Returns:
        Forces at both extremes of the deformation over the distance between these, N/m, and work of the cycle, J, by
        the law as it is.

    Source: EN 1998-1:2004, 10.9.2(2) and (3); ASCE/SEI 7-16, Eq. 17.2-3; friction of the design velocity in the loop of
        a slider: EN 15129:2009, 8.3.
    """
    angle, last = steady_cycle(law, amplitude, frequency)
    work = float(2.0 * np.pi * amplitude / SAMPLES * (last @ np.cos(angle)))
    sliding, beside = _friction_at(law, 2.0 * np.pi * frequency * amplitude if speed is None else speed)
    if sliding != law:
        last = steady_cycle(sliding, amplitude, frequency)[1]
    quarter = SAMPLES // 4  # the cycle begins one step after its zero
    stiffness = (last[quarter - 1] - last[3 * quarter - 1]) / (2.0 * amplitude)
    return float(stiffness) + beside / amplitude, work


def _friction_at(law: LawValues, speed: float) -> tuple[LawValues, float]:
    """The law with the friction of one speed (m/s) at every speed, and the size of the friction beside it, N."""
    values, kept, beside = law.values, [], 0.0
    if law.law == "friction_pendulum":
        W, R, f_slow, f_fast, a, Y = values
        mu = f_fast - (f_fast - f_slow) * np.exp(-a * speed)
        values = (W, R, mu, mu, 0.0, Y * mu / f_slow)  # as stiff before it slips
    for effect in law.effects:
        friction = _FRICTION.get(effect.name) if effect.placement == "whole" else None
        if friction is None:
            kept.append(effect)
        else:
            beside += friction(speed, *effect.values)
    return LawValues(law.law, values, tuple(kept)), beside


_FRICTION: Mapping[str, Callable[..., float]] = MappingProxyType(
    {
        "friction.coulomb": lambda v, F_c, v0: F_c * np.tanh(v / v0),
        "friction.stribeck": lambda v, F_c, s, v_s: (
            F_c * (1.0 + s * np.exp(-((v / v_s) ** 2))) * np.tanh(10.0 * v / v_s)
        ),
    }
)
"""Friction beside a law that depends on the speed: its force by speed (m/s) and parameters, N."""
