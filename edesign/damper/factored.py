"""The force of a damper whose stroke and velocity are raised by factors, by its own law."""

from __future__ import annotations

import math

import numpy as np

from edesign.core import LawValues
from edesign.damper.harmonic import steady_cycle
from edesign.damper.laws import LAWS

_DASHPOTS = ("viscous", "viscous_power")
_ANY = 1.0  # Hz, of laws that no frequency changes


def force_ratio(law: LawValues, stroke: float, velocity: float | None, on_stroke: float, on_velocity: float) -> float:
    """Return the force of a damper at its stroke and velocity times factors, over that at the stroke and velocity.

    Both are the largest forces in a steady sine with this stroke and largest velocity, by the law itself: of a dashpot
    with a power alpha the ratio is the factor on the velocity to the power alpha. It is at least 1.

    Args:
        law: with its parameters, at its own size.
        stroke: amplitude of its deformation, m.
        velocity: largest one, m/s; None: not known.

    Returns:
        The ratio; nan where the law depends on a velocity that is not known.
    """
    if on_stroke == 1.0 and on_velocity == 1.0:
        return 1.0
    if law.law in _DASHPOTS and not law.effects:
        _, alpha = (*law.values, 1.0)[:2]
        return float(on_velocity**alpha)
    if velocity is None and (LAWS[law.law].rate_dependent or law.effects):
        return math.nan
    if not stroke > 0.0 or velocity == 0.0:
        return 1.0
    frequency = _ANY if velocity is None else velocity / (2.0 * math.pi * stroke)
    raised = frequency if velocity is None else frequency * on_velocity / on_stroke
    forces = (steady_cycle(law, stroke, frequency)[1], steady_cycle(law, on_stroke * stroke, raised)[1])
    before, after = (float(np.abs(force).max()) for force in forces)
    return max(after / before, 1.0) if before > 0.0 else 1.0
