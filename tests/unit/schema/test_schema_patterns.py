"""Texts with units in schemas: they are taken and refused as edesign takes and refuses them."""

from __future__ import annotations

import re
from typing import Annotated, Any

import pytest
from jsonschema import Draft202012Validator
from pydantic import TypeAdapter, ValidationError
from pydantic_core import PydanticCustomError

from edesign.project.notation import quantities, units
from edesign.project.notation.positions import Place
from edesign.project.notation.quantities import Kind
from edesign.project.notation.selections import Lines, Numbers, NumbersOrNone
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.unit_patterns import _PATTERNS
from edesign.project.notation.units import parse_quantity, written
from edesign.project.notation.written import quantity
from edesign.project.substructure.quantities import DASHPOT, TIME_CUBED, TIME_SQUARED, VELOCITY_PER_FORCE
from edesign.schema.build import _Generator

KINDS = (*quantities.KINDS, DASHPOT, TIME_SQUARED, TIME_CUBED, VELOCITY_PER_FORCE)
UNITS = """
    m mm cm km um in ft yd m^2 mm^2 cm^2 mm2 mm² mm**2 ft^2 m^3 in^3 m^4 cm^4 cm4 in^4 N kN MN kip lbf N/m kN/m N/mm
    kN/mm MN/m kip/in plf klf Pa kPa MPa GPa N/mm^2 N/mm² kN/m^2 kN/cm2 psi ksi psf ksf bar kg t g lb Mg s ms min h
    hours days year years m/s mm/s km/h ft/s m/s^2 m/s2 cm/s^2 kg/m lb/ft kg/m^3 t/m3 pcf Hz kHz 1/s N*m kN*m kN·m MN*m
    kip*ft J kJ rad mrad deg N*m/rad kN*m/rad MN*m/rad kN*s/m N*s/mm s^2 s^3 ms^2 m/s/N mol kelvin
""".split()


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.unit in _PATTERNS], ids=lambda kind: kind.name)
def test_units_are_taken_as_they_are_read(kind: Kind) -> None:
    pattern = re.compile(quantity(kind)(dict)["pattern"])
    taken = [unit for unit in UNITS if pattern.search(f"3 {unit}")]
    assert taken == [unit for unit in UNITS if _is_read(f"3 {unit}", kind)]
    assert len(taken) >= 1 and pattern.search(kind.example)


@pytest.mark.parametrize("number", "3 -3 +3 0 -0 0.0 .5 1e-3 0e5 1,5 e 1e --1 0.01".split())
@pytest.mark.parametrize("sign", ["any", "positive", "not negative"])
def test_numbers_are_taken_as_they_are_read(number: str, sign: Any) -> None:
    pattern = re.compile(quantity(quantities.LENGTH, sign)(dict)["pattern"])
    for text in (f"{number} m", f"{number}m", f" {number}  mm "):
        negative_zero = number.startswith("-") and _is_read(text, quantities.LENGTH, sign) and sign != "any"
        assert bool(pattern.search(text)) == _is_read(text, quantities.LENGTH, sign) or negative_zero, text


VALUES = [
    *("all", "none", "3", "1-4", "1 - 4", "A", "A-D", "AA", "a", "3-", "-3", "1,2", "", "top", "A3", "1/3", "0.25"),
    *("30 %", "2.4 m", "-2 m", "20 degC", "293.15 K", "20 °C", "20", "20 F", "all, 3", "5 kN", "2 %", "-2 %", "2 % %"),
    *(0.25, 3, -3, 1.5, True, [1, "3-5"], ["A", "C-D"], [], ["all"], {"a": 1}),
]


TYPES = {
    "numbers": Numbers,
    "numbers or none": NumbersOrNone,
    "lines": Lines,
    "place": Place,
    "temperature": Temperature,
    "factor": units.Factor,
    "unit ratio": units.UnitRatio,
    "positive ratio": units.PositiveRatio,
    "positive factor": units.PositiveFactor,
    "signed factor": units.SignedFactor,
    "force": Annotated[float, written(quantities.FORCE)],
}


@pytest.mark.parametrize("name", TYPES)
def test_other_texts_are_taken_as_they_are_read(name: str) -> None:
    adapter: TypeAdapter[Any] = TypeAdapter(TYPES[name])
    schema = Draft202012Validator(adapter.json_schema(schema_generator=_Generator))
    for value in VALUES:
        try:
            adapter.validate_python(tuple(value) if isinstance(value, list) else value)
            read = True
        except ValidationError:
            read = False
        if read:
            assert schema.is_valid(value), value
        elif schema.is_valid(value):  # only what no expression can decide
            assert value in ("30 %", "3", "20"), value


def _is_read(text: str, kind: Kind, sign: Any = "any") -> bool:
    try:
        parse_quantity(text, kind, sign)
    except PydanticCustomError:
        return False
    return True
