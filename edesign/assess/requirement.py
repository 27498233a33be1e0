"""What a criterion asks of each history, and the limits that a statistic over histories has to keep."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from edesign.archive.dataset import Group
from edesign.assess.acceptance import FrameMember, Kind
from edesign.assess.measures import Located, lacking_measure, located_measure
from edesign.assess.performance import usage
from edesign.assess.quantities import lacking, located_quantity, missing_history
from edesign.assess.spread import EVERYWHERE
from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import (
    Criterion,
    HingeCriterion,
    LimitCriterion,
    MeasureCriterion,
    PerformanceCriterion,
    QuantityCriterion,
)
from edesign.project.criteria.criterion_quantities import QUANTITIES, SELECTIONS
from edesign.project.criteria.measures import InSpace, short_name
from edesign.project.criteria.performance import PERFORMANCE_STANDARDS
from edesign.project.notation.names import storey_of
from edesign.project.notation.selections import NumberSelection

KINDS: dict[str, tuple[Kind, ...]] = {"columns": ("column",), "beams": ("beam",), "all": ("column", "beam")}
UNITS = {
    "m": ("mm", 1e-3),
    "N": ("kN", 1e3),
    "N*m": ("kN m", 1e3),
    "m/s": ("mm/s", 1e-3),
    "m/s^2": ("m/s2", 1.0),
    "J": ("kJ", 1e3),
    "rad": ("rad", 1.0),
    "1": ("%", 0.01),
    "": ("", 1.0),
    (DEMAND_OVER_CAPACITY := "D/C"): ("", 1.0),
}
"""Unit in which values of an SI unit are shown to people, with its size in SI."""
NEGLIGIBLE = 1e-9
"""A value of less, in SI, is what arithmetic leaves of 0: a nanometre, a nanonewton, a nanoradian are not measured."""


@dataclass(frozen=True)
class Requirement:
    """A criterion made ready: what to take of a history, and its limits.

    Attributes:
        name: of the criterion.
        words: what it asks for, with units.
        statistic: over the histories.
        place: value and place of one completed history, None where it has none.
        most, least: limits in SI; of a performance level the usage 1.
        unit: SI unit.
        share: of the histories that have to meet the limit, in place of a statistic; None: there is none.
        of_dampers: it means nothing of a frame without dampers.
        lacks: why it does not apply to a completed history, "" where it does.
        missing: the variable over time that it needs and a completed history has not in the archive, "" if none.
        bends: of a beam's name whether what is limited is how that beam bends.
    """

    name: str
    words: str
    statistic: str
    place: Callable[[Group], Located | None]
    most: float | None
    least: float | None
    unit: str
    share: float | None = None
    of_dampers: bool = False
    lacks: Callable[[Group], str] = lambda group: ""
    missing: Callable[[Group], str] = lambda group: ""
    bends: Callable[[str], bool] = lambda beam: False


def requirement_of(criterion: Criterion, members: Mapping[str, FrameMember], project: AnalysisFile) -> Requirement:
    """Make a criterion ready for judging histories.

    Args:
        criterion: of a study, or what an objective asks for.
        members: of the frame, by name; needed for performance levels only.
    """
    found = MAKERS[type(criterion)](criterion, members, project)
    if criterion.traits.bends_beams:
        storeys = _numbers(criterion.storeys, project)
        found = replace(found, bends=partial(_chosen, storeys=storeys, members=criterion.traits.members))
    if criterion.share is None:
        return found
    words = f"{found.words}, in at least {100.0 * criterion.share:g} % of the motions"
    return replace(found, share=criterion.share, words=words, statistic="share")


def _chosen(name: str, storeys: tuple[int, ...] | None, members: tuple[str, ...]) -> bool:
    """Say whether a member is among those that a criterion chooses; all without `storeys` or `members`."""
    return (storeys is None or storey_of(name) in storeys) and (not members or name in members)


def _of_measure(criterion: MeasureCriterion, members: Mapping[str, FrameMember], project: AnalysisFile) -> Requirement:
    place = partial(
        _worst,
        measures=[criterion.measure],
        storeys=_numbers(criterion.storeys, project),
        members=criterion.members or None,
        chosen=criterion.in_space,
    )
    where = _where(criterion.storeys, criterion.members) + _in_space(criterion)
    return Requirement(
        criterion.name,
        f"{short_name(criterion.measure).replace('_', ' ')} {_range(criterion)}{where}",
        criterion.statistic,
        place,
        criterion.most,
        criterion.least,
        criterion.kind.unit,
        of_dampers=criterion.traits.of_dampers,
        lacks=partial(lacking_measure, measure=criterion.measure),
    )


def _of_hinges(criterion: HingeCriterion, members: Mapping[str, FrameMember], project: AnalysisFile) -> Requirement:
    measures = [f"{kind}_plastic_rotation_rad" for kind in KINDS[criterion.of]]
    storeys, names = _numbers(criterion.storeys, project), criterion.members or None
    place = partial(_worst, measures=measures, storeys=storeys, members=names)
    of = "members" if criterion.of == "all" else criterion.of
    where = _where(criterion.storeys, criterion.members)
    words = f"no plastic hinges in {of}: at most {criterion.rotation:g} rad{where}"
    return Requirement(criterion.name, words, criterion.statistic, place, criterion.rotation, None, "rad")


def _of_quantity(
    criterion: QuantityCriterion, members: Mapping[str, FrameMember], project: AnalysisFile
) -> Requirement:
    quantity = QUANTITIES[criterion.quantity]
    words = f"{criterion.quantity.replace('_', ' ')}{_of_what(criterion)} {_range(criterion)}"
    for key in SELECTIONS[quantity.place]:
        chosen = getattr(criterion, key)
        if key == "of":
            words += _KINDS_IN_WORDS[chosen]
            continue
        text = ", ".join(chosen) if isinstance(chosen, tuple) else "" if chosen.is_all else str(chosen)
        words += f", {key if set(',-') & set(text) else key.removesuffix('s')} {text}" if text else ""
    words += _in_space(criterion)
    return Requirement(
        criterion.name,
        words,
        criterion.statistic,
        partial(located_quantity, asked=criterion, project=project),
        criterion.most,
        criterion.least,
        quantity.kind.unit,
        of_dampers=criterion.traits.of_dampers,
        lacks=partial(lacking, asked=criterion, project=project),
        missing=partial(missing_history, asked=criterion),
    )


_KINDS_IN_WORDS = {
    "all": "",
    "columns": ", columns",
    "beams": ", beams",
    "not_dissipative": ", members that are not meant to yield",
}


def _of_what(criterion: QuantityCriterion) -> str:
    """Side, oscillator or term in words."""
    if criterion.quantity == "support_vertical_reaction" and criterion.side is not None:
        return {"tension": " in uplift", "compression": " in compression"}[criterion.side]
    if criterion.side is not None:
        return f" in {criterion.side}"
    if criterion.frequency is not None and criterion.damping is not None:
        return f" at {criterion.frequency:g} Hz, {100.0 * criterion.damping:g} % damping,"
    return f" of {criterion.term.replace('_', '-')}" if criterion.term is not None else ""


def _of_performance(
    criterion: PerformanceCriterion, members: Mapping[str, FrameMember], project: AnalysisFile
) -> Requirement:
    storeys, level, by, of = _numbers(criterion.storeys, project), criterion.performance, criterion.ways, criterion.of
    standard = PERFORMANCE_STANDARDS[criterion.standard]

    def place(group: Group) -> Located | None:
        found = usage(group, members, level, by, KINDS[of], storeys, criterion.standard)
        if found is None:
            return None
        return Located(
            found.ratio,
            found.storey,
            found.member,
            remark=found.of_force,
            direction=found.direction,
            line=found.line,
            axis=found.axis,
            not_judged=found.not_judged,
        )

    ways = {"drift": "drift", "members": "plastic rotation", "both": "drift and plastic rotation"}
    whose = f" of {of}" if by != "drift" and of != "all" else ""
    whom = "" if criterion.standard == "fema356" else f" of {standard.name}"
    words = f"{standard.levels[level]}{whom} by {ways[by]}{whose}"
    return Requirement(criterion.name, words, criterion.statistic, place, 1.0, None, DEMAND_OVER_CAPACITY)


MAKERS: dict[type, Callable[[Any, Mapping[str, FrameMember], AnalysisFile], Requirement]] = {
    MeasureCriterion: _of_measure,
    QuantityCriterion: _of_quantity,
    HingeCriterion: _of_hinges,
    PerformanceCriterion: _of_performance,
}
"""What makes each kind of criterion ready: of the criterion, the members of its frame by name, and the project."""


def shown(value: float, unit: str, digits: int = 4) -> str:
    """Return a value in SI with the unit people read.

    Args:
        value: SI.
        unit: SI unit, a key of `UNITS`.
        digits: significant ones.
    """
    return f"{bare(value, unit, digits)} {UNITS[unit][0]}".rstrip()


def bare(value: float, unit: str, digits: int) -> str:
    """Return a value in SI in the unit that people read, without that unit; what is negligible as 0.

    Args:
        value: SI.
        unit: SI unit, a key of `UNITS`.
        digits: significant ones.
    """
    return f"{0.0 if abs(value) < NEGLIGIBLE else value / UNITS[unit][1]:.{digits}g}"


def _worst(
    group: Group,
    measures: Sequence[str],
    storeys: tuple[int, ...] | None,
    members: tuple[str, ...] | None,
    chosen: InSpace = EVERYWHERE,
) -> Located | None:
    places = [located_measure(group, measure, storeys, members, chosen) for measure in measures]
    there = [place for place in places if place is not None]
    return max(there, key=lambda place: place.value, default=None)


def _numbers(chosen: NumberSelection, project: AnalysisFile) -> tuple[int, ...] | None:
    return None if chosen.is_all else chosen.numbers(1, project.grid.n_storeys)


def _where(storeys: NumberSelection, members: tuple[str, ...]) -> str:
    text = "" if storeys.is_all else f", storeys {storeys}"
    return text + (f", members {', '.join(members)}" if members else "")


def _in_space(criterion: LimitCriterion) -> str:
    """Where in a building, in words."""
    place = criterion.in_space
    parts = (
        "resultant" if place.direction == "resultant" else f"along {place.direction}" if place.direction else "",
        f"at {', '.join(place.at)}" if place.at else "",
        f"in frame{'s' * (len(place.frames) > 1)} {', '.join(place.frames)}" if place.frames else "",
        f"about {place.axis}" if place.axis else "",
    )
    return "".join(f", {part}" for part in parts if part)


def _range(criterion: LimitCriterion) -> str:
    unit = criterion.kind.unit
    if criterion.most is None:
        assert criterion.least is not None
        return f"at least {shown(criterion.least, unit)}"
    if criterion.least is None:
        return f"at most {shown(criterion.most, unit)}"
    label, size = UNITS[unit]
    return f"{criterion.least / size:.4g} to {criterion.most / size:.4g} {label}".rstrip()
