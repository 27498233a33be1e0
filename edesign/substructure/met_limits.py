"""Limits of the rig and of its sensors that a virtual test met: which, when first, and for how long."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.core.substructure import SATURATED, SENSOR, LoopRecord


@dataclass(frozen=True)
class MetLimit:
    """A limit that a test met.

    Attributes:
        name: of SATURATED.
        first, last: end of the first and of the last main step in which it was met, s.
        duration: of all main steps in which it was met, s.
    """

    name: str
    first: float
    last: float
    duration: float

    @property
    def times(self) -> str:
        """Times in words, after a space; empty where they are not known, as of archives of older versions."""
        if math.isnan(self.first):
            return ""
        return f" (first at {self.first:.4g} s, last at {self.last:.4g} s, for {self.duration:.3g} s in all)"


def met_limits(record: LoopRecord, time: np.ndarray) -> tuple[MetLimit, ...]:
    """Return the limits that a run met.

    Args:
        time: (n,) s at main steps, evenly spaced, at least as long as the record.
    """
    found = []
    for bit, name in SATURATED.items():
        met = np.flatnonzero(record.saturated & bit)
        if met.size:
            first, last = (float(time[met[i]]) for i in (0, -1))
            found.append(MetLimit(name, first, last, float(met.size * (time[1] - time[0]))))
    return tuple(found)


def in_words(limits: Sequence[MetLimit]) -> str:
    """Return limits with their times: "the velocity limit of the rig (first at 1 s, last at 2 s, for 0.3 s in all)".

    Args:
        limits: that were met.
    """
    return " and ".join(f"the {_name(one)}{one.times}" for one in limits)


def _name(limit: MetLimit) -> str:
    return limit.name if limit.name == SENSOR else f"{limit.name} limit of the rig"
