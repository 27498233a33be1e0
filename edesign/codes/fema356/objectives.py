"""Rehabilitation objectives: a performance level at a hazard level."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from edesign.codes.fema356.drift import PERFORMANCE_LEVELS

Rank = Literal["basic", "enhanced", "reduced"]

PROBABILITIES = (0.50, 0.20, 0.10, 0.02)
"""Probabilities of exceedance in 50 years of the hazard levels; those of 10 and 2 % are BSE-1 and BSE-2."""
YEARS = 50.0
ROUNDED_PERIODS = (75.0, 225.0, 500.0, 2500.0)
"""Return periods, in years, as which those of the levels are written: 72, 224, 475 and 2475 years."""


@dataclass(frozen=True)
class Objective:
    """A rehabilitation objective.

    Attributes:
        letter: a to l, row by row of Table 5.4.
        probability: of exceedance in 50 years.
        level: performance level, IO, LS or CP.
        rank: h and l together are the basic safety objective.
    """

    letter: str
    probability: float
    level: str
    rank: Rank


BASIC = "hl"
"""Letters of the objectives that together are the basic safety objective."""


def _rank(letter: str) -> Rank:
    if letter in BASIC:
        return "basic"
    return "enhanced" if letter in "adgjk" else "reduced"


def return_period(probability: float) -> float:
    """Return T_R = -50 / ln(1 - P), years.

    Args:
        probability: P of exceedance in 50 years, between 0 and 1.
    """
    return -YEARS / math.log1p(-probability)


TOLERANCE = max(rounded / return_period(p) - 1.0 for rounded, p in zip(ROUNDED_PERIODS, PROBABILITIES, strict=True))
"""By how much a return period may differ from that of a level, of which it is: what rounding makes, 5.4 % of 500 years.

Neighbouring levels differ by a factor of 2 and more, so that no period is of two of them.
"""


def is_of_level(probability: float, wanted: float) -> bool:
    """Say whether a probability of exceedance in 50 years is that of a hazard level, as precisely as these are written.

    Args:
        probability: of exceedance in 50 years.
        wanted: one of `PROBABILITIES`.
    """
    return abs(return_period(probability) / return_period(wanted) - 1.0) <= TOLERANCE * (1.0 + 1e-9)


OBJECTIVES = {
    letter: Objective(letter, probability, level, _rank(letter))
    for letter, (probability, level) in zip(
        "abcdefghijkl", ((p, level) for p in PROBABILITIES for level in PERFORMANCE_LEVELS), strict=True
    )
}
"""All objectives by letter.

Source: thesis Table 5.4; FEMA 356, Table C1-1 without its column of the Operational level, which shifts its letters
    (h and l are its k and p).
"""
