"""What is done to a recording before it is used, step by step."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.notation.units import Duration, PositiveFrequency, PositiveRatio, PositiveTime, UnitRatio
from edesign.project.reading.base import Model

Order = Annotated[int, Field(ge=0, le=8)]


class Baseline(Model):
    """A polynomial fitted to velocity or acceleration is taken out.

    Attributes:
        order: order of the polynomial.
        fit: what the polynomial is fitted to.
    """

    order: Order = 1
    fit: Literal["velocity", "acceleration"] = "velocity"


class RemoveDrift(Model):
    """A polynomial of the displacement is taken out so that the ground ends at rest in its place.

    Attributes:
        order: order of the polynomial of the displacement.
    """

    order: Annotated[int, Field(ge=3, le=8)] = 6


class Filter(Model):
    """Acausal Butterworth filter between two frequencies, or beyond one.

    Attributes:
        low: lower corner frequency; without the key nothing is cut below.
        high: upper corner frequency; without the key nothing is cut above.
        order: order of the filter.
        keep_pads: whether the zeros that the filter needs before and after the record are kept.
    """

    low: PositiveFrequency | None = None
    high: PositiveFrequency | None = None
    order: Annotated[int, Field(ge=1, le=10)] = 4
    keep_pads: bool = True


class Trim(Model):
    """The part between two times.

    Attributes:
        start: begin of the part.
        end: end of the part, within the record.
        taper: length of the half cosines at both ends.
    """

    start: Duration
    end: PositiveTime
    taper: Duration = 0.5


class Significant(Model):
    """The part between two shares of the Arias intensity.

    Attributes:
        bounds: the two shares of the Arias intensity.
        lead: time kept before the part.
        tail: time kept after the part.
        taper: length of the half cosines at both ends.
    """

    bounds: tuple[UnitRatio, PositiveRatio] = (0.001, 0.999)
    lead: Duration = 1.0
    tail: Duration = 1.0
    taper: Duration = 0.5


class Taper(Model):
    """Half cosines at both ends.

    Attributes:
        start: length of the half cosine at the start.
        end: length of the half cosine at the end.
    """

    start: Duration = 0.0
    end: Duration = 0.0


class Pad(Model):
    """Zeros before and after.

    Attributes:
        before: time of zeros before the record.
        after: time of zeros after the record.
    """

    before: Duration = 0.0
    after: Duration = 0.0


class Resample(Model):
    """Another time step, band-limited.

    Attributes:
        time_step: new time step.
    """

    time_step: PositiveTime


class Step(Model):
    """One step of the processing: exactly one of the keys.

    Attributes:
        baseline: take out a polynomial fitted to velocity or acceleration.
        remove_drift: take out a polynomial of the displacement, so that the ground ends at rest in its place.
        filter: acausal Butterworth filter.
        trim: keep the part between two times.
        significant: keep the part between two shares of the Arias intensity.
        taper: half cosines at the ends.
        pad: zeros before and after.
        resample: another time step.
        reverse: turn the motion to the other side.
    """

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
