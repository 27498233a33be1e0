"""Rehabilitation objectives: a performance level at a hazard level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from edesign.codes.fema356.drift import PERFORMANCE_LEVELS

Rank = Literal["basic", "enhanced", "reduced"]

PROBABILITIES = (0.50, 0.20, 0.10, 0.02)
"""Probabilities of exceedance in 50 years of the hazard levels; those of 10 and 2 % are BSE-1 and BSE-2."""


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


def _rank(letter: str) -> Rank:
    if letter in "hl":
        return "basic"
    return "enhanced" if letter in "adgjk" else "reduced"


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
