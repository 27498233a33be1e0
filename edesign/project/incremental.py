"""Incremental dynamic analysis in a study file: each record scaled step by step until the frame collapses."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag

from edesign.project.base import Model, by_key, by_shape, refuse
from edesign.project.hazard import LevelName
from edesign.project.measures import SHORT_NAMES, parse_measure_value
from edesign.project.problems import Keys, Problems, unknown_name
from edesign.project.project import Project
from edesign.project.units import Duration, PositiveAcceleration, PositiveFactor, PositiveRatio, PositiveTime

COLLAPSE = "collapse"
"""The limit that every study has."""

Count = Annotated[int, Field(ge=2, le=1000)]
Name = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_+-]*$", max_length=24)]


def _several(value: Any) -> Any:
    """A single name is a list of one."""
    return (value,) if isinstance(value, str) else value


Names = Annotated[tuple[str, ...], Field(min_length=1), BeforeValidator(_several)]


class Limit(Model):
    """What a fragility is of: a response measure beyond a value in SI; written `{interstorey_drift: 2.5 %}`."""

    measure: str
    value: float


def _limit(value: Any) -> Any:
    if not isinstance(value, Mapping) or len(value) != 1:
        raise refuse("one response measure with its value is needed, for example `{interstorey_drift: 2.5 %}`")
    ((name, given),) = value.items()
    if name not in SHORT_NAMES:
        raise refuse(unknown_name("response measure", str(name), SHORT_NAMES))
    limit = parse_measure_value(SHORT_NAMES[name], given)
    if limit == 0.0:
        raise refuse(f"`{given}` must be greater than zero")
    return Limit(measure=SHORT_NAMES[name], value=limit)


class _Range(Model):
    """Values at equal distances, both ends included."""

    count: Count

    def values(self, first: float, last: float) -> tuple[float, ...]:
        """The values from the first to the last."""
        steps = self.count - 1
        return tuple((first * (steps - i) + last * i) / steps for i in range(self.count))


class AccelerationRange(_Range):
    """`count` accelerations from one to another, m/s2."""

    first: Annotated[PositiveAcceleration, Field(alias="from")]
    last: Annotated[PositiveAcceleration, Field(alias="to")]


class FactorRange(_Range):
    """`count` factors from one to another."""

    first: Annotated[PositiveFactor, Field(alias="from")]
    last: Annotated[PositiveFactor, Field(alias="to")]


Accelerations = Annotated[
    Annotated[AccelerationRange, Tag("?mapping")]
    | Annotated[Annotated[tuple[PositiveAcceleration, ...], Field(min_length=2)], Tag("?plain")],
    Discriminator(by_shape),
]
Factors = Annotated[
    Annotated[FactorRange, Tag("?mapping")]
    | Annotated[Annotated[tuple[PositiveFactor, ...], Field(min_length=2)], Tag("?plain")],
    Discriminator(by_shape),
]


class _Incremental(Model):
    """What all have: variants and records, the drift that counts as collapse, and what fragilities are wanted of."""

    name: Name
    variants: Names = ("all",)
    records: Names
    levels: Accelerations | Factors
    level: LevelName | None = None
    collapse_drift: PositiveRatio = 0.10
    limits: dict[Name, Annotated[Limit, BeforeValidator(_limit)]] = {}
    free_vibration: Duration = 0.0

    @property
    def intensities(self) -> tuple[float, ...]:
        """The values of the intensity measure in ascending order, m/s2 or factors."""
        levels = self.levels
        return levels if isinstance(levels, tuple) else levels.values(levels.first, levels.last)


class SpectralAccelerationStudy(_Incremental):
    """Records scaled to a pseudo acceleration at 5 % damping and `period` (s), by default T1 of each variant."""

    intensity: Literal["spectral_acceleration"]
    levels: Accelerations
    period: PositiveTime | None = None


class PeakAccelerationStudy(_Incremental):
    """Records scaled to a peak ground acceleration."""

    intensity: Literal["pga"]
    levels: Accelerations


class LevelFactorStudy(_Incremental):
    """Records that are fitted to the spectrum: those of the hazard's `level` times factors."""

    intensity: Literal["level_factor"]
    levels: Factors
    level: LevelName


Incremental = Annotated[
    Annotated[SpectralAccelerationStudy, Tag("?intensity=spectral_acceleration")]
    | Annotated[PeakAccelerationStudy, Tag("?intensity=pga")]
    | Annotated[LevelFactorStudy, Tag("?intensity=level_factor")],
    Discriminator(by_key("intensity")),
]


def check_incremental(
    keys: Keys, incremental: Incremental, base: Project, variants: Collection[str], problems: Problems
) -> None:
    """Check an incremental study against its project; it has no schema problems.

    Args:
        keys: where it stands in the study file.
        incremental: the study.
        base: the project that is studied.
        variants: names of the variants of the study file.
        problems: receives what is wrong.
    """
    if incremental.variants != ("all",):
        _known(problems, (*keys, "variants"), "variant", incremental.variants, variants)
    _once(problems, (*keys, "variants"), incremental.variants)
    names = tuple(reference.partition("/")[0] for reference in incremental.records)
    _known(problems, (*keys, "records"), "record", names, base.records)
    _once(problems, (*keys, "records"), incremental.records)
    levels = base.hazard.levels if base.hazard is not None else {}
    if incremental.level is not None and incremental.level not in levels:
        problems.at_value((*keys, "level"), unknown_name("level", incremental.level, levels))
    if isinstance(incremental, LevelFactorStudy):
        for i, name in enumerate(names):
            if name in base.records and base.records[name].match is None:
                message = (
                    f"`{name}` is not fitted to the spectrum of the hazard, so that it has no level to be scaled from"
                )
                problems.at_value(_item(problems, (*keys, "records"), i), message)
    values = incremental.intensities
    if any(later <= earlier for earlier, later in zip(values, values[1:], strict=False)):
        problems.at_value((*keys, "levels"), "intensities must ascend: each greater than the one before it")
    if COLLAPSE in incremental.limits:
        problems.at_key(
            (*keys, "limits", COLLAPSE), f"`{COLLAPSE}` is there without being asked for; choose another name"
        )


def _known(problems: Problems, keys: Keys, what: str, given: tuple[str, ...], known: Collection[str]) -> None:
    for i, name in enumerate(given):
        if name not in known:
            problems.at_value(_item(problems, keys, i), unknown_name(what, name, known))


def _once(problems: Problems, keys: Keys, given: tuple[str, ...]) -> None:
    for i, name in enumerate(given):
        if name in given[:i]:
            problems.at_value(_item(problems, keys, i), f"`{name}` comes twice")


def _item(problems: Problems, keys: Keys, i: int) -> Keys:
    """The place of one of several names, of which a single one needs no list."""
    return (*keys, i) if problems.node(keys).items is not None else keys
