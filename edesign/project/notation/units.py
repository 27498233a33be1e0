"""Values with units at the edge: `3.5 m` becomes 3.5, `275 MPa` becomes 275e6. Inside everything is a float in SI.

A value that no quantity of its kind can have, such as `1e300 m`, is refused here, whatever key it stands at.
"""

from __future__ import annotations

import math
import re
from functools import cache, lru_cache
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic_core import PydanticCustomError

from edesign.project.notation.quantities import (
    ACCELERATION,
    ANGLE,
    AREA,
    AREA_LOAD,
    DENSITY,
    FORCE,
    FREQUENCY,
    INERTIA,
    KINDS,
    LENGTH,
    LINE_LOAD,
    MASS,
    MOMENT,
    ROTATION,
    ROTATIONAL_STIFFNESS,
    STIFFNESS,
    STRESS,
    TIME,
    VELOCITY,
    Kind,
)
from edesign.project.notation.si_numbers import SiCount, SiNumber
from edesign.project.notation.written import NUMBER, Written, quantity, ratio, words_or
from edesign.project.reading.base import refuse
from edesign.project.reading.problems import as_seen, did_you_mean, nearest
from edesign.project.reading.words import a

if TYPE_CHECKING:
    import pint

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity, m/s2 (exact by definition)."""

Sign = Literal["any", "positive", "not negative"]

_VALUE = re.compile(rf"\s*({NUMBER})\s*(.*?)\s*")
_UNIT = re.compile(r"[A-Za-zµμ°%0-9 ·⋅*/^()²³⁴.+-]{1,40}")
_POWERS = str.maketrans({"²": "^2", "³": "^3", "⁴": "^4", "·": "*", "⋅": "*"})
_COMMON = (
    "m mm cm km m^2 mm^2 cm^2 m^4 cm^4 mm^4 N kN MN N/m kN/m N/mm MN/m kN/m^2 kN/cm^2 N/mm^2 Pa kPa MPa GPa kg t "
    "kg/m^3 s ms min g m/s^2 cm/s^2 rad mrad deg kN*m N*m Hz"
).split()


LARGEST_FACTOR = 1e12
"""Of ratios without a limit of their own, and the inverse of the least of those above zero. Beyond it one of the two
numbers that a ratio is of has no digits left in a sum with the other: double precision has sixteen, of which the
tolerance of equilibrium, 1e-7, takes the last seven of the larger."""


def parse_quantity(value: Any, kind: Kind, sign: Sign = "any") -> float:
    """Read a value with its unit.

    Args:
        value: text such as `3.5 m`.
        kind: the quantity that is needed.
        sign: whether zero or negative values are refused.

    Returns:
        The value in the SI unit of `kind`.

    Raises:
        PydanticCustomError: no number, no unit, unknown unit, another dimension, a refused sign, or out of bounds.
    """
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise refuse(
            f"{a(kind.name)} with its unit is needed, for example `{kind.example}`, not {as_seen(value)} [E-VALUE-01]"
        )
    match = _VALUE.fullmatch(str(value))
    if not match:
        if str(value)[:1] in _DASHES:
            raise refuse(
                f"`{value}` begins with a dash that is no minus; write `-`, as in `-{kind.example}` [E-VALUE-01]"
            )
        raise refuse(f"`{value}` is no {kind.name}; write number and unit, for example `{kind.example}` [E-VALUE-01]")
    number, unit = match[1], match[2]
    if not unit and isinstance(value, SiNumber | SiCount):
        value.kind, unit = kind, kind.unit
    if not unit:
        raise refuse(
            f"the bare number `{value}` needs a unit; {a(kind.name)} is written like `{kind.written(number)}`"
            " [E-UNIT-01]"
        )
    try:
        factor = _known_factor(unit, kind)
    except PydanticCustomError:
        factor = _factor(str(value), unit, kind)  # whose message shows the value
    result = float(number) * factor
    if not math.isfinite(result):
        raise refuse(f"`{value}` is not finite [E-VALUE-02]")
    if sign == "positive" and result <= 0.0:
        raise refuse(f"`{value}` must be greater than zero [E-VALUE-02]")
    if sign == "not negative" and result < 0.0:
        raise refuse(f"`{value}` must not be negative [E-VALUE-02]")
    if result != 0.0 and not kind.least <= abs(result) <= kind.most:
        zero = "" if sign == "positive" else ", or zero"
        span = f"{kind.least:g} to {kind.most:g} {kind.unit}{zero}"
        raise refuse(
            f"`{value}` is beyond what {a(kind.name)} can be, {span}; look at its power and its unit [E-UNIT-03]"
        )
    return result


def parse_ratio(value: Any, low: float, high: float, low_allowed: bool = True, high_allowed: bool = True) -> float:
    """Read a ratio: a plain number or a percentage such as `2 %`; the value must lie between `low` and `high`.

    Args:
        low: lower bound.
        high: upper bound.
        low_allowed: whether the lower bound itself is allowed.
        high_allowed: whether the upper bound itself is allowed.

    Raises:
        PydanticCustomError: the value is no ratio, or out of bounds.
    """
    match = None
    if isinstance(value, (str, int, float)) and not isinstance(value, bool):
        match = _VALUE.fullmatch(str(value))
    if not match:
        raise refuse(
            f"a ratio is needed, a plain number or a percentage such as `0.02` or `2 %`, not {as_seen(value)}"
            " [E-VALUE-01]"
        )
    number, unit = match[1], match[2]
    if unit not in ("", "%"):
        raise refuse(
            f"`{value}` has the unit `{unit}`, but a ratio is a plain number or a percentage such as `2 %` [E-UNIT-02]"
        )
    result = float(number) / 100.0 if unit else float(number)
    inside_low = result >= low if low_allowed else result > low
    inside_high = result <= high if high_allowed else result < high
    if not (math.isfinite(result) and inside_low and inside_high):
        lower = f"at least {low:g}" if low_allowed else f"greater than {low:g}"
        upper = "" if high == math.inf else f" and at most {high:g}" if high_allowed else f" and less than {high:g}"
        percent = result / 100.0  # 5 where 5 % is meant
        meant = not unit and 1.0 <= result <= 100.0 and low < percent < high
        hint = f"; {number} per cent is written `{number} %`" if meant else ""
        raise refuse(f"`{value}` is out of range: a ratio {lower}{upper} is allowed{hint} [E-VALUE-02]")
    if result > LARGEST_FACTOR or 0.0 < abs(result) < 1.0 / LARGEST_FACTOR:
        span = f"{1.0 / LARGEST_FACTOR:g} to {LARGEST_FACTOR:g}" + (", or zero" if low_allowed and low <= 0.0 else "")
        raise refuse(f"`{value}` is beyond what a ratio can be, {span} [E-UNIT-03]")
    return result


def parse_signed_ratio(value: Any) -> float:
    """Read a ratio of either sign; zero is refused.

    Raises:
        PydanticCustomError: the value is no ratio, zero, or out of bounds.
    """
    result = parse_ratio(value, -LARGEST_FACTOR, LARGEST_FACTOR)
    if result == 0.0:
        raise refuse(f"`{value}` is out of range: a ratio above or below 0 is allowed [E-VALUE-02]")
    return result


def restraint(kind: Kind, what: str, *words: str) -> Written:
    """Return the reader of a restraint: one of some words, or a stiffness greater than zero.

    Args:
        what: is allowed, for the message: "a direction is `fixed`, `free`, or has a stiffness".
        words: that are taken as they are.
    """

    def read(value: Any) -> Any:
        if isinstance(value, str) and value in words:
            return value
        meant = nearest(value, words) if isinstance(value, str) else ""
        if meant:
            raise refuse(f"`{value}` is unknown; did you mean `{meant}`? ({what}) [E-UNIT-02]")
        try:
            return parse_quantity(value, kind, "positive")
        except ValueError as error:
            raise refuse(f"{what}: {error}") from None

    return Written(read, words_or(quantity(kind, "positive"), *words))


def angle_or(what: str, *words: str) -> Written:
    """Return the reader of an angle, or of one of some words.

    Args:
        what: is allowed, for the message.
        words: that are taken as they are.
    """

    def read(value: Any) -> Any:
        if isinstance(value, str) and value in words:
            return value
        meant = nearest(value, words) if isinstance(value, str) else ""
        if meant or (isinstance(value, str) and value.isalpha()):
            hint = f"; did you mean `{meant}`?" if meant else ""
            raise refuse(f"`{value}` is unknown{hint} ({what}) [E-VALUE-03]")
        return parse_quantity(value, ANGLE, "any")

    return Written(read, words_or(quantity(ANGLE), *words))


_STRESSES = {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "N/m^2": 1.0, "kN/m^2": 1e3, "kN/cm^2": 1e7, "N/mm^2": 1e6}
_MOMENTS = {"N*m": 1.0, "kN*m": 1e3, "MN*m": 1e6}
_FACTORS: dict[str, dict[str, float]] = {
    "m": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "m^2": {"m^2": 1.0, "mm^2": 1e-6, "cm^2": 1e-4},
    "m^4": {"m^4": 1.0, "cm^4": 1e-8},
    "N": {"N": 1.0, "kN": 1e3, "MN": 1e6},
    "N/m": {"N/m": 1.0, "kN/m": 1e3, "N/mm": 1e3, "MN/m": 1e6},
    "Pa": _STRESSES,
    "N/m^2": _STRESSES,
    "kg": {"kg": 1.0, "t": 1e3},
    "kg/m^3": {"kg/m^3": 1.0, "t/m^3": 1e3},
    "s": {"s": 1.0, "ms": 1e-3, "min": 60.0},
    "m/s": {"m/s": 1.0, "mm/s": 1e-3},
    "m/s^2": {"g": STANDARD_GRAVITY, "m/s^2": 1.0, "cm/s^2": 1e-2},
    "1/s": {"Hz": 1.0},
    "rad": {"rad": 1.0, "mrad": 1e-3, "deg": math.radians(1.0)},
    "dimensionless": {"": 1.0},
    "N*m": _MOMENTS,
    "N*m/rad": {f"{unit}/rad": factor for unit, factor in _MOMENTS.items()},
}
"""Factors of what engineers write most, by the SI unit of the quantity: pint, which knows all others, loads slowly.

In an acceleration g stands for gravity; everywhere else it is the gram.
"""

_OF_LABORATORIES: dict[str, dict[str, float]] = {
    "m": {"um": 1e-6},
    "N/m": {"kN/mm": 1e6},
    "N*s/m": {"N*s/m": 1.0, "kN*s/m": 1e3, "kN*s/mm": 1e6},
    "1/s": {"1/s": 1.0},
    "s^2": {"s^2": 1.0},
}
"""The same of what laboratories write, and of which no building is built."""
_OF_AMERICA = (
    "psf = pound_force / foot ** 2",
    "ksf = kip / foot ** 2",
    "plf = pound_force / foot",
    "klf = kip / foot",
    "pcf = pound / foot ** 3",
)
"""Short forms of loads and of a density that pint does not know."""
_DASHES = tuple("\u2010\u2011\u2012\u2013\u2014\u2212")
"""What word processors write for a minus."""
_POWER_DASHPOT = re.compile(r"(N|kN|MN)\*\(s/(m|mm)\)\^([0-9.]+)")
"""Of F = c v^p, whose unit has the power of its parameter."""


def units_of(kind: Kind) -> dict[str, float]:
    """Return the usual units of a quantity with their factors to SI."""
    return _FACTORS.get(kind.unit, {})


@cache
def _registry() -> pint.UnitRegistry[float]:
    import pint  # a third of a second: only where a unit is a rare one

    registry: pint.UnitRegistry[float] = pint.UnitRegistry()
    for definition in _OF_AMERICA:
        registry.define(definition)
    return registry


@cache
def _dimension(unit: str) -> Any:
    return _registry().parse_units(unit).dimensionality


@lru_cache(maxsize=1000)  # a project has few units, and thousands of values
def _known_factor(unit: str, kind: Kind) -> float:
    return _factor(unit, unit, kind)


def _factor(value: str, unit: str, kind: Kind) -> float:
    """Factor from `unit` to SI after checking that it measures `kind`."""
    for factors in (_FACTORS, _OF_LABORATORIES):
        if (known := factors.get(kind.unit, {}).get(_with_powers(unit))) is not None:
            return known
    written, wanted = _POWER_DASHPOT.fullmatch(unit), _POWER_DASHPOT.fullmatch(kind.unit)
    if written and wanted and written[3] == wanted[3]:
        return _FACTORS["N"][written[1]] * _FACTORS["m"][written[2]] ** -float(written[3])
    if unit == "%":
        raise refuse(f"`{value}` is a ratio, but {a(kind.name)} is needed, for example `{kind.example}` [E-UNIT-02]")
    parsed = _parse_unit(value, unit, kind)
    if parsed.dimensionality != _dimension(kind.unit):
        raise refuse(
            f"`{value}` is {a(_name(parsed.dimensionality))}, but {a(kind.name)} is needed, "
            f"for example `{kind.example}` [E-UNIT-02]"
        )
    return float(_registry().Quantity(1.0, parsed).to_base_units().magnitude)


def _parse_unit(value: str, unit: str, kind: Kind) -> Any:
    text = _with_powers(unit)
    if _UNIT.fullmatch(unit):
        registry = _registry()
        try:
            return registry.parse_units(text)
        except Exception:  # noqa: BLE001  pint raises many kinds, all of which mean the same here
            pass
    if unit.startswith(","):
        raise refuse(
            f"`{value}`: decimals stand behind a point, not a comma, for example `{kind.example}` [E-VALUE-01]"
        )
    hint = did_you_mean(text, _COMMON)
    raise refuse(
        f"`{value}`: unknown unit `{unit}`{hint} ({a(kind.name)} is written like `{kind.example}`) [E-UNIT-02]"
    )


def _with_powers(unit: str) -> str:
    """`mm2` and `m/s2` are how engineers write powers; pint wants a sign between."""
    return re.sub(r"([A-Za-z])([0-9])", r"\1^\2", unit.translate(_POWERS))


def _name(dimensionality: Any) -> str:
    for kind in KINDS:
        if _dimension(kind.unit) == dimensionality:
            return kind.name
    return f"quantity of dimension {_dimensions(dimensionality)}"


def _dimensions(dimensionality: Any) -> str:
    parts = []
    for name, power in sorted(dimensionality.items()):
        parts.append(name.strip("[]") + (f"^{power:g}" if power != 1 else ""))
    return " * ".join(parts) if parts else "1"


def written(kind: Kind, sign: Sign = "any") -> Written:
    """Return the reader of a quantity.

    Args:
        kind: the physical quantity.
        sign: `any`, `positive` or `not negative`.
    """
    return Written(lambda value: parse_quantity(value, kind, sign), quantity(kind, sign))


def written_ratio(low: float, high: float, low_allowed: bool = True, high_allowed: bool = True) -> Written:
    """Return the reader of a ratio between two bounds.

    Args:
        low: lower bound.
        high: upper bound.
        low_allowed: whether the lower bound itself is allowed.
        high_allowed: whether the upper bound itself is allowed.
    """
    bounds = (low, high, low_allowed, high_allowed)
    return Written(lambda value: parse_ratio(value, *bounds), ratio(*bounds))


Length = Annotated[float, written(LENGTH)]
PositiveLength = Annotated[float, written(LENGTH, "positive")]
NotNegativeLength = Annotated[float, written(LENGTH, "not negative")]
PositiveArea = Annotated[float, written(AREA, "positive")]
PositiveInertia = Annotated[float, written(INERTIA, "positive")]
Force = Annotated[float, written(FORCE)]
NotNegativeForce = Annotated[float, written(FORCE, "not negative")]
PositiveForce = Annotated[float, written(FORCE, "positive")]
PositiveMoment = Annotated[float, written(MOMENT, "positive")]
Rotation = Annotated[float, written(ROTATION, "not negative")]
PositiveRotation = Annotated[float, written(ROTATION, "positive")]
Angle = Annotated[float, written(ANGLE)]
LineLoad = Annotated[float, written(LINE_LOAD)]
AreaLoad = Annotated[float, written(AREA_LOAD)]
PositiveStiffness = Annotated[float, written(STIFFNESS, "positive")]
PositiveRotationalStiffness = Annotated[float, written(ROTATIONAL_STIFFNESS, "positive")]
PositiveStress = Annotated[float, written(STRESS, "positive")]
Mass = Annotated[float, written(MASS, "not negative")]
PositiveMass = Annotated[float, written(MASS, "positive")]
PositiveDensity = Annotated[float, written(DENSITY, "positive")]
PositiveTime = Annotated[float, written(TIME, "positive")]
Duration = Annotated[float, written(TIME, "not negative")]
PositiveFrequency = Annotated[float, written(FREQUENCY, "positive")]
PositiveVelocity = Annotated[float, written(VELOCITY, "positive")]
PositiveAcceleration = Annotated[float, written(ACCELERATION, "positive")]
PositiveRatio = Annotated[float, written_ratio(0.0, 1.0, low_allowed=False)]
"""Greater than 0, at most 1."""
BucklingLengthFactor = Annotated[float, written_ratio(0.1, 1.0)]
"""At least 0.1, at most 1. Fixed ends make 0.5, and each half between holds half of what it was. At a tenth even a bar
of a non-dimensional slenderness of 2 over its length has 0.2, at which EN 1993-1-1, 6.3.1.2(4), lets buckling be
ignored: a brace with less does not buckle, and needs no model of it."""
PushedDrift = Annotated[float, written_ratio(1e-6, 1.0)]
"""At least 1e-6, at most 1. Steel frames yield at a drift near 0.5 %, so at 1e-6 the base shear is 2e-4 of the
strength; of forces that are in equilibrium to 1e-7 of the largest that leaves three digits."""
LeastBrace = Annotated[float, written_ratio(0.001, math.inf)]
"""At least 0.001. A damper behind such a brace adds 0.025 % of damping at most, (sqrt(1 + r) - 1) / 2. That is 1/30 of
the least that EN 1991-1-4, Table F.2, has for a steel building, 0.8 % (delta_s = 0.05): it is none."""
Hardening = Annotated[float, written_ratio(0.0, 1.0, high_allowed=False)]
"""At least 0, less than 1."""
UnitRatio = Annotated[float, written_ratio(0.0, 1.0)]
"""At least 0, at most 1."""
PoissonRatio = Annotated[float, written_ratio(0.0, 0.5)]
"""At least 0, at most 0.5, that of saturated clay which keeps its volume."""
PositiveFactor = Annotated[float, written_ratio(0.0, math.inf, low_allowed=False)]
"""Greater than 0."""
Factor = Annotated[float, written_ratio(0.0, math.inf)]
"""At least 0."""
SignedFactor = Annotated[float, Written(parse_signed_ratio, ratio(-math.inf, math.inf))]
"""Above or below 0."""
