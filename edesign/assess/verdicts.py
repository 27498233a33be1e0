"""Verdicts: whether the responses of a study meet its criteria and its rehabilitation objectives."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from edesign.archive.dataset import Group
from edesign.assess.judgement import share_met, statistic_of, within
from edesign.assess.measures import Located, place_in_words
from edesign.assess.members import VariantMembers, with_gravity
from edesign.assess.requirement import NEGLIGIBLE, Requirement, requirement_of
from edesign.assess.sets import HistorySet, history_sets, target_sets
from edesign.assess.statistics import code_statistic
from edesign.codes.fema356.objectives import OBJECTIVES
from edesign.codes.motion_sets import SetRules
from edesign.frame.masses import STILL_BEAMS
from edesign.ground_motion.hazard import objective_level, rules_in_force
from edesign.project.analysis_file import AnalysisFile
from edesign.project.criteria.criteria import Criterion, Objectives, PerformanceCriterion
from edesign.project.reading.problems import listed
from edesign.project.study.study import Study, own_variant

Answer = Literal["met", "not met", "open", "does not apply"]
_STATIC = "states at target displacements have no such result"


@dataclass(frozen=True)
class Verdict:
    """Verdict on one criterion for one variant at one hazard level.

    Attributes:
        name: of the criterion, or `objective h, by drift`.
        requirement: in words and units.
        statistic: that was taken; of a criterion by a code the one that the code takes of so many motions.
        value: the statistic in SI with failed histories counted as infinite where that leaves it finite, else the one
            over the histories that have a value; None if none has. Of performance levels: usage, met up to 1. Of a
            share of the motions: that share.
        limit: that decides, in SI; of a share the least one.
        unit: SI unit of both, "1" for ratios, "D/C" of performance levels.
        met: None: it does not apply, there is no history yet, or it depends on histories that have not run.
        remark: "better than the range", "failed histories count as infinite", why it does not apply, ...
        governing_history, governing_storey, governing_member, governing_floor: of the largest value (smallest for
            `least`); the member may be a damper or a support.
        governing_line, governing_direction, governing_axis: of it in a building, "" where there is none.
        count: histories with a value.
        missing: histories without.
        motions: of these histories, if several are of one motion.
        applies: False: it means nothing of this variant, or the study runs no history of it at this level.
        from_below: the value must not be less than the limit.
        of_target: it is of states at target displacements, and not of histories.
        source: of the limit, where no criterion says it.
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
    governing_floor: int | None = None
    motions: int | None = None
    governing_line: str = ""
    governing_direction: str = ""
    governing_axis: str = ""
    applies: bool = True
    from_below: bool = False
    of_target: bool = False
    source: str = ""

    @property
    def answer(self) -> Answer:
        """The verdict in a word or three."""
        if not self.applies:
            return "does not apply"
        return "open" if self.met is None else "met" if self.met else "not met"

    @property
    def ratio(self) -> float | None:
        """Demand over capacity, met up to 1: value over limit, of a limit from below the inverse; None without.

        It is infinite where failed histories decide, whatever the value of the others, and of a limit of zero. A share
        of 0 has none: how far histories are beyond a limit does not show in how many are.
        """
        if self.statistic == "share" and not self.value:
            return None
        demand, capacity = (self.limit, self.value) if self.from_below else (self.value, self.limit)
        found = None if demand is None or not capacity else demand / capacity
        return math.inf if self.met is False and (found is None or found <= 1.0) else found

    @property
    def number(self) -> int:
        """How many motions the statistic is over, those without a value included."""
        return self.count + len(self.missing) if self.motions is None else self.motions

    @property
    def negligible(self) -> bool:
        """True if the value is 0 but for rounding, and has an upper limit: then no place and no history governs."""
        return self.value is not None and abs(self.value) < NEGLIGIBLE and not self.from_below and self.met is not False

    @property
    def place(self) -> str:
        """The floor, storey, member, damper or support that governs, "" where there is none.

        In a building with its column line and direction, or the axis of bending of a member: `storey 3, line A4, y`.
        """
        return place_in_words(
            self.governing_storey,
            self.governing_member,
            self.governing_floor,
            self.governing_line,
            self.governing_direction,
            self.governing_axis,
        )


def judge(
    criteria: Sequence[Criterion],
    objectives: Objectives,
    histories: Mapping[str, Group],
    project: AnalysisFile,
    study: Study | None = None,
) -> tuple[Verdict, ...]:
    """Judge the histories of a study.

    Each criterion is judged for each of its variants at each of its levels for which there are histories (completed,
    failed, or planned), and for those that it names and that have none. Of the latter, what the study does not run does
    not apply, and what it should have run is open; so is a quantity that a variant has not, such as the force of
    dampers of a bare frame. Objectives are judged for all
    variants at their hazard level by the statistic of the code in force, by drift and by members apart.

    Histories of one motion at several angles, and with masses at several places of a building, count as the worst of
    them, before the statistic is taken.

    A failed history counts as infinitely far beyond the limit: a mean or a maximum over it is not met, a median is as
    long as fewer than half of the histories failed.

    States at target displacements are judged beside histories, those of each method apart, by their maximum over
    patterns and directions (EN 1998-1:2004, 4.3.3.4.2.2(1) asks for several).

    Args:
        objectives: letters of Table 5.4.
        histories: results by name, with the attributes kind, variant, level and status; one that was planned and has
            not run has the status "not run".
        study: says what should have run, and which variants have no dampers; None: what is named should have run.
    """
    sets = (*history_sets(histories), *target_sets(histories))
    members = VariantMembers(project, study)
    under_gravity, rules = with_gravity(members, histories), rules_in_force(project.hazard)
    verdicts = []
    for criterion in criteria:
        for found in _chosen(sets, criterion.variants, criterion.levels, study):
            of_variant = under_gravity(found.variant) if criterion.traits.by_members else {}
            asked = requirement_of(criterion, of_variant, members.project(found.variant))
            verdicts.append(_verdict(asked, found, study, rules))
    for letter in objectives:
        objective = OBJECTIVES[letter]
        level = objective_level(letter, project.hazard)
        for by in ("drift", "members"):
            given = {"name": f"objective {letter}, by {by}", "performance": objective.level, "by": by}
            asks = PerformanceCriterion.model_validate(given)
            for found in _chosen(sets, (), (level or "no such level",), study):
                of_variant = members(found.variant)
                asked = requirement_of(asks, of_variant, members.project(found.variant))
                verdicts.append(_verdict(asked, found, study, rules))
    return tuple(verdicts)


def _chosen(
    sets: Sequence[HistorySet], variants: tuple[str, ...], levels: tuple[str, ...], study: Study | None
) -> list[HistorySet]:
    """Sets of the variants and levels; what is planned or named and not there is empty.

    Without levels all sets that have one are meant, and where none has one, all.
    """
    planned = study.planned_sets if study is not None else ()
    leveled = any(s.level for s in sets) or any(level for _, level in planned)

    def wanted(variant: str, level: str) -> bool:
        named = study.named(variant) if study is not None else variant
        of_variant = not variants or variant in variants or named in variants
        return of_variant and (level in levels if levels else bool(level) or not leveled)

    found = [s for s in sets if wanted(s.variant, s.level)]
    there = {(s.variant, s.level) for s in found}
    shaken = {(s.variant, s.level) for s in found if s.method is None}
    others = [pair for pair in planned if wanted(*pair) and pair not in shaken]
    others += [(variant, level) for variant in variants for level in levels if (variant, level) not in there]
    found += [HistorySet(*pair) for pair in dict.fromkeys(others)]
    return found or [HistorySet(", ".join(variants), ", ".join(levels))]


def _verdict(asked: Requirement, found: HistorySet, study: Study | None, rules: SetRules) -> Verdict:
    of_code = code_statistic(asked.statistic, found.motions, rules, from_below=asked.most is None)
    asked = replace(asked, statistic=of_code)
    why = _why_not(asked, found, study)
    if why:
        return _unanswered(asked, found, why, applies=False)
    if found.method is not None:
        asked = replace(asked, statistic="maximum", share=None)
    lost = next((name for group in found.completed.values() if (name := asked.missing(group))), "")
    if lost:
        if found.method is not None:
            return _unanswered(asked, found, _STATIC, applies=False)
        return _unanswered(asked, found, f"`{lost}` is not in the archive", applies=True)
    places = {name: asked.place(group) for name, group in found.completed.items()}
    values = {name: place.value if (place := places.get(name)) is not None else None for name in found.histories}
    there = {name: value for name, value in values.items() if value is not None}
    if found.completed and not there:
        why = _STATIC if found.method is not None else "its histories have no such result"
        return _unanswered(asked, found, why, applies=False)
    bad = math.inf if asked.most is not None else -math.inf
    worst = found.worst_of_motions(values, from_below=bad < 0.0)
    if asked.share is not None:
        statistic = "share"
        value, met = share_met(asked.share, worst, found.not_run, asked.most, asked.least)
    else:
        statistic = asked.statistic
        ended = {name: value for name, value in values.items() if name not in found.not_run}
        value = statistic_of(statistic, found.worst_of_motions(ended, bad < 0.0), bad)
        if value is not None and not math.isfinite(value):
            value = statistic_of(statistic, found.worst_of_motions(there, bad < 0.0), bad)
        met = within(statistic, worst, found.not_run, asked.most, asked.least) if values else None
    governing = ""
    if there:
        governing = max(there, key=lambda name: there[name]) if bad > 0.0 else min(there, key=lambda name: there[name])
    place = places.get(governing)
    return replace(
        _unanswered(asked, found, _remark(asked, found, value, met, place, places.values()), applies=True),
        statistic=statistic,
        value=value,
        met=met,
        governing_history=governing,
        governing_storey=place.storey if place is not None else None,
        governing_member=place.member if place is not None else "",
        governing_floor=place.floor if place is not None else None,
        governing_line=place.line if place is not None else "",
        governing_direction=place.direction if place is not None else "",
        governing_axis=place.axis if place is not None else "",
        count=len(there),
        missing=tuple(name for name, one in values.items() if one is None),
    )


def _why_not(asked: Requirement, found: HistorySet, study: Study | None) -> str:
    """Why a requirement does not apply to a set, "" where it does or that is not known yet."""
    if study is not None:
        variant = study.variants.get(own_variant(found.variant))
        if asked.of_dampers and variant is not None and variant.dampers == "none":
            return "there are no dampers"
        if not found.histories and (found.variant, found.level) not in study.planned_sets:
            return "the study runs no such histories"
    reasons = [asked.lacks(group) for group in found.completed.values()]
    return reasons[0] if reasons and all(reasons) else ""


def _unanswered(asked: Requirement, found: HistorySet, remark: str, applies: bool) -> Verdict:
    limit, unit = _limit(asked)
    missing = tuple(found.histories) if applies else ()
    below = asked.share is not None or asked.most is None
    nothing = (asked.statistic, None, limit, unit, None, remark, "", None, "", 0, missing)
    empty = Verdict(asked.name, asked.words, found.label, found.level, *nothing, applies=applies, from_below=below)
    motions = len(set(found.motion_of.values()))
    empty = replace(empty, of_target=found.method is not None)
    return replace(empty, motions=motions) if applies and motions < len(found.histories) else empty


def _limit(asked: Requirement) -> tuple[float, str]:
    if asked.share is not None:
        return asked.share, "1"
    limit = asked.most if asked.most is not None else asked.least
    assert limit is not None
    return limit, asked.unit


def _remark(
    asked: Requirement,
    found: HistorySet,
    value: float | None = None,
    met: bool | None = None,
    place: Located | None = None,
    places: Iterable[Located | None] = (),
) -> str:
    remarks = [place.remark] if place is not None and place.remark and met is False else []
    if not found.histories:
        remarks.append("no such histories")
    if asked.share is None and asked.most is not None and asked.least is not None and met and value is not None:
        remarks.append("better than the range" if value < asked.least else "within the range")
    if found.failed:
        remarks.append("failed histories count as beyond the limit")
    if found.not_run:
        remarks.append("histories not run yet")
    rotation, member = max((place.not_judged for place in places if place is not None), default=(0.0, ""))
    if member:
        rotates = f"up to {1e3 * rotation:.3g} mrad ({member})"
        remarks.append(f"rotations about weak axes, {rotates}, are not judged: no limit is known")
    still_beams = {name: None for group in found.completed.values() for name in group.attributes.get(STILL_BEAMS) or ()}
    if still := [name for name in map(str, still_beams) if asked.bends(name)]:
        remarks.append(f"vertical motion does not bend {listed(still, 3)}: masses stand at the ends of beams")
    return "; ".join(remarks)
