"""What the responses of a study are judged by: limits of measures, plastic hinges, performance levels, objectives."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, Discriminator, Field, Tag, ValidationInfo, field_validator

from edesign.project.base import Model, refuse
from edesign.project.measures import MEASURE_KINDS, ROTATION, SHORT_NAMES, parse_measure_value
from edesign.project.problems import unknown_name
from edesign.project.selections import ALL_NUMBERS, Numbers
from edesign.project.units import parse_quantity

StatisticName = Literal["mean", "maximum", "median", "84%"]
PerformanceLevel = Literal["IO", "LS", "CP"]
MemberKinds = Literal["columns", "beams", "all"]
Objective = Literal["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"]
CriterionName = Annotated[str, Field(min_length=1, max_length=120)]


def _some_names(value: Any) -> Any:
    """One name, a list of names, or `all` (an empty tuple)."""
    if value == "all":
        return ()
    if isinstance(value, str):
        return (value,)
    if not isinstance(value, (list, tuple)) or not all(isinstance(item, str) for item in value):
        raise refuse("a name, a list of names, or `all` is needed")
    if not value:
        raise refuse("the list is empty; write `all`, or at least one name")
    return tuple(value)


def _measure(value: Any) -> Any:
    if isinstance(value, str) and value in MEASURE_KINDS:
        return value
    if isinstance(value, str) and value in SHORT_NAMES:
        return SHORT_NAMES[value]
    raise refuse(unknown_name("measure", str(value), SHORT_NAMES))


def _rotation(value: Any) -> float:
    return parse_quantity(value, ROTATION, "not negative")


def _statistic(value: Any) -> Any:
    return "84%" if value == "84 %" else value


Names = Annotated[tuple[str, ...], BeforeValidator(_some_names)]


class _Criterion(Model):
    """What all criteria share: a name, the histories they look at, and the statistic over the records.

    `variants` and `levels` are names, or all if empty; each variant at each level is judged on its own.
    """

    name: CriterionName
    variants: Names = ()
    levels: Names = ()
    statistic: Annotated[StatisticName, BeforeValidator(_statistic)] = "mean"
    storeys: Numbers = ALL_NUMBERS


class MeasureCriterion(_Criterion):
    """Limits of a response measure, in SI.

    `most` decides. `least` beside it is the lower end of a target range: what is below is better than required.
    `least` alone is a requirement.
    """

    measure: Annotated[str, BeforeValidator(_measure)]
    most: float | None = None
    least: float | None = None
    members: Names = ()

    @field_validator("most", "least", mode="before")
    @classmethod
    def _value(cls, value: Any, info: ValidationInfo) -> Any:
        measure = info.data.get("measure")
        return None if measure is None else parse_measure_value(measure, value)


class HingeCriterion(_Criterion):
    """No plastic hinges: the plastic rotation of the ends of members is at most `rotation` (rad)."""

    plastic_hinges: Literal["none"]
    of: MemberKinds = "all"
    members: Names = ()
    rotation: Annotated[float, BeforeValidator(_rotation)] = 0.001


class PerformanceCriterion(_Criterion):
    """A structural performance level of FEMA 356, by drifts, by plastic rotations of members, or by both."""

    performance: PerformanceLevel
    by: Literal["drift", "members", "both"] = "both"
    of: MemberKinds = "all"


def _which(value: Any) -> str:
    given = value if isinstance(value, Mapping) else type(value).model_fields if isinstance(value, BaseModel) else ()
    return next((f"?{key}" for key in ("performance", "plastic_hinges") if key in given), "?measure")


Criterion = Annotated[
    Annotated[MeasureCriterion, Tag("?measure")]
    | Annotated[HingeCriterion, Tag("?plastic_hinges")]
    | Annotated[PerformanceCriterion, Tag("?performance")],
    Discriminator(_which),
]
Criteria = tuple[Criterion, ...]
Objectives = tuple[Objective, ...]
