"""Cross checks of criteria and objectives: what they name exists, and no two of them contradict each other."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType

from edesign.project.analysis.outputs import HistoryKind
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.criteria_in_space import check_in_space
from edesign.project.checks.criterion_places import check_places
from edesign.project.checks.criterion_quantities import check_members, check_quantity
from edesign.project.checks.names import check_names
from edesign.project.checks.selections import GridSelections
from edesign.project.criteria.criteria import (
    Criterion,
    LimitCriterion,
    MeasureCriterion,
    Objectives,
    QuantityCriterion,
)
from edesign.project.criteria.criterion_quantities import keys_of
from edesign.project.criteria.measures import MEASURES
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, keys_text


def check_criteria(
    keys: Keys,
    criteria: Sequence[Criterion],
    objectives: Objectives,
    project: AnalysisFile,
    variants: Collection[str],
    problems: Problems,
    kept: Collection[HistoryKind] | None = None,
    dampers: Mapping[str, Sequence[str]] = MappingProxyType({}),
) -> None:
    """Check criteria and objectives against the project and against each other.

    Args:
        keys: path of the mapping that has `criteria` and `objectives`; () for the root of a study file.
        criteria: as read; they have no schema problems.
        objectives: letters.
        project: whose structure and hazard levels they mean.
        variants: names of the variants of the study.
        kept: histories that the study keeps of every record; None: not known.
        dampers: names of the dampers of each variant.
    """
    levels = project.hazard_levels
    for i, criterion in enumerate(criteria):
        at: Keys = (*keys, "criteria", i)
        before = len(problems.found)
        if criterion.name in (earlier.name for earlier in criteria[:i]):
            problems.at_value((*at, "name"), f"the name `{criterion.name}` is used already [E-NAME-02]")
        check_names(problems, (*at, "variants"), "variant", criterion.variants, variants)
        check_names(problems, (*at, "levels"), "level", criterion.levels, levels)
        GridSelections(problems, project.grid.n_storeys, project.structure).storeys(at, criterion.storeys)
        if criterion.share is not None and "statistic" in criterion.model_fields_set:
            problems.at_key(
                (*at, "share"), "a criterion has a `statistic` or a `share` of the motions, not both [E-KEY-03]"
            )
        if isinstance(criterion, LimitCriterion):
            _limits(problems, at, criterion)
            check_in_space(at, criterion, project, problems)
        if isinstance(criterion, QuantityCriterion):
            check_quantity(at, criterion, project, problems, kept, dampers)
        if isinstance(criterion, MeasureCriterion) and not _measured(problems, at, criterion, project):
            continue
        traits = criterion.traits
        if traits.members_of is not None:
            check_members((*at, "members"), traits.members, project, traits.members_of, problems)
        if isinstance(criterion, LimitCriterion) and len(problems.found) == before:
            check_places(at, criterion, project, problems, dampers)
    _contradictions(problems, keys, criteria, tuple(variants), tuple(levels))
    for i, letter in enumerate(objectives):
        at = (*keys, "objectives", i)
        if letter in objectives[:i]:
            problems.at_value(at, f"`{letter}` comes twice [E-NAME-02]")


def _limits(problems: Problems, at: Keys, criterion: LimitCriterion) -> None:
    if criterion.most is None and criterion.least is None:
        problems.under(at, "most", "this key is missing (or `least`); a criterion needs a limit [E-KEY-02]")
    elif criterion.most is not None and criterion.least is not None and criterion.least > criterion.most:
        message = (
            f"`least` ({criterion.least:g}) is greater than `most` ({criterion.most:g}); nothing is in between"
            " [E-VALUE-04]"
        )
        problems.at_value((*at, "least"), message)


def _measured(problems: Problems, at: Keys, criterion: MeasureCriterion, project: AnalysisFile) -> bool:
    """Whether the structure has a measure at all; selections that mean nothing for it are reported."""
    place = MEASURES[criterion.measure].place
    if place is None or place == "storey":
        if criterion.members:
            problems.at_key((*at, "members"), f"`{criterion.measure}` has no members to choose from [E-CRIT-04]")
        if not criterion.storeys.is_all and place is None:
            whole = f"`{criterion.measure}` is one of the whole {project.structure} [E-CRIT-04]"
            problems.at_key((*at, "storeys"), whole)
    elif place == "brace" and not _buckle(project):
        whose = f"braces with `buckling`, and this {project.structure} has none"
        message = f"`{criterion.measure}` is one of {whose} [E-CRIT-04]"
        problems.at_value((*at, "measure"), message)
        return False
    return True


def _buckle(project: AnalysisFile) -> bool:
    return isinstance(project, Project) and any(run.buckling is not None for run in project.frame.braces)


def _contradictions(
    problems: Problems, keys: Keys, criteria: Sequence[Criterion], variants: tuple[str, ...], levels: tuple[str, ...]
) -> None:
    """Two ranges of one statistic of one measure, over the same place, that have nothing in common."""
    measured = [(i, c) for i, c in enumerate(criteria) if isinstance(c, LimitCriterion)]
    for position, (i, later) in enumerate(measured):
        for j, earlier in measured[:position]:
            if not _same(earlier, later):
                continue
            both = [
                f"{variant} at {level}"
                for variant in (later.variants or variants)
                for level in (later.levels or levels)
                if variant in (earlier.variants or variants) and level in (earlier.levels or levels)
            ]
            low = max(earlier.least or 0.0, later.least or 0.0)
            high = min(_most(earlier), _most(later))
            alone = max((earlier.least or 0.0) - _most(earlier), (later.least or 0.0) - _most(later))
            if both and low > high and alone <= 0.0:
                line = problems.node((*keys, "criteria", j)).mark.line
                place = keys_text((*keys, "criteria", j))
                bounds = f"at least {low:g} and at most {high:g} {later.kind.unit.replace('1', '')}".rstrip()
                message = (
                    f"`{later.name}` contradicts `{earlier.name}` ({place}, line {line}): for {both[0]} "
                    f"the {later.statistic} of `{later.subject}` cannot be {bounds} [E-VALUE-04]"
                )
                problems.at_value((*keys, "criteria", i), message)


def _same(one: LimitCriterion, other: LimitCriterion) -> bool:
    if one.subject != other.subject or type(one) is not type(other):
        return False
    keys = ("storeys", "members") if isinstance(one, MeasureCriterion) else keys_of(one.quantity)
    if one.in_space != other.in_space:
        return False
    return all(getattr(one, key) == getattr(other, key) for key in ("statistic", "share", *keys))


def _most(criterion: LimitCriterion) -> float:
    return math.inf if criterion.most is None else criterion.most
