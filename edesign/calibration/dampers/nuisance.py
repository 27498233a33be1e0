"""Nuisances of single tests, whose amplitudes are integrated out: what makes them, and how they are told."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


class Told(NamedTuple):
    """A number of a test that its amplitudes make.

    Attributes:
        name: what it is.
        unit: SI, of it.
        weights: (k,) of the amplitudes in it; of a wave (2, k), of its sine and its cosine.
        frequency: of a wave, Hz; 0.0: it is none.
    """

    name: str
    unit: str
    weights: np.ndarray
    frequency: float = 0.0


@dataclass(frozen=True, eq=False)
class Nuisance:
    """Columns of one nuisance in one test.

    Attributes:
        of: label of the effect, or name of what is not known of the test.
        columns: (n, k) N; an amplitude has the prior N(0, 1).
        told: what is told of it.
        predicted: whether a prediction of the test has it, as estimated from the test; else it is an error of that.
    """

    of: str
    columns: np.ndarray
    told: tuple[Told, ...]
    predicted: bool


def joined(every: list[Nuisance], chosen: bool | None = None) -> np.ndarray | None:
    """Return all columns (n, k) N of a test side by side; None: there are none.

    Args:
        chosen: of those alone that predictions have, or have not; None: of all.
    """
    some = [one.columns for one in every if chosen in (None, one.predicted)]
    return np.hstack(some) if some else None
