"""Quantities of substructure tests: frequencies in Hz, delays, rates, powers of time, and short lists of them."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Annotated, Any

from pydantic_core import PydanticCustomError

from edesign.project.notation.quantities import FORCE, FREQUENCY, LENGTH, TIME, Kind
from edesign.project.notation.units import Sign, parse_quantity, written
from edesign.project.notation.written import NUMBER, Written, either, given, items, one_or_list_of, quantity, text
from edesign.project.reading.base import refuse

MOST_DELAY = 1.0
"""Longest delay that is taken for one, s; actuators are late by 5 to 30 ms."""

TIME_SQUARED = Kind("time squared", "s^2", "9.45e-5 s^2")
TIME_CUBED = Kind("time cubed", "s^3", "5e-7 s^3")
RATE = Kind("rate", "1/s", "2 /s")
TIME_RATE = Kind("time per time", "dimensionless", "0.05 s/s")
TIME_SQUARED_RATE = Kind("squared time per time", "s^2/s", "0.001 s^2/s")
DASHPOT = Kind("damping coefficient", "N*s/m", "100 kN*s/m")
VELOCITY_PER_FORCE = Kind("velocity per force", "m/s/N", "1e-3 m/s/N")

_PER = re.compile(r"(?<=[0-9. ])/(?=\s*[A-Za-z])")
_STEPS = re.compile(r"\s*([0-9]{1,6})(?:\s*steps?)?\s*")
Parser = Callable[[Any], float]


def parse_frequency(value: Any, sign: Sign = "positive") -> float:
    """Read a frequency such as `2 Hz`.

    Args:
        sign: `any`, `positive` or `not negative`.

    Raises:
        PydanticCustomError: it is none, or a circular frequency, which is 2 pi times as large.
    """
    if "rad" in str(value) or "rpm" in str(value):
        raise refuse(f"`{value}` is an angular velocity; write the frequency in Hz, for example `2 Hz` [E-UNIT-02]")
    return parse_quantity(value, FREQUENCY, sign)


def parse_delay(value: Any) -> float:
    """Read a delay in s.

    Raises:
        PydanticCustomError: it is none, negative, or longer than any actuator is late.
    """
    found = parse_quantity(value, TIME, "not negative")
    if found > MOST_DELAY:
        raise refuse(
            f"`{value}` is no delay of an actuator, which is some milliseconds; at most 1 s is possible [E-VALUE-02]"
        )
    return found


def parse_rate(value: Any, sign: Sign = "positive") -> float:
    """Read a rate of change such as `2 /s`.

    Args:
        sign: `any`, `positive` or `not negative`.

    Raises:
        PydanticCustomError: it is none, or a frequency, which could be meant with or without 2 pi.
    """
    if "Hz" in str(value) or "rad" in str(value):
        raise refuse(f"`{value}` is a frequency, and a rate is needed, for example `{RATE.example}` [E-VALUE-01]")
    if not isinstance(value, str):
        return parse_quantity(value, RATE, sign)
    try:
        return parse_quantity(_PER.sub("1/", value), RATE, sign)
    except PydanticCustomError as error:
        raise refuse(error.message().replace("1/", "/")) from None


def parse_number(value: Any) -> float:
    """Read a plain number.

    Raises:
        PydanticCustomError: the value is no number.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise refuse(f"`{value}` is no plain number [E-VALUE-01]")
    return float(value)


def parse_steps(value: Any) -> int:
    """Read a whole number of main steps: `1`, `1 step`, `2 steps`.

    Raises:
        PydanticCustomError: the value is no whole number of steps.
    """
    match = _STEPS.fullmatch(str(value)) if isinstance(value, (str, int)) and not isinstance(value, bool) else None
    if not match:
        raise refuse(f"`{value}` is no whole number of main steps, for example `1 step` [E-VALUE-01]")
    return int(match[1])


def each(readers: tuple[Written, ...], example: str, fewest: int | None = None) -> Written:
    """Return the reader of a list whose items have readers of their own.

    Args:
        example: of such a list, for messages.
        fewest: items that are needed; None: as many as there are readers.
    """
    least = len(readers) if fewest is None else fewest
    count = str(least) if least == len(readers) else f"{least} to {len(readers)}"

    def read(value: Any) -> tuple[float, ...]:
        if not isinstance(value, (tuple, list)) or not least <= len(value) <= len(readers):
            raise refuse(f"a list of {count} values is needed, for example `{example}` [E-VALUE-01]")
        return tuple(_item(one.read, value, i) for i, one in enumerate(readers[: len(value)]))

    return Written(read, items(*(one.schema for one in readers), fewest=least))


def several(reader: Written) -> Written:
    """Return the reader of one value, or of a list of one and more."""

    def read(value: Any) -> tuple[float, ...]:
        if not isinstance(value, (tuple, list)):
            return (reader.read(value),)
        if not value:
            raise refuse("the list is empty [E-VALUE-01]")
        return tuple(_item(reader.read, value, i) for i in range(len(value)))

    return Written(read, one_or_list_of(reader.schema))


def _item(parse: Parser, values: Any, i: int) -> float:
    try:
        return parse(values[i])
    except PydanticCustomError as error:
        raise refuse(error.message(), i) from None


_DELAY = Written(parse_delay, quantity(TIME, "not negative"))
_HERTZ = Written(parse_frequency, quantity(FREQUENCY, "positive"))
_FROM_ZERO = Written(lambda value: parse_frequency(value, "not negative"), quantity(FREQUENCY, "not negative"))
_RATE_TEXT = text("change in a second", rf"{NUMBER}\s*(?:1 ?)?/ ?(?:ms|s|min)", RATE.example)
_NUMBER = Written(parse_number, given({"type": "number"}))
_STEPS_TEXT = text("number of main steps", r"[0-9]{1,6}\s*(?:steps?)?", "1 step")

Delay = Annotated[float, _DELAY]
Hertz = Annotated[float, _HERTZ]
Rate = Annotated[float, Written(parse_rate, _RATE_TEXT)]
NoNegativeRate = Annotated[float, Written(lambda value: parse_rate(value, "not negative"), _RATE_TEXT)]
TimeRate = Annotated[float, written(TIME_RATE, "positive")]
TimeSquaredRate = Annotated[float, written(TIME_SQUARED_RATE, "positive")]
PositiveVelocityPerForce = Annotated[float, written(VELOCITY_PER_FORCE, "positive")]
NoNegativeLength = Annotated[float, written(LENGTH, "not negative")]
NoNegativeForce = Annotated[float, written(FORCE, "not negative")]
NoNegativeDashpot = Annotated[float, written(DASHPOT, "not negative")]
Steps = Annotated[int, Written(parse_steps, either(given({"type": "integer", "minimum": 0}), _STEPS_TEXT))]

Hertzes = Annotated[tuple[float, ...], several(_HERTZ)]
Band = Annotated[tuple[float, float], each((_FROM_ZERO, _HERTZ), "[0.1 Hz, 5 Hz]")]
SweepBand = Annotated[tuple[float, float], each((_HERTZ,) * 2, "[0.5 Hz, 10 Hz]")]
NumberRange = Annotated[tuple[float, float], each((_NUMBER,) * 2, "[0.7, 1.3]")]
TimeRange = Annotated[tuple[float, float], each((written(TIME, "not negative"),) * 2, "[0 ms, 40 ms]")]
TimeSquaredRange = Annotated[
    tuple[float, float], each((written(TIME_SQUARED, "not negative"),) * 2, "[0 s^2, 8e-4 s^2]")
]
Alpha = Annotated[
    tuple[float, float, float],
    each((_NUMBER, written(TIME), written(TIME_SQUARED)), "[1.0, 10 ms, 6e-5 s^2]"),
]
"""a0 (-), a1 (s), a2 (s2): command = a0 x + a1 x' + a2 x''."""
AlphaList = Annotated[
    tuple[float, ...],
    each(
        (_NUMBER, written(TIME), written(TIME_SQUARED), written(TIME_CUBED)),
        "[1.0, 10 ms, 6e-5 s^2, 2e-7 s^3]",
        fewest=2,
    ),
]
"""The first two of them at least, and perhaps a3 (s3) of the jerk."""
