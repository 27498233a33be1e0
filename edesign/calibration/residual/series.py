"""Histories of tests, measured and predicted at the stages of a calibration, and errors over them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from edesign.calibration.residual.record import Residual
from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.start import Start

Stage = Literal["declared", "refit", "corrected"]
STAGES: tuple[Stage, ...] = ("declared", "refit", "corrected")


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

    @property
    def judged(self) -> slice:
        """Samples that count: those before depend on how the test started."""
        return slice(self.start.first(self.time) if self.start else 0, None)

    @property
    def of_test(self) -> str:
        """Name of its test."""
        return self.test or self.name

    def residual(self, stage: Stage) -> Residual:
        """Return the residual at a stage, as its analysis takes it: the samples that are judged."""
        histories = self.time, self.displacement, self.velocity, self.measured, self.predicted[stage], self.temperature
        return Residual(self.name, self.order, self.use, *(values[self.judged] for values in histories))
