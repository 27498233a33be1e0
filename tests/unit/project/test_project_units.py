"""Units at the edge, against the definitions of the units."""

from __future__ import annotations

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic_core import PydanticCustomError

from edesign.project.notation import units
from edesign.project.notation.units import Kind, parse_quantity, parse_ratio

# reference: definitions of the SI; 1 lbf = 0.45359237 kg x 9.80665 m/s2 and 1 in = 25.4 mm exactly
REFERENCE = [
    ("3.5 m", units.LENGTH, 3.5),
    ("3500 mm", units.LENGTH, 3.5),
    ("1 in", units.LENGTH, 0.0254),
    ("275 MPa", units.STRESS, 275e6),
    ("275 N/mm2", units.STRESS, 275e6),
    ("275 N/mm²", units.STRESS, 275e6),
    ("27.5 kN/cm^2", units.STRESS, 275e6),
    ("210 GPa", units.STRESS, 210e9),
    ("23 kN/m", units.LINE_LOAD, 23e3),
    ("9.6 N/mm", units.LINE_LOAD, 9600.0),
    ("1 lbf", units.FORCE, 0.45359237 * 9.80665),
    ("50 psf", units.AREA_LOAD, 50 * 0.45359237 * 9.80665 / 0.3048**2),
    ("1 ksf", units.AREA_LOAD, 1000 * 0.45359237 * 9.80665 / 0.3048**2),
    ("1.5 klf", units.LINE_LOAD, 1500 * 0.45359237 * 9.80665 / 0.3048),
    ("80 plf", units.LINE_LOAD, 80 * 0.45359237 * 9.80665 / 0.3048),
    ("110 pcf", units.DENSITY, 110 * 0.45359237 / 0.3048**3),
    ("29.5 t", units.MASS, 29500.0),
    ("29.5 kN*s^2/m", units.MASS, 29500.0),
    ("20 g", units.MASS, 0.020),
    ("0.414 g", units.ACCELERATION, 0.414 * 9.80665),
    ("3.2 m/s2", units.ACCELERATION, 3.2),
    ("320 cm/s^2", units.ACCELERATION, 3.2),
    ("10 ms", units.TIME, 0.010),
    ("33740 cm4", units.INERTIA, 3.374e-4),
    ("100 cm²", units.AREA, 0.01),
    ("1e-3 m^4", units.INERTIA, 1e-3),
    (" 2.5e3  mm ", units.LENGTH, 2.5),
]


@pytest.mark.parametrize(("text", "kind", "value"), REFERENCE)
def test_quantities_become_si(text: str, kind: Kind, value: float) -> None:
    assert parse_quantity(text, kind) == pytest.approx(value, rel=1e-14)  # a few roundings of a product


@pytest.mark.parametrize(
    ("value", "kind", "said"),
    [
        (3.5, units.LENGTH, "bare number `3.5` needs a unit; a length is written like `3.5 m`"),
        ("3.5", units.LENGTH, "bare number"),
        (True, units.LENGTH, "with its unit is needed"),
        (None, units.LENGTH, "with its unit is needed"),
        (("3 m",), units.LENGTH, "with its unit is needed"),
        ("200 kN", units.LENGTH, "is a force, but a length is needed"),
        ("9.81 m/s^2", units.LENGTH, "is an acceleration, but a length"),
        ("3 kg", units.ACCELERATION, "is a mass, but an acceleration"),
        ("3 g", units.FORCE, "is a mass, but a force"),
        ("2 %", units.LENGTH, "is a ratio, but a length"),
        ("3 m m m", units.LENGTH, "is a volume"),
        ("3 kNN", units.FORCE, "unknown unit `kNN`; did you mean `kN`?"),
        ("3,5 m", units.LENGTH, "a point, not a comma"),
        ("g", units.ACCELERATION, "number and unit"),
        ("nan m", units.LENGTH, "is no length"),
        ("1e999 m", units.LENGTH, "not finite"),
        ("3 __import__('os')", units.LENGTH, "unknown unit"),
    ],
)
def test_what_is_refused(value: object, kind: Kind, said: str) -> None:
    with pytest.raises(PydanticCustomError) as caught:
        parse_quantity(value, kind)
    assert said in caught.value.message()


@pytest.mark.parametrize(
    ("value", "expected"), [("2 %", 0.02), ("2%", 0.02), (0.02, 0.02), (1, 1.0), ("100 %", 1.0), ("1e-5", 1e-5)]
)
def test_ratios(value: object, expected: float) -> None:
    assert parse_ratio(value, 0.0, 1.0, low_allowed=False) == pytest.approx(expected, rel=1e-15)


@pytest.mark.parametrize("value", [0, "0 %", 1.01, "101 %", -0.1, "2 m", True, None, "much"])
def test_ratios_outside_zero_to_one(value: object) -> None:
    with pytest.raises(PydanticCustomError):
        parse_ratio(value, 0.0, 1.0, low_allowed=False)


@given(st.floats(allow_nan=False, allow_infinity=False, width=64))
def test_every_float_keeps_its_value_or_is_refused(value: float) -> None:
    if value == 0.0 or 1e-10 <= abs(value) <= 4.1e7:
        assert parse_quantity(f"{value!r} m", units.LENGTH) == value
        return
    with pytest.raises(PydanticCustomError, match="is beyond what a length can be, 1e-10 to 4.1e\\+07 m, or zero"):
        parse_quantity(f"{value!r} m", units.LENGTH)


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ("40075 km", units.LENGTH),  # the equator
        ("20015 km", units.LENGTH),  # the farthest earthquake
        ("22590 kg/m^3", units.DENSITY),  # osmium
        ("1.2 TPa", units.STRESS),  # diamond
        ("10000000 years", units.TIME),  # the return periods of hazard curves
        ("1 um", units.LENGTH),  # noise of a transducer
        ("1 us", units.TIME),
        ("1 km^2", units.AREA),
        ("1000000 kN/mm", units.STIFFNESS),
        ("1 mN", units.FORCE),
        ("1 degree", units.ROTATION),
    ],
)
def test_what_is_somewhere_in_the_world_is_no_slip(value: str, kind: Kind) -> None:
    assert parse_quantity(value, kind) > 0.0


@pytest.mark.parametrize("kind", units._KINDS, ids=lambda kind: kind.name)
def test_no_quantity_is_without_bounds(kind: Kind) -> None:
    unit = "" if kind is units.NUMBER else kind.unit
    for number in ("1e300", "1e-300", "-1e300"):
        if unit:
            with pytest.raises(PydanticCustomError, match=f"`{number} .*` is beyond what an? {kind.name} can be"):
                parse_quantity(f"{number} {unit}", kind)


@pytest.mark.parametrize("value", ["1e300", 1e13, "1e-13", "1e300 %"])
def test_no_ratio_is_without_bounds(value: object) -> None:
    with pytest.raises(PydanticCustomError, match="is beyond what a ratio can be, 1e-12 to 1e\\+12"):
        parse_ratio(value, 0.0, float("inf"), low_allowed=False)


@pytest.mark.parametrize(("value", "seen"), [(None, "nothing"), (True, "`true`"), ((1,), "a list"), ({}, "a mapping")])
def test_what_is_no_value_is_shown(value: object, seen: str) -> None:
    with pytest.raises(PydanticCustomError, match=f"a length with its unit is needed, .*, not {seen}"):
        parse_quantity(value, units.LENGTH)
    with pytest.raises(PydanticCustomError, match=f"a ratio is needed, .*, not {seen}"):
        parse_ratio(value, 0.0, 1.0)


def test_pint_is_not_loaded_for_the_units_of_most_projects() -> None:
    read = "units.parse_quantity('3.5 m', units.LENGTH); units.parse_quantity('275 N/mm2', units.STRESS)"
    code = f"import sys; from edesign.project.notation import units; {read}; sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_factors_at_hand_are_those_of_pint() -> None:
    """To the last bit, so that a value does not depend on which of both reads it."""
    registry = units._registry()
    for base, factors in units._FACTORS.items():
        for unit, factor in factors.items():
            if (base, unit) == ("m/s^2", "g"):
                continue  # the gram
            found = registry.Quantity(1.0, registry.parse_units(unit)).to_base_units()
            assert float(found.magnitude) == factor, unit
            assert found.dimensionality == units._dimension(base), unit
