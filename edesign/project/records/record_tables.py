"""How tables of samples are read, which do not say it themselves."""

from __future__ import annotations

import re
from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.notation.written import NUMBER, Written, text
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.problems import did_you_mean, listed

Layout = Literal["columns", "rows"]
UNITS = ("g", "m/s^2", "cm/s^2", "mm/s^2")
"""Units of acceleration; `g/10` and `0.5 g` are also allowed."""
_UNIT = rf"(?:{NUMBER}\s*)?(?:{'|'.join(map(re.escape, UNITS))})(?:/[0-9]*[1-9][0-9]*)?"


def _acceleration_unit(value: Any) -> Any:
    if not isinstance(value, str) or not re.fullmatch(_UNIT, value):
        hint = did_you_mean(str(value), UNITS)
        raise refuse(f"`{value}` is unknown{hint} (allowed: {listed(UNITS)}, also with a number: `g/10`) [E-VALUE-03]")
    return value


AccelerationUnit = Annotated[str, Written(_acceleration_unit, text("unit of acceleration", _UNIT, "g"))]
Column = Annotated[int, Field(ge=1)] | Annotated[str, Field(min_length=1)]


class Columns(Model):
    """Columns of a CSV file, by header or by number from 1.

    Attributes:
        time: column of time; without the key `time_step` is needed.
        acceleration: column of acceleration.
    """

    time: Column | None = None
    acceleration: Column
