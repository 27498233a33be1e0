"""The response measures that criteria may limit: what each is, and of what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from edesign.project.notation.quantities import ACCELERATION, FORCE, LENGTH, ROTATION, Kind
from edesign.project.notation.units import parse_quantity, parse_ratio
from edesign.project.notation.written import Json, quantity, ratio

RATIO = Kind("ratio", "1", "1.3 %")
MULTIPLE = Kind("multiple", "", "12")
"""A ratio of which one is little, and which is not printed in per cent."""


@dataclass(frozen=True)
class Measure:
    """A response measure that a criterion may limit.

    Attributes:
        kind: what its values are.
        place: what it is the largest of, and what a criterion may choose among; None: it is one of the whole frame.
    """

    kind: Kind
    place: Literal["storey", "column", "beam", "brace", "damper"] | None = None


MEASURES: dict[str, Measure] = {
    "roof_displacement_m": Measure(LENGTH),
    "residual_roof_displacement_m": Measure(LENGTH),
    "final_roof_displacement_m": Measure(LENGTH),
    "roof_drift": Measure(RATIO),
    "interstorey_drift": Measure(RATIO, "storey"),
    "residual_interstorey_drift": Measure(RATIO, "storey"),
    "final_interstorey_drift": Measure(RATIO, "storey"),
    "base_shear_N": Measure(FORCE),
    "column_base_shear_N": Measure(FORCE),
    "roof_acceleration_m_s2": Measure(ACCELERATION),
    "relative_roof_acceleration_m_s2": Measure(ACCELERATION),
    "beam_plastic_rotation_rad": Measure(ROTATION, "beam"),
    "column_plastic_rotation_rad": Measure(ROTATION, "column"),
    "column_axial_force_N": Measure(FORCE, "column"),
    "brace_ductility": Measure(RATIO, "brace"),
    "brace_damage": Measure(RATIO, "brace"),
    "damper_strain": Measure(RATIO, "damper"),
    "damper_deformation_m": Measure(LENGTH, "damper"),
    "damper_force_N": Measure(FORCE, "damper"),
}
"""By name; the unit ends the name, ratios have none."""

_ENDINGS = {"m": "_m", "N": "_N", "m/s^2": "_m_s2", "rad": "_rad", "1": ""}


def short_name(measure: str) -> str:
    """Return the name of a measure without the unit at its end: base_shear_N -> base_shear."""
    return measure.removesuffix(_ENDINGS[MEASURES[measure].kind.unit])


SHORT_NAMES = {short_name(measure): measure for measure in MEASURES}
"""Measures by their names without units."""


def parse_limit(kind: Kind, value: Any) -> float:
    """Read a limit of a measure or of an archived quantity with its unit.

    Args:
        kind: of a measure, or of an archived quantity.
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
