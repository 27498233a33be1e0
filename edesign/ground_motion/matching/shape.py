"""How far matching changed the character of a motion, and how far it may."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.ground_motion.intensity import husid, measures
from edesign.ground_motion.record import Record

GREATEST_RATIO = 1.715
"""Of Arias intensity or duration, upwards or downwards: score 6 of 10 exp(-x^2), x = ratio - 1."""
GREATEST_HUSID_DIFFERENCE = 0.4
"""Between the normalised Husid curves: score 6 of 10 (1 - difference)."""
LEAST_CORRELATION = 0.6
"""Between the accelerations: score 6 of 10 times the correlation.

Source of the four bounds: Anderson (2004), 13th World Conference on Earthquake Engineering, paper 243. From score 6 on
a fit is "good", and one horizontal component of a recording typically fits the other one that well. A matched motion
that keeps within the bounds is as near to its original as the other component of the same recording is.
"""


@dataclass(frozen=True)
class Shape:
    """A matched motion against the scaled original.

    Attributes:
        arias_ratio: Arias intensity after over before.
        duration_ratio: significant duration 5-95 % after over before.
        husid_difference: greatest difference of the Husid curves, each normalised by its end value.
        correlation: of the accelerations, sample by sample.
    """

    arias_ratio: float
    duration_ratio: float
    husid_difference: float
    correlation: float

    def notes(self) -> tuple[str, ...]:
        """Describe what is outside the bounds.

        Returns:
            One sentence for each quantity outside them.
        """
        low, high = 1.0 / GREATEST_RATIO, GREATEST_RATIO
        found = []
        if not low <= self.arias_ratio <= high:
            found.append(
                f"the Arias intensity is {self.arias_ratio:.2f} times that of the scaled original, "
                f"outside {low:.2f} to {high:.2f}"
            )
        if not low <= self.duration_ratio <= high:
            found.append(
                f"the significant duration (5-95 %) is {self.duration_ratio:.2f} times that of the scaled original, "
                f"outside {low:.2f} to {high:.2f}"
            )
        if self.husid_difference > GREATEST_HUSID_DIFFERENCE:
            found.append(
                f"energy arrives at other times: the Husid curves differ by {self.husid_difference:.2f}, "
                f"more than {GREATEST_HUSID_DIFFERENCE:g}"
            )
        if self.correlation < LEAST_CORRELATION:
            found.append(
                f"the correlation with the scaled original is {self.correlation:.2f}, less than {LEAST_CORRELATION:g}"
            )
        return tuple(found)


def compare(before: Record, after: Record) -> Shape:
    """Return how far a motion changed.

    Args:
        before: the scaled original, not zero throughout.
        after: the matched motion on the same time axis, not zero throughout.
    """
    first, second = before.acceleration, after.acceleration
    old, new = measures(before), measures(after)
    apart = husid(first, before.time_step) - husid(second, after.time_step)
    return Shape(
        arias_ratio=new.arias / old.arias,
        duration_ratio=new.duration_5_95 / old.duration_5_95,
        husid_difference=float(np.max(np.abs(apart))),
        correlation=float(first @ second / (np.linalg.norm(first) * np.linalg.norm(second))),
    )
