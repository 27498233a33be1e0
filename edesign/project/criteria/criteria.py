"""What a study is judged by: limits of measures and quantities, plastic hinges, performance levels, objectives."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Annotated, Any, Literal

from pydantic import (
    ConfigDict,
    Field,
    ValidationInfo,
    WithJsonSchema,
    field_validator,
)

from edesign.project.analysis.outputs import HistoryKind
from edesign.project.criteria.criterion_quantities import QUANTITIES, EnergyTerm, Side
from edesign.project.criteria.measures import (
    ELSEWHERE,
    MEASURES,
    RESULTANTS,
    SHORT_NAMES,
    InSpace,
    add_limits,
    parse_limit,
)
from edesign.project.criteria.performance import PERFORMANCE_STANDARDS, By, PerformanceLevel, Standard
from edesign.project.document import LONGEST
from edesign.project.notation.names import member_kind
from edesign.project.notation.quantities import Kind
from edesign.project.notation.selections import ALL_LINES, ALL_NUMBERS, Lines, Numbers
from edesign.project.notation.several import several
from edesign.project.notation.units import PositiveFrequency, PositiveRatio, Rotation
from edesign.project.notation.written import Written, given, one_or_list, text, words_or
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import as_seen, unknown_name

MemberKinds = Literal["columns", "beams", "all"]
MembersOf = Literal["column", "beam", "brace", "column or beam"]
Objective = Literal["a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l"]
CriterionName = Annotated[str, Field(min_length=1, max_length=120)]


def _some_names(value: Any) -> Any:
    """One name, a list of names, or `all` (an empty tuple)."""
    if value == "all":
        return ()
    names = several(value)
    for i, name in enumerate(names):
        if not isinstance(name, str):
            at = (i,) if names is value else ()
            raise refuse(f"a name, a list of names, or `all` is needed, not {as_seen(name)} [E-VALUE-01]", *at)
    if not names:
        raise refuse("the list is empty; write `all`, or at least one name [E-VALUE-01]")
    return tuple(names)


def _measure(value: Any) -> Any:
    if isinstance(value, str) and value in MEASURES:
        return value
    if isinstance(value, str) and value in SHORT_NAMES:
        return SHORT_NAMES[value]
    raise refuse(unknown_name("measure", str(value), SHORT_NAMES))


def _quantity(value: Any) -> Any:
    if isinstance(value, str) and value in QUANTITIES:
        return value
    known = "; `edesign quantities` lists them (the stroke of a damper is `damper_deformation`)"
    raise refuse(unknown_name("quantity", str(value), QUANTITIES, known))


CODE_IN_FORCE = "code"
"""The statistic that the code of the hazard takes of so many motions."""
PLAIN_STATISTICS = (CODE_IN_FORCE, "mean", "maximum", "median", "ec8", "ntc2018", "asce7")
"""Statistics that need no number; the last three are what these codes take of so many motions."""
_PERCENTILE = re.compile(r"(?:percentile )?([0-9]+(?:\.[0-9]+)?) ?%")


def _statistic(value: Any) -> Any:
    """The name of a statistic; a percentile as `84%`."""
    if isinstance(value, str) and value in PLAIN_STATISTICS:
        return value
    match = _PERCENTILE.fullmatch(value) if isinstance(value, str) else None
    if match is None:
        names = ", ".join(f"`{name}`" for name in PLAIN_STATISTICS)
        raise refuse(f"`{value}` is no statistic; allowed: {names}, and percentiles such as `84 %` [E-VALUE-03]")
    if not 0.0 < float(match[1]) < 100.0:
        raise refuse(
            f"`{value}`: a percentile is more than 0 % and less than 100 %; of all it is the `maximum` [E-VALUE-02]"
        )
    return f"{float(match[1]):g}%"


_ONE_OF: dict[MemberKinds, MembersOf] = {"columns": "column", "beams": "beam", "all": "column or beam"}
Names = Annotated[tuple[str, ...], Written(_some_names, one_or_list)]


@dataclass(frozen=True)
class Traits:
    """What is to be known of a criterion of any kind before it is judged.

    Attributes:
        of_dampers: it means nothing of a frame without dampers.
        bends_beams: it limits how beams bend.
        members: that it chooses by name; (): all, or there are none to choose from.
        members_of: what these have to be; None: that is checked elsewhere.
        by_members: limits of each member are needed to judge it.
        kept: the histories that must be kept for it (`outputs: histories`); None: all that it needs is archived.
        over_time: the variable over time that it is computed from, "" if extremes are enough.
        from_below: it has a least value alone.
        standard: where its limit comes from if `source` does not say it.
    """

    of_dampers: bool = False
    bends_beams: bool = False
    members: tuple[str, ...] = ()
    members_of: MembersOf | None = None
    by_members: bool = False
    kept: HistoryKind | None = None
    over_time: str = ""
    from_below: bool = False
    standard: str = ""


class _Criterion(Model):
    """What all criteria share: a name, the histories they look at, and the statistic over the records.

    Its `traits` say what others have to know of a criterion without asking of which kind it is.

    Attributes:
        name: unique name of the criterion.
        source: clause of a code, or an agreement, that the limit comes from; the report prints it beside the check.
        variants: variants that are judged, each on its own, or `all`.
        levels: hazard levels that are judged, each on its own, or `all`.
        statistic: statistic over the histories; `code` is that of the code of the `hazard`: the mean of enough motions
            (seven in EN 1998-1), else the most unfavourable value. `ec8`, `ntc2018` and `asce7` name the code.
        share: share of the histories that have to meet the limit, in place of a statistic.
        storeys: storeys that count.
    """

    name: CriterionName
    source: Annotated[str, Field(min_length=1, max_length=LONGEST)] | None = None
    variants: Names = ()
    levels: Names = ()
    statistic: Annotated[
        str, Written(_statistic, words_or(text("percentile", _PERCENTILE.pattern, "84 %"), *PLAIN_STATISTICS))
    ] = CODE_IN_FORCE
    share: PositiveRatio | None = None
    storeys: Numbers = ALL_NUMBERS

    @property
    def traits(self) -> Traits:
        """What is to be known of it."""
        return Traits()


_KINDS = {name: of.kind for name, of in MEASURES.items()}
_KINDS |= {short: _KINDS[name] for short, name in SHORT_NAMES.items()}
_Limit = Annotated[float, WithJsonSchema({"title": "limit with its unit", "type": ["number", "string"]})]


class _SomewhereInSpace(_Criterion):
    """What criteria with limits say of where in a building; plane frames have none of these keys.

    Attributes:
        direction: direction of a building, `x` or `y`, or `resultant`, of both at one instant; without the key the
            larger of x and y counts.
        at: column lines of a building, such as `[A1, A4]`; of floors also `centre`, the centre of mass.
        frames: plane frames of a building, such as `[X1, YA]`.
        axis: local axis about which members of a building bend: `y` is the strong one of an I section.
    """

    direction: Literal["x", "y", "resultant"] | None = None
    at: Names = ()
    frames: Names = ()
    axis: Literal["y", "z"] | None = None

    @property
    def in_space(self) -> InSpace:
        """Where in a building it looks."""
        return InSpace(self.direction, self.at, self.frames, self.axis)


class MeasureCriterion(_SomewhereInSpace):
    """Limits of a response measure.

    Attributes:
        measure: response measure, with or without the unit at the end of its name.
        most: largest value allowed, with its unit.
        least: least value required; beside `most` the lower end of a target range, below which is better than required.
        members: members or dampers that count, or `all`.
    """

    model_config = ConfigDict(json_schema_extra=lambda schema: add_limits(schema, "measure", _KINDS))

    measure: Annotated[str, Written(_measure, given({"enum": sorted({*SHORT_NAMES, *MEASURES})}))]
    most: _Limit | None = None
    least: _Limit | None = None
    members: Names = ()

    @property
    def subject(self) -> str:
        """What is limited."""
        return self.measure

    @property
    def kind(self) -> Kind:
        """What its limits are."""
        return MEASURES[self.measure].kind

    @property
    def resultant(self) -> str | None:
        """The quantity whose resultant of both directions is limited; None: it is not asked for, or there is none."""
        return MEASURES[self.measure].resultant if self.direction == "resultant" else None

    @property
    def traits(self) -> Traits:
        """What is to be known of it."""
        place = MEASURES[self.measure].place
        return Traits(
            of_dampers=place == "damper",
            bends_beams=place == "beam",
            members=self.members,
            members_of=place if place == "column" or place == "beam" or place == "brace" else None,
            from_below=self.most is None,
        )

    @field_validator("most", "least", mode="before")
    @classmethod
    def _value(cls, value: Any, info: ValidationInfo) -> Any:
        measure = info.data.get("measure")
        return None if measure is None else parse_limit(MEASURES[measure].kind, value)


class QuantityCriterion(_SomewhereInSpace):
    """Limits of an archived quantity at some of its places.

    The largest absolute value over time counts, or that on one side, over the places that are chosen.

    Attributes:
        quantity: quantity of the archive; `edesign quantities` lists them.
        most: largest value allowed, with its unit.
        least: least value required; beside `most` the lower end of a target range, below which is better than required.
        floors: floors that count.
        members: columns, beams or braces that count, or `all`.
        of: kind of members that count; `not_dissipative` those of both that `design` does not let yield.
        dampers: dampers that count, or `all`.
        lines: column lines that count, of supports or isolators at their bases.
        side: tension or compression alone; of a vertical reaction tension is uplift.
        frequency: frequency of the oscillator on a floor.
        damping: damping ratio of the oscillator on a floor.
        term: term of the energy balance.
    """

    model_config = ConfigDict(
        json_schema_extra=lambda schema: add_limits(
            schema, "quantity", {name: of.kind for name, of in QUANTITIES.items()}
        )
    )

    quantity: Annotated[str, Written(_quantity, given({"enum": sorted(QUANTITIES)}))]
    most: _Limit | None = None
    least: _Limit | None = None
    floors: Numbers = ALL_NUMBERS
    members: Names = ()
    of: MemberKinds | Literal["not_dissipative"] = "all"
    dampers: Names = ()
    lines: Lines = ALL_LINES
    side: Side | None = None
    frequency: PositiveFrequency | None = None
    damping: PositiveRatio | None = None
    term: EnergyTerm | None = None

    @property
    def subject(self) -> str:
        """What is limited."""
        return self.quantity

    @property
    def kind(self) -> Kind:
        """What its limits are."""
        return QUANTITIES[self.quantity].kind

    @property
    def resultant(self) -> str | None:
        """The quantity whose resultant of both directions is limited; None: it is not asked for, or there is none."""
        found = ELSEWHERE.get(self.quantity, self.quantity) if self.in_space.lines else self.quantity
        return found if self.direction == "resultant" and found in RESULTANTS else None

    @property
    def traits(self) -> Traits:
        """What is to be known of it."""
        quantity = QUANTITIES[self.quantity]
        return Traits(
            of_dampers=quantity.place == "damper" or quantity.of_dampers or self.term == "dampers",
            bends_beams=quantity.bends,
            members=self.members,
            kept=quantity.kept,
            over_time=quantity.over_time,
            from_below=self.most is None,
        )

    def counts(self, member: str, dissipative: bool) -> bool:
        """Return whether `of` chooses a member.

        Args:
            dissipative: whether it is meant to yield.
        """
        if self.of == "not_dissipative":
            return not dissipative
        return self.of == "all" or self.of == f"{member_kind(member)}s"

    @field_validator("most", "least", mode="before")
    @classmethod
    def _value(cls, value: Any, info: ValidationInfo) -> Any:
        quantity = info.data.get("quantity")
        return None if quantity is None else parse_limit(QUANTITIES[quantity].kind, value)


class HingeCriterion(_Criterion):
    """No plastic hinges: the plastic rotation of the ends of members is at most `rotation` (rad).

    Attributes:
        plastic_hinges: no plastic hinges.
        of: members that count.
        members: members that count by name, or `all`.
        rotation: plastic rotation of an end from which it counts as a hinge.
    """

    plastic_hinges: Literal["none"]
    of: MemberKinds = "all"
    members: Names = ()
    rotation: Rotation = 0.001

    @property
    def traits(self) -> Traits:
        """What is to be known of it."""
        return Traits(bends_beams=self.of != "columns", members=self.members, members_of=_ONE_OF[self.of])


class PerformanceCriterion(_Criterion):
    """A structural performance level, by drifts, by plastic rotations of members, or by both.

    Attributes:
        standard: standard whose level it is.
        performance: `IO`, `LS` or `CP` of FEMA 356 and ASCE/SEI 41-17; `DL`, `SD` or `NC` of EN 1998-3.
        by: whether drifts, plastic rotations of members, or both are judged; only FEMA 356 has drifts. Without the key
            all that the standard has limits of.
        of: members that count.
    """

    standard: Standard = "fema356"
    performance: PerformanceLevel
    by: By | None = None
    of: MemberKinds = "all"

    @property
    def ways(self) -> By:
        """What is judged."""
        return self.by or ("both" if "both" in PERFORMANCE_STANDARDS[self.standard].tables else "members")

    @property
    def traits(self) -> Traits:
        """What is to be known of it."""
        standard = PERFORMANCE_STANDARDS[self.standard]
        bends = self.ways != "drift" and self.of != "columns"
        return Traits(bends_beams=bends, by_members=True, standard=f"{standard.name}, {standard.tables[self.ways]}")

    @field_validator("performance")
    @classmethod
    def _level(cls, level: PerformanceLevel, info: ValidationInfo) -> PerformanceLevel:
        standard = PERFORMANCE_STANDARDS.get(info.data.get("standard", ""))
        if standard is None or level in standard.levels:
            return level
        others = [f"`standard: {key}`" for key, other in PERFORMANCE_STANDARDS.items() if level in other.levels]
        known = ", ".join(f"`{name}`" for name in standard.levels)
        raise refuse(f"`{level}` is no level of {standard.name} ({known}), but of {' and '.join(others)} [E-VALUE-03]")

    @field_validator("by")
    @classmethod
    def _way(cls, by: By | None, info: ValidationInfo) -> By | None:
        standard = PERFORMANCE_STANDARDS.get(info.data.get("standard", ""))
        if by is None or standard is None or by in standard.tables:
            return by
        raise refuse(f"{standard.name} has no limits of drift here; leave `by` out, or write `members` [E-VALUE-03]")


LimitCriterion = MeasureCriterion | QuantityCriterion
"""Limits, `most` and `least`, of what is measured."""


Criterion = Annotated[
    MeasureCriterion | QuantityCriterion | HingeCriterion | PerformanceCriterion,
    OneOf(
        otherwise=MeasureCriterion,
        performance=PerformanceCriterion,
        plastic_hinges=HingeCriterion,
        quantity=QuantityCriterion,
    ),
]
Criteria = tuple[Criterion, ...]
Objectives = tuple[Objective, ...]
