"""Structural performance levels that histories meet, by drift and by plastic rotations of members."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from edesign.archive.dataset import Group
from edesign.assess.acceptance import ELASTIC_ROTATION, FrameMember, Kind
from edesign.assess.measures import located_measure, place_in_words
from edesign.assess.members import member_usages
from edesign.assess.sets import TARGET, HistorySet
from edesign.assess.statistics import STATISTICS, statistics
from edesign.codes.fema356.drift import drift_limits
from edesign.project.criteria.performance import PERFORMANCE_STANDARDS, By, Standard
from edesign.project.notation.names import member_kind

BEYOND = "beyond CP"
"""What stands for the level of a response that meets none."""


@dataclass(frozen=True)
class Usage:
    """A response over what a performance level allows: the level is met up to 1.

    Attributes:
        governing: "transient drift", "residual drift" or "plastic rotation".
        storey: where it governs.
        member: the column or beam that governs, "" for a drift.
        rotation: largest plastic rotation of the member, rad.
        elastic: why the member has to stay elastic, as a force-controlled column has; "" where it has not.
        line, direction: of a drift of a building, "" where there is none.
        axis: about which the member of a building rotates, "" where there is none.
        not_judged: largest plastic rotation about a weak axis, rad, and its member; 0 and "" where nothing rotates so.
    """

    ratio: float
    governing: str
    storey: int | None = None
    member: str = ""
    rotation: float = 0.0
    elastic: str = ""
    line: str = ""
    direction: str = ""
    axis: str = ""
    not_judged: tuple[float, str] = (0.0, "")

    @property
    def place(self) -> str:
        """The storey or member, of a building with its line and direction, or its axis."""
        return place_in_words(self.storey, self.member, None, self.line, self.direction, self.axis)

    @property
    def of_force(self) -> str:
        """Remark on a member that has to stay elastic, as a force-controlled column; "" for anything else."""
        if not self.elastic:
            return ""
        member = f"{member_kind(self.member)} {self.member} {self.elastic}"
        if self.ratio <= 1.0:
            return f"{member} and {'elastic' if self.elastic.startswith('is') else 'is elastic'}"
        return f"{member} and yields: plastic rotation {1e3 * self.rotation:.3g} mrad"


@dataclass(frozen=True)
class SetPerformance:
    """Performance levels of a variant at a hazard level.

    Attributes:
        statistic: over the histories, of the usages of each level.
        by_drift, by_members: the level of the statistic, None without any result.
        drift_counts, member_counts: how many motions, by their worst histories, are at each level and beyond the last.
        worst_drift, worst_members: (history, its usage of the last level) with the largest usage of this level.
        count: completed histories.
        missing: the others; they are in no count and in no statistic.
    """

    variant: str
    level: str
    statistic: str
    by_drift: str | None
    by_members: str | None
    drift_counts: dict[str, int]
    member_counts: dict[str, int]
    worst_drift: tuple[str, Usage] | None
    worst_members: tuple[str, Usage] | None
    count: int
    missing: tuple[str, ...]


def drift_performance(group: Group, level: str, storeys: Collection[int] | None = None) -> Usage | None:
    """Return the drifts of a history over those of a level; None if it has no residual drift.

    A state at a target displacement has none, and is judged by its transient drift alone.

    Args:
        level: IO, LS or CP.
        storeys: only these; None: all.
    """
    limits = drift_limits(level)
    found = []
    for measure, governing, limit in (
        ("interstorey_drift", "transient drift", limits.transient),
        ("residual_interstorey_drift", "residual drift", limits.permanent),
    ):
        place = located_measure(group, measure, storeys)
        if place is None:
            if measure.startswith("residual") and group.attributes.get("kind") == TARGET:
                continue
            return None
        found.append(Usage(place.value / limit, governing, place.storey, line=place.line, direction=place.direction))
    return max(found, key=lambda usage: usage.ratio)


def member_performance(
    group: Group,
    members: Mapping[str, FrameMember],
    level: str,
    kinds: Collection[Kind] = ("column", "beam"),
    storeys: Collection[int] | None = None,
    standard: str = "fema356",
) -> Usage | None:
    """Return the plastic rotation of the member that governs over what a level allows it; None without any.

    Args:
        group: of the analysis in the archive.
        members: of the frame, by name.
        level: a performance level of the standard.
        kinds: of the members that count.
        storeys: whose members count; None: all.
        standard: whose level it is, a key of `ACCEPTANCE`.
    """
    usages = member_usages(group, members, level, kinds, storeys, standard)
    if not usages:
        return None
    worst = max(usages, key=lambda usage: usage.ratio)
    member = worst.member
    weak = max(usages, key=lambda usage: usage.other)
    return Usage(
        worst.ratio,
        "plastic rotation",
        member.storey,
        member.name,
        worst.rotation,
        worst.elastic,
        axis=worst.axis,
        not_judged=(weak.other, weak.member.name) if weak.other > ELASTIC_ROTATION else (0.0, ""),
    )


def usage(
    group: Group,
    members: Mapping[str, FrameMember],
    level: str,
    by: By = "both",
    kinds: Collection[Kind] = ("column", "beam"),
    storeys: Collection[int] | None = None,
    standard: str = "fema356",
) -> Usage | None:
    """Return the usage of a level by drift, by members, or the larger of both; None if one that counts is missing.

    Args:
        group: of the analysis in the archive.
        members: of the frame, by name.
        level: a performance level of the standard.
        by: "drift", "members" or "both"; FEMA 356 alone has levels by drift.
        storeys: that count; None: all.
        standard: whose level it is, a key of `ACCEPTANCE`.
    """
    found = []
    if by != "members":
        found.append(drift_performance(group, level, storeys))
    if by != "drift":
        found.append(member_performance(group, members, level, kinds, storeys, standard))
    there = [item for item in found if item is not None]
    if len(there) < len(found):
        return None
    return replace(max(there, key=lambda item: item.ratio), not_judged=max(item.not_judged for item in there))


def set_performance(
    histories: HistorySet, members: Mapping[str, FrameMember], statistic: str = "mean", standard: Standard = "fema356"
) -> SetPerformance:
    """Return the performance levels of a set of histories; by drift there are none but in FEMA 356.

    Args:
        histories: of one variant at one hazard level.
        statistic: a name of `STATISTICS`; FEMA 356 (3.3.2.2.4) takes the mean of seven or more histories and the
            maximum of fewer.
    """
    completed, of = histories.completed, PERFORMANCE_STANDARDS[standard]
    beyond = f"beyond {[*of.levels][-1]}"
    found: dict[str, tuple[str | None, dict[str, int], tuple[str, Usage] | None]] = {}
    ways: tuple[By, ...] = ("drift", "members")
    for by in ways:
        if by not in of.tables:
            found[by] = None, {}, None
            continue
        kept: dict[str, dict[str, Usage | None]] = {
            name: {level: usage(group, members, level, by, standard=standard) for level in of.levels}
            for name, group in completed.items()
        }
        of_motions = _of_motions(kept, histories)
        levels = {name: _reached(usages, beyond) for name, usages in of_motions.items()}
        counts = {level: sum(reached == level for reached in levels.values()) for level in (*of.levels, beyond)}
        together = {}
        for level in of.levels:
            ratios = {
                name: None if (item := usages[level]) is None else item.ratio for name, usages in of_motions.items()
            }
            value = STATISTICS[statistic](statistics(ratios))
            together[level] = None if value is None else Usage(value, statistic)
        worst = [(name, item) for name, usages in kept.items() if (item := [*usages.values()][-1]) is not None]
        found[by] = (
            _reached(together, beyond),
            counts,
            max(worst, key=lambda pair: pair[1].ratio, default=None),
        )
    (by_drift, drift_counts, worst_drift), (by_members, member_counts, worst_members) = found["drift"], found["members"]
    return SetPerformance(
        histories.variant,
        histories.level,
        statistic,
        by_drift,
        by_members,
        drift_counts,
        member_counts,
        worst_drift,
        worst_members,
        len(completed),
        tuple(name for name in histories.histories if name not in completed),
    )


def _of_motions(
    kept: Mapping[str, dict[str, Usage | None]], histories: HistorySet
) -> dict[str, dict[str, Usage | None]]:
    """The worst usage of each level over the histories of a motion, by the name of its first one."""
    found: dict[str, dict[str, Usage | None]] = {}
    for name, usages in kept.items():
        one = found.setdefault(histories.motion_of[name], dict(usages))
        for level, item in usages.items():
            other = one[level]
            if item is None or (other is not None and item.ratio > other.ratio):
                one[level] = item
    return found


def _reached(usages: Mapping[str, Usage | None], beyond: str) -> str | None:
    """The first level whose usage is at most 1, `beyond` if there is none; None without results."""
    for level, item in usages.items():
        if item is None:
            return None
        if item.ratio <= 1.0:
            return level
    return beyond
