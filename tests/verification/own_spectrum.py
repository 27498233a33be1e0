"""The spectrum of a record as a target: what matching must leave alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.ground_motion.record import Record
from edesign.ground_motion.response_spectrum import psa


@dataclass(frozen=True)
class Own:
    """The spectrum of a record as a target, times a slow wave in log period if `ripple` is its height."""

    record: Record
    ripple: float = 0.0
    damping: float = 0.05
    label: str = "its own spectrum"
    last_period: float = np.inf

    @property
    def zero_period(self) -> float:
        return self.record.pga

    def acceleration(self, period: Any) -> np.ndarray:
        wave = 1.0 + self.ripple * np.sin(3.0 * np.log(np.asarray(period)))
        return psa(self.record.acceleration, self.record.time_step, period) * wave

    def displacement(self, period: Any) -> np.ndarray:
        return self.acceleration(period) * (np.asarray(period) / (2.0 * np.pi)) ** 2
