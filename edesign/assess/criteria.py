"""Verdicts: whether the responses of a study meet its criteria and its rehabilitation objectives."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from edesign.archive.dataset import Group
from edesign.assess.judgement import statistic_of, within
from edesign.assess.members import frame_members
from edesign.assess.performance import By
from edesign.assess.requirement import Requirement, performance_requirement, requirement_of
from edesign.assess.sets import HistorySet, history_sets, target_sets
from edesign.codes.fema356.objectives import OBJECTIVES
from edesign.project.checks_criteria import objective_level
from edesign.project.criteria import Criterion, Objectives, PerformanceCriterion
from edesign.project.project import Project


@dataclass(frozen=True)
class Verdict:
    """Whether one criterion is met by one variant at one hazard level.

    Attributes:
        name: of the criterion, or `objective h, by drift`.
        requirement: in words and units.
        value: the statistic in SI with failed histories counted as infinite where that leaves it finite, else the one
            over the histories that have a value; None if none has. Of performance levels: usage, met up to 1.
        limit: that decides, in SI.
        unit: SI unit of both, "1" for ratios.
        met: None: no history yet, or it depends on histories that have not run.
        remark: "better than the range", "failed histories count as infinite", ...
        governing_history, governing_storey, governing_member: of the largest value (smallest for `least`).
        count: histories with a value.
        missing: histories without.
    """

    name: str
    requirement: str
    variant: str
    level: str
    statistic: str
    value: float | None
    limit: float
    unit: str
    met: bool | None
    remark: str
    governing_history: str
    governing_storey: int | None
    governing_member: str
    count: int
    missing: tuple[str, ...]


def judge(
    criteria: Sequence[Criterion], objectives: Objectives, histories: Mapping[str, Group], project: Project
) -> tuple[Verdict, ...]:
    """Judge the histories of a study.

    Each criterion is judged for each of its variants at each of its levels for which there are histories (completed,
    failed, or planned), and for those that it names and that have none (met: None). Objectives are judged for all
    variants at their hazard level by the mean, by drift and by members apart.

    A failed history counts as infinitely far beyond the limit: a mean or a maximum over it is not met, a median is as
    long as fewer than half of the histories failed.

    States at target displacements are judged beside histories, those of each method apart, by their maximum over
    patterns and directions (EN 1998-1:2004, 4.3.3.4.2.2(1) asks for several).

    Args:
        criteria: of the study.
        objectives: letters of Table 5.4.
        histories: results by name, with the attributes kind, variant, level and status; one that was planned and has
            not run has the status "not run".
        project: of the frame and the hazard levels.
    """
    sets = (*history_sets(histories), *target_sets(histories))
    members = frame_members(project) if objectives or any(isinstance(c, PerformanceCriterion) for c in criteria) else {}
    verdicts = []
    for criterion in criteria:
        asked = requirement_of(criterion, members, project)
        chosen = _chosen(sets, criterion.variants, criterion.levels)
        verdicts += [_verdict(asked, found) for found in chosen]
    for letter in objectives:
        objective = OBJECTIVES[letter]
        level = objective_level(letter, project.hazard)
        ways: tuple[By, ...] = ("drift", "members")
        for by in ways:
            name = f"objective {letter}, by {by}"
            asked = performance_requirement(name, objective.level, by, "all", "mean", None, members)
            verdicts += [_verdict(asked, found) for found in _chosen(sets, (), (level or "no such level",))]
    return tuple(verdicts)


def _chosen(sets: Sequence[HistorySet], variants: tuple[str, ...], levels: tuple[str, ...]) -> list[HistorySet]:
    """Sets of the variants and levels (empty: all that have one); what is named and not there is an empty set."""
    found = [s for s in sets if (s.variant in variants or not variants) and (s.level in levels if levels else s.level)]
    there = {(s.variant, s.level) for s in found}
    found += [HistorySet(v, level) for v in variants for level in levels if (v, level) not in there]
    return found or [HistorySet(", ".join(variants), ", ".join(levels))]


def _verdict(asked: Requirement, found: HistorySet) -> Verdict:
    if found.method is not None:
        asked = replace(asked, statistic="maximum")
    places = {name: asked.place(group) for name, group in found.completed.items()}
    values = {name: place.value if (place := places.get(name)) is not None else None for name in found.histories}
    there = {name: value for name, value in values.items() if value is not None}
    bad = math.inf if asked.most is not None else -math.inf
    ended = {name: value for name, value in values.items() if name not in found.not_run}
    value = statistic_of(asked.statistic, ended, bad)
    if value is not None and not math.isfinite(value):
        value = statistic_of(asked.statistic, there, bad)
    applies = bool(there) or not found.completed  # completed histories without it: the frame has no such thing
    met = within(asked.statistic, values, found.not_run, asked.most, asked.least) if values and applies else None
    governing = ""
    if there:
        governing = max(there, key=lambda name: there[name]) if bad > 0.0 else min(there, key=lambda name: there[name])
    place = places.get(governing)
    limit = asked.most if asked.most is not None else asked.least
    assert limit is not None
    return Verdict(
        asked.name,
        asked.words,
        found.label,
        found.level,
        asked.statistic,
        value,
        limit,
        asked.unit,
        met,
        _remark(asked, found, value, met, applies),
        governing,
        place.storey if place is not None else None,
        place.member if place is not None else "",
        len(there),
        tuple(name for name, value in values.items() if value is None),
    )


def _remark(asked: Requirement, found: HistorySet, value: float | None, met: bool | None, applies: bool) -> str:
    remarks = []
    if not found.histories:
        remarks.append("no such histories")
    elif not applies:
        remarks.append("does not apply")
    if asked.most is not None and asked.least is not None and met and value is not None:
        remarks.append("better than the range" if value < asked.least else "within the range")
    if found.failed:
        remarks.append("failed histories count as beyond the limit")
    if found.not_run:
        remarks.append("histories not run yet")
    return "; ".join(remarks)
