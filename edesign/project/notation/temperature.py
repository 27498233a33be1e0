"""Temperatures with their unit: `20 degC`, `293.15 K`; inside degC."""

from __future__ import annotations

import math
import re
from typing import Annotated, Any

from edesign.project.notation.written import NUMBER, Written, text
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen

_TEMPERATURE = re.compile(r"\s*([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(degC|°C|K)\s*")
_ABSOLUTE_ZERO_C = -273.15
IRON_MELTS_C = 1538.0
"""No steel, and no elastomer, stands a higher temperature."""


def parse_temperature(value: Any) -> float:
    """Read a temperature with its unit.

    Returns:
        degC.

    Raises:
        PydanticCustomError: no number, no unit, another unit, below absolute zero, or above what iron stands.
    """
    match = _TEMPERATURE.fullmatch(value) if isinstance(value, str) else None
    if not match:
        raise refuse(f"{as_seen(value)} is no temperature; write number and unit, `20 degC` or `293.15 K` [E-VALUE-01]")
    number = float(match[1])
    result = number + _ABSOLUTE_ZERO_C if match[2] == "K" else number
    if not (math.isfinite(result) and result >= _ABSOLUTE_ZERO_C):
        raise refuse(f"`{value}` is below absolute zero [E-VALUE-02]")
    if result > IRON_MELTS_C:
        raise refuse(f"`{value}` is beyond {IRON_MELTS_C:g} degC, at which iron melts [E-VALUE-02]")
    return round(result, 9)  # 293.15 K is 20 degC


TEMPERATURE_TEXT = text("temperature", rf"{NUMBER}\s*(?:degC|°C|K)", "20 degC", "293.15 K")
Temperature = Annotated[float, Written(parse_temperature, TEMPERATURE_TEXT)]
"""degC."""
