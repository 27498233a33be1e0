"""What a residual analysis is given of a test."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError

FEWEST = 16  # samples


@dataclass(frozen=True)
class Residual:
    """Measured and predicted force of one test, with the motion they belong to.

    Attributes:
        name: of the test.
        order: its place among the tests of the specimen, from 0.
        use: `fit` or `validate`.
        time: (n,) s, ascending.
        displacement: (n,) m.
        velocity: (n,) m/s, without noise (`noise.smooth`).
        measured, predicted: (n,) N.
        temperature_C: (n,) degC, or one number.
    """

    name: str
    order: int
    use: str
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    measured: np.ndarray
    predicted: np.ndarray
    temperature_C: np.ndarray | float

    def __post_init__(self) -> None:
        size = np.asarray(self.time).size
        for name in ("time", "displacement", "velocity", "measured", "predicted"):
            values = np.asarray(getattr(self, name), dtype=float)
            if values.shape != (size,):
                raise InputError(f"test {self.name}: {values.size} samples of {name}, {size} of time")
            if not np.isfinite(values).all():
                at = int(np.argmin(np.isfinite(values)))
                raise InputError(f"test {self.name}: {name}: sample {at + 1} is {values[at]:g}, not a finite number")
            object.__setattr__(self, name, values)
        if size < FEWEST:
            raise InputError(f"test {self.name}: a residual needs at least {FEWEST} samples, not {size}")
        temperature = np.broadcast_to(np.asarray(self.temperature_C, dtype=float), (size,))
        object.__setattr__(self, "temperature_C", temperature)

    @property
    def residual(self) -> np.ndarray:
        """Measured less predicted force (n,), N."""
        return np.asarray(self.measured - self.predicted)

    @property
    def temperature(self) -> np.ndarray:
        """Temperature at each sample (n,), degC."""
        return np.asarray(self.temperature_C)

    @property
    def rms_force(self) -> float:
        """Root of the mean square of the measured force, N; never zero."""
        return max(float(np.sqrt(np.mean(self.measured**2))), np.finfo(float).tiny)

    @property
    def nrms(self) -> float:
        """Sum of the squared residual over that of the measured force; no root is taken."""
        return float(np.mean(self.residual**2)) / self.rms_force**2
