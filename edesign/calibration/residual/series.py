"""Histories of tests, measured and predicted at the stages of a calibration, and errors over them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.start import Start
from edesign.errors import InputError

Stage = Literal["declared", "refit", "corrected"]
STAGES: tuple[Stage, ...] = ("declared", "refit", "corrected")
FEWEST = 16  # samples of a residual


@dataclass(frozen=True)
class Errors:
    """NRMS of a model: sum of squared errors over sum of squared measured values.

    Attributes:
        fit, validate: over all samples of the tests used so.
        tests: of each test.
        channels: of each series of a test with several channels, by its name.
    """

    fit: float
    validate: float
    tests: Mapping[str, float]
    channels: Mapping[str, float] = field(default_factory=dict)

    def of(self, series: Series) -> float:
        """Return the error of a series: that of its test if it is the only one."""
        return self.channels[series.name] if series.name in self.channels else self.tests[series.name]


@dataclass(frozen=True)
class Worst:
    """What is predicted worst for its noise, and worse than chance leaves.

    Attributes:
        name: of the test, or of its channel.
        error, floor: NRMS, and that of its noise.
    """

    name: str
    error: float
    floor: float

    @property
    def times(self) -> float:
        """Error over noise floor."""
        return self.error / self.floor


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
                raise InputError(f"test {self.name}: {values.size} samples of {name}, {size} of time [E-CALIB-03]")
            if not np.isfinite(values).all():
                at = int(np.argmin(np.isfinite(values)))
                raise InputError(
                    f"test {self.name}: {name}: sample {at + 1} is {values[at]:g}, not a finite number [E-CALIB-03]"
                )
            object.__setattr__(self, name, values)
        if size < FEWEST:
            raise InputError(f"test {self.name}: a residual needs at least {FEWEST} samples, not {size} [E-CALIB-03]")
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


@dataclass(frozen=True, eq=False)
class Series:
    """Histories of one test at full rate, or of one of its channels.

    Attributes:
        name: of the test, or of the test and the channel.
        title, use, order: of the test.
        time: (n,) s.
        displacement: (n,) m, freed from noise; of a channel that of its floor, relative to the base.
        velocity: (n,) m/s.
        measured: (n,) in `unit`.
        predicted: (n,) by stage: declared, refit, corrected.
        temperature: (n,) degC.
        noise: standard deviation of what no model can predict.
        quantity: what is measured and predicted.
        unit: SI, of that.
        test: name of the test of which this is a channel; "" if it is all of it.
        channel: of the test, for people.
        start: how the record of a damper test starts away from rest; None: at rest.
        clipped: (n,) whether what is measured stands at the end of the instrument's range; None: it does nowhere.
        spikes: (n,) whether it is a spike, over which it is interpolated; None: there is none.
        motion_spikes: (n,) the same of the displacement.
        ends: (n,) whether it is at an end of the record in motion, whose derivatives are not known; None: nowhere.
        assumed: whether `noise` is the least that an instrument is thought to have, as the record shows less.
    """

    name: str
    title: str
    use: Use
    order: int
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    measured: np.ndarray
    predicted: Mapping[Stage, np.ndarray]
    temperature: np.ndarray
    noise: float
    quantity: str = "force"
    unit: str = "N"
    test: str = ""
    channel: str = ""
    start: Start | None = None
    clipped: np.ndarray | None = None
    spikes: np.ndarray | None = None
    motion_spikes: np.ndarray | None = None
    ends: np.ndarray | None = None
    assumed: bool = False

    @property
    def judged(self) -> slice:
        """Samples from the first one that counts: those before depend on how the test started."""
        return slice(self.start.first(self.time) if self.start else 0, None)

    @property
    def counted(self) -> np.ndarray:
        """Samples (n,) that errors count: of those that are judged the ones that are not lost."""
        found = ~self._lost
        found[: self.judged.start] = False
        return found

    @property
    def _lost(self) -> np.ndarray:
        """Samples (n,) that are clipped, spikes, or at ends in motion."""
        found = np.zeros(self.time.size, dtype=bool)
        for lost in (self.clipped, self.spikes, self.motion_spikes, self.ends):
            found |= False if lost is None else lost
        return found

    @property
    def of_test(self) -> str:
        """Name of its test."""
        return self.test or self.name

    def residual(self, stage: Stage) -> Residual:
        """Return the residual at a stage, as its analysis takes it: nothing is left where the measured is lost."""
        predicted = self.predicted[stage]
        measured = np.where(self._lost, predicted, self.measured)
        histories = self.time, self.displacement, self.velocity, measured, predicted, self.temperature
        return Residual(self.name, self.order, self.use, *(values[self.judged] for values in histories))
