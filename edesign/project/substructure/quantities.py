"""Quantities of substructure tests: frequencies in Hz, delays, rates, powers of time, and short lists of them."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Annotated, Any

from pydantic import BeforeValidator
from pydantic_core import PydanticCustomError

from edesign.project.notation.units import FORCE, FREQUENCY, LENGTH, TIME, Kind, Sign, parse_quantity
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

    Raises:
        PydanticCustomError: it is none, or a circular frequency, which is 2 pi times as large.
    """
    if "rad" in str(value) or "rpm" in str(value):
        raise refuse(f"`{value}` is an angular velocity; write the frequency in Hz, for example `2 Hz`")
    return parse_quantity(value, FREQUENCY, sign)


def parse_delay(value: Any) -> float:
    """Read a delay in s.

    Raises:
        PydanticCustomError: it is none, negative, or longer than any actuator is late.
    """
    found = parse_quantity(value, TIME, "not negative")
    if found > MOST_DELAY:
        raise refuse(f"`{value}` is no delay of an actuator, which is some milliseconds; at most 1 s is possible")
    return found


def parse_rate(value: Any, sign: Sign = "positive") -> float:
    """Read a change in a second such as `2 /s`.

    Raises:
        PydanticCustomError: it is none, or a frequency, which could be meant with or without 2 pi.
    """
    if "Hz" in str(value) or "rad" in str(value):
        raise refuse(f"`{value}` is a frequency, and a rate is needed, for example `{RATE.example}`")
    if not isinstance(value, str):
        return parse_quantity(value, RATE, sign)
    try:
        return parse_quantity(_PER.sub("1/", value), RATE, sign)
    except PydanticCustomError as error:
        raise refuse(error.message().replace("1/", "/")) from None


def parse_number(value: Any) -> float:
    """Read a plain number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise refuse(f"`{value}` is no plain number")
    return float(value)


def parse_steps(value: Any) -> int:
    """Read a whole number of main steps: `1`, `1 step`, `2 steps`."""
    match = _STEPS.fullmatch(str(value)) if isinstance(value, (str, int)) and not isinstance(value, bool) else None
    if not match:
        raise refuse(f"`{value}` is no whole number of main steps, for example `1 step`")
    return int(match[1])


def quantity(kind: Kind, sign: Sign = "any") -> Parser:
    """Return what reads a quantity of one kind."""
    return lambda value: parse_quantity(value, kind, sign)


def each(parsers: tuple[Parser, ...], example: str, fewest: int | None = None) -> BeforeValidator:
    """Return what reads a list whose items have parsers of their own.

    Args:
        parsers: of the items.
        example: of such a list, for messages.
        fewest: items that are needed; None: as many as there are parsers.
    """
    least = len(parsers) if fewest is None else fewest
    count = str(least) if least == len(parsers) else f"{least} to {len(parsers)}"

    def read(value: Any) -> tuple[float, ...]:
        if not isinstance(value, (tuple, list)) or not least <= len(value) <= len(parsers):
            raise refuse(f"a list of {count} values is needed, for example `{example}`")
        return tuple(_item(parse, value, i) for i, parse in enumerate(parsers[: len(value)]))

    return BeforeValidator(read)


def several(parse: Parser) -> BeforeValidator:
    """Return what reads one value, or a list of one and more."""

    def read(value: Any) -> tuple[float, ...]:
        if not isinstance(value, (tuple, list)):
            return (parse(value),)
        if not value:
            raise refuse("the list is empty")
        return tuple(_item(parse, value, i) for i in range(len(value)))

    return BeforeValidator(read)


def _item(parse: Parser, values: Any, i: int) -> float:
    try:
        return parse(values[i])
    except PydanticCustomError as error:
        raise refuse(error.message(), i) from None


Delay = Annotated[float, BeforeValidator(parse_delay)]
Hertz = Annotated[float, BeforeValidator(parse_frequency)]
Rate = Annotated[float, BeforeValidator(parse_rate)]
NoNegativeRate = Annotated[float, BeforeValidator(lambda value: parse_rate(value, "not negative"))]
TimeRate = Annotated[float, BeforeValidator(quantity(TIME_RATE, "positive"))]
TimeSquaredRate = Annotated[float, BeforeValidator(quantity(TIME_SQUARED_RATE, "positive"))]
PositiveVelocityPerForce = Annotated[float, BeforeValidator(quantity(VELOCITY_PER_FORCE, "positive"))]
NoNegativeLength = Annotated[float, BeforeValidator(quantity(LENGTH, "not negative"))]
NoNegativeForce = Annotated[float, BeforeValidator(quantity(FORCE, "not negative"))]
NoNegativeDashpot = Annotated[float, BeforeValidator(quantity(DASHPOT, "not negative"))]
Steps = Annotated[int, BeforeValidator(parse_steps)]

Hertzes = Annotated[tuple[float, ...], several(parse_frequency)]
Band = Annotated[
    tuple[float, float], each((lambda v: parse_frequency(v, "not negative"), parse_frequency), "[0.1 Hz, 5 Hz]")
]
SweepBand = Annotated[tuple[float, float], each((parse_frequency,) * 2, "[0.5 Hz, 10 Hz]")]
NumberRange = Annotated[tuple[float, float], each((parse_number,) * 2, "[0.7, 1.3]")]
TimeRange = Annotated[tuple[float, float], each((quantity(TIME, "not negative"),) * 2, "[0 ms, 40 ms]")]
TimeSquaredRange = Annotated[
    tuple[float, float], each((quantity(TIME_SQUARED, "not negative"),) * 2, "[0 s^2, 8e-4 s^2]")
]
Alpha = Annotated[
    tuple[float, float, float],
    each((parse_number, quantity(TIME), quantity(TIME_SQUARED)), "[1.0, 10 ms, 6e-5 s^2]"),
]
"""a0 (-), a1 (s), a2 (s2): command = a0 x + a1 x' + a2 x''."""
AlphaList = Annotated[
    tuple[float, ...],
    each(
        (parse_number, quantity(TIME), quantity(TIME_SQUARED), quantity(TIME_CUBED)),
        "[1.0, 10 ms, 6e-5 s^2, 2e-7 s^3]",
        fewest=2,
    ),
]
"""The first two of them at least, and perhaps a3 (s3) of the jerk."""
