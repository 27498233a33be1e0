"""How tables of samples are read, which do not say it themselves."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from edesign.project.reading.base import Model

Layout = Literal["columns", "rows"]
AccelerationUnit = Literal["g", "m/s^2", "cm/s^2", "mm/s^2"]
Column = Annotated[int, Field(ge=1)] | Annotated[str, Field(min_length=1)]


class Columns(Model):
    """Columns of a CSV file, by header or by number from 1.

    Attributes:
        time: column of time; without the key `time_step` is needed.
        acceleration: column of acceleration.
    """

    time: Column | None = None
    acceleration: Column
