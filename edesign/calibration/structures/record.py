"""Records of one test of a structure: base acceleration in, floors' motion out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.damper.testing.measured_histories import Use

Measure = Literal["acceleration", "displacement"]
UNITS: dict[Measure, str] = {"acceleration": "m/s^2", "displacement": "m"}


@dataclass(frozen=True)
class Channel:
    """What an instrument measures.

    Attributes:
        measure: absolute acceleration, or displacement relative to the base.
        floor: from 0.
    """

    measure: Measure
    floor: int

    @property
    def label(self) -> str:
        """For people."""
        return f"{self.measure} of floor {self.floor + 1}"


@dataclass(frozen=True, eq=False)
class StructureTest:
    """Histories of a test at equal time steps.

    Attributes:
        name: unique in its campaign.
        step: s.
        base: acceleration (t,) m/s2.
        channels: measured.
        values: (t, channels), SI.
        title: for people.
        use: whether models are fitted to the test, or only compared with it.
        source: the file it comes from.
    """

    name: str
    step: float
    base: np.ndarray
    channels: tuple[Channel, ...]
    values: np.ndarray
    title: str = ""
    use: Use = "fit"
    source: str = ""

    @property
    def time(self) -> np.ndarray:
        """Times (t,) from 0, s."""
        return self.step * np.arange(self.base.size)

    def column(self, measure: Measure, floor: int) -> np.ndarray | None:
        """Return one channel (t,); None: it was not measured.

        Args:
            floor: from 0.
        """
        wanted = Channel(measure, floor)
        return self.values[:, self.channels.index(wanted)] if wanted in self.channels else None
