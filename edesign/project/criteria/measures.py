"""The response measures that criteria may limit: what each is, and of what."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

from edesign.project.notation.quantities import ACCELERATION, FORCE, LENGTH, ROTATION, Kind
from edesign.project.notation.units import parse_quantity, parse_ratio
from edesign.project.notation.written import Json, quantity, ratio

RATIO = Kind("ratio", "1", "1.3 %")
MULTIPLE = Kind("multiple", "", "12")
"""A ratio of which one is little, and which is not printed in per cent."""


CENTRE = "centre"
"""What stands for the centre of mass of a floor where column lines are named."""


@dataclass(frozen=True)
class InSpace:
    """Where in a building something is looked for; without anything everywhere.

    Attributes:
        direction: "x", "y", or "resultant": of both at the same instant; None: the larger of x and y counts.
        at: names of column lines, or `CENTRE`.
        frames: names of plane frames.
        axis: local axis of members about which they bend, "y" or "z"; None: the larger of both counts.
    """

    direction: str | None = None
    at: tuple[str, ...] = ()
    frames: tuple[str, ...] = ()
    axis: str | None = None

    @property
    def lines(self) -> tuple[str, ...]:
        """The column lines of `at`."""
        return tuple(name for name in self.at if name != CENTRE)


SPACE_KEYS = tuple(field.name for field in fields(InSpace))
"""The keys of a criterion that say where in a building; plane frames have none of them."""
ELSEWHERE = {
    "floor_displacement": "point_displacement",
    "floor_acceleration": "point_acceleration",
    "storey_drift": "line_drift",
    "residual_storey_drift": "residual_line_drift",
}
"""Quantities of floors and storeys of a building, and what they are on column lines."""
RESULTANTS = (
    "floor_displacement",
    "floor_acceleration",
    "point_displacement",
    "point_acceleration",
    "diaphragm_displacement",
    "diaphragm_acceleration",
    "storey_shear",
    "base_shear",
    "base_displacement",
    "base_acceleration",
    "isolator_displacement",
)
"""Quantities of buildings that have resultants of both directions."""


@dataclass(frozen=True)
class Measure:
    """A response measure that a criterion may limit.

    Attributes:
        kind: what its values are.
        place: what it is the largest of, and what a criterion may choose among; None: it is one of the whole frame.
        in_space: keys of a criterion that say where in a building.
        resultant: the quantity whose resultant of both directions it may be; None: it has none.
    """

    kind: Kind
    place: Literal["storey", "column", "beam", "brace", "damper"] | None = None
    in_space: tuple[str, ...] = ()
    resultant: str | None = None


DIRECTED = ("direction",)
ON_LINES = ("direction", "at", "frames")
BENT = ("frames", "axis")
FRAMED = ("frames",)


MEASURES: dict[str, Measure] = {
    "roof_displacement_m": Measure(LENGTH, in_space=DIRECTED, resultant="floor_displacement"),
    "residual_roof_displacement_m": Measure(LENGTH, in_space=DIRECTED),
    "final_roof_displacement_m": Measure(LENGTH, in_space=DIRECTED),
    "roof_drift": Measure(RATIO, in_space=DIRECTED),
    "interstorey_drift": Measure(RATIO, "storey", ON_LINES),
    "residual_interstorey_drift": Measure(RATIO, "storey", ON_LINES),
    "final_interstorey_drift": Measure(RATIO, "storey", ON_LINES),
    "base_shear_N": Measure(FORCE, in_space=DIRECTED, resultant="base_shear"),
    "column_base_shear_N": Measure(FORCE, in_space=DIRECTED, resultant="storey_shear"),
    "roof_acceleration_m_s2": Measure(ACCELERATION, in_space=DIRECTED, resultant="floor_acceleration"),
    "relative_roof_acceleration_m_s2": Measure(ACCELERATION, in_space=DIRECTED),
    "beam_plastic_rotation_rad": Measure(ROTATION, "beam", BENT),
    "column_plastic_rotation_rad": Measure(ROTATION, "column", BENT),
    "column_axial_force_N": Measure(FORCE, "column", FRAMED),
    "brace_ductility": Measure(RATIO, "brace", FRAMED),
    "brace_damage": Measure(RATIO, "brace", FRAMED),
    "damper_strain": Measure(RATIO, "damper", FRAMED),
    "damper_deformation_m": Measure(LENGTH, "damper", FRAMED),
    "damper_force_N": Measure(FORCE, "damper", FRAMED),
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
