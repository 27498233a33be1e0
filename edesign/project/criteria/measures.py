"""Names and units of the response measures that criteria may limit."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from edesign.project.notation.quantities import ACCELERATION, FORCE, LENGTH, ROTATION, Kind
from edesign.project.notation.units import parse_quantity, parse_ratio
from edesign.project.notation.written import Json, quantity, ratio

RATIO = Kind("ratio", "1", "1.3 %")
MULTIPLE = Kind("multiple", "", "12")
"""A ratio of which one is little, and which is not printed in per cent."""

MEASURE_KINDS = {
    "roof_displacement_m": LENGTH,
    "residual_roof_displacement_m": LENGTH,
    "final_roof_displacement_m": LENGTH,
    "roof_drift": RATIO,
    "interstorey_drift": RATIO,
    "residual_interstorey_drift": RATIO,
    "final_interstorey_drift": RATIO,
    "base_shear_N": FORCE,
    "column_base_shear_N": FORCE,
    "roof_acceleration_m_s2": ACCELERATION,
    "relative_roof_acceleration_m_s2": ACCELERATION,
    "beam_plastic_rotation_rad": ROTATION,
    "column_plastic_rotation_rad": ROTATION,
    "column_axial_force_N": FORCE,
    "brace_ductility": RATIO,
    "brace_damage": RATIO,
    "damper_strain": RATIO,
    "damper_deformation_m": LENGTH,
    "damper_force_N": FORCE,
}
"""The quantity that each response measure is of; the unit ends the name, ratios have none."""

_ENDINGS = {"m": "_m", "N": "_N", "m/s^2": "_m_s2", "rad": "_rad", "1": ""}


def short_name(measure: str) -> str:
    """Return the name of a measure without the unit at its end: base_shear_N -> base_shear."""
    return measure.removesuffix(_ENDINGS[MEASURE_KINDS[measure].unit])


SHORT_NAMES = {short_name(measure): measure for measure in MEASURE_KINDS}
"""Measures by their names without units."""


def parse_limit(kind: Kind, value: Any) -> float:
    """Read a limit of a measure or of an archived quantity with its unit.

    Args:
        kind: of `MEASURE_KINDS`, or of an archived quantity.
        value: text such as `1.3 %`, `35 mm`, `0.002 rad`.

    Returns:
        The value in SI.

    Raises:
        PydanticCustomError: no number, another unit, or a negative value; what is limited has no sign.
    """
    if kind in (RATIO, MULTIPLE):
        return parse_ratio(value, 0.0, float("inf"))
    return parse_quantity(value, kind, "not negative")


def limit_schema(kind: Kind) -> Json:
    """Return the JSON schema of what `parse_limit` reads."""
    make = ratio(0.0, float("inf")) if kind in (RATIO, MULTIPLE) else quantity(kind, "not negative")
    return make(dict)


def add_limits(schema: Json, key: str, kinds: Mapping[str, Kind]) -> None:
    """Say in a schema which limits, `most` and `least`, belong to which value of a key.

    Args:
        schema: of a criterion; is changed.
        key: of the criterion: "measure".
        kinds: the quantity that limits are of by value of the key.
    """
    schema["allOf"] = []
    for kind in dict.fromkeys(kinds.values()):
        names = sorted(name for name, of in kinds.items() if of == kind)
        limits = {side: limit_schema(kind) for side in ("most", "least")}
        chosen = {"properties": {key: {"enum": names}}, "required": [key]}
        schema["allOf"].append({"if": chosen, "then": {"properties": limits}})
