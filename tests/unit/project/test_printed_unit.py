"""Units of printed values, against their definitions."""

from __future__ import annotations

import math

import pytest
from pydantic_core import PydanticCustomError

from edesign.project.notation.printed_unit import told_apart, unit_factor


@pytest.mark.parametrize(
    ("unit", "si", "factor"),
    [
        ("cm", "m", 0.01),
        ("kN", "N", 1e3),
        ("kN/m", "N/m", 1e3),
        ("%", "1", 0.01),
        ("1", "1", 1.0),
        ("g", "m/s^2", 9.80665),
        ("mrad", "rad", 1e-3),
        ("deg", "rad", math.pi / 180.0),
        ("Hz", "Hz", 1.0),
        ("kJ", "J", 1e3),
        ("mm^2", "m^2", 1e-6),
        ("mm2", "m^2", 1e-6),
        ("t", "kg", 1e3),  # a quantity without a name here
    ],
)
def test_one_unit_in_si(unit: str, si: str, factor: float) -> None:
    assert unit_factor(unit, si) == pytest.approx(factor, rel=1e-14)


@pytest.mark.parametrize(("unit", "si"), [("kg", "N"), ("%", "m"), ("cm", "1"), ("3 m", "m"), ("kNn", "N"), ("", "m")])
def test_another_dimension_is_refused(unit: str, si: str) -> None:
    with pytest.raises(PydanticCustomError):
        unit_factor(unit, si)


@pytest.mark.parametrize(
    ("value", "limit", "told"),
    [
        (0.3, 0.2, ("0.3", "0.2")),
        (0.20004, 0.2, ("0.20004", "0.2")),
        (0.2, 0.2, ("0.2", "0.2")),
        (0.2000000001, 0.2, ("0.2", "0.2")),
    ],
)
def test_a_value_and_its_limit_do_not_look_equal(value: float, limit: float, told: tuple[str, str]) -> None:
    assert told_apart(value, limit, lambda of, digits: f"{of:.{digits}g}") == told
