"""Units at the edge, against the definitions of the units."""

from __future__ import annotations

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st
from messages import says
from pydantic_core import PydanticCustomError

from edesign.project.notation import quantities, units
from edesign.project.notation.quantities import Kind
from edesign.project.notation.units import parse_quantity, parse_ratio

# reference: definitions of the SI; 1 lbf = 0.45359237 kg x 9.80665 m/s2 and 1 in = 25.4 mm exactly
REFERENCE = [
    ("3.5 m", quantities.LENGTH, 3.5),
    ("3500 mm", quantities.LENGTH, 3.5),
    ("1 in", quantities.LENGTH, 0.0254),
    ("275 MPa", quantities.STRESS, 275e6),
    ("275 N/mm2", quantities.STRESS, 275e6),
    ("275 N/mm²", quantities.STRESS, 275e6),
    ("27.5 kN/cm^2", quantities.STRESS, 275e6),
    ("210 GPa", quantities.STRESS, 210e9),
    ("23 kN/m", quantities.LINE_LOAD, 23e3),
    ("9.6 N/mm", quantities.LINE_LOAD, 9600.0),
    ("1 lbf", quantities.FORCE, 0.45359237 * 9.80665),
    ("50 psf", quantities.AREA_LOAD, 50 * 0.45359237 * 9.80665 / 0.3048**2),
    ("1 ksf", quantities.AREA_LOAD, 1000 * 0.45359237 * 9.80665 / 0.3048**2),
    ("1.5 klf", quantities.LINE_LOAD, 1500 * 0.45359237 * 9.80665 / 0.3048),
    ("80 plf", quantities.LINE_LOAD, 80 * 0.45359237 * 9.80665 / 0.3048),
    ("110 pcf", quantities.DENSITY, 110 * 0.45359237 / 0.3048**3),
    ("29.5 t", quantities.MASS, 29500.0),
    ("29.5 kN*s^2/m", quantities.MASS, 29500.0),
    ("20 g", quantities.MASS, 0.020),
    ("0.414 g", quantities.ACCELERATION, 0.414 * 9.80665),
    ("3.2 m/s2", quantities.ACCELERATION, 3.2),
    ("320 cm/s^2", quantities.ACCELERATION, 3.2),
    ("10 ms", quantities.TIME, 0.010),
    ("33740 cm4", quantities.INERTIA, 3.374e-4),
    ("100 cm²", quantities.AREA, 0.01),
    ("1e-3 m^4", quantities.INERTIA, 1e-3),
    (" 2.5e3  mm ", quantities.LENGTH, 2.5),
]


@pytest.mark.parametrize(("text", "kind", "value"), REFERENCE)
def test_quantities_become_si(text: str, kind: Kind, value: float) -> None:
    assert parse_quantity(text, kind) == pytest.approx(value, rel=1e-14)  # a few roundings of a product


@pytest.mark.parametrize(
    ("value", "kind", "said"),
    [
        (3.5, quantities.LENGTH, "`3.5 m` E-UNIT-01"),
        ("3.5", quantities.LENGTH, "E-UNIT-01"),
        (True, quantities.LENGTH, "E-VALUE-01"),
        (None, quantities.LENGTH, "E-VALUE-01"),
        (("3 m",), quantities.LENGTH, "E-VALUE-01"),
        ("200 kN", quantities.LENGTH, "force length E-UNIT-02"),
        ("9.81 m/s^2", quantities.LENGTH, "acceleration length E-UNIT-02"),
        ("3 kg", quantities.ACCELERATION, "mass acceleration E-UNIT-02"),
        ("3 g", quantities.FORCE, "mass force E-UNIT-02"),
        ("2 %", quantities.LENGTH, "ratio length E-UNIT-02"),
        ("3 m m m", quantities.LENGTH, "volume E-UNIT-02"),
        ("3 kNN", quantities.FORCE, "`kN` E-UNIT-02"),
        ("3,5 m", quantities.LENGTH, "comma E-VALUE-01"),
        ("g", quantities.ACCELERATION, "E-VALUE-01"),
        ("nan m", quantities.LENGTH, "E-VALUE-01"),
        ("1e999 m", quantities.LENGTH, "E-VALUE-02"),
        ("3 __import__('os')", quantities.LENGTH, "E-UNIT-02"),
    ],
)
def test_what_is_refused(value: object, kind: Kind, said: str) -> None:
    with pytest.raises(PydanticCustomError) as caught:
        parse_quantity(value, kind)
    assert says(caught.value.message(), said)


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
        assert parse_quantity(f"{value!r} m", quantities.LENGTH) == value
        return
    with pytest.raises(PydanticCustomError, match="1e-10 to 4.1e\\+07 m.*E-UNIT-03"):
        parse_quantity(f"{value!r} m", quantities.LENGTH)


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        ("40075 km", quantities.LENGTH),  # the equator
        ("20015 km", quantities.LENGTH),  # the farthest earthquake
        ("22590 kg/m^3", quantities.DENSITY),  # osmium
        ("1.2 TPa", quantities.STRESS),  # diamond
        ("10000000 years", quantities.TIME),  # the return periods of hazard curves
        ("1 um", quantities.LENGTH),  # noise of a transducer
        ("1 us", quantities.TIME),
        ("1 km^2", quantities.AREA),
        ("1000000 kN/mm", quantities.STIFFNESS),
        ("1 mN", quantities.FORCE),
        ("1 degree", quantities.ROTATION),
    ],
)
def test_what_is_somewhere_in_the_world_is_no_slip(value: str, kind: Kind) -> None:
    assert parse_quantity(value, kind) > 0.0


@pytest.mark.parametrize("kind", quantities.KINDS, ids=lambda kind: kind.name)
def test_no_quantity_is_without_bounds(kind: Kind) -> None:
    unit = "" if kind is quantities.NUMBER else kind.unit
    for number in ("1e300", "1e-300", "-1e300"):
        if unit:
            with pytest.raises(PydanticCustomError, match=f"`{number} .*{kind.name}.*E-UNIT-03"):
                parse_quantity(f"{number} {unit}", kind)


@pytest.mark.parametrize("value", ["1e300", 1e13, "1e-13", "1e300 %"])
def test_no_ratio_is_without_bounds(value: object) -> None:
    with pytest.raises(PydanticCustomError, match="1e-12 to 1e\\+12.*E-UNIT-03"):
        parse_ratio(value, 0.0, float("inf"), low_allowed=False)


@pytest.mark.parametrize(("value", "seen"), [(None, "nothing"), (True, "`true`"), ((1,), "a list"), ({}, "a mapping")])
def test_what_is_no_value_is_shown(value: object, seen: str) -> None:
    with pytest.raises(PydanticCustomError, match=f"length .* not {seen}.*E-VALUE-01"):
        parse_quantity(value, quantities.LENGTH)
    with pytest.raises(PydanticCustomError, match=f"ratio .* not {seen}.*E-VALUE-01"):
        parse_ratio(value, 0.0, 1.0)


def test_pint_is_not_loaded_for_the_units_of_most_projects() -> None:
    read = "units.parse_quantity('3.5 m', quantities.LENGTH); units.parse_quantity('275 N/mm2', quantities.STRESS)"
    code = (
        f"import sys; from edesign.project.notation import quantities, units; {read}; sys.exit('pint' in sys.modules)"
    )
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


@pytest.mark.parametrize(
    ("unit", "meant"), [("kNN", "kN"), ("KN", "kN"), ("kPaa", "kPa"), ("zz", ""), ("quibbles", "")]
)
def test_units_are_suggested_that_are_near(unit: str, meant: str) -> None:
    """Of `zz` one of two letters is that of Hz."""
    with pytest.raises(PydanticCustomError) as caught:
        parse_quantity(f"3 {unit}", quantities.FORCE)
    assert says(str(caught.value), f"`{unit}` E-UNIT-02") and (f"mean `{meant}`" in str(caught.value)) == bool(meant)
