"""Incremental dynamic analysis in a study file: each record scaled step by step until the frame collapses."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import Field

from edesign.project.actions.hazard_base import LevelName
from edesign.project.analysis.shaking import Shaking
from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.criteria.measures import MEASURES, SHORT_NAMES, limit_schema, parse_limit
from edesign.project.notation.several import Names, ShortName
from edesign.project.notation.units import Duration, PositiveAcceleration, PositiveFactor, PositiveRatio, PositiveTime
from edesign.project.notation.written import SHARED, Inner, Json, Written
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import unknown_name
from edesign.project.study.life_cycle import LifeCycle

COLLAPSE = "collapse"
"""The limit that every study has."""

Count = Annotated[int, Field(ge=2, le=1000)]


class Limit(Model):
    """A limit of a fragility: a response measure with a value, written `{interstorey_drift: 2.5 %}`.

    Attributes:
        measure: response measure.
        value: value of the limit, SI.
    """

    measure: str
    value: float


def _limit(value: Any) -> Any:
    if not isinstance(value, Mapping) or len(value) != 1:
        raise refuse(
            "one response measure with its value is needed, for example `{interstorey_drift: 2.5 %}` [E-VALUE-01]"
        )
    ((name, given),) = value.items()
    if name not in SHORT_NAMES:
        raise refuse(unknown_name("response measure", str(name), SHORT_NAMES))
    limit = parse_limit(MEASURES[SHORT_NAMES[name]].kind, given)
    if limit == 0.0:
        raise refuse(f"`{given}` must be greater than zero [E-VALUE-02]")
    return Limit(measure=SHORT_NAMES[name], value=limit)


def _limit_schema(_inner: Inner) -> Json:
    kinds = {name: limit_schema(MEASURES[SHORT_NAMES[name]].kind) for name in sorted(SHORT_NAMES)}
    alone = {"minProperties": 1, "maxProperties": 1}
    said = {"title": "Limit", SHARED: "response measure with its limit"}
    return {**said, "type": "object", "properties": kinds, "additionalProperties": False, **alone}


class _Range(Model):
    """Values at equal distances, both ends included.

    Attributes:
        count: how many values, both ends included.
    """

    count: Count

    def values(self, first: float, last: float) -> tuple[float, ...]:
        """The values from the first to the last."""
        steps = self.count - 1
        return tuple((first * (steps - i) + last * i) / steps for i in range(self.count))


class AccelerationRange(_Range):
    """Accelerations at equal distances, both ends included.

    Attributes:
        first: first acceleration.
        last: last acceleration.
    """

    first: Annotated[PositiveAcceleration, Field(alias="from")]
    last: Annotated[PositiveAcceleration, Field(alias="to")]


class FactorRange(_Range):
    """Factors at equal distances, both ends included.

    Attributes:
        first: first factor.
        last: last factor.
    """

    first: Annotated[PositiveFactor, Field(alias="from")]
    last: Annotated[PositiveFactor, Field(alias="to")]


Accelerations = Annotated[AccelerationRange | Annotated[tuple[PositiveAcceleration, ...], Field(min_length=2)], OneOf()]
Factors = Annotated[FactorRange | Annotated[tuple[PositiveFactor, ...], Field(min_length=2)], OneOf()]


class _Incremental(Shaking):
    """What all have: variants and records, the drift that counts as collapse, and what fragilities are wanted of.

    Attributes:
        name: name of the study, of letters, digits and `_ + -`.
        variants: variants of the study, or `all`.
        records: records of the project; of a suite all its recordings.
        levels: ascending intensities: a list, or `{from, to, count}`.
        level: hazard level that the median is compared with.
        collapse_drift: drift ratio of a storey that counts as collapse.
        limits: limits of which fragilities are wanted, by name: one response measure with its value each.
        free_vibration: time after the end of each record.
        wave_passage: the motion reaches the supports one after the other; without the key all at once.
        life_cycle: how often limits are passed over the life of the building, and what that costs.
    """

    name: ShortName
    variants: Names = ("all",)
    records: Names
    levels: Accelerations | Factors
    level: LevelName | None = None
    collapse_drift: PositiveRatio = 0.10
    limits: dict[ShortName, Annotated[Limit, Written(_limit, _limit_schema)]] = {}
    free_vibration: Duration = 0.0
    wave_passage: WavePassage | None = None
    life_cycle: LifeCycle | None = None

    @property
    def intensities(self) -> tuple[float, ...]:
        """The values of the intensity measure in ascending order, m/s2 or factors."""
        levels = self.levels
        return levels if isinstance(levels, tuple) else levels.values(levels.first, levels.last)


class SpectralAccelerationStudy(_Incremental):
    """Records scaled to a pseudo acceleration at 5 % damping.

    Attributes:
        intensity: the levels are pseudo accelerations.
        levels: ascending accelerations: a list, or `{from, to, count}`.
        period: period of the pseudo acceleration; without the key T1 of each variant.
    """

    intensity: Literal["spectral_acceleration"]
    levels: Accelerations
    period: PositiveTime | None = None


class PeakAccelerationStudy(_Incremental):
    """Records scaled to a peak ground acceleration.

    Attributes:
        intensity: the levels are peak ground accelerations.
        levels: ascending accelerations: a list, or `{from, to, count}`.
    """

    intensity: Literal["pga"]
    levels: Accelerations


class LevelFactorStudy(_Incremental):
    """Records that are fitted to the spectrum: those of the hazard's `level` times factors.

    Attributes:
        intensity: the levels are factors on a level of the hazard.
        levels: ascending factors: a list, or `{from, to, count}`.
        level: hazard level that the factors multiply.
    """

    intensity: Literal["level_factor"]
    levels: Factors
    level: LevelName


Incremental = Annotated[SpectralAccelerationStudy | PeakAccelerationStudy | LevelFactorStudy, OneOf("intensity")]
