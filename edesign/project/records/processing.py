"""What is done to a recording before it is used, step by step."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import Duration, PositiveFrequency, PositiveRatio, PositiveTime, UnitRatio
from edesign.project.reading.base import Model

Order = Annotated[int, Field(ge=0, le=8)]


class Baseline(Model):
    """A polynomial fitted to velocity or acceleration is taken out."""

    order: Order = 1
    fit: Literal["velocity", "acceleration"] = "velocity"


class RemoveDrift(Model):
    """A polynomial of the displacement is taken out so that the ground ends at rest in its place."""

    order: Annotated[int, Field(ge=3, le=8)] = 6


class Filter(Model):
    """Acausal Butterworth filter between two frequencies (Hz), or beyond one."""

    low: PositiveFrequency | None = None
    high: PositiveFrequency | None = None
    order: Annotated[int, Field(ge=1, le=10)] = 4
    keep_pads: bool = True


class Trim(Model):
    """The part between two times, s."""

    start: Duration
    end: PositiveTime
    taper: Duration = 0.5


class Significant(Model):
    """The part between two shares of the Arias intensity, with lead and tail, s."""

    bounds: tuple[UnitRatio, PositiveRatio] = (0.001, 0.999)
    lead: Duration = 1.0
    tail: Duration = 1.0
    taper: Duration = 0.5


class Taper(Model):
    """Half cosines at both ends, s."""

    start: Duration = 0.0
    end: Duration = 0.0


class Pad(Model):
    """Zeros before and after, s."""

    before: Duration = 0.0
    after: Duration = 0.0


class Resample(Model):
    """Another time step (s), band-limited."""

    time_step: PositiveTime


class Step(Model):
    """One step: exactly one of the keys; `reverse` turns the motion to the other side."""

    baseline: Baseline | None = None
    remove_drift: RemoveDrift | None = None
    filter: Filter | None = None
    trim: Trim | None = None
    significant: Significant | None = None
    taper: Taper | None = None
    pad: Pad | None = None
    resample: Resample | None = None
    reverse: bool | None = None

    @property
    def given(self) -> tuple[str, ...]:
        """The keys that are given."""
        return tuple(name for name in type(self).model_fields if getattr(self, name) is not None)
